// What a candidate is on disk, so that a verdict is not taken for what has been built anew.
#ifndef RG_HARNESS_COMPARE_BISECT_STAMP_H
#define RG_HARNESS_COMPARE_BISECT_STAMP_H

#include <stdint.h>

// A hash of names, sizes and times of the file or folder that a candidate names or, where it names
// none, of those that stand in it, as in vulkan@VK_DRIVER_FILES=a.json:b.json. 0: it names none.
// What such a file names in turn is not looked at, and of a folder no more than 65,536 files are.
uint64_t rg_candidate_stamp(const char *name);

#endif
