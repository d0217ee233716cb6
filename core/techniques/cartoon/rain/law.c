// The law of the rain on every device: no drop or splash is lost.
#include <stdio.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/techniques/cartoon/rain/rain.h"

struct living {
    uint32_t falling, stuck, sprays;
};

static bool read_all(const struct cartoon_rain *r, cartoon_raindrop *drops, cartoon_spray *sprays,
                     uint32_t *tally)
{
    const int64_t drop_bytes = r->params.drop_slots * (int64_t)sizeof(*drops);
    const int64_t spray_bytes = r->params.spray_slots * (int64_t)sizeof(*sprays);
    return drops && sprays && rg_buf_read(r->raindrops->buf, 0, drops, drop_bytes) &&
           rg_buf_read(r->sprays->buf, 0, sprays, spray_bytes) &&
           rg_buf_read(r->tally->buf, 0, tally, CARTOON_TALLY * 4);
}

static struct living count(const struct cartoon_rain *r, const cartoon_raindrop *drops,
                           const cartoon_spray *sprays)
{
    struct living n = {0};
    for (int i = 0; i < r->params.drop_slots; i++) {
        n.falling += drops[i].state == CARTOON_DROP;
        n.stuck += drops[i].state != CARTOON_DROP && drops[i].state != CARTOON_DEATH;
    }
    for (int i = 0; i < r->params.spray_slots; i++)
        n.sprays += sprays[i].state != CARTOON_DEATH;
    return n;
}

bool cartoon_rain_holds(const struct cartoon_rain *r, char *detail, size_t size)
{
    cartoon_raindrop *drops = rg_alloc((size_t)r->params.drop_slots, sizeof(*drops), "drops");
    cartoon_spray *sprays = rg_alloc((size_t)r->params.spray_slots, sizeof(*sprays), "splashes");
    uint32_t t[CARTOON_TALLY];
    bool holds = read_all(r, drops, sprays, t);
    if (holds) {
        const struct living n = count(r, drops, sprays);
        holds = n.falling == t[CARTOON_RELEASED] - t[CARTOON_HITS] - t[CARTOON_LEFT] &&
                n.stuck == t[CARTOON_HITS] - t[CARTOON_FADED] &&
                n.sprays == t[CARTOON_SPLASHED] - t[CARTOON_SPRAY_ENDED] &&
                t[CARTOON_SPLASHED] == t[CARTOON_HITS] && !t[CARTOON_REFUSED];
        if (!holds)
            snprintf(detail, size,
                     "%u drops fall, %u stick and %u splash, of %u released, %u hits, %u that left "
                     "and %u splashes that ended",
                     n.falling, n.stuck, n.sprays, t[CARTOON_RELEASED], t[CARTOON_HITS],
                     t[CARTOON_LEFT], t[CARTOON_SPRAY_ENDED]);
    }
    free(drops);
    free(sprays);
    return holds;
}
