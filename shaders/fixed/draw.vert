#version 450
// Vertices of draws of fixed functions (fixed.h). A section is chosen by its name, as a macro.
#ifdef FEEDBACK
#define CAUGHT(offset) , xfb_buffer = 0, xfb_offset = offset, xfb_stride = 32
#else
#define CAUGHT(offset)
#endif

layout(location = 0) in vec4 position;
layout(location = 1) in vec4 at_in;
layout(location = 2) in vec4 colour_in;
layout(location = 3) in vec4 offset;
layout(std140, binding = 0) uniform Params
{
    ivec4 state; // nudge, shift, value
};
layout(location = 0 CAUGHT(0)) out vec4 at;
layout(location = 1 CAUGHT(16)) out vec4 colour;

#ifdef PLAIN
vec4 coloured() { return colour_in; }
#endif
#ifdef FEEDBACK
vec4 coloured() { return colour_in; }
#endif
#ifdef CLIPPED
out float gl_ClipDistance[1];
vec4 coloured() { return colour_in; }
#endif
#ifdef FORMATS
layout(location = 4) in vec4 bytes;
layout(location = 5) in vec4 signed_bytes;
layout(location = 6) in vec4 words;
layout(location = 7) in vec4 signed_words;
layout(location = 8) in vec4 halves;
layout(location = 9) in vec4 tens;
vec4 coloured() { return (bytes + 0.5 * signed_bytes + 2.0 * words + signed_words + 0.25 * halves + tens) * 0.125 + 0.25; }
#endif

void main()
{
    vec4 moved = position + offset;
    moved.xy += float(state.x) / 8192.0 * moved.w;
    gl_Position = moved;
    gl_PointSize = float(state.z);
    at = at_in + vec4(vec3(float(state.y) / 4096.0), 0.0);
    colour = coloured();
#ifdef CLIPPED
    gl_ClipDistance[0] = moved.x + 0.4375 * moved.y + float(state.z) / 256.0;
#endif
}
