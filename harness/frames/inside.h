// The instance of a session, for what else looks into it in this folder, and nowhere else.
#ifndef RG_HARNESS_FRAMES_INSIDE_H
#define RG_HARNESS_FRAMES_INSIDE_H

struct rg_instance;
struct rg_session;

struct rg_instance *rg_session_instance(struct rg_session *session);

#endif
