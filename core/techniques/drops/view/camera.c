// The pane's place in a picture, and the camera's place in the world.
#include <math.h>

#include "core/scene/matrix.h"
#include "core/techniques/drops/instance.h"

drops_view_params drops_view_of(const struct drops *d, int width, int height)
{
    const struct drops_settings *s = &d->settings;
    const float across = (float)s->columns / (float)width;
    const float down = (float)s->rows / (float)height;
    const float cells = across > down ? across : down;
    return (drops_view_params){
        .columns = s->columns,
        .rows = s->rows,
        .stride = d->params.stride,
        .is_of_ids = s->view == DROPS_VIEW_IDS,
        .cells_per_px = cells,
        .first_column = ((float)s->columns - cells * (float)width) / 2,
        .first_row = ((float)s->rows - cells * (float)height) / 2,
        .white_mm = 3,
        .cell_mm = (float)s->cell_mm,
        .width = width,
        .height = height,
        .critical = d->params.critical,
        .least_px = 1.5f,
    };
}

// The matrix from (right, down, towards the viewer) on the pane to the world, whose y is up; an
// upright pane is seen along -z. The camera keeps the pane's top upwards and looks through it. It
// looks upwards if the pane lies flat, with the water on its upper side.
static m4 to_world_of(const drops_params *params, double tilt_deg)
{
    const double tilt = tilt_deg * M_PI / 180;
    const double down_x = (double)params->down_x, down_y = (double)params->down_y;
    const double right[3] = {down_y, -down_x, 0};
    const double up[3] = {-down_x * sin(tilt), -down_y * sin(tilt), -cos(tilt)};
    // The world's z is right x up; the pane's y is flipped for the product.
    const double back[3] = {right[2] * up[1] - right[1] * up[2],
                            right[0] * up[2] - right[2] * up[0],
                            right[1] * up[0] - right[0] * up[1]};
    float rows[16] = {[15] = 1};
    for (int i = 0; i < 3; i++) {
        rows[i] = (float)right[i];
        rows[4 + i] = (float)up[i];
        rows[8 + i] = (float)back[i];
    }
    return rg_m4_of(rows);
}

drops_pane_params drops_pane_of(const struct drops *d, const drops_view_params *view)
{
    const struct drops_settings *s = &d->settings;
    const drops_params *params = &d->params;
    const struct rg_image_desc *background = &d->background->image->desc;
    const double mm_m = 1000, far_mm = s->background_m * mm_m;
    const double wide_mm = 2 * far_mm * tan(s->background_deg * M_PI / 360);
    const double texel_mm = wide_mm / background->width;
    return (drops_pane_params){
        .to_world = to_world_of(params, s->tilt_deg),
        .columns = s->columns,
        .rows = s->rows,
        .stride = params->stride,
        .rays = s->rays_px,
        .cell_mm = (float)s->cell_mm,
        .mm_px = (float)s->cell_mm * view->cells_per_px,
        .left_mm = (float)s->cell_mm * view->first_column,
        .top_mm = (float)s->cell_mm * view->first_row,
        .middle_x_mm = (float)(s->cell_mm * s->columns / 2),
        .middle_y_mm = (float)(s->cell_mm * s->rows / 2),
        .distance_mm = (float)s->distance_mm,
        .contact_mm = (float)s->contact_mm,
        .index = (float)s->refractive_index,
        .environment_px = s->environment_px,
        .has_background = s->background[0] != 0,
        .background_mm = (float)far_mm,
        .per_width = (float)(1 / wide_mm),
        .per_height = (float)(1 / (texel_mm * background->height)),
        .texels_mm = (float)(1 / texel_mm),
        .right_x = params->down_y,
        .right_y = -params->down_x,
        .down_x = params->down_x,
        .down_y = params->down_y,
    };
}
