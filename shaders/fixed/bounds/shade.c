// Values of the fragments of shaders/fixed/draw.frag, by the intervals of their attributes.
#include "shaders/fixed/bounds/scene.h"

static void corners_of(const struct rg_fragment *f, bool is_colour, int c, double values[3])
{
    for (int i = 0; i < 3; i++) {
        const struct rg_corner *corner = &f->primitive->corners[i];
        values[i] = is_colour ? corner->colour[c] : corner->at[c];
    }
}

// An attribute in perspective.
static struct rg_span value(const struct rg_fragment *f, bool is_colour, int c)
{
    double values[3];
    if (!f->plane) // of a point
        return rg_span_at(is_colour ? f->primitive->corners[0].colour[c]
                                    : f->primitive->corners[0].at[c]);
    corners_of(f, is_colour, c, values);
    return rg_plane_value(&f->place, values, f->is_inside);
}

static struct rg_span affine(const struct rg_fragment *f, int c)
{
    double values[3];
    corners_of(f, true, c, values);
    for (int i = 0; i < 3; i++)
        values[i] *= f->primitive->corners[i].place[3];
    return rg_plane_affine(&f->place, values);
}

static struct rg_span step(const struct rg_fragment *f, int c, bool in_y)
{
    double values[3];
    corners_of(f, false, c, values);
    return rg_plane_step(f->plane, values, f->x, f->y, in_y);
}

// --- levels of detail (OpenGL, Scale Factor and Level of Detail; Vulkan, Scale Factor Operation,
// LOD) ---

// From the absolute steps of both coordinates in x and in y. The scale is at least the greatest
// step. It is at most the sum of both coordinates' greatest steps in OpenGL, and in Vulkan the
// square root of two times the sum of both steps in one direction.
static struct rg_span lod_of(const struct rg_scene *scene, const struct rg_span u[2],
                             const struct rg_span v[2])
{
    const double least = rg_span_most(rg_span_most(u[0], u[1]), rg_span_most(v[0], v[1])).low;
    const double sum = fmax(u[0].high, u[1].high) + fmax(v[0].high, v[1].high);
    const double along = fmax(u[0].high + v[0].high, u[1].high + v[1].high);
    const double most = scene->precision->is_opengl ? sum : fmax(sum, sqrt(2) * along);
    return (struct rg_span){log2(fmax(least * RG_FIXED_TEXTURE_PX, 1e-9)),
                            log2(fmax(most * RG_FIXED_TEXTURE_PX, 1e-9))};
}

static void steps_of(const struct rg_fragment *f, int c, struct rg_span steps[2])
{
    for (int in_y = 0; in_y < 2; in_y++)
        steps[in_y] = rg_span_absolute(step(f, c, in_y));
}

static void look(const struct rg_scene *scene, const struct rg_fragment *f, struct rg_span out[4])
{
    const struct rg_span u = value(f, false, 0), v = value(f, false, 1);
    struct rg_span of_u[2], of_v[2];
    if (scene->state->mip == RG_FIXED_MIP_OFF) {
        rg_texture_look(scene, u, v, 0, 0, out);
        return;
    }
    steps_of(f, 0, of_u);
    steps_of(f, 1, of_v);
    rg_texture_look_lod(scene, u, v, lod_of(scene, of_u, of_v), out);
}

static void look_gradient(const struct rg_scene *scene, const struct rg_fragment *f,
                          struct rg_span out[4])
{
    const struct rg_span u = value(f, false, 0), v = value(f, false, 1);
    const double by = scene->state->value / 256.0;
    // The shader's gradients: u in x alone, v in y alone.
    const struct rg_span of_u[2] = {rg_span_absolute(rg_span_scale(u, by))};
    const struct rg_span of_v[2] = {{0, 0}, rg_span_absolute(rg_span_scale(v, by))};
    rg_texture_look_lod(scene, u, v, lod_of(scene, of_u, of_v), out);
}

