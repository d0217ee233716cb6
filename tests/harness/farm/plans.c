// Plans: which cells, in which groups, for how long, and in how many shards; and that a plan's file
// says the same, or is refused.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/record/disk/seal.h"
#include "harness/tables/claims/claim.h"
#include "harness/tables/farm/cut.h"
#include "harness/tables/papers/papers.h"
#include "kernels/dialect/rng.h"
#include "tests/harness/farm/made.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

static char path[64];

static void plan_table(struct rg_farm_plan *plan, const char *id, bool full, const char *devices)
{
    const struct rg_table *table = rg_table_find(id);
    *plan = (struct rg_farm_plan){.full = full, .commit = "a commit"};
    assert_true(rg_farm_name_devices(plan, devices));
    assert_true(rg_farm_make(plan, &table, 1));
}

// --- cells and groups ---

// Rows of a claim are one group. feng-1's claims are about each row by itself, or about two.
static void test_groups(void **state)
{
    (void)state;
    struct rg_farm_plan plan;
    plan_table(&plan, "stuppacher-2", false, "cpu");
    assert_int_equal(plan.group_count, 1);
    assert_string_equal(plan.groups[0].id, "stuppacher-2/1-3");
    assert_int_equal(plan.cell_count, 9); // three rows, works paper, reading and ours
    rg_farm_plan_free(&plan);
    plan_table(&plan, "raster-1", false, "cpu,cpu:reference"); // no paper claims anything of it
    assert_int_equal(plan.group_count, 4);
    assert_string_equal(plan.groups[3].id, "raster-1/4");
    assert_int_equal(plan.groups[3].cell_count, 2);
    rg_farm_plan_free(&plan);
    plan_table(&plan, "creus-5.1", true, "cpu"); // textures
    assert_int_equal(plan.group_count, 1);
    rg_farm_plan_free(&plan);
}

// A claim about each row by itself ties none; rows that no claim ties stand alone.
static void test_ids_of_groups(void **state)
{
    (void)state;
    static const struct {
        const char *table;
        bool full;
        const char *ids; // of the first groups
        int groups;
    } rows[] = {{"creus-5.3", true, "creus-5.3/1-9 creus-5.3/10-18 ", 2},
                {"creus-5.5", true, "creus-5.5/1-9 creus-5.5/10 creus-5.5/11 ", 3},
                {"feng-1", false, "feng-1/1,4,7 ", 1},
                {"feng-1", true, "feng-1/1-7 ", 1},
                {"feng-2", true, "feng-2/1-5 feng-2/6 feng-2/7 ", 26},
                {"ye-1", true, "ye-1/1 ye-1/2 ye-1/3 ye-1/4 ye-1/5 ", 5},
                {"chin-timing", true, "chin-timing/1 ", 1}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_farm_plan plan;
        char ids[8192] = "";
        plan_table(&plan, rows[i].table, rows[i].full, "cpu");
        for (int64_t g = 0; g < plan.group_count; g++)
            snprintf(ids + strlen(ids), sizeof(ids) - strlen(ids), "%s ", plan.groups[g].id);
        if (strncmp(ids, rows[i].ids, strlen(rows[i].ids)) != 0)
            fail_msg("%s begins with %s, not %s", rows[i].table, ids, rows[i].ids);
        assert_int_equal(plan.group_count, rows[i].groups);
        rg_farm_plan_free(&plan);
    }
}

// Rows with gaps, and claims that have a row in common: rows 1, 3 and 8, and 5, 6 and 7.
static void test_rows_with_gaps(void **state)
{
    (void)state;
    static const struct rg_claim gaps[] = {
        {.table = "creus-5.4", .variant = "full", .test = RG_CLAIM_RATIO, .first = 5, .last = 6},
        {.table = "creus-5.4", .variant = "full", .test = RG_CLAIM_RATIO, .first = 3, .last = 8},
        {.table = "creus-5.4", .variant = "full", .test = RG_CLAIM_RATIO, .first = 7, .last = 6},
        {.table = "creus-5.4", .variant = "full", .test = RG_CLAIM_RATIO, .first = 8, .last = 1},
        {.table = "creus-5.4", .variant = "full", .test = RG_CLAIM_RATE, .first = 1, .last = 8},
        {.table = "creus-5.3", .variant = "full", .test = RG_CLAIM_FALLS, .first = 1, .last = 8},
        {.table = NULL}};
    static const char *const ids[] = {"creus-5.4/1,3,8", "creus-5.4/2", "creus-5.4/4",
                                      "creus-5.4/5-7"};
    const struct rg_claim *all = rg_claims;
    struct rg_farm_plan plan;
    rg_claims = gaps;
    plan_table(&plan, "creus-5.4", true, "cpu");
    rg_claims = all;
    assert_int_equal(plan.group_count, 4);
    for (int g = 0; g < 4; g++)
        assert_string_equal(plan.groups[g].id, ids[g]);
    // Each of three works and two variants, row by row.
    assert_int_equal(plan.groups[0].cell_count, 3 * 3 * 2);
    for (int i = 0; i < 18; i++)
        assert_int_equal(plan.cells[i].row, i < 6 ? 1 : i < 12 ? 3 : 8);
    assert_string_equal(plan.cells[1].variant, "no_geometry");
    assert_string_equal(plan.cells[2].work, "reading");
    rg_farm_plan_free(&plan);
}

