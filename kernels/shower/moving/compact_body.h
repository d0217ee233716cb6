// shower: particles of place and speed alone, tested by their corners.
#define SHOWER_FULL 0
#define SHOWER_BODY 1
#include "kernels/shower/moving/move.h"
