// Makes what a level draws with of the DRAW program that was just included.
#if RG_CHECKED
#include "backends/cpu/draw_reference.h"
#else
#include "backends/cpu/draw_stages.h"
#endif
