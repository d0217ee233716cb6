// Compares two pictures of one shape: what differs, by how much, whether one would see it, and
// which agreement tier they meet.
//
// Figures are of two kinds. *Linear* figures use the texels as they are. *Encoded* figures use one
// fixed encoding: colours times the exposure, clamped to 0..1, sRGB-encoded, 8 bits; alpha
// straight, 8 bits. Encoded differences are in codes (1 code = 1/255). FLIP is LDR-FLIP of the
// encoded pictures, also for HDR files; HDR-FLIP is added on request. Pictures read from integers
// were decoded to light, so their linear figures are of light, and figures of their codes, as other
// programs give them, are added.
//
// Every figure is the same for any number of threads and on any processor.
#ifndef RG_CORE_IMAGE_COMPARE_COMPARE_H
#define RG_CORE_IMAGE_COMPARE_COMPARE_H

#include "core/base/outcome.h"
#include "core/base/tier.h"
#include "core/image/picture.h"

enum { RG_ABOVE_COUNT = 4 };

// The absolute linear differences above which values and pixels are counted.
extern const float rg_above_thresholds[RG_ABOVE_COUNT];

// OpenImageIO's figures, by its definitions: linear, over all values of all channels. Two NaN, or
// two infinities of one sign, agree; any other value that is not finite is a mismatch and makes
// `max` infinite. Neither adds to mean and rms, which divide by all values.
struct rg_metrics {
    double mean;                   // of |A - B|
    double rms;                    // of A - B
    double psnr_db;                // 20 log10(largest |value|, at least 1, / rms); infinite where
                                   // nothing differs, NAN where a value is not finite
    double max;                    // of |A - B|
    int max_x, max_y, max_channel; // the first value in row order with it; 0 when equal
    int64_t values;                // compared
    int64_t differing_values;      // not equal to the bit (0 and -0 differ)
    int64_t differing_pixels;      // pixels with a differing value
    int64_t values_above[RG_ABOVE_COUNT];
    int64_t pixels_above[RG_ABOVE_COUNT]; // with a value above: OpenImageIO's nfail and nwarn
    int64_t nonfinite_a, nonfinite_b;     // values that are NaN or infinite
    int64_t nonfinite_mismatches;
};

// FLIP (Andersson et al. 2020), LDR, encoded: 0 means equal, 1 as different as possible.
struct rg_flip {
    double mean, max;
    double weighted_median;                          // the pixels below it hold half of the sum
    double weighted_quartile_1, weighted_quartile_3; // the same for a quarter and three quarters
    double p99;                 // 99 % of the pixels are at or below it (nearest rank)
    double mask_mean, mask_p99; // over the rain mask; 0 when it is empty
};

// HDR-FLIP (Andersson et al. 2021) of A, the reference, and B, tone-mapped by ACES.
struct rg_hdr_flip {
    double start_exposure, stop_exposure; // in stops
    int exposures;                        // evenly spaced from the one to the other
    struct rg_flip flip;
};

// Whether two pictures meet a tier, and the first condition that failed, "" when none.
struct rg_verdict {
    bool holds;
    char why[120];
};

// Encoded, except for the relative errors. A pixel is in the rain mask if one of its colours
// differs by more than 1 code from the background's in A or B. Without a background the mask is the
// whole picture.
struct rg_tiers {
    int64_t mask_pixels;
    bool mask_is_whole;                  // no background was given
    struct rg_verdict of[RG_TIER_COUNT]; // by tier
    // T1
    int max_codes;               // largest difference anywhere, alpha included
    double above_one_fraction;   // fraction of the mask: pixels with a difference above 1 code
    double bias_codes;           // mean of B - A over the mask, of the colour where it is largest
    int64_t coverage_mismatches; // pixels that rain covers in one picture (above 1 code) and that
                                 // equal the background in the other; 0 without a background
    // T2
    double matched_a, matched_b; // fraction of the mask: pixels of A (of B) whose colour occurs, to
                                 // 8 codes, within 1 pixel in B (in A)
    double energy_ratio;         // sum of |B - background| / sum of |A - background|; 1 when 0 / 0
    double tile_max_codes;       // largest |mean of B - A| of a colour in a 16 x 16 tile
    // Linear, of the light that the encoding clamps away below black and above white, relative to
    // the larger of the two values and at least to 1. `above_one_fraction`, `matched_` and
    // `tile_max_codes` include it, converted to codes by the slope at white: 112 codes for a
    // relative difference of 1.
    double clamped_max;   // T1: the largest difference anywhere, alpha included
    double clamped_bias;  // T1: mean of B - A over the mask, of the colour where it is largest
    double clamped_ratio; // T2: light of B by that of A, over the mask's values of which one is
                          // beyond black or white; 1 without any
    // Additional figures: linear, over the mask's colours.
    double relative_mean; // sum of |A - B| / sum of max(|A|, |B|)
    double relative_max;  // largest such ratio of one pixel
};

