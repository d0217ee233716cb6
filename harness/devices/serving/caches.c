#include "harness/devices/serving/caches.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/base/files/user.h"

// As Mesa reads it: what is no number is 0.
static int width_of(const char *text)
{
    const long bits = strtol(text, NULL, 0);
    return bits > 0 && bits <= 4096 ? (int)bits : 0;
}

void rg_caches_part(void)
{
    const char *width = getenv("LP_NATIVE_VECTOR_WIDTH");
    char name[64], path[PATH_MAX], why[256];
    if (!width || getenv("MESA_SHADER_CACHE_DIR"))
        return;
    snprintf(name, sizeof(name), "llvmpipe-%d-bits/", width_of(width));
    // Its last name is empty, so that the folder itself is made.
    if (rg_user_path(RG_USER_CACHE, name, path, sizeof(path), why) &&
        rg_user_make_folders(path, why))
        setenv("MESA_SHADER_CACHE_DIR", path, 0);
}
