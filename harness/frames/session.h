// A technique open on a device: the one way by which the harness reaches an instance.
//
// What comes back is copied, and nothing points into the instance or the device's memory. So the
// instance may live in a worker (harness/devices/workers/device.h), which a driver can bring down
// without harming the command; this folder alone knows.
//
// Functions that return false or NULL have logged one line. A session that has failed is closed.
// When a worker ends, each session in it has failed.
#ifndef RG_HARNESS_FRAMES_SESSION_H
#define RG_HARNESS_FRAMES_SESSION_H

#include "core/device/work.h"
#include "core/image/picture.h"
#include "core/techniques/proof.h"
#include "core/techniques/technique.h"
#include "harness/frames/subject.h"

struct rg_session;

// Opens a subject, whose settings are copied, on a device, at frame 0.
struct rg_session *rg_session_open(struct rg_device *device, const struct rg_subject *subject);
// Opens it, simulates so many frames and draws the last.
struct rg_session *rg_session_run(struct rg_device *device, const struct rg_subject *subject,
                                  int frames);
void rg_session_close(struct rg_session *session); // NULL is accepted

// Whether its instance is still there: it ends with its worker, which another session's call can
// bring down.
bool rg_session_lives(const struct rg_session *session);

struct rg_device *rg_session_device(const struct rg_session *session);

// --- simulating and drawing ---

// Simulates one frame.
bool rg_session_step(struct rg_session *session);
// Draws the present state.
bool rg_session_draw(struct rg_session *session);
// Waits until all is done.
bool rg_session_sync(struct rg_session *session);
// Simulates and draws so many frames, and waits; fewer when the user interrupts
// (harness/console/interrupt.h), which is no failure. `wall_ms` gets how long that took by the
// clock of the process in which the instance lives, from call to end; NULL: nobody asks.
bool rg_session_frames(struct rg_session *session, int frames, double *wall_ms);
// One such frame, with what it comes to counted exactly, which takes its time.
bool rg_session_count(struct rg_session *session, struct rg_tally *tally);
// One such frame that also waits after every stage, and tells how long each took by wall clock, by
// the name of its kernel and in the order of the frame.
bool rg_session_stages(struct rg_session *session,
                       void (*tell)(const char *kernel, double ms, void *user), void *user);
// The API's own clock (rg_device_time).
bool rg_session_time(struct rg_session *session, int64_t *time_ns);

// The code that runs for it, once it has drawn.
bool rg_session_code(struct rg_session *session, struct rg_session_code *code);

// --- its picture ---

// The target's texels as the device holds them: *size bytes, which the caller frees.
void *rg_session_read(struct rg_session *session, size_t *size);
// The same as a picture of 4 channels, which the caller destroys; `texels` as rg_session_read gave
// them.
bool rg_session_picture(const struct rg_session *session, const void *texels,
                        struct rg_picture *picture);
// Both at once.
bool rg_session_read_picture(struct rg_session *session, struct rg_picture *picture);

// --- its state, and what it tells of itself ---

// False, with one logged line and nothing told, where it has gone with its worker.
bool rg_session_tell(const struct rg_session *session, struct rg_account *account);

// The number of the state's buffers, and the words of one, which the caller frees. `layout` gets
// its name and rows, and no asset.
int rg_session_state_count(const struct rg_session *session);
void *rg_session_read_state(struct rg_session *session, int index, struct rg_state *layout,
                            size_t *size);
// The law of this number of its technique's proof; NULL: there is none.
const struct rg_law *rg_session_law(const struct rg_session *session, int number);
// Whether a law of the technique's proof holds now; else `detail` says what is wrong, or is empty
// where it could not be found out, which has been logged.
bool rg_session_obeys(const struct rg_session *session, const struct rg_law *law, char *detail,
                      size_t size);
// The size of a texture that the technique reads from, and the level of the whole texture that its
// level 0 is. False, and nothing is logged, where there is none of this name.
bool rg_session_texture(const struct rg_session *session, const char *name,
                        struct rg_image_desc *desc, int *first_level);

#endif
