// shower: particles with their attributes, tested by their point.
#define SHOWER_FULL 1
#define SHOWER_BODY 0
#include "kernels/shower/moving/move.h"
