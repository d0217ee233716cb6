// Notes of cpu:reference about a run: the first index out of range, and its counts.
#ifndef RG_BACKENDS_CPU_KERNELS_NOTES_H
#define RG_BACKENDS_CPU_KERNELS_NOTES_H

#include <stdint.h>

struct rg_notes {
    const char *slot; // the slot of an index out of range; NULL: none
    int index, count;
    int64_t records, fragments, fragments_kept, texels_fetched; // as in core/device/work.h
};

// Returns the index if it is in range, else notes the fault and returns 0, so that the run can
// finish.
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

// The same for an image's word, for a fetch of `texels` texels.
static inline __attribute__((unused)) int rg_checked_texels(struct rg_notes *notes, int index,
                                                            int count, const char *slot, int texels)
{
    notes->texels_fetched += texels;
    return rg_checked_index(notes, index, count, slot);
}

#endif
