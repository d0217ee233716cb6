// Opens cartoon on a device: the scene, stages.
#include "core/techniques/cartoon/instance.h"

#define AT(field) offsetof(struct cartoon, field)

static const struct rg_stage stages[CARTOON_STAGES] = {
    [CARTOON_RUN_FACES] = {"cartoon_faces", .params = AT(faces), .colour = "normal_map",
                           .depth = "depth_map", .depth_mode = RG_DEPTH_WRITE},
    [CARTOON_RUN_SHADE] = {"cartoon_gooch", .params = AT(shade), .colour = "target"},
};

bool cartoon_open(struct rg_instance *instance)
{
    struct cartoon *c = (struct cartoon *)instance;
    return cartoon_scene_open(c) && rg_open_stages(instance, stages, CARTOON_STAGES, c, NULL) >= 0;
}

void cartoon_close(struct rg_instance *instance)
{
    diorama_destroy(((struct cartoon *)instance)->diorama);
}
