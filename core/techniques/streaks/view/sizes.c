// The sizes of drops: classes of a spectrum or a single one, and the facts told of that rain.
#include <math.h>
#include <string.h>

#include "core/base/log.h"
#include "core/techniques/streaks/instance.h"

// In the order of the parameters' choices.
enum { ONE_SIZE, OF_MARSHALL_PALMER, OF_BEST };

static struct rg_spectrum spectrum_of(const struct streaks_settings *set)
{
    struct rg_spectrum spectrum = {
        .kind = set->spectrum == OF_BEST ? RG_BEST : RG_MARSHALL_PALMER,
        .law = (enum rg_speed_law)set->terminal_speed,
        .rain_mm_h = set->rain_mm_h,
        .least_mm = set->least_diameter_mm,
        .most_mm = RG_LARGEST_DROP_MM,
        .amount = 1,
    };
    if (set->normalised)
        rg_spectrum_normalise(&spectrum);
    return spectrum;
}

// Rayleigh's frequency of a water drop; the atlas's second oscillation is twice as fast.
double streaks_swings_a_second(double radius_m)
{
    const double tension_n_m = 0.0728, density_kg_m3 = 1000;
    return sqrt(8 * tension_n_m / (density_kg_m3 * pow(radius_m, 3))) / (2 * M_PI);
}

static void put_class(struct streaks_sizes *sizes, const struct streaks_settings *set, int i,
                      double radius_m, double speed_m_s, double weight)
{
    const double usual_m = set->drop_radius_mm / 1000;
    float *words = sizes->words + (size_t)i * STREAKS_SIZE_WORDS;
    words[0] = (float)(radius_m / usual_m);
    words[1] = (float)(speed_m_s / set->fall_speed_m_s);
    words[2] = (float)(streaks_swings_a_second(radius_m) / streaks_swings_a_second(usual_m));
    words[3] = (float)weight;
    words[4] = 0;
    sizes->speeds_m_s[i] = speed_m_s;
    sizes->largest_m = fmax(sizes->largest_m, radius_m);
    sizes->fastest_m_s = fmax(sizes->fastest_m_s, speed_m_s);
}

static bool make_one(struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    s->sizes.count = 1;
    s->sizes.drops_m3 = set->drops_m2_s / set->fall_speed_m_s;
    put_class(&s->sizes, set, 0, set->drop_radius_mm / 1000, set->fall_speed_m_s, 1);
    return true;
}

static bool make_classes(struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    struct rg_drop_class classes[STREAKS_SIZES];
    struct streaks_sizes *sizes = &s->sizes;
    sizes->spectrum = spectrum_of(set);
    sizes->rainfall = rg_spectrum_rainfall(&sizes->spectrum);
    sizes->count = STREAKS_SIZES;
    sizes->drops_m3 = sizes->rainfall.drops_m3 * set->kept_share;
    rg_spectrum_classes(&sizes->spectrum, (enum rg_spectrum_keep)set->kept, STREAKS_SIZES, classes);
    for (int i = 0; i < STREAKS_SIZES; i++)
        put_class(sizes, set, i, classes[i].diameter_mm / 2000, classes[i].speed_m_s,
                  classes[i].drops_m3 * STREAKS_SIZES / sizes->drops_m3);
    return true;
}

bool streaks_sizes_make(struct streaks *s)
{
    memset(&s->sizes, 0, sizeof(s->sizes));
    return s->settings.spectrum == ONE_SIZE ? make_one(s) : make_classes(s);
}

// --- before memory is taken ---

bool streaks_sizes_fit(const struct streaks *s, const struct rg_density *density)
{
    const struct streaks_settings *set = &s->settings;
    const double volume = 4 * s->space.half_x_m * s->space.half_y_m * set->local_height_m;
    const double drops = s->sizes.drops_m3 * rg_density_mean(density) * volume;
    if (set->spectrum == ONE_SIZE || drops <= INT32_MAX)
        return true;
    return rg_unsupported("spectrum: %.4g drops a cubic metre are %.4g in the local space, at most "
                          "%d can be told apart; raise least_diameter_mm, or lower kept_share, "
                          "local_height_m, rain_width_m or rain_depth_m",
                          s->sizes.drops_m3, drops, INT32_MAX);
}

// --- a frame ---

bool streaks_sizes_differ(const struct streaks *s)
{
    return s->sizes.count > 1;
}

