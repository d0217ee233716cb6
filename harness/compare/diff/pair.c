#include "harness/compare/diff/pair.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/files/file.h"
#include "core/base/log.h"
#include "core/base/text/plain.h"
#include "core/image/compare/heatmap.h"
#include "core/image/files/io.h"
#include "harness/console/exit.h"

static const char *yes(const struct rg_verdict *verdict)
{
    return verdict->holds ? "holds" : "fails: ";
}

static void print_verdicts(const struct rg_tiers *t)
{
    printf("\n  T0 identical                 %s%s\n", yes(&t->of[RG_T0]), t->of[RG_T0].why);
    printf("  T1 arithmetic                %s%s\n", yes(&t->of[RG_T1]), t->of[RG_T1].why);
    printf("  T2 geometry                  %s%s\n", yes(&t->of[RG_T2]), t->of[RG_T2].why);
}

static void print_psnr(const struct rg_metrics *m)
{
    if (isnan(m->psnr_db))
        printf("  PSNR                         none, of values that are no numbers\n");
    else
        printf("  PSNR                         %.4g dB\n", m->psnr_db);
}

// The meaning of linear figures depends on the files: integers were decoded.
static void print_codes(const struct rg_metrics *m)
{
    printf("\ncodes, over the largest code\n");
    printf("  mean error, rms              %.6g, %.6g\n", m->mean, m->rms);
    print_psnr(m);
    printf("  largest error                %.6g\n", m->max);
}

static void print_metrics(const struct rg_metrics *m, bool decoded)
{
    printf("\nlinear light%s\n", decoded ? ", decoded from sRGB codes" : "");
    printf("  differing values             %lld of %lld, in %lld pixels\n",
           (long long)m->differing_values, (long long)m->values, (long long)m->differing_pixels);
    printf("  mean error, rms              %.6g, %.6g\n", m->mean, m->rms);
    print_psnr(m);
    printf("  largest error                %.6g", m->max);
    if (m->max > 0)
        printf(" at x %d, y %d, channel %d", m->max_x, m->max_y, m->max_channel);
    printf("\n  pixels above                 ");
    for (int t = 0; t < RG_ABOVE_COUNT; t++)
        printf("%s%g: %lld", t ? ", " : "", (double)rg_above_thresholds[t],
               (long long)m->pixels_above[t]);
    printf("\n");
    if (m->nonfinite_a || m->nonfinite_b)
        printf("  NaN or infinite              %lld in A, %lld in B, %lld do not agree\n",
               (long long)m->nonfinite_a, (long long)m->nonfinite_b,
               (long long)m->nonfinite_mismatches);
}

static void print_tiers(const struct rg_comparison *c)
{
    const struct rg_tiers *t = &c->tiers;
    printf("\nencoded: sRGB, 8 bits, exposure %g\n", (double)c->exposure);
    printf("  rain mask                    %lld pixels%s\n", (long long)t->mask_pixels,
           t->mask_is_whole ? " (no background given: the whole picture)" : "");
    printf("  largest difference           %d/255\n", t->max_codes);
    printf("  above 1/255                  %.4g %% of the mask\n", 100 * t->above_one_fraction);
    printf("  bias                         %.4g/255\n", t->bias_codes);
    if (!t->mask_is_whole)
        printf("  coverage differs             %lld pixels\n", (long long)t->coverage_mismatches);
    printf("  found within 1 pixel         %.4f %% of A in B, %.4f %% of B in A\n",
           100 * t->matched_a, 100 * t->matched_b);
    printf("  energy ratio                 %.6f\n", t->energy_ratio);
    printf("  largest tile difference      %.4g/255\n", t->tile_max_codes);
    printf("  beyond black and white       largest %.4g %%, bias %.4g %%, ratio of light %.6f\n",
           100 * t->clamped_max, 100 * t->clamped_bias, t->clamped_ratio);
    printf("  relative error (linear)      mean %.4g, largest %.4g\n", t->relative_mean,
           t->relative_max);
}

static void print_flip(const struct rg_flip *f)
{
    printf("  mean, weighted median        %.6f, %.6f\n", f->mean, f->weighted_median);
    printf("  weighted quartiles           %.6f, %.6f\n", f->weighted_quartile_1,
           f->weighted_quartile_3);
    printf("  99th percentile, largest     %.6f, %.6f\n", f->p99, f->max);
    printf("  over the mask: mean, p99     %.6f, %.6f\n", f->mask_mean, f->mask_p99);
}

static void print_name(char which, const char *name)
{
    char plain[4096];
    snprintf(plain, sizeof(plain), "%s", name);
    rg_plain(plain);
    printf("%c %s\n", which, plain);
}

