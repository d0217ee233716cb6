// Merges: one run from the records that shards left, whatever befell them on the way.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/record/disk/stored.h"
#include "harness/tables/farm/merge.h"
#include "tests/harness/farm/made.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

enum { TABLES = 2, ROWS = 4, VARIANTS = 2, GROUPS = TABLES * ROWS };

// A farm whose records lie in two folders, and what was logged of them.
struct rig {
    struct farm farm;
    char a[80], b[80], out[80];
    struct rg_farm_records found;
    char heard[8192];
};

static void hear(enum rg_log_level level, const char *line, void *user)
{
    struct rig *rig = user;
    (void)level;
    const size_t used = strlen(rig->heard);
    snprintf(rig->heard + used, sizeof(rig->heard) - used, "%s\n", line);
}

// The records of even groups lie in A, those of odd ones in B.
static void begin_with(struct rig *rig, int tables)
{
    *rig = (struct rig){.heard = ""};
    assert_int_equal(make_folder(NULL), 0);
    snprintf(rig->a, sizeof(rig->a), "%s/a", folder);
    snprintf(rig->b, sizeof(rig->b), "%s/b", folder);
    snprintf(rig->out, sizeof(rig->out), "%s/out", folder);
    make_farm(&rig->farm, tables, ROWS, VARIANTS);
    rg_text_copy(rig->farm.plan.digest, RG_FARM_DIGEST, "0123456789abcdef");
    for (int64_t g = 0; g < rig->farm.plan.group_count; g++)
        leave_record(&rig->farm, g, 0, g % 2 ? rig->b : rig->a);
}

static void begin(struct rig *rig)
{
    begin_with(rig, TABLES);
}

static void end(struct rig *rig)
{
    rg_farm_found_free(&rig->found);
    unmake_farm(&rig->farm);
    remove_whole_folder(NULL);
}

static bool find(struct rig *rig)
{
    const char *const folders[] = {rig->a, rig->b};
    rg_farm_found_free(&rig->found);
    *rig->heard = 0;
    rg_log_listen(hear, rig);
    const bool ok = rg_farm_records_find(&rig->found, &rig->farm.plan, folders, 2);
    rg_log_listen(NULL, NULL);
    return ok;
}

static int64_t missing(struct rig *rig)
{
    rg_log_listen(hear, rig);
    const int64_t cells = rg_farm_missing(&rig->found, &rig->farm.plan);
    rg_log_listen(NULL, NULL);
    return cells;
}

static void expect_heard(const struct rig *rig, const char *words)
{
    if (!strstr(rig->heard, words))
        fail_msg("'%s' is not in: %s", words, rig->heard);
}

// The number of cells of the tables in a folder, each of which is a measured group's.
static int count_cells(const struct rig *rig, const char *from, int machine)
{
    struct rg_stored stored = {0};
    int cells = 0;
    assert_true(rg_stored_read(&stored, from));
    for (int i = 0; i < stored.count; i++) {
        const struct rg_result *table = &stored.results[i];
        for (struct rg_place at = rg_result_start(table); rg_result_next(table, &at); cells++) {
            const int64_t group = ROWS * atoi(table->table + strlen("farm-")) + at.row;
            struct rg_result due = measure_group(&rig->farm, group, machine);
            const struct rg_record *x = rg_result_at(table, at), *y = rg_result_at(&due, at);
            assert_memory_equal(x->samples_ms, y->samples_ms, sizeof(x->samples_ms));
            assert_memory_equal(x->counters, y->counters, sizeof(x->counters));
            assert_string_equal(x->device.name, y->device.name);
            rg_result_free(&due);
        }
    }
    rg_stored_free(&stored);
    return cells;
}

// --- one run ---

static void test_whole(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_stored stored = {0};
    begin(&rig);
    assert_true(find(&rig));
    assert_string_equal(rig.heard, "");
    assert_int_equal(rig.found.count, GROUPS);
    assert_int_equal(rig.found.machine_count, 1);
    assert_int_equal(missing(&rig), 0);
    assert_int_equal(rg_farm_merge(&rig.farm.plan, &rig.found, rig.out), RG_EXIT_PASS);
    assert_int_equal(count_cells(&rig, rig.out, 0), rig.farm.plan.cell_count);
    assert_true(rg_stored_read(&stored, rig.out));
    assert_int_equal(stored.count, TABLES);
    for (int i = 0; i < stored.count; i++) {
        assert_int_equal(stored.results[i].first_row, 0);
        assert_int_equal(stored.results[i].last_row, ROWS - 1);
        assert_int_equal(rg_result_first_missing(&stored.results[i]), ROWS);
    }
    rg_stored_free(&stored);
    end(&rig);
}

