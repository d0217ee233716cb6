// A driver of any API that crashes the process that loads it.
#include <stdlib.h>

__attribute__((constructor)) static void crash(void)
{
    abort();
}