// Quick mode plans the rows that it measures, and a work that few devices can do is left out.
static void test_rows_and_works(void **state)
{
    (void)state;
    struct rg_farm_plan quick, full;
    plan_table(&quick, "feng-1", false, "cpu");
    plan_table(&full, "feng-1", true, "cpu");
    assert_below(quick.cell_count, full.cell_count);
    assert_false(rg_farm_has_row(&quick, 0, quick.group_count, 1));
    assert_true(rg_farm_has_row(&full, 0, full.group_count, 1));
    for (int64_t i = 0; i < full.cell_count; i++)
        assert_string_not_equal(full.cells[i].work, "queries");
    rg_farm_plan_free(&quick);
    rg_farm_plan_free(&full);
}

// Ids name cells, are unique, and stay the same whatever else is planned.
static void test_ids(void **state)
{
    (void)state;
    struct rg_farm_plan plan, more;
    char id[RG_FARM_ID], other[RG_FARM_ID];
    plan_table(&plan, "stuppacher-2", false, "cpu:reference");
    plan_table(&more, "stuppacher-2", false, "new=cpu@A=1,cpu:reference");
    rg_farm_cell_id(&plan, &plan.groups[0], &plan.cells[0], id, sizeof(id));
    assert_string_equal(id, "stuppacher-2/1/paper/full/cpu:reference");
    rg_farm_cell_id(&more, &more.groups[0], &more.cells[1], other, sizeof(other));
    assert_string_equal(other, id);
    rg_farm_cell_id(&more, &more.groups[0], &more.cells[0], other, sizeof(other));
    assert_string_equal(other, "stuppacher-2/1/paper/full/new");
    assert_string_equal(more.devices[0].asked, "new=cpu@A=1");
    for (int64_t i = 0; i < more.cell_count; i++)
        for (int64_t k = 0; k < i; k++) {
            rg_farm_cell_id(&more, &more.groups[0], &more.cells[i], id, sizeof(id));
            rg_farm_cell_id(&more, &more.groups[0], &more.cells[k], other, sizeof(other));
            assert_string_not_equal(id, other);
        }
    rg_farm_plan_free(&plan);
    rg_farm_plan_free(&more);
}

static void test_devices(void **state)
{
    (void)state;
    static const char *const wrong[] = {"all", "cpu,all", "cpu,new=cpu@A=1,cpu"};
    rg_log_listen(log_last, NULL);
    for (size_t i = 0; i < 3; i++) {
        struct rg_farm_plan plan = {0};
        assert_false(rg_farm_name_devices(&plan, wrong[i]));
        assert_non_null(strstr(logged, i < 2 ? "--device all: " : "'cpu' twice"));
    }
    struct rg_farm_plan plan = {0};
    assert_false(rg_farm_name_devices(&plan, "cpu,fog"));
    assert_non_null(strstr(logged, "device 'fog': unknown"));
    rg_log_listen(NULL, NULL);
    plan = (struct rg_farm_plan){0};
    assert_true(rg_farm_name_devices(&plan, "many=cpu@B=2,cpu,cpu:reference"));
    static const char *const due[][2] = {
        {"many", "many=cpu@B=2"}, {"cpu", "cpu"}, {"cpu:reference", "cpu:reference"}};
    assert_int_equal(plan.device_count, 3);
    for (int d = 0; d < 3; d++) {
        assert_string_equal(plan.devices[d].name, due[d][0]);
        assert_string_equal(plan.devices[d].asked, due[d][1]);
    }
}

