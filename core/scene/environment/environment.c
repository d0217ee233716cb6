#include "core/scene/environment/environment.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/image/files/io.h"
#include "core/scene/environment/cube.h"
#include "core/scene/environment/ktx.h"
#include "core/scene/environment/street.h"

// The folder in which Debian's open3d-gui-data installs its maps; RG_ENVIRONMENT_DIR may name
// another.
#define PACKAGE_DIR "/usr/share/open3d-gui/resources"

enum { SKY_SIZE = 256, MIN_SIZE = 16, MAX_SIZE = 1024 };

// --- the procedural sky: overcast, brighter towards the horizon, over dark ground ---

static double mix_by(double low, double high, double t)
{
    t = fmin(fmax(t, 0), 1);
    return low + (high - low) * t * t * (3 - 2 * t);
}

// To a whole power by products alone, which every C library has alike.
static double power_of(double x, int power)
{
    double result = 1;
    for (; power; power >>= 1, x *= x)
        result *= power & 1 ? x : 1;
    return result;
}

static void sky_light(const double d[3], const void *user, double light[3])
{
    (void)user;
    static const double zenith[3] = {0.35, 0.42, 0.52}, horizon[3] = {0.95, 0.97, 1.0},
                        ground[3] = {0.06, 0.06, 0.055}, sun[3] = {0.48, 0.6, 0.64};
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double up = d[1] / length;
    const double to_sun = (d[0] * sun[0] + d[1] * sun[1] + d[2] * sun[2]) / length;
    const double glow = to_sun > 0 ? power_of(to_sun, 24) * 2 + power_of(to_sun, 400) * 40 : 0;
    for (int i = 0; i < 3; i++) {
        double sky = mix_by(horizon[i], zenith[i], up * 1.6) + glow;
        light[i] = mix_by(ground[i], sky, up * 25 + 0.5);
    }
}

static struct rg_environment *make_sky(void)
{
    struct rg_environment *environment = rg_environment_create(SKY_SIZE);
    if (environment)
        rg_environment_fill(environment, sky_light, NULL);
    return environment;
}

// --- lat-long images: the horizon along the middle row, straight up along the top ---

static double picture_value(const struct rg_picture *p, int x, int y, int channel)
{
    x = (x % p->width + p->width) % p->width;
    y = y < 0 ? 0 : y >= p->height ? p->height - 1 : y;
    channel = p->channels < 3 ? 0 : channel;
    return (double)p->texels[((int64_t)y * p->width + x) * p->channels + channel];
}

static void lat_long_light(const double d[3], const void *user, double light[3])
{
    const struct rg_picture *picture = user;
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double u = (atan2(d[0], -d[2]) / (2 * M_PI) + 0.5) * picture->width - 0.5;
    const double v = acos(d[1] / length) / M_PI * picture->height - 0.5;
    const int x = (int)floor(u), y = (int)floor(v);
    const double fx = u - x, fy = v - y;
    for (int c = 0; c < 3; c++)
        light[c] = (picture_value(picture, x, y, c) * (1 - fx) +
                    picture_value(picture, x + 1, y, c) * fx) *
                       (1 - fy) +
                   (picture_value(picture, x, y + 1, c) * (1 - fx) +
                    picture_value(picture, x + 1, y + 1, c) * fx) *
                       fy;
}

static struct rg_environment *read_lat_long(const char *path)
{
    struct rg_picture picture;
    if (!rg_picture_read(path, &picture))
        return NULL;
    if (picture.width != 2 * picture.height) {
        rg_error("%s: %dx%d is no lat-long environment; it must be twice as wide as high", path,
                 picture.width, picture.height);
        rg_picture_destroy(&picture);
        return NULL;
    }
    int size = picture.height / 2;
    size = size < MIN_SIZE ? MIN_SIZE : size > MAX_SIZE ? MAX_SIZE : size;
    struct rg_environment *environment = rg_environment_create(size);
    if (environment)
        rg_environment_fill(environment, lat_long_light, &picture);
    rg_picture_destroy(&picture);
    return environment;
}

// --- by name ---

static bool ends_in(const char *text, const char *end)
{
    const size_t length = strlen(text), end_length = strlen(end);
    return length >= end_length && !strcmp(text + length - end_length, end);
}

static bool is_path(const char *name)
{
    return strpbrk(name, "./");
}

static const char *package_folder(void)
{
    const char *folder = getenv("RG_ENVIRONMENT_DIR");
    return folder && *folder ? folder : PACKAGE_DIR;
}

void rg_environment_file(const char *name, char path[RG_ENVIRONMENT_PATH_SIZE])
{
    if (is_path(name))
        snprintf(path, RG_ENVIRONMENT_PATH_SIZE, "%s", name);
    else
        snprintf(path, RG_ENVIRONMENT_PATH_SIZE, "%s/%s_skybox.ktx", package_folder(), name);
}

static struct rg_environment *read_packaged(const char *name)
{
    const char *folder = package_folder();
    char path[RG_ENVIRONMENT_PATH_SIZE];
    rg_environment_file(name, path);
    if (!access(path, F_OK))
        return rg_ktx_read(path);
    if (!access(folder, F_OK))
        return rg_error_null("environment '%s': neither a file nor a map in %s", name, folder);
    rg_warning("environment '%s': %s is absent (the Debian package open3d-gui-data brings it); "
               "using the procedural sky",
               name, folder);
    return make_sky();
}

// The street, with as many texels as its reader has use for.
static struct rg_environment *make_street(enum street_time time, int size_px)
{
    return rg_street(time, size_px < MIN_SIZE ? MIN_SIZE : size_px > MAX_SIZE ? MAX_SIZE : size_px);
}

struct rg_environment *rg_environment_load(const char *name, int size_px)
{
    if (!strcmp(name, "street"))
        return make_street(STREET_DAY, size_px);
    if (!strcmp(name, "street-night"))
        return make_street(STREET_NIGHT, size_px);
    if (!*name || !strcmp(name, "sky"))
        return make_sky();
    if (ends_in(name, ".ktx"))
        return rg_ktx_read(name);
    if (is_path(name))
        return read_lat_long(name);
    return read_packaged(name);
}

static bool write_level(const struct rg_environment *environment, int level, struct rg_image *image)
{
    const int size_px = rg_level_size(image->desc.width, level);
    const size_t face_texels = (size_t)size_px * (size_t)size_px;
    uint32_t *texels = malloc(6 * face_texels * sizeof(uint32_t));
    if (!texels)
        return rg_harness_error("environment: no memory for faces of %d texels", size_px);
    bool ok = rg_environment_pack(environment, size_px, texels);
    for (int face = 0; ok && face < 6; face++)
        ok = rg_image_write(image, face, level, texels + (size_t)face * face_texels);
    free(texels);
    return ok;
}

struct rg_image *rg_environment_upload(const struct rg_environment *environment, int size_px,
                                       int levels, struct rg_device *device)
{
    struct rg_image *image = rg_image_create(
        device, &(struct rg_image_desc){RG_RG11B10F, size_px, size_px, 6, levels}, "environment");
    struct rg_environment *halved = NULL; // from level to level
    for (int level = 0; image && level < levels; level++) {
        if (!rg_environment_halve_to(environment, rg_level_size(size_px, level), &halved) ||
            !write_level(halved ? halved : environment, level, image)) {
            rg_image_destroy(image);
            image = NULL;
        }
    }
    rg_environment_destroy(halved);
    return image;
}
