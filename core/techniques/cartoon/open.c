// Opens cartoon on a device: its scene and stages.
#include "core/techniques/cartoon/instance.h"

#define AT(field) offsetof(struct cartoon, field)

static int style_of(const struct rg_instance *instance)
{
    return ((const struct cartoon *)instance)->settings.style;
}

static bool has_outlines(const struct rg_instance *i)
{
    return style_of(i) != CARTOON_GOOCH && style_of(i) != CARTOON_TONED;
}

static bool is_gooch(const struct rg_instance *i)
{
    return style_of(i) == CARTOON_GOOCH || style_of(i) == CARTOON_GOOCH_OUTLINES;
}

static bool is_toned(const struct rg_instance *i)
{
    return style_of(i) == CARTOON_TONED || style_of(i) == CARTOON_TONED_OUTLINES;
}

static bool is_paper(const struct rg_instance *i)
{
    return style_of(i) == CARTOON_OUTLINES;
}

static bool is_hatched(const struct rg_instance *i)
{
    return style_of(i) == CARTOON_HATCHING;
}

static bool asks_faces(const struct rg_instance *i)
{
    return ((const struct cartoon *)i)->settings.rain.collide == CARTOON_COLLIDE_CORRECT;
}

#define ONTO_NUMBERS .colour = "face_map", .depth = "number_depth", .depth_mode = RG_DEPTH_WRITE
#define ONTO_MAPS    .colour = "normal_map", .depth = "depth_map", .depth_mode = RG_DEPTH_WRITE
#define PICTURE      .params = AT(shade), .colour = RG_BACKGROUND

static const struct rg_stage stages[CARTOON_STAGES] = {
    [CARTOON_RUN_SOLIDS] = {"cartoon_faces", .params = AT(solids), ONTO_MAPS, .cull = RG_CULL_BACK},
    [CARTOON_RUN_THIN] = {"cartoon_faces", .params = AT(thin), ONTO_MAPS},
    [CARTOON_RUN_SOLID_NUMBERS] = {"cartoon_numbers", asks_faces, .params = AT(solids),
                                   ONTO_NUMBERS, .cull = RG_CULL_BACK},
    [CARTOON_RUN_THIN_NUMBERS] = {"cartoon_numbers", asks_faces, .params = AT(thin), ONTO_NUMBERS},
    [CARTOON_RUN_INK] = {"cartoon_ink", has_outlines, .params = AT(outlines), .depth = "ink",
                         .depth_mode = RG_DEPTH_WRITE},
    [CARTOON_RUN_GOOCH] = {"cartoon_gooch", is_gooch, PICTURE},
    [CARTOON_RUN_TONES] = {"cartoon_tones", is_toned, PICTURE},
    [CARTOON_RUN_PAPER] = {"cartoon_paper", is_paper, PICTURE},
    [CARTOON_RUN_HATCHING] = {"cartoon_hatching", is_hatched, PICTURE},
};

bool cartoon_open(struct rg_instance *instance)
{
    struct cartoon *c = (struct cartoon *)instance;
    return cartoon_scene_open(c) && rg_layer_open(&c->layer, instance) &&
           (c->first_stage = rg_open_stages(instance, stages, CARTOON_STAGES, c, NULL)) >= 0 &&
           cartoon_rain_open(
               &c->rain, instance, &c->settings.rain, c->settings.seed,
               &(struct cartoon_rain_scene){c->diorama, &c->view.camera, &c->view.to_clip}) &&
           cartoon_water_open(&c->water, &c->rain, &c->settings.water);
}

void cartoon_close(struct rg_instance *instance)
{
    struct cartoon *c = (struct cartoon *)instance;
    cartoon_rain_close(&c->rain);
    diorama_destroy(c->diorama);
}