// Rows that the plan leaves out are no part of the table, as in a run of one machine.
static void test_left_out(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_stored stored = {0};
    begin(&rig);
    struct rg_farm_plan *plan = &rig.farm.plan;
    assert_int_equal(remove(record_path(&rig.farm, 1, rig.b)), 0);
    memmove(plan->groups + 1, plan->groups + 2,
            (size_t)(--plan->group_count - 1) * sizeof(*plan->groups));
    assert_true(find(&rig));
    assert_int_equal(missing(&rig), 0);
    assert_int_equal(rg_farm_merge(plan, &rig.found, rig.out), RG_EXIT_PASS);
    assert_true(rg_stored_read(&stored, rig.out));
    assert_true(stored.results[0].left_out[1] && !rg_result_has(&stored.results[0], 1));
    assert_int_equal(rg_result_first_missing(&stored.results[0]), ROWS);
    rg_stored_free(&stored);
    end(&rig);
}

// --- what befalls records ---

static void write_text(const char *path, const char *text, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    fclose(file);
}

static char *read_text(const char *path, size_t *size)
{
    static char text[1 << 18];
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    *size = fread(text, 1, sizeof(text) - 1, file);
    text[*size] = 0;
    fclose(file);
    return text;
}

// A folder that is half copied lacks files, and has some under other names.
static void test_half_copied(void **state)
{
    (void)state;
    struct rig rig;
    char other[512];
    size_t size;
    begin(&rig);
    const char *path = record_path(&rig.farm, 2, rig.a);
    const char *text = read_text(path, &size);
    snprintf(other, sizeof(other), "%s/.a.json.Xy12Z", rig.a);
    write_text(other, text, size / 3);
    snprintf(other, sizeof(other), "%s/.a.json", rig.a);
    write_text(other, text, size / 3);
    snprintf(other, sizeof(other), "%s/a.json.part", rig.a);
    write_text(other, text, size / 2);
    assert_int_equal(remove(path), 0);
    assert_true(find(&rig));
    assert_string_equal(rig.heard, "");
    assert_int_equal(missing(&rig), 2 * VARIANTS);
    expect_heard(&rig, "farm-0/3: missing, 4 cells");
    assert_int_equal(rg_farm_merge(&rig.farm.plan, &rig.found, rig.out), RG_EXIT_PASS);
    assert_int_equal(count_cells(&rig, rig.out, 0), rig.farm.plan.cell_count - 2 * VARIANTS);
    end(&rig);
}

static int count_lines(const struct rig *rig, const char *words)
{
    int count = 0;
    for (const char *at = rig->heard; (at = strstr(at, words)); at++)
        count++;
    return count;
}

// What merging prints, which stays until the next call.
static const char *merge(struct rig *rig, int *exit)
{
    static char text[4096];
    FILE *file = tmpfile();
    const int kept = dup(STDOUT_FILENO);
    assert_non_null(file);
    fflush(stdout);
    dup2(fileno(file), STDOUT_FILENO);
    *exit = rg_farm_merge(&rig->farm.plan, &rig->found, rig->out);
    dup2(kept, STDOUT_FILENO);
    close(kept);
    rewind(file);
    text[fread(text, 1, sizeof(text) - 1, file)] = 0;
    fclose(file);
    return text;
}

