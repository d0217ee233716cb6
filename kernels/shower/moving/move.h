// shower: a step of all particles, including those that leave or land. A kernel defines
// SHOWER_FULL, 1 to keep attributes, and SHOWER_BODY, 1 to test a drop's corners and not its point,
// and includes this file. The code has no branches, so that compilers move several particles side
// by side.
#include "kernels/shower/body.h"
#include "kernels/shower/promotion.h"

#define RG_PARAMS shower_params
#if SHOWER_FULL
#define RG_SLOTS                                                                                   \
    INOUT(1, float, particles)                                                                     \
    OUT(2, uint, marks) IMAGE(3, D32F, heights) INOUT(4, float, attributes)
#else
#define RG_SLOTS INOUT(1, float, particles) OUT(2, uint, marks) IMAGE(3, D32F, heights)
#endif
#include "kernels/dialect/slots/slots.h"

#include "kernels/shower/ground.h"

#if SHOWER_FULL
RG_FN v3 shower_acceleration(rg_ctx rg, shower_params p, int i)
{
    return v3_make(attributes_at(rg, SHOWER_AX * p.slots + i),
                   attributes_at(rg, SHOWER_AY * p.slots + i),
                   attributes_at(rg, SHOWER_AZ * p.slots + i));
}
#else
RG_FN v3 shower_acceleration(rg_ctx rg RG_UNUSED, shower_params p, int i RG_UNUSED)
{
    return v3_make(0.0f, -p.gravity_m_s2, 0.0f);
}
#endif

RG_FN shower_particle shower_at(rg_ctx rg, shower_params p, int i)
{
    shower_particle q;
    q.at =
        v3_make(particles_at(rg, SHOWER_X * p.slots + i), particles_at(rg, SHOWER_Y * p.slots + i),
                particles_at(rg, SHOWER_Z * p.slots + i));
    q.fall_m_s = particles_at(rg, SHOWER_FALL * p.slots + i);
    q.vx = p.wind_x;
    q.vz = p.wind_z;
    q.acceleration = shower_acceleration(rg, p, i);
    q.age = 0.0f;
#if SHOWER_FULL
    q.age = attributes_at(rg, SHOWER_AGE * p.slots + i);
#endif
    return q;
}

RG_PROC void shower_kept(rg_ctx rg, shower_params p, int i, shower_particle q)
{
    particles_put(rg, SHOWER_X * p.slots + i, q.at.x);
    particles_put(rg, SHOWER_Y * p.slots + i, q.at.y);
    particles_put(rg, SHOWER_Z * p.slots + i, q.at.z);
    particles_put(rg, SHOWER_FALL * p.slots + i, q.fall_m_s);
#if SHOWER_FULL
    attributes_put(rg, SHOWER_VX * p.slots + i, q.vx);
    attributes_put(rg, SHOWER_VZ * p.slots + i, q.vz);
    attributes_put(rg, SHOWER_AGE * p.slots + i, q.age);
#endif
}

RG_GRID_KERNEL(shower_move)
{
    shower_particle q = shower_at(rg, p, x);
    shower_particle m = shower_moved(p, q);
    int was = q.fall_m_s > 0.0f ? 1 : 0;
    shower_return back = shower_returned(p, m.at, shower_chance(p, x));
    int crossed = was & p.is_promoted & back.is_back;
    m.at = v3_make(crossed != 0 ? back.at.x : m.at.x, crossed != 0 ? back.at.y : m.at.y,
                   crossed != 0 ? back.at.z : m.at.z);
    float ground = shower_ground(rg, p, m.at.x, m.at.z);
#if SHOWER_BODY
    int seen = shower_holds_body(p, m.at, m.fall_m_s);
#else
    int seen = shower_holds(p, m.at);
#endif
    int stays = was & seen & (m.at.y >= ground ? 1 : 0);
    int raised = (1 - stays) & was & p.is_promoted & shower_has_top(p, m.at.x, m.at.z, ground);
    int afresh = raised | (crossed & back.is_deep);
    float fresh = p.fall_m_s * shower_share(p, shower_ahead(p, m.at.x, m.at.z));
    float promoted = shower_promoted(p, m.at, ground);
    int there = stays | raised; // a free slot is all 0
    m.at = v3_make(there != 0 ? m.at.x : 0.0f,
                   there == 0    ? 0.0f
                   : raised != 0 ? promoted
                                 : m.at.y,
                   there != 0 ? m.at.z : 0.0f);
    m.fall_m_s = there == 0 ? 0.0f : afresh != 0 ? fresh : m.fall_m_s;
    m.vx = there != 0 ? m.vx : 0.0f;
    m.vz = there != 0 ? m.vz : 0.0f;
    m.age = stays != 0 ? m.age : 0.0f;
    shower_kept(rg, p, x, m);
    uint mark = raised != 0 ? SHOWER_PROMOTED : crossed != 0 ? SHOWER_CROSSED : SHOWER_STAYS;
    marks_put(rg, x, there != 0 ? mark : SHOWER_FREE);
}
