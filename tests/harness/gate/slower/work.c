#include "tests/harness/gate/slower/work.h"

static volatile unsigned kept;

void rg_test_work(long loops)
{
    unsigned x = kept | 1;
    for (long i = 0; i < loops; i++)
        x *= 0x9e3779b1u + (unsigned)i;
    kept = x;
}
