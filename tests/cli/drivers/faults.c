// A driver of which any function fails. This library is loaded before others (LD_PRELOAD) and
// intercepts every function of Vulkan, OpenCL, EGL and OpenGL that the program calls.
#define _GNU_SOURCE // RTLD_NEXT, dlvsym
#include <dlfcn.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/cli/drivers/ways.h"

enum kind { VK_CODE, VK_VALUE, VK_NOTHING, CL_CODE, CL_HANDLE, CL_VALUE, EGL_VALUE, GL_VALUE };

// --- interception of each function ---

// The program is linked with functions of Vulkan and OpenCL by name. It looks up those of EGL and
// OpenGL; the driver's own calls of these must not be intercepted.
#define NAMED(name)           ".globl " #name "\n.type " #name ", @function\n" #name ":\n"
#define LABEL_VK_CODE         NAMED
#define LABEL_VK_VALUE        NAMED
#define LABEL_VK_NOTHING      NAMED
#define LABEL_CL_CODE         NAMED
#define LABEL_CL_HANDLE       NAMED
#define LABEL_CL_VALUE        NAMED
#define LABEL_EGL_VALUE(name) ""
#define LABEL_GL_VALUE(name)  ""
// Each function has a piece of code that loads its number.
#define FUNCTION(number, name, kind, parameters)                                                   \
    __asm__(".text\n" LABEL_##kind(name) "faulty_" #name ":\n"                                     \
                                         "endbr64\nmov $" #number ", %r11d\njmp faulty_any\n");
#include FUNCTIONS
#undef FUNCTION

// Saves the parameters' registers and asks `choose` for the function to go on with; without one,
// returns its result.
__asm__(".text\nfaulty_any:\n"
        "push %rbp\nmov %rsp, %rbp\nsub $176, %rsp\n"
        "mov %rdi, 0(%rsp)\nmov %rsi, 8(%rsp)\nmov %rdx, 16(%rsp)\n"
        "mov %rcx, 24(%rsp)\nmov %r8, 32(%rsp)\nmov %r9, 40(%rsp)\n"
        "movups %xmm0, 48(%rsp)\nmovups %xmm1, 64(%rsp)\nmovups %xmm2, 80(%rsp)\n"
        "movups %xmm3, 96(%rsp)\nmovups %xmm4, 112(%rsp)\nmovups %xmm5, 128(%rsp)\n"
        "movups %xmm6, 144(%rsp)\nmovups %xmm7, 160(%rsp)\n"
        "mov %r11d, %edi\nmov %rsp, %rsi\ncall choose\n"
        "mov %rax, %r11\nmov %rdx, %rax\n"
        "mov 0(%rsp), %rdi\nmov 8(%rsp), %rsi\nmov 16(%rsp), %rdx\n"
        "mov 24(%rsp), %rcx\nmov 32(%rsp), %r8\nmov 40(%rsp), %r9\n"
        "movups 48(%rsp), %xmm0\nmovups 64(%rsp), %xmm1\nmovups 80(%rsp), %xmm2\n"
        "movups 96(%rsp), %xmm3\nmovups 112(%rsp), %xmm4\nmovups 128(%rsp), %xmm5\n"
        "movups 144(%rsp), %xmm6\nmovups 160(%rsp), %xmm7\n"
        "leave\ntest %r11, %r11\njz 1f\njmp *%r11\n1: ret\n");

#define FUNCTION(number, name, kind, parameters) void faulty_##name(void) __asm__("faulty_" #name);
#include FUNCTIONS
#undef FUNCTION

static struct function {
    const char *name;
    enum kind kind;
    int parameters;
    void (*faulty)(void);
    void *real;
    int calls;
} functions[] = {
#define FUNCTION(number, name, kind, parameters) {#name, kind, parameters, faulty_##name, NULL, 0},
#include FUNCTIONS
#undef FUNCTION
};

static void *real_dlsym(void *handle, const char *name)
{
    static void *(*real)(void *, const char *);
    if (!real)
        real = (void *(*)(void *, const char *))dlvsym(RTLD_NEXT, "dlsym", "GLIBC_2.34");
    if (!real)
        real = (void *(*)(void *, const char *))dlvsym(RTLD_NEXT, "dlsym", "GLIBC_2.2.5");
    return real(handle, name);
}

// --- how it fails ---

static bool is_lost;                  // the device is lost, from now on
static uint32_t pending, egl_pending; // the codes for glGetError and eglGetError; 0: none

static void note_reached(const struct function *function)
{
    const char *path = getenv("RG_REACHED");
    const int file = path ? open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600) : -1;
    char line[80];
    const int length = snprintf(line, sizeof(line), "%s\n", function->name);
    if (file >= 0 && write(file, line, (size_t)length) != length)
        abort();
    if (file >= 0)
        close(file);
}

