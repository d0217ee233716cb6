// shower: particles with their attributes, tested by their corners.
#define SHOWER_FULL 1
#define SHOWER_BODY 1
#include "kernels/shower/moving/move.h"
