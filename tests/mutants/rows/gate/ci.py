"""What runs a gate in CI: googletest's flags and shards, pictures that differ, patches of what is expected."""
from fault import Fault

TESTS = ("command line, ci", "command line, reports")

SHARDS, PARSE, FLAGS = "harness/compare/gate/report/shards.c", "harness/cli/parse.c", "harness/commands/comparing/gtest.c"
RUN, AGREE, CASES, SIDES = (f"harness/compare/gate/run/{name}.c" for name in ("gate", "alike", "cases", "sides"))
STRAYS = "harness/compare/gate/run/strays.c"
CELLS, AGAIN = (f"harness/compare/gate/cells/{name}.c" for name in ("cells", "again"))
FILE, AGAINST = "core/base/files/file.c", "harness/compare/gate/baseline/against.c"
COMMAND = "harness/commands/comparing/gate.c"
PICTURES, OUTPUTS = "harness/compare/gate/pictures/pictures.c", "harness/commands/comparing/outputs.c"

ROWS = [
    Fault(OUTPUTS, "«spares_kept(outputs->pictures, file)»;", "true", "a gate's journal replaces its cells", tests=("command line, baselines",)),
    Fault(CASES, "return «c->times.is_ours» || c->times.side != RG_SIDE_B;", "false", "a side that is no raingauge is expected to fail", tests=("command line, gates",)),
    Fault(CASES, "c->times.is_ours || «c->times.side != RG_SIDE_B»;", "false", "A's crash while it is timed is what was expected of B", tests=("command line, gates",)),
    Fault(CASES, "«device != own» : strcmp", "false", "A's crash is what was expected of B", tests=("command line, gates",)),
    Fault(AGREE, "agreement->is_ours = «failure.fault == RG_FAULT_INPUT» ||", "false", "a file that is missing is an expected failure", tests=("command line, gates",)),
    Fault(AGREE, "agreement->is_ours = «true»;", "false", "a cell without rain is an expected failure", tests=("command line, gates",)),
    Fault(CASES, "return «kind == RG_KIND_FAILURE || kind == RG_KIND_ERROR» ? own", "own != RG_ENDING_PASS", "what has expired and is faster passes", tests=("command line, gates",)),
    Fault(FILE, "return name_a && name_b && «!strcmp(name_a, name_b)» && lead", "false", "a report replaces another whose file was not there yet", tests=("command line, gates",)),
    Fault(FILE, "&& «lead_to_one(folder_a, folder_b)»;", "true", "files of one name in two folders are one", tests=("command line, gates",)),
    Fault(OUTPUTS, "«spares(summary_path(outputs), file)» &&", "true", "a summary is appended to the cells", tests=("command line, gates",)),
    Fault(OUTPUTS, "«spares(summary, outputs->bmf)» &&", "true", "a summary is appended to a report", tests=("command line, gates",)),
    Fault(AGAINST, "c->agreement.is_ours |= «c->agreement.outcome == RG_FAIL»;", "false", "a driver that does not load is a picture that was expected to differ", tests=("command line, gates",)),
    Fault(SHARDS, "if («!path || !*path»)", "true", "no runner is told that shards are understood"),
    Fault(SHARDS, "    if («!has_total || !has_index»)", "false", "half of a shard is taken for all of it"),
    Fault(SHARDS, "&& «value >= 0» && value", "true", "shards are counted below 0"),
    Fault(SHARDS, "(«shards->index < shards->total» ||", "true", "a shard beyond the last passes"),
    Fault(RUN, "«gate->chosen++ % asked->shards.total» == asked->shards.index;", "gate->chosen++ % 2", "shards have cases of each other"),
    Fault(RUN, "return rg_exit_with(RG_EXIT_PASS, «compared»);", "1", "a gate that compared nothing passes", tests=("command line, vacuous", "command line, ci")),
    Fault(RUN, "rg_report_count(report, RG_ENDING_EXPECTED_FAILURE) - «report->idle_count»;", "0", "what fell as expected counts as compared", tests=("command line, gates", "command line, vacuous")),
    Fault(RUN, "    if («!any || is_told»)\n", "true", "a required device of which nothing was compared passes", tests=("command line, vacuous",)),
    Fault(RUN, "    clean = «rg_texts_clean(name, true)»;", "strdup(name)", "a name that is listed is not known to a filter"),
    Fault(PARSE, "if (!flag || «holds»)", "true", "a flag that is 0 holds"),
    Fault(FLAGS, "char *value = «*text» ? NULL", "false", "the environment goes before a flag"),
    Fault(FLAGS, "if («is_folder»)", "false", "a report's folder is not made"),
    Fault(FLAGS, "is_folder ? «\"raingauge.xml\"» : \"\"", "\"\"", "a report is written over its folder"),
    Fault(AGREE, "agreement->has_pictures = «rg_gate_pictures_write(agreement->folder, agreement->name,\n                                                             &a->picture, &b->picture, &c)»;", "true", "reports name pictures that are not there"),
    Fault(AGREE, "if («!ok» && agreement->folder)", "true", "pictures that are the same are written"),
    Fault(AGREE, "agreement->would_hold = «rg_tiers_strictest(tiers)»;", "RG_TIER_COUNT", "no command says what a tier that would hold costs", tests=("command line, gates",)),
    Fault(CASES, "rg_gate_cell_again(out, c->cell, «agreement->truth», rg_gate_case_device(c));", "c->devices[0]", "a baseline's device is compared with itself again", tests=("command line, gates",)),
    Fault("harness/compare/gate/text/shell.c", "        if («text[i] == '\\''»)", "0", "a quote in a device's name ends the shell's", tests=("command line, gates",)),
    Fault(AGAIN, "    fprintf(out, \"raingauge diff %s --size %dx%d --frame %d\", cell->technique->name, cell->width,\n            cell->height, «cell->frames»);", "60", "another frame is compared again", tests=("command line, gates",)),
    Fault(AGAIN, "        «rg_shell_word(out, word, length);»", "(void)word;", "a cell is compared again without its settings", tests=("command line, gates",)),
    Fault(RUN, "        if («!c->is_compared && !c->is_skipped» &&\n", "false", "what is expected of a device that is not there goes", tests=("command line, reports",)),
    Fault(COMMAND, "    if («o->against»)\n        rg_gate_pairs_left", "false", "what is expected of devices that one build was not asked for goes", tests=("command line, reports",)),
    Fault(COMMAND, "if («!rg_baseline_asks(o->devices.names, in->baseline.devices[i].name)»)", "false", "what is expected of devices that a baseline was not asked for goes", tests=("command line, reports",)),
    Fault(PICTURES, "for (int i = 0; ok && i < «2»; i++) {", "1", "B's picture is not written"),
    Fault(CASES, "if («broke_off(c)»)\n        return ending_of_outcome", "false", "a side that does not start any more leaves it open", tests=("command line, gates",)),
    Fault(CASES, ".outcome = «broke_off(c)» ?", "false", "a cell that broke off while it was timed passed, to the expectations", tests=("command line, gates",)),
    Fault(CASES, "if («c->agreement.has_pictures»)", "false", "reports name no picture"),
    Fault("harness/commands/comparing/outputs.c", "const size_t stem = «end && !strcmp(end, \".xml\")» ?", "false", "pictures lie in a folder with the report's ending"),
    Fault(OUTPUTS, "«adds_new»,", "false", "what nothing expects is not in the patch"),
    Fault(OUTPUTS, "return !report || !*report || «!file || !rg_file_is_same(report, file)» ||", "true", "a report replaces a file that is read", tests=("command line, baselines",)),
    Fault(AGREE, "} else if («rg_comparison_outcome(&c, owed) == RG_NOTHING») {", "false", "a cell without rain is a difference", tests=("command line, gates",)),
    Fault(SIDES, "else if («!strcmp(name.name, other.name)»)", "false", "cells of a device that is named twice share a name", tests=("command line, gates",)),
    Fault(SIDES, "if («!seen[i].is_there»)", "false", "a device that is missing and required skips its cells", tests=("command line, gates",)),
    Fault(SIDES, "        all = «is_there(seen, count, name.name, report) && all»;", "all && is_there(seen, count, name.name, report)", "of two devices that are missing one is told", tests=("command line, gates",)),
    Fault(SIDES, "                                                   .message = «rg_last_error()»,", "\"\"", "a report does not say which device is missing", tests=("command line, gates", "command line, ci")),
    Fault(RUN, "gate->is_told = «gate->report.case_count && set_passport(&r)»;", "false", "a device that is missing leaves no report", tests=("command line, gates", "command line, ci")),
    Fault(AGAINST, "gate->is_told = «ok && !are_there && gate->report.case_count»;", "false", "a device of a baseline that is missing leaves no report", tests=("command line, gates",)),
    Fault(COMMAND, "exit = rg_exit_worse(exit, «rg_exit_of_error()»); // a full disk", "RG_EXIT_FAIL", "a full disk is a regression", tests=("command line, gates",)),
    Fault(RUN, "return rg_exit_worse(found == RG_EXIT_PASS ? rg_gate_exit(request, gate) : found, «kept»);", "RG_EXIT_PASS", "launches that are lost are not told of", tests=("command line, gates",)),
    Fault(RUN, "    «r->left_ms -= rg_now_ms() - start_ms;»", ";", "each device of two builds has half of the budget that others have taken", tests=("command line, gates",)),
    Fault("backends/library.c", "    if («!*id»)\n", "0", "libraries without a build id are all the same", tests=("command line, gates",)),
    Fault(STRAYS, "        any = «rg_glob(row->cell, cells->cells[i].name)»;", "true", "an expectation of no cell is silent", tests=("expectations", "command line, reports")),
    Fault(STRAYS, "return «row->since > today»;", "false", "an expectation to come is silent", tests=("expectations",)),
    Fault(STRAYS, "&& row->until - today > «YEAR_DAYS»;", "100 * YEAR_DAYS", "an expectation without end is silent", tests=("expectations",)),
    Fault("harness/compare/gate/expected/judge.c", "if («today < row->since»)", "false", "an expectation to come holds already", tests=("expectations",)),
    Fault(STRAYS, "if («!driver || !targets[i].driver» || rg_glob(", "!driver", "a driver that is not there is told to be another", tests=("expectations",)),
    Fault(STRAYS, "if (device && «!rg_glob(device, targets[i].device)»)", "false", "an expectation of no device is silent", tests=("expectations", "command line, gates")),
    Fault(STRAYS, "        if («row->file != file» ||", "false", "expectations of no cell are told of each file", tests=("expectations",)),
    Fault(STRAYS, "if («s->known->files[file].form == RG_FORM_OWN»)", "true", "Mesa's lists of other suites are complained about", tests=("expectations",)),
    Fault(COMMAND, "if («is_read && !o->gtest.list»)", "false", "nobody is told of an expectation of no cell", tests=("command line, reports",)),
    Fault(CELLS, "           «has_keys_once(cell->assignments)»;", "true", "of a parameter that stands twice the last holds", tests=("gate cells",)),
    Fault(COMMAND, "if («gate.is_told» && ", "true", "a gate that fails early leaves an empty report", tests=("command line, gates",)),
]
