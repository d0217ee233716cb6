"""Budgets of time: what cells are expected to take, what is chosen of tables, and when that is planned anew."""
from fault import Fault

TESTS = ("budget", "planner")

PLAN, CELL, BUDGET, PROBE = ("harness/tables/runs/plan.c", "harness/tables/runs/cell.c", "harness/tables/runs/budget.c",
                             "harness/tables/runs/probe.c")

ROWS = [
    Fault(PLAN, "for (enum stage stage = «FIRST»; stage < STAGES; stage++) {", "CLAIMED", "a dear table of claims comes before cheap ones"),
    Fault(PLAN, "«planned_s + step.more_s <= budget_s») {", "(planned_s + step.more_s <= budget_s || (stage = STAGES, false))", "the first step that is too dear ends the plan"),
    Fault(PLAN, "if («!c->devices && (!is_of_devices(stage) || stage == LAST)»)", "false", "tables that are left out are refined"),
    Fault(PLAN, "case DUE:\n        «c->size = t->due;»", ";", "pictures are smaller than a claim is about"),
    Fault(PLAN, "if (!any || «step.more_s < found->more_s»)", "true", "the last table is chosen first"),
    Fault(PLAN, "planned_s += «step.more_s»;", "0", "a plan has no end"),
    Fault(PLAN, "case CLAIMED:\n        if («!t->has_claims»)", "false", "claims need nothing first"),
    Fault(PLAN, "double cell_s = c->devices ? «t->check_s[c->size]» : 0;", "0", "the image to check by takes nothing"),
    Fault(CELL, "return «floor(frames / table->window_frames)» *", "0 * frames", "a window is never left"),
    Fault("harness/tables/claims/hearing.c", "if («claim->test == RG_CLAIM_RATE && h->result->size_divisor > 1») {", "false", "a rate of small pictures is judged", tests=("verdicts",)),
    Fault(BUDGET, "? «fmin(fmax(b->taken_s / b->due_s, 0.5), 4)» : 1;", "1.0", "slow cells are planned as if they were not", tests=("planner",)),
    Fault(BUDGET, "if («due_s <= left_s»)", "true", "nothing is planned anew", tests=("planner",)),
    Fault(BUDGET, "left_s = («b->seconds - passed_s(b)») / slow;", "b->seconds", "time does not pass", tests=("planner",)),
    Fault(BUDGET, "b->choices[i].expected_s «* had / fmax(wanted, 1)»;", "* 1.0", "rows that are not done were due", tests=("planner",)),
    Fault(BUDGET, "if («b->tables[i]->is_of_textures»)\n        return;", "false", "textures tell how slow frames are", tests=("planner",)),
    Fault(BUDGET, "if («!b->measured»)", "false", "a budget in which nothing is measured passes", tests=("planner",)),
    Fault(BUDGET, "b->measured += «had > 0»;", "1", "a table without a row counts as measured", tests=("planner",)),
    Fault(PROBE, "/ («pixels[smallest + 1] - pixels[smallest]»);", "1.0", "larger pictures take as long as smaller ones", tests=("planner",)),
    Fault(PROBE, "p->of_cpu.frame_ms[size] *= «(1 + more) / 2»;", "1 + 0 * more", "every row takes as long as the last", tests=("planner",)),
    Fault(PROBE, "(«1 + dry_share») * frames", "1 + 0 * dry_share", "a dry picture takes nothing", tests=("planner",)),
    Fault(PROBE, "probe->open_ms = fmax(opened - start «- probe->frame_ms», 0);", "- 0", "the first frame counts as opening", tests=("planner",)),
    Fault(PROBE, "if («!(ratio->frame_ms[RG_BUDGET_WHOLE] > 0)») {", "true", "every table looks at every device", tests=("planner",)),
    Fault(PROBE, "count += «!before || !now || strcmp(before, now) != 0»;", "1", "each level opens its texture", tests=("planner",)),
]
