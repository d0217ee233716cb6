// For tests of drops: an instance with settings as text, and the contents of its buffers.
#ifndef RG_TESTS_CORE_TECHNIQUES_DROPS_RIG_H
#define RG_TESTS_CORE_TECHNIQUES_DROPS_RIG_H

#include "core/techniques/drops/instance.h"

// Opens drops with these "key=value key=value" over its defaults, and a picture of this size. Fails
// the test otherwise.
struct drops *rig_open_sized(struct rg_device *device, const char *assignments, int width,
                             int height);
// The same for tests of the simulation alone: the picture is small and shows the height map.
struct drops *rig_open(struct rg_device *device, const char *assignments);
void rig_close(struct drops *d);
void rig_step(struct drops *d, int steps);

// All words of a buffer; the caller frees them.
void *rig_words(struct drops *d, const char *name);
uint32_t rig_tally(struct drops *d, int word);
// All drops; the caller frees them.
drops_drop *rig_drops(struct drops *d, int *count);
// Replaces the drops. Their IDs are first_id, first_id + 1 and so on, and none counts as new.
void rig_put(struct drops *d, const drops_drop *all, int count, uint32_t first_id);

#endif
