// One query for each drop, as in the paper: the device rasterises the drop's tessellated bounding
// sphere, and counts its visible samples. The paper gives no tessellation. Ours has CARTOON_SLICES
// by CARTOON_STACKS quads, without those that are turned away, so that no pixel counts twice. A
// drop may take more items, because the API's queries begin at multiples of 32; these draw nothing.
#include "kernels/cartoon/rain/params.h"
#include "kernels/dialect/draw/triangle.h"

#define RG_PARAMS  cartoon_rain_params
#define RG_SLOTS   IN(1, uint, living) IN(2, cartoon_raindrop, raindrops) IN(3, float, sphere)
#define RG_CORNERS 4

RG_STRUCT(cartoon_facet)
{
    rg_planes planes;
};
#define RG_RECORD cartoon_facet
#include "kernels/dialect/draw/draw.h"

#include "kernels/cartoon/rain/view.h"

#define CARTOON_SLICES 6
#define CARTOON_STACKS 4

// Corner k of the sphere's mesh, rings of CARTOON_SLICES from the lower pole to the upper one.
RG_FN rg_corner cartoon_on_sphere(rg_ctx rg, cartoon_rain_params p, v3 middle, float radius, int k)
{
    return m4_project(p.to_clip, v3_make(middle.x + radius * sphere_at(rg, 3 * k),
                                         middle.y + radius * sphere_at(rg, 3 * k + 1),
                                         middle.z + radius * sphere_at(rg, 3 * k + 2)));
}

// The drop of facet i: i / p.facets. Compilers vectorise no division of integers by a variable, so
// floats divide: first i, then the remainder, which is small enough to be exact.
RG_FN int cartoon_facet_drop(cartoon_rain_params p, int i)
{
    float facets = rg_to_float(p.facets);
    int nth = rg_to_int(rg_to_float(i) / facets);
    return nth + rg_to_int(rg_floor(rg_to_float(i - nth * p.facets) / facets));
}

// The lowest ring begins with its upper corners: a facet's first three corners say which way it
// turns, so they must not be in one place.
RG_FN rg_item cartoon_facet_of(rg_ctx rg, cartoon_rain_params p, int i)
{
    int nth = cartoon_facet_drop(p, i);
    int facet = i - nth * p.facets;
    int ring = rg_imin(facet / CARTOON_SLICES, CARTOON_STACKS - 1);
    int slice = facet % CARTOON_SLICES;
    int next = slice == CARTOON_SLICES - 1 ? 0 : slice + 1;
    cartoon_raindrop d = raindrops_at(rg, rg_to_int(living_at(rg, nth)));
    v3 middle = v3_make(d.x, d.y, d.z);
    cartoon_spot s = cartoon_spot_of(p, middle);
    float radius = cartoon_bound_m(p, s.distance_m);
    int lower = ring * CARTOON_SLICES;
    int upper = lower + CARTOON_SLICES;
    bool is_lowest = ring == 0;
    int is_facet = facet < CARTOON_SLICES * CARTOON_STACKS ? 1 : 0;
    int is_drop = d.state == CARTOON_DROP ? 1 : 0;
    rg_item t;
    t.alive = is_facet & is_drop & s.inside;
    t.a = cartoon_on_sphere(rg, p, middle, radius, is_lowest ? upper + next : lower + slice);
    t.b = cartoon_on_sphere(rg, p, middle, radius, is_lowest ? upper + slice : lower + next);
    t.c = cartoon_on_sphere(rg, p, middle, radius, is_lowest ? lower + slice : upper + next);
    t.d = cartoon_on_sphere(rg, p, middle, radius, is_lowest ? lower + next : upper + slice);
    return t;
}

RG_DRAW_ITEM(cartoon_spheres)
{
    return cartoon_facet_of(rg, p, i);
}

RG_DRAW_RECORD(cartoon_spheres)
{
    cartoon_facet r;
    r.planes = rg_planes_of(draw, cartoon_facet_of(rg, p, i));
    return r;
}

RG_DRAW_FRAGMENT(cartoon_spheres)
{
    return rg_fragment_make(rg_rgba(0.0f, 0.0f, 0.0f, 0.0f), rg_planes_depth(r.planes, px, py));
}
