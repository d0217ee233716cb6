// A library, loaded before raingauge, in which raingauge's own calls for resources fail. Calls of
// drivers and other libraries do not fail, since they return into other code.
//
//     WANT_CALL    the calls that fail: "malloc" (with calloc, realloc and aligned_alloc), "mmap",
//                  "fdopen", "memstream", "spawn", "pipe", "socketpair", "memfd" or "thread"
//     WANT_AT      N: only a process's Nth such call; 0 or none: all of them
//     WANT_OF      "worker": only in workers; "harness": only in other processes; none: in all
#define _GNU_SOURCE // dl_iterate_phdr
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <spawn.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static uintptr_t program_begin, program_end;
static char wanted[32];
static long at;
static atomic_long calls;

// The first object is the program.
static int find_program(struct dl_phdr_info *info, size_t size, void *user)
{
    (void)size;
    (void)user;
    for (int i = 0; i < info->dlpi_phnum; i++) {
        const ElfW(Phdr) *part = &info->dlpi_phdr[i];
        if (part->p_type != PT_LOAD || !(part->p_flags & PF_X))
            continue;
        program_begin = info->dlpi_addr + part->p_vaddr;
        program_end = program_begin + part->p_memsz;
    }
    return 1;
}

static int is_worker(void)
{
    char line[512] = "";
    const int file = open("/proc/self/cmdline", O_RDONLY);
    const ssize_t got = file < 0 ? 0 : read(file, line, sizeof(line) - 1);
    if (file >= 0)
        close(file);
    const size_t name = strlen(line) + 1;
    return (size_t)(got < 0 ? 0 : got) > name && !strcmp(line + name, "worker");
}

__attribute__((constructor)) static void begin(void)
{
    const char *call = getenv("WANT_CALL"), *number = getenv("WANT_AT"), *of = getenv("WANT_OF");
    if (!call || (of && *of && (strcmp(of, "worker") == 0) != is_worker()))
        return;
    at = number ? atol(number) : 0;
    snprintf(wanted, sizeof(wanted), "%s", call);
    dl_iterate_phdr(find_program, NULL);
}

static int fails(const char *call, const void *from)
{
    const uintptr_t place = (uintptr_t)from;
    if (place < program_begin || place >= program_end || strcmp(call, wanted) != 0)
        return 0;
    const long number = ++calls;
    return !at || number == at;
}

#define REFUSE(call, error, result)                                                                \
    if (fails(call, __builtin_return_address(0)))                                                  \
    return errno = (error), (result)
#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

void *malloc(size_t size)
{
    REFUSE("malloc", ENOMEM, NULL);
    return __libc_malloc(size);
}

void *calloc(size_t count, size_t size)
{
    REFUSE("malloc", ENOMEM, NULL);
    return __libc_calloc(count, size);
}

void *realloc(void *memory, size_t size)
{
    REFUSE("malloc", ENOMEM, NULL);
    return __libc_realloc(memory, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    REFUSE("malloc", ENOMEM, NULL);
    return __libc_memalign(alignment, size);
}

char *strdup(const char *text)
{
    REFUSE("malloc", ENOMEM, NULL);
    char *copy = __libc_malloc(strlen(text) + 1);
    return copy ? strcpy(copy, text) : NULL;
}

// With 64-bit offsets the linker's name is mmap64.
void *mmap(void *place, size_t size, int allowed, int flags, int file, off_t from)
{
    REFUSE("mmap", ENOMEM, MAP_FAILED);
    return NEXT(mmap)(place, size, allowed, flags, file, from);
}

FILE *fdopen(int file, const char *mode)
{
    REFUSE("fdopen", ENOMEM, NULL);
    return NEXT(fdopen)(file, mode);
}

FILE *open_memstream(char **text, size_t *size)
{
    REFUSE("memstream", ENOMEM, NULL);
    return NEXT(open_memstream)(text, size);
}

int posix_spawnp(pid_t *child, const char *name, const posix_spawn_file_actions_t *actions,
                 const posix_spawnattr_t *attributes, char *const arguments[],
                 char *const environment[])
{
    REFUSE("spawn", EAGAIN, EAGAIN);
    return NEXT(posix_spawnp)(child, name, actions, attributes, arguments, environment);
}

int pipe2(int ends[2], int flags)
{
    REFUSE("pipe", EMFILE, -1);
    return NEXT(pipe2)(ends, flags);
}

int socketpair(int domain, int type, int protocol, int ends[2])
{
    REFUSE("socketpair", ENFILE, -1);
    return NEXT(socketpair)(domain, type, protocol, ends);
}

int memfd_create(const char *name, unsigned int flags)
{
    REFUSE("memfd", EPERM, -1);
    return NEXT(memfd_create)(name, flags);
}

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*act)(void *),
                   void *user)
{
    REFUSE("thread", EAGAIN, EAGAIN);
    return NEXT(pthread_create)(thread, attributes, act, user);
}
