// Water on a pane and how it bends light, in double precision: written from docs/drops.md and
// textbooks' forms of the laws, without anything of kernels/ or core/.
#ifndef RG_TESTS_ORACLE_DROPS_PANE_WATER_H
#define RG_TESTS_ORACLE_DROPS_PANE_WATER_H

// Heights of cells, borrowed: row by row from the top.
struct water_map {
    const float *height_mm;
    int columns, rows;
    double cell_mm;
};

struct water_surface {
    double height, slope[2]; // mm and mm/mm, to the right and down
    double bend;             // 1/mm
};

// The bicubic B-spline with a map's heights as coefficients, at a place in mm. Beyond the map's
// edges the outermost cells repeat.
struct water_surface water_surface_at(const struct water_map *map, double x_mm, double y_mm);

// Light along the unit vector `d` passes from index n1 into n2, through a surface whose unit normal
// points with the light. Returns the reflected share of unpolarised light; if it is 1, `passed` is
// not set.
double water_pass(const double d[3], const double normal[3], double n1, double n2,
                  double passed[3]);

#endif
