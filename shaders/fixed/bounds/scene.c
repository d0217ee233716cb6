// Draws a state's primitives into samples.
#include "shaders/fixed/bounds/scene.h"

#include <stdlib.h>

#include "core/base/alloc.h"

enum { PX = RG_FIXED_PX };

struct rg_sample *rg_scene_sample(const struct rg_scene *scene, int layer, int x, int y, int sample)
{
    return &scene->samples[((layer * PX + y) * PX + x) * scene->sample_count + sample];
}

// --- pixels that a primitive may reach ---

struct box {
    int from[2], to[2]; // in x and y, without `to`
};

// With a pixel more on each side, whatever place in the pixel is meant.
static struct box box_of(const struct rg_span reach[2])
{
    struct box box;
    for (int c = 0; c < 2; c++) {
        box.from[c] = (int)rg_span_clamp(rg_span_at(reach[c].low - 1), 0, PX).low;
        box.to[c] = (int)rg_span_clamp(rg_span_at(ceil(reach[c].high) + 1), 0, PX).high;
    }
    return box;
}

static struct box within_scissor(const struct rg_scene *scene, int layer, struct box box)
{
    int scissor[4];
    rg_fixed_scissor(scene->state, layer, scissor);
    for (int c = 0; c < 2 && scene->state->scissor; c++) {
        const int from = scissor[c], to = scissor[c] + scissor[2 + c];
        box.from[c] = box.from[c] < from ? from : box.from[c];
        box.to[c] = box.to[c] > to ? to : box.to[c];
    }
    return box;
}

// --- a fragment ---

static void count(struct rg_span *counter, enum rg_cover cover)
{
    counter->low += cover == RG_COVER_YES;
    counter->high += cover != RG_COVER_NO;
}

// Stores reach their images before tests, which these draws lack.
static void store(struct rg_scene *scene, const struct rg_fragment *f, enum rg_cover cover)
{
    struct rg_span(*stored)[4] = scene->stores[(int)f->y * PX + (int)f->x];
    for (int i = 0; i < RG_FIXED_STORES; i++)
        for (int c = 0; c < 4; c++)
            stored[i][c] = cover == RG_COVER_YES ? f->stored[i][c]
                                                 : rg_span_join(stored[i][c], f->stored[i][c]);
}

// Alpha between 0 and 1 takes any samples (OpenGL, Alpha To Coverage; Vulkan, Multisample
// Coverage).
static enum rg_cover with_alpha(const struct rg_scene *scene, const struct rg_fragment *f,
                                enum rg_cover cover)
{
    const struct rg_span alpha = f->colours[0][3];
    if (!scene->state->alpha_to_coverage || alpha.low >= 1 || cover == RG_COVER_NO)
        return cover;
    return alpha.high <= 0 ? RG_COVER_NO : RG_COVER_MAYBE;
}

static void merge(struct rg_scene *scene, const struct rg_fragment *f, int facing,
                  const enum rg_cover *covers)
{
    const int x = (int)f->x, y = (int)f->y;
    for (int i = 0; i < scene->sample_count; i++) {
        if (covers[i] == RG_COVER_NO || scene->state->samples_off >> i & 1)
            continue;
        const enum rg_cover passes =
            rg_sample_merge(scene, f, facing, with_alpha(scene, f, covers[i]),
                            rg_scene_sample(scene, f->primitive->layer, x, y, i));
        count(&scene->visible, passes);
        if (scene->state->counts)
            count(&scene->counts[x],
                  scene->state->fragment == RG_FIXED_FRAGMENT_EARLY ? passes : covers[i]);
    }
    if (scene->state->stores)
        store(scene, f, covers[0]);
}

// --- triangles ---

struct triangle {
    const struct rg_primitive *primitive;
    struct rg_outline outline;
    struct rg_plane plane;
    struct rg_span offset;
    double depths[3];
    struct rg_fragment fragment; // of the pixel that is drawn
};

// With samples, attributes are those of any place in the pixel (OpenGL Shading Language,
// Interpolation Qualifiers), and with centroid of one in the primitive too.
static void place_fragment(const struct rg_scene *scene, struct triangle *t, int x, int y)
{
    struct rg_fragment *f = &t->fragment;
    f->x = x + 0.5;
    f->y = y + 0.5;
    rg_plane_at(&t->plane, f->x, f->y, scene->state->samples ? 0.5 : 0, &f->place);
    f->is_inside = !scene->state->samples || scene->state->fragment == RG_FIXED_FRAGMENT_CENTROID;
    if (scene->state->depth_test) // else nothing reads it
        f->depth =
            rg_span_clamp(rg_span_add(rg_plane_affine(&f->place, t->depths), t->offset), 0, 1);
}

static void draw_pixel(struct rg_scene *scene, struct triangle *t, int x, int y)
{
    enum rg_cover covers[RG_FIXED_SAMPLES], most = RG_COVER_NO;
    for (int i = 0; i < scene->sample_count; i++) {
        covers[i] = rg_outline_cover(&t->outline, x + scene->places[i][0], y + scene->places[i][1]);
        most = covers[i] > most ? covers[i] : most;
    }
    if (most == RG_COVER_NO)
        return;
    place_fragment(scene, t, x, y);
    rg_fragment_shade(scene, &t->fragment);
    merge(scene, &t->fragment, t->outline.facing, covers);
}

