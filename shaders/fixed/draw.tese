#version 450
// Places what the tessellation of draws of fixed functions makes (fixed.h).
layout(triangles, fractional_odd_spacing, ccw) in;
layout(location = 0) in vec4 at_in[];
layout(location = 1) in vec4 colour_in[];
layout(location = 0) out vec4 at;
layout(location = 1) out vec4 colour;

#ifdef BULGE
void main()
{
    vec3 c = gl_TessCoord;
    gl_Position = gl_in[0].gl_Position * c.x + gl_in[1].gl_Position * c.y + gl_in[2].gl_Position * c.z;
    gl_Position.xy *= 1.0 + c.x * c.y + c.y * c.z;
    at = at_in[0] * c.x + at_in[1] * c.y + at_in[2] * c.z;
    colour = vec4(c, 1.0) * 0.75 + 0.25 * colour_in[0];
}
#endif
