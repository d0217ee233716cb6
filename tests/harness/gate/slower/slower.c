// raingauge with real work beside each timed frame, on the thread that simulates and draws:
// RG_EXTRA_LOOPS loops of work.h.
#include <stdbool.h>
#include <stdlib.h>

#include "harness/console/interrupt.h"
#include "tests/harness/gate/slower/work.h"

bool __real_rg_interrupted(void);
bool __wrap_rg_interrupted(void);

// A session asks this once a frame (harness/devices/frames/local.c), within the timed part.
bool __wrap_rg_interrupted(void)
{
    static long loops = -1;
    if (loops < 0)
        loops = getenv("RG_EXTRA_LOOPS") ? atol(getenv("RG_EXTRA_LOOPS")) : 0;
    rg_test_work(loops);
    return __real_rg_interrupted();
}
