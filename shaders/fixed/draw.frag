#version 450
// Fragments of draws of fixed functions (fixed.h). A section is chosen by its name, as a macro.
layout(std140, binding = 0) uniform Params
{
    ivec4 state; // nudge, shift, value
};

#ifdef COLOUR
layout(location = 1) in vec4 colour;
layout(location = 0) out vec4 shade;
void main() { shade = colour; }
#endif
#ifdef AFFINE
layout(location = 1) noperspective in vec4 colour;
layout(location = 0) out vec4 shade;
void main() { shade = colour; }
#endif
#ifdef CENTROID
layout(location = 1) centroid in vec4 colour;
layout(location = 0) out vec4 shade;
void main() { shade = colour; }
#endif
#ifdef FLAT
layout(location = 1) flat in vec4 colour;
layout(location = 0) out vec4 shade;
void main() { shade = colour; }
#endif
#ifdef DERIVATIVES
layout(location = 0) in vec4 at;
layout(location = 0) out vec4 shade;
void main() { shade = vec4(dFdx(at.xy), dFdy(at.xy) + fwidth(at.x * at.y)); }
#endif

#ifdef TEXTURE
layout(location = 0) in vec4 at;
layout(location = 0) out vec4 shade;
layout(binding = 1) uniform sampler2D image;
void main() { shade = texture(image, at.xy); }
#endif
#ifdef LAYERED
layout(location = 0) in vec4 at;
layout(location = 0) out vec4 shade;
layout(binding = 1) uniform sampler2DArray image;
void main() { shade = texture(image, vec3(at.xy, at.z + float(state.z) / 256.0)); }
#endif
#ifdef CUBE
layout(location = 0) in vec4 at;
layout(location = 0) out vec4 shade;
layout(binding = 1) uniform samplerCube image;
void main() { shade = texture(image, vec3(at.x - 0.625, 1.25 - at.y, at.z * 0.5 - 1.0)); }
#endif
#ifdef SHADOW
layout(location = 0) in vec4 at;
layout(location = 0) out vec4 shade;
layout(binding = 1) uniform sampler2DShadow image;
void main() { shade = vec4(texture(image, vec3(at.xy, at.z * 0.25)), texture(image, vec3(at.yx, 0.5)), 0.0, 1.0); }
#endif
#ifdef GATHER
layout(location = 0) in vec4 at;
layout(location = 0) out vec4 shade;
layout(binding = 1) uniform sampler2D image;
void main() { shade = textureGather(image, at.xy, 1) - 0.5 * textureGather(image, at.yx, 3) + 0.25; }
#endif
#ifdef GRAD
layout(location = 0) in vec4 at;
layout(location = 0) out vec4 shade;
layout(binding = 1) uniform sampler2D image;
void main()
{
    float step = float(state.z) / 256.0;
    shade = textureGrad(image, at.xy, vec2(step * at.x, 0.0), vec2(0.0, step * at.y));
}
#endif

#ifdef DEPTH
layout(location = 1) in vec4 colour;
layout(location = 0) out vec4 shade;
void main()
{
    shade = colour;
    gl_FragDepth = gl_FragCoord.z * 0.5 + float(state.z) / 4096.0 + colour.x * 0.25;
}
#endif
#ifdef DISCARD
layout(location = 1) in vec4 colour;
layout(location = 0) out vec4 shade;
layout(std430, binding = 2) buffer Counts { uint counts[64]; };
void main()
{
    atomicAdd(counts[int(gl_FragCoord.x)], 1u);
    if (fract(colour.x * 8.0) < 0.5)
        discard;
    shade = colour;
}
#endif
#ifdef EARLY
layout(early_fragment_tests) in;
layout(location = 1) in vec4 colour;
layout(location = 0) out vec4 shade;
layout(std430, binding = 2) buffer Counts { uint counts[64]; };
void main()
{
    atomicAdd(counts[int(gl_FragCoord.x)], 1u);
    if (fract(colour.x * 8.0) < 0.5)
        discard;
    shade = colour;
}
#endif

#ifdef TARGETS
layout(location = 1) in vec4 colour;
layout(location = 0) out vec4 shades[5];
void main()
{
    shades[0] = colour;
    shades[1] = colour.yzxw;
    shades[2] = colour.zxyw;
    shades[3] = colour.wxyz;
    shades[4] = colour.xwzy;
}
#endif
#ifdef DUAL
layout(location = 1) in vec4 colour;
layout(location = 0, index = 0) out vec4 shade;
layout(location = 0, index = 1) out vec4 weight;
void main()
{
    shade = colour;
    weight = colour.yzwx;
}
#endif
#ifdef STORE
layout(location = 1) in vec4 colour;
layout(location = 0) out vec4 shade;
layout(binding = 3, rgba8) writeonly uniform image2D bytes;
layout(binding = 4, rgba16f) writeonly uniform image2D halves;
layout(binding = 5, rgb10_a2) writeonly uniform image2D tens;
layout(binding = 6, r11f_g11f_b10f) writeonly uniform image2D elevens;
void main()
{
    ivec2 place = ivec2(gl_FragCoord.xy);
    imageStore(bytes, place, colour);
    imageStore(halves, place, colour * 3.0);
    imageStore(tens, place, colour);
    imageStore(elevens, place, colour * 5.0);
    shade = colour;
}
#endif
