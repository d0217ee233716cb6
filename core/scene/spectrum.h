// The size distribution of raindrops, and their speeds of fall.
//
// Sources: Marshall and Palmer, 1948: N(D) = 8000 exp(-4.1 R^-0.21 D) per cubic metre and
// millimetre. Best, 1950: air holds 67 R^0.846 cubic millimetres of water per cubic metre, of which
// the share exp(-(D / a)^2.25) is in drops wider than D, a = 1.30 R^0.232 mm. Terminal speeds: Gunn
// and Kinzer, 1949, linearly interpolated; Atlas, Srivastava and Sekhon, 1973: 9.65 - 10.3 exp(-0.6
// D) m/s. R is the rain rate in millimetres an hour, D a diameter in millimetres.
#ifndef RG_CORE_SCENE_SPECTRUM_H
#define RG_CORE_SCENE_SPECTRUM_H

enum rg_spectrum_kind { RG_MARSHALL_PALMER, RG_BEST };
enum rg_speed_law { RG_GUNN_KINZER, RG_ATLAS };
// Which drops of a spectrum are kept: all alike, in proportion to their cross-sections, or to their
// cross-sections over their speeds, which is how bright a streak is.
enum rg_spectrum_keep { RG_KEEP_ALIKE, RG_KEEP_BY_SECTION, RG_KEEP_BY_STREAK };

// The drops between two diameters.
struct rg_spectrum {
    enum rg_spectrum_kind kind;
    enum rg_speed_law law;
    double rain_mm_h;         // R, the rain rate of the spectrum; above 0
    double least_mm, most_mm; // 0.1 <= least < most
    double amount;            // the drops that there are over those of the law: 1, or normalised
};

// The largest and the smallest diameter: larger drops break up as they fall, smaller ones are a
// cloud's.
#define RG_LARGEST_DROP_MM  6.0
#define RG_SMALLEST_DROP_MM 0.1

double rg_drop_volume_mm3(double diameter_mm); // of a sphere
// How fast the number of Marshall and Palmer's drops falls with their diameter, in 1/mm.
double rg_marshall_palmer_slope(double rain_mm_h);

// The number of drops of a diameter, per cubic metre and millimetre, whatever the bounds; not
// normalised.
double rg_spectrum_density(const struct rg_spectrum *spectrum, double diameter_mm);
double rg_terminal_speed(enum rg_speed_law law, double diameter_mm); // m/s

// Sets the amount so that drops of 0.1 to 6 mm, all together, make R at their speeds. The law
// itself makes another rain rate (docs/spectra.md).
void rg_spectrum_normalise(struct rg_spectrum *spectrum);

// Totals over the drops between the bounds.
struct rg_rainfall {
    double drops_m3;     // per cubic metre
    double water_mm3_m3; // in a cubic metre of air
    double rain_mm_h;    // rate of rain on level ground
    double drops_m2_s;
    double section_mm2_m3; // sum of their cross-sections
};
struct rg_rainfall rg_spectrum_rainfall(const struct rg_spectrum *spectrum);

// The light that drops block on a kilometre, as a share that small amounts of it add up to: their
// cross-sections, without what they bend aside by diffraction, which is as much again.
double rg_extinction_per_km(double section_mm2_m3);

// Divides the spectrum into `count` classes so that each holds the same number of kept drops. A
// class has the diameter that gives its drops their total water, and as many drops as its share of
// the spectrum.
struct rg_drop_class {
    double diameter_mm, speed_m_s;
    double drops_m3;
};
void rg_spectrum_classes(const struct rg_spectrum *spectrum, enum rg_spectrum_keep keep, int count,
                         struct rg_drop_class *classes);

#endif
