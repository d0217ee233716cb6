// A drop as it is seen: its two ends on the screen, and how much of a pixel's width it fills.
// Programs include this file after their slots, which have
//   IN(1, float, particles)  the planes x, y, z and fall
#ifndef RG_KERNELS_SHOWER_VIEW_LOOK_H
#define RG_KERNELS_SHOWER_VIEW_LOOK_H

RG_STRUCT(shower_drop)
{
    rg_corner low; // in clip space
    rg_corner high;
    float low_x, low_y; // pixels from the target's middle, y down
    float high_x, high_y;
    float width_px;
    float depth; // of its lower end
    int alive;
};

RG_FN shower_drop shower_drop_at(rg_ctx rg, shower_view_params p, int i)
{
    int slots = p.rain.slots;
    v3 at = v3_make(particles_at(rg, SHOWER_X * slots + i), particles_at(rg, SHOWER_Y * slots + i),
                    particles_at(rg, SHOWER_Z * slots + i));
    float fall = particles_at(rg, SHOWER_FALL * slots + i);
    shower_drop d;
    d.alive = fall > 0.0f ? 1 : 0;
    d.low = m4_project(p.to_clip, at);
    d.high = m4_project(p.to_clip, v3_add(at, shower_upwards(p.rain, at, fall)));
    float low_w = 1.0f / rg_max(d.low.w, RG_LEAST_W);
    float high_w = 1.0f / rg_max(d.high.w, RG_LEAST_W);
    d.low_x = d.low.x * low_w * p.half_width;
    d.low_y = d.low.y * low_w * p.half_height;
    d.high_x = d.high.x * high_w * p.half_width;
    d.high_y = d.high.y * high_w * p.half_height;
    float share = shower_share(p.rain, shower_ahead(p.rain, at.x, at.z));
    d.width_px = p.rain.width_m * share * p.focal_px * low_w;
    d.depth = d.low.z * low_w;
    return d;
}

// A corner (x_px, y_px) beside an end.
RG_FN rg_corner shower_beside_end(shower_view_params p, rg_corner end, float x_px, float y_px)
{
    return rg_corner_make(end.x + x_px / p.half_width * end.w, end.y + y_px / p.half_height * end.w,
                          end.z, end.w);
}

RG_FN rg_item shower_item(shower_view_params p, shower_drop d, float x_px, float y_px)
{
    rg_item t;
    t.alive = d.alive;
    t.a = shower_beside_end(p, d.low, -x_px, -y_px);
    t.b = shower_beside_end(p, d.high, -x_px, -y_px);
    t.c = shower_beside_end(p, d.high, x_px, y_px);
    t.d = shower_beside_end(p, d.low, x_px, y_px);
    return t;
}

// The share that a drop hides of a pixel which its texture fills: drops narrower than a pixel hide
// less.
RG_FN float shower_opacity(shower_view_params p, shower_drop d)
{
    return p.opacity * rg_min(d.width_px, 1.0f);
}

#endif
