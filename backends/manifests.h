// Examines the files that tell an API's loader where its drivers are.
//
// Loaders silently skip a driver that they cannot load, and then report none, so that a broken
// driver looks like a missing one. To tell the two apart, this code reads the same files in the
// same places, and loads the libraries named there.
#ifndef RG_BACKENDS_MANIFESTS_H
#define RG_BACKENDS_MANIFESTS_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "backends/backend.h"

// A variable that holds folders, separated by ':', and the default if it is not set; "~/" is the
// user's folder.
struct rg_manifest_place {
    const char *variable, *usual; // either may be NULL
};

// The places in which an API's loader looks for drivers. Lists end with NULL.
struct rg_manifest_rules {
    // Variables with files or folders that replace the usual places; the first that is set counts.
    // And variables with additional files.
    const char *instead[4], *beside[3];
    struct rg_manifest_place places[6]; // the usual places; two NULLs end the list
    const char *below;                  // the subfolder in each place: "/vulkan/icd.d"
    const char *ending;                 // of a file's name: ".json"
    bool names_any;                     // files named by variables may have any name
    bool names_libraries;               // or be the library itself
    bool names_usual;                   // or be a name in the first usual place
    bool is_text;                       // a file has one line of text, not JSON
    bool beside_file;                   // paths with a '/' are relative to the file's folder
    const char *functions[3];           // a driver's library exports one of these
    // Asks a driver, whose library could be loaded, for its number of devices; -1: it fails, and
    // `why` says how. NULL: drivers are not asked.
    int (*ask)(void *library, char *why, size_t why_size);
    const char *package; // the Debian package with a driver
};

// The loader's own result when it gave no usable device.
enum rg_manifest_state {
    RG_MANIFEST_NONE,    // it found none
    RG_MANIFEST_UNCLEAR, // an error that it also reports if it finds none
    RG_MANIFEST_FAILED,  // an error
    RG_MANIFEST_BROKEN,  // an error of this machine's set-up
};

// The result of a backend's list that has found `count` devices: `count`; 0: no driver is
// installed; or an enum rg_list_end. Without devices, `why` (of `why_size` bytes) has the loader's
// reason, and gets one line: what failed, or how to install a driver. With devices it is "", or
// tells of another driver that fails. If a variable names a driver that cannot be loaded, the list
// fails in any case, because the named driver must be the one that runs.
int rg_manifests_judge(const struct rg_manifest_rules *rules, int count,
                       enum rg_manifest_state state, char *why, size_t why_size);

// If a variable names drivers, notes that they are being loaded, for reports of a crash
// (core/base/doing.h).
void rg_manifests_begin(const struct rg_manifest_rules *rules);

// The files of drivers that can be loaded, separated by ':', if others cannot and no variable names
// any; else false.
bool rg_manifests_sound(const struct rg_manifest_rules *rules, char *paths, size_t size);

// The library named in a driver's file: ICD.library_path of JSON, or the first word of a text.
// False, with the reason in `fault`, if there is none.
bool rg_manifest_read_library(FILE *file, bool is_text, char named[PATH_MAX], char *fault,
                              size_t size);

// Loads and unloads a library. False on failure, with the linker's words in `why`; `is_absent` is
// set if there is no such file.
bool rg_manifests_load(const char *library, bool *is_absent, char *why, size_t why_size);

#endif