// A streak's contribution grows with its drop's cross-section, spread over the fall in the
// exposure; the variance of pixels grows with its square over that length.
struct streaks_equivalent streaks_sizes_equivalent(const struct streaks *s)
{
    double section = 0, passing = 0, varied = 0;
    for (int i = 0; i < s->sizes.count; i++) {
        const float *words = s->sizes.words + (size_t)i * STREAKS_SIZE_WORDS;
        const double radius_m = (double)words[0] * s->settings.drop_radius_mm / 1000;
        const double one = (double)words[3] * radius_m * radius_m / s->sizes.count;
        section += one;
        passing += one * s->sizes.speeds_m_s[i];
        varied += one * one * s->sizes.count / s->sizes.speeds_m_s[i];
    }
    const double speed_m_s = passing / section, radius2_m2 = varied * speed_m_s / section;
    return (struct streaks_equivalent){sqrt(radius2_m2), speed_m_s,
                                       s->sizes.drops_m3 * section / radius2_m2};
}

void streaks_sizes_turn(struct streaks *s, double top_m)
{
    const double time_s = s->settings.step_s * (double)s->base.frame;
    for (int i = 0; streaks_sizes_differ(s) && i < s->sizes.count; i++)
        s->sizes.words[(size_t)i * STREAKS_SIZE_WORDS + 4] =
            (float)rg_rain_run(s->sizes.speeds_m_s[i], time_s, top_m, s->settings.local_height_m);
}

// --- facts ---

struct realised {
    const struct streaks *s;
    double rain_m3_s; // water that falls, as if all drops passed through one plane
};

static void add_drop(void *user, uint32_t number, int64_t times)
{
    struct realised *sum = user;
    const struct streaks *s = sum->s;
    const int i = streaks_size_class(number, s->sizes.count);
    const float *words = s->sizes.words + (size_t)i * STREAKS_SIZE_WORDS;
    const double diameter_mm = 2 * (double)words[0] * s->settings.drop_radius_mm;
    sum->rain_m3_s += (double)times * (double)words[3] * s->sizes.speeds_m_s[i] *
                      rg_drop_volume_mm3(diameter_mm) * 1e-9;
}

// The rain rate of the particles where the density map is white.
static double realised_mm_h(const struct streaks *s)
{
    struct realised sum = {.s = s};
    const double volume =
        4 * s->space.half_x_m * s->space.half_y_m * s->settings.local_height_m * s->mean_density;
    streaks_packets_each(s->rain->packets, add_drop, &sum);
    return sum.rain_m3_s / volume * 3600 * 1000;
}

// Water that falls and light that is blocked where the density map is white, by drops of one size.
static void tell_one(struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    const double radius_mm = set->drop_radius_mm;
    const double section_mm2_m3 = s->sizes.drops_m3 * M_PI * radius_mm * radius_mm;
    const double water_mm3_m2_s = set->drops_m2_s * rg_drop_volume_mm3(2 * radius_mm);
    rg_tell(&s->base, "rain_rate_mm_h", water_mm3_m2_s * 3600 * 1e-6);
    rg_tell(&s->base, "extinction_per_km", rg_extinction_per_km(section_mm2_m3));
}

static void tell_spectrum(struct streaks *s)
{
    const struct rg_rainfall kept = s->sizes.rainfall;
    struct rg_spectrum spectrum = s->sizes.spectrum;
    spectrum.most_mm = spectrum.least_mm;
    spectrum.least_mm = RG_SMALLEST_DROP_MM;
    const struct rg_rainfall left = spectrum.most_mm > spectrum.least_mm
                                        ? rg_spectrum_rainfall(&spectrum)
                                        : (struct rg_rainfall){0};
    rg_tell(&s->base, "rain_rate_mm_h", kept.rain_mm_h);
    rg_tell(&s->base, "extinction_per_km", rg_extinction_per_km(kept.section_mm2_m3));
    rg_tell(&s->base, "rain_nominal_mm_h", spectrum.rain_mm_h);
    rg_tell(&s->base, "rain_realised_mm_h", realised_mm_h(s));
    rg_tell(&s->base, "drops_m3", kept.drops_m3);
    rg_tell(&s->base, "drops_left_out_m3", left.drops_m3);
    rg_tell(&s->base, "water_left_out_share",
            left.water_mm3_m3 / (left.water_mm3_m3 + kept.water_mm3_m3));
    rg_tell(&s->base, "light_left_out_share",
            left.section_mm2_m3 / (left.section_mm2_m3 + kept.section_mm2_m3));
    rg_tell(&s->base, "rain_left_out_mm_h", left.rain_mm_h);
}

void streaks_sizes_tell(struct streaks *s)
{
    if (streaks_sizes_differ(s))
        tell_spectrum(s);
    else
        tell_one(s);
}
