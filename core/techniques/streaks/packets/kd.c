// The kd-tree over the top plane.
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/techniques/streaks/packets/inner.h"

enum { TASK = 1 << 15, MAX_BINS = 4096 };

// Each node passes the ids of its particles to its two children, in order.

struct kd {
    struct streaks_packets *packets;
    uint32_t *ids[2]; // two arrays, used alternately
};

struct kd_part {
    struct streaks_node box;
    int64_t first, count;
    int32_t node, packet; // indices of this node and of its first leaf
    int array;            // the array that holds its ids
};

int64_t streaks_kd_leaves(int64_t count, int size)
{
    int depth = 0;
    while (count >> depth > size)
        depth++;
    // At this depth parts hold `least` particles, and `more` of them one more; a part with one too
    // many is halved once more.
    const int64_t least = count >> depth, more = count - (least << depth);
    return ((int64_t)1 << depth) + (least == size ? more : 0);
}

// A cut: the first `low_count` particles by (coordinate, id) are those below `at`, and the first
// `ties` of those at it.
struct cut {
    int axis;
    uint32_t at;
    int64_t ties;
};

// Finds the cut's coordinate by counting in ever finer bins.
static struct cut find_cut(const struct kd *kd, const struct kd_part *part, int axis,
                           int64_t low_count)
{
    const uint32_t *ids = kd->ids[part->array] + part->first;
    uint32_t low = axis ? part->box.top : part->box.left;
    uint32_t high = axis ? part->box.bottom : part->box.right;
    int64_t wanted = low_count;
    uint32_t bins = 16;
    while (bins < part->count && bins < MAX_BINS)
        bins *= 2;
    while (high - low > 1) {
        int shift = 0;
        while ((high - low - 1) >> shift >= bins)
            shift++;
        uint32_t counts[MAX_BINS];
        memset(counts, 0, bins * sizeof(*counts));
        for (int64_t i = 0; i < part->count; i++) {
            const uint32_t at = streaks_lattice(kd->packets, ids[i], axis) - low;
            if (at < high - low)
                counts[at >> shift]++;
        }
        uint32_t bin = 0;
        for (; wanted >= counts[bin]; bin++)
            wanted -= counts[bin];
        low += bin << shift;
        high = high - low > 1u << shift ? low + (1u << shift) : high;
    }
    return (struct cut){axis, low, wanted};
}

// Moves the ids of the lower part before those of the upper one; both keep their order. Returns the
// largest coordinate of the lower part and the least of the upper one.
static void hand_on(const struct kd *kd, const struct kd_part *part, struct cut cut,
                    int64_t low_count, uint32_t *lower_end, uint32_t *upper_begin)
{
    const uint32_t *from = kd->ids[part->array] + part->first;
    uint32_t *low = kd->ids[!part->array] + part->first, *high = low + low_count;
    uint32_t largest = 0, least = UINT32_MAX;
    for (int64_t i = 0; i < part->count; i++) {
        const uint32_t at = streaks_lattice(kd->packets, from[i], cut.axis);
        const bool lower = at < cut.at || (at == cut.at && cut.ties-- > 0);
        if (lower) {
            *low++ = from[i];
            largest = at > largest ? at : largest;
        } else {
            *high++ = from[i];
            least = at < least ? at : least;
        }
    }
    *lower_end = largest + 1;
    *upper_begin = least < largest + 1 ? least : largest + 1;
}

static int longer_axis(const struct streaks_packets *p, const struct streaks_node *box)
{
    return (box->bottom - box->top) * p->half_y_m > (box->right - box->left) * p->half_x_m;
}

static void build_kd(const struct kd *kd, struct kd_part part);

static void build_kd_halves(const struct kd *kd, const struct kd_part *part)
{
    struct streaks_packets *p = kd->packets;
    const int64_t low_count = part->count / 2;
    const int32_t low_leaves = (int32_t)streaks_kd_leaves(low_count, p->settings.packet_size);
    const int axis = longer_axis(p, &part->box);
    const struct cut cut = find_cut(kd, part, axis, low_count);
    struct kd_part low = *part, high = *part;
    hand_on(kd, part, cut, low_count, axis ? &low.box.bottom : &low.box.right,
            axis ? &high.box.top : &high.box.left);
    low.array = high.array = !part->array;
    low.count = low_count;
    low.node = part->node + 1;
    high.first += low_count;
    high.count -= low_count;
    high.node = part->node + 2 * low_leaves;
    high.packet = part->packet + low_leaves;
    p->nodes[part->node].second = high.node;
    if (part->count > TASK) {
#pragma omp task firstprivate(low)
        build_kd(kd, low);
    } else {
        build_kd(kd, low);
    }
    build_kd(kd, high);
}

static void build_kd(const struct kd *kd, struct kd_part part)
{
    struct streaks_packets *p = kd->packets;
    p->nodes[part.node] = part.box;
    if (part.count > p->settings.packet_size) {
        build_kd_halves(kd, &part);
        return;
    }
    if (part.array == 1)
        memcpy(kd->ids[0] + part.first, kd->ids[1] + part.first,
               (size_t)part.count * sizeof(uint32_t));
    p->nodes[part.node].packet = part.packet;
    p->packets[part.packet] = (struct streaks_packet){
        .first = part.first, .count = (int32_t)part.count, .node = part.node};
}

bool streaks_kd_build(struct streaks_packets *packets, int64_t count)
{
    struct kd kd = {packets, {NULL, NULL}};
    const int64_t leaves = streaks_kd_leaves(count, packets->settings.packet_size);
    static const char what[] = "rain: particles' numbers";
    const bool good =
        (kd.ids[0] = rg_alloc((size_t)count, sizeof(uint32_t), what)) &&
        (kd.ids[1] = rg_alloc((size_t)count, sizeof(uint32_t), what)) &&
        (packets->nodes =
             rg_alloc((size_t)(2 * leaves), sizeof(*packets->nodes), "rain: a tree")) &&
        (packets->packets = rg_alloc((size_t)leaves, sizeof(*packets->packets), "rain: packets"));
    if (good) {
        for (int64_t i = 0; i < count; i++)
            kd.ids[0][i] = (uint32_t)i;
        const struct kd_part whole = {.box = streaks_everywhere, .count = count};
#pragma omp parallel
#pragma omp single
        build_kd(&kd, whole);
        packets->node_count = 2 * leaves - 1;
        packets->info.packets = leaves;
    }
    packets->ids = kd.ids[0];
    free(kd.ids[1]);
    return good;
}
