// Which cases a gate has, of which pair, with which sides, and how shards divide them.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/compare/gate/run/running.h"
#include "tests/harness/gate/cells/read.h"
#include "tests/tools/expect.h"

// A stand-in: one device has fixed functions.
bool rg_gate_has_fixed(const struct rg_baseline *baseline, const struct rg_gate_pair *pair)
{
    (void)baseline;
    return !strcmp(pair->names[RG_SIDE_B], "vulkan");
}

static const char text_of_cells[] = "one raster 16x16 1\ntwo raster 16x16 1\n"
                                    "three raster 16x16 1\nfour raster 16x16 1\n";
static const struct rg_gate_pairs pairs = {.count = 2,
                                           .all = {{{"cpu", "gl"}}, {{"gl", "vulkan"}}}};
static const struct rg_gate_pairs alone = {.count = 2, .all = {{{"", "gl"}}, {{"", "vulkan"}}}};

static int set_up(void **state)
{
    (void)state;
    return read_cells(text_of_cells);
}

struct choice {
    struct rg_gate gate;
    struct rg_running_gate run;
    char names[400]; // of the shard's cases
};

static void choose(const struct rg_gate_request *request, struct choice *made)
{
    *made = (struct choice){.run = {.asked = request}};
    made->run.gate = &made->gate;
    assert_true(rg_gate_choose(&made->run));
    for (int i = 0; i < made->gate.case_count; i++)
        snprintf(made->names + strlen(made->names), sizeof(made->names) - strlen(made->names),
                 "%s%s", i ? " " : "", made->gate.cases[i].name);
}

static void assert_all(const struct rg_gate *gate, const char *due)
{
    char names[400] = "";
    size_t i;
    const json_t *name;
    json_array_foreach(gate->names, i, name)
    {
        snprintf(names + strlen(names), sizeof(names) - strlen(names), "%s%s", i ? " " : "",
                 json_string_value(name));
    }
    assert_string_equal(names, due);
}

#define OF_GL     "one.gl two.gl three.gl four.gl"
#define OF_VULKAN "one.vulkan two.vulkan three.vulkan four.vulkan"

static void cases_are_those_of_the_filter_pair_by_pair(void **state)
{
    (void)state;
    static const struct {
        const char *filter, *cases, *all;
        int of_gl, of_vulkan;
        bool has_fixed;
    } rows[] = {
        {NULL, OF_GL " " OF_VULKAN, OF_GL " " OF_VULKAN " fixed.vulkan", 4, 4, true},
        {"*.gl", OF_GL, OF_GL, 4, 0, false},
        {"t*-*.gl", "two.vulkan three.vulkan", "two.vulkan three.vulkan", 0, 2, false},
        {"fixed*:four.gl", "four.gl", "four.gl fixed.vulkan", 1, 0, true},
        {"no*", "", "", 0, 0, false},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const struct rg_gate_request request = {
            .cells = &cells, .pairs = &pairs, .shard = {1, 1}, .filter = rows[i].filter};
        struct choice made;
        choose(&request, &made);
        assert_string_equal(made.names, rows[i].cases);
        assert_all(&made.gate, rows[i].all);
        assert_int_equal(made.gate.chosen, json_array_size(made.gate.names));
        assert_int_equal(made.run.family[0], rows[i].of_gl);
        assert_int_equal(made.run.family[1], rows[i].of_vulkan);
        assert_int_equal(made.run.sides[3].has_fixed, rows[i].has_fixed);
        assert_false(made.run.sides[1].has_fixed);
        rg_gate_free(&made.gate);
    }
}

static void a_case_has_the_sides_of_its_pair(void **state)
{
    (void)state;
    const struct rg_gate_request request = {.cells = &cells, .pairs = &pairs, .shard = {1, 1}};
    struct choice made;
    choose(&request, &made);
    assert_int_equal(made.run.side_count, 4);
    for (int i = 0; i < 8; i++) {
        const struct rg_gate_case *c = &made.gate.cases[i];
        assert_ptr_equal(c->cell, &cells.cells[i % 4]);
        assert_int_equal(c->pair, i / 4);
        assert_int_equal(c->place, i);
        assert_int_equal(c->expectation, -1);
        assert_int_equal(c->device_count, 2);
        assert_null(c->before);
        for (int side = 0; side < RG_SIDES; side++) {
            assert_ptr_equal(c->sides[side], &made.run.sides[i / 4 * 2 + side]);
            assert_string_equal(c->sides[side]->name, pairs.all[i / 4].names[side]);
            assert_ptr_equal(c->devices[side], c->sides[side]->name);
        }
    }
    rg_gate_free(&made.gate);
}

