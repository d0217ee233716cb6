#define _XOPEN_SOURCE 700 // shmget
#include "harness/devices/workers/segment.h"

#include <errno.h>
#include <stddef.h>
#include <sys/shm.h>

static const void *const failed = (void *)-1;

int rg_segment_create(struct rg_segment *segment, int64_t size)
{
    rg_segment_free(segment);
    const int id = shmget(IPC_PRIVATE, (size_t)size, IPC_CREAT | 0600);
    if (id < 0)
        return errno;
    void *bytes = shmat(id, NULL, 0);
    const int error = bytes == failed ? errno : 0;
    // It is removed at once, and lives on as long as a process has it: so none is ever left behind.
    shmctl(id, IPC_RMID, NULL);
    if (!error)
        *segment = (struct rg_segment){id, bytes, size};
    return error;
}

bool rg_segment_join(struct rg_segment *segment, int id)
{
    struct shmid_ds state;
    rg_segment_free(segment);
    void *bytes = shmat(id, NULL, 0);
    if (bytes == failed)
        return false;
    *segment = (struct rg_segment){id, bytes, 0};
    if (shmctl(id, IPC_STAT, &state)) {
        rg_segment_free(segment);
        return false;
    }
    segment->size = (int64_t)state.shm_segsz;
    return true;
}

void rg_segment_free(struct rg_segment *segment)
{
    if (segment->bytes)
        shmdt(segment->bytes);
    *segment = (struct rg_segment){0};
}
