#include "harness/commands/drawing/atlas/compare.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/stats.h"
#include "harness/record/named.h"

static const double GOOD = 0.9;
enum { WORST_PRINTED = 8, LEAST_PAIRS = 3 };

static const char *const way_names[RG_CAVE_WAYS] = {"as_it_is", "mirrored", "other_side",
                                                    "other_drop"};
static const char *const way_words[RG_CAVE_WAYS] = {
    "as they are", "mirrored", "light on the other side", "drop swings to the other side"};

// --- figures ---

static bool is_of(const struct rg_cave_row *row, int which)
{
    const struct rg_cave_found *f = &row->found;
    if (which == RG_CAVE_ENV)
        return f->env;
    return !f->env && (which == RG_CAVE_LIGHTS || f->view == which);
}

struct rg_cave_figures rg_cave_figures(const struct rg_cave_comparison *comparison, int which,
                                       enum rg_cave_way way)
{
    struct rg_cave_figures figures = {0};
    double *values = rg_alloc((size_t)comparison->count, sizeof(*values), "streak database");
    int above = 0;
    for (int i = 0; values && i < comparison->count; i++) {
        const struct rg_cave_row *row = &comparison->rows[i];
        if (row->flat || !is_of(row, which))
            continue;
        const double value = row->correlation[way];
        if (!figures.pictures || value < figures.worst) {
            figures.worst = value;
            figures.worst_row = row;
        }
        above += value > GOOD;
        values[figures.pictures++] = value;
    }
    if (figures.pictures) {
        figures.median = rg_median(values, figures.pictures).median;
        figures.above = above / (double)figures.pictures;
    }
    free(values);
    return figures;
}

enum rg_cave_way rg_cave_best(const struct rg_cave_comparison *comparison)
{
    enum rg_cave_way best = RG_CAVE_AS_IT_IS;
    const int which =
        rg_cave_figures(comparison, RG_CAVE_LIGHTS, best).pictures ? RG_CAVE_LIGHTS : RG_CAVE_ENV;
    for (int way = 1; way < RG_CAVE_WAYS; way++)
        if (rg_cave_figures(comparison, which, (enum rg_cave_way)way).median >
            rg_cave_figures(comparison, which, best).median)
            best = (enum rg_cave_way)way;
    return best;
}

double rg_cave_brightness(const struct rg_cave_comparison *comparison, int *pictures)
{
    double sum[5] = {0}; // of x, y, xx, yy, xy
    int n = 0;
    for (int i = 0; i < comparison->count; i++) {
        const struct rg_cave_row *row = &comparison->rows[i];
        if (row->found.env || !(row->ours > 0 && row->theirs > 0))
            continue;
        const double x = log(row->ours), y = log(row->theirs);
        const double parts[5] = {x, y, x * x, y * y, x * y};
        for (int k = 0; k < 5; k++)
            sum[k] += parts[k];
        n++;
    }
    *pictures = n;
    if (n < LEAST_PAIRS)
        return NAN;
    const double xx = sum[2] - sum[0] * sum[0] / n, yy = sum[3] - sum[1] * sum[1] / n;
    return xx > 0 && yy > 0 ? (sum[4] - sum[0] * sum[1] / n) / sqrt(xx * yy) : NAN;
}

static int flat_ones(const struct rg_cave_comparison *comparison)
{
    int flat = 0;
    for (int i = 0; i < comparison->count; i++)
        flat += comparison->rows[i].flat;
    return flat;
}

static const char *name_of(const struct rg_cave_row *row)
{
    const char *slash = strrchr(row->found.path, '/');
    return slash ? slash + 1 : row->found.path;
}

// --- text ---

static void print_figures(const char *what, const struct rg_cave_figures *f)
{
    if (f->pictures)
        printf("%-30s %8d  %7.3f  %8.1f %%  %7.3f  %s\n", what, f->pictures, f->median,
               100 * f->above, f->worst, name_of(f->worst_row));
}

static void print_heading(const char *what)
{
    printf("\n%-30s %8s  %7s  %10s  %7s\n", what, "pictures", "median", "above 0.9", "worst");
}

struct ranked {
    double correlation;
    const struct rg_cave_row *row;
};

static int by_correlation(const void *a, const void *b)
{
    const struct ranked *x = a, *y = b;
    return (x->correlation > y->correlation) - (x->correlation < y->correlation);
}

static void print_worst(const struct rg_cave_comparison *comparison, enum rg_cave_way way)
{
    struct ranked *ranks = rg_alloc((size_t)comparison->count, sizeof(*ranks), "streak database");
    int count = 0;
    for (int i = 0; ranks && i < comparison->count; i++)
        if (!comparison->rows[i].flat)
            ranks[count++] =
                (struct ranked){comparison->rows[i].correlation[way], &comparison->rows[i]};
    if (!count) {
        free(ranks);
        return;
    }
    qsort(ranks, (size_t)count, sizeof(*ranks), by_correlation);
    printf("\nleast alike:");
    for (int i = 0; i < count && i < WORST_PRINTED; i++)
        printf("%s %s %.3f", i ? "," : "", name_of(ranks[i].row), ranks[i].correlation);
    printf("\n");
    free(ranks);
}

