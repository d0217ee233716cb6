#include "core/techniques/shower/shower.h"

#include "core/techniques/proof.h"
#include "core/techniques/shower/instance.h"

const struct rg_technique rg_technique_shower = {
    .name = "shower",
    .paper = "ye",
    .about = "rain as a particle system, the traditional one and the improved one",
    .shown = {"wind_m_s=2", 960, 540, 120, 1.0},
    .params = &shower_param_table,
    .proof = &shower_proof,
    .size = sizeof(struct shower),
    .settings = offsetof(struct shower, settings),
    .open = shower_open,
    .close = shower_close,
    .step = shower_step,
    .draw = shower_draw,
};
