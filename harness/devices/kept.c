#include "harness/devices/kept.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"

// --- subjects ---

static bool is_same(const struct rg_subject *a, const struct rg_subject *b)
{
    return a->settings && a->technique == b->technique && a->width == b->width &&
           a->height == b->height &&
           !memcmp(a->settings, b->settings, a->technique->params->settings_size);
}

// Copies a subject with its settings. False, with one logged line, when memory runs out.
static bool own_subject(struct rg_subject *own, const struct rg_subject *subject)
{
    *own = *subject;
    own->settings = rg_settings_copy(subject->technique, subject->settings, "");
    return own->settings != NULL;
}

static void free_subject(struct rg_subject *own)
{
    free((void *)own->settings);
    *own = (struct rg_subject){0};
}

// --- devices ---

struct rg_device *rg_kept_device(struct rg_kept *kept, const char *name)
{
    for (int i = 0; i < kept->devices->count; i++)
        if (!strcmp(kept->devices->devices[i]->info.name, name))
            return kept->devices->devices[i];
    struct rg_device **own = kept->own;
    while (*own && strcmp((*own)->info.name, name) && own < kept->own + RG_KEPT_DEVICES - 1)
        own++;
    if (!*own)
        *own = rg_devices_open_one(name);
    return *own;
}

// --- sessions ---

// The place of the session kept on a device; each device has one.
static struct rg_kept_session *kept_on(struct rg_kept *kept, const struct rg_device *device)
{
    struct rg_kept_session *place = kept->sessions;
    while (place->session && rg_session_device(place->session) != device)
        place++;
    return place;
}

static void close_kept(struct rg_kept_session *place)
{
    rg_session_close(place->session);
    free_subject(&place->of);
    place->session = NULL;
}

void rg_kept_put(struct rg_kept *kept, struct rg_session *session)
{
    struct rg_kept_session *place = kept_on(kept, rg_session_device(session));
    close_kept(place);
    place->session = session;
}

struct rg_session *rg_kept_open(struct rg_kept *kept, struct rg_device *device,
                                const struct rg_subject *subject)
{
    struct rg_kept_session *place = kept_on(kept, device);
    if (place->session && is_same(&place->of, subject))
        return place->session;
    struct rg_session *session = rg_session_open(device, subject);
    if (!session)
        return NULL;
    rg_kept_put(kept, session);
    return own_subject(&place->of, subject) ? session : NULL;
}

// --- truths ---

static bool draw_truth(struct rg_kept *kept, const struct rg_subject *subject, int frames,
                       struct rg_picture *picture)
{
    struct rg_device *device = rg_kept_device(kept, "cpu");
    struct rg_session *session = device ? rg_session_run(device, subject, frames) : NULL;
    if (!session)
        return false;
    const bool ok = rg_session_read_picture(session, picture);
    rg_kept_put(kept, session);
    return ok;
}

const struct rg_picture *rg_kept_truth(struct rg_kept *kept, const struct rg_subject *subject,
                                       int frames)
{
    for (int i = 0; i < RG_KEPT_TRUTHS; i++)
        if (kept->truths[i].frames == frames && is_same(&kept->truths[i].of, subject))
            return &kept->truths[i].picture;
    struct rg_kept_picture *truth = &kept->truths[kept->truth_count % RG_KEPT_TRUTHS];
    rg_picture_destroy(&truth->picture);
    free_subject(&truth->of);
    *truth = (struct rg_kept_picture){.frames = frames};
    if (!draw_truth(kept, subject, frames, &truth->picture) || !own_subject(&truth->of, subject))
        return NULL;
    kept->truth_count++;
    return &truth->picture;
}

bool rg_kept_free(struct rg_kept *kept)
{
    bool clean = true;
    for (int i = 0; i < RG_MAX_DEVICES + RG_KEPT_DEVICES; i++)
        close_kept(&kept->sessions[i]);
    for (int i = 0; i < RG_KEPT_TRUTHS; i++) {
        rg_picture_destroy(&kept->truths[i].picture);
        free_subject(&kept->truths[i].of);
    }
    for (int i = 0; i < RG_KEPT_DEVICES; i++)
        if (kept->own[i])
            clean = rg_device_close(kept->own[i]) && clean;
    *kept = (struct rg_kept){.devices = kept->devices};
    return clean;
}
