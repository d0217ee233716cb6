// What cpu:reference notes of a run: the first index out of range, and what the run came to.
#ifndef RG_BACKENDS_CPU_KERNELS_NOTES_H
#define RG_BACKENDS_CPU_KERNELS_NOTES_H

#include <stdint.h>

struct rg_notes {
    const char *slot; // of the index that is out of range; NULL: none was
    int index, count;
    int64_t records, fragments, fragments_kept, texels_fetched; // as core/device/work.h has them
};

// The index if it is in range, else 0 with the fault noted, so that the run can go on and report.
static inline __attribute__((unused)) int rg_checked_index(struct rg_notes *notes, int index,
                                                           int count, const char *slot)
{
    if (index >= 0 && index < count)
        return index;
    if (!notes->slot) {
        notes->slot = slot;
        notes->index = index;
        notes->count = count;
    }
    return 0;
}

// The same of an image's word, from which so many texels are fetched.
static inline __attribute__((unused)) int rg_checked_texels(struct rg_notes *notes, int index,
                                                            int count, const char *slot, int texels)
{
    notes->texels_fetched += texels;
    return rg_checked_index(notes, index, count, slot);
}

#endif
