// Commands that are asked for what they cannot do: each says so in one line that names the words,
// and opens no device, draws nothing and prints nothing.
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "harness/console/exit.h"
#include "tests/harness/cli/asked.h"

struct refused {
    const char *line, *logged;
};

static const struct refused of_tables[] = {
    {"table", "table: all tables take hours; name some, as `raingauge list tables` prints them, or "
              "add --budget 4m, --quick or --full"},
    {"table creus-5.9", "table 'creus-5.9': unknown; the nearest is 'creus-5.1', and `raingauge "
                        "list tables` prints them"},
    {"table creus-5.4 --variant none",
     "--variant none: table 'creus-5.4' times no such thing; its first is full"},
    {"table creus-5.4 --work queries",
     "--work queries: table 'creus-5.4' has no such work; choose paper or ours"},
    {"table creus-5.4 ye-1 --work queries --variant x",
     "--work queries: table 'creus-5.4' has no such work; choose paper or ours"},
    {"table --quick --variant none", "--variant none: no table times such a thing"},
    {"table creus-5.4 --rows 7-9", "--rows 7-9: creus-5.4 has rows 1-8"},
    {"table creus-5.4 creus-5.3 --rows 18-19", "--rows 18-19: creus-5.3 has rows 1-18"},
    {"table raster-1 --claims",
     "--claims: the paper claims nothing of table 'raster-1'; leave it out, or name another table"},
    {"table raster-1 feng-1 --claims --set seed=", "parameter 'seed': '' is no whole number"},
    {"table creus-5.4 --set nope=1", "parameter 'nope': streaks has none of that name; the nearest "
                                     "is 'kept', and `raingauge list params streaks` prints all"},
    {"table creus-5.4 --set seed=x", "parameter 'seed': 'x' is no whole number"},
    {"table creus-5.4 --kept in", "--kept: is about claims; add --claims, or leave it out"},
    {"table creus-5.4 --claims --kept none", "none: cannot be read: No such file or directory; "
                                             "name a file as `raingauge table -o` writes it"},
    {"table --plan p.json creus-5.4", "--plan: the plan names the tables; leave out 'creus-5.4'"},
    {"table --plan none.json", "--plan: name the folder of its records, as -o records"},
    {"table --shard 1/2", "--shard: is of a plan; name it, as --plan plan.json"},
    {"table creus-5.4 --shard 1/2", "--shard: is of a plan; name it, as --plan plan.json"},
    {"table creus-5.4 --budget x", "--budget 'x': is no time; write it as 90s, 4m or 1h"},
    {"table creus-5.4 --from none", "none: cannot be read: No such file or directory; name a file "
                                    "as `raingauge table -o` writes it"},
    {"table none.table",
     "none.table: No such file or directory; name a text file that can be read"},
    {"table none/a", "none/a: No such file or directory; name a text file that can be read"},
    {"table creus-5.4 --compile --device",
     "--device: missing argument; `raingauge table --help` prints the options"},
    {"table --plan none.json -o out", "none.json: cannot be read: No such file or directory; name "
                                      "a file as `raingauge plan -o` writes it"},
    {"claims", "claims: all tables take hours; name some, as `raingauge list tables` prints them, "
               "or add --budget 4m, --quick or --full"},
    {"claims raster-1", "claims 'raster-1': the paper claims nothing of this table; `raingauge "
                        "table --claims --from results/tables` names the tables that have claims"},
    {"claims none", "claims 'none': no such table; `raingauge table --claims --from "
                    "results/tables` names the tables that have claims"},
    {"claims creus-5.4 raster-1",
     "claims 'raster-1': the paper claims nothing of this table; `raingauge table --claims --from "
     "results/tables` names the tables that have claims"},
    {"claims creus-5.4 --budget x", "--budget 'x': is no time; write it as 90s, 4m or 1h"},
    {"claims --from none", "none: cannot be read: No such file or directory; name a file as "
                           "`raingauge table -o` writes it"},
    {"claims none.table",
     "none.table: No such file or directory; name a text file that can be read"},
    {"sweep", "no technique named; `raingauge list techniques` prints them"},
    {"sweep none", "technique 'none': unknown; the nearest is 'drops', and `raingauge list "
                   "techniques` prints them"},
    {"sweep flow", "--axis: none is of a parameter; name one, as in --axis seed=1,2..5"},
    {"sweep flow --axis device=cpu",
     "--axis: none is of a parameter; name one, as in --axis seed=1,2..5"},
    {"sweep flow --axis seed=1 --axis device=cpu --axis device=gl",
     "--axis device: stands twice; name all devices at once"},
    {"sweep flow --axis seed=1 --axis device=cpu --device gl",
     "--axis device: --device names devices too; leave one of the two out"},
    {"sweep flow --axis nope=1", "parameter 'nope': flow has none of that name; the nearest is "
                                 "'move', and `raingauge list params flow` prints all"},
    {"sweep flow --axis seed=x", "parameter 'seed': 'x' is no whole number"},
    {"sweep flow --axis seed=1,2 --set seed=3",
     "--axis seed: --set seed=3 would give all its rows one value; leave one of the two out"},
    {"sweep flow --axis seed=1 --set nope=3",
     "parameter 'nope': flow has none of that name; the nearest is 'move', and `raingauge list "
     "params flow` prints all"},
    {"sweep flow --axis seed=1,2 --axis drops=1,2 --axis view=box --axis step=1",
     "parameter 'step': flow has none of that name; the nearest is 'seed', and `raingauge list "
     "params flow` prints all"},
};

