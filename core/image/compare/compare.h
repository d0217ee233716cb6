// Comparing two pictures of one shape: what differs, by how much, whether one would see it, and the
// agreement tier they hold.
//
// Two domains. *Linear* figures are taken from the texels as they are. *Encoded* figures are taken
// from one fixed encoding: colours times the exposure, clamped to 0..1, sRGB-encoded, 8 bits; alpha
// straight, 8 bits. Encoded differences are quoted in codes (1 code = 1/255). FLIP is LDR-FLIP of
// the encoded pictures, for HDR files too, and HDR-FLIP beside it where it is asked for. Pictures
// read from integers were decoded: linear figures of them are of light, and those that other
// programs give, of codes, stand beside them.
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

// OpenImageIO's figures, by its definitions: linear, over all values of all channels. Where both
// values are NaN, or both infinite with one sign, they agree; another value that is not finite
// is a mismatch and makes `max` infinite. Neither enters mean and rms, which divide by all values.
struct rg_metrics {
    double mean;                   // of |A - B|
    double rms;                    // of A - B
    double psnr_db;                // 20 log10(largest |value|, at least 1, / rms); infinite where
                                   // nothing differs, NAN where else a value is not finite
    double max;                    // of |A - B|
    int max_x, max_y, max_channel; // of the first value in row order that has it; 0 when equal
    int64_t values;                // compared
    int64_t differing_values;      // not equal to the bit (0 and -0 differ)
    int64_t differing_pixels;      // with a differing value
    int64_t values_above[RG_ABOVE_COUNT];
    int64_t pixels_above[RG_ABOVE_COUNT]; // with a value above: OpenImageIO's nfail and nwarn
    int64_t nonfinite_a, nonfinite_b;     // values that are NaN or infinite
    int64_t nonfinite_mismatches;
};

// FLIP (Andersson et al. 2020), LDR, encoded: 0 the same, 1 as different as can be.
struct rg_flip {
    double mean, max;
    double weighted_median;                          // pixels below it hold half of the sum
    double weighted_quartile_1, weighted_quartile_3; // a quarter, and three
    double p99;                 // 99 % of the pixels are at or below it (nearest rank)
    double mask_mean, mask_p99; // over the rain mask; 0 when it is empty
};

// HDR-FLIP (Andersson et al. 2021) of A, the reference, and B, tone-mapped by ACES.
struct rg_hdr_flip {
    double start_exposure, stop_exposure; // in stops
    int exposures;                        // from the one to the other, evenly
    struct rg_flip flip;
};

// What a tier's verdict says, with the first condition that failed, "" when none.
struct rg_verdict {
    bool holds;
    char why[120];
};

// Encoded, but for the relative errors. The rain mask: pixels of which a colour is more than 1 code
// from the background's in A or B. Without a background it is the whole picture.
struct rg_tiers {
    int64_t mask_pixels;
    bool mask_is_whole;                  // no background was given
    struct rg_verdict of[RG_TIER_COUNT]; // by tier
    // T1
    int max_codes;               // largest difference anywhere, alpha included
    double above_one_fraction;   // of the mask: pixels with a difference above 1 code
    double bias_codes;           // mean of B - A over the mask, of the colour where it is largest
    int64_t coverage_mismatches; // pixels that rain covers in one (above 1 code) and leaves exactly
                                 // the background in the other; 0 without a background
    // T2
    double matched_a, matched_b; // of the mask: pixels of A (of B) whose colour is found, to 8
                                 // codes, within 1 pixel in B (in A)
    double energy_ratio;         // sum of |B - background| / sum of |A - background|; 1 when 0 / 0
    double tile_max_codes;       // largest |mean of B - A| of a colour in a 16 x 16 tile
    // Linear, of what the encoding clamps away below black and above white: relative to the larger
    // of the two values, and to 1 at least. `above_one_fraction`, `matched_` and `tile_max_codes`
    // have it too, as the codes that so much is at white: 112 for all of it.
    double clamped_max;   // T1: the largest difference anywhere, alpha included
    double clamped_bias;  // T1: mean of B - A over the mask, of the colour where it is largest
    double clamped_ratio; // T2: light of B by that of A, of values of which one is beyond black
                          // or white, over the mask; 1 without any
    // Beside them: linear, over the mask's colours.
    double relative_mean; // sum of |A - B| / sum of max(|A|, |B|)
    double relative_max;  // largest of the same of one pixel
};

struct rg_compare_options {
    float exposure;          // 0: 1
    float pixels_per_degree; // 0: 67.02, a 0.7 m wide 3840 pixel screen seen from 0.7 m
    bool hdr_flip;           // wanted, of pictures that were not decoded from integers
};

