// The user's folders: where they are, and that they are made.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "core/base/files/user.h"

static void a_path_is_in_the_users_folder(void **state)
{
    (void)state;
    char path[64], why[256];
    setenv("XDG_CACHE_HOME", "/cache", 1);
    setenv("HOME", "/somewhere", 1);
    assert_true(rg_user_path(RG_USER_CACHE, "a/b", path, sizeof(path), why));
    assert_string_equal(path, "/cache/raingauge/a/b");
    setenv("XDG_CACHE_HOME", "no/absolute/path", 1);
    assert_true(rg_user_path(RG_USER_CACHE, "a", path, sizeof(path), why));
    assert_string_equal(path, "/somewhere/.cache/raingauge/a");
    assert_true(rg_user_path(RG_USER_CACHE, "a", path, strlen(path) + 1, why));
    assert_false(rg_user_path(RG_USER_CACHE, "ab", path, strlen(path) + 1, why));
    assert_non_null(strstr(why, "too long"));
    setenv("XDG_STATE_HOME", "/state", 1);
    assert_true(rg_user_path(RG_USER_STATE, "", path, sizeof(path), why));
    assert_string_equal(path, "/state/raingauge/");
    unsetenv("XDG_STATE_HOME");
    assert_true(rg_user_path(RG_USER_STATE, "a", path, sizeof(path), why));
    assert_string_equal(path, "/somewhere/.local/state/raingauge/a");
    unsetenv("HOME");
    assert_false(rg_user_path(RG_USER_CACHE, "a", path, sizeof(path), why));
    assert_non_null(strstr(why, "XDG_CACHE_HOME"));
}

static void its_folders_are_made(void **state)
{
    (void)state;
    char folder[] = "/tmp/raingauge-cache-XXXXXX", path[128], why[256];
    struct stat st;
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof(path), "%s/a/b/", folder);
    assert_true(rg_user_make_folders(path, why));
    assert_true(rg_user_make_folders(path, why)); // they are there already
    assert_true(!stat(path, &st) && S_ISDIR(st.st_mode) && (st.st_mode & 0777) == 0700);
    snprintf(path, sizeof(path), "%s/a/b", folder);
    rmdir(path);
    fclose(fopen(path, "w"));
    snprintf(path, sizeof(path), "%s/a/b/c/", folder);
    assert_false(rg_user_make_folders(path, why));
    assert_non_null(strstr(why, "Not a directory"));
    snprintf(path, sizeof(path), "rm -r %s", folder);
    assert_int_equal(system(path), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_path_is_in_the_users_folder),
        cmocka_unit_test(its_folders_are_made),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
