// The materials that all dioramas share.
#include <assert.h>
#include <string.h>

#include "core/scene/diorama/build.h"

static const struct diorama_material colours[PAINTS] = {
    [PAINT_CLAY] = {0.86f, 0.52f, 0.36f, 0.5f},      [PAINT_LAWN] = {0.62f, 0.76f, 0.46f, 0},
    [PAINT_MEADOW] = {0.52f, 0.69f, 0.40f, 0},       [PAINT_LEAF] = {0.46f, 0.68f, 0.36f, 0},
    [PAINT_DARK_LEAF] = {0.28f, 0.53f, 0.38f, 0},    [PAINT_BLOSSOM] = {0.95f, 0.70f, 0.74f, 0},
    [PAINT_BARK] = {0.52f, 0.38f, 0.30f, 0},         [PAINT_WOOD] = {0.66f, 0.44f, 0.28f, 0.1f},
    [PAINT_PALE_WOOD] = {0.85f, 0.68f, 0.46f, 0.1f}, [PAINT_STONE] = {0.64f, 0.64f, 0.66f, 0},
    [PAINT_PALE_STONE] = {0.82f, 0.80f, 0.76f, 0},   [PAINT_DARK_STONE] = {0.46f, 0.47f, 0.52f, 0},
    [PAINT_SAND] = {0.90f, 0.82f, 0.64f, 0},         [PAINT_ROAD] = {0.56f, 0.59f, 0.66f, 0.1f},
    [PAINT_WATER] = {0.50f, 0.74f, 0.88f, 1},        [PAINT_PLASTER] = {0.97f, 0.90f, 0.76f, 0},
    [PAINT_CREAM] = {0.98f, 0.95f, 0.87f, 0.3f},     [PAINT_WHITE] = {0.97f, 0.97f, 0.96f, 0.6f},
    [PAINT_TILE] = {0.86f, 0.44f, 0.32f, 0},         [PAINT_BRICK] = {0.76f, 0.43f, 0.35f, 0},
    [PAINT_GLASS] = {0.66f, 0.85f, 0.92f, 1},        [PAINT_RED] = {0.90f, 0.27f, 0.24f, 0.9f},
    [PAINT_ORANGE] = {0.96f, 0.58f, 0.26f, 0.5f},    [PAINT_YELLOW] = {0.98f, 0.82f, 0.34f, 0.4f},
    [PAINT_BLUE] = {0.33f, 0.52f, 0.80f, 0.6f},      [PAINT_TEAL] = {0.32f, 0.68f, 0.68f, 0.6f},
    [PAINT_PINK] = {0.94f, 0.56f, 0.66f, 0.3f},      [PAINT_BLACK] = {0.24f, 0.24f, 0.28f, 0.4f},
    [PAINT_CHROME] = {0.80f, 0.84f, 0.88f, 1},       [PAINT_IRON] = {0.30f, 0.36f, 0.38f, 0.4f},
    [PAINT_LIGHT] = {1.00f, 0.94f, 0.66f, 0.8f},     [PAINT_COFFEE] = {0.42f, 0.27f, 0.20f, 0.6f},
};

void diorama_paint(struct diorama *diorama)
{
    static_assert((int)PAINTS <= (int)DIORAMA_MATERIALS, "the paint box has no room");
    diorama->material_count = PAINTS;
    memcpy(diorama->palette, colours, sizeof(colours));
}
