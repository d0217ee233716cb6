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
    Fault(JUDGE, "return «verdicts[verdict].git» +", "(verdict == RG_JUDGED_SKIP ? 1 : verdicts[verdict].git)", "git takes what was skipped for bad"),
    Fault(JUDGE, "return «git_is_bisecting» ?", "false", "git takes a misspelt option for bad"),
    Fault(JUDGE, "return «git_is_bisecting» ?", "true", "a misspelt option ends with 128 everywhere"),
    Fault(JUDGE, "«hand_over(RG_VARIABLE_CANDIDATE, candidate)»", "true", "the command gets no candidate"),
    Fault(LIST, "length > 0 && «distance < nearest»)", "false", "of stretches as long the first is halved", tests=("bisect",)),
    Fault(LIST, "from ? «\"bad\"» : \"good\"", "\"good\"", "the end that is not there has the other's name", tests=("bisect",)),
    Fault(LIST, "        «s.left += length;»", "s.left++;", "a stretch is told as one candidate", tests=("bisect",)),
    Fault(JUDGE, "        «return RG_JUDGED_STOP;»\n    default:", "return status == RG_EXIT_SIGNALLED + SIGHUP ? RG_JUDGED_SKIP : RG_JUDGED_STOP;", "a terminal that is closed skips candidates", tests=("bisect",)),
    Fault(JUDGE, "        «return RG_JUDGED_STOP;»\n    default:", "return status == RG_EXIT_SIGNALLED + SIGTERM ? RG_JUDGED_SKIP : RG_JUDGED_STOP;", "a command that is asked to end skips its candidate", tests=("bisect",)),
    Fault(JUDGE, "(rg_now_ms() - start_ms) / «1000»;", "1", "milliseconds are told as seconds", tests=("bisect",)),
    Fault(JUDGE, "hand_over(RG_VARIABLE_GOOD, «good»)", "candidate", "the good end is the candidate", tests=("bisect",)),
    Fault(RUN, "printf(«judged.tries > 1» ?", "true", "each verdict took tries", tests=("bisect",)),
    Fault(RUN, "word, name, «b->judged[b->count - 1].status»);", "b->judged[0].status", "the bad end ended as the good one", tests=("bisect",)),
    Fault(RUN, "name, «rg_judgement_name(b->verdicts[at])», word);", "word", "an end is what it should be, and is refused", tests=("bisect",)),
    Fault(RUN, "found->left == 1 ? \"\" : \"s\", «found->steps»);", "(int)found->left", "all that is left is to be judged", tests=("bisect",)),
    Fault(RUN, "\"status\", «j->status»,", "j->tries", "JSON has tries for the status", tests=("bisect",)),
    Fault(RUN, "rg_number_json(«j->seconds»)", "1000 * j->seconds", "JSON has milliseconds", tests=("bisect",)),
    Fault(RUN, "\"candidates\", «(int)last + 1»,", "(int)last", "JSON has a candidate fewer", tests=("bisect",)),

    # --- what blind draws showed ---
    Fault("harness/compare/bisect/bisect.c", "rg_info(\"interrupted; --good '%s' --bad '%s' go on from here\", names[«b->found.good»],", "b->found.bad", "a bisect goes on from a wrong end", tests=("bisect",)),
]