// A baseline whose rows took these seconds: first those of gl, then those of vulkan.
static struct rg_baseline baseline_of(const double seconds[8])
{
    struct rg_baseline baseline = {.count = 0};
    for (int i = 0; i < 8; i++) {
        struct rg_baseline_row *row = rg_baseline_add(&baseline);
        assert_non_null(row);
        snprintf(row->cell, sizeof(row->cell), "%s", cells.cells[i % 4].name);
        snprintf(row->device, sizeof(row->device), "%s", i < 4 ? "gl" : "vulkan");
        row->seconds = seconds[i];
    }
    return baseline;
}

static void with_a_baseline_b_runs_alone_and_all_are_timed_together(void **state)
{
    (void)state;
    static const double seconds[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    struct rg_baseline baseline = baseline_of(seconds);
    const struct rg_gate_request request = {
        .cells = &cells, .pairs = &alone, .baseline = &baseline, .shard = {1, 1}};
    struct choice made;
    choose(&request, &made);
    assert_string_equal(made.names, OF_GL " " OF_VULKAN);
    assert_int_equal(made.run.family[0], 8);
    assert_int_equal(made.run.family[1], 0);
    for (int i = 0; i < 8; i++) {
        const struct rg_gate_case *c = &made.gate.cases[i];
        assert_ptr_equal(c->before, &baseline.rows[i]);
        assert_int_equal(c->pair, 0);
        assert_null(c->sides[RG_SIDE_A]);
        assert_ptr_equal(c->sides[RG_SIDE_B], &made.run.sides[i / 4 * 2 + 1]);
        assert_int_equal(c->device_count, 1);
        assert_string_equal(c->devices[0], i < 4 ? "gl" : "vulkan");
    }
    assert_true(made.run.sides[3].has_fixed);
    rg_gate_free(&made.gate);
    rg_baseline_free(&baseline);
}

// --- shards ---

// The names of the cases that one of two shards has.
static void assert_shard(struct rg_gate_request request, int number, const char *due)
{
    struct choice made;
    request.shard = (struct rg_shard){number, 2};
    choose(&request, &made);
    assert_string_equal(made.names, due);
    rg_gate_free(&made.gate);
}

// The largest goes first, each to the shard with the least so far; an unknown time counts as the
// mean of the known ones, here 22/3.
static void shards_divide_cases_by_their_seconds(void **state)
{
    (void)state;
    json_t *times = json_pack("{s:f, s:i, s:f}", "one.gl", 10.0, "three.gl", 6, "four.gl", 6.0);
    static const double seconds[8] = {1, 2, 4, 8, 0, 0, 0, 0};
    struct rg_baseline baseline = baseline_of(seconds);
    struct rg_gate_request request = {.cells = &cells, .pairs = &pairs, .filter = "*.gl"};
    assert_shard(request, 1, "one.gl three.gl");
    assert_shard(request, 2, "two.gl four.gl");
    request.times = times;
    assert_shard(request, 1, "one.gl four.gl");
    assert_shard(request, 2, "two.gl three.gl");
    request.is_apart = true;
    assert_shard(request, 1, "one.gl three.gl");
    request.is_apart = false;
    request.pairs = &alone;
    request.baseline = &baseline;
    request.times = NULL;
    assert_shard(request, 1, "four.gl");
    assert_shard(request, 2, "one.gl two.gl three.gl");
    request.times = times; // that of an earlier gate goes before that of the baseline
    assert_shard(request, 1, "one.gl two.gl");
    assert_shard(request, 2, "three.gl four.gl");
    json_decref(times);
    rg_baseline_free(&baseline);
}

// Fixed functions are divided with the cells, and are no cell of a course.
static void fixed_functions_go_to_one_shard(void **state)
{
    (void)state;
    const struct rg_gate_request request = {
        .cells = &cells, .pairs = &pairs, .filter = "*.vulkan", .shard = {1, 2}};
    struct rg_gate_request other = request;
    struct choice first, second;
    other.shard.number = 2;
    choose(&request, &first);
    choose(&other, &second);
    assert_string_equal(first.names, "one.vulkan three.vulkan");
    assert_string_equal(second.names, "two.vulkan four.vulkan");
    assert_true(first.run.sides[3].has_fixed && !second.run.sides[3].has_fixed);
    assert_int_equal(first.gate.cases[1].place, 2);
    assert_int_equal(second.gate.cases[1].place, 3);
    assert_true(first.run.family[1] == 4 && second.run.family[1] == 4);
    rg_gate_free(&first.gate);
    rg_gate_free(&second.gate);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cases_are_those_of_the_filter_pair_by_pair),
        cmocka_unit_test(a_case_has_the_sides_of_its_pair),
        cmocka_unit_test(with_a_baseline_b_runs_alone_and_all_are_timed_together),
        cmocka_unit_test(shards_divide_cases_by_their_seconds),
        cmocka_unit_test(fixed_functions_go_to_one_shard),
    };
    return cmocka_run_group_tests(tests, set_up, free_cells);
}
