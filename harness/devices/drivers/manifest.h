// Manifests: the small files by which the loaders of Vulkan, EGL and OpenCL know drivers. One names
// a library, by its path, or by a bare name that the dynamic linker looks for in the system's
// folders, wherever the manifest itself lies.
#ifndef RG_HARNESS_DEVICES_DRIVERS_MANIFEST_H
#define RG_HARNESS_DEVICES_DRIVERS_MANIFEST_H

#include <jansson.h>
#include <limits.h>
#include <stdbool.h>

enum rg_manifest_fault {
    RG_MANIFEST_WELL,
    RG_MANIFEST_ABSENT,    // there is no such file
    RG_MANIFEST_NO_FORM,   // it is no manifest
    RG_MANIFEST_NO_LIBRARY // the library that it names by a path is not there
};

struct rg_manifest {
    char path[PATH_MAX];
    char named[PATH_MAX];   // the library as the manifest has it
    char library[PATH_MAX]; // the same for the dynamic linker: a path, or a bare name
    bool is_bare;
    enum rg_manifest_fault fault;
};

// Reads one: JSON with a "library_path", or where its name ends in ".icd" a line with the library.
void rg_manifest_read(const char *path, struct rg_manifest *manifest);

// Writes a copy that names another library, where no file of that content lies there. False, and
// one logged line, on failure.
bool rg_manifest_write(const struct rg_manifest *manifest, const char *library, const char *path);

// The folder that a manifest was installed under, "/opt/mesa" of
// "/opt/mesa/usr/share/vulkan/icd.d/lvp.json"; "": it lies in no folder that is meant for such
// files, or in the system's.
void rg_manifest_tree(const char *path, char tree[PATH_MAX]);

// Whether a path lies below a folder, links followed.
bool rg_path_is_below(const char *path, const char *folder);

// Whether a file is a library for another processor or another size of addresses than this program.
bool rg_library_is_foreign(const char *path);

#endif