// A plan has as many devices as a record.
static void test_too_many_devices(void **state)
{
    (void)state;
    char names[64 * (RG_MAX_DEVICES + 1)] = "";
    struct rg_farm_plan plan = {0};
    for (int d = 0; d < RG_MAX_DEVICES; d++)
        snprintf(names + strlen(names), sizeof(names) - strlen(names), "%sd%d=cpu@N=%d",
                 d ? "," : "", d, d);
    assert_true(rg_farm_name_devices(&plan, names));
    assert_int_equal(plan.device_count, RG_MAX_DEVICES);
    plan = (struct rg_farm_plan){0};
    snprintf(names + strlen(names), sizeof(names) - strlen(names), ",more=cpu@N=more");
    rg_log_listen(log_last, NULL);
    assert_false(rg_farm_name_devices(&plan, names));
    rg_log_listen(NULL, NULL);
    assert_non_null(strstr(logged, "--device: more than "));
}

// --- expected times ---

// A stored result of a farm's table, whose frames take so long.
static struct rg_result stored_result(const struct farm *farm, int rows, double frame_ms)
{
    struct rg_result result = measure_group(farm, 0, 0);
    const struct rg_record filled = *rg_result_at(&result, (struct rg_place){0});
    result.last_row = rows - 1;
    for (int row = 0; row < rows; row++) {
        assert_true(rg_table_add_row(&result, &farm->tables[0], row));
        for (struct rg_place at = rg_result_start_row(row); rg_result_next_in_row(&result, &at);) {
            struct rg_record *record = rg_result_at(&result, at);
            record->create_ms = filled.create_ms;
            record->first_frame_ms = frame_ms;
            record->sample_count = 6;
            for (int i = 0; i < 6; i++)
                record->samples_ms[i] = (row + 1) * frame_ms;
            rg_record_settle(record);
        }
    }
    return result;
}

// Cells with a record are known, and longer frames take longer; others get the mean of those.
static void test_expected(void **state)
{
    (void)state;
    struct farm farm;
    make_farm(&farm, 2, 4, 1);
    struct rg_result result = stored_result(&farm, 3, 400);
    const struct rg_stored stored = {.count = 1, .results = &result}, none = {.count = 0};
    assert_int_equal(rg_farm_expect(&farm.plan, farm.all, 2, &stored, 1), 6);
    const struct rg_farm_cell *cells = farm.plan.cells;
    assert_true(cells[0].is_known && cells[5].is_known && !cells[6].is_known);
    assert_above(cells[2].seconds, cells[0].seconds);
    assert_above(cells[4].seconds, cells[2].seconds);
    // Six samples, and check frames, of 0.4 s each at least.
    assert_at_least(cells[0].seconds, 6 * 0.4);
    const double mean = (cells[0].seconds + cells[2].seconds + cells[4].seconds) / 3;
    assert_near(cells[6].seconds, mean, 1e-9);
    assert_near(cells[8].seconds, mean, 1e-9);
    assert_near(farm.plan.groups[0].seconds, cells[0].seconds + cells[1].seconds, 1e-9);
    // Without records the machine's speed is all that is known.
    assert_int_equal(rg_farm_expect(&farm.plan, farm.all, 2, &none, 1), 6); // stays known
    rg_result_free(&result);
    unmake_farm(&farm);
    make_farm(&farm, 1, 2, 1);
    assert_int_equal(rg_farm_expect(&farm.plan, farm.all, 1, &none, 1), 0);
    const double slow_s = farm.plan.cells[0].seconds;
    assert_int_equal(rg_farm_expect(&farm.plan, farm.all, 1, &none, 0.5), 0);
    assert_below(farm.plan.cells[0].seconds, slow_s);
    assert_above(farm.plan.cells[0].seconds, 0);
    unmake_farm(&farm);
}

// Of records of both lengths those of the plan's count; without them the others do.
static void test_lengths(void **state)
{
    (void)state;
    struct farm farm;
    make_farm(&farm, 1, 2, 1);
    struct rg_result both[] = {stored_result(&farm, 2, 800), stored_result(&farm, 2, 400)};
    const struct rg_stored quick = {.count = 1, .results = &both[1]};
    const struct rg_stored all = {.count = 2, .results = both};
    const struct rg_stored full = {.count = 1, .results = both};
    both[0].full = true;
    assert_int_equal(rg_farm_expect(&farm.plan, farm.all, 1, &quick, 1), 4);
    const double quick_s = farm.plan.cells[0].seconds;
    assert_int_equal(rg_farm_expect(&farm.plan, farm.all, 1, &all, 1), 4);
    assert_equals(farm.plan.cells[0].seconds, quick_s);
    assert_int_equal(rg_farm_expect(&farm.plan, farm.all, 1, &full, 1), 4);
    assert_above(farm.plan.cells[0].seconds, quick_s);
    for (int i = 0; i < 2; i++)
        rg_result_free(&both[i]);
    unmake_farm(&farm);
}

