// Does so much of the work of raingauge-slower, for others to tell what it takes.
#include <stdlib.h>

#include "tests/harness/gate/slower/work.h"

int main(int argc, char **argv)
{
    rg_test_work(argc > 1 ? atol(argv[1]) : 0);
    return 0;
}
