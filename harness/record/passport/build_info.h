// The sources and tools of this binary; filled in by the build.
#ifndef RG_HARNESS_RECORD_PASSPORT_BUILD_INFO_H
#define RG_HARNESS_RECORD_PASSPORT_BUILD_INFO_H

extern const char rg_build_version[]; // "0.1.0"
// git's, with "-dirty" for a changed tree; "unknown" outside git
extern const char rg_build_commit[];
extern const char rg_build_compiler[]; // "gcc 12.2.0"
extern const char rg_build_type[];     // meson's: "release", "debug"; with sanitizers, if any

// A library that takes part in what is computed: other versions read or decimate meshes in another
// way.
struct rg_build_library {
    const char *name, *version; // "meshoptimizer", "0.18"
};
extern const struct rg_build_library rg_build_libraries[]; // ends with a name of NULL

#endif