// --- shards ---

static void fill_groups(struct rg_farm_plan *plan, int count, uint seed)
{
    const struct rg_farm_cell cell = {.row = 1, .variant = "full"};
    *plan = (struct rg_farm_plan){.device_count = 1, .devices = {{"cpu", "cpu"}}};
    for (int i = 0; i < count; i++) {
        char id[32];
        const double chance = rg_random(3, seed, (uint)i, 0).x / 4294967296.0;
        snprintf(id, sizeof(id), "t-%d/1", i);
        assert_true(rg_farm_add_group(plan, "t", id) && rg_farm_add_cell(plan, &cell));
        plan->cells[i].seconds = exp(6 * chance); // 1 to 400 s
    }
}

// Every group is in one shard. The longest is at most 1.3 times the mean, or the largest group.
static void test_cut(void **state)
{
    (void)state;
    for (uint seed = 0; seed < 50; seed++) {
        struct rg_farm_plan plan;
        const int count = 1 + (int)(rg_random(4, seed, 0, 0).x % 200), shards = 1 + (int)seed % 16;
        int shard_of[200], again[200];
        double taken[16] = {0}, longest = 0, told, most = 0;
        fill_groups(&plan, count, seed);
        const double mean = rg_farm_sum(&plan) / shards;
        assert_true(rg_farm_cut(&plan, shards, shard_of, &told));
        assert_true(rg_farm_cut(&plan, shards, again, NULL));
        assert_memory_equal(shard_of, again, (size_t)count * sizeof(*again));
        for (int g = 0; g < count; g++) {
            assert_between(shard_of[g], 1, shards);
            taken[shard_of[g] - 1] += plan.groups[g].seconds;
            most = fmax(most, plan.groups[g].seconds);
        }
        for (int s = 0; s < shards; s++)
            longest = fmax(longest, taken[s]);
        assert_near(longest, told, 1e-9 * longest);
        assert_at_most(longest, fmax(1.3 * mean, most) * (1 + 1e-12));
        rg_farm_plan_free(&plan);
    }
}

// --- a file ---

static void expect_cells(const struct rg_farm_plan *found, const struct rg_farm_plan *due)
{
    for (int64_t g = 0; g < found->group_count; g++) {
        assert_string_equal(found->groups[g].id, due->groups[g].id);
        assert_int_equal(found->groups[g].first_cell, due->groups[g].first_cell);
        assert_int_equal(found->groups[g].cell_count, due->groups[g].cell_count);
        assert_string_equal(found->groups[g].table, due->groups[g].table);
        assert_near(found->groups[g].seconds, due->groups[g].seconds, 1e-6);
    }
    for (int64_t i = 0; i < found->cell_count; i++) {
        assert_int_equal(found->cells[i].row, due->cells[i].row);
        assert_int_equal(found->cells[i].device, due->cells[i].device);
        assert_string_equal(found->cells[i].work, due->cells[i].work);
        assert_string_equal(found->cells[i].variant, due->cells[i].variant);
    }
}

static void test_file(void **state)
{
    (void)state;
    struct farm farm;
    struct rg_farm_plan found = {0};
    make_farm(&farm, 2, 3, 2);
    farm.plan.shards = 7;
    farm.plan.full = true;
    snprintf(farm.plan.devices[1].asked, RG_FARM_ASKED, "cpu:reference@A=1");
    snprintf(farm.plan.cells[2].work, RG_NAME_SIZE, "ours");
    farm.plan.cells[1] = (struct rg_farm_cell){1, "", "v0", 1, 1.0 / 3, true};
    rg_farm_sum(&farm.plan);
    assert_true(rg_farm_plan_write(&farm.plan, path));
    assert_true(rg_farm_plan_read(&found, path));
    assert_string_equal(found.digest, farm.plan.digest);
    assert_int_equal(strlen(found.digest), 16);
    assert_string_equal(found.commit, farm.plan.commit);
    assert_int_equal(found.shards, 7);
    assert_int_equal(found.group_count, farm.plan.group_count);
    assert_int_equal(found.cell_count, farm.plan.cell_count);
    expect_cells(&found, &farm.plan);
    assert_true(found.full);
    assert_int_equal(found.device_count, 2);
    assert_string_equal(found.devices[0].name, "cpu");
    assert_string_equal(found.devices[1].name, "cpu:reference");
    assert_string_equal(found.devices[1].asked, "cpu:reference@A=1");
    assert_true(found.cells[1].is_known && !found.cells[0].is_known);
    assert_equals(found.cells[1].seconds, 0.333333333);
    assert_int_equal(found.cells[1].device, 1);
    rg_farm_plan_free(&found);
    unmake_farm(&farm);
    unlink(path);
}

