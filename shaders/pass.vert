// The vertex stage of a GRID kernel whose texels native devices draw: one triangle over the target.
void main()
{
    float x = (RG_VERTEX_INDEX & 1) != 0 ? 3.0 : -1.0;
    float y = (RG_VERTEX_INDEX & 2) != 0 ? 3.0 : -1.0;
    gl_Position = vec4(x, y, 0.0, 1.0);
}
