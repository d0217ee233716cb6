// Fits the constants of drops that swing as the database's, one direction of light left out at a
// time: fit FOLDER. The constants that a fit finds draw the pictures of the direction that it has
// not seen. FOLDER has pictures of the original database, seen from the front. Without a folder the
// program tries the arithmetic on pictures that it draws itself, with constants that it knows.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/scene/atlas/cave/find.h"
#include "core/scene/atlas/cave/picture.h"
#include "core/scene/atlas/streak.h"
#include "tests/tools/expect.h"

enum { OSCILLATIONS = RG_ATLAS_OSCILLATIONS, PIXELS = 16 * 525, STEPS = 5, KEPT = 2000 };

// --- the grid ---

enum { LAMP_DEG, POSES, A20_OF_2_TO_5, A20_OF_1_AND_6_TO_9, A31, BLIND, AXES };

// Around the constants of the atlas: 7.5 degrees, 45 poses, 0.1, 0.2, 0.1 and 0.6 radii.
static const double steps[AXES][STEPS] = {
    [LAMP_DEG] = {6, 6.75, 7.5, 8.25, 9},
    [POSES] = {15, 30, 45, 60, 75},
    [A20_OF_2_TO_5] = {0.05, 0.075, 0.1, 0.125, 0.15},
    [A20_OF_1_AND_6_TO_9] = {0.15, 0.175, 0.2, 0.225, 0.25},
    [A31] = {0.05, 0.075, 0.1, 0.125, 0.15},
    [BLIND] = {0, 0.3, 0.6, 0.9, 1.2},
};

// A step on each axis.
struct point {
    int at[AXES];
};

static int a20_of(int oscillation)
{
    return oscillation > 1 && oscillation < 6 ? A20_OF_2_TO_5 : A20_OF_1_AND_6_TO_9;
}

// The point without what does not matter to an oscillation.
static struct point mattering(struct point point, int oscillation)
{
    for (int axis = A20_OF_2_TO_5; axis <= A20_OF_1_AND_6_TO_9; axis++)
        if (oscillation == 0 || axis != a20_of(oscillation))
            point.at[axis] = 0;
    if (oscillation < 2)
        point.at[A31] = 0;
    return point;
}

// --- streaks of any constants ---

static struct point tried;

static double value_of(int axis)
{
    return steps[axis][tried.at[axis]];
}

// Stands in for the atlas's own shapes (docs/atlas.md, "The drop").
struct rg_drop_shape rg_drop_shape(enum rg_swings swings, int oscillation, double time_s)
{
    static const double phi_deg[4] = {270, 0, 90, 180};
    const double r3 = pow(1.6e-3, 3), w2 = sqrt(8 * 0.0728 / (1000 * r3));
    const double phi =
        oscillation < 2 ? 0 : phi_deg[(oscillation - 2) % 4] * 3.14159265358979323846 / 180;
    const double a20 = oscillation ? value_of(a20_of(oscillation)) : 0;
    const double a31 = oscillation > 1 ? value_of(A31) : 0;
    (void)swings;
    return (struct rg_drop_shape){.a = (float)(a20 * sin(w2 * time_s)),
                                  .b = (float)(a31 * sin(2 * w2 * time_s)),
                                  .mx = (float)sin(phi),
                                  .mz = (float)cos(phi),
                                  .blind = (float)value_of(BLIND)};
}

// --- pictures ---

struct picture {
    int oscillation, cell; // of the light
    double theirs;         // mean light
    float texels[PIXELS];
};

static struct picture *pictures;
static int picture_count, level, width, height;
static bool mirrored;
static struct rg_streak_detail detail = {RG_SWINGS_DATABASE, 0, .column = 6, .along = 64};

static double correlate(const float *ours, const float *theirs, double *mean)
{
    double sums[5] = {0};
    for (int i = 0; i < width * height; i++) {
        const int column = i % width, from = mirrored ? i - column + width - 1 - column : i;
        const double a = (double)ours[from], b = (double)theirs[i];
        const double parts[5] = {a, b, a * a, b * b, a * b};
        for (int k = 0; k < 5; k++)
            sums[k] += parts[k] / (width * height);
    }
    *mean = sums[0];
    return (sums[4] - sums[0] * sums[1]) /
           sqrt((sums[2] - sums[0] * sums[0]) * (sums[3] - sums[1] * sums[1]));
}

// What an oscillation's pictures are like at a point.
struct looks {
    int oscillation;
    struct point point;
    double correlation[RG_ATLAS_CELLS], ours[RG_ATLAS_CELLS]; // by the light's cell
};

