#include "core/techniques/drops/drops.h"

#include "core/techniques/drops/instance.h"
#include "core/techniques/proof.h"

const struct rg_technique rg_technique_drops = {
    .name = "drops",
    .paper = "chin",
    .about = "drops that run down a pane, follow trails, merge and leave others behind",
    .shown = {"environment=street-night environment_px=512 aperture_mm=12 columns=500 rows=300",
              640, 384, 900, 0.9},
    .params = &drops_param_table,
    .proof = &drops_proof,
    .size = sizeof(struct drops),
    .settings = offsetof(struct drops, settings),
    .open = drops_open,
    .close = drops_close,
    .step = drops_step,
    .draw = drops_draw,
};
