// The processor's name.
#ifndef RG_CORE_BASE_FILES_PROCESSOR_H
#define RG_CORE_BASE_FILES_PROCESSOR_H

#include <stddef.h>

// The processor's name from a file as Linux' /proc/cpuinfo: its model name, or on arm64, which has
// none, what its implementers and parts are called ("Neoverse-N1", "Cortex-A76, Cortex-A55"); those
// of unknown names by number ("implementer 0x41, part 0xd99"). "" where the file has neither.
void rg_processor_name(const char *path, char *name, size_t size);

#endif
