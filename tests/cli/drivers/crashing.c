// A driver of any API that brings down whoever loads it.
#include <stdlib.h>

__attribute__((constructor)) static void crash(void)
{
    abort();
}
