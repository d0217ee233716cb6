// The instance of a session. Only files of this folder may include this: all others go through
// session.h.
#ifndef RG_HARNESS_FRAMES_INSIDE_H
#define RG_HARNESS_FRAMES_INSIDE_H

struct rg_instance;
struct rg_session;

struct rg_instance *rg_session_instance(struct rg_session *session);

#endif