static const struct refused of_plans[] = {
    {"plan", "plan: name the file to write it to, as -o plan.json"},
    {"plan none", "plan: name the file to write it to, as -o plan.json"},
    {"plan creus-5.4 --device all", "plan: name the file to write it to, as -o plan.json"},
    {"plan creus-5.4 --device nope", "plan: name the file to write it to, as -o plan.json"},
    {"plan creus-5.4 --device cpu,cpu", "plan: name the file to write it to, as -o plan.json"},
    {"plan --missing", "plan --missing: name a plan and folders of records"},
    {"plan --missing p.json", "plan --missing: name a plan and folders of records"},
    {"plan --missing none.json in", "none.json: cannot be read: No such file or directory; name a "
                                    "file as `raingauge plan -o` writes it"},
    {"plan creus-5.4 --shards 0", "--shards 0: must be 1 to 100000"},
    {"plan none -o p.json",
     "table 'none': unknown; the nearest is 'ye-1', and `raingauge list tables` prints them"},
    {"plan creus-5.4 -o p.json --device all", "--device all: which devices there are is known only "
                                              "where cells are measured; name them, as cpu,vulkan"},
    {"plan creus-5.4 -o p.json --device nope",
     "device 'nope': unknown; `raingauge list devices` prints the names"},
    {"plan creus-5.4 -o p.json --device cpu,cpu", "--device: names 'cpu' twice; name it once"},
    {"merge", "merge: name a plan and folders of records"},
    {"merge p.json", "merge: name a plan and folders of records"},
    {"merge p.json in", "merge: name the folder of the tables, as -o tables"},
    {"merge none.json in -o out", "none.json: cannot be read: No such file or directory; name a "
                                  "file as `raingauge plan -o` writes it"},
};

