// Manifests: the small files that tell the loaders of Vulkan, EGL and OpenCL about drivers. Each
// names a library, by path, or by a bare name that the dynamic linker looks up in the system's
// folders, wherever the manifest is.
#ifndef RG_HARNESS_DEVICES_DRIVERS_MANIFEST_H
#define RG_HARNESS_DEVICES_DRIVERS_MANIFEST_H

#include <jansson.h>
#include <limits.h>
#include <stdbool.h>

enum rg_manifest_fault {
    RG_MANIFEST_WELL,
    RG_MANIFEST_ABSENT,    // the file does not exist
    RG_MANIFEST_NO_FORM,   // it is not a manifest
    RG_MANIFEST_NO_LIBRARY // the library at its path does not exist
};

struct rg_manifest {
    char path[PATH_MAX];
    char named[PATH_MAX];   // the library as written in the manifest
    char library[PATH_MAX]; // the library for the dynamic linker: a path, or a bare name
    bool is_bare;
    enum rg_manifest_fault fault;
};

// Reads a manifest: JSON with a "library_path", or, if the name ends in ".icd", a line with the
// library.
void rg_manifest_read(const char *path, struct rg_manifest *manifest);

// Writes a copy with another library, unless that content is there already. False, and one logged
// line, on failure.
bool rg_manifest_write(const struct rg_manifest *manifest, const char *library, const char *path);

// The prefix under which a manifest is installed, "/opt/mesa" for
// "/opt/mesa/usr/share/vulkan/icd.d/lvp.json"; "": the manifest is not in a folder for manifests,
// or is in the system's.
void rg_manifest_tree(const char *path, char tree[PATH_MAX]);

// Whether a path is below a folder, after following links.
bool rg_path_is_below(const char *path, const char *folder);

// Whether a file is a library for another processor or address size than this program's.
bool rg_library_is_foreign(const char *path);

#endif
