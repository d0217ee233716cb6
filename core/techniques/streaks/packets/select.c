#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/array.h"
#include "core/base/log.h"
#include "core/techniques/streaks/packets/inner.h"

void streaks_selection_release(struct streaks_selection *selection)
{
    free(selection->selected);
    free(selection->draws);
    free(selection->blocks);
    free(selection->runs);
    free(selection->masks);
    free(selection->seen);
    memset(selection, 0, sizeof(*selection));
}

static bool add_place(struct streaks_selection *s, int place, int64_t particles)
{
    if (!rg_array_fit(&s->selected, &s->room[STREAKS_SELECTED], s->packets + 1,
                      sizeof(*s->selected), "rain: selected packets"))
        return false;
    s->selected[s->packets++] = place;
    s->particles += particles;
    return true;
}

// --- selecting packets ---

static double metres(uint32_t lattice, double half_m)
{
    return ((double)lattice / (1 << (STREAKS_LATTICE_BITS - 1)) - 1) * half_m;
}

static bool descend(const struct streaks_packets *p, const struct streaks_area *area, int32_t index,
                    struct streaks_selection *s)
{
    const struct streaks_node *node = &p->nodes[index];
    if (p->info.scheme != STREAKS_WORLD &&
        !streaks_area_meets(area, metres(node->left, p->half_x_m), metres(node->top, p->half_y_m),
                            metres(node->right, p->half_x_m), metres(node->bottom, p->half_y_m)))
        return true;
    if (node->packet >= 0)
        return add_place(s, node->packet, p->packets[node->packet].count);
    return node->second < 0 ||
           (descend(p, area, index + 1, s) && descend(p, area, node->second, s));
}

// The cells that an interval of metres meets, including borders, clamped to 0 and count - 1.
static void cells_along(double low, double high, double half_m, int count, int *first, int *last)
{
    const double scale = count / (2 * half_m);
    const double from = ceil((low + half_m) * scale) - 1, to = floor((high + half_m) * scale);
    *first = from > 0 ? (int)fmin(from, count) : 0;
    *last = to < count - 1 ? (int)fmax(to, -1) : count - 1;
}

static bool select_cells(const struct streaks_packets *p, const struct streaks_area *area,
                         struct streaks_selection *s)
{
    int left, right, top, bottom;
    cells_along(area->left, area->right, p->half_x_m, p->grid.across, &left, &right);
    cells_along(area->top, area->bottom, p->half_y_m, p->grid.down, &top, &bottom);
    for (int row = top; row <= bottom; row++)
        for (int column = left; column <= right; column++) {
            const int cell = row * p->grid.across + column;
            const int level = p->grid.levels[cell];
            double r[4];
            streaks_packets_rectangle(p, cell, r);
            if (level == 0 || !streaks_area_meets(area, r[0], r[1], r[2], r[3]))
                continue;
            if (!add_place(s, cell, p->grid.buckets[level].count))
                return false;
        }
    return true;
}

void streaks_packets_rectangle(const struct streaks_packets *p, int place, double rectangle_m[4])
{
    if (p->info.scheme == STREAKS_GRID) {
        const double wide = 2 * p->half_x_m / p->grid.across, high = 2 * p->half_y_m / p->grid.down;
        const int column = place % p->grid.across, row = place / p->grid.across;
        const double r[4] = {column * wide - p->half_x_m, row * high - p->half_y_m,
                             (column + 1) * wide - p->half_x_m, (row + 1) * high - p->half_y_m};
        memcpy(rectangle_m, r, sizeof(r));
        return;
    }
    const struct streaks_node *node = &p->nodes[p->packets[place].node];
    rectangle_m[0] = metres(node->left, p->half_x_m);
    rectangle_m[1] = metres(node->top, p->half_y_m);
    rectangle_m[2] = metres(node->right, p->half_x_m);
    rectangle_m[3] = metres(node->bottom, p->half_y_m);
}

int64_t streaks_packets_count(const struct streaks_packets *p, int place)
{
    return p->info.scheme == STREAKS_GRID ? p->grid.buckets[p->grid.levels[place]].count
                                          : p->packets[place].count;
}

static bool good_view(const struct streaks_view *view)
{
    bool good = view->radius_m >= 0 && isfinite(view->top_m) && isfinite(view->run) &&
                view->across_m >= 0 && view->above_m >= 0 && view->below_m >= 0;
    for (int axis = 0; axis < 3; axis++) {
        good = good && isfinite(view->eye[axis]);
        for (int corner = 0; corner < 8; corner++)
            good = good && isfinite(view->corners[corner][axis]);
    }
    return good || rg_error("rain: the view or its margins are no numbers, or negative; check the "
                            "camera and the culling radius (%g m)",
                            view->radius_m);
}

bool streaks_select(const struct streaks_packets *packets, const struct streaks_view *view,
                    struct streaks_selection *selection)
{
    selection->particles = selection->block_count = 0;
    selection->packets = selection->draw_count = 0;
    if (!good_view(view))
        return false;
    struct streaks_area area;
    streaks_area_of(view, packets->half_x_m, packets->half_y_m, packets->settings.local_height_m,
                    &area);
    const bool grid = packets->info.scheme == STREAKS_GRID;
    if (grid ? !select_cells(packets, &area, selection) : !descend(packets, &area, 0, selection))
        return false;
    return streaks_by_id(packets) ? streaks_list_by_id(packets, view, selection)
                                  : streaks_list_by_packet(packets, view, selection);
}