// A cell has an id for people, and the whole document no more than what is read.
static void test_document(void **state)
{
    (void)state;
    static const char due[] =
        "{\"format\":1,\"commit\":\"abc\",\"full\":false,\"shards\":3,\"devices\":[{\"name\":"
        "\"cpu\","
        "\"asked\":\"cpu@A=1\"}],\"groups\":[{\"id\":\"t/2\",\"table\":\"t\",\"cells\":[{\"id\":"
        "\"t/2/ours/v/"
        "cpu\",\"row\":2,\"work\":\"ours\",\"variant\":\"v\",\"seconds\":2.5,\"known\":"
        "true,\"device\":\"cpu\"},{\"id\":\"t/3/w/cpu\",\"row\":3,\"work\":\"\",\"variant\":\"w\","
        "\"seconds\":1,\"known\":false,\"device\":\"cpu\"}]}]}";
    const struct rg_farm_cell cells[] = {{2, "ours", "v", 0, 2.5, true}, {3, "", "w", 0, 1, false}};
    struct rg_farm_plan plan = {.commit = "abc", .shards = 3, .device_count = 1};
    snprintf(plan.devices[0].name, RG_DEVICE_NAME_SIZE, "cpu");
    snprintf(plan.devices[0].asked, RG_FARM_ASKED, "cpu@A=1");
    assert_true(rg_farm_add_group(&plan, "t", "t/2"));
    for (int i = 0; i < 2; i++)
        assert_true(rg_farm_add_cell(&plan, &cells[i]));
    assert_true(rg_farm_plan_write(&plan, path));
    json_t *document = json_load_file(path, 0, NULL);
    assert_non_null(document);
    assert_string_equal(json_string_value(json_object_get(document, "checksum")), plan.digest);
    json_object_del(document, "checksum");
    char *text = json_dumps(document, JSON_COMPACT | JSON_REAL_PRECISION(6));
    assert_string_equal(text, due);
    free(text);
    json_decref(document);
    rg_farm_plan_free(&plan);
    assert_true(!plan.cells && !plan.groups && !plan.group_count && !plan.device_count);
    unlink(path);
}

static void replace(const char *from, const char *to)
{
    FILE *file = fopen(path, "rb");
    static char text[1 << 16], changed[1 << 16];
    assert_non_null(file);
    text[fread(text, 1, sizeof(text) - 1, file)] = 0;
    fclose(file);
    const char *at = strstr(text, from);
    assert_non_null(at);
    snprintf(changed, sizeof(changed), "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
    file = fopen(path, "wb");
    fputs(changed, file);
    fclose(file);
}

static void test_refused(void **state)
{
    (void)state;
    static const struct {
        const char *from, *to, *says;
    } rows[] = {{"\"row\": 2", "\"row\": 3", "was changed or cut since it was made; make it anew"},
                {"\"seconds\": 1", "\"seconds\": 2", "was changed or cut"},
                {"\"shards\": 0", "\"shards\": 9", "was changed or cut"},
                {"\"checksum\"", "\"checksun\"", "was changed or cut"},
                {"\"format\": 1", "\"format\": 2", "format is 2, and this raingauge reads 1"},
                {"\"groups\": [", "\"groups\": [}", "is no JSON"},
                {"\"groups\"", "\"cells\"", "is no plan"}};
    struct farm farm;
    make_farm(&farm, 1, 3, 1);
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_farm_plan found = {0};
        assert_true(rg_farm_plan_write(&farm.plan, path));
        replace(rows[i].from, rows[i].to);
        rg_log_listen(log_last, NULL);
        assert_false(rg_farm_plan_read(&found, path));
        rg_log_listen(NULL, NULL);
        if (!strstr(logged, rows[i].says) || !strstr(logged, path))
            fail_msg("'%s' is not in: %s", rows[i].says, logged);
        rg_farm_plan_free(&found);
    }
    unmake_farm(&farm);
    unlink(path);
}

