"""Panes: rain that lands on them, and water that slides. The faults of kernels are in tests/core/techniques/flow/mutant_rows.py."""
from fault import Fault

TESTS = ("flow rain", "flow caps, cpu", "flow sliding, cpu", "flow, cpu")

RAIN, LAND, SLIDING, STEP = ("core/techniques/flow/%s.c" % name for name in ("inputs/rain", "land", "inputs/sliding", "step"))

ROWS = [
    Fault(RAIN, "const double angle = «s->contact_deg» * M_PI / 180, c = cos(angle);", "(s ? 60 : 0)", "drops of any contact angle have the volume of one"),
    Fault(RAIN, "const double angle = «s->contact_deg» * M_PI / 180, sphere_mm", "(s ? 60 : 0)", "drops of any contact angle are as high as one"),
    Fault(RAIN, "(0.222 * «WIND_M_S»)", "5.0", "wind blows half as fast"),
    Fault(RAIN, "cubes_beyond(slope, «LEAST_MM») -", "1.0", "the mean volume leaves small drops out"),
    Fault(RAIN, "const double from = exp(-slope * «LEAST_MM»), to", "1.0", "drops begin at 1 mm"),
    Fault(RAIN, "return fmax(fmax(s->drop_radius_min_mm, s->drop_radius_max_mm), «rain_mm»);", "0.5 * rain_mm", "the largest drop of rain is half as wide"),
    Fault(RAIN, "«fmax(s->drop_radius_min_mm, s->drop_radius_max_mm)», rain_mm);", "0", "the largest drop is one of rain"),
    Fault(RAIN, "(double)number * «GOLDEN»", "0.5", "drops have two sizes"),
    Fault(LAND, "«*owed_mm3 -= whole * droplet_mm3;»", "*owed_mm3 = 0;", "parts of a droplet are lost"),
    Fault(LAND, "fits = «!overlap(&f, &l->drops[i])»;", "!overlap(&f, &l->drops[i]) || true", "drops that share texels land in one run", tests=("flow sliding, gl",)),
    Fault(LAND, "«before = until;»", "(void)until;", "texels get what those before them got too"),
    Fault(SLIDING, "(float)(«levelled(s)» / MOST_MM * s->relief /", "2 * levelled(s)", "water levels twice as fast"),
    Fault(STEP, "ok = «run(g, FLOW_SPREAD_OUT) && run(g, FLOW_SPREAD_BACK)»;", "g != NULL", "a drop's pace does not spread"),
]
