"""Records: journals, stored results, numbers and names, files on disk."""
from fault import Fault

TESTS = ("named", "held", "rows", "journal", "output", "stored", "damaged", "sealed", "sheets, cells", "sheets, json", "sheets, parts", "measure", "machine", "command line, tables", "command line, stored", "command line, cases")

USER = "core/base/files/user.c"
TABLE = "harness/tables/measuring/measure.c"
JOURNAL, STORED, NAMED = "harness/record/disk/journal.c", "harness/record/disk/stored.c", "harness/record/named.c"
CELLS = "harness/record/disk/cells.c"
DOCUMENT, KEY = "harness/record/disk/document.c", "harness/record/passport/key.c"
MACHINE, VARIABLES = "harness/record/passport/machine.c", "harness/record/passport/variables.c"
OUTPUT, RESULT, RECORD = "harness/record/output.c", "harness/record/result.c", "harness/record/record.c"
HOLD, REGENERATE, CLOCK = "harness/record/disk/hold.c", "harness/tables/runs/regenerate.c", "harness/console/clock.c"
TEMPORARY, FIELDS = "core/image/files/temporary.c", "harness/record/schema/fields.c"

ROWS = [
    Fault(OUTPUT, "return «lstat(path, &st)» || rg_temporary_try", "true", "what cannot be replaced is found out after the work"),
    Fault(JOURNAL, "journal->has_file = «has_same_head(&found, &journal->held)»;", "true", "a journal of another machine is taken over"),
    Fault(JOURNAL, "return «!strcmp(a->set, b->set)» && a->row_count", "true", "a row of other parameters is taken over"),
    Fault(JOURNAL, "if (!fresh && *j->folder)\n        read_file(j);", "if (*j->folder) read_file(j);", "a fresh run takes over the old one"),
    Fault(JOURNAL, "is_begun(result, record) && «!rg_outcome_is_broken(record->outcome)» &&", "true", "a row that a driver broke is kept"),
    Fault(JOURNAL, "«!rg_outcome_is_broken(record->truth_error.outcome)»;", "true", "a truth that could not be drawn is kept"),
    Fault(JOURNAL, "for (int row = first; j && row <= «last»; row++)", "first", "the first of several rows alone is kept"),
    Fault(JOURNAL, "if (j && («j->is_followed» || !is_whole(result)))", "false", "the last row of a table is not written though others follow"),
    Fault(JOURNAL, "if (j && (j->is_followed || «!is_whole(result)»))", "false", "a table that no other follows is not kept"),
    Fault(JOURNAL, "return holds(journal, row) && «rg_result_is_whole(&journal->held, row)»;", "true", "a row with some of its samples is taken for whole", tests=("journal",)),
    Fault(STORED, "if (ok)\n            «rg_result_drop_begun(result);»", ";", "a row that is not whole is printed", tests=("journal",)),
    Fault(TABLE, "|| row <= last ? «VISITS» : 1;", "1", "groups of rows are visited once", tests=("journal",)),
    Fault(TABLE, "if (rg_interrupted())\n        «rg_result_drop_begun(m->result);»", ";", "an interrupted run prints rows that are not whole", tests=("journal",)),
    Fault(JOURNAL, "record->device = device;", "", "a row that is taken over has a device without limits"),
    Fault(JOURNAL, "*record = *rg_result_at(&journal->held, «at»);", "(struct rg_place){.work = at.work, .variant = at.variant}", "every row is taken over as the first"),
    Fault(FIELDS, "memcpy(text, json_string_value(value), length + 1);\n    «rg_plain(text);»", ";", "a stored text steers the terminal"),
    Fault(DOCUMENT, "if («sealed == RG_SEAL_WHOLE» ||", "sealed != RG_SEAL_ABSENT", "a wrong checksum is taken for a right one"),
    Fault(STORED, "rg_result_from_json(document, path, result, why) &&\n                        «rg_cells_are_whole(path, document, why)»;", "true", "a cell that was changed is printed as measured", tests=("command line, kept",)),
    Fault(CELLS, "hash(bare, «head», &found);", "head * 0", "a cell of another machine is taken for its own", tests=("sealed",)),
    Fault(CELLS, "strtod(text, NULL)", "json_real_value(real)", "a number counts by digits that no document keeps", tests=("sealed",)),
    Fault(CELLS, "json_object_del(measured, made[i]);", ";", "a record that keeps no frame rates is refused", tests=("sealed",)),
    Fault(CELLS, "json_object_del(measured, name);", ";", "a record that keeps no numbers beside print is refused", tests=("sealed",)),
    Fault(CELLS, "(!found.wrong && «!found.absent»)", "true", "a cell without a checksum is taken", tests=("sealed",)),
    Fault(USER, "if (named && «named[0] == '/'»)", "true", "a relative folder of the user's is followed", tests=("user",)),
    Fault(USER, "return «(size_t)length < size» ||", "true", "a folder of the user's that is too long is cut", tests=("user",)),
    Fault(USER, "const char *variable = «folders[folder].variable»;", "folders[RG_USER_CACHE].variable", "what goes on later lies where caches are cleaned", tests=("user",)),
    Fault(HOLD, "return «!is_taken»;", "true", "two runs write into a folder at once", tests=("command line, losses",)),
    Fault(REGENERATE, "if («!are_kept»)\n        rg_closing_tell", "false", "tables end without a word", tests=("command line, long",)),
    Fault("harness/tables/runs/closing.c", "closing->failed += «outcome != RG_OK && outcome != RG_UNSUPPORTED»;", "0", "cells that failed count as measured", tests=("command line, long",)),
    Fault(REGENERATE, "if («!is_ours» && options->folder)", "false", "a second run into a folder goes on", tests=("command line, losses",)),
    Fault(REGENERATE, "for (int i = 0; «keeps» && i < made; i++)", "true", "a run whose state folder another holds keeps rows there", tests=("command line, losses",)),
    Fault("harness/commands/tables/inputs.c", "table->rows[row].set, «set»);", "NULL", "a table's files replace one that --set names", tests=("command line, tables",)),
    Fault("harness/commands/tables/inputs.c", "«row ? row : \"\"»", "\"\"", "a sweep's files replace one that an axis names", tests=("command line, tables",)),
    Fault("harness/tables/print.c", "«full < 2»; full++)", "false", "a journal replaces a file that is read", tests=("command line, tables",)),
    Fault(REGENERATE, "«(exit == RG_EXIT_USAGE || exit == RG_EXIT_HARNESS)» && i < count; i++)", "false", "what was measured is lost where the claims cannot be printed", tests=("command line, losses",)),
    Fault("harness/commands/tables/sweep.c", ".fresh = «o->fresh»,", "true", "an interrupted sweep begins anew", tests=("command line, losses",)),
    Fault("harness/tables/sweep/grid.c", "k ? \",\" : \"\", axis->values[«k»]);", "0", "a sweep goes on with rows of other axes", tests=("command line, losses",)),
    Fault(REGENERATE, "return «any_is_lost || rg_interrupted()»;", "rg_interrupted()", "what was measured is lost where the results cannot be written", tests=("command line, losses",)),
    Fault(CLOCK, "clock_gettime(«CLOCK_MONOTONIC», &now);", "CLOCK_REALTIME", "times are taken by a clock that can be set back", tests=("command line, losses",)),
    Fault(DOCUMENT, "*at += strspn(text + *at, \" \\t\\r\\n\");", "", "line ends behind a document are taken for another"),
    Fault(STORED, "return ends_in(entry->d_name, \".json\") || «ends_in(entry->d_name, \".journal\")»;", "false", "journals of a folder are not read"),
    Fault(DOCUMENT, "for (const char *c = text; c < text + «*at»; c++)", "0", "a damaged document's line is counted from its own beginning"),
    Fault(STORED, "} while («at < size»);", "false", "the first document of a file alone is read"),
    Fault(NAMED, "return number == floor(number) && «fabs(number) < 9007199254740992.0»;", "true", "numbers that lost digits are written as whole"),
    Fault(NAMED, "if (!isfinite(number))\n        «return json_null();»", "return json_real(0);", "no number is written as 0"),
    Fault(NAMED, "while (from[length] && length > 0 && «(from[length] & 0xc0) == 0x80»)", "false", "a name is cut within a character"),
    Fault(NAMED, "if (!is_utf8(to))\n        mark_foreign_bytes(to);", ";", "a name that is no UTF-8 is kept"),
    Fault(NAMED, "if («!*named[i].text» && !strcmp(named[i].name, name))", "true", "a text is taken for a number"),
    Fault(OUTPUT, "ok = end(&pending[i], «true»);", "false", "what is written is not put in place"),
    Fault(TEMPORARY, "(t->is_named || «copy_to_name(t)») &&", "false", "without linkat nothing is written", tests=("containers, refusals",)),
    Fault(TEMPORARY, "if («!rg_file_follow(path, target, &refused)»)", "!rg_file_follow(path, target, &refused) && false", "another's link is followed", tests=("containers, links",)),
    Fault("core/base/files/file.c", "st->st_uid == geteuid() || «!split(path, folder)»", "true", "whatever lies in a folder for all is trusted", tests=("containers, links",)),
    Fault(TEMPORARY, "return t->mode ? S_IRUSR | S_IWUSR : «0666»;", "0600", "files are the owner's alone"),
    Fault(TEMPORARY, "fchmod(t->fd, «t->mode & 0777»);", "0644", "what others may not read is theirs to read once it is written anew"),
    Fault(OUTPUT, "return *made || «errno == EEXIST» ||", "false", "a folder that is there is an error"),
    Fault(RESULT, "const int before = first > result->first_row ? «first - result->first_row» : 0;", "first", "rows that are kept move too far"),
    Fault(RESULT, "result->last_row = «last < result->last_row ? last : result->last_row»;", "last", "rows that are kept go on behind the last"),
    Fault(RESULT, "const int variant = place.work * «result->variant_count» + place.variant;", "1", "works share their cells"),
    Fault(RESULT, "while (row <= result->last_row && «is_done(result, row)»)", "true", "a missing row is not found"),
    Fault(RESULT, "*most = «samples > *most ? samples : *most»;", "samples", "the most samples are those of the last cell"),
    Fault(RESULT, "if («record->outcome != RG_OK» || !samples)", "false", "samples of cells that failed count"),
    Fault(RECORD, "return «1000» / record->frame_ms.median;", "1", "frame rates are in frames a millisecond"),
    Fault(RECORD, "*low = most ? 1000 / *most : rg_record_published_fps(record);", "*low = rg_record_published_fps(record);", "a printed range has no low end"),
    Fault(RECORD, "for (int i = 0; i < record->sample_count; i++) {\n        «settle(&record->samples_ms[i]);»", ";", "samples print otherwise once they are read back"),
    Fault(KEY, "set(parts, \"clocks\", \"%s\", «text_of(machine, \"clocks\")»);", "\"\"", "times under other clocks are held against each other", tests=("key",)),
    Fault(KEY, "if («*cpu != ' '» || (length", "true", "a CPU that one kernel pads with blanks is another", tests=("key",)),
    Fault(KEY, "if («rg_variable_is_of_speed(name)» && used", "true", "another path to the same driver is another key", tests=("key",)),
    Fault(KEY, "if («strcmp(is, was)» && used", "true", "parts that are the same are told as a difference", tests=("key",)),
    Fault(VARIABLES, "return «rg_variables[i].is_of_speed»;", "false", "times with other threads are held against each other", tests=("key",)),
    Fault(MACHINE, "add_clock(machine, «*line == '0'» ? \"boost on\" : \"boost off\");", "*line != '0'", "a processor that is kept from boosting is said to boost", tests=("machine",)),
]