static struct looks kept[KEPT];
static int kept_count;

static struct looks look(int oscillation, struct point point, const struct rg_lobes *lobes)
{
    struct looks looks = {oscillation, point, {0}, {0}};
    struct rg_streak_detail of_point = detail;
    struct rg_streaks streaks;
    of_point.moments = (int)value_of(POSES);
    assert_true(rg_streaks_trace(oscillation, 0, level, &of_point, lobes, &streaks));
    const double balance = (double)rg_streaks_balance(&streaks);
    for (int i = 0; i < picture_count; i++) {
        const int cell = pictures[i].cell;
        const int lobe = rg_lobe_of_cell(cell / RG_ATLAS_PHIS, cell % RG_ATLAS_PHIS);
        if (pictures[i].oscillation != oscillation)
            continue;
        looks.correlation[cell] = correlate(streaks.point + (size_t)lobe * width * height,
                                            pictures[i].texels, &looks.ours[cell]);
        looks.ours[cell] *= balance;
    }
    rg_streaks_free(&streaks);
    return looks;
}

static bool has_oscillation(int oscillation)
{
    for (int i = 0; i < picture_count; i++)
        if (pictures[i].oscillation == oscillation)
            return true;
    return false;
}

static const struct looks *find(int oscillation, struct point point)
{
    for (int i = 0; i < kept_count; i++)
        if (kept[i].oscillation == oscillation && !memcmp(&kept[i].point, &point, sizeof(point)))
            return &kept[i];
    return NULL;
}

// Traces what is not kept yet of a point.
static void see(struct point point)
{
    static struct rg_lobes lobes;
    float directions[RG_LOBE_COUNT][3];
    tried = point;
    rg_lobes_of_atlas(&lobes);
    memcpy(directions, lobes.direction, sizeof(directions));
    rg_lobes_fill(&lobes, RG_LOBE_COUNT, directions, value_of(LAMP_DEG));
#pragma omp parallel for schedule(dynamic)
    for (int k = 0; k < OSCILLATIONS; k++) {
        const struct point of = mattering(point, k);
        if (!has_oscillation(k) || find(k, of))
            continue;
        const struct looks looks = look(k, of, &lobes);
#pragma omp critical
        {
            assert_true(kept_count < KEPT);
            kept[kept_count++] = looks;
        }
    }
}

// --- fits ---

// The mean correlation of all pictures but those of one light.
static double likeness(struct point point, int without)
{
    double sum = 0;
    int count = 0;
    see(point);
    for (int i = 0; i < picture_count; i++) {
        const int oscillation = pictures[i].oscillation;
        if (pictures[i].cell == without)
            continue;
        sum += find(oscillation, mattering(point, oscillation))->correlation[pictures[i].cell];
        count++;
    }
    return sum / count;
}

// Climbs along one axis after the other, from a corner of the grid, until none leads higher.
static struct point fit(int without)
{
    struct point best = {{0}};
    double most = likeness(best, without);
    for (bool climbs = true; climbs;) {
        climbs = false;
        for (int axis = 0; axis < AXES; axis++)
            for (int step = 0; step < STEPS; step++) {
                struct point next = best;
                next.at[axis] = step;
                const double like = likeness(next, without);
                if (like <= most)
                    continue;
                best = next;
                most = like;
                climbs = true;
            }
    }
    return best;
}

// Correlations of pictures that no fit saw, and their light.
struct held_out {
    int count;
    double correlation[10 * RG_ATLAS_CELLS], ours[10 * RG_ATLAS_CELLS], theirs[10 * RG_ATLAS_CELLS];
};