// A layer is the nearest whole number.
static void look_layer(const struct rg_scene *scene, const struct rg_fragment *f,
                       struct rg_span out[4])
{
    const struct rg_span u = value(f, false, 0), v = value(f, false, 1);
    const struct rg_span layer =
        rg_span_clamp(rg_span_add(value(f, false, 2), rg_span_at(scene->state->value / 256.0)), 0,
                      scene->texture.layers - 1);
    const int first = (int)ceil(layer.low - 0.5), last = (int)floor(layer.high + 0.5);
    for (int i = first; i <= last; i++) {
        struct rg_span one[4];
        rg_texture_look(scene, u, v, i, 0, one);
        for (int c = 0; c < 4; c++)
            out[c] = i == first ? one[c] : rg_span_join(out[c], one[c]);
    }
}

static void look_cube(const struct rg_scene *scene, const struct rg_fragment *f,
                      struct rg_span out[4])
{
    const struct rg_span direction[] = {
        rg_span_add(value(f, false, 0), rg_span_at(-0.625)),
        rg_span_less(rg_span_at(1.25), value(f, false, 1)),
        rg_span_add(rg_span_scale(value(f, false, 2), 0.5), rg_span_at(-1))};
    bool is_first = true;
    for (int face = 0; face < RG_SCENE_FACES; face++) {
        struct rg_span u, v, one[4];
        if (!rg_cube_place(direction, face, &u, &v))
            continue;
        rg_texture_look(scene, u, v, face, 0, one);
        for (int c = 0; c < 4; c++)
            out[c] = is_first ? one[c] : rg_span_join(out[c], one[c]);
        is_first = false;
    }
}

static void look_shadow(const struct rg_scene *scene, const struct rg_fragment *f,
                        struct rg_span out[4])
{
    const struct rg_span u = value(f, false, 0), v = value(f, false, 1);
    out[0] = rg_texture_compare(scene, u, v, rg_span_scale(value(f, false, 2), 0.25));
    out[1] = rg_texture_compare(scene, v, u, rg_span_at(0.5));
    out[2] = rg_span_at(0);
    out[3] = rg_span_at(1);
}

static void gather(const struct rg_scene *scene, const struct rg_fragment *f, struct rg_span out[4])
{
    const struct rg_span u = value(f, false, 0), v = value(f, false, 1);
    struct rg_span other[4];
    rg_texture_gather(scene, u, v, 1, out);
    rg_texture_gather(scene, v, u, 3, other);
    for (int c = 0; c < 4; c++)
        out[c] = rg_span_add(rg_span_less(out[c], rg_span_scale(other[c], 0.5)), rg_span_at(0.25));
}

// An attribute at any pixel of the quad.
static struct rg_span in_quad(struct rg_span at, struct rg_span dx, struct rg_span dy)
{
    return rg_span_widen(at, rg_span_absolute(dx).high + rg_span_absolute(dy).high);
}

static void derive(const struct rg_fragment *f, struct rg_span out[4])
{
    const struct rg_span du[] = {step(f, 0, false), step(f, 0, true)};
    const struct rg_span dv[] = {step(f, 1, false), step(f, 1, true)};
    const struct rg_span u = in_quad(value(f, false, 0), du[0], du[1]);
    const struct rg_span v = in_quad(value(f, false, 1), dv[0], dv[1]);
    struct rg_span width = rg_span_at(0);
    for (int i = 0; i < 2; i++) // u1 v1 - u0 v0 is (u1 - u0) v0 + u1 (v1 - v0)
        width = rg_span_add(
            width, rg_span_absolute(rg_span_add(rg_span_times(du[i], v), rg_span_times(dv[i], u))));
    out[0] = du[0];
    out[1] = dv[0];
    out[2] = rg_span_add(du[1], width);
    out[3] = rg_span_add(dv[1], width);
}

// --- other values ---

