// A picture file is written whole or not at all, whatever ends the program or fills the disk.
#define _GNU_SOURCE // unshare
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "core/base/program.h"
#include "core/image/files/io.h"
#include "core/image/files/temporary.h"
#include "tests/core/image/files/scratch.h"
#include "tests/tools/expect.h"

static void assert_not_written(const char *name, const struct rg_picture *picture, const char *word)
{
    int before = files_in_folder();
    error_count = 0;
    const struct rg_write_options options = {.full_float = true};
    assert_false(rg_picture_write(in_folder(name), picture, &options));
    if (error_count != 1 || !strstr(errors, word))
        fail_msg("%d lines, the last: %s", error_count, errors);
    assert_int_equal(files_in_folder(), before);
}

static void what_cannot_be_written_leaves_nothing(void **state)
{
    (void)state;
    struct rg_picture picture = noise_picture(3);
    assert_not_written("none/a.png", &picture, "folder is not there");
    assert_not_written("a.xyz", &picture, ".xyz");
    mkdir(in_folder("a.png"), 0777);
    assert_not_written("a.png", &picture, "is a folder");
    rmdir(in_folder("a.png"));
    struct rg_picture four = noise_picture(4);
    assert_not_written("a.hdr", &four, "3 channels");
    rg_picture_destroy(&four);
    rg_picture_destroy(&picture);
}

// On a full disk, here a limit of one block, the old file stays.
static void a_full_disk_leaves_the_old_file(void **state)
{
    (void)state;
    const char *const names[] = {"full.exr", "full.png", "full.hdr", "full.tif"};
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, 300, 200, 3, "noise"));
    for (int64_t i = 0; i < rg_picture_values(&picture); i++)
        picture.texels[i] = (float)(rain_noise((uint32_t)i) >> 8) * 0x1p-24f;
    for (int i = 0; i < 4; i++) // loads the writers before the limit holds
        assert_true(rg_picture_write(in_folder(names[i]), &picture, &(struct rg_write_options){0}));
    signal(SIGXFSZ, SIG_IGN);
    struct rlimit before, small;
    getrlimit(RLIMIT_FSIZE, &before);
    small = before;
    small.rlim_cur = 4096;
    setrlimit(RLIMIT_FSIZE, &small);
    for (int i = 0; i < 4; i++)
        assert_not_written(names[i], &picture, names[i]);
    setrlimit(RLIMIT_FSIZE, &before);
    for (int i = 0; i < 4; i++) {
        struct rg_picture back;
        assert_true(rg_picture_read(in_folder(names[i]), &back));
        assert_int_equal(back.width, 300);
        rg_picture_destroy(&back);
        unlink(in_folder(names[i]));
    }
    rg_picture_destroy(&picture);
}

// Without /proc a file has a name while it is written.
static bool hide_proc(void)
{
    return !unshare(CLONE_NEWUSER | CLONE_NEWNS) && !mount("none", "/proc", "tmpfs", 0, NULL);
}

// How a child ends that does this work and then raises a signal; status 1 if it raises none.
static int status_of(void (*work)(int), int number)
{
    int status = 0;
    const pid_t child = fork();
    if (child == 0) {
        signal(number, rg_program_end_by);
        work(number);
        _exit(1);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    return status;
}

static void end_with_a_name(int number)
{
    struct rg_why why;
    struct rg_temporary temporary;
    if (!hide_proc())
        _exit(77);
    if (rg_temporary_make(in_folder("new.png"), &temporary, &why) && temporary.is_named &&
        files_in_folder() == 1)
        raise(number);
}

// A signal that asks to end removes the named file as well.
static void a_signal_takes_the_name(void **state)
{
    (void)state;
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    for (int i = 0; i < 3; i++) {
        const int status = status_of(end_with_a_name, signals[i]);
        if (WIFEXITED(status) && WEXITSTATUS(status) == 77)
            skip(); // no file system may be mounted here
        assert_true(WIFSIGNALED(status) && WTERMSIG(status) == signals[i]);
        assert_int_equal(files_in_folder(), 0);
    }
}

static void end_within(int number)
{
    struct rg_why why;
    struct rg_temporary temporary;
    if (rg_temporary_make(in_folder("kept.png"), &temporary, &why) &&
        write(temporary.fd, "new", 3) == 3)
        raise(number);
}

// The program may end in any way while it writes: the old file stays, and nothing else is left.
static void a_signal_leaves_nothing(void **state)
{
    (void)state;
    static const int signals[] = {SIGINT, SIGTERM, SIGKILL};
    write_bytes("kept.png", "old", 3);
    for (int i = 0; i < 3; i++) {
        assert_true(WIFSIGNALED(status_of(end_within, signals[i])));
        assert_int_equal(files_in_folder(), 1);
    }
    unlink(in_folder("kept.png"));
}

// A shell's redirection follows links, too.
static void a_link_is_followed(void **state)
{
    (void)state;
    struct rg_picture picture = noise_picture(3);
    struct stat st;
    char target[256], link[256];
    snprintf(target, sizeof(target), "%s", in_folder("target.png"));
    snprintf(link, sizeof(link), "%s", in_folder("link.png"));
    assert_int_equal(symlink(target, link), 0);
    assert_not_written("link.png", &picture, "a link to nothing");
    write_bytes("target.png", "old", 3);
    assert_true(rg_picture_write(link, &picture, &(struct rg_write_options){0}));
    assert_int_equal(lstat(link, &st), 0);
    assert_true(S_ISLNK(st.st_mode));
    assert_int_equal(stat(target, &st), 0);
    assert_above(st.st_size, 3);
    rg_picture_destroy(&picture);
    unlink(link);
    unlink(target);
}

// A small picture stays in a buffer until the file is closed; the close must fail as well.
static void a_full_disk_is_noticed_at_the_close(void **state)
{
    (void)state;
    const char *const names[] = {"last.exr", "last.png", "last.hdr", "last.tif"};
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, 8, 8, 3, "grey"));
    for (int64_t i = 0; i < rg_picture_values(&picture); i++)
        picture.texels[i] = 0.5f;
    signal(SIGXFSZ, SIG_IGN);
    struct rlimit before, small;
    getrlimit(RLIMIT_FSIZE, &before);
    for (int i = 0; i < 4; i++) {
        assert_true(rg_picture_write(in_folder(names[i]), &picture, &(struct rg_write_options){0}));
        struct stat st;
        stat(in_folder(names[i]), &st);
        unlink(in_folder(names[i]));
        small = before;
        small.rlim_cur = (rlim_t)st.st_size - 1;
        setrlimit(RLIMIT_FSIZE, &small);
        assert_not_written(names[i], &picture, names[i]);
        setrlimit(RLIMIT_FSIZE, &before);
    }
    rg_picture_destroy(&picture);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_cannot_be_written_leaves_nothing),
        cmocka_unit_test(a_full_disk_leaves_the_old_file),
        cmocka_unit_test(a_signal_leaves_nothing),
        cmocka_unit_test(a_signal_takes_the_name),
        cmocka_unit_test(a_link_is_followed),
        cmocka_unit_test(a_full_disk_is_noticed_at_the_close),
    };
    return cmocka_run_group_tests_name("picture files that are written", tests, make_scratch,
                                       remove_scratch);
}
