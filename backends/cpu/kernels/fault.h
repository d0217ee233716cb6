// An index out of range, found by cpu:reference: the first one of a run.
#ifndef RG_BACKENDS_CPU_KERNELS_FAULT_H
#define RG_BACKENDS_CPU_KERNELS_FAULT_H

struct rg_fault {
    const char *slot; // NULL: none
    int index, count;
};

// The index if it is in range, else 0 with the fault noted, so that the run can go on and report.
static inline __attribute__((unused)) int rg_checked_index(struct rg_fault *fault, int index,
                                                           int count, const char *slot)
{
    if (index >= 0 && index < count)
        return index;
    if (!fault->slot) {
        fault->slot = slot;
        fault->index = index;
        fault->count = count;
    }
    return 0;
}

#endif
