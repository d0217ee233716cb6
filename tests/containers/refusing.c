// Runs a command for which the kernel refuses some system calls, like the filters of containers and
// emulators:
//
//     refusing ERRNO CALL[,CALL]... COMMAND [ARGUMENT]...
//
// ERRNO is a number. "nameless" is openat for a file without a name (O_TMPFILE).
#define _GNU_SOURCE // O_TMPFILE
#include <errno.h>
#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

static const struct {
    const char *name;
    unsigned int number;
} calls[] = {
    {"capset", SYS_capset},
    {"clone", SYS_clone},
    {"clone3", SYS_clone3},
    {"close_range", SYS_close_range},
    {"execve", SYS_execve},
    {"fchmod", SYS_fchmod},
    {"flock", SYS_flock},
    {"fsync", SYS_fsync},
    {"ftruncate", SYS_ftruncate},
    {"getrandom", SYS_getrandom},
    {"linkat", SYS_linkat},
    {"madvise", SYS_madvise},
    {"memfd_create", SYS_memfd_create},
    {"pipe2", SYS_pipe2},
    {"prctl", SYS_prctl},
    {"prlimit64", SYS_prlimit64},
    {"seccomp", SYS_seccomp},
    {"sendfile", SYS_sendfile},
    {"shmat", SYS_shmat},
    {"shmget", SYS_shmget},
    {"socketpair", SYS_socketpair},
    {"statx", SYS_statx},
    {"sysinfo", SYS_sysinfo},
    {"waitid", SYS_waitid},
};
enum { MOST = 200, UNUSABLE = 99, REFUSED_ALL = 98 };

#define STEP(code, value) (struct sock_filter) BPF_STMT((code), (value))
#define SKIP(test, value, yes, no)                                                                 \
    (struct sock_filter) BPF_JUMP(BPF_JMP | (test) | BPF_K, (value), (yes), (no))
#define LOAD(field) STEP(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, field))

static int add(struct sock_filter *program, int n, const char *name, unsigned int error)
{
    const struct sock_filter refuse = STEP(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | error);
    if (!strcmp(name, "nameless")) {
        program[n++] = SKIP(BPF_JEQ, SYS_openat, 0, 4);
        program[n++] = LOAD(args[2]);
        program[n++] = SKIP(BPF_JSET, O_TMPFILE & ~O_DIRECTORY, 0, 1);
        program[n++] = refuse;
        program[n++] = LOAD(nr);
        return n;
    }
    for (size_t i = 0; i < sizeof(calls) / sizeof(calls[0]); i++) {
        if (strcmp(name, calls[i].name))
            continue;
        program[n++] = SKIP(BPF_JEQ, calls[i].number, 0, 1);
        program[n++] = refuse;
        return n;
    }
    fprintf(stderr, "refusing: no call '%s'\n", name);
    exit(UNUSABLE);
}

int main(int argc, char **argv)
{
    struct sock_filter program[MOST];
    int n = 0;
    if (argc < 4)
        return fputs("refusing ERRNO CALL[,CALL]... COMMAND [ARGUMENT]...\n", stderr), UNUSABLE;
    program[n++] = LOAD(nr);
    for (char *name = strtok(argv[2], ","); name && n < MOST - 8; name = strtok(NULL, ","))
        n = add(program, n, name, (unsigned int)atoi(argv[1]));
    program[n++] = STEP(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
    const struct sock_fprog filter = {(unsigned short)n, program};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) ||
        prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter))
        return perror("refusing: seccomp"), UNUSABLE;
    execv(argv[3], argv + 3); // fails if the filter refuses execve
    perror(argv[3]);
    return REFUSED_ALL;
}