struct rg_comparison {
    int width, height, channels;
    float exposure, pixels_per_degree;
    const char *tier; // "T0", "T1", "T2" (the strictest that holds) or "none"
    struct rg_metrics metrics;
    bool has_codes; // both were decoded from integers
    struct rg_metrics code_metrics;
    struct rg_flip flip;
    bool has_hdr_flip;
    struct rg_hdr_flip hdr_flip;
    struct rg_tiers tiers;
    float *flip_map; // width * height FLIP values, row 0 on top; owned
};

// Compares B with A. `background` (NULL: none) is the picture without rain. Pictures of different
// sizes or channel counts, or options out of range, are logged as `name_a`, `name_b`.
// The caller calls rg_comparison_destroy on success.
bool rg_compare(const struct rg_picture *a, const char *name_a, const struct rg_picture *b,
                const char *name_b, const struct rg_picture *background,
                const struct rg_compare_options *options, struct rg_comparison *comparison);

// NULL and a zeroed struct are accepted.
void rg_comparison_destroy(struct rg_comparison *comparison);

// --- the parts, for tests and for callers that want one figure ---

// The fixed encoding: 4 codes a pixel (red, green, blue, alpha; grey thrice; no alpha: 255) into
// width * height * 4 bytes.
void rg_encode(const struct rg_picture *picture, float exposure, uint8_t *codes);

bool rg_metrics_compute(const struct rg_picture *a, const struct rg_picture *b,
                        struct rg_metrics *metrics);

// The same of what `make` makes of each row, into as many floats as the row has values: whole
// pictures of them would cost more than all figures.
typedef void rg_row_maker(const struct rg_picture *picture, int y, float *row);
bool rg_metrics_of_rows(const struct rg_picture *a, const struct rg_picture *b, rg_row_maker *make,
                        struct rg_metrics *metrics);

// The same of two pictures' codes, over the largest code, from which they were decoded.
bool rg_code_metrics(const struct rg_picture *a, const struct rg_picture *b,
                     struct rg_metrics *metrics);

// `mask` receives 1 for a pixel of the rain mask, 0 for another (width * height bytes).
// `background_codes`: NULL for none.
bool rg_tiers_compute(const struct rg_picture *a, const struct rg_picture *b,
                      const uint8_t *a_codes, const uint8_t *b_codes,
                      const uint8_t *background_codes, float exposure,
                      const struct rg_metrics *metrics, uint8_t *mask, struct rg_tiers *tiers);

// What a comparison comes to of two pictures that owe each other a tier: ok, fail, or nothing where
// neither has rain, so that nothing of it was compared.
enum rg_outcome rg_comparison_outcome(const struct rg_comparison *comparison, enum rg_tier owed);

// The strictest tier that two pictures hold; RG_TIER_COUNT: none.
int rg_tiers_strictest(const struct rg_tiers *tiers);
// The same in words: "T2 would hold", or "no tier would hold: " and why T2 does not.
enum { RG_TIERS_TEXT = 160 };
void rg_tiers_text(const struct rg_tiers *tiers, char text[RG_TIERS_TEXT]);

// Whether a picture has any pixel of rain before its background: of an empty mask nothing can be
// said.
bool rg_shows_rain(const uint8_t *codes, const uint8_t *background_codes, int64_t pixels);
// The same of pictures of one size, encoded with an exposure. False, and one logged line, without
// memory.
bool rg_picture_shows_rain(const struct rg_picture *picture, const struct rg_picture *background,
                           float exposure, bool *shows);

// FLIP of each pixel into width * height floats. pixels_per_degree: 1 to 200.
bool rg_flip_map(const uint8_t *a_codes, const uint8_t *b_codes, int width, int height,
                 float pixels_per_degree, float *map);
// The same of pictures of one shape as they are shown: `tone` makes what a screen shows, 0 to 1, of
// values of one colour, in place. Where the map has had a larger value, that stays.
typedef void rg_tone(float *values, int count, float scale);
bool rg_flip_map_shown(const struct rg_picture *a, const struct rg_picture *b, rg_tone *tone,
                       float scale, float pixels_per_degree, float *map);
// HDR-FLIP of each pixel; `hdr` gets the exposures.
bool rg_hdr_flip_map(const struct rg_picture *a, const struct rg_picture *b,
                     float pixels_per_degree, float *map, struct rg_hdr_flip *hdr);
// `mask`: NULL for the whole map.
bool rg_flip_pool(const float *map, const uint8_t *mask, int64_t pixels, struct rg_flip *flip);

// FLIP's own cube root and power, for positive arguments: relative errors below 4e-7 and 4e-6.
float rg_flip_cbrt(float x);
float rg_flip_pow(float x, float y);

#endif
