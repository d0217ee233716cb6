"""Baselines of gates: their contents, comparisons with them, and refusals."""
from fault import Fault

TESTS = ("command line, baselines", "command line, acts")

FILE, BASELINE = "harness/compare/gate/baseline/file.c", "harness/compare/gate/baseline/baseline.c"
COMPARE, RUN = "harness/compare/gate/run/agree.c", "harness/compare/gate/run/gate.c"
CHANGES, MAKE, TAKE = "harness/compare/gate/baseline/changes.c", "harness/compare/gate/baseline/make.c", "harness/compare/gate/baseline/take.c"
COMMAND, ALIKE = "harness/commands/comparing/baseline.c", "harness/compare/gate/sides/alike.c"

FIXED, FUNCTIONS, OF_FIXED = "harness/compare/gate/run/fixed.c", "harness/measure/serving/fixed.c", ("command line, fixed",)

ROWS = [
    Fault(FIXED, "const bool same = «was && is && !strcmp(was, is)»;", "true", "every digest of a fixed function is the baseline's", tests=OF_FIXED),
    Fault(FIXED, "if («*why»)\n        return skip(&h, RG_ENDING_SKIPPED", "false", "digests of another processor are compared", tests=OF_FIXED),
    Fault(FIXED, "rest + («llvm ? strspn(rest, \"0123456789.\") : 0»)", "0", "digests of another LLVM are not compared", tests=OF_FIXED),
    Fault(FIXED, "if (!was || (same && «row < 0»))", "true", "an expectation of a fixed function never passes unexpectedly", tests=OF_FIXED),
    Fault(FIXED, "return «steps <= rg_fixed_draws[draw].steps ? steps : 0»;", "steps", "two drivers may differ by anything where the APIs allow a little", tests=OF_FIXED),
    Fault(FIXED, "same || (steps && «!asked->strict»)", "true", "a strict gate lets two drivers differ", tests=OF_FIXED),
    Fault("harness/devices/drivers/apart.c", "if («!chooses(v, length)» &&", "true", "another driver is another setting, so that no digests are compared", tests=OF_FIXED),
    Fault("harness/compare/gate/cells/unused.c", "any = «rg_glob(row->cell, rg_gate_fixed_cell(i))»;", "false", "an expectation of a fixed function is said to be of no cell", tests=OF_FIXED),
    Fault(CHANGES, "    if («json_equal(was, is)»)\n        return 0;", "true", "another digest is no change of a baseline", tests=OF_FIXED),
    Fault(FUNCTIONS, "if («told->digest == told->other»)", "false", "a draw that leaves what its neighbour does is kept", tests=OF_FIXED),
    Fault(FUNCTIONS, "return failed < «MOST_FAILED»", "1000", "a driver that fails every draw is asked for all", tests=OF_FIXED),
    Fault(FUNCTIONS, "else if («told->is_constant»)", "false", "a picture that is the same everywhere is kept", tests=OF_FIXED),
    Fault(BASELINE, "«strchr(name, '@')» && rg_baseline_asks", "false", "a baseline starts programs"),
    Fault(FILE, "!read_format(&r, document) || «!rg_document_unseal(path, document, true, why)»)", "(json_object_del(document, \"checksum\"), false)", "a baseline that was edited is taken"),
    Fault(FILE, "return «format == RG_BASELINE_FORMAT» ||", "true", "a baseline of another version is taken"),
    Fault(FILE, "if (ok && «at < size») {", "false", "what follows a baseline is passed over"),
    Fault(FILE, "return «rg_baseline_find(baseline, row->cell, row->device) == row» ||", "true", "a cell that stands there twice is taken"),
    Fault(BASELINE, "«strcmp(settings, row->settings) != 0»)", "false", "other work is held against a baseline"),
    Fault("harness/compare/gate/cells/cells.c", "hash = XXH3_64bits_withSeed(line, strlen(line), «hash»);", "0", "the last parameter alone is in a cell's digest"),
    Fault(BASELINE, "if («!rg_baseline_find(baseline, cells->cells[i].name, baseline->devices[d].name)»)", "false", "a cell that the baseline lacks is passed over"),
    Fault(COMPARE, "if («is_same» && c->before->outcome == RG_OK)", "true", "no picture is looked at"),
    Fault(COMPARE, "if (is_same && «c->before->outcome == RG_OK»)", "true", "a driver that drew wrongly for the baseline is right"),
    Fault(COMPARE, "if («!strcmp(was, is->digest)»)", "true", "states are not looked at"),
    Fault(COMPARE, "return «have_alike_counters(&before->counters, &now->counters, &c->agreement)» &&", "true", "counters are not looked at"),
    Fault(COMPARE, "«have_alike_work(&before->work, &now->work, &c->agreement)»;", "true", "the work of a frame is not looked at"),
    Fault(COMPARE, "row->decision.ratio / «slower»;", "1", "yardsticks are told and do not count"),
    Fault(COMMAND, "if (is_there && «left_out != RG_EXIT_PASS»)", "false", "an update drops the rows of a device that fell", tests=("command line, baselines",)),
    Fault(ALIKE, "if («rg_memory_allows(bytes)»)", "true", "pictures are compared whatever they take", tests=("command line, gates",)),
    Fault(COMPARE, "if («one->value != other->value»)", "false", "counters that differ are alike"),
    Fault(RUN, "c->is_timed = «r->same_key[c->sides[RG_SIDE_B] - r->sides]»;", "true", "times under another key fail the gate"),
    Fault("harness/commands/comparing/gate.c", "        if («rg_baseline_asks(o->devices.names, name)»)\n            memcpy", "true", "devices that nobody asked for run"),
    Fault(CHANGES, "if («strcmp(then->picture, now->picture) != 0»)", "false", "another picture is no change"),
    Fault(CHANGES, "        if («rg_baseline_find(now, row->cell, row->device)»)\n            continue;", "row", "a cell that is gone is no change"),
    Fault(CHANGES, "if (!was || «json_equal(is->parts, was->parts)»)", "true", "another key is no change"),
    Fault(MAKE, "    «row->outcome = agreement.outcome;»\n", ";", "a picture that is wrong makes a baseline as one that is right"),
    Fault(TAKE, "rg_digest_of(words, «size», state->digest);", "0", "a state's digest is of nothing"),
    Fault(COMMAND, "if (is_there && «!o->update») {", "false", "a baseline is written over without being asked to"),
    Fault(COMMAND, "«(!before->is_there || rg_baseline_read(&before->baseline, path))»;", "true", "what is no baseline is written over"),
    Fault(COMMAND, "if («!is_as_before(o->output, before)»)", "false", "what another wrote meanwhile is written over"),
    Fault(COMMAND, "«rg_interrupted()» ? RG_EXIT_SIGNALLED + rg_interrupt_signal() : rg_exit_of_error();", "false", "a baseline that is interrupted ends as bad input does", tests=("command line, losses",)),
    Fault("harness/commands/comparing/gate.c", "bool any = «o->pictures_only || o->gtest.list»;", "true", "a gate passes for want of times"),
]