static void judge(struct point point, int light, struct held_out *out)
{
    see(point);
    for (int i = 0; i < picture_count; i++) {
        const int oscillation = pictures[i].oscillation;
        if (pictures[i].cell != light)
            continue;
        const struct looks *looks = find(oscillation, mattering(point, oscillation));
        out->correlation[out->count] = looks->correlation[light];
        out->ours[out->count] = looks->ours[light];
        out->theirs[out->count++] = pictures[i].theirs;
    }
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

struct figures {
    double median, above, worst; // of the correlations; above: the share above 0.9
    double brightness, slope;    // of the logarithms: correlation, and theirs over ours
};

static struct figures figures_of(struct held_out *out)
{
    struct figures figures = {0};
    double s[5] = {0};
    const int n = out->count;
    for (int i = 0; i < n; i++) {
        const double x = log(out->ours[i]), y = log(out->theirs[i]);
        const double parts[5] = {x, y, x * x, y * y, x * y};
        for (int k = 0; k < 5; k++)
            s[k] += parts[k] / n;
        figures.above += out->correlation[i] > 0.9;
    }
    const double xx = s[2] - s[0] * s[0], yy = s[3] - s[1] * s[1], xy = s[4] - s[0] * s[1];
    figures.above /= n;
    figures.brightness = xy / sqrt(xx * yy);
    figures.slope = xy / xx;
    qsort(out->correlation, (size_t)n, sizeof(double), by_size);
    figures.median = 0.5 * (out->correlation[(n - 1) / 2] + out->correlation[n / 2]);
    figures.worst = out->correlation[0];
    return figures;
}

static bool has_light(int cell)
{
    for (int i = 0; i < picture_count; i++)
        if (pictures[i].cell == cell)
            return true;
    return false;
}

// Leaves out each light in turn. `points` gets the fits by the light's cell.
static void leave_out(struct point points[RG_ATLAS_CELLS])
{
    for (int cell = 0; cell < RG_ATLAS_CELLS; cell++)
        if (has_light(cell))
            points[cell] = fit(cell);
}

// Judges the pictures of each light by the fit that has not seen them.
static struct figures judge_all(const struct point points[RG_ATLAS_CELLS])
{
    static struct held_out out;
    out.count = 0;
    for (int cell = 0; cell < RG_ATLAS_CELLS; cell++)
        if (has_light(cell))
            judge(points[cell], cell, &out);
    return figures_of(&out);
}

// --- pictures of our own ---

enum { DRAWN_LIGHTS = 3 };
static const struct point known = {{3, 2, 3, 3, 3, 2}};

static double mean_of(const float *texels)
{
    double sum = 0;
    for (int i = 0; i < width * height; i++)
        sum += (double)texels[i] / (width * height);
    return sum;
}

// In codes of 8 bits, the brightest of which is the largest.
static void put_codes(const float *from, float *texels)
{
    float largest = 0;
    for (int i = 0; i < width * height; i++)
        largest = fmaxf(largest, from[i]);
    for (int i = 0; i < width * height; i++)
        texels[i] = (float)(round(255 * (double)from[i] / (double)largest) / 255);
}

// Draws pictures of three oscillations under three lights, at these constants, in codes of 8 bits.
static void draw(struct point point, int first_light, int lights)
{
    static const int oscillations[3] = {1, 5, 7}, cells[DRAWN_LIGHTS] = {47, 70, 79};
    struct rg_lobes *lobes = malloc(sizeof(*lobes));
    float directions[RG_LOBE_COUNT][3];
    tried = point;
    rg_lobes_of_atlas(lobes);
    memcpy(directions, lobes->direction, sizeof(directions));
    rg_lobes_fill(lobes, RG_LOBE_COUNT, directions, value_of(LAMP_DEG));
    for (int k = 0; k < 3; k++) {
        struct rg_streaks s;
        struct rg_streak_detail of_point = detail;
        of_point.moments = (int)value_of(POSES);
        assert_true(rg_streaks_trace(oscillations[k], 0, level, &of_point, lobes, &s));
        for (int l = first_light; l < first_light + lights; l++) {
            struct picture *picture = &pictures[3 * l + k];
            const float *from =
                s.point + (size_t)rg_lobe_of_cell(cells[l] / 9, cells[l] % 9) * width * height;
            *picture = (struct picture){.oscillation = oscillations[k], .cell = cells[l]};
            put_codes(from, picture->texels);
            picture->theirs = 7 * pow(mean_of(from) * (double)rg_streaks_balance(&s), 0.9);
        }
        rg_streaks_free(&s);
    }
    free(lobes);
}

static void begin(void)
{
    level = 3;
    width = RG_ATLAS_CELL_PX >> level;
    height = rg_atlas_row_height(0, level);
    detail.column = 4;
    detail.along = 16;
    picture_count = 3 * DRAWN_LIGHTS;
    kept_count = 0;
    draw(known, 0, DRAWN_LIGHTS);
}

// Every fit finds the constants with which the pictures were drawn, and thus what it has not seen.
static void test_finds_what_was_drawn(void **state)
{
    (void)state;
    struct point points[RG_ATLAS_CELLS];
    begin();
    leave_out(points);
    const struct figures is = judge_all(points);
    for (int i = 0; i < picture_count; i++) {
        const int *at = points[pictures[i].cell].at;
        if (memcmp(at, known.at, sizeof(known)))
            fail_msg("without light %d: %d %d %d %d %d %d", pictures[i].cell, at[0], at[1], at[2],
                     at[3], at[4], at[5]);
    }
    print_message("median %.5f, worst %.5f, brightness %.5f, slope %.4f\n", is.median, is.worst,
                  is.brightness, is.slope);
    assert_above(is.worst, 0.999);
    assert_equals(is.above, 1);
    assert_above(is.brightness, 0.9999);
    assert_below(fabs(is.slope - 0.9), 1e-3);
}

// A fit that leaves out a light does not see its pictures: here they were drawn with other
// constants, and judged by those that the other lights have they are like nothing.
static void test_leaves_a_light_out(void **state)
{
    (void)state;
    static struct held_out out;
    begin();
    const int light = pictures[0].cell;
    const double good = likeness(known, light);
    draw((struct point){{0, 0, 0, 4, 0, 0}}, 0, 1);
    kept_count = 0;
    const struct point found = fit(light);
    assert_memory_equal(&found, &known, sizeof(known));
    assert_equals(likeness(known, light), good);
    assert_below(likeness(known, -1), good - 0.01);
    judge(found, light, &out);
    assert_int_equal(out.count, 3);
    assert_below(figures_of(&out).worst, 0.97);
}

// --- the database's ---

static bool load(const char *folder)
{
    struct rg_cave_files files;
    struct rg_cave_why why;
    static struct rg_cave_factors factors;
    if (!rg_cave_find(folder, &files, &why) ||
        !rg_cave_point_factors(files.point_factors[0], 0, &factors, &why))
        return fprintf(stderr, "%s\n", why.text) < 0;
    for (int i = 0; i < files.count; i++) {
        const struct rg_cave_found *f = &files.items[i];
        struct picture *picture = &pictures[picture_count];
        level = 1;
        if (f->env || f->view)
            continue;
        if (!rg_cave_read_any(f->path, 0, &level, picture->texels, &why) || level != 1)
            return fprintf(stderr, "%s: not 16 pixels wide\n", f->path) < 0;
        width = RG_ATLAS_CELL_PX >> level;
        height = rg_atlas_row_height(0, level);
        picture->oscillation = f->oscillation;
        picture->cell = f->light * RG_ATLAS_PHIS + f->phi;
        picture->theirs =
            mean_of(picture->texels) * (double)factors.factor[f->light][f->phi][f->oscillation];
        picture_count++;
    }
    return picture_count > 0;
}

static int fit_database(const char *folder)
{
    const struct point shipped = {{2, 2, 2, 2, 2, 2}};
    struct point points[RG_ATLAS_CELLS];
    if (!load(folder))
        return 1;
    const double as_it_is = likeness(shipped, -1);
    mirrored = true;
    kept_count = 0;
    mirrored = likeness(shipped, -1) > as_it_is;
    kept_count = 0;
    printf("%d pictures%s, mean correlation at the atlas's constants %.4f\n", picture_count,
           mirrored ? ", mirrored" : "", likeness(shipped, -1));
    leave_out(points);
    printf("left out   lamp poses a20 2-5 a20 1,6-9    a31  blind\n");
    for (int cell = 0; cell < RG_ATLAS_CELLS; cell++) {
        if (!has_light(cell))
            continue;
        tried = points[cell];
        printf("%3d, %3d  %5.2f %5.0f %7.3f %9.3f %6.3f %6.2f\n", 20 * (cell / 9) - 90,
               20 * (cell % 9) + 10, value_of(LAMP_DEG), value_of(POSES), value_of(A20_OF_2_TO_5),
               value_of(A20_OF_1_AND_6_TO_9), value_of(A31), value_of(BLIND));
    }
    detail.column = 12; // as fine as the atlas
    detail.along = 256;
    kept_count = 0;
    const struct figures is = judge_all(points);
    printf("left out: median %.3f, %.1f %% above 0.9, worst %.3f, brightness %.3f, slope %.3f\n",
           is.median, 100 * is.above, is.worst, is.brightness, is.slope);
    return 0;
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_finds_what_was_drawn),
                                       cmocka_unit_test(test_leaves_a_light_out)};
    pictures = calloc((size_t)OSCILLATIONS * RG_ATLAS_CELLS, sizeof(*pictures));
    const int failed = !pictures  ? 1
                       : argc > 1 ? fit_database(argv[1])
                                  : cmocka_run_group_tests(tests, NULL, NULL);
    free(pictures);
    return failed;
}