static const struct refused of_comparisons[] = {
    {"verify --frame 0 --stages",
     "--frame 0: --stages compares what the stages of frames leave, at least of 1"},
    {"verify --shard 1/2",
     "--shard: name the folder of its record, as -o verified, which all shards share"},
    {"verify --from none", "none: No such file or directory; name a folder of records"},
    {"verify none", "technique 'none': unknown; the nearest is 'drops', and `raingauge list "
                    "techniques` prints them"},
    {"verify flow --shard 3/2",
     "--shard: name the folder of its record, as -o verified, which all shards share"},
    {"verify flow --shard 0/2",
     "--shard: name the folder of its record, as -o verified, which all shards share"},
    {"verify flow --shard x",
     "--shard: name the folder of its record, as -o verified, which all shards share"},
    {"verify flow -o v --shard 3/2", "--shard 3/2: shard 3 is none of 1 to 2"},
    {"verify flow -o v --shard 0/2", "--shard 0/2: shard 0 is none of 1 to 2"},
    {"verify flow -o v --shard x", "--shard x: write it as 1/4, the first of four, or as auto"},
    {"verify flow -o v --shard 1", "--shard 1: write it as 1/4, the first of four, or as auto"},
    {"verify flow --stages --poses",
     "--poses: unknown option; `raingauge verify --help` prints the options"},
    {"diff", "diff: name a technique, or two image files; `raingauge diff --help` explains"},
    {"diff none", "technique 'none': unknown; the nearest is 'drops', and `raingauge list "
                  "techniques` prints them"},
    {"diff none.png other.png", "none.png: No such file or directory; check the name"},
    {"diff in in",
     "diff: 'in' is a folder; name two pictures, and call diff once for each pair of files"},
    {"diff flow flow", "flow: the extension is missing; use .exr, .png, .hdr or .tif"},
    {"diff flow --set nope=1", "parameter 'nope': flow has none of that name; the nearest is "
                               "'move', and `raingauge list params flow` prints all"},
    {"diff none.png other.png third.png",
     "diff: name a technique, or two image files; `raingauge diff --help` explains"},
    {"diff in flow",
     "diff: 'in' is a folder; name two pictures, and call diff once for each pair of files"},
    {"diff --background b.png flow",
     "--background: belongs to `diff A B`, and 1 argument is given; leave it out, or write that"},
    {"shrink", "no technique named; `raingauge list techniques` prints them"},
    {"shrink none", "technique 'none': unknown; the nearest is 'drops', and `raingauge list "
                    "techniques` prints them"},
    {"shrink flow --device cpu,gl --set nope=1",
     "parameter 'nope': flow has none of that name; the nearest is 'move', and `raingauge list "
     "params flow` prints all"},
    {"shrink flow -o in", "in: is a folder; name a file in it"},
    {"gate", "gate: name two devices, the one that B is held against first, as in `raingauge gate "
             "cpu cpu@OMP_NUM_THREADS=1`, or another build by --against, or a file by --baseline"},
    {"gate --cells none",
     "gate: name two devices, the one that B is held against first, as in `raingauge gate cpu "
     "cpu@OMP_NUM_THREADS=1`, or another build by --against, or a file by --baseline"},
    {"gate cpu gl --cells none",
     "none: No such file or directory; name a text file that can be read"},
    {"gate --from none", "none: No such file or directory; name a folder of records"},
    {"gate --from none cpu", "--from: the shards had their devices; leave out 'cpu'"},
    {"gate cpu gl vulkan",
     "gate: 'vulkan' is one argument too many; `raingauge gate --help` prints the usage"},
    {"gate cpu gl --shard 1/2",
     "--shard: name the folder of its record, as -o gate, which all shards share"},
    {"gate cpu gl --shard 3/2 -o out", "--shard 3/2: shard 3 is none of 1 to 2"},
    {"gate cpu gl --update",
     "--update: there is no file to write; name one by --expectations or --fails"},
    {"gate cpu gl --times t.json",
     "--times: divides the cells among shards; add --shard, or leave it out"},
    {"gate cpu gl --baseline none", "gate: 'cpu' is a device of a pair, and --baseline has pairs "
                                    "of its own; name devices by --device"},
    {"gate cpu gl --against none", "gate: 'cpu' is a device of a pair, and --against has pairs of "
                                   "its own; name devices by --device"},
    {"gate cpu --baseline none --against none", "--baseline and --against: choose one"},
    {"gate --list", "--list: unknown option; `raingauge gate --help` prints the options"},
    {"gate cpu gl --expect none",
     "--expect: unknown option; `raingauge gate --help` prints the options"},
    {"gate cpu gl --pictures none/x",
     "gate: 'none/x' is one argument too many; `raingauge gate --help` prints the usage"},
    {"gate cpu gl --gtest_output=xml:a/b", "a/b: its folder is not there; make it first"},
    {"baseline",
     "baseline: name the file to write, as in `raingauge baseline -o results/baseline.json`"},
    {"baseline -o in", "in: is a folder; name a file in it"},
    {"bisect", "bisect: --run names the command that judges, as in `raingauge bisect --good A "
               "--bad B --run 'raingauge gate \"$RG_GOOD\" \"$RG_CANDIDATE\"' X Y`"},
    {"bisect a", "bisect: --run names the command that judges, as in `raingauge bisect --good A "
                 "--bad B --run 'raingauge gate \"$RG_GOOD\" \"$RG_CANDIDATE\"' X Y`"},
    {"bisect --good a --bad b",
     "bisect: --run names the command that judges, as in `raingauge bisect --good A --bad B --run "
     "'raingauge gate \"$RG_GOOD\" \"$RG_CANDIDATE\"' X Y`"},
    {"bisect --good a --bad a --run x list", "--good and --bad are both 'a'; name two candidates"},
    {"bisect --run x --good a", "bisect: --good and --bad name the two ends; --bad is missing"},
    {"bisect --run x --good a --bad b a c",
     "--bad 'b' is not among the candidates, and the other end is; write it as they have it"},
    {"bisect --run x --good b --bad a a c",
     "--good 'b' is not among the candidates, and the other end is; write it as they have it"},
    {"bisect --run x --good a --bad c a b a c",
     "bisect: the candidate 'a' is there twice; name each once"},
    {"bisect --run x --good a --bad c --git",
     "--git: unknown option; `raingauge bisect --help` prints the options"},
};

