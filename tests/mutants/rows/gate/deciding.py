"""Verdicts on two sides that were timed in turn, and the course that leads to them."""
from fault import Fault

TESTS = ("verdicts of two", "verdicts apart", "course of a gate", "verdicts on traces")

DECIDE, COURSE = "harness/judge/decide.c", "harness/judge/course.c"
JOURNAL = "harness/compare/gate/sides/journal.c"
APART, SHIFT = "harness/judge/apart.c", "harness/judge/shift.c"

ROWS = [
    Fault(DECIDE, "- log(a_ms[0]) «- log(a_ms[1])») / 2;", "- log(a_ms[0])", "a quad has A's first time twice"),
    Fault(DECIDE, "return rule->error / rule->rows / «rule->look_count» / 2;", "1", "each look spends all of the error"),
    Fault(DECIDE, "return rule->error / «rule->rows» / rule->look_count / 2;", "1", "each row spends all of the error"),
    Fault(DECIDE, "return rule->error / rule->rows / rule->look_count / «2»;", "1", "each end of an interval spends all of the error"),
    Fault(DECIDE, "if (low > excluded(rule) && «median > worth(rule)»)", "true", "what is small and sure is a regression"),
    Fault(DECIDE, "if («low > excluded(rule)» && median > worth(rule))", "true", "what is large and unsure is a regression"),
    Fault(DECIDE, "if (high < -excluded(rule) && «median < -worth(rule)»)", "true", "what is small and sure is an improvement"),
    Fault(DECIDE, "return «low > -margin» && high < margin", "true", "what may be faster by more than the margin passes"),
    Fault(DECIDE, "low > -margin && «high < margin» ?", "true", "what may be slower by more than the margin passes"),
    Fault(DECIDE, "if («!isfinite(d->smallest)»)\n        return 0;", "false", "one launch would have found any change"),
    Fault(DECIDE, "while («count >= LEAST_CORRELATED» &&", "true", "two launches are taken for linked", lives="of fewer than eight the bound by chance is above what a correlation reaches"),
    Fault(DECIDE, "«lag1_autocorrelation(logs, count) > fmax(CORRELATED, NORMAL_95 / sqrt(count))»)", "false", "linked launches are counted one by one"),
    Fault(DECIDE, "return ties > «COARSE» * count;", "0.5", "a coarse timer decides"),
    Fault(DECIDE, "(sorted[«(long)i * count / taken»] + sorted", "i", "of many launches the smallest alone tell the shift", tests=("verdicts of two",)),
    Fault(DECIDE, "+ sorted[«(long)j * count / taken»]) / 2", "j", "a launch's pairs are with the smallest alone", tests=("verdicts of two",)),
    Fault(DECIDE, "if («!d->is_coarse»)", "true", "a coarse timer is told and decides"),
    Fault(DECIDE, "return «DEVIATION_OF_MAD» * rg_median_at", "1", "the spread is half of what it is"),
    Fault(DECIDE, "(rg_gate_upper_quantile(rg_gate_tail(rule)) «+ quantile») * error;", "", "a change that is seen one time of two is said to be seen"),
    Fault(DECIDE, "d.error = «RG_GATE_SQRT_HALF_PI» * d.spread", "1", "a median is as sure as a mean"),
    Fault(DECIDE, "return fmax(by_interval, «by_worth»);", "by_interval", "what is no worth a word is said to be seen"),
    Fault(COURSE, "s->source->take(row, «draw(s, 2, row) & 1», &quads", "false", "A always comes first"),
    Fault(COURSE, "        «shuffle(s);»\n", ";", "rows have no order of their own in a launch"),
    Fault(COURSE, "if («quads->is_disturbed») {", "false", "disturbed quads count"),
    Fault(COURSE, "    c->is_again = true;\n    c->count = «c->look = 0»;", "0", "what is measured again has the look it was found with"),
    Fault(COURSE, "end(s, row, «verdict == found->before.verdict» ? RG_END_DECIDED", "true", "what was not found again counts"),
    Fault(COURSE, "row->disturbed > 32 && «row->disturbed > 3 * (row->launches - row->disturbed)»;", "true", "a third of the launches disturbed ends a row"),
    Fault(COURSE, "    else\n        «begin_again(s, row);»", "end(s, row, RG_END_DECIDED);", "what is found once counts"),
    Fault(COURSE, "if («why != RG_END_DECIDED»)", "false", "a course that was cut short has a verdict"),
    Fault(DECIDE, "return rule->is_apart ? «log1p(rule->margin / 2)» : 0;", "0", "what runs differ by as such is a regression", tests=("verdicts apart",)),
    Fault(DECIDE, "return log1p(«rule->is_apart» ? rule->margin : rule->margin / 2);", "false", "times that were taken apart tell half of the margin", tests=("verdicts apart",)),
    Fault(APART, "units.count = rg_gate_group(units.logs, units.count);", ";", "linked launches that were taken apart are counted one by one", tests=("verdicts apart",)),
    Fault(APART, "a.spread * a.spread / a.count «+ b.spread * b.spread / b.count»)", "", "what launches now scatter is no error", tests=("verdicts apart",)),
    Fault(APART, "rg_shift(a.logs, a.count, b.logs, b.count, «rg_gate_tail(rule)»);", "rule->error", "times that were taken apart spend all of the error at each end", tests=("verdicts apart",)),
    Fault(SHIFT, "(«u >= b» ? of_a * of[b][u - b] : 0)", "u > b", "a pair is missing from the distribution", tests=("verdicts apart",)),
    Fault(SHIFT, "+ «of_b» * of[b - 1][u];", "of_a", "two samples are taken for as large as each other", tests=("verdicts apart",)),
    Fault(SHIFT, "below + probability[k] <= «tail»)", "2 * tail", "each end of an interval spends all of the error", tests=("verdicts apart",)),
    Fault(SHIFT, "b[j] «- a[i]»;", "+ a[i]", "a shift is a sum", tests=("verdicts apart",)),
    Fault(SHIFT, ".high = k ? differences[«pairs - k»] : NAN,", "pairs - k - 1", "the upper end is one pair too low", tests=("verdicts apart",)),
    Fault(COURSE, "return «s->source->before»\n", "NULL", "times that were taken earlier are not looked at", tests=("verdicts apart",)),
    Fault(COURSE, "sample.logs[i] = «exp(sample.logs[i])»;", "sample.logs[i]", "the time before is told as a logarithm", tests=("verdicts apart",)),
    Fault(JOURNAL, "} else if («!json_equal(json_object_get(found, \"key\"), key)») {", "false", "what another gate kept is gone on with", tests=("command line, losses",)),
    Fault(JOURNAL, "if (!found || «count < 0») {", "false", "a journal that is none is gone on with", tests=("command line, losses",), lives="its checksum tells one that was damaged before"),
    Fault(JOURNAL, "if («was && !strcmp(was, code)»)\n", "was != NULL", "times that other code took are gone on with", tests=("command line, losses",)),
    Fault("harness/compare/gate/run/timing.c", "r->asked->baseline ? «lot->before» : NULL};", "NULL", "times that are kept are held against none of the baseline's", tests=("command line, baselines",)),
    Fault(JOURNAL, "    «json_array_append_new(launches, launch_json(launch, quads));»", ";", "a launch is not kept", tests=("command line, losses",)),
    Fault(JOURNAL, "if (take_launch(found, &number, quads) && «number == launch»)", "true", "each launch is the first that was kept", tests=("command line, losses",)),
    Fault("harness/compare/gate/run/choose.c", "+= «chosen->cell != NULL»;", "chosen->cell && c->shard_of[i] == shard->number", "each shard spends the whole error", tests=("shards of a gate",)),
]
