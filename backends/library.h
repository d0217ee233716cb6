// Which file on disk holds code that this process runs.
//
// A driver's name and version are what it says of itself, and its path is what somebody asked for:
// the loaders of Vulkan, EGL and OpenCL look through folders, and may take another file. So the
// file is found from the code itself, by the address of a function.
#ifndef RG_BACKENDS_LIBRARY_H
#define RG_BACKENDS_LIBRARY_H

#include <stdbool.h>
#include <stdint.h>

enum { RG_LIBRARY_PATH = 512, RG_BUILD_ID_SIZE = 129 };

struct rg_library {
    char path[RG_LIBRARY_PATH];   // as the kernel has mapped it, without links; "": unknown
    char build[RG_BUILD_ID_SIZE]; // rg_build_id
    uint64_t device, inode;       // of the file; both 0: unknown
};

struct dl_phdr_info;

// The linker's build id of a loaded object, in hexadecimal digits: any change of its code gives
// another one. Where the linker left none, a hash of its code.
void rg_build_id(const struct dl_phdr_info *object, char id[RG_BUILD_ID_SIZE]);

// The file that holds the code at this address; all "" and 0 where none does.
void rg_library_at(const void *code, struct rg_library *library);

// Whether the object that holds the code at this address exports the symbol itself. What an object
// that it needs exports does not count.
bool rg_library_exports(const void *code, const char *symbol);

// The code of loaded objects, one after the other: an address in each for which `is_wanted` says
// yes, of its path and such an address. Up to `max`; returns how many.
int rg_libraries_find(bool (*is_wanted)(const char *path, const void *code), const void **codes,
                      int max);

// Whether both are one file: by the file system's numbers, or by path and build id where a file
// system has no stable numbers.
bool rg_library_is_same(const struct rg_library *a, const struct rg_library *b);

#endif
