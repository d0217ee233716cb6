// shower: puts a new particle into a slot. Kernels include this file after their slots, which have
//   INOUT or OUT(1, float, particles), OUT(4, float, attributes)  of one word if none are kept
#ifndef RG_KERNELS_SHOWER_RENEWAL_PLACE_H
#define RG_KERNELS_SHOWER_RENEWAL_PLACE_H

RG_PROC void shower_put(rg_ctx rg, shower_params p, int i, shower_particle q, int is_full)
{
    particles_put(rg, SHOWER_X * p.slots + i, q.at.x);
    particles_put(rg, SHOWER_Y * p.slots + i, q.at.y);
    particles_put(rg, SHOWER_Z * p.slots + i, q.at.z);
    particles_put(rg, SHOWER_FALL * p.slots + i, q.fall_m_s);
    if (is_full == 0)
        return;
    attributes_put(rg, SHOWER_VX * p.slots + i, q.vx);
    attributes_put(rg, SHOWER_VZ * p.slots + i, q.vz);
    attributes_put(rg, SHOWER_AX * p.slots + i, q.acceleration.x);
    attributes_put(rg, SHOWER_AY * p.slots + i, q.acceleration.y);
    attributes_put(rg, SHOWER_AZ * p.slots + i, q.acceleration.z);
    attributes_put(rg, SHOWER_AGE * p.slots + i, q.age);
}

#endif
