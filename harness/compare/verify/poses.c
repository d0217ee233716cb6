// Decides which poses of a technique run, and for how long.
#include "harness/compare/verify/verify.h"

// QUICK_STEPS and FULL_STEPS are the defaults of poses. In one of USUAL_PART of the full steps
// drops run down a pane and storms fill a scene; later steps repeat that.
enum { QUICK_STEPS = 100, FULL_STEPS = 1000, USUAL_PART = 5 };

static int usual_steps(int quick, int full)
{
    const int part = (full + USUAL_PART - 1) / USUAL_PART;
    const int steps = quick > part ? quick : part; // fewer may show no rain
    return full == RG_POSE_LEFT_OUT || steps > full ? full : steps;
}

static int own_steps(enum rg_verify_length length, const struct rg_pose *pose)
{
    const int quick = pose->quick_steps ? pose->quick_steps : QUICK_STEPS;
    const int full = pose->full_steps ? pose->full_steps : FULL_STEPS;
    if (length == RG_VERIFY_USUAL)
        return usual_steps(quick, full);
    return length == RG_VERIFY_QUICK ? quick : full;
}

int rg_verify_steps(const struct rg_verify *v, const struct rg_pose *pose)
{
    const int own = own_steps(v->length, pose);
    return own == RG_POSE_LEFT_OUT || v->steps < 0 ? own : v->steps;
}

bool rg_verify_has_seed(const struct rg_verify *v, const struct rg_pose *pose, int seed)
{
    const int place = (int)(pose - v->technique->proof->poses);
    return v->length == RG_VERIFY_FULL || place == 0 || place % RG_VERIFY_SEEDS == seed;
}

int rg_verify_poses(const struct rg_verify *v)
{
    int count = 0;
    for (const struct rg_pose *pose = v->technique->proof->poses; pose->set; pose++)
        count += rg_verify_steps(v, pose) != RG_POSE_LEFT_OUT;
    return count;
}