static const struct refused of_pictures[] = {
    {"render", "no technique named; `raingauge list techniques` prints them"},
    {"render none", "technique 'none': unknown; the nearest is 'drops', and `raingauge list "
                    "techniques` prints them"},
    {"render flow --device cpu,gl",
     "--device cpu,gl: render draws on one device; `raingauge diff` compares several"},
    {"render flow --frames 5-3", "--frames 5-3: frames count from 0, the first not after the last"},
    {"render flow --frames 3-5 -o a.png",
     "a.png: has no place for the frame's number; name pictures as in rain-%04d.png, or a clip, as "
     "in rain.webm"},
    {"render flow --frame 3 -o a.webm",
     "a.webm: a clip holds several frames; give --frames A-B, or name a picture"},
    {"render flow --frame 3 --frames 3-5", "--frames and --frame: choose one"},
    {"render flow --set nope=1", "parameter 'nope': flow has none of that name; the nearest is "
                                 "'move', and `raingauge list params flow` prints all"},
    {"render --case a.txt flow", "--case a.txt: names its technique itself; leave out 'flow'"},
    {"render flow --fps 3",
     "--fps 3: a clip alone has it; name one (-o NAME.webm), or leave it out"},
    {"render flow --fps 3 -o a%d.png --frames 1-2",
     "--fps 3: a clip alone has it; name one (-o NAME.webm), or leave it out"},
    {"render flow --fps 3 -o a.png --frame 2",
     "--fps 3: a clip alone has it; name one (-o NAME.webm), or leave it out"},
    {"trace", "no technique named; `raingauge list techniques` prints them"},
    {"trace none", "technique 'none': unknown; the nearest is 'drops', and `raingauge list "
                   "techniques` prints them"},
    {"trace flow --set nope=1", "parameter 'nope': flow has none of that name; the nearest is "
                                "'move', and `raingauge list params flow` prints all"},
    {"trace flow -o none/a.json", "none/a.json: its folder is not there; make it first"},
    {"trace flow --json", "--json: unknown option; `raingauge trace --help` prints the options"},
    {"figures none",
     "figure 'none': unknown; the nearest is 'ye-3', and `raingauge list figures` prints them"},
    {"figures creus-4.3 none",
     "figure 'none': unknown; the nearest is 'ye-3', and `raingauge list figures` prints them"},
    {"figures creus-4.3 --device cpu,gl",
     "--device cpu,gl: figures draws on one device; `raingauge diff` compares several"},
    {"atlas none", "technique 'none': unknown; the nearest is 'drops', and `raingauge list "
                   "techniques` prints them"},
    {"atlas flow", "technique 'flow': it generates no textures; `raingauge atlas --help`"},
    {"atlas cartoon --quick", "atlas cartoon: --from, --compare, --measured, --quick and --full "
                              "are about the streak atlas; leave them out"},
    {"atlas cartoon --full", "atlas cartoon: --from, --compare, --measured, --quick and --full are "
                             "about the streak atlas; leave them out"},
    {"atlas cartoon --from in", "atlas cartoon: --from, --compare, --measured, --quick and --full "
                                "are about the streak atlas; leave them out"},
    {"atlas cartoon --measured", "atlas cartoon: --from, --compare, --measured, --quick and --full "
                                 "are about the streak atlas; leave them out"},
    {"atlas cartoon --compare in", "atlas cartoon: --from, --compare, --measured, --quick and "
                                   "--full are about the streak atlas; leave them out"},
    {"atlas --compare none",
     "none: No such file or directory; name a folder with pictures of the database"},
    {"atlas --from in --measured", "--measured and --from: choose one"},
};

