// What a session is: an instance in this process, or one in a worker that is asked for all of it.
// Only files of this folder may include this: all others go through session.h.
#ifndef RG_HARNESS_FRAMES_WAYS_H
#define RG_HARNESS_FRAMES_WAYS_H

#include "core/device/work.h"
#include "core/techniques/proof.h"
#include "harness/frames/digests.h"
#include "harness/frames/subject.h"

struct rg_session;

// What can be done with a session, by where its instance lives; each as session.h or digests.h says
// of the function of the same name.
struct rg_session_ways {
    bool (*open)(struct rg_session *session, const struct rg_subject *subject);
    void (*close)(struct rg_session *session);
    bool (*step)(struct rg_session *session);
    bool (*draw)(struct rg_session *session);
    bool (*sync)(struct rg_session *session);
    bool (*frames)(struct rg_session *session, int frames, double *wall_ms);
    bool (*count)(struct rg_session *session, struct rg_tally *tally);
    bool (*stages)(struct rg_session *session,
                   void (*tell)(const char *kernel, double ms, void *user), void *user);
    bool (*time)(struct rg_session *session, int64_t *time_ns);
    bool (*code)(struct rg_session *session, struct rg_session_code *code);
    void *(*read)(struct rg_session *session, size_t *size);
    bool (*tell)(const struct rg_session *session, struct rg_account *account);
    void *(*read_state)(struct rg_session *session, int index, struct rg_state *layout,
                        size_t *size);
    bool (*obeys)(const struct rg_session *session, const struct rg_law *law, char *detail,
                  size_t size);
    bool (*texture)(const struct rg_session *session, const char *name, struct rg_image_desc *desc,
                    int *first_level);
    bool (*take_digests)(const struct rg_digest_run *run, struct rg_device *device,
                         struct rg_digests *digests);
    bool (*take_contents)(const struct rg_digest_run *run, struct rg_device *device, int row,
                          struct rg_contents *contents, struct rg_state *state);
    bool (*take_dispatches)(const struct rg_digest_run *run, struct rg_device *device,
                            int stages_run, struct rg_dispatches *dispatches);
    bool (*run_dispatched)(struct rg_dispatched *dispatched, struct rg_device *device);
    void *(*take_code)(struct rg_device *device, const struct rg_kernel *kernel,
                       enum rg_code_kind kind, size_t *size);
};
extern const struct rg_session_ways rg_local_session, rg_remote_session;

struct rg_session {
    const struct rg_session_ways *ways;
    struct rg_device *device;
    const struct rg_technique *technique;
    int width, height; // pixels
    int state_count;
    struct rg_instance *instance; // in this process
    int number, life;             // in a worker: its number there, and in which of its lives
};

#endif
