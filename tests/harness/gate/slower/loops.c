// Does the given number of loops of raingauge-slower's work, so that others can time them.
#include <stdlib.h>

#include "tests/harness/gate/slower/work.h"

int main(int argc, char **argv)
{
    rg_test_work(argc > 1 ? atol(argv[1]) : 0);
    return 0;
}