static void colour(const struct rg_fragment *f, struct rg_span out[4])
{
    for (int c = 0; c < 4; c++)
        out[c] = value(f, true, c);
}

static void flat(const struct rg_fragment *f, struct rg_span out[4])
{
    for (int c = 0; c < 4; c++)
        out[c] = rg_span_at(f->primitive->corners[f->primitive->provoking].colour[c]);
}

static void order(const struct rg_span in[4], const char places[5], struct rg_span out[4])
{
    for (int c = 0; c < 4; c++)
        out[c] = in[places[c] - '0'];
}

static void to_targets(struct rg_fragment *f)
{
    static const char *const orders[] = {"0123", "1203", "2013", "3012", "0321"};
    struct rg_span all[4];
    colour(f, all);
    for (int i = 0; i < RG_FIXED_EQUATIONS; i++)
        order(all, orders[i], f->colours[i]);
}

static void store(struct rg_fragment *f)
{
    static const double factors[RG_FIXED_STORES] = {1, 3, 1, 5};
    colour(f, f->colours[0]);
    for (int i = 0; i < RG_FIXED_STORES; i++)
        for (int c = 0; c < 4; c++)
            f->stored[i][c] = rg_span_scale(f->colours[0][c], factors[i]);
}

static void set_depth(const struct rg_scene *scene, struct rg_fragment *f)
{
    const double rounding = ldexp(1, -23);
    colour(f, f->colours[0]);
    f->depth = rg_span_add(rg_span_scale(f->depth, 0.5), rg_span_scale(f->colours[0][0], 0.25));
    f->depth = rg_span_widen(f->depth, rounding);
    f->depth = rg_span_add(f->depth, rg_span_at(scene->state->value / 4096.0));
}

// Fragments with fract(8 x) < 0.5 are discarded.
static void discard(struct rg_fragment *f)
{
    colour(f, f->colours[0]);
    const struct rg_span eights = rg_span_scale(f->colours[0][0], 16);
    const double low = floor(eights.low), high = floor(eights.high);
    f->stays = low < high ? RG_COVER_MAYBE : fmod(low, 2) != 0 ? RG_COVER_YES : RG_COVER_NO;
}

void rg_fragment_shade(const struct rg_scene *scene, struct rg_fragment *f)
{
    struct rg_span *out = f->colours[0];
    f->stays = RG_COVER_YES;
    switch (scene->state->fragment) {
    case RG_FIXED_FRAGMENT_AFFINE:
        for (int c = 0; c < 4; c++)
            out[c] = affine(f, c);
        return;
    case RG_FIXED_FRAGMENT_FLAT:
        flat(f, out);
        return;
    case RG_FIXED_FRAGMENT_DERIVATIVES:
        derive(f, out);
        return;
    case RG_FIXED_FRAGMENT_TEXTURE:
        look(scene, f, out);
        return;
    case RG_FIXED_FRAGMENT_LAYERED:
        look_layer(scene, f, out);
        return;
    case RG_FIXED_FRAGMENT_CUBE:
        look_cube(scene, f, out);
        return;
    case RG_FIXED_FRAGMENT_SHADOW:
        look_shadow(scene, f, out);
        return;
    case RG_FIXED_FRAGMENT_GATHER:
        gather(scene, f, out);
        return;
    case RG_FIXED_FRAGMENT_GRAD:
        look_gradient(scene, f, out);
        return;
    case RG_FIXED_FRAGMENT_DEPTH:
        set_depth(scene, f);
        return;
    case RG_FIXED_FRAGMENT_DISCARD:
    case RG_FIXED_FRAGMENT_EARLY:
        discard(f);
        return;
    case RG_FIXED_FRAGMENT_TARGETS:
        to_targets(f);
        return;
    case RG_FIXED_FRAGMENT_DUAL:
        colour(f, out);
        order(out, "1230", f->second);
        return;
    case RG_FIXED_FRAGMENT_STORE:
        store(f);
        return;
    default:
        colour(f, out);
    }
}
