// Functions compiled for several x86-64 levels, the best chosen at start. No level may fuse
// multiplications and additions, so that all give the same bits.
#ifndef RG_CORE_IMAGE_COMPARE_MULTIVERSION_H
#define RG_CORE_IMAGE_COMPARE_MULTIVERSION_H

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define RG_MULTIVERSION                                                                            \
    __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define RG_MULTIVERSION
#endif

#endif
