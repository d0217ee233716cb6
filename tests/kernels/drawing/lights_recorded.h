// lights.h with a record for each quad and light.
#define TEST_LIGHT_RECORDS 1
#include "tests/kernels/drawing/lights.h"
