"""Budgets of time: the order in which cells are measured, the skipped ones, and the time left."""
from fault import Fault

TESTS = ("priority", "within a budget", "time left", "foreseen")

ORDER, CELL, BUDGET = "harness/tables/runs/order.c", "harness/tables/measuring/cell.c", "harness/tables/runs/budget.c"
COMPILE, PROGRESS, MEASURE = "harness/tables/runs/compile.c", "harness/console/progress.c", "harness/tables/measuring/measure.c"

ROWS = [
    Fault(ORDER, "for (enum rg_turn turn = «0»; turn < RG_TURNS && !any; turn++)", "RG_TURN_NEEDED", "nothing comes first", tests=("priority",)),
    Fault(ORDER, "if (!*any || «is_cheaper(order, &step, found)»)", "true", "the last table is the first", tests=("priority",)),
    Fault(ORDER, "return adds && «(turn == RG_TURN_FIRST) == !s->rows»;", "true", "tables of which nothing is there are refined", tests=("priority",)),
    Fault(ORDER, "turn == RG_TURN_CLAIMED ? «s->has_claims»\n", "true", "claims need nothing first", tests=("priority",)),
    Fault(ORDER, "others & ~s->share.devices & «~s->tried[turn]» & 1u << d;", "~0u", "what was tried is tried for ever", tests=("priority",)),
    Fault(ORDER, ": scaled_s > 0          ? «scaled_s»\n", "0", "others of a technique tell nothing", tests=("priority",)),
    Fault(ORDER, ": elsewhere_s > 0       ? «elsewhere_s»\n", "0", "what a cell took elsewhere tells nothing", tests=("priority",)),
    Fault(ORDER, "samples = «before->all_samples ? 1 : 2»;", "1", "more samples take no longer", tests=("priority",)),
    Fault(ORDER, "    step->share.divisor = «2»;", "1", "whole pictures keep others out", tests=("priority",)),
    Fault(ORDER, "has_part ? left_s / «waiting(order, RG_TURN_FIRST)» : left_s;", "1", "the first table has all of the time", tests=("priority",)),
    Fault(BUDGET, "while (ok && !rg_interrupted() && (is_first || «left_s(b) > 0») &&", "true", "a budget has no end", tests=("within a budget",)),
    Fault(BUDGET, "if (!is_first && «step.expected_s >= left_s(b)») {", "false", "what would not end in time is begun", tests=("within a budget",)),
    Fault(BUDGET, ".end_ms = «options->begin_ms» + 1000 * options->budget_s};", "rg_now_ms()", "a budget begins with the first table", tests=("within a budget",)),
    Fault(BUDGET, "if («now_ms <= b->end_ms» || rg_interrupted())", "true", "a budget that is too small is taken", tests=("within a budget",)),
    Fault(BUDGET, "(start_ms - begin_ms + «parts * (now_ms - start_ms)») / 1000);", "0", "the number that is told is too small", tests=("within a budget",)),
    Fault(BUDGET, "adds ? «is_there» || !rows[row] : !is_there;", "false", "rows that are there are measured again", lives="it takes time, and gives no other rows"),
    Fault(BUDGET, "        rg_result_take(&joined, «old»);", "part", "what was measured before is lost", tests=("within a budget",)),
    Fault(BUDGET, "(rg_turns[step->turn].is_whole && «rows < s->rows»)) {", "false", "a part of a device takes the place of all others", tests=("within a budget",)),
    Fault(MEASURE, "if («!m->deadline || !m->rows_opened»)", "true", "rows are begun behind the end", tests=("within a budget",)),
    Fault(MEASURE, "rg_now_ms() + «open_ms» + rows * row_ms", "0", "the samples of what is open take nothing", tests=("within a budget",)),
    Fault(PROGRESS, "if («p->is_unlike» || p->due_ms < 0)", "false", "tables that follow are taken to be like the first", tests=("progress", "time left")),
    Fault(MEASURE, "? fmax(«(now_ms - m->first_ms) / done_ms», 1) : 0;", "0.0", "what is left goes on as the warm-up did", tests=("time left",)),
    Fault(MEASURE, "    rg_progress_due(m.bar, «-1»);", "1e7", "a time is told before rows are open", tests=("time left",)),
    Fault(MEASURE, "ms += is_whole ? 0 : «rg_jobs_expected_ms(job, 1, &m->options)»;", "1", "what open jobs take is not told", tests=("time left",)),
    Fault("harness/measure/measure.c", "return «open_ms * (1 + (double)s->samples / (fit > 1 ? fit : 1))»;", "0.0", "windows that are opened anew take no time", tests=("time left",)),
    Fault(CELL, "return «floor(frames / table->window_frames)» *", "0 * frames", "a window is never left"),
    Fault(COMPILE, "if («devices->devices[d]->backend->package»)", "\"\"", "what has no driver is opened beforehand", tests=("compiling beforehand",)),
    Fault(COMPILE, "if («k < jobs->table_count» || tables[i]", "false", "each table of a technique is opened beforehand", tests=("compiling beforehand",)),
    Fault(COMPILE, "return (int)«fmax(1, fmin(fmin(machine.cores_allowed, quota), MAX_AT_ONCE))»;", "1", "drivers compile one after the other", tests=("compiling beforehand",)),
    Fault(COMPILE, "return (int)«fmax(1, fmin(fmin(machine.cores_allowed, quota), MAX_AT_ONCE))»;", "MAX_AT_ONCE", "drivers compile all at once", tests=("compiling beforehand",)),
    Fault(COMPILE, "if («status» && exit != RG_EXIT_UNSUPPORTED", "0", "what is not compiled is not told", tests=("compiling beforehand",)),
    Fault(COMPILE, "status && «exit != RG_EXIT_UNSUPPORTED»", "true", "what is unsupported is told as a failure", tests=("compiling beforehand",)),
    Fault(COMPILE, "begun < count_of(jobs) && «!rg_interrupted()») {", "true", "what was interrupted begins the rest", tests=("compiling beforehand",)),
    Fault("harness/tables/sweep/plan.c", "probe_settings(device, &subject, «rg_cell_steps(table)», probe)", "1", "a sweep is of the first frames", tests=("foreseen",)),
    Fault(CELL, "*step_ms = passed_ms «/ fmax(done, 1)»;", "/ 1", "each step takes what all do", tests=("foreseen",)),
    Fault(CELL, "done < steps && «passed_ms < LONGEST_MS» &&", "true", "looking takes as long as what it foresees", tests=("foreseen",)),
    Fault(CELL, "passed_ms < LONGEST_MS && «!rg_interrupted()») {", "true", "an interrupted look goes on", tests=("foreseen",)),
    Fault(CELL, "return (int)fmax(«rg_cell_check_frames(table) - 2», 1);", "1", "no rain builds up before it is looked at", tests=("foreseen",)),
    Fault(CELL, "(steps == 1 || «rg_session_frames(session, 1, &f->frame_ms)»)", "true", "a frame takes what it did before rain built up", tests=("foreseen",)),
    Fault(CELL, "f->open_ms = fmax(opened - start «- f->frame_ms», 0);", "- 0", "the first frame counts as opening", tests=("foreseen",)),
    Fault(CELL, "fmax(frames - 2, 0) * «f->step_ms» +", "f->frame_ms", "frames that are simulated are drawn", tests=("foreseen",)),
    Fault(CELL, "return fmin(fmax(o->warm_up_frames, 1), «floor(o->warm_up_ms / ms) + 1»);", "20.0", "long frames warm up as often as short ones", tests=("foreseen",)),
]
