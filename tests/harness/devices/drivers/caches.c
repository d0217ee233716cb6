// Folders for drivers' compiled code: one for each set of settings and each driver, of which the
// last used stay.
#include "harness/devices/drivers/caches.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "tests/harness/devices/drivers/place.h"

static struct rg_side_folder find(const char *api, const char *environment)
{
    struct rg_side_folder folder;
    assert_true(rg_side_folder_find(api, environment, &folder));
    return folder;
}

static int begin(void **state)
{
    const int failed = begin_place(state);
    setenv("XDG_CACHE_HOME", place, 1);
    setenv("TMPDIR", in_place("temporary"), 1);
    unsetenv("LP_PERF");
    unsetenv("VK_DRIVER_FILES");
    return failed;
}

static bool is_there(const char *path)
{
    return !access(path, F_OK);
}

// --- settings ---

static void a_folder_is_of_its_settings(void **state)
{
    (void)state;
    const uint64_t plain = find("vulkan", "").settings;
    static const struct {
        const char *api, *environment, *ours; // LP_PERF of this process
        bool same;                            // as plain
    } rows[] = {
        {"vulkan", "", NULL, true},
        {"gl", "", NULL, false},
        {"vulkan", "LP_PERF=no_tex\0", NULL, false},
        {"vulkan", "ANY=1\0", NULL, false},
        {"vulkan", "RG_ANY=1\0", NULL, true},
        {"vulkan", "RG_PROGRAM=/bin/a\0", NULL, false},
        {"vulkan", "", "no_tex", false},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        if (rows[i].ours)
            setenv("LP_PERF", rows[i].ours, 1);
        if ((find(rows[i].api, rows[i].environment).settings == plain) != rows[i].same)
            fail_msg("row %d: %s %s", (int)i, rows[i].api, rows[i].environment);
        unsetenv("LP_PERF");
    }
    const uint64_t both = find("vulkan", "A=1\0LP_PERF=x\0").settings;
    assert_true(both == find("vulkan", "LP_PERF=x\0A=1\0").settings);
    assert_true(both != find("vulkan", "A=1\0LP_PERF=y\0").settings);
    assert_true(both != find("vulkan", "LP_PERF=x\0").settings);
    // The device's own value counts, whatever this process has.
    setenv("LP_PERF", "y", 1);
    assert_true(both == find("vulkan", "A=1\0LP_PERF=x\0").settings);
    assert_true(find("vulkan", "").settings == find("vulkan", "LP_PERF=y\0").settings);
}

static void folders_lie_in_the_user_s_cache(void **state)
{
    (void)state;
    const struct rg_side_folder folder = find("vulkan", "A=1\0");
    const char *settings =
        text_of("%s/raingauge/sides/%016llx", place, (unsigned long long)folder.settings);
    assert_string_equal(folder.settings_path, settings);
    assert_string_equal(folder.path, text_of("%s/0000000000000000", settings));
    assert_true(folder.driver == 0);
    assert_true(is_there(folder.path));
    // Without one they lie among temporary files.
    setenv("XDG_CACHE_HOME", "/proc/none", 1);
    put_text("temporary/empty", "");
    const struct rg_side_folder other = find("vulkan", "A=1\0");
    assert_string_equal(other.settings_path,
                        text_of("%s/raingauge-%ld/%016llx", in_place("temporary"), (long)getuid(),
                                (unsigned long long)folder.settings));
    assert_true(is_there(other.path));
    assert_int_equal(lines, 0);
}

// --- drivers ---

static void the_driver_is_noted_for_the_next_time(void **state)
{
    (void)state;
    const uint64_t driver = UINT64_C(0x0123456789abcdef);
    struct rg_side_folder folder = find("vulkan", "");
    assert_true(rg_side_folder_move(&folder, driver));
    assert_true(folder.driver == driver);
    assert_string_equal(folder.path, text_of("%s/0123456789abcdef", folder.settings_path));
    assert_true(is_there(folder.path));
    assert_false(rg_side_folder_move(&folder, driver)); // it is there
    struct rg_side_folder next = find("vulkan", "");
    assert_true(next.driver == driver);
    assert_string_equal(next.path, folder.path);
    assert_true(rg_side_folder_move(&next, 7));
    assert_true(find("vulkan", "").driver == 7);
    assert_true(find("vulkan", "OTHER=1\0").driver == 0);
}

// --- old folders go ---

// Makes folders from 0 on, each used a second after the one before.
static void make_old(const char *parent, int count)
{
    for (int i = 0; i < count; i++) {
        const char *path = text_of("%s/%02d", parent, i);
        struct timespec used[2] = {{.tv_sec = 1000000 + i}, {.tv_sec = 1000000 + i}};
        assert_int_equal(mkdir(path, 0700), 0);
        assert_int_equal(mkdir(text_of("%s/%02d/mesa", parent, i), 0700), 0);
        assert_int_equal(utimensat(AT_FDCWD, path, used, 0), 0);
    }
}

static int folders_in(const char *parent)
{
    int count = 0;
    DIR *all = opendir(parent);
    assert_non_null(all);
    for (const struct dirent *entry; (entry = readdir(all));) {
        struct stat what;
        count += *entry->d_name != '.' && !stat(text_of("%s/%s", parent, entry->d_name), &what) &&
                 S_ISDIR(what.st_mode);
    }
    closedir(all);
    return count;
}

