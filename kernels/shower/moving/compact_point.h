// shower: particles of place and speed alone, tested by their point.
#define SHOWER_FULL 0
#define SHOWER_BODY 0
#include "kernels/shower/moving/move.h"
