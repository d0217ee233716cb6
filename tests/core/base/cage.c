// The cage allows a program some actions and refuses it others.
#define _GNU_SOURCE // syscall
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/cage/cage.h"
#include "tests/tools/expect.h"

static pid_t parent; // a caged program cannot ask for it

// Each returns whether the call went through. They use nothing but system calls.
static bool opens_a_file(void)
{
    return open("/dev/null", O_RDONLY) >= 0;
}

static bool makes_a_socket(void)
{
    return socket(AF_UNIX, SOCK_STREAM, 0) >= 0;
}

static bool starts_a_process(void)
{
    const pid_t child = fork();
    if (child == 0)
        _exit(0);
    return child > 0;
}

static bool starts_a_program(void)
{
    char *const args[] = {(char *)"true", NULL};
    execv("/bin/true", args); // returns only if it fails
    return false;
}

static bool removes_a_file(void)
{
    return !unlink("/tmp/raingauge-cage-none") || errno == ENOENT;
}

static bool kills_its_parent(void)
{
    return !kill(parent, 0);
}

static bool kills_a_thread_of_its_parent(void)
{
    return !syscall(SYS_tgkill, parent, parent, 0);
}

// A descriptor signals its owner when it becomes readable or writable; F_SETSIG can make that
// SIGKILL.
static bool has_its_parent_killed(void)
{
    return !fcntl(RG_CAGE_REPLY, F_SETOWN, parent);
}

static bool chooses_the_signal(void)
{
    return !fcntl(RG_CAGE_REPLY, F_SETSIG, SIGKILL);
}

static bool signals_itself(void)
{
    return !syscall(SYS_tgkill, getpid(), gettid(), 0);
}

static bool copies_a_descriptor(void)
{
    return fcntl(RG_CAGE_FILE, F_GETFL) >= 0 && fcntl(RG_CAGE_FILE, F_DUPFD_CLOEXEC, 0) >= 0;
}

static bool makes_memory_executable(void)
{
    return mmap(NULL, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) !=
           MAP_FAILED;
}

static bool traces(void)
{
    return syscall(SYS_ptrace, 0, 0, 0, 0) >= 0;
}