static bool is_culled(const struct rg_scene *scene, int facing)
{
    return (scene->state->cull == RG_FIXED_CULL_BACK && facing < 0) ||
           (scene->state->cull == RG_FIXED_CULL_FRONT && facing > 0);
}

static void draw_triangle(struct rg_scene *scene, const struct rg_primitive *primitive)
{
    struct triangle t = {.primitive = primitive};
    t.fragment.primitive = primitive;
    t.fragment.plane = &t.plane;
    if (!rg_outline_of(scene, primitive, &t.outline) || is_culled(scene, t.outline.facing) ||
        !rg_plane_of(scene, primitive, t.outline.slack, &t.plane))
        return;
    for (int i = 0; i < 3; i++)
        t.depths[i] = primitive->corners[i].place[2];
    if (scene->state->offset_units || scene->state->offset_slope_16)
        t.offset = rg_plane_offset(scene, primitive, t.outline.slack);
    const struct box box = within_scissor(scene, primitive->layer, box_of(t.outline.box));
    for (int y = box.from[1]; y < box.to[1]; y++)
        for (int x = box.from[0]; x < box.to[0]; x++)
            draw_pixel(scene, &t, x, y);
}

// --- points and lines ---

static void project(const struct rg_corner *corner, double place[2])
{
    for (int c = 0; c < 2; c++)
        place[c] = (corner->place[c] / corner->place[3] + 1) * PX / 2;
}

// A square around the place (OpenGL, Basic Point Rasterization; Vulkan, Basic Point Rasterization).
static void draw_point(struct rg_scene *scene, const struct rg_primitive *primitive)
{
    const double half = scene->state->value / 2.0;
    double place[2];
    project(&primitive->corners[0], place);
    const double reach = half + scene->grid;
    const struct box box = box_of((struct rg_span[]){rg_span_widen(rg_span_at(place[0]), reach),
                                                     rg_span_widen(rg_span_at(place[1]), reach)});
    for (int y = box.from[1]; y < box.to[1]; y++)
        for (int x = box.from[0]; x < box.to[0]; x++) {
            struct rg_fragment f = {.x = x + 0.5, .y = y + 0.5, .primitive = primitive};
            const double away = fmax(fabs(f.x - place[0]), fabs(f.y - place[1]));
            enum rg_cover covers[RG_FIXED_SAMPLES];
            for (int i = 0; i < RG_FIXED_SAMPLES; i++)
                covers[i] = away < half - scene->grid    ? RG_COVER_YES
                            : away <= half + scene->grid ? RG_COVER_MAYBE
                                                         : RG_COVER_NO;
            rg_fragment_shade(scene, &f);
            merge(scene, &f, 1, covers);
        }
}

// Whether a segment comes within `reach` of a place in x and in y.
static bool is_near(const double a[2], const double b[2], const double place[2], double reach)
{
    double first = 0, last = 1;
    for (int c = 0; c < 2; c++) {
        const double step = b[c] - a[c], low = place[c] - reach - a[c], high = low + 2 * reach;
        if (fabs(step) < 1e-9 && (low > 0 || high < 0))
            return false;
        if (fabs(step) >= 1e-9) {
            first = fmax(first, fmin(low / step, high / step));
            last = fmin(last, fmax(low / step, high / step));
        }
    }
    return first <= last;
}

// The place along a line is that of the pixel's centre (OpenGL, Basic Line Segment Rasterization;
// Vulkan, Basic Line Segment Rasterization), or one pixel beside it.
static void colour_line(const struct rg_corner corners[2], const double a[2], const double b[2],
                        struct rg_fragment *f)
{
    const double dx = b[0] - a[0], dy = b[1] - a[1], length = fmax(hypot(dx, dy), 1e-6);
    const double t = ((f->x - a[0]) * dx + (f->y - a[1]) * dy) / (length * length);
    for (int c = 0; c < 4; c++) {
        struct rg_span all = {INFINITY, -INFINITY};
        for (int end = -1; end <= 1; end += 2) {
            const double at = t + end / length;
            const double over_a = (1 - at) / corners[0].place[3], over_b = at / corners[1].place[3];
            all =
                rg_span_reach(all, (over_a * corners[0].colour[c] + over_b * corners[1].colour[c]) /
                                       (over_a + over_b));
        }
        f->colours[0][c] = rg_span_widen(all, 1e-6);
    }
    f->stays = RG_COVER_YES;
}