static const struct refused of_others[] = {
    {"list none", "list 'none': unknown; the nearest is 'tables', and there are techniques, "
                  "tables, figures, devices and params TECHNIQUE"},
    {"list", "list: name what to list: techniques, tables, figures, devices, or params TECHNIQUE"},
    {"list params", "list params: name a technique; `raingauge list techniques` prints them"},
    {"list params none", "technique 'none': unknown; the nearest is 'drops', and `raingauge list "
                         "techniques` prints them"},
    {"list params flow more",
     "list: 'more' is one argument too many; `raingauge list --help` prints the usage"},
    {"list techniques more",
     "list: 'more' is one argument too many; `raingauge list --help` prints the usage"},
    {"doctor --kernels none", "--kernels: there is no kernel 'none'; `all`, or names of kernels "
                              "with commas between them, as lines about drivers have them"},
    {"doctor --prologue --json", "--prologue and --json: choose one"},
    {"doctor --kernels a --fixed-function", "--fixed-function and --kernels: choose one"},
    {"report", "report: names no records; name files or folders, such as results/tables"},
    {"report none", "none: cannot be read: No such file or directory; name what a command wrote "
                    "with --json or -o (docs/records.md)"},
    {"report a --format nope", "--format nope: choose html, md or badge"},
    {"report in", "in: holds no .json and no figures.md; name what a command wrote with --json or "
                  "-o (docs/records.md)"},
};

static void expect_refused(const struct refused *rows, size_t size)
{
    asked_opening = RG_EXIT_HARNESS;
    assert_int_equal(mkdir("in", 0777), 0);
    for (size_t i = 0; i < size / sizeof(*rows); i++) {
        const int exit = asked_run(rows[i].line);
        if (exit != RG_EXIT_USAGE || strcmp(asked_logged, rows[i].logged) != 0)
            fail_msg("%s: status %d, '%s'", rows[i].line, exit, asked_logged);
        assert_string_equal(asked_printed, "");
        if (*asked_seen && strcmp(asked_seen, "memory 0; ") != 0)
            fail_msg("%s: %s", rows[i].line, asked_seen);
    }
}

static void tables_are_refused(void **state)
{
    (void)state;
    expect_refused(of_tables, sizeof(of_tables));
}

static void plans_are_refused(void **state)
{
    (void)state;
    expect_refused(of_plans, sizeof(of_plans));
}

static void comparisons_are_refused(void **state)
{
    (void)state;
    expect_refused(of_comparisons, sizeof(of_comparisons));
}

static void pictures_are_refused(void **state)
{
    (void)state;
    expect_refused(of_pictures, sizeof(of_pictures));
}

static void other_words_are_refused(void **state)
{
    (void)state;
    expect_refused(of_others, sizeof(of_others));
}

#define ASKED(test) cmocka_unit_test_setup_teardown(test, asked_setup, asked_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        ASKED(tables_are_refused),   ASKED(plans_are_refused),       ASKED(comparisons_are_refused),
        ASKED(pictures_are_refused), ASKED(other_words_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