void rg_pair_print(const char *a, const char *b, const struct rg_comparison *c)
{
    print_name('A', a);
    print_name('B', b);
    printf("%d x %d pixels, %d channel%s; tier %s\n", c->width, c->height, c->channels,
           c->channels > 1 ? "s" : "", c->tier);
    print_verdicts(&c->tiers);
    print_tiers(c);
    print_metrics(&c->metrics, c->has_codes);
    if (c->has_codes)
        print_codes(&c->code_metrics);
    printf("\nFLIP (LDR, %.4g pixels a degree)\n", (double)c->pixels_per_degree);
    print_flip(&c->flip);
    if (!c->has_hdr_flip)
        return;
    printf("\nHDR-FLIP (ACES, %d exposures from %.4g to %.4g stops)\n", c->hdr_flip.exposures,
           c->hdr_flip.start_exposure, c->hdr_flip.stop_exposure);
    print_flip(&c->hdr_flip.flip);
}

// null stands for infinity and NaN, which JSON lacks.
static json_t *number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *verdict_json(const struct rg_verdict *verdict)
{
    return json_pack("{s:b, s:s}", "holds", verdict->holds, "why", verdict->why);
}

static json_t *tiers_json(const struct rg_tiers *t)
{
    return json_pack(
        "{s:o, s:o, s:o, s:b, s:o, s:o, s:I, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "t0",
        verdict_json(&t->of[RG_T0]), "t1", verdict_json(&t->of[RG_T1]), "t2",
        verdict_json(&t->of[RG_T2]), "mask_is_whole", t->mask_is_whole, "above_one_fraction",
        number(t->above_one_fraction), "bias_codes", number(t->bias_codes), "coverage_mismatches",
        (json_int_t)t->coverage_mismatches, "matched_a", number(t->matched_a), "matched_b",
        number(t->matched_b), "energy_ratio", number(t->energy_ratio), "tile_max_codes",
        number(t->tile_max_codes), "relative_mean", number(t->relative_mean), "relative_max",
        number(t->relative_max), "clamped_max", number(t->clamped_max), "clamped_bias",
        number(t->clamped_bias), "clamped_ratio", number(t->clamped_ratio));
}

static json_t *metrics_json(const struct rg_metrics *m)
{
    json_t *above = json_array();
    for (int t = 0; t < RG_ABOVE_COUNT; t++)
        json_array_append_new(above, json_pack("{s:f, s:I, s:I}", "threshold",
                                               (double)rg_above_thresholds[t], "values",
                                               (json_int_t)m->values_above[t], "pixels",
                                               (json_int_t)m->pixels_above[t]));
    return json_pack("{s:o, s:o, s:o, s:[i,i,i], s:I, s:I, s:I, s:I, s:I, s:o}", "mean",
                     number(m->mean), "rms", number(m->rms), "max", number(m->max), "max_at",
                     m->max_x, m->max_y, m->max_channel, "values", (json_int_t)m->values,
                     "differing_pixels", (json_int_t)m->differing_pixels, "nonfinite_a",
                     (json_int_t)m->nonfinite_a, "nonfinite_b", (json_int_t)m->nonfinite_b,
                     "nonfinite_mismatches", (json_int_t)m->nonfinite_mismatches, "above", above);
}

// null: nothing differs. Absent if a value is NaN.
static void set_psnr(json_t *json, const struct rg_metrics *m)
{
    if (!isnan(m->psnr_db))
        json_object_set_new(json, "psnr", number(m->psnr_db));
}

static json_t *codes_json(const struct rg_comparison *c)
{
    const struct rg_metrics *m = &c->code_metrics;
    if (!c->has_codes)
        return json_null();
    json_t *json = json_pack("{s:o, s:o, s:o}", "mean", number(m->mean), "rms", number(m->rms),
                             "max", number(m->max));
    set_psnr(json, m);
    return json;
}

static json_t *hdr_flip_json(const struct rg_comparison *c)
{
    const struct rg_flip *f = &c->hdr_flip.flip;
    if (!c->has_hdr_flip)
        return json_null();
    return json_pack("{s:o, s:o, s:i, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "start_exposure",
                     number(c->hdr_flip.start_exposure), "stop_exposure",
                     number(c->hdr_flip.stop_exposure), "exposures", c->hdr_flip.exposures, "mean",
                     number(f->mean), "weighted_median", number(f->weighted_median),
                     "weighted_quartile_1", number(f->weighted_quartile_1), "weighted_quartile_3",
                     number(f->weighted_quartile_3), "p99", number(f->p99), "max", number(f->max),
                     "mask_mean", number(f->mask_mean), "mask_p99", number(f->mask_p99));
}

