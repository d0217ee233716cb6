#include "core/scene/city/buildings/lots.h"

enum { CHANCE_CUT = 200 };

#define WIDEST_M    27.0
#define NARROWEST_M 13.0

struct cutting {
    const struct city_builder *b;
    struct city_lot *lots;
    int count;
    uint32_t block;
};

static void cut(struct cutting *c, struct city_lot lot, uint32_t way)
{
    const double wide = lot.x1 - lot.x0, deep = lot.z1 - lot.z0;
    const bool across = wide >= deep;
    const double side = across ? wide : deep;
    const uint32_t which = c->block * 256 + way;
    const bool small_enough = side < WIDEST_M || (side < 2 * WIDEST_M - 10 &&
                                                  city_chance(c->b, CHANCE_CUT, which, 1) < 0.2);
    if (small_enough || side < 2 * NARROWEST_M || c->count + 2 > CITY_MOST_LOTS || way > 60) {
        lot.id = which;
        c->lots[c->count++] = lot;
        return;
    }
    const double share = 0.38 + 0.24 * city_chance(c->b, CHANCE_CUT, which, 0);
    struct city_lot first = lot, second = lot;
    if (across) {
        first.x1 = second.x0 = lot.x0 + wide * share;
        first.street &= ~BOX_X1;
        second.street &= ~BOX_X0;
    } else {
        first.z1 = second.z0 = lot.z0 + deep * share;
        first.street &= ~BOX_Z1;
        second.street &= ~BOX_Z0;
    }
    cut(c, first, 2 * way);
    cut(c, second, 2 * way + 1);
}

int city_lots(const struct city_builder *b, const struct city_block *block,
              struct city_lot lots[CITY_MOST_LOTS])
{
    struct cutting c = {b, lots, 0, (uint32_t)block->index};
    cut(&c, (struct city_lot){block->x0, block->z0, block->x1, block->z1, BOX_WALLS, 0}, 1);
    return c.count;
}
