// The traditional system as the paper's program ran it: one thread of the host allocates each
// particle at birth and frees it at death. Particles use the kernels' own functions, so that the
// numbers equal those of the free list.
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/techniques/shower/instance.h"
#include "kernels/shower/birth.h"
#include "kernels/shower/body.h"
#include "kernels/shower/heights.h"

struct shower_heap {
    shower_particle **at; // by slot; NULL: free
    int slots;
    float *words; // as on the device: planes, the attributes' after the others'
    int planes;
    int map_px;
    float *depths; // the scene's depth from above
    uint32_t tally[SHOWER_TALLY];
};

void shower_heap_close(struct shower_heap *h)
{
    if (!h)
        return;
    for (int i = 0; h->at && i < h->slots; i++)
        free(h->at[i]);
    free(h->at);
    free(h->words);
    free(h->depths);
    free(h);
}

static bool make(struct shower_heap *h, const struct shower *s, struct rg_image *heights)
{
    h->slots = s->params.slots;
    h->planes = SHOWER_WORDS + (s->params.is_full ? SHOWER_ATTRIBUTES : 0);
    h->map_px = heights->desc.width;
    const size_t texels = (size_t)h->map_px * (size_t)h->map_px;
    return (h->at = rg_alloc((size_t)h->slots, sizeof(*h->at), "particles")) &&
           (h->words =
                rg_alloc((size_t)h->slots * (size_t)h->planes, sizeof(*h->words), "particles")) &&
           (h->depths = rg_alloc(texels, sizeof(*h->depths), "scene seen from above")) &&
           rg_image_read(heights, 0, 0, h->depths);
}

struct shower_heap *shower_heap_open(const struct shower *s, struct rg_image *heights)
{
    struct shower_heap *h = rg_alloc(1, sizeof(*h), "particles");
    if (h && make(h, s, heights))
        return h;
    shower_heap_close(h);
    return NULL;
}

static float ground_at(const struct shower_heap *h, const shower_params *p, v3 at)
{
    const shower_map_place m = shower_map_place_at(*p, at.x, at.z, h->map_px, h->map_px);
    return shower_height(*p, h->depths[(size_t)m.z * (size_t)h->map_px + (size_t)m.x], m.outside);
}

// Moves a particle; false when it dies in this step.
static bool move(const struct shower_heap *h, const shower_params *p, bool by_point,
                 shower_particle *q)
{
    *q = shower_moved(*p, *q);
    const int seen = by_point ? shower_holds(*p, q->at) : shower_holds_body(*p, q->at, q->fall_m_s);
    return seen && q->at.y >= ground_at(h, p, q->at);
}

static void end_particles(struct shower_heap *h, const shower_params *p, bool by_point)
{
    for (int i = 0; i < h->slots; i++)
        if (h->at[i] && !move(h, p, by_point, h->at[i])) {
            free(h->at[i]);
            h->at[i] = NULL;
            h->tally[SHOWER_ALIVE]--;
            h->tally[SHOWER_DIED]++;
        }
}

static bool bear_particles(struct shower_heap *h, const shower_params *p)
{
    int births = p->wanted - (int)h->tally[SHOWER_ALIVE];
    for (int i = 0; i < h->slots && births > 0; i++) {
        if (h->at[i])
            continue;
        if (!(h->at[i] = rg_alloc(1, sizeof(**h->at), "particle")))
            return false;
        *h->at[i] = shower_born(*p, i);
        h->tally[SHOWER_ALIVE]++;
        h->tally[SHOWER_BORN]++;
        births--;
    }
    return true;
}

// Writes the particles in the device's layout.
static void list_words(struct shower_heap *h)
{
    const shower_particle none = {0};
    for (int i = 0; i < h->slots; i++) {
        const shower_particle *q = h->at[i] ? h->at[i] : &none;
        const float words[] = {
            q->at.x, q->at.y,           q->at.z,           q->fall_m_s,       q->vx,
            q->vz,   q->acceleration.x, q->acceleration.y, q->acceleration.z, q->age};
        for (int k = 0; k < h->planes; k++)
            h->words[(size_t)k * (size_t)h->slots + (size_t)i] = words[k];
    }
}

bool shower_heap_step(struct shower *s)
{
    struct shower_heap *h = s->heap;
    const int64_t bytes = (int64_t)h->slots * 4;
    end_particles(h, &s->params, shower_is_new(&s->settings, s->settings.crop));
    if (!bear_particles(h, &s->params))
        return false;
    list_words(h);
    return rg_buf_write(s->particles->buf, 0, h->words, SHOWER_WORDS * bytes) &&
           (!s->params.is_full ||
            rg_buf_write(s->attributes->buf, 0, h->words + SHOWER_WORDS * (int64_t)h->slots,
                         SHOWER_ATTRIBUTES * bytes)) &&
           rg_buf_write(s->counts->buf, 0, h->tally, sizeof(h->tally));
}