static bool is_utf8(const char *name)
{
    json_t *json = json_string(name);
    const bool is = json != NULL;
    json_decref(json);
    return is || rg_error("diff --json: '%s' is not UTF-8; give the file another name", name);
}

json_t *rg_pair_json(const char *a, const char *b, const struct rg_comparison *c)
{
    const struct rg_flip *f = &c->flip;
    if (!is_utf8(a) || !is_utf8(b))
        return NULL;
    json_t *pair = json_pack(
        "{s:s, s:s, s:s, s:i, s:I, s:I, s:o, s:o, s:o, s:o, s:o, s:o, s:f, s:f, s:o, s:o, "
        "s:o}",
        "a", a, "b", b, "tier", c->tier, "max", c->tiers.max_codes, "differing",
        (json_int_t)c->metrics.differing_values, "mask", (json_int_t)c->tiers.mask_pixels,
        "flip_mean", number(f->mean), "flip_weighted_median", number(f->weighted_median),
        "flip_p99", number(f->p99), "flip_max", number(f->max), "flip_mask_mean",
        number(f->mask_mean), "flip_mask_p99", number(f->mask_p99), "exposure", (double)c->exposure,
        "pixels_per_degree", (double)c->pixels_per_degree, "relative_mean",
        number(c->tiers.relative_mean), "tiers", tiers_json(&c->tiers), "linear",
        metrics_json(&c->metrics));
    if (!pair)
        return rg_harness_error_null(
            "diff --json: no memory for the figures of '%s' and '%s'; close other "
            "programs",
            a, b);
    set_psnr(pair, &c->metrics);
    json_object_set_new(pair, "flip_weighted_quartile_1", number(f->weighted_quartile_1));
    json_object_set_new(pair, "flip_weighted_quartile_3", number(f->weighted_quartile_3));
    json_object_set_new(pair, "codes", codes_json(c));
    json_object_set_new(pair, "hdr_flip", hdr_flip_json(c));
    return pair;
}

bool rg_pairs_print_json(json_t *devices, json_t *pictures, json_t *pairs, json_t *failures)
{
    json_t *all = json_pack("{s:i, s:o*, s:O*, s:O, s:O}", "format", 1, "devices", devices,
                            "pictures", pictures, "pairs", pairs, "failures", failures);
    bool good = all && json_dumpf(all, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) == 0;
    printf("\n");
    json_decref(all);
    return good || rg_stdout_error();
}

bool rg_is_folder_prefix(const char *prefix)
{
    return *prefix && prefix[strlen(prefix) - 1] == '/';
}

// PREFIX-name.png, or FOLDER/name.png, which the caller frees. NULL, and one logged line, without
// memory.
static char *heatmap_path(const char *prefix, const char *name)
{
    const size_t size = strlen(prefix) + strlen(name) + 6;
    char *path = rg_alloc(size, 1, "a heat map's name");
    if (path)
        snprintf(path, size, "%s%s%s.png", prefix, rg_is_folder_prefix(prefix) ? "" : "-", name);
    return path;
}

bool rg_pair_heatmaps_can_be_written(const char *prefix, int64_t pixels)
{
    char *path = prefix ? heatmap_path(prefix, "flip") : NULL;
    const bool good = !prefix || (path && rg_picture_can_be_written(path, pixels));
    free(path);
    return good;
}

bool rg_pair_heatmaps_spare(const char *prefix, const char *read)
{
    static const char *const names[] = {"flip", "difference"};
    bool spared = true;
    for (int i = 0; spared && prefix && i < 2; i++) {
        char *path = heatmap_path(prefix, names[i]);
        spared = path && rg_file_spares(path, read);
        free(path);
    }
    return spared;
}

// Draws `values` as a heat map into PREFIX-name.png.
static bool write_heatmap(const char *prefix, const char *name, const float *values,
                          const struct rg_comparison *c, float top)
{
    char *path = heatmap_path(prefix, name);
    if (!path)
        return false;
    struct rg_picture heat;
    bool good = rg_heatmap_draw(values, c->width, c->height, top, &heat) &&
                rg_picture_write(path, &heat, &(struct rg_write_options){0});
    rg_picture_destroy(&heat);
    free(path);
    return good;
}

bool rg_pair_heatmaps(const char *prefix, const struct rg_picture *a, const struct rg_picture *b,
                      const struct rg_comparison *c)
{
    float *difference = malloc((size_t)c->width * (size_t)c->height * sizeof(*difference)), top;
    if (!difference)
        return rg_harness_error("%s: no memory for the heat maps", prefix);
    rg_heatmap_difference(a, b, difference, &top);
    bool good = write_heatmap(prefix, "flip", c->flip_map, c, 1.0f) &&
                write_heatmap(prefix, "difference", difference, c, top);
    free(difference);
    return good;
}
