// Measures how closely an atlas agrees with pictures of the original database.
#ifndef RG_HARNESS_COMMANDS_DRAWING_ATLAS_COMPARE_H
#define RG_HARNESS_COMMANDS_DRAWING_ATLAS_COMPARE_H

#include "core/scene/atlas/cave/compare.h"

// Results for a set of pictures, compared in one way.
struct rg_cave_figures {
    int pictures;         // with a correlation
    double median, above; // of the correlations; and the share of them above 0.9
    double worst;         // all are 0 without pictures
    const struct rg_cave_row *worst_row;
};

// Sets of pictures: of single lights, of light from everywhere, or of single lights in one view.
enum { RG_CAVE_LIGHTS = -1, RG_CAVE_ENV = -2 }; // others are views

struct rg_cave_figures rg_cave_figures(const struct rg_cave_comparison *comparison, int which,
                                       enum rg_cave_way way);
// The way with the best median correlation for the pictures of single lights, or if there are none
// for all pictures; the first of equals.
enum rg_cave_way rg_cave_best(const struct rg_cave_comparison *comparison);

// The correlation of the logarithms of mean light, over pictures of single lights with a factor
// that are not dark; `pictures` is their number. NAN below three.
double rg_cave_brightness(const struct rg_cave_comparison *comparison, int *pictures);

// Prints all results to standard output, as text or as JSON (docs/records.md).
void rg_cave_print(const struct rg_cave_comparison *comparison, const struct rg_atlas *atlas,
                   const char *folder, bool json);

#endif