struct rg_compare_options {
    float exposure;          // 0: 1
    float pixels_per_degree; // 0: 67.02, a 0.7 m wide 3840 pixel screen seen from 0.7 m
    bool hdr_flip;           // compute HDR-FLIP for pictures that were not decoded from integers
};

struct rg_comparison {
    int width, height, channels;
    float exposure, pixels_per_degree;
    const char *tier; // the strictest tier that holds: "T0", "T1", "T2" or "none"
    struct rg_metrics metrics;
    bool has_codes; // both pictures were decoded from integers
    struct rg_metrics code_metrics;
    struct rg_flip flip;
    bool has_hdr_flip;
    struct rg_hdr_flip hdr_flip;
    struct rg_tiers tiers;
    float *flip_map; // width * height FLIP values, row 0 on top; owned
};

// Compares B with A. `background` (NULL: none) is the picture without rain. False, with one logged
// line that names `name_a` and `name_b`, where sizes or channel counts differ or options are out of
// range. The caller calls rg_comparison_destroy on success.
bool rg_compare(const struct rg_picture *a, const char *name_a, const struct rg_picture *b,
                const char *name_b, const struct rg_picture *background,
                const struct rg_compare_options *options, struct rg_comparison *comparison);

// NULL and a zeroed struct are accepted.
void rg_comparison_destroy(struct rg_comparison *comparison);

// --- the parts, for tests and for callers that want one figure ---

// The fixed encoding: 4 codes for each pixel (red, green, blue, alpha; grey thrice; no alpha: 255),
// into width * height * 4 bytes.
void rg_encode(const struct rg_picture *picture, float exposure, uint8_t *codes);

bool rg_metrics_compute(const struct rg_picture *a, const struct rg_picture *b,
                        struct rg_metrics *metrics);

// Metrics of rows that `make` computes from the texels, into as many floats as the row has values.
// Keeping whole pictures of them would cost more than all figures.
typedef void rg_row_maker(const struct rg_picture *picture, int y, float *row);
bool rg_metrics_of_rows(const struct rg_picture *a, const struct rg_picture *b, rg_row_maker *make,
                        struct rg_metrics *metrics);

// Metrics of the codes from which two pictures were decoded, as fractions of the largest code.
bool rg_code_metrics(const struct rg_picture *a, const struct rg_picture *b,
                     struct rg_metrics *metrics);

// `mask` receives 1 for a pixel of the rain mask, 0 for another (width * height bytes).
// `background_codes`: NULL for none.
bool rg_tiers_compute(const struct rg_picture *a, const struct rg_picture *b,
                      const uint8_t *a_codes, const uint8_t *b_codes,
                      const uint8_t *background_codes, float exposure,
                      const struct rg_metrics *metrics, uint8_t *mask, struct rg_tiers *tiers);

// The outcome of comparing two pictures that must meet a tier: ok, fail, or nothing where neither
// shows rain, so that the comparison proves nothing.
enum rg_outcome rg_comparison_outcome(const struct rg_comparison *comparison, enum rg_tier owed);

// The strictest tier that two pictures meet; RG_TIER_COUNT: none.
int rg_tiers_strictest(const struct rg_tiers *tiers);
// The same in words: "T2 would hold", or "no tier would hold: " and why T2 does not.
enum { RG_TIERS_TEXT = 160 };
void rg_tiers_text(const struct rg_tiers *tiers, char text[RG_TIERS_TEXT]);

// Whether a picture has any pixel of rain in front of its background: an empty mask proves nothing.
bool rg_shows_rain(const uint8_t *codes, const uint8_t *background_codes, int64_t pixels);
// The same for two linear pictures of one size, encoded with `exposure`. False, and one logged
// line, when memory runs out.
bool rg_picture_shows_rain(const struct rg_picture *picture, const struct rg_picture *background,
                           float exposure, bool *shows);

// FLIP of each pixel into width * height floats. pixels_per_degree: 1 to 200.
bool rg_flip_map(const uint8_t *a_codes, const uint8_t *b_codes, int width, int height,
                 float pixels_per_degree, float *map);
// The same for two pictures of one shape as a screen shows them: `tone` converts values of one
// colour, in place, to those of the screen, 0 to 1. A larger value that is already in the map
// stays.
typedef void rg_tone(float *values, int count, float scale);
bool rg_flip_map_shown(const struct rg_picture *a, const struct rg_picture *b, rg_tone *tone,
                       float scale, float pixels_per_degree, float *map);
// HDR-FLIP of each pixel; `hdr` gets the exposures.
bool rg_hdr_flip_map(const struct rg_picture *a, const struct rg_picture *b,
                     float pixels_per_degree, float *map, struct rg_hdr_flip *hdr);
// Statistics of a FLIP map. `mask`: NULL for the whole map.
bool rg_flip_pool(const float *map, const uint8_t *mask, int64_t pixels, struct rg_flip *flip);

// FLIP's own cube root and power, for positive arguments: relative errors below 4e-7 and 4e-6.
float rg_flip_cbrt(float x);
float rg_flip_pow(float x, float y);

#endif