static bool takes_memory(void)
{
    char *bytes = mmap(NULL, 1 << 20, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return bytes != MAP_FAILED && (bytes[4096] = 1) && !munmap(bytes, 1 << 20);
}

static bool reads_and_writes(void)
{
    int both[2];
    char byte = 'x';
    memcpy(both, (const int[]){RG_CAGE_FILE, RG_CAGE_REPLY}, sizeof(both));
    return read(both[0], &byte, 1) == 1 && write(both[1], &byte, 1) == 1;
}

static const struct {
    const char *what;
    bool (*act)(void);
    bool may;
} acts[] = {
    {"opens a file", opens_a_file, false},
    {"makes a socket", makes_a_socket, false},
    {"starts a process", starts_a_process, false},
    {"starts a program", starts_a_program, false},
    {"removes a file", removes_a_file, false},
    {"signals its parent", kills_its_parent, false},
    {"signals a thread of its parent", kills_a_thread_of_its_parent, false},
    {"has its parent signalled for a descriptor", has_its_parent_killed, false},
    {"chooses the signal of a descriptor", chooses_the_signal, false},
    {"makes memory executable", makes_memory_executable, false},
    {"traces", traces, false},
    {"takes memory", takes_memory, true},
    {"reads and writes what it was given", reads_and_writes, true},
    {"signals itself", signals_itself, true},
    {"asks for a descriptor's flags and copies it", copies_a_descriptor, true},
};

// The exit status of a child that acts: 0 it could, 1 it could not, 2 no cage.
static int act_in_a_child(size_t i, bool shut)
{
    int status = 0;
    parent = getpid();
    const pid_t child = fork();
    if (child == 0) {
        const int zero = fcntl(open("/dev/zero", O_RDONLY), F_DUPFD, RG_CAGE_FILE + 1);
        const int null = fcntl(open("/dev/null", O_WRONLY), F_DUPFD, RG_CAGE_FILE + 1);
        dup2(zero, RG_CAGE_FILE);
        dup2(null, RG_CAGE_REPLY);
        if (shut && !rg_cage_shut())
            _exit(2);
        _exit(acts[i].act() ? 0 : 1);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void a_caged_program_computes_and_answers(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(acts) / sizeof(acts[0]); i++) {
        const int status = act_in_a_child(i, true);
        if (status != (acts[i].may ? 0 : 1))
            fail_msg("a caged program that %s: %d", acts[i].what, status);
    }
}

// Without this, refusals in the cage would prove nothing.
static void without_a_cage_all_of_it_works(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(acts) / sizeof(acts[0]); i++)
        if (act_in_a_child(i, false) != 0)
            fail_msg("a free program does not: %s", acts[i].what);
}

static void limits_hold(void **state)
{
    (void)state;
    int status = 0;
    const pid_t child = fork();
    if (child == 0) {
        const struct rg_cage_limits limits = {.cpu_s = 20};
        struct rlimit time;
        rg_cage_limit(&limits);
        signal(SIGXFSZ, SIG_IGN);
        const int file = memfd_create("file", 0);
        getrlimit(RLIMIT_CPU, &time);
        _exit(write(file, "x", 1) < 0 && time.rlim_cur >= 20 && time.rlim_cur <= 60 ? 0 : 1);
    }
    waitpid(child, &status, 0);
    assert_int_equal(status, 0);
}

// The program sees none of our variables and has five descriptors. A sixth is the folder, which sh
// opens to count them.
static void a_caged_program_has_no_environment(void **state)
{
    (void)state;
    struct rg_caged caged;
    char text[64] = "";
    const int file = open("/dev/null", O_RDONLY);
    const char *const args[] = {
        "/bin/sh", "-c", "set -- /proc/$$/fd/*; echo \"${RG_TEST_SECRET-none} $#\" >&3", NULL};
    setenv("RG_TEST_SECRET", "seen", 1);
    assert_int_equal(rg_caged_run(args, file, 20, 100, &caged), 0);
    assert_int_equal(rg_caged_end(&caged, "sh", text, sizeof(text)), RG_CAGED_SOUND);
    assert_int_equal(caged.bytes, 7);
    assert_memory_equal(caged.reply, "none 6\n", 7);
    free(caged.reply);
    close(file);
}

// A program that closes its reply but runs on is killed at its time limit.
static void a_caged_program_that_feigns_its_end_is_killed(void **state)
{
    (void)state;
    struct rg_caged caged;
    const int file = open("/dev/null", O_RDONLY);
    const char *const args[] = {"/bin/sh", "-c", "exec 3>&-; exec sleep 20", NULL};
    assert_int_equal(RG_CAGE_REPLY, 3);
    assert_int_equal(rg_caged_run(args, file, 1, 100, &caged), 0);
    assert_false(caged.ended);
    assert_int_equal(WTERMSIG(caged.status), SIGKILL);
    free(caged.reply);
    close(file);
}

// A reply comes whole, however large; one beyond its limit is refused.
static void a_reply_has_an_end(void **state)
{
    (void)state;
    enum { MANY = 3000000 };
    struct rg_caged caged;
    char why[300] = "";
    const char *const args[] = {"/bin/sh", "-c", "head -c 3000000 /dev/zero >&3; printf x >&3",
                                NULL};
    assert_int_equal(rg_caged_run(args, -1, 20, MANY + 1, &caged), 0);
    assert_int_equal(rg_caged_end(&caged, "sh", why, sizeof(why)), RG_CAGED_SOUND);
    assert_equals(caged.bytes, MANY + 1);
    assert_true(!caged.reply[MANY - 1]);
    assert_equals(caged.reply[MANY], 'x');
    free(caged.reply);
    assert_int_equal(rg_caged_run(args, -1, 20, MANY, &caged), 0);
    assert_int_equal(rg_caged_end(&caged, "sh", why, sizeof(why)), RG_CAGED_FILE);
    assert_string_equal(why, "sh made more of it than it can hold; the file is damaged: repair it");
    free(caged.reply);
}

// The way a program ends tells what went wrong. If the loader lacks a library, the file is not
// blamed.
static void an_end_that_is_not_sound_says_why(void **state)
{
    (void)state;
    static const struct {
        const char *script, *why;
        enum rg_caged_end end;
    } ends[] = {
        {"exit 3", "sh ended with status 3 on it; the file is damaged: repair or convert it",
         RG_CAGED_FILE},
        {"exit 127",
         "what reads it with sh could not be loaded, as where a library is absent; "
         "install raingauge's packages again",
         RG_CAGED_MACHINE},
        {"exit 77",
         "the system gives its reader no cage (seccomp, prctl, capset), as in an emulator; allow "
         "these, or set RG_CAGE=off to read files that you trust without one",
         RG_CAGED_MACHINE},
        {"exit 78",
         "no memory for what sh makes of it; close other programs, or allow more (ulimit -v)",
         RG_CAGED_LACKING},
        {"kill -SEGV $$",
         "sh crashed on it (Segmentation fault); the file is damaged: repair or "
         "convert it",
         RG_CAGED_FILE},
    };
    for (size_t i = 0; i < sizeof(ends) / sizeof(ends[0]); i++) {
        struct rg_caged caged;
        char why[300] = "";
        const char *const args[] = {"/bin/sh", "-c", ends[i].script, NULL};
        assert_int_equal(rg_caged_run(args, -1, 20, 100, &caged), 0);
        assert_int_equal(rg_caged_end(&caged, "sh", why, sizeof(why)), ends[i].end);
        assert_string_equal(why, ends[i].why);
        free(caged.reply);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_caged_program_computes_and_answers),
        cmocka_unit_test(without_a_cage_all_of_it_works),
        cmocka_unit_test(limits_hold),
        cmocka_unit_test(a_caged_program_has_no_environment),
        cmocka_unit_test(a_caged_program_that_feigns_its_end_is_killed),
        cmocka_unit_test(a_reply_has_an_end),
        cmocka_unit_test(an_end_that_is_not_sound_says_why),
    };
    return cmocka_run_group_tests_name("cage", tests, NULL, NULL);
}
