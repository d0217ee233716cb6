// Makes of the DRAW program that was just included the functions that a level draws it with.
#if RG_CHECKED
#include "backends/cpu/draw/reference_tmpl.h"
#else
#include "backends/cpu/draw/stages_tmpl.h"
#endif
