"""Reports of gates: escaped texts, each form's marks and limits, and the lines that runners of gtest read."""
from fault import Fault

TESTS = ("reports, forms", "reports, gtest", "reports, limits", "command line, cases")

TEXTS, REPORT = "harness/compare/gate/report/texts.c", "harness/compare/gate/report/report.c"
FILES = "core/base/files/file.c"
FORMS = "harness/compare/gate/report/forms.c"
JUNIT, GITHUB, JSON = "harness/compare/gate/report/junit.c", "harness/compare/gate/report/github.c", "harness/compare/gate/report/json.c"
TEXT, GTEST = "harness/compare/gate/report/text.c", "harness/compare/gate/report/gtest.c"
GLOB = "harness/compare/gate/text/glob.c"

ROWS = [
    Fault(FORMS, "return («fclose(out) == 0 && is_held»)", "fclose(out) || true", "a summary on a full disk is lost without a word"),
    Fault(FILES, "return «S_ISREG(st->st_mode)»   ? NULL", "true", "a FIFO is taken for a file", tests=("command line, acts",)),
    Fault(TEXTS, "if (!length || «code < least[length]» ||", "false", "overlong UTF-8 is taken for a character"),
    Fault(TEXTS, "«(code >= 0xd800 && code < 0xe000)»)", "false", "surrogates are taken for characters"),
    Fault(TEXTS, "if (!is_line && «(code == '\\n' || code == '\\t')»)", "true", "details keep controls"),
    Fault(TEXTS, "const bool is_control = «code >= 0x80 && code < 0xa0»;", "false", "controls of eight bits are kept"),
    Fault(TEXTS, "const bool is_break = «code == 0x2028 || code == 0x2029»;", "false", "line breaks of Unicode are kept"),
    Fault(TEXTS, "const bool is_turn = «(code >= 0x202a && code <= 0x202e)»", "false", "text may turn the order of what follows"),
    Fault(TEXTS, "while (size > 0 && «(text[size] & 0xc0) == 0x80»)", "false", "a text is cut within a character"),
    Fault(REPORT, "for (int number = 2; «has_name(report, made)»; number++)", "false", "two cases have one name"),
    Fault(REPORT, "if («length > RG_REPORT_NAME») {", "false", "names of any length are kept"),
    Fault(REPORT, "if («length <= RG_REPORT_LINE»)", "true", "messages of any length are kept"),
    Fault(REPORT, "return «endings[ending].element»;", "ending == RG_ENDING_NOTHING_MEASURED ? NULL : endings[ending].element", "a gate that measured nothing passes"),
    Fault(REPORT, "return «endings[ending].element»;", "ending == RG_ENDING_UNEXPECTED_PASS ? NULL : endings[ending].element", "an unexpected pass passes"),
    Fault(REPORT, "const bool is_whole = «is_made» && is_written;", "true", "a form that could not be made replaces the file"),
    Fault(JUNIT, "return «c == '&'» ", "false", "ampersands are not escaped"),
    Fault(JUNIT, ": «is_attribute && c == '\\n'»", "false", "attributes lose their line breaks"),
    Fault(JUNIT, "if («written > most»)", "false", "details are never cut"),
    Fault(JUNIT, "sum += «size < most ? size : most»;", "size", "all details are cut where one is too long"),
    Fault(JUNIT, "if («size >= RG_JUNIT_LIMIT»)", "false", "a file that is too large without details is written"),
    Fault(JUNIT, "const bool is_safe = «!strstr(path, \"]]\")»", "true", "a path ends its own mark of a picture"),
    Fault(JUNIT, "put(out, told->message, strlen(told->message), false);", ";", "the message is not repeated in the body"),
    Fault(JUNIT, "return «isfinite(seconds) && seconds > 0» ? seconds : 0;", "true", "a time that is no number is written"),
    Fault(GITHUB, "(is_property && («*text == ':'» || *text == ','))", "false", "a colon ends the title"),
    Fault(GITHUB, "const bool is_mark = «*text == '%'» ||", "false", "per cent signs are not escaped"),
    Fault(GITHUB, "«count < RG_ANNOTATIONS»;", "true", "every case is annotated"),
    Fault(GITHUB, "const struct rg_report_case *told = &report->cases[«report->order[i]»];\n        const char *command", "i", "the first three are annotated, not the worst"),
    Fault(GITHUB, "return «longest + 1»;", "3", "a fence in the details ends their block"),
    Fault(GITHUB, "«size + NOTE» <= page->room;", "size", "the note of what is left out exceeds the room"),
    Fault(GITHUB, "const bool fits = «!page->left_out» && size", "true", "a case that is less bad takes the room of a worse"),
    Fault(GITHUB, "? RG_SUMMARY_LIMIT - «(size_t)st.st_size»\n", "0", "what the step's summary has already is not counted"),
    Fault(GITHUB, "put_escaped(out, «told->message»);", "told->name", "the reason is not told"),
    Fault(JSON, "if («!isfinite(number.value)»)", "false", "a case that was not timed has a measure"),
    Fault(JSON, "const double ns_a_ms = «1e6»;", "1", "latency is in milliseconds"),
    Fault(JSON, "\"lower_value\", json_real(«number.low» * unit)", "number.high", "the lower bound is the upper one"),
    Fault(TEXT, "const bool is_command = «text[i] == '[' && i >= 2 && !strncmp(text + i - 2, \"##\", 2)»;", "false", "a text is a command to GitHub"),
    Fault(TEXT, "if («width > room»)", "false", "lines of any width"),
    Fault(TEXT, "«fputs(bar, out);»", ";", "further lines of a text begin as the text likes"),
    Fault(GTEST, "if («minus == filter»)", "false", "a filter of what not to run lets nothing through"),
    Fault(GLOB, "} else if («star») {", "false", "a star takes no character"),
    Fault(GTEST, "matches_any(filter, «minus ? minus : end», name)", "end", "what follows the minus is wanted"),
    Fault(GLOB, "«*pattern == '?'» || *pattern == *text", "false", "a question mark is a character"),
    Fault(GTEST, "is_changed |= «!is_plain(*c) && *c != '.'»;", "false", "two names become one for gtest"),
    Fault(GTEST, "*c == '.' ? «'/'»", "'.'", "a test has a point, which ends its suite"),
    Fault(GTEST, "fprintf(out, *text == '\\n' ? \"\\n| \" : \"%c\", «*text == '[' ? '(' : *text»);", "*text", "details are taken for a result"),
    Fault(GTEST, "|| «is_listed(report, i, first, filter)»)", "false", "a suite is listed with each of its tests"),
]
