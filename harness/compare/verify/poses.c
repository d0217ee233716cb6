// Which poses of a technique are run, and for how long.
#include "harness/compare/verify/verify.h"

// Of poses that do not say.
enum { QUICK_STEPS = 100, FULL_STEPS = 1000 };

int rg_verify_steps(const struct rg_verify *v, const struct rg_pose *pose)
{
    const int own = v->quick ? pose->quick_steps : pose->full_steps;
    if (own == RG_POSE_LEFT_OUT || v->steps < 0)
        return own ? own : v->quick ? QUICK_STEPS : FULL_STEPS;
    return v->steps;
}

bool rg_verify_has_seed(const struct rg_verify *v, const struct rg_pose *pose, int seed)
{
    const int place = (int)(pose - v->technique->proof->poses);
    return !v->quick || place == 0 || place % RG_VERIFY_SEEDS == seed;
}

int rg_verify_poses(const struct rg_verify *v)
{
    int count = 0;
    for (const struct rg_pose *pose = v->technique->proof->poses; pose->set; pose++)
        count += rg_verify_steps(v, pose) != RG_POSE_LEFT_OUT;
    return count;
}