// A fragment lies at most one pixel beside one whose diamond the segment meets. Which do is left to
// the device.
static void draw_line(struct rg_scene *scene, const struct rg_primitive *primitive)
{
    static const enum rg_cover covers[RG_FIXED_SAMPLES] = {RG_COVER_MAYBE, RG_COVER_MAYBE,
                                                           RG_COVER_MAYBE, RG_COVER_MAYBE};
    double ends[2][2];
    for (int i = 0; i < 2; i++)
        project(&primitive->corners[i], ends[i]);
    const double reach = 1.5 + scene->grid;
    struct rg_span all[2];
    for (int c = 0; c < 2; c++)
        all[c] = rg_span_widen(rg_span_reach(rg_span_at(ends[0][c]), ends[1][c]), reach);
    const struct box box = box_of(all);
    for (int y = box.from[1]; y < box.to[1]; y++)
        for (int x = box.from[0]; x < box.to[0]; x++) {
            struct rg_fragment f = {.x = x + 0.5, .y = y + 0.5, .primitive = primitive};
            if (!is_near(ends[0], ends[1], (double[]){f.x, f.y}, reach))
                continue;
            colour_line(primitive->corners, ends[0], ends[1], &f);
            merge(scene, &f, 1, covers);
        }
}

// --- primitives ---

// Which corner a strip's turned triangles begin with is left to the device.
static void take_corner(struct rg_scene *scene, const struct rg_primitive *primitive, int i,
                        struct rg_span out[8])
{
    const bool is_turned = scene->primitive_count % 2;
    for (int k = 0; k < 3; k++) {
        const struct rg_corner *corner = &primitive->corners[(i + k) % 3];
        for (int c = 0; c < 4 && (!k || is_turned); c++) {
            out[c] = k ? rg_span_reach(out[c], corner->at[c]) : rg_span_at(corner->at[c]);
            out[4 + c] =
                k ? rg_span_reach(out[4 + c], corner->colour[c]) : rg_span_at(corner->colour[c]);
        }
    }
}

static void take(struct rg_scene *scene, const struct rg_primitive *primitive)
{
    for (int i = 0; i < 3; i++)
        take_corner(scene, primitive, i, scene->caught[(ptrdiff_t)scene->primitive_count * 3 + i]);
}

static void draw(struct rg_scene *scene, const struct rg_primitive *primitive)
{
    bool has_inside = false;
    for (int i = 0; i < primitive->count; i++) {
        const double *p = primitive->corners[i].place;
        has_inside =
            has_inside || (fabs(p[0]) <= p[3] && fabs(p[1]) <= p[3] && p[2] >= 0 && p[2] <= p[3]);
    }
    if (scene->state->feedback)
        take(scene, primitive);
    scene->primitive_count++;
    scene->inside_count += has_inside;
    if (primitive->count == 3)
        draw_triangle(scene, primitive);
    else if (primitive->count == 2)
        draw_line(scene, primitive);
    else
        draw_point(scene, primitive);
}

// --- all ---

static void prepare(struct rg_scene *scene)
{
    const struct rg_fixed_state *state = scene->state;
    scene->grid = rg_precision_step(scene->precision->subpixel_bits);
    scene->sample_count = state->samples ? RG_FIXED_SAMPLES : 1;
    scene->layer_count = state->layers ? state->layers : 1;
    for (int i = 0; i < RG_FIXED_SAMPLES; i++)
        for (int c = 0; c < 2; c++)
            scene->places[i][c] = state->samples ? scene->precision->places[i][c] : 0.5;
}

// What a draw does not use is not there, since it would have to be zeroed.
static bool make_room(struct rg_scene *scene)
{
    const struct rg_fixed_state *state = scene->state;
    const int count = scene->layer_count * PX * PX * scene->sample_count;
    scene->samples = rg_alloc((size_t)count, sizeof(*scene->samples), "bounds");
    if (state->stores)
        scene->stores = rg_alloc(PX * PX, sizeof(*scene->stores), "bounds");
    if (state->texels)
        scene->texture.texels =
            rg_alloc((size_t)rg_fixed_layers(state), sizeof(*scene->texture.texels), "bounds");
    return scene->samples && (!state->stores || scene->stores) &&
           (!state->texels || scene->texture.texels);
}

static void clear(struct rg_scene *scene)
{
    const int format = scene->state->format;
    const int count = scene->layer_count * PX * PX * scene->sample_count;
    struct rg_sample before = {.depth = {1, 1}, .stencil = {1}};
    for (int i = 0; i < RG_FIXED_EQUATIONS; i++)
        for (int c = 0; c < 4; c++)
            before.colours[i][c] = rg_round_colour(format, rg_span_at(rg_fixed_before[c]));
    for (int i = 0; i < count; i++)
        scene->samples[i] = before;
}

struct rg_scene *rg_scene_draw(const struct rg_fixed_state *state,
                               const struct rg_fixed_precision *precision)
{
    struct rg_scene *scene = rg_alloc(1, sizeof(*scene), "bounds");
    if (!scene)
        return NULL;
    scene->state = state;
    scene->precision = precision;
    prepare(scene);
    if (!make_room(scene)) {
        rg_scene_free(scene);
        return NULL;
    }
    clear(scene);
    rg_fixed_make_vertices(state, &scene->vertices);
    rg_scene_texture(scene);
    rg_scene_assemble(scene, draw);
    return scene;
}

void rg_scene_free(struct rg_scene *scene)
{
    if (scene) {
        free(scene->samples);
        free(scene->stores);
        free(scene->texture.texels);
    }
    free(scene);
}