static void print_text(const struct rg_cave_comparison *comparison, const char *folder)
{
    const enum rg_cave_way best = rg_cave_best(comparison);
    const int flat = flat_ones(comparison);
    int pairs = 0;
    const double brightness = rg_cave_brightness(comparison, &pairs);
    printf("%d pictures of %s beside ours, correlation of all pixels\n", comparison->count, folder);
    print_heading("single lights");
    for (int way = 0; way < RG_CAVE_WAYS; way++) {
        const struct rg_cave_figures f =
            rg_cave_figures(comparison, RG_CAVE_LIGHTS, (enum rg_cave_way)way);
        print_figures(way_words[way], &f);
    }
    print_heading(way_words[best]);
    for (int view = 0; view < RG_ATLAS_VIEWS; view++) {
        char what[32];
        const struct rg_cave_figures f = rg_cave_figures(comparison, view, best);
        snprintf(what, sizeof(what), "view at %d degrees", 20 * view);
        print_figures(what, &f);
    }
    const struct rg_cave_figures env = rg_cave_figures(comparison, RG_CAVE_ENV, best);
    print_figures("light from everywhere", &env);
    print_worst(comparison, best);
    if (pairs >= LEAST_PAIRS)
        printf("mean brightness: correlation of the logarithms %.3f, %d pictures\n", brightness,
               pairs);
    else
        printf(
            "mean brightness: not compared; the factors are in dcam00_point_max.txt and so on\n");
    if (flat)
        printf("%d pictures are even, theirs or ours, and have no correlation\n", flat);
}

// --- JSON ---

static json_t *figures_json(const char *key, const char *name, const struct rg_cave_figures *f)
{
    return json_pack("{sssisfsfsfso}", key, name, "pictures", f->pictures, "median", f->median,
                     "above_0_9", f->above, "worst", f->worst, "worst_picture",
                     f->worst_row ? rg_json_text(name_of(f->worst_row)) : json_null());
}

static json_t *row_json(const struct rg_cave_row *row)
{
    const struct rg_cave_found *f = &row->found;
    json_t *correlation = json_object();
    for (int way = 0; way < RG_CAVE_WAYS; way++)
        json_object_set_new(correlation, way_names[way],
                            row->flat ? json_null() : json_real(row->correlation[way]));
    json_t *json = json_pack("{sosisisiso}", "picture", rg_json_text(name_of(row)), "width",
                             f->width, "oscillation", f->oscillation, "view_deg", 20 * f->view,
                             "correlation", correlation);
    json_object_set_new(json, "light_deg", f->env ? json_null() : json_integer(20 * f->light - 90));
    json_object_set_new(json, "phi_deg", f->env ? json_null() : json_integer(20 * f->phi + 10));
    json_object_set_new(json, "ours", row->theirs > 0 ? json_real(row->ours) : json_null());
    json_object_set_new(json, "theirs", row->theirs > 0 ? json_real(row->theirs) : json_null());
    return json;
}

static json_t *sets_json(const struct rg_cave_comparison *comparison, enum rg_cave_way best)
{
    json_t *sets = json_array();
    for (int view = 0; view < RG_ATLAS_VIEWS; view++) {
        char name[32];
        const struct rg_cave_figures f = rg_cave_figures(comparison, view, best);
        snprintf(name, sizeof(name), "view %d", 20 * view);
        if (f.pictures)
            json_array_append_new(sets, figures_json("set", name, &f));
    }
    const struct rg_cave_figures env = rg_cave_figures(comparison, RG_CAVE_ENV, best);
    if (env.pictures)
        json_array_append_new(sets, figures_json("set", "everywhere", &env));
    return sets;
}

static void print_json(const struct rg_cave_comparison *comparison, const struct rg_atlas *atlas,
                       const char *folder)
{
    const enum rg_cave_way best = rg_cave_best(comparison);
    char hash[32];
    int pairs = 0;
    const double brightness = rg_cave_brightness(comparison, &pairs);
    json_t *ways = json_array(), *pictures = json_array();
    for (int way = 0; way < RG_CAVE_WAYS; way++) {
        const struct rg_cave_figures f =
            rg_cave_figures(comparison, RG_CAVE_LIGHTS, (enum rg_cave_way)way);
        json_array_append_new(ways, figures_json("way", way_names[way], &f));
    }
    for (int i = 0; i < comparison->count; i++)
        json_array_append_new(pictures, row_json(&comparison->rows[i]));
    snprintf(hash, sizeof(hash), "%016llx", (unsigned long long)atlas->hash);
    json_t *json = json_pack(
        "{sisosssosssosisoso}", "format", 1, "folder", rg_json_text(folder), "hash", hash, "ways",
        ways, "best", way_names[best], "sets", sets_json(comparison, best), "flat",
        flat_ones(comparison), "brightness",
        isnan(brightness) ? json_null()
                          : json_pack("{sisf}", "pictures", pairs, "correlation", brightness),
        "pictures", pictures);
    json_dumpf(json, stdout, JSON_INDENT(1) | JSON_REAL_PRECISION(9));
    printf("\n");
    json_decref(json);
}

void rg_cave_print(const struct rg_cave_comparison *comparison, const struct rg_atlas *atlas,
                   const char *folder, bool json)
{
    if (json)
        print_json(comparison, atlas, folder);
    else
        print_text(comparison, folder);
}
