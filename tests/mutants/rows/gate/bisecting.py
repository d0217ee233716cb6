"""Bisects: the next candidate to judge, the meaning of a command's exit status, and how the command is called."""
from fault import Fault

TESTS = ("bisect", "command line, bisects")

BISECT = "harness/compare/bisect/"
LIST, RUN, JUDGE = BISECT + "list.c", BISECT + "bisect.c", BISECT + "verdict.c"
COMMAND = "harness/commands/comparing/bisect.c"

ROWS = [
    Fault(LIST, "first + «(length - 1) / 2»;", "0", "a stretch is walked through one by one"),
    Fault(LIST, "if («length > longest» ||", "!longest", "what is skipped in the middle is left one by one"),
    Fault(LIST, "s.bad < count - 1 && «verdicts[s.bad] != RG_JUDGED_BAD»; s.bad++)", "true", "the last bad one is found"),
    Fault(LIST, "for (int64_t first = «s.good + 1», end;", "1", "what lies before the last good one counts as left"),
    Fault(JUDGE, "return «RG_JUDGED_AGAIN»;", "RG_JUDGED_STOP", "what is inconclusive ends a bisect"),
    Fault(JUDGE, "return «crash_is_bad ? RG_JUDGED_BAD : RG_JUDGED_SKIP»;", "RG_JUDGED_SKIP", "--crash bad says nothing"),
    Fault(JUDGE, "if («status <= RG_EXIT_SIGNALLED»)", "status < 100", "a command that is not there is skipped"),
    Fault(JUDGE, "ldexp(judging->budget_s, «number»)", "0", "each try has the same time"),
    Fault(JUDGE, "            «kill(-child, SIGTERM);»", ";", "the command of an interrupted bisect runs on"),
    Fault(LIST, "for (int64_t i = 0, j = candidates->count - 1; «from > to» && i < j;", "false", "a list with the newest first is searched backwards"),
    Fault(LIST, "«!has_each_once(candidates->names + 1, candidates->count - 2)»", "false", "a candidate that stands there twice has two verdicts"),
    Fault(RUN, "b->found = rg_search_of(«b->verdicts», b->candidates->count);", "(enum rg_judgement[65]){0}", "an interrupted bisect forgets what it found"),
    Fault(RUN, "is_one = «found->bad == found->good + 1»;", "true", "one of several is called the first"),
    Fault(RUN, "if (exit == RG_EXIT_PASS)\n        exit = «judge_end(bisect, count - 1, RG_JUDGED_BAD)»;", "RG_EXIT_PASS", "the bad end is not judged"),
    Fault(COMMAND, "if («strstr(line, blanks[i][0])»)", "false", "the shell gets {} for a candidate"),
    Fault(COMMAND, "i < («is_git ? 1 : 3»); i++)", "3", "git's command may have no {}"),
    Fault(JUDGE, "{\"skip\", «RG_EXIT_GIT_SKIP»}", "1", "git takes what was skipped for bad"),
    Fault(JUDGE, "return «git_is_bisecting» ?", "false", "git takes a misspelt option for bad"),
    Fault(JUDGE, "return «git_is_bisecting» ?", "true", "a misspelt option ends with 128 everywhere"),
    Fault(JUDGE, "«hand_over(RG_VARIABLE_CANDIDATE, candidate)»", "true", "the command gets no candidate"),
]
