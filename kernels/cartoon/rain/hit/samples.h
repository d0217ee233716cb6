// The samples of a drop's bounding sphere that the scene does not hide. The paper counts them by an
// occlusion query (section 4). Reads the slot depth_map.
#ifndef RG_KERNELS_CARTOON_RAIN_HIT_SAMPLES_H
#define RG_KERNELS_CARTOON_RAIN_HIT_SAMPLES_H

#include "kernels/cartoon/rain/view.h"

// Counts the pixels with their centre in the sphere's disc on the screen, in which the sphere's
// near side lies before the scene.
RG_FN int cartoon_samples(rg_ctx rg, cartoon_rain_params p, cartoon_spot s)
{
    float radius_m = cartoon_bound_m(p, s.distance_m);
    float m_px = s.distance_m / p.focal_px; // width of a pixel at the drop
    float radius_px = radius_m / m_px;
    int left = rg_imax(rg_to_int(rg_floor(s.x_px - radius_px + 0.5f)), 0);
    int right = rg_imin(rg_to_int(rg_floor(s.x_px + radius_px - 0.5f)), p.width - 1);
    int top = rg_imax(rg_to_int(rg_floor(s.y_px - radius_px + 0.5f)), 0);
    int bottom = rg_imin(rg_to_int(rg_floor(s.y_px + radius_px - 0.5f)), p.height - 1);
    int count = 0;
    for (int y = top; y <= bottom; y++) {
        float down_m = (rg_to_float(y) + 0.5f - s.y_px) * m_px;
        for (int x = left; x <= right; x++) {
            float across_m = (rg_to_float(x) + 0.5f - s.x_px) * m_px;
            float bulge = radius_m * radius_m - across_m * across_m - down_m * down_m;
            float near_m = s.distance_m - rg_sqrt(rg_max(bulge, 0.0f));
            float depth = p.depth_at + p.depth_by / near_m;
            if (bulge >= 0.0f && depth < depth_map_texel(rg, x, y, 0, 0).r)
                count += 1;
        }
    }
    return count;
}

#endif
