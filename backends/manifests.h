// The files that tell an API's loader where its drivers are, read once more.
//
// Loaders pass over a driver that they cannot load, in silence, and then say that there is none. So
// a driver that is there and fails looks like one that is absent. Here the same files are looked
// for in the same places, and the libraries that they name are loaded, to find out which it is.
#ifndef RG_BACKENDS_MANIFESTS_H
#define RG_BACKENDS_MANIFESTS_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

// A variable that holds folders, ':' between two, and what is taken where it is not set: "~/" is
// the user's folder.
struct rg_manifest_place {
    const char *variable, *usual; // either may be NULL
};

// Where an API's loader looks, and for what. Lists end with NULL.
struct rg_manifest_rules {
    // Variables with files or folders that are read instead of the usual places; the first that is
    // set counts. Then those whose files are read besides.
    const char *instead[4], *beside[3];
    struct rg_manifest_place places[6]; // the usual ones, up to one of two NULLs
    const char *below;                  // the folder in each of them: "/vulkan/icd.d"
    const char *ending;                 // of a file's name: ".json"
    bool names_any;                     // a variable's file may be called anything
    bool names_libraries;               // or be the library itself
    bool names_usual;                   // or be a name in the first of the usual places
    bool is_text;                       // a file is a line, and no JSON
    bool beside_file;                   // a path with a '/' begins at the file's own folder
    const char *functions[3];           // a driver's library has one of them
    // Asks a driver whose library could be loaded: how many devices it tells of; -1: it fails, and
    // `why` says how. NULL: it is not asked.
    int (*ask)(void *library, char *why, size_t why_size);
    const char *package; // the Debian package that brings a driver
};

// What the loader itself came to, where it gave no device that can be used.
enum rg_manifest_state {
    RG_MANIFEST_NONE,    // it found none
    RG_MANIFEST_UNCLEAR, // an error that it also gives where there is none
    RG_MANIFEST_FAILED,  // an error
};

// What a backend's list returns that has found `count` devices: `count`; 0: no driver is there; -1:
// one is there, and fails. `why` (of `why_size` bytes) has the loader's reason where there is no
// device, and gets one line: what failed, or how to come by a driver. Beside devices it is "", or
// tells of another driver that fails. Where a variable names a driver that cannot be loaded, the
// list fails, whatever else was found: the driver that was named has to be the one that runs.
int rg_manifests_judge(const struct rg_manifest_rules *rules, int count,
                       enum rg_manifest_state state, char *why, size_t why_size);

// Says that drivers are being loaded, to whoever learns of a crash (core/base/doing.h), where a
// variable names them.
void rg_manifests_begin(const struct rg_manifest_rules *rules);

// The files of drivers that can be loaded, ':' between two, where others cannot, and no variable
// names any. Else false.
bool rg_manifests_sound(const struct rg_manifest_rules *rules, char *paths, size_t size);

// The library that a driver's file names, as it stands there: ICD.library_path of JSON, or the
// first word of a text. False, and `fault` says why, where it names none.
bool rg_manifest_read_library(FILE *file, bool is_text, char named[PATH_MAX], char *fault,
                              size_t size);

// Loads a library, and lets it go again. False where it cannot be, and `why` has the linker's
// words; `is_absent` is set where there simply is no such file.
bool rg_manifests_load(const char *library, bool *is_absent, char *why, size_t why_size);

#endif
