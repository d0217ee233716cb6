// Finds the file on disk that holds code of this process.
//
// A driver's name and version are its own claims. A path is only a request: the loaders of Vulkan,
// EGL and OpenCL search folders, and may load another file. So the file is found by the address of
// a function in it.
#ifndef RG_BACKENDS_LIBRARY_H
#define RG_BACKENDS_LIBRARY_H

#include <stdbool.h>
#include <stdint.h>

enum { RG_LIBRARY_PATH = 512, RG_BUILD_ID_SIZE = 129 };

struct rg_library {
    char path[RG_LIBRARY_PATH];   // as mapped by the kernel, without links; "": unknown
    char build[RG_BUILD_ID_SIZE]; // rg_build_id
    uint64_t device, inode;       // of the file; both 0: unknown
};

struct dl_phdr_info;

// The linker's build id of a loaded object, in hexadecimal digits, which changes with its code.
// Without a build id, a hash of the code.
void rg_build_id(const struct dl_phdr_info *object, char id[RG_BUILD_ID_SIZE]);

// The file with the code at this address; all "" and 0 if there is none.
void rg_library_at(const void *code, struct rg_library *library);

// Whether the object that contains the address exports the symbol itself, rather than through an
// object that it needs.
bool rg_library_exports(const void *code, const char *symbol);

// Finds up to `max` loaded objects for which `is_wanted` returns true, given the object's path and
// an address in its code. Returns their number; `codes` gets the addresses.
int rg_libraries_find(bool (*is_wanted)(const char *path, const void *code), const void **codes,
                      int max);

// Whether both are one file: by device and inode, or by path and build id if a file system has no
// stable numbers.
bool rg_library_is_same(const struct rg_library *a, const struct rg_library *b);

#endif
