// Makes the drawing functions of a level for the DRAW program that was just included.
#if RG_CHECKED
#include "backends/cpu/draw/reference_tmpl.h"
#else
#include "backends/cpu/draw/stages_tmpl.h"
#endif
