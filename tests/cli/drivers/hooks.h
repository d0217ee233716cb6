// The common part of the tests' drivers, which intercept the real ones. Functions that are looked
// up by name get a hook, which goes on to the real function. A driver for Vulkan is in front of
// lavapipe, and the loader finds it by a manifest. For EGL, OpenGL and OpenCL it is loaded before
// others (LD_PRELOAD).
#ifndef RG_TESTS_CLI_DRIVERS_HOOKS_H
#define RG_TESTS_CLI_DRIVERS_HOOKS_H

#include <dlfcn.h> // with _GNU_SOURCE: RTLD_NEXT, dlvsym
#include <stdbool.h>
#include <stddef.h>
#include <string.h>
#include <vulkan/vk_icd.h>
#include <vulkan/vulkan.h>

typedef void (*any_function)(void);

// `real` is known after the function was looked up.
struct hook {
    const char *name;
    any_function hooked, *real;
};
// clang-format off
#define HOOK(function) {#function, (any_function)hooked_##function, (any_function *)(void *)&real_##function}
// clang-format on

// The function that a name gets instead of the real one. Each driver defines it, by hook_among over
// its hooks.
static any_function hook_of(const char *name, any_function real);

static any_function hook_among(const struct hook *hooks, size_t count, const char *name,
                               any_function real)
{
    for (size_t i = 0; real && name && i < count; i++) {
        if (strcmp(hooks[i].name, name) != 0)
            continue;
        *hooks[i].real = real;
        return hooks[i].hooked;
    }
    return real;
}

// --- Vulkan: a driver in front of lavapipe ---

static void *lavapipe(const char *function)
{
    static void *library;
    if (!library)
        library = dlopen("libvulkan_lvp.so", RTLD_NOW | RTLD_LOCAL);
    return library ? dlsym(library, function) : NULL;
}

VKAPI_ATTR VkResult VKAPI_CALL vk_icdNegotiateLoaderICDInterfaceVersion(uint32_t *version)
{
    PFN_vkNegotiateLoaderICDInterfaceVersion real =
        (PFN_vkNegotiateLoaderICDInterfaceVersion)lavapipe(
            "vk_icdNegotiateLoaderICDInterfaceVersion");
    return real ? real(version) : VK_ERROR_INCOMPATIBLE_DRIVER;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vk_icdGetInstanceProcAddr(VkInstance instance,
                                                                   const char *name)
{
    PFN_vkGetInstanceProcAddr real =
        (PFN_vkGetInstanceProcAddr)lavapipe("vk_icdGetInstanceProcAddr");
    return real ? hook_of(name, real(instance, name)) : NULL;
}

// --- EGL and OpenGL: libepoxy asks the dynamic linker for each function ---

void *dlsym(void *handle, const char *name)
{
    static void *(*real)(void *, const char *);
    if (!real)
        real = (void *(*)(void *, const char *))dlvsym(RTLD_NEXT, "dlsym", "GLIBC_2.34");
    if (!real)
        real = (void *(*)(void *, const char *))dlvsym(RTLD_NEXT, "dlsym", "GLIBC_2.2.5");
    void *found = real(handle, name);
    const bool is_ours = !strncmp(name, "gl", 2) || !strncmp(name, "egl", 3);
    return is_ours ? (void *)hook_of(name, (any_function)found) : found;
}

// --- OpenCL: linked functions ---

#define REAL(function) ((__typeof__(&(function)))dlsym(RTLD_NEXT, #function))

#endif
