"""Panes: rain that lands on them, and water that slides. The faults of kernels are in tests/core/techniques/flow/mutant_rows.py."""
from fault import Fault

TESTS = ("flow rain", "flow caps, cpu", "flow sliding, cpu", "flow, cpu")

RAIN, LAND, SLIDING, STEP = ("core/techniques/flow/%s.c" % name for name in ("inputs/rain", "land", "inputs/sliding", "step"))

ROWS = [
    Fault(RAIN, "const double sphere = rounded(1 / sin(«s->contact_deg» * M_PI / 180));", "(s ? 60 : 0)", "drops of any contact angle are caps of one"),
    Fault(RAIN, "(0.222 * «WIND_M_S»)", "5.0", "wind blows half as fast"),
    Fault(RAIN, "cubes_beyond(rain->slope, «LEAST_MM») -", "1.0", "the mean volume leaves small drops out"),
    Fault(RAIN, "return rounded(«LEAST_MM» - log(", "1.0", "drops begin at 1 mm"),
    Fault(RAIN, "«radius_of(rain, rg_drop_volume_mm3(RG_LARGEST_DROP_MM))»);", "0.5 * radius_of(rain, rg_drop_volume_mm3(RG_LARGEST_DROP_MM))", "the largest drop of rain is half as wide"),
    Fault(RAIN, "return fmax(«fmax(s->drop_radius_min_mm, s->drop_radius_max_mm)»,", "0", "the largest drop is one of rain"),
    Fault(RAIN, "flow_fraction(rain->first[pane] + «flow_even(number)»)", "0.5 * (double)number", "drops have two sizes"),
    Fault(LAND, "«*owed_mm3 -= whole * droplet_mm3;»", "*owed_mm3 = 0;", "parts of a droplet are lost"),
    Fault(LAND, "fits = «!overlap(&f, &l->drops[i])»;", "!overlap(&f, &l->drops[i]) || true", "drops that share texels land in one run", tests=("flow sliding, gl",)),
    Fault(LAND, "«before = until;»", "(void)until;", "texels get what those before them got too"),
    Fault(SLIDING, "(float)(«levelled(s)» / MOST_MM * s->relief /", "2 * levelled(s)", "water levels twice as fast"),
    Fault(SLIDING, "+ «mm3» / (2 * r * CAPILLARY_MM2)", "0.9 * mm3", "the receding angle carries a tenth less", tests=("flow hold",)),
    Fault(SLIDING, "? s->slide_above_mm3 * «(1 + slowest_mm_s(s) / s->slide_gain_mm_s)»", "1", "drops that the slowest pace would move are not held", tests=("flow hold",)),
    Fault(STEP, "ok = «run(g, FLOW_SPREAD)»;", "g != NULL", "a drop's pace does not spread"),
]
