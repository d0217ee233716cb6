"""Parameters of techniques, options of commands, and their bounds."""
from fault import Fault

TESTS = ("parameters", "command line, parsing", "options of all commands", "command line, cases", "command line, wrong",
         "command line, renders", "command line, pages", "streaks, sizes")

PARAMS, VALUE, PARSE, OPTION = ("core/techniques/params.c", "harness/commands/cli/value.c", "harness/commands/cli/parse.c", "harness/commands/cli/option.c")
WORDS, PAIR = "core/base/text/words.c", "core/base/text/pair.c"

THREADS = "harness/console/threads.c"

LOG = "core/base/log.c"
ROWS = [
    Fault("harness/commands/list.c", "for (int i = 0; «lists[i]»; i++)\n        rg_nearest_try(&nearest, what, lists[i]);", "lists[i + 1]", "the last list is never the nearest", tests=("command line, cases",)),
    Fault(VALUE, "if («!*text»)", "false", "an option's text may be empty"),
    Fault(LOG, "return «level == RG_LOG_INFO»;", "true", "each cell that meets an error prints it", tests=("log",)),
    Fault(LOG, "if («is_held»)", "false", "what is only counted logs errors", tests=("log",)),
    Fault(THREADS, "if («threads <= rg_threads_most()»)", "true", "a hundred thousand threads are made", tests=("command line, results",)),
    Fault(THREADS, "return «!unsetenv(count_name)»;", "false", "each process complains of a wrong number of threads", tests=("command line, results",)),
    Fault(THREADS, "«dup2(nothing, STDERR_FILENO)»;", "0", "libgomp complains twice", tests=("command line, results",)),
    Fault(PARAMS, "*double_at(param, settings) = param->initial;", "*double_at(param, settings) = (int)param->initial;", "defaults are whole numbers"),
    Fault(PARAMS, "param->kind == RG_PARAM_FLOAT || «value == floor(value)»;", "true", "a whole number may have a fraction"),
    Fault(PARAMS, "if (end == text || «*end» || !isfinite(value) || !whole)", "false", "what follows a number is ignored"),
    Fault(PARAMS, "*end || «!isfinite(value)» || !whole)", "false", "a parameter may be no number"),
    Fault(PARAMS, "if (value < param->min || «value > param->max»)", "false", "a parameter may be above its range"),
    Fault(PARAMS, "if («value < param->min» || value > param->max)", "false", "a parameter may be below its range"),
    Fault(PARAMS, "if (value < param->min || «value > param->max»)", "value >= param->max", "a parameter's maximum is refused"),
    Fault(PARAMS, "if («value < param->min» || value > param->max)", "value <= param->min", "a parameter's minimum is refused"),
    Fault(PARAMS, "if («strlen(text) == length» && !memcmp(choice, text, length)) {", "true", "the beginning of a choice is taken for it"),
    Fault(PARAMS, "if («strlen(text) >= RG_PATH_SIZE»)", "strlen(text) > RG_PATH_SIZE + 8", "a path of 1024 bytes is taken"),
    Fault(PARAMS, "return «!table->preset» || strcmp(param->name, table->preset) ||", "true", "a preset assigns nothing"),
    Fault(WORDS, "if (!nearest->name || «distance < nearest->distance»)", "false", "the nearest name is the first one"),
    Fault(PARAMS, "snprintf(text, size, «\"%.10g\"», *double_at", "\"%.3g\"", "parameters print three digits"),
    Fault(VALUE, "if (value < row->least || «value > row->most»)", "false", "an option's number may be above its range"),
    Fault(VALUE, "if (!(«*number > 0» && *number <= row->most))", "*number >= 0", "a factor may be 0"),
    Fault(PAIR, "return take(&text, first) && *text++ == sign && take(&text, second) && «!*text»;", "true", "what follows a size is ignored"),
    Fault(PAIR, "*width <= RG_MOST_PX && «*height <= RG_MOST_PX»;", "true", "a picture may be of any height"),
    Fault(PAIR, "*last = «*first»;", "*first + 1", "a range of one number has two"),
    Fault(VALUE, "if (range->first < row->least || «range->last < range->first»)", "false", "a range may run backwards"),
    Fault(VALUE, "if («errno || value < INT_MIN || value > INT_MAX»)", "false", "a number that does not fit is cut"),
    Fault(VALUE, "*(int *)at(row, values) = «(int)row->least - 1»;", "(int)row->least", "an option that is not given has its least value"),
    Fault(PARSE, "ok = !row->initial || «rg_option_set(row, line->values, row->initial, line->command->name)»;", "true", "options have no defaults"),
    Fault(PARSE, "if («line->arguments.count == places»)", "false", "arguments that are too many are ignored"),
    Fault(PARSE, "if («line->given[j]» && rg_has_word", "false", "options that exclude each other are taken"),
    Fault(PARSE, "if (line->given[i] && «row->arguments && row->arguments != count»)", "false", "options of other arguments are ignored"),
    Fault(OPTION, "if (row.kind == RG_OPTION_GROUP)\n            «arguments = row.arguments;»", ";", "a heading has no number of arguments"),
    Fault(PARSE, "if («value < -1» && !refuse(line, value))", "false", "an unknown option is ignored"),
    Fault(PARSE, "rg_command_print_help(line->command);\n    return «RG_EXIT_PASS»;", "RG_EXIT_USAGE", "asking for help fails"),
    Fault(OPTION, "row.offset «+= includer->offset»;", "+= 0", "options that commands share lie at the beginning"),
    Fault(OPTION, "row.initial = «includer->initial ? includer->initial : row.initial»;", "row.initial", "a command has no default of its own"),
    Fault("harness/main.c", "for (int i = «0»; rg_commands[i]; i++)\n        rg_nearest_try", "1", "the first command is never the nearest", tests=("command line, cases",)),
]
