// Cube maps as six layers, +x -x +y -y +z -z, oriented as in OpenGL and Vulkan.
#ifndef RG_KERNELS_DIALECT_IMAGE_CUBE_H
#define RG_KERNELS_DIALECT_IMAGE_CUBE_H

#include "kernels/dialect/vec.h"

// A point of a cube map.
RG_STRUCT(cube_point)
{
    int face;
    float x; // 0 to `size`, in texels
    float y;
};
RG_STRUCT_SIZE(cube_point, 3)

// `value`, negated if `by` is negative.
RG_FN float cube_turn(float value, float by)
{
    return rg_bits_float(rg_float_bits(value) ^ (rg_float_bits(by) & 0x80000000u));
}

// The face of an axis: the second one if the direction's component is negative.
RG_FN int cube_face(int first, float along)
{
    return first + rg_to_int(rg_float_bits(along) >> 31);
}

// The point in which a direction (of any length but zero) meets a cube map of `size` texels along a
// face.
RG_FN cube_point cube_locate(v3 d, int size)
{
    float ax = rg_abs(d.x);
    float ay = rg_abs(d.y);
    float major = rg_max(ax, rg_max(ay, rg_abs(d.z)));
    // Faces of a negative axis run the other way: across on x and z, down on y.
    float s = ax == major ? cube_turn(-d.z, d.x) : ay == major ? d.x : cube_turn(d.x, d.z);
    float t = ax == major ? -d.y : ay == major ? cube_turn(d.z, d.y) : -d.y;
    float half_size = 0.5f * rg_to_float(size);
    float scale = half_size / major;
    cube_point c;
    c.face = ax == major ? cube_face(0, d.x) : ay == major ? cube_face(2, d.y) : cube_face(4, d.z);
    c.x = s * scale + half_size;
    c.y = t * scale + half_size;
    return c;
}

// The texel that a coordinate of a cube_point lies in.
RG_FN int cube_texel(float coordinate, int size)
{
    return rg_imin(rg_to_int(coordinate), size - 1);
}

#endif
