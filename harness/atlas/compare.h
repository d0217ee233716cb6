// How near an atlas is to pictures of the original database, in figures.
#ifndef RG_HARNESS_ATLAS_COMPARE_H
#define RG_HARNESS_ATLAS_COMPARE_H

#include "core/scene/atlas/cave/compare.h"

// Of a set of pictures, laid beside ours in one way.
struct rg_cave_figures {
    int pictures;         // that have a correlation
    double median, above; // of the correlations; the share of them above 0.9
    double worst;         // 0 where there are no pictures, as all others
    const struct rg_cave_row *worst_row;
};

// Which pictures: of single lights, of light from everywhere, or of single lights in one view.
enum { RG_CAVE_LIGHTS = -1, RG_CAVE_ENV = -2 }; // else a view

struct rg_cave_figures rg_cave_figures(const struct rg_cave_comparison *comparison, int which,
                                       enum rg_cave_way way);
// The way in which the pictures of single lights, or where there are none those of all, correlate
// best in the median; the first of equals.
enum rg_cave_way rg_cave_best(const struct rg_cave_comparison *comparison);

// The correlation of the logarithms of mean light, over the pictures of single lights that have a
// factor and are not dark; `pictures` is how many. NAN below three.
double rg_cave_brightness(const struct rg_cave_comparison *comparison, int *pictures);

// All of it on standard output, as text or as JSON (docs/records.md).
void rg_cave_print(const struct rg_cave_comparison *comparison, const struct rg_atlas *atlas,
                   const char *folder, bool json);

#endif
