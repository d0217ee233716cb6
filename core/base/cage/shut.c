#define _GNU_SOURCE // RLIMIT_AS, syscall
#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/capability.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "core/base/cage/cage.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer) // clang's name for it
#define __SANITIZE_ADDRESS__
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
enum { SLOWNESS = 3, LIMITS_MEMORY = 0 };
#else
enum { SLOWNESS = 1, LIMITS_MEMORY = 1 };
#endif

#if defined(__x86_64__)
#define ARCHITECTURE AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define ARCHITECTURE AUDIT_ARCH_AARCH64
#endif

// --- limits ---

// Never raises a hard limit that is lower already.
static void limit(__rlimit_resource_t resource, int64_t most)
{
    struct rlimit now;
    if (getrlimit(resource, &now) ||
        (now.rlim_max != RLIM_INFINITY && now.rlim_max <= (rlim_t)most))
        return;
    now.rlim_cur = (rlim_t)most; // SIGXCPU comes at the soft limit of time
    setrlimit(resource, &now);
}

void rg_cage_limit(const struct rg_cage_limits *limits)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
    if (limits->cpu_s)
        limit(RLIMIT_CPU, SLOWNESS * limits->cpu_s);
    if (limits->memory_bytes && LIMITS_MEMORY)
        limit(RLIMIT_AS, limits->memory_bytes);
    limit(RLIMIT_FSIZE, 0);
}

// --- privileges ---

static bool drop_capabilities(void)
{
    struct __user_cap_header_struct header = {_LINUX_CAPABILITY_VERSION_3, 0};
    struct __user_cap_data_struct none[_LINUX_CAPABILITY_U32S_3];
    memset(none, 0, sizeof(none));
    return !syscall(SYS_capset, &header, none);
}

// --- system calls ---

// Calls for memory, open descriptors, time, locks, the process's own signal handlers, a thread's
// start, and the end.
static const unsigned int allowed[] = {
    SYS_read,         SYS_readv,
    SYS_pread64,      SYS_pwrite64,
    SYS_write,        SYS_writev,
    SYS_lseek,        SYS_fstat,
    SYS_newfstatat, // fstat on many systems
    SYS_ftruncate,    SYS_dup,
    SYS_close,        SYS_mmap,
    SYS_mprotect,     SYS_mremap,
    SYS_munmap,       SYS_madvise,
    SYS_brk,          SYS_futex,
    SYS_getrandom,    SYS_clock_gettime,
    SYS_sched_yield,  SYS_sched_getaffinity,
    SYS_getpid,       SYS_gettid,
    SYS_rt_sigaction, SYS_rt_sigprocmask,
    SYS_rt_sigreturn, SYS_sigaltstack,
    SYS_rseq,         SYS_set_robust_list,
    SYS_exit,         SYS_exit_group,
};
// The only operations of fcntl. With F_SETOWN, F_SETSIG and O_ASYNC the kernel would send any
// signal to any process of the user.
static const unsigned int asked[] = {F_GETFD, F_SETFD, F_GETFL, F_DUPFD, F_DUPFD_CLOEXEC};
enum {
    COUNT = sizeof(allowed) / sizeof(allowed[0]),
    ASKED = sizeof(asked) / sizeof(asked[0]),
    LENGTH = COUNT + (4 + ASKED) + (4 + 1) + 12, // the length of the program below
};

// Other calls fail with EPERM, so that libraries can report the failure.
#define REFUSE (SECCOMP_RET_ERRNO | (EPERM & SECCOMP_RET_DATA))
#define LOAD(field)                                                                                \
    (struct sock_filter) BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, field))
#define ARGUMENT(i) ((unsigned int)offsetof(struct seccomp_data, args[i])) // its lower half
#define JUMP(test, value, yes, no)                                                                 \
    (struct sock_filter) BPF_JUMP(BPF_JMP | (test) | BPF_K, (value), (yes), (no))
#define RETURN(value) (struct sock_filter) BPF_STMT(BPF_RET | BPF_K, (value))

#ifdef ARCHITECTURE
// Allows a call with the given values of one argument only. Compares the argument's lower half,
// which is all that the kernel reads. Returns the instruction count; another call's number stays
// loaded.
static int allow_with(struct sock_filter *program, unsigned int call, unsigned int argument_at,
                      const unsigned int *values, int count)
{
    int n = 0;
    program[n++] = JUMP(BPF_JEQ, call, 0, (unsigned char)(count + 3));
    program[n++] = (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, argument_at);
    for (int i = 0; i < count; i++)
        program[n++] = JUMP(BPF_JEQ, values[i], (unsigned char)(count - i), 0);
    program[n++] = RETURN(REFUSE);
    program[n++] = RETURN(SECCOMP_RET_ALLOW);
    return n;
}
#endif

static bool shut(void)
{
#ifdef ARCHITECTURE
    struct sock_filter program[LENGTH];
    int n = 0;
    program[n++] = LOAD(arch);
    program[n++] = JUMP(BPF_JEQ, ARCHITECTURE, 1, 0);
    program[n++] = RETURN(SECCOMP_RET_KILL_PROCESS);
    // Memory is never made executable: args[2] is the protection in both calls.
    program[n++] = LOAD(nr);
    program[n++] = JUMP(BPF_JEQ, SYS_mmap, 1, 0);
    program[n++] = JUMP(BPF_JEQ, SYS_mprotect, 0, 4);
    program[n++] = LOAD(args[2]);
    program[n++] = JUMP(BPF_JSET, PROT_EXEC, 0, 1);
    program[n++] = RETURN(REFUSE);
    program[n++] = RETURN(SECCOMP_RET_ALLOW);
    // abort sends a signal to its own process; no other process may get one.
    const unsigned int own = (unsigned int)getpid();
    n += allow_with(program + n, SYS_tgkill, ARGUMENT(0), &own, 1);
    n += allow_with(program + n, SYS_fcntl, ARGUMENT(1), asked, ASKED);
    for (int i = 0; i < COUNT; i++)
        program[n++] = JUMP(BPF_JEQ, allowed[i], (unsigned char)(COUNT - i), 0);
    program[n++] = RETURN(REFUSE);
    program[n++] = RETURN(SECCOMP_RET_ALLOW);
    const struct sock_fprog filter = {(unsigned short)n, program};
    return drop_capabilities() && !prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) &&
           !syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &filter);
#else
    return drop_capabilities() && !prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
#endif
}

bool rg_cage_shut(void)
{
    const char *const choice = getenv(RG_CAGE_VARIABLE);
    return shut() || (choice && !strcmp(choice, "off"));
}

// --- the reply ---

bool rg_cage_reply(const void *data, size_t bytes)
{
    for (size_t done = 0; done < bytes;) {
        const ssize_t written = write(RG_CAGE_REPLY, (const char *)data + done, bytes - done);
        if (written < 0 && errno != EINTR)
            return false;
        done += written > 0 ? (size_t)written : 0;
    }
    return true;
}
