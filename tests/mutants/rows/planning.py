"""Budgets of time: what cells are expected to take, what is chosen of tables, and when that is planned anew."""
from fault import Fault

TESTS = ("budget", "planner", "time left")

PLAN, CELL, BUDGET, PROBE = ("harness/tables/runs/plan.c", "harness/tables/measuring/cell.c", "harness/tables/runs/budget.c",
                             "harness/tables/runs/probe.c")
LOOK, NEEDED, BAR = "harness/tables/runs/look.c", "harness/tables/runs/needed.c", "harness/tables/measuring/bar.c"

ROWS = [
    Fault(PLAN, "for (enum stage stage = «FIRST»; stage < STAGES; stage++) {", "CLAIMED", "a dear table of claims comes before cheap ones"),
    Fault(PLAN, "«planned_s + step.more_s <= most_s») {", "(planned_s + step.more_s <= most_s || (stage = STAGES, false))", "the first step that is too dear ends the plan"),
    Fault(PLAN, "if («!c->devices && (!is_of_devices(stage) || stage == LAST)»)", "false", "tables that are left out are refined"),
    Fault(PLAN, "const double most_s = is_of_least(stage) ? budget_s : «(1 - RESERVE)» * budget_s;", "1", "nothing is left for cells that take longer", tests=("budget",)),
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
    Fault(LOOK, "/ («pixels[smallest + 1] - pixels[smallest]»);", "1.0", "larger pictures take as long as smaller ones", tests=("planner",)),
    Fault(LOOK, "(«frames->open_ms < LATE_MS» ||", "true", "what a driver compiles once is expected of each cell", tests=("planner",)),
    Fault(PROBE, "ok = «probe_row(p, row)»;", "(p->of_row[row] = p->of_row[p->last], true)", "every row takes as long as the last", tests=("planner",)),
    Fault(PROBE, "dry.frame_ms *= «p->kind->dry_share»;", "0", "a dry picture takes nothing", tests=("planner",)),
    Fault(CELL, "f->open_ms = fmax(opened - start «- f->frame_ms», 0);", "- 0", "the first frame counts as opening", tests=("planner",)),
    Fault(LOOK, "if («!(known->frame_ms[RG_BUDGET_WHOLE] > 0)») {", "true", "every table looks at every device", tests=("planner",)),
    Fault("harness/tables/runs/textures.c", "count += «!before || !now || strcmp(before, now) != 0»;", "1", "each level opens its texture", tests=("planner",)),
    Fault(CELL, "fmax(frames - 2, 0) * «f->step_ms» +", "f->frame_ms", "frames that are simulated are drawn", tests=("budget",)),
    Fault(CELL, "return fmin(fmax(o->warm_up_frames, 1), «floor(o->warm_up_ms / ms) + 1»);", "20.0", "long frames warm up as often as short ones", tests=("budget",)),
    Fault(BUDGET, "1000 * (b->seconds «- least_behind_s(b, i)»);", "- 0", "a table may take what those behind it need", tests=("planner",)),
    Fault(BUDGET, "return s * «slowness(b)»;", "1", "slow cells leave the next tables too little", tests=("planner",)),
    Fault(PROBE, "if (!table->truth || «kind->has_truth»)", "false", "each table looks at its truth", tests=("planner",)),
    Fault(PROBE, "if («kind->is_known»)\n        return true;\n    if (!rg_look_row(p, p->cpu, p->last, p->smallest, without, &dry))", "false", "each table looks at a dry picture", tests=("planner",)),
    Fault(LOOK, "table.quick = «quick»;", "p->table->quick", "small pictures show as much as whole ones", tests=("planner",)),
    Fault(PLAN, "return table->truth && («size == RG_BUDGET_WHOLE» || rg_needs_truth(table));", "true", "errors of small pictures are measured that no claim is about", tests=("planner",)),
    Fault("harness/measure/measure.c", "all_ms += last == r->all ? «passes_ms(job, options)» : 0;", "0", "what telling passes apart takes is not told", tests=("time left",)),
    Fault(LOOK, "    if («found»)\n        return found;", "false", "each table looks at its other works", tests=("planner",)),
    Fault(LOOK, ".work = «p->work»}", "0", "other works are expected to take what the first does", tests=("planner",)),
    Fault(PROBE, "other ? rg_look_scaled(&first, «&other->by_first[device]») : first", "&known->of[0]", "a work takes what a device does", tests=("planner",)),
    Fault(BAR, "return planned > 0 ? «learned->parts[part].taken / planned» : 1;", "1", "rows that were opened tell nothing of those that are left", tests=("time left",)),
    Fault(BAR, "rg_progress_add(bar->progress, «more»);", "0", "a row that took longer counts as due", tests=("time left",)),
    Fault("harness/tables/runs/regenerate.c", "    if («!rg_interrupted()»)\n        return forecasts;", "true", "what an interrupted forecast had found is told as all", tests=("time left",)),
    Fault("harness/tables/runs/regenerate.c", "&tasks[«kind»].learned", "i", "each table learns for itself", tests=("time left",)),
    Fault("harness/tables/runs/regenerate.c", "forecasts[i].part = «part_of(tasks[i].table, o)»;", "(struct rg_table_part){.last_row = tasks[i].table->row_count - 1}", "full mode is expected to take what quick mode does", tests=("time left",)),
    Fault(PROBE, "add_row(&p, p.rows[row] ? «row» : p.last, &known, &costs);", "p.last", "each row is expected to take what the last one does", tests=("planner", "time left")),
    Fault("harness/tables/measuring/measure.c", "group->units = unit_ms > 0 ? «(int64_t)(ms / unit_ms)» : shown;", "shown / 3", "what open jobs take is told wrongly", tests=("time left",)),
]
