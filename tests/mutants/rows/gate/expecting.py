"""What a gate reads from text: its cells, and what it expects to go wrong; how results meet that, and patches of it."""
from fault import Fault

TESTS = ("gate cells", "expectations", "patches of expectations")

CELLS, LINES, GLOB = "harness/compare/gate/cells/cells.c", "harness/compare/gate/text/lines.c", "harness/compare/gate/text/glob.c"
DATE, OWN, MESA = "harness/compare/gate/text/date.c", "harness/compare/gate/expected/own.c", "harness/compare/gate/expected/mesa.c"
JUDGE, PATCH, DIFF = "harness/compare/gate/expected/judge.c", "harness/compare/gate/expected/patch.c", "harness/compare/gate/expected/diff.c"
REGEX, WRITE, LOG = "harness/compare/gate/expected/regex.c", "harness/compare/gate/expected/write.c", "core/base/log.c"

ROWS = [
    Fault(REGEX, "return («group->atoms <= MOST_ATOMS» &&", "true", "counts in counts take all memory"),
    Fault(REGEX, "if («t->depth == MOST_DEPTH»)", "t->depth < 0", "groups in groups take all of the stack"),
    Fault(REGEX, "group->atoms += «last.atoms - t->last.atoms»;", "0", "a count counts nothing"),
    Fault(LOG, "if («error_place && level == RG_LOG_ERROR»)", "false", "what refuses a line does not say where it is"),
    Fault(CELLS, "rg_log_place(«NULL»);", "place", "errors of others name a line of the cells"),
    Fault(CELLS, "return isalnum((unsigned char)*name) && «strlen(name) < RG_GATE_NAME_SIZE»;", "true", "a cell's name that is too long is cut"),
    Fault(CELLS, "if («!strcmp(other->name, cell->name)»)", "false", "two cells have one name"),
    Fault(CELLS, "return c > text && *c == end && «value <= most» ? (int)value : -1;", "true", "a picture may be of any size"),
    Fault(CELLS, "return ok && («cells->count» || rg_error", "true", "a file without a cell is taken"),
    Fault(LINES, "length -= «end && length > 0 && text[length - 1] == '\\r'»;", "0", "files with CR LF are refused"),
    Fault(LINES, "if («((unsigned char)text[i] < ' ' && text[i] != '\\t') || text[i] == 127»)", "false", "control characters are taken"),
    Fault(GLOB, "text = «++from»;", "from", "a star takes nothing", tests=("expectations",)),
    Fault(DATE, "return (year % 4 == 0 && «year % 100 != 0») || year % 400 == 0;", "true", "every hundredth year is a leap year"),
    Fault(OWN, "return «row->since <= row->until» ||", "true", "an expectation ends before it begins"),
    Fault(OWN, "for (int i = 0; i < 3 + («row->kind == RG_EXPECT_FAIL»); i++)", "0", "a failure needs no outcome"),
    Fault(OWN, "if («row->values[field]»)", "false", "the first of two fields is lost"),
    Fault(MESA, "word[strcspn(word, \",\")] = «0»;", "word[strcspn(word, \",\")]", "what stands behind a status is taken for it"),
    Fault(MESA, "if («!words[status].outcomes»)", "false", "a test that is said to pass is expected to fail"),
    Fault(REGEX, "const bool is_lazy = «c == '?' && t->is_repeated»;", "false", "a lazy repetition may be of nothing"),
    Fault(REGEX, "if («t->at[2] != ':'»)", "false", "groups that are unknown are taken for others"),
    Fault(JUDGE, "const bool is_over = «today > row->until»;", "today >= row->until", "an expectation ends a day early"),
    Fault(JUDGE, "if («row->kind == RG_EXPECT_FAIL && result->outcome == RG_OK»)", "false", "what is fixed is not noticed"),
    Fault(JUDGE, "if («!(row->outcomes & 1U << result->outcome)»)", "false", "another outcome is as good as that expected"),
    Fault(JUDGE, "return value >= envelope->least && «value <= envelope->most»;", "true", "an envelope has no upper end"),
    Fault(JUDGE, "if («result->outcome == RG_UNSUPPORTED») // it neither", "false", "what did not run fails differently"),
    Fault(JUDGE, "if ((found < 0 || «row->kind < expected->rows[found].kind») &&", "false", "a failure that stands first hides a skip"),
    Fault(JUDGE, "is_of(row->values[RG_FIELD_DEVICE], device) &&\n           (!driver || «is_of(row->values[RG_FIELD_DRIVER], driver)»);", "true", "an expectation is of all drivers"),
    Fault(JUDGE, "(«!driver» || is_of(row", "false", "what is expected of one driver goes where nobody knows which there is"),
    Fault(JUDGE, "return met == RG_MET_FIXED || met == RG_MET_DIFFERENT || «met == RG_MET_EXPIRED»;", "false", "a gate passes with what has expired"),
    Fault(OWN, "i < 2 && «!are_compared»; i++)", "false", "evidence of pictures stands beside outcomes that have none"),
    Fault(PATCH, "row->at[field] == line && «is_idle(row, s, field)»)", "false", "a patch writes what is refused"),
    Fault(PATCH, "else if («s->fixed || is_over»)", "is_over", "a row stays whole for cells that pass"),
    Fault(PATCH, "return «s->has_expired»;", "false", "what has expired stays so"),
    Fault(PATCH, "return «e->least < old->least» || e->most > old->most;", "false", "an envelope does not grow downwards"),
    Fault(JUDGE, "if (row->kind == RG_EXPECT_SKIP && «!is_over»)", "true", "a skip holds for ever"),
    Fault(JUDGE, "if («result->is_foreign») // of", "false", "a failure of another is what was expected of a device"),
    Fault(PATCH, "return p->rows[i] < 0 && «!p->results[i].is_foreign» &&", "true", "a device is blamed for a failure of another"),
    Fault(PATCH, "result->outcome == RG_UNSUPPORTED || «result->is_foreign»)", "false", "a row gets what failed on another device"),
    Fault(PATCH, "           «rg_met_fails(p->met[i], p->results[i].outcome)»;", "true", "cells that pass are added as failures"),
    Fault(PATCH, "else if («is_unended»)", "false", "a last line without an end is lost"),
    Fault(DIFF, "const char *end = «strchr(lines->name, ' ')» ?", "false", "a name with blanks is no file to patch", tests=("command line, reports",)),
    Fault(PATCH, "if ((is_of_row(p, row, i) || «is_fixed_behind(p, row, i)») &&", "false", "what stood twice is fixed once", tests=("patches of expectations",)),
    Fault(PATCH, "return is_of_row(p, row, result) && «!has_passed»;", "!has_passed && p->met[result] != RG_MET_NOTHING", "what did not run is not expected to fail any more", tests=("patches of expectations",)),
    Fault(PATCH, "s->has_expired : is_over && «!s->unknown»)", "true", "what did not run goes with what is fixed", tests=("patches of expectations", "command line, reports")),
    Fault(PATCH, "    if («s.unknown»)\n", "false", "what did not run is expected to fail as others do now", tests=("patches of expectations",)),
    Fault(PATCH, "    if («s->unknown»)\n", "false", "a line of Mesa's goes where a test passes on one of two devices", tests=("patches of expectations",)),
    Fault(PATCH, "                                                               «p->results[result].outcome == RG_OK»);", "false", "what has passed stays in quarantine", tests=("patches of expectations",)),
    Fault(DIFF, "*moved += «added»;", "0", "later hunks name the old file's lines", lives="patch(1) finds a hunk by its text, and takes its line in the new file for nothing"),
    Fault(DIFF, "while (n < count && edits[n].line - edits[n - 1].line <= «2 * CONTEXT»)", "0", "hunks overlap"),
    Fault(WRITE, "fputc(«(unsigned char)*c < ' ' || *c == blank || *c == 127» ? '?' : *c, out);", "false", "a name breaks the line that it stands in"),
    Fault(WRITE, "if (text && «is_writable(cell)»)", "true", "Mesa's line has a comma in its name"),
]
