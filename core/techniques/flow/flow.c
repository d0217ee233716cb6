// flow: water on panes of glass or mirror as a cellular automaton on height maps. Stuppacher &
// Supan, "Rendering of Water Drops in Real-Time" (2007). step.c and draw.c have the order of the
// stages, open.c their bindings, kernels/flow/ the formulas, simulation.c and view.c the host's
// computations. docs/flow.md explains.
#include "core/techniques/flow/instance.h"

const struct rg_technique rg_technique_flow = {
    .name = "flow",
    .paper = "stuppacher",
    .about = "water flowing down panes of glass or mirror (Stuppacher & Supan 2007)",
    .shown = {"environment=street-night environment_px=1024 resolution_px=512 glow=0.3 "
              "distance_mm=330 camera_elevation_deg=12",
              600, 600, 90, 1.1},
    .params = &flow_param_table,
    .proof = &flow_proof,
    .size = sizeof(struct flow),
    .settings = offsetof(struct flow, settings),
    .open = flow_open,
    .close = flow_close,
    .step = flow_step,
    .draw = flow_draw,
};