static void the_least_recently_used_goes(void **state)
{
    (void)state;
    struct rg_side_folder folder = find("vulkan", "");
    const char *settings = folder.settings_path;
    make_old(settings, RG_SIDE_DRIVERS_KEPT - 1); // with that of no driver there are just enough
    assert_int_equal(folders_in(settings), RG_SIDE_DRIVERS_KEPT);
    const struct timespec long_ago[2] = {{.tv_sec = 1}, {.tv_sec = 1}}; // our own is older still
    assert_int_equal(utimensat(AT_FDCWD, folder.path, long_ago, 0), 0);
    assert_true(rg_side_folder_move(&folder, 1));
    assert_int_equal(folders_in(settings), RG_SIDE_DRIVERS_KEPT);
    assert_false(is_there(text_of("%s/00", settings)));
    assert_true(is_there(text_of("%s/01", settings)));
    assert_true(rg_side_folder_move(&folder, 2));
    assert_false(is_there(text_of("%s/01", settings)));
    assert_true(is_there(text_of("%s/02", settings)));
    // Those that this process uses stay, though they are too many.
    for (uint64_t driver = 3; driver < 9; driver++)
        assert_true(rg_side_folder_move(&folder, driver));
    assert_int_equal(folders_in(settings), 9);
    // A folder that is there already evicts none.
    make_old(settings, 1);
    assert_true(rg_side_folder_move(&folder, 3));
    assert_true(is_there(text_of("%s/00", settings)));
}

static void folders_of_settings_are_bounded_too(void **state)
{
    (void)state;
    char sides[PATH_MAX];
    strcpy(sides, in_place("raingauge/sides"));
    put_text("raingauge/sides/a file", "");
    make_old(sides, RG_SIDES_KEPT);
    find("vulkan", "");
    assert_int_equal(folders_in(sides), RG_SIDES_KEPT);
    assert_false(is_there(text_of("%s/00", sides)));
    assert_true(is_there(text_of("%s/01/mesa", sides)));
}

// Nothing more is removed where another process holds the oldest.
static void what_others_use_stays(void **state)
{
    (void)state;
    char sides[PATH_MAX];
    strcpy(sides, in_place("raingauge/sides"));
    put_text("raingauge/sides/a file", "");
    make_old(sides, RG_SIDES_KEPT);
    const int other = open(text_of("%s/00", sides), O_RDONLY | O_DIRECTORY);
    assert_int_equal(flock(other, LOCK_SH), 0);
    find("vulkan", "");
    assert_true(is_there(text_of("%s/00", sides)));
    assert_true(is_there(text_of("%s/01", sides)));
    close(other);
    find("gl", "");
    assert_false(is_there(text_of("%s/00", sides)));
    assert_false(is_there(text_of("%s/01", sides)));
    assert_int_equal(folders_in(sides), RG_SIDES_KEPT);
}

// --- drivers' variables ---

static void drivers_cache_there_unless_the_name_says_where(void **state)
{
    (void)state;
    static const char *const rows[][2] = {{"MESA_SHADER_CACHE_DIR", "mesa"},
                                          {"POCL_CACHE_DIR", "pocl"},
                                          {"__GL_SHADER_DISK_CACHE_PATH", "nvidia"},
                                          {"CUDA_CACHE_PATH", "cuda"}};
    const struct rg_side_folder folder = find("vulkan", "");
    for (int own = 0; own < 4; own++) {
        struct rg_worker_variables variables = {.text = NULL};
        if (own)
            assert_true(rg_variables_set(&variables, rows[own][0], "/mine"));
        assert_true(rg_side_caches_set(&folder, &variables));
        for (int i = 0; i < 4; i++) {
            const char *path = text_of("%s/%s", folder.path, rows[i][1]);
            assert_string_equal(rg_variables_find(&variables, rows[i][0]),
                                own && i == own ? "/mine" : path);
            assert_int_equal(is_there(path), true);
        }
        rg_variables_free(&variables);
    }
    char path[PATH_MAX];
    assert_true(rg_side_folder_in(&folder, "manifests", path));
    assert_string_equal(path, text_of("%s/manifests", folder.path));
    assert_true(rg_side_folder_in(&folder, "manifests", path)); // it is there
    struct rg_side_folder gone = folder;
    strcat(gone.path, "/none");
    assert_false(rg_side_folder_in(&gone, "manifests", path));
    assert_int_equal(lines, 1);
    assert_non_null(strstr(logged, "none/manifests: cannot be made: No such file or directory"));
}

int main(void)
{
#define IN_A_CACHE(test) cmocka_unit_test_setup_teardown(test, begin, end_place)
    const struct CMUnitTest tests[] = {
        IN_A_CACHE(a_folder_is_of_its_settings),
        IN_A_CACHE(folders_lie_in_the_user_s_cache),
        IN_A_CACHE(the_driver_is_noted_for_the_next_time),
        IN_A_CACHE(the_least_recently_used_goes),
        IN_A_CACHE(folders_of_settings_are_bounded_too),
        IN_A_CACHE(what_others_use_stays),
        IN_A_CACHE(drivers_cache_there_unless_the_name_says_where),
    };
    return cmocka_run_group_tests_name("caches of drivers", tests, NULL, NULL);
}
