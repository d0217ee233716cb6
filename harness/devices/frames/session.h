// A session: a technique open on a device, and the harness's only access to an instance.
//
// Results are copies, with no pointer into the instance or the device's memory. So the instance may
// live in a worker (harness/devices/workers/device.h), whose crash does not end the command; only
// this folder knows which.
//
// Functions that return false or NULL have logged one line. A session that has failed can only be
// closed. When a worker ends, all its sessions fail.
#ifndef RG_HARNESS_DEVICES_FRAMES_SESSION_H
#define RG_HARNESS_DEVICES_FRAMES_SESSION_H

#include "core/device/work.h"
#include "core/image/picture.h"
#include "core/techniques/proof.h"
#include "core/techniques/technique.h"
#include "harness/devices/frames/subject.h"

struct rg_session;

// Opens a subject on a device, at frame 0. Its settings are copied.
struct rg_session *rg_session_open(struct rg_device *device, const struct rg_subject *subject);
// Opens a session, simulates this many frames and draws the last.
struct rg_session *rg_session_run(struct rg_device *device, const struct rg_subject *subject,
                                  int frames);
void rg_session_close(struct rg_session *session); // NULL is accepted

// Whether its instance still exists: it ends with its worker, which another session's call can
// crash.
bool rg_session_lives(const struct rg_session *session);

struct rg_device *rg_session_device(const struct rg_session *session);

// --- simulating and drawing ---

// Simulates one frame.
bool rg_session_step(struct rg_session *session);
// Draws the current state.
bool rg_session_draw(struct rg_session *session);
// Waits until the device is idle.
bool rg_session_sync(struct rg_session *session);
// Simulates and draws this many frames, and waits; an interruption (harness/console/interrupt.h)
// ends it early without failure. `wall_ms`, if not NULL, gets the duration from call to end by the
// clock of the instance's process.
bool rg_session_frames(struct rg_session *session, int frames, double *wall_ms);
// Makes one such frame with exact counts of its work, which takes longer.
bool rg_session_count(struct rg_session *session, struct rg_tally *tally);
// Makes one such frame that waits after every stage, and calls `tell` with each stage's kernel and
// wall time, in the frame's order.
bool rg_session_stages(struct rg_session *session,
                       void (*tell)(const char *kernel, double ms, void *user), void *user);
// Reads the API's clock (rg_device_time).
bool rg_session_time(struct rg_session *session, int64_t *time_ns);

// Gets the code that runs for the session, after it has drawn.
bool rg_session_code(struct rg_session *session, struct rg_session_code *code);

// --- its picture ---

// Reads the target's texels in the device's format: *size bytes, which the caller frees.
void *rg_session_read(struct rg_session *session, size_t *size);
// Converts texels from rg_session_read to a picture of 4 channels, which the caller destroys.
bool rg_session_picture(const struct rg_session *session, const void *texels,
                        struct rg_picture *picture);
// Reads and converts.
bool rg_session_read_picture(struct rg_session *session, struct rg_picture *picture);

// --- state and account ---

// Gets an account of the session. False, with one logged line and no account, if the session has
// ended with its worker.
bool rg_session_tell(const struct rg_session *session, struct rg_account *account);

// The number of the state's buffers; and the words of one, which the caller frees. `layout` gets
// its name and rows, but no asset.
int rg_session_state_count(const struct rg_session *session);
void *rg_session_read_state(struct rg_session *session, int index, struct rg_state *layout,
                            size_t *size);
// A law of its technique's proof by number; NULL: there is none.
const struct rg_law *rg_session_law(const struct rg_session *session, int number);
// Whether a law of the technique's proof holds now. If not, `detail` says what is wrong; it is
// empty if the law could not be checked, which has been logged.
bool rg_session_obeys(const struct rg_session *session, const struct rg_law *law, char *detail,
                      size_t size);
// The size of an input texture of the technique, and the level of the whole texture that is its
// level 0. False, without a message, if there is none of this name.
bool rg_session_texture(const struct rg_session *session, const char *name,
                        struct rg_image_desc *desc, int *first_level);

#endif