// Whether a function reports a lost device, besides the one that lost it.
static bool tells_of_loss(const struct function *function)
{
    static const char *const parts[] = {"vkQueue",   "Wait",     "vkGetQueryPoolResults",
                                        "clEnqueue", "clFinish", "clFlush"};
    for (size_t i = 0; i < sizeof(parts) / sizeof(parts[0]); i++)
        if (strstr(function->name, parts[i]))
            return function->kind == VK_CODE || function->kind == CL_CODE;
    return false;
}

struct choice {
    void *to;        // the function to go on with; NULL: none
    uint64_t result; // the result if there is none
};

// The result of a function that fails.
static struct choice refuse(const struct function *function, void *const *parameters, bool lost)
{
    enum {
        VK_NO_MEMORY = -1,
        VK_LOST = -4,
        CL_NO_MEMORY = -6,
        CL_NO_RESOURCES = -5,
        GL_NO_MEMORY = 0x505,
        GL_LOST = 0x507,
        EGL_NO_MEMORY = 0x3003,
        EGL_LOST = 0x300e
    };
    const int32_t cl = lost ? CL_NO_RESOURCES : CL_NO_MEMORY;
    switch (function->kind) {
    case VK_CODE:
        return (struct choice){NULL, (uint32_t)(lost ? VK_LOST : VK_NO_MEMORY)};
    case CL_CODE:
        return (struct choice){NULL, (uint32_t)cl};
    case CL_HANDLE:
        if (parameters[function->parameters - 1])
            *(int32_t *)parameters[function->parameters - 1] = cl;
        break;
    case EGL_VALUE:
        egl_pending = lost ? EGL_LOST : EGL_NO_MEMORY;
        break;
    case GL_VALUE:
        pending = lost ? GL_LOST : GL_NO_MEMORY;
        break;
    default:
        break;
    }
    return (struct choice){NULL, 0};
}

// For glGetError and eglGetError: the pending code, or the driver's own.
static struct choice tell(const struct function *function, uint32_t *code)
{
    const struct choice told = {NULL, *code};
    if (!*code)
        return (struct choice){function->real, 0};
    if (!is_lost)
        *code = 0;
    return told;
}

// Chooses how a call goes on; faulty_any calls it with the six registers of parameters.
struct choice choose(uint32_t number, void *const *parameters)
    __attribute__((used, visibility("hidden")));
struct choice choose(uint32_t number, void *const *parameters)
{
    struct function *function = &functions[number];
    const char *asked = getenv("RG_FAULT");
    char name[64] = "", how[16] = "";
    int after = 0;
    if (!function->real)
        function->real = real_dlsym(RTLD_NEXT, function->name);
    if (!function->calls++)
        note_reached(function);
    const bool is_asked = asked && sscanf(asked, "%63[^:]:%15[^:]:%d", name, how, &after) == 3 &&
                          !strcmp(name, function->name) && function->calls > after;
    if (is_asked) {
        end_as(how);
        is_lost = is_lost || !strcmp(how, "lost");
        if (!is_lost || function->kind != VK_NOTHING) {
            const struct choice refused = refuse(function, parameters, is_lost);
            if (strcmp(name, "glGetError") != 0 && strcmp(name, "eglGetError") != 0)
                return refused;
        }
    }
    if (is_lost && tells_of_loss(function))
        return refuse(function, parameters, true);
    if (!strcmp(function->name, "glGetError"))
        return tell(function, &pending);
    if (!strcmp(function->name, "eglGetError"))
        return tell(function, &egl_pending);
    return (struct choice){function->real, 0};
}

// --- functions that are looked up by name, as libepoxy does ---

static void *before(const char *name, void *real)
{
    for (size_t i = 0; real && i < sizeof(functions) / sizeof(functions[0]); i++) {
        if (strcmp(functions[i].name, name) != 0)
            continue;
        functions[i].real = real;
        return (void *)functions[i].faulty;
    }
    return real;
}

static void *(*real_get)(const char *);

static void *get(const char *name)
{
    return before(name, real_get(name));
}

void *dlsym(void *handle, const char *name);
void *dlsym(void *handle, const char *name)
{
    void *found = real_dlsym(handle, name);
    Dl_info caller;
    const bool is_epoxy = dladdr(__builtin_return_address(0), &caller) && caller.dli_fname &&
                          strstr(caller.dli_fname, "libepoxy");
    if (!is_epoxy || !found)
        return found;
    if (strcmp(name, "eglGetProcAddress") != 0)
        return before(name, found);
    real_get = (void *(*)(const char *))found;
    return (void *)get;
}