// Writes a plan again with another value at a place, under a seal that fits.
static void seal_with(const char *text)
{
    json_error_t error;
    json_t *json = json_loads(text, 0, &error);
    assert_non_null(json);
    assert_true(rg_seal(json));
    assert_int_equal(json_dump_file(json, path, RG_JSON_FLAGS), 0);
    json_decref(json);
}

#define HEAD    "\"format\":1,\"commit\":\"c\",\"full\":false,\"shards\":0,"
#define DEVICES "\"devices\":[{\"name\":\"cpu\",\"asked\":\"cpu\"}],"
#define CELL(row, device)                                                                          \
    "{\"row\":" row                                                                                \
    ",\"work\":\"\",\"variant\":\"v\",\"seconds\":1,\"known\":false,\"device\":\"" device "\"}"
#define GROUP(cells) "{\"id\":\"t/1\",\"table\":\"t\",\"cells\":[" cells "]}"

// A plan that is sealed, and yet none that raingauge wrote: the line names the place.
static void test_malformed(void **state)
{
    (void)state;
    static const struct {
        const char *text, *says; // NULL: it is read
    } rows[] = {
        {"{" HEAD DEVICES "\"groups\":[" GROUP(CELL("1", "cpu")) "]}", NULL},
        {"{" HEAD DEVICES "\"groups\":[" GROUP(CELL("1", "cpu") "," CELL("2", "gl")) "]}",
         "groups[0].cells[1].device is 'gl', which 'devices' does not name"},
        {"{" HEAD DEVICES "\"groups\":[" GROUP(CELL("1", "cpu")) "," GROUP("") "]}",
         "groups[1].cells is empty"},
        {"{" HEAD DEVICES "\"groups\":[" GROUP(CELL("0", "cpu")) "]}", "groups[0].cells[0].row"},
        {"{" HEAD DEVICES "\"groups\":[{\"table\":\"t\",\"cells\":[]}]}", "groups[0].id"},
        {"{" HEAD "\"devices\":[{\"name\":\"cpu\"}],\"groups\":[" GROUP(CELL("1", "cpu")) "]}",
         "devices[0].asked"},
        {"{\"format\":1,\"full\":false,\"shards\":0," DEVICES
         "\"groups\":[" GROUP(CELL("1", "cpu")) "]}",
         "commit"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_farm_plan found = {0};
        seal_with(rows[i].text);
        rg_log_listen(log_last, NULL);
        *logged = 0;
        assert_int_equal(rg_farm_plan_read(&found, path), !rows[i].says);
        rg_log_listen(NULL, NULL);
        if (rows[i].says && (!strstr(logged, rows[i].says) || !strstr(logged, path)))
            fail_msg("'%s' is not in: %s", rows[i].says, logged);
        rg_farm_plan_free(&found);
    }
    unlink(path);
}

static void test_more_after_its_end(void **state)
{
    (void)state;
    struct farm farm;
    struct rg_farm_plan found = {0};
    make_farm(&farm, 1, 1, 1);
    assert_true(rg_farm_plan_write(&farm.plan, path));
    FILE *file = fopen(path, "ab");
    assert_non_null(file);
    fputs("\n{}", file);
    fclose(file);
    rg_log_listen(log_last, NULL);
    assert_false(rg_farm_plan_read(&found, path));
    rg_log_listen(NULL, NULL);
    assert_non_null(strstr(logged, "has more after its end"));
    rg_farm_plan_free(&found);
    unmake_farm(&farm);
    unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_groups),
        cmocka_unit_test(test_ids_of_groups),
        cmocka_unit_test(test_rows_with_gaps),
        cmocka_unit_test(test_rows_and_works),
        cmocka_unit_test(test_ids),
        cmocka_unit_test(test_devices),
        cmocka_unit_test(test_too_many_devices),
        cmocka_unit_test(test_expected),
        cmocka_unit_test(test_lengths),
        cmocka_unit_test(test_cut),
        cmocka_unit_test(test_document),
        cmocka_unit_test(test_file),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_malformed),
        cmocka_unit_test(test_more_after_its_end),
    };
    snprintf(path, sizeof(path), "/tmp/raingauge-test-plan-%d.json", (int)getpid());
    return cmocka_run_group_tests(tests, NULL, NULL);
}
