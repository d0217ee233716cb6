// The quad-tree over the top plane.
#include "core/base/array.h"
#include "core/base/log.h"
#include "core/techniques/streaks/packets/inner.h"

static int32_t add_node(struct streaks_packets *p, struct streaks_node node)
{
    if (p->node_count == INT32_MAX) {
        rg_error("rain: a tree of more than %d nodes; use larger packets", INT32_MAX);
        return -1;
    }
    if (!rg_array_fit(&p->nodes, &p->node_room, p->node_count + 1, sizeof(*p->nodes),
                      "rain: nodes of a tree"))
        return -1;
    p->nodes[p->node_count] = node;
    return (int32_t)p->node_count++;
}

static bool add_packet(struct streaks_packets *p, int64_t first, int64_t count, int32_t node)
{
    if (!rg_array_fit(&p->packets, &p->packet_room, p->info.packets + 1, sizeof(*p->packets),
                      "rain: packets"))
        return false;
    p->nodes[node].packet = (int32_t)p->info.packets;
    p->packets[p->info.packets++] =
        (struct streaks_packet){.first = first, .count = (int32_t)count, .node = node};
    return true;
}

// --- building the tree ---
//
// Ids follow a Morton curve, so that a node's particles follow each other. Each quartering is two
// halvings, first across y, then across x; the branches between these have no packets.

struct quad {
    struct streaks_node node;
    int depth;
    int64_t first, count;
};

// The first of a node's particles at or beyond `border`.
static int64_t first_beyond(const struct streaks_packets *p, const struct quad *quad, int axis,
                            uint32_t border)
{
    int64_t low = quad->first, high = quad->first + quad->count;
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (streaks_lattice(p, middle, axis) < border)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static bool build_quad(struct streaks_packets *p, struct quad quad);

static bool build_halves(struct streaks_packets *p, const struct quad *quad, int32_t node)
{
    const int axis = quad->depth % 2 ? 0 : 1;
    struct quad low = *quad, high = *quad;
    low.depth = high.depth = quad->depth + 1;
    uint32_t border;
    if (axis == 0)
        border = low.node.right = high.node.left =
            quad->node.left + (quad->node.right - quad->node.left) / 2;
    else
        border = low.node.bottom = high.node.top =
            quad->node.top + (quad->node.bottom - quad->node.top) / 2;
    high.first = first_beyond(p, quad, axis, border);
    low.count = high.first - quad->first;
    high.count = quad->count - low.count;
    if (!build_quad(p, low))
        return false;
    p->nodes[node].second = (int32_t)p->node_count;
    return build_quad(p, high);
}

// Splits the particles of one lattice point, if they exceed a packet, by their ids.
static bool build_heap(struct streaks_packets *p, const struct quad *quad)
{
    struct quad low = *quad, high = *quad;
    const int32_t node = add_node(p, quad->node);
    if (node < 0)
        return false;
    if (quad->count <= p->settings.packet_size)
        return add_packet(p, quad->first, quad->count, node);
    low.count = p->settings.packet_size;
    high.first += low.count;
    high.count -= low.count;
    if (!build_heap(p, &low))
        return false;
    p->nodes[node].second = (int32_t)p->node_count;
    return build_heap(p, &high);
}

static bool build_quad(struct streaks_packets *p, struct quad quad)
{
    quad.node.second = quad.node.packet = -1;
    if (quad.depth == STREAKS_DEEPEST && quad.count > p->settings.packet_size)
        return build_heap(p, &quad);
    const int32_t node = add_node(p, quad.node);
    if (node < 0 || quad.count == 0)
        return node >= 0;
    if (quad.depth % 2 == 0 && quad.count <= p->settings.packet_size)
        return add_packet(p, quad.first, quad.count, node);
    return build_halves(p, &quad, node);
}

bool streaks_quad_build(struct streaks_packets *packets, int64_t count)
{
    return build_quad(packets, (struct quad){.node = streaks_everywhere, .count = count});
}
