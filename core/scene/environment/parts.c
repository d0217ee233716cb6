#include "core/scene/environment/parts.h"

// The street runs off a little to the left of straight ahead, -z: by 11 of 61.
#define TURN_SIN (11.0 / 61)
#define TURN_COS (60.0 / 61)

const double street_lamp[3] = {1, .62, .27};

void street_turn(const double from[3], double to[3])
{
    to[0] = TURN_COS * from[0] - TURN_SIN * from[2];
    to[1] = from[1];
    to[2] = -TURN_SIN * from[0] - TURN_COS * from[2];
}

// --- chance and patterns ---

double street_chance(int a, int b, int c)
{
    uint32_t h = (uint32_t)a * 0x9e3779b1u ^ (uint32_t)b * 0x85ebca77u ^ (uint32_t)c * 0xc2b2ae3du;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return (double)(h ^ h >> 15) / 4294967296.0;
}

double street_noise(double x, double y, int seed)
{
    const int i = street_floor(x), j = street_floor(y);
    const double u = street_smooth(x - i), v = street_smooth(y - j);
    const double a = street_chance(i, j, seed), b = street_chance(i + 1, j, seed);
    const double c = street_chance(i, j + 1, seed), d = street_chance(i + 1, j + 1, seed);
    return a + (b - a) * u + (c - a) * v + (a - b - c + d) * u * v;
}

double street_clouds(double x, double y, int seed)
{
    return (street_noise(x, y, seed) * 4 + street_noise(2.3 * x, 2.3 * y, seed + 1) * 2 +
            street_noise(5.1 * x, 5.1 * y, seed + 2)) /
           7;
}

double street_stripes(double x, double share, double width)
{
    const double from = x - width / 2, to = x + width / 2;
    const int first = street_floor(from), last = street_floor(to);
    const double begin = from - first, end = to - last;
    const double covered =
        (last - first) * share + (end < share ? end : share) - (begin < share ? begin : share);
    return covered / width;
}

double street_lamplight(const struct street_look *look, double x_m, double y_m, double z_m)
{
    double light = 0;
    if (look->lamps <= 0)
        return 0;
    for (int side = 0; side < 2; side++) {
        const double at = z_m / LAMP_GAP_M + (side ? .5 : 0);
        const int first = street_floor(at - .5);
        for (int lamp = first; lamp <= first + 1; lamp++) {
            const double x = x_m - (side ? LAMP_X_M : -LAMP_X_M), y = y_m - LAMP_Y_M;
            const double z = z_m - (lamp - (side ? .5 : 0) + .5) * LAMP_GAP_M;
            const double way2 = x * x + y * y + z * z + .8;
            light += 14 / (way2 * (1 + way2 * .012));
        }
    }
    return look->lamps * light;
}