// A line tells what each machine's folder holds. A table without a record is not written.
static void test_told(void **state)
{
    (void)state;
    struct rig rig;
    char due[8192];
    int exit;
    begin(&rig);
    assert_true(find(&rig));
    snprintf(due, sizeof(due), "%s: 2 tables, 32 cells of 32, key %s (%s)\n", rig.out,
             rig.found.machines[0].key, rig.found.machines[0].text);
    assert_string_equal(merge(&rig, &exit), due);
    assert_int_equal(exit, RG_EXIT_PASS);
    assert_string_not_equal(rig.found.machines[0].text, "");
    for (int64_t g = ROWS; g < GROUPS; g++)
        assert_int_equal(remove(record_path(&rig.farm, g, g % 2 ? rig.b : rig.a)), 0);
    leave_record(&rig.farm, 1, 1, rig.b);
    leave_record(&rig.farm, ROWS, 1, rig.a);
    assert_true(find(&rig));
    const struct rg_farm_machine *machines = rig.found.machines;
    snprintf(due, sizeof(due),
             "%s/%s: 1 table, 12 cells of 32, key %s (%s)\n%s/%s: 2 tables, 8 cells of 32, key %s "
             "(%s)\n",
             rig.out, machines[0].key, machines[0].key, machines[0].text, rig.out, machines[1].key,
             machines[1].key, machines[1].text);
    assert_string_equal(merge(&rig, &exit), due);
    assert_non_null(strstr(machines[1].text, "another processor"));
    end(&rig);
}

// Ten of a kind are named, and the others only counted; but all cells count as missing.
static void test_many(void **state)
{
    (void)state;
    struct rig rig;
    begin_with(&rig, 3);
    const int64_t groups = rig.farm.plan.group_count;
    assert_int_equal(groups, 12);
    for (int64_t g = 0; g < groups; g++)
        leave_record(&rig.farm, g, 0, g % 2 ? rig.a : rig.b);
    assert_true(find(&rig));
    assert_int_equal(rig.found.twice, groups);
    expect_heard(&rig, "\n2 records more are there twice\n");
    assert_int_equal(count_lines(&rig, "\n"), 11);
    for (int64_t g = 0; g < groups; g++) {
        const char *path = record_path(&rig.farm, g, g % 2 ? rig.a : rig.b);
        assert_int_equal(remove(path), 0);
        path = record_path(&rig.farm, g, g % 2 ? rig.b : rig.a);
        assert_int_equal(truncate(path, 9), 0);
    }
    assert_true(find(&rig));
    assert_int_equal(rig.found.damaged, groups);
    expect_heard(&rig, "\n2 records more are damaged\n");
    assert_int_equal(count_lines(&rig, "\n"), 11);
    *rig.heard = 0;
    assert_int_equal(missing(&rig), rig.farm.plan.cell_count);
    expect_heard(&rig, "\n2 groups more are missing\n");
    assert_int_equal(count_lines(&rig, ": missing, 4 cells"), 10);
    end(&rig);
}

// Replaces the first occurrence in a record; without `to` the rest is cut off.
static void damage(const char *path, const char *from, const char *to)
{
    static char changed[1 << 18];
    size_t size;
    const char *text = read_text(path, &size), *at = strstr(text, from);
    assert_non_null(at);
    snprintf(changed, sizeof(changed), "%.*s%s%s", (int)(at - text), text, to ? to : "",
             to ? at + strlen(from) : "");
    write_text(path, changed, strlen(changed));
}

// A damaged record is told of, and counts as missing.
static void test_damaged(void **state)
{
    (void)state;
    static const struct {
        const char *from, *to, *says;
    } rows[] = {{"\"samples_ms\"", NULL, "is no JSON"},
                {"\"cells\"", NULL, "is no JSON"},
                {"{", NULL, "is no JSON"},
                {"\"first_frame_ms\":28", "\"first_frame_ms\":29", "wrong checksum"},
                {"\"first_frame_ms\"", "\"first_frame\"", "first_frame_ms is missing"},
                {"\"id\":\"farm-0/3\"", "\"id\":\"farm-0/4\"", "no checksum is right"}};
    struct rig rig;
    begin(&rig);
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        leave_record(&rig.farm, 2, 0, rig.a);
        const char *path = record_path(&rig.farm, 2, rig.a);
        damage(path, rows[i].from, rows[i].to);
        assert_true(find(&rig));
        assert_int_equal(rig.found.damaged, 1);
        expect_heard(&rig, rows[i].says);
        expect_heard(&rig, path);
        assert_int_equal(missing(&rig), 2 * VARIANTS);
    }
    // Whole in another folder, it is not missing.
    leave_record(&rig.farm, 2, 0, rig.b);
    assert_true(find(&rig));
    assert_int_equal(rig.found.damaged, 1);
    assert_int_equal(missing(&rig), 0);
    end(&rig);
}

