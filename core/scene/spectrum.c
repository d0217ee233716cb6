#include "core/scene/spectrum.h"

#include <math.h>
#include <string.h>

// Steps of the integral over the spectrum; their width grows with the diameter, as the spectrum
// varies.
enum { STEPS = 1 << 15 };

double rg_drop_volume_mm3(double d)
{
    return M_PI / 6 * d * d * d;
}

// --- how many ---

double rg_marshall_palmer_slope(double rain_mm_h)
{
    return 4.1 * pow(rain_mm_h, -0.21);
}

static double marshall_palmer(double rain_mm_h, double d)
{
    return 8000 * exp(-rg_marshall_palmer_slope(rain_mm_h) * d);
}

// The density by diameter of the share of water, divided by a drop's volume.
static double best(double rain_mm_h, double d)
{
    const double a = 1.30 * pow(rain_mm_h, 0.232), n = 2.25;
    const double water = 67 * pow(rain_mm_h, 0.846);
    const double share = n / a * pow(d / a, n - 1) * exp(-pow(d / a, n));
    return water * share / rg_drop_volume_mm3(d);
}

double rg_spectrum_density(const struct rg_spectrum *spectrum, double d)
{
    return spectrum->kind == RG_BEST ? best(spectrum->rain_mm_h, d)
                                     : marshall_palmer(spectrum->rain_mm_h, d);
}

// --- how fast ---

// Diameters in millimetres, speeds in metres a second.
static const double gunn_kinzer[][2] = {
    {0, 0},      {0.1, 0.27}, {0.2, 0.72}, {0.3, 1.17}, {0.4, 1.62}, {0.5, 2.06}, {0.6, 2.47},
    {0.7, 2.87}, {0.8, 3.27}, {0.9, 3.67}, {1.0, 4.03}, {1.2, 4.64}, {1.4, 5.17}, {1.6, 5.65},
    {1.8, 6.09}, {2.0, 6.49}, {2.2, 6.90}, {2.4, 7.27}, {2.6, 7.57}, {2.8, 7.82}, {3.0, 8.06},
    {3.2, 8.26}, {3.4, 8.44}, {3.6, 8.60}, {3.8, 8.72}, {4.0, 8.83}, {4.4, 8.98}, {4.8, 9.07},
    {5.0, 9.09}, {5.4, 9.14}, {5.8, 9.17}, {99, 9.17},
};

double rg_terminal_speed(enum rg_speed_law law, double d)
{
    if (law == RG_ATLAS)
        return fmax(9.65 - 10.3 * exp(-0.6 * d), 0);
    int i = 1;
    while (gunn_kinzer[i][0] < d && gunn_kinzer[i][0] < 99)
        i++;
    const double *a = gunn_kinzer[i - 1], *b = gunn_kinzer[i];
    return a[1] + (b[1] - a[1]) * (d - a[0]) / (b[0] - a[0]);
}

// --- sums ---

// The middle and width of step i; steps have equal ratios from the least to the most.
static double middle_of(const struct rg_spectrum *spectrum, int i, double *width)
{
    const double ratio = log(spectrum->most_mm / spectrum->least_mm) / STEPS;
    const double from = spectrum->least_mm * exp(ratio * i);
    *width = from * expm1(ratio);
    return from + *width / 2;
}

struct rg_rainfall rg_spectrum_rainfall(const struct rg_spectrum *spectrum)
{
    struct rg_rainfall sum = {0};
    for (int i = 0; i < STEPS; i++) {
        double width;
        const double d = middle_of(spectrum, i, &width);
        const double drops = spectrum->amount * rg_spectrum_density(spectrum, d) * width;
        const double speed = rg_terminal_speed(spectrum->law, d);
        sum.drops_m3 += drops;
        sum.water_mm3_m3 += drops * rg_drop_volume_mm3(d);
        sum.drops_m2_s += drops * speed;
        sum.rain_mm_h += drops * rg_drop_volume_mm3(d) * speed * 3600 * 1e-6;
        sum.section_mm2_m3 += drops * M_PI / 4 * d * d;
    }
    return sum;
}

void rg_spectrum_normalise(struct rg_spectrum *spectrum)
{
    struct rg_spectrum whole = *spectrum;
    whole.amount = 1;
    whole.least_mm = RG_SMALLEST_DROP_MM;
    whole.most_mm = RG_LARGEST_DROP_MM;
    spectrum->amount = spectrum->rain_mm_h / rg_spectrum_rainfall(&whole).rain_mm_h;
}

double rg_extinction_per_km(double section_mm2_m3)
{
    return section_mm2_m3 * 1e-6 * 1000;
}

// --- classes ---

// How readily a drop is kept, by any unit.
static double chance_of(const struct rg_spectrum *spectrum, enum rg_spectrum_keep keep, double d)
{
    if (keep != RG_KEEP_BY_STREAK)
        return keep == RG_KEEP_ALIKE ? 1 : d * d;
    return d * d / fmax(rg_terminal_speed(spectrum->law, d), 0.1); // Atlas' may be 0
}

static double kept_of(const struct rg_spectrum *spectrum, enum rg_spectrum_keep keep)
{
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        double width;
        const double d = middle_of(spectrum, i, &width);
        sum += rg_spectrum_density(spectrum, d) * width * chance_of(spectrum, keep, d);
    }
    return sum;
}

void rg_spectrum_classes(const struct rg_spectrum *spectrum, enum rg_spectrum_keep keep, int count,
                         struct rg_drop_class *classes)
{
    const double kept = kept_of(spectrum, keep);
    double before = 0;
    memset(classes, 0, (size_t)count * sizeof(*classes));
    for (int i = 0; i < STEPS; i++) {
        double width;
        const double d = middle_of(spectrum, i, &width);
        const double drops = rg_spectrum_density(spectrum, d) * width;
        const double step = drops * chance_of(spectrum, keep, d);
        // A step may span several classes; each gets its part.
        for (double done = 0; done < step;) {
            const int at = (int)fmin(floor((before + done) / kept * count), count - 1);
            const double left = at < count - 1 ? kept * (at + 1) / count - (before + done) : step;
            const double part = fmin(fmax(left, kept * 1e-12), step - done);
            classes[at].drops_m3 += drops * part / step;
            classes[at].diameter_mm += drops * part / step * d * d * d;
            done += part;
        }
        before += step;
    }
    for (int k = 0; k < count; k++) {
        classes[k].diameter_mm = cbrt(classes[k].diameter_mm / classes[k].drops_m3);
        classes[k].speed_m_s = rg_terminal_speed(spectrum->law, classes[k].diameter_mm);
        classes[k].drops_m3 *= spectrum->amount;
    }
}
