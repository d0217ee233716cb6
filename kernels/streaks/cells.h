// The places of textures in the streak atlases (Creus, figure 4.7): a row for each elevation of the
// camera, and in it nine columns of azimuth for each of ten elevations of the light.
// core/scene/atlas/atlas.h has the same for the host.
#ifndef RG_KERNELS_STREAKS_CELLS_H
#define RG_KERNELS_STREAKS_CELLS_H

#include "kernels/dialect/math.h"
#include "kernels/dialect/vec.h"

#define STREAKS_VIEWS    5  // elevations of the camera, 20 degrees apart from 0 on
#define STREAKS_HEIGHTS  10 // of the light, 20 degrees apart from -90 on
#define STREAKS_AZIMUTHS 9  // of the light from the camera, 20 degrees apart from 10 on
#define STREAKS_COLUMNS  90
#define STREAKS_FRAMES   21 // of a splash, of each material

#define STREAKS_CELL_PX     32 // width of a cell in level 0
#define STREAKS_SPLASH_PX   48
#define STREAKS_SPLASH_LAST 5 // its last level

// Brightness factors: of the point atlases by oscillation, view and column; from this index on, of
// the skies.
#define STREAKS_SKY_FACTORS 4500
// From this index on, the parts in which light shows on splashes, by material and column.
#define STREAKS_SPLASH_FACTORS 4550

// The first texel of a view's row in level 0; the atlas' height for the view after the last. It is
// a sum, because gcc would make a table of choices, and read it for one pixel at a time.
RG_FN int streaks_row(int view)
{
    return 1050 * rg_iclamp(view, 0, 1) + 988 * rg_iclamp(view - 1, 0, 1) +
           810 * rg_iclamp(view - 2, 0, 1) + 544 * rg_iclamp(view - 3, 0, 1) +
           214 * rg_iclamp(view - 4, 0, 1);
}

// Sizes in the atlas' pictures, in texels of level 0: a drop's diameter, and the part of a view's
// row above the drop's way, and below it. This part differs by less than a texel between views.
#define STREAKS_DROP_PX 23.744f
#define STREAKS_RIM_PX  19.6f

// A drop's way in the atlas, in texels of level 0: 42.5 diameters, foreshortened.
RG_FN float streaks_way_px(int view)
{
    return 1009.12f - 60.8574f * rg_to_float(rg_iclamp(view, 0, 1)) -
           175.2318f * rg_to_float(rg_iclamp(view - 1, 0, 1)) -
           268.4708f * rg_to_float(rg_iclamp(view - 2, 0, 1)) -
           329.3281f * rg_to_float(rg_iclamp(view - 3, 0, 1));
}

// A place across `size` texels from `first` on. It stays half a texel inside, so that no neighbour
// bleeds in.
RG_FN float streaks_within(float first, float size, float share)
{
    return first + rg_clamp(share * size, 0.5f, size - 0.5f);
}

// A place across a column, in texels of a level of the full atlas, 0 to 5.
RG_FN float streaks_across(int column, float u, int level)
{
    int wide = STREAKS_CELL_PX >> level;
    return streaks_within(rg_to_float(column * wide), rg_to_float(wide), u);
}

// --- angles, in steps of the atlas ---

// 180 / pi / 20, written out, because compilers round constants that they compute in different
// ways.
#define STREAKS_STEPS_A_RADIAN 2.86478898f

RG_FN float streaks_steps(float radians)
{
    return radians * STREAKS_STEPS_A_RADIAN;
}

// The elevation of a direction of length 1 above the plane across the fall, in steps of 20 degrees.
RG_FN float streaks_elevation(v3 d)
{
    return streaks_steps(rg_atan2(-d.z, rg_sqrt(rg_max(1.0f - d.z * d.z, 0.0f))));
}

// The distance of a light to the left of a ray, across the fall.
RG_FN float streaks_to_left(v3 to_light, v3 ray)
{
    return to_light.x * ray.y - to_light.y * ray.x;
}

// The azimuth of a light from the viewer, to either side, in steps from the atlas' first one on.
RG_FN float streaks_azimuth(v3 to_light, v3 ray)
{
    float cosine = -(to_light.x * ray.x + to_light.y * ray.y);
    return streaks_steps(rg_atan2(rg_abs(streaks_to_left(to_light, ray)), cosine)) - 0.5f;
}

// The lower of the two views that an elevation lies between.
RG_FN int streaks_view(float elevation)
{
    return rg_imin(rg_to_int(elevation), STREAKS_VIEWS - 2);
}

// The time for which a drop covers the middle of its way in a view's pictures, as a share of the
// exposure.
RG_FN float streaks_steadiness(int view)
{
    return STREAKS_DROP_PX / streaks_way_px(view);
}

RG_FN float streaks_steadiness_at(float shown)
{
    int view = streaks_view(shown);
    float first = streaks_steadiness(view);
    return first + (streaks_steadiness(view + 1) - first) * (shown - rg_to_float(view));
}

#endif
