#version 450
// Stages between vertices and fragments of draws of fixed functions (fixed.h).
layout(triangles) in;
layout(location = 0) in vec4 at_in[];
layout(location = 1) in vec4 colour_in[];
layout(location = 0) out vec4 at;
layout(location = 1) out vec4 colour;
layout(std140, binding = 0) uniform Params
{
    ivec4 state;
};

#ifdef BESIDE
layout(triangle_strip, max_vertices = 6) out;
void emit(int i, vec4 moved, float light)
{
    gl_Position = gl_in[i].gl_Position + moved;
    at = at_in[i];
    colour = colour_in[i] * light;
    EmitVertex();
}
void main()
{
    for (int i = 0; i < 3; i++)
        emit(i, vec4(0.0), 1.0);
    EndPrimitive();
    for (int i = 2; i >= 0; i--)
        emit(i, vec4(float(state.z) / 256.0, 0.125, 0.0, 0.0), 0.5);
    EndPrimitive();
}
#endif
#ifdef EVERYWHERE
layout(triangle_strip, max_vertices = 12) out;
void main()
{
    for (int layer = 0; layer < 4; layer++) {
        for (int i = 0; i < 3; i++) {
            gl_Layer = layer;
            gl_ViewportIndex = layer;
            gl_Position = gl_in[i].gl_Position + vec4(float(state.z * layer) / 256.0, 0.0, 0.0, 0.0);
            at = at_in[i];
            colour = colour_in[i];
            EmitVertex();
        }
        EndPrimitive();
    }
}
#endif
