#version 450
// Controls the tessellation of draws of fixed functions (fixed.h).
layout(vertices = 3) out;
layout(location = 0) in vec4 at_in[];
layout(location = 1) in vec4 colour_in[];
layout(location = 0) out vec4 at[];
layout(location = 1) out vec4 colour[];
layout(std140, binding = 0) uniform Params
{
    ivec4 state; // z: the level, in quarters
};

#ifdef BULGE
void main()
{
    gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position;
    at[gl_InvocationID] = at_in[gl_InvocationID];
    colour[gl_InvocationID] = colour_in[gl_InvocationID];
    gl_TessLevelOuter[0] = float(state.z) * 0.25;
    gl_TessLevelOuter[1] = float(state.z) * 0.25 + 1.0;
    gl_TessLevelOuter[2] = float(state.z) * 0.25 + 2.0;
    gl_TessLevelInner[0] = float(state.z) * 0.25;
}
#endif
