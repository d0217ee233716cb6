#include "tests/oracle/flow/box.h"

#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double product[3])
{
    for (int i = 0; i < 3; i++)
        product[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

// Turns `v` about the unit axis `k`, right-handed (Rodrigues).
static void turn(double v[3], const double k[3], double degrees)
{
    const double radians = degrees * 3.14159265358979323846 / 180;
    const double c = cos(radians), s = sin(radians), along = dot(k, v) * (1 - c);
    double beside[3];
    cross(k, v, beside);
    for (int i = 0; i < 3; i++)
        v[i] = v[i] * c + beside[i] * s + k[i] * along;
}

void box_oracle_turn(struct box_oracle *box, double pitch_deg, double yaw_deg, double roll_deg)
{
    static const double right[3] = {1, 0, 0}, up[3] = {0, 1, 0}, out[3] = {0, 0, 1};
    // The box before it turns: each pane's normal, and the way up for a viewer before it. On the
    // top that points away from the front, on the bottom towards it, as on a sheet that folds
    // around.
    static const double normals[BOX_PANES][3] = {{0, 0, 1},  {0, 0, -1}, {1, 0, 0},
                                                 {-1, 0, 0}, {0, 1, 0},  {0, -1, 0}};
    static const double ups[BOX_PANES][3] = {{0, 1, 0}, {0, 1, 0},  {0, 1, 0},
                                             {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
    for (int pane = 0; pane < BOX_PANES; pane++) {
        double(*frame)[3] = box->frames[pane];
        cross(ups[pane], normals[pane], frame[0]);
        for (int i = 0; i < 3; i++)
            frame[1][i] = -ups[pane][i];
        memcpy(frame[2], normals[pane], sizeof(frame[2]));
        for (int i = 0; i < 3; i++) {
            turn(frame[i], out, -roll_deg);
            turn(frame[i], right, -pitch_deg);
            turn(frame[i], up, yaw_deg);
        }
    }
}

void box_oracle_centre(const struct box_oracle *box, int size, struct box_texel texel,
                       double point[3])
{
    const double(*f)[3] = box->frames[texel.pane];
    const double u = 2 * (texel.x + 0.5) / size - 1, v = 2 * (texel.y + 0.5) / size - 1;
    for (int i = 0; i < 3; i++)
        point[i] = f[2][i] + u * f[0][i] + v * f[1][i];
}

// The pane whose outside this normal points to.
static int pane_towards(const struct box_oracle *box, const double normal[3])
{
    for (int pane = 0; pane < BOX_PANES; pane++)
        if (dot(box->frames[pane][2], normal) > 0.5)
            return pane;
    return -1;
}

static int texel_of(double along, int size)
{
    return (int)floor((along + 1) / 2 * size);
}

bool box_oracle_walk(const struct box_oracle *box, int size, struct box_texel from, int dx, int dy,
                     struct box_texel *to)
{
    const double(*f)[3] = box->frames[from.pane];
    const double last = 1 - 1.0 / size;
    double u = 2 * (from.x + dx + 0.5) / size - 1, v = 2 * (from.y + dy + 0.5) / size - 1;
    *to = (struct box_texel){from.pane, from.x + dx, from.y + dy};
    if (fabs(u) < 1 && fabs(v) < 1)
        return true;
    // Beyond an edge the way goes down the other side.
    double out[3], point[3];
    const int across = fabs(v) > 1 ? 1 : 0, beside = 1 - across;
    const double way = across ? v : u, past = fabs(way) - 1;
    const double along = fmin(fmax(across ? u : v, -last), last);
    for (int i = 0; i < 3; i++) {
        out[i] = way < 0 ? -f[across][i] : f[across][i];
        point[i] = out[i] + f[2][i] * (1 - past) + f[beside][i] * along;
    }
    to->pane = pane_towards(box, out);
    to->x = texel_of(dot(point, box->frames[to->pane][0]), size);
    to->y = texel_of(dot(point, box->frames[to->pane][1]), size);
    return out[1] > -0.5;
}
