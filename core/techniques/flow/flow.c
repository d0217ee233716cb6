// flow: water on panes of glass or mirror as a cellular automaton on height maps. Stuppacher &
// Supan, "Rendering of Water Drops in Real-Time" (2007). The order of the stages is in step.c and
// draw.c, what they are bound to in open.c, formulas are in kernels/flow/, what the host computes
// in simulation.c and view.c, and docs/flow.md explains.
#include "core/techniques/flow/instance.h"

const struct rg_technique rg_technique_flow = {
    .name = "flow",
    .paper = "stuppacher",
    .about = "water flowing down panes of glass or mirror (Stuppacher & Supan 2007)",
    .params = &flow_param_table,
    .proof = &flow_proof,
    .size = sizeof(struct flow),
    .settings = offsetof(struct flow, settings),
    .open = flow_open,
    .step = flow_step,
    .draw = flow_draw,
};
