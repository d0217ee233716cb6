"""Budgets of time: what cells are expected to take, what is chosen of tables, and when that is planned anew."""
from fault import Fault

TESTS = ("budget",)

PLAN, CELL = "harness/tables/runs/plan.c", "harness/tables/runs/cell.c"

ROWS = [
    Fault(PLAN, "for (enum stage stage = «FIRST»; stage < STAGES; stage++) {", "CLAIMED", "a dear table of claims comes before cheap ones"),
    Fault(PLAN, "«planned_s + step.more_s <= budget_s») {", "(planned_s + step.more_s <= budget_s || (stage = STAGES, false))", "the first step that is too dear ends the plan"),
    Fault(PLAN, "if («!c->devices && (!is_of_devices(stage) || stage == LAST)»)", "false", "tables that are left out are refined"),
    Fault(PLAN, "case DUE:\n        «c->size = t->due;»", ";", "pictures are smaller than a claim is about"),
    Fault(PLAN, "if (!any || «step.more_s < found->more_s»)", "true", "the last table is chosen first"),
    Fault(PLAN, "planned_s += «step.more_s»;", "0", "a plan has no end"),
    Fault(PLAN, "case CLAIMED:\n        if («!t->has_claims»)", "false", "claims need nothing first"),
    Fault(PLAN, "double cell_s = c->devices ? «t->check_s[c->size]» : 0;", "0", "the image to check by takes nothing"),
    Fault(CELL, "fmax(floor(o->job_ms / (ms * a_sample)), «o->least_samples»)", "0", "long frames have fewer samples than six"),
    Fault(CELL, "return «floor(frames / table->window_frames)» *", "0 * frames", "a window is never left"),
    Fault("harness/tables/claims/hearing.c", "if («claim->test == RG_CLAIM_RATE && h->result->size_divisor > 1») {", "false", "a rate of small pictures is judged", tests=("verdicts",)),
]
