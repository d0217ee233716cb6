"""Bisects: which candidate is judged next, what a command's exit status says, how it is called, and what is kept."""
from fault import Fault

TESTS = ("bisect", "bisect, kept", "command line, bisects")

BISECT = "harness/compare/bisect/"
SEARCH, BLANKS, JUDGE = BISECT + "search.c", BISECT + "blanks.c", BISECT + "judge.c"
LIST, KEPT, RUN = BISECT + "list.c", BISECT + "kept.c", BISECT + "bisect.c"
COMMAND, GIT = "harness/commands/comparing/bisect.c", BISECT + "git.c"

ROWS = [
    Fault(SEARCH, "first + «(length - 1) / 2»;", "0", "a stretch is walked through one by one"),
    Fault(SEARCH, "if («length > longest» ||", "!longest", "what is skipped in the middle is left one by one"),
    Fault(SEARCH, "            search.bad = i;\n            «break;»", ";", "the last bad one is found"),
    Fault(SEARCH, "            search.good = i;\n            «search.left = 0;»", ";", "what lies before the last good one counts as left"),
    Fault(BLANKS, "if («f->doubt || is_in_words(f)»)", "is_in_words(f)", "a quote in a comment or a here-document is taken for one"),
    Fault(BLANKS, "if («f->doubt || is_in_words(f)»)", "f->doubt", "another shell takes a candidate for code"),
    Fault(BLANKS, "length = «is_escape(at, f->quotes)» ? 2 : 1;", "false", "an escaped quote opens quotes"),
    Fault(BLANKS, "line = «skip_joints(line + 1)»)", "line + 1", "a here-document whose mark is on two lines is none"),
    Fault(JUDGE, "return «RG_JUDGED_AGAIN»;", "RG_JUDGED_STOP", "what is inconclusive ends a bisect"),
    Fault(JUDGE, "return «crash_is_bad ? RG_JUDGED_BAD : RG_JUDGED_SKIP»;", "RG_JUDGED_SKIP", "--crash bad says nothing"),
    Fault(JUDGE, "if («status <= RG_EXIT_SIGNALLED»)", "status < 100", "a command that is not there is skipped"),
    Fault(JUDGE, "ldexp(judging->budget_s, «number»)", "0", "each try has the same time"),
    Fault(JUDGE, "            «kill(-child, SIGTERM);»", ";", "the command of an interrupted bisect runs on"),
    Fault(LIST, "    if («from > to»)", "false", "a list with the newest first is searched backwards"),
    Fault(LIST, "«!has_each_once(candidates)»", "false", "a candidate that stands there twice has two verdicts"),
    Fault(KEPT, "«!json_equal(json_object_get(document, \"key\"), key)»)", "false", "verdicts of another raingauge or machine are taken"),
    Fault(KEPT, "at >= b->candidates->count || «b->judged[at].verdict != RG_JUDGED_NONE»)", "false", "a verdict that stands there twice is taken twice"),
    Fault(KEPT, "if («!can_be(&judged, b->judging)»)", "false", "a verdict that cannot be is taken"),
    Fault(KEPT, "if («strcmp(stamp, now) != 0»)", "false", "a candidate that was built anew keeps its verdict"),
    Fault(KEPT, "if (!ok || «b->judged[0].verdict == RG_JUDGED_NONE»)", "false", "verdicts outlive the good end that they were held against"),
    Fault(KEPT, "hash = «hash_text(bisect->candidates->names[i], hash)»;", "hash", "bisects of other candidates have one file"),
    Fault(RUN, "    «rg_bisect_kept_remove(&r->kept);»", ";", "verdicts stay when a bisect is done"),
    Fault(RUN, "if («is_told» && b->end != RG_BISECT_STOPPED)", "true", "what a bisect came to is lost where it cannot be printed"),
    Fault(RUN, "b->fresh ? «0» : rg_bisect", "rg_bisect_kept_take(&r->kept, b)", "--fresh takes verdicts"),
    Fault(GIT, ": verdict == RG_JUDGED_SKIP ? «RG_EXIT_GIT_SKIP»", "1", "git takes what was skipped for bad"),
    Fault(GIT, "return «git_is_bisecting()» ?", "false", "git takes a misspelt option for bad"),
    Fault(GIT, "return «git_is_bisecting()» ?", "true", "a misspelt option ends with 128 everywhere"),
    Fault(JUDGE, "«hand_over(RG_VARIABLE_CANDIDATE, candidate)»", "true", "the command gets no candidate"),
]