// Records of another plan, commit or format are refused by name, and so are other files.
static void test_foreign(void **state)
{
    (void)state;
    static const char commit[] = "0000000-other", digest[] = "fedcba9876543210";
    struct rig rig;
    begin(&rig);
    struct farm other = rig.farm;
    rg_text_copy(other.plan.digest, RG_FARM_DIGEST, digest);
    leave_record(&other, 2, 0, rig.a);
    assert_false(find(&rig));
    expect_heard(&rig, record_path(&rig.farm, 2, rig.a));
    expect_heard(&rig, "is of plan fedcba9876543210, and the plan is of 0123456789abcdef");
    json_t *build = json_object_get(rig.farm.passports[1], "raingauge");
    json_object_set_new(build, "commit", json_string(commit));
    leave_record(&rig.farm, 2, 1, rig.a);
    assert_false(find(&rig));
    expect_heard(&rig, "is of commit 0000000-other, and the plan is of ");
    leave_record(&rig.farm, 2, 0, rig.a);
    damage(record_path(&rig.farm, 2, rig.a), "\"format\":1", "\"format\":2");
    assert_false(find(&rig));
    expect_heard(&rig, "format is 2, and this raingauge reads 1");
    leave_record(&rig.farm, 2, 0, rig.a);
    assert_true(find(&rig));
    char path[512];
    snprintf(path, sizeof(path), "%s/table.json", rig.b);
    write_text(path, "{}", 2);
    assert_false(find(&rig));
    expect_heard(&rig, "table.json: is no record of a group of this plan");
    end(&rig);
}

// A table as `raingauge table -o` writes it is no record of a shard, whatever its name.
static void test_no_record(void **state)
{
    (void)state;
    struct rig rig;
    begin(&rig);
    damage(record_path(&rig.farm, 2, rig.a), "\"group\"", "\"grape\"");
    assert_false(find(&rig));
    expect_heard(&rig, "is no record of a shard");
    end(&rig);
}

// --- two of one ---

static void test_twice(void **state)
{
    (void)state;
    struct rig rig;
    begin(&rig);
    leave_record(&rig.farm, 2, 0, rig.b);
    assert_true(find(&rig));
    assert_int_equal(rig.found.twice, 1);
    assert_int_equal(rig.found.count, GROUPS);
    expect_heard(&rig, "farm-0/3: is there twice; ");
    expect_heard(&rig, record_path(&rig.farm, 2, rig.a));
    assert_string_equal(rg_farm_record_of(&rig.found, 2, 0)->path,
                        record_path(&rig.farm, 2, rig.a));
    assert_int_equal(rg_farm_merge(&rig.farm.plan, &rig.found, rig.out), RG_EXIT_PASS);
    assert_int_equal(count_cells(&rig, rig.out, 0), rig.farm.plan.cell_count);
    end(&rig);
}

// Two comparison keys get a folder each, and no table has cells of both.
static void test_two_keys(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_stored stored = {0};
    begin(&rig);
    leave_record(&rig.farm, 1, 1, rig.b);
    leave_record(&rig.farm, 2, 1, rig.b); // the other machine measured it, too
    assert_true(find(&rig));
    assert_int_equal(rig.found.twice, 0);
    assert_int_equal(rig.found.machine_count, 2);
    assert_string_not_equal(rig.found.machines[0].key, rig.found.machines[1].key);
    assert_int_equal(missing(&rig), 0);
    assert_int_equal(rg_farm_merge(&rig.farm.plan, &rig.found, rig.out), RG_EXIT_PASS);
    for (int i = 0; i < 2; i++) {
        char own[128];
        snprintf(own, sizeof(own), "%s/%s", rig.out, rig.found.machines[i].key);
        assert_int_equal(count_cells(&rig, own, i), 2 * VARIANTS * (i ? 2 : GROUPS - 1));
        assert_true(rg_stored_read(&stored, own));
        // Rows that another machine measured are left out, and do not count as missing.
        assert_int_equal(rg_result_first_missing(&stored.results[0]), ROWS);
        rg_stored_free(&stored);
    }
    end(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_whole),       cmocka_unit_test(test_left_out),
        cmocka_unit_test(test_half_copied), cmocka_unit_test(test_damaged),
        cmocka_unit_test(test_foreign),     cmocka_unit_test(test_no_record),
        cmocka_unit_test(test_twice),       cmocka_unit_test(test_two_keys),
        cmocka_unit_test(test_many),        cmocka_unit_test(test_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
