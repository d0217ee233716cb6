"""The backends of drivers: OpenGL, Vulkan and OpenCL."""
from fault import Fault

TESTS = ("device suite, draws, gl", "device suite, targets, gl", "device suite, images, gl", "device suite, kernels, gl",
         "device suite, draws, vulkan", "device suite, targets, vulkan", "device suite, images, vulkan",
         "device suite, kernels, vulkan", "device suite, kernels, opencl", "device suite, images, opencl",
         "device suite, draws, opencl", "gl", "vulkan", "opencl")

GL, TARGET, VK, VK_TIME, VK_IMAGE = ("backends/gl/draw.c", "backends/gl/target.c", "backends/vulkan/draw.c",
                                     "backends/vulkan/time.c", "backends/vulkan/image.c")
ROUNDING, KERNEL, OF_ROUNDING = "backends/asked/rounding.c", "backends/kernel.c", ("rounding of devices", "command line, doctor")
CL_BUF, CL_PASS, CL_TIME = "backends/opencl/buf.c", "backends/opencl/pass.c", "backends/opencl/time.c"
OF_GL = ("device suite, draws, gl", "device suite, targets, gl")
OF_VK = ("device suite, draws, vulkan", "device suite, targets, vulkan", "device suite, kernels, vulkan")
OF_CL = ("device suite, kernels, opencl", "device suite, images, opencl", "opencl")

BLENDING, OF_BLENDING = "backends/asked/blending.c", ("blending of devices",)
OWN_GL, OWN_VK = ("device suite, draws, gl, own blending",), ("device suite, draws, vulkan, own blending",)

MANIFESTS, OF_FAILING = "backends/manifests.c", ("command line, failing",)

# Draws of fixed functions.
OF_FIXED_GL, OF_FIXED_VK = ("fixed functions, gl",), ("fixed functions, vulkan",)
GL_STATE, GL_TEXTURE, GL_TARGET = (f"backends/gl/api/fixed/{name}.c" for name in ("state", "texture", "target"))
VK_PIPELINE, VK_TEXTURE, VK_RECORD = (f"backends/vulkan/api/fixed/{name}.c" for name in ("pipeline", "texture", "record"))

# Bounds of those draws.
ROUND, COVER, PLANE, TEXTURE, DECODE, MERGE, SCENE, BOUNDS, SECTIONS, CORNERS, SHADE = (
    f"shaders/fixed/bounds/{name}.c" for name in
    ("span", "cover", "plane", "texture", "decode", "merge", "scene", "bounds", "sections", "corners", "shade"))
CUBE = "shaders/fixed/bounds/cube.c"
OF_BOUNDS, JUDGED = ("bounds of places", "bounds of texels", "bounds of draws"), "harness/devices/measure/serving/fixed_pairs.c"

# Native devices.
GL_SAMPLER, VK_SAMPLER, VK_STATE = "backends/gl/api/sampler.c", "backends/vulkan/api/sampler.c", "backends/vulkan/api/pipeline.c"
OF_NATIVE = ("command line, native",)
OF_SUITE_GL, OF_SUITE_VK = ("device suite, native, gl",), ("device suite, native, vulkan",)

FEATURES, OF_FEATURES = "backends/asked/features.c", "harness/compare/blame/features.c"
GRID, TARGETS, OF_BOTH_SUITES = "core/device/grid.c", "core/device/targets.c", OF_SUITE_GL + OF_SUITE_VK

ROWS = [
    Fault(FEATURES, "asked && *asked ? «0» : RG_FEATURE_ALL", "RG_FEATURE_ALL", "features that are not named are the driver's too", tests=OF_NATIVE),
    Fault(FEATURES, "device->blends = «!(device->info.features & RG_FEATURE_BLENDING)» &&", "false", "a driver that shall not blend blends", tests=OF_NATIVE),
    Fault(OF_FEATURES, "device->info.features & «~exact», words);", "exact", "the other features are switched", tests=OF_NATIVE),
    Fault(OF_FEATURES, "told->by_bits = is_first ? «holds» : told->by_bits;", "true", "features are to end differences within the tier", tests=OF_NATIVE),
    Fault(GL, "glDrawArrays(GL_TRIANGLES, 0, «3»);", "0", "gl:native draws no texels", tests=OF_SUITE_GL),
    Fault(VK, "vkCmdDraw(commands, «3», 1, 0, 0);", "0", "vulkan:native draws no texels", tests=OF_SUITE_VK),
    Fault(TARGETS, ".layer = «kernel->layer(run->params, from->depth)»,", "0", "texels of every layer are drawn in the first", tests=OF_BOTH_SUITES),
    Fault(TARGETS, ".x1 = smaller(«from->width + extent->width»,", "extent->width", "the scissor of texels begins at the edge", tests=OF_BOTH_SUITES),
    Fault(TARGETS, ".y1 = smaller(«from->height + extent->height», image->desc.height)", "from->height + extent->height + 1", "a row of texels is drawn that no item has", tests=OF_BOTH_SUITES),
    Fault(GRID, "draws_texels(pass) ? «1» : limits->max_groups[2];", "limits->max_groups[2]", "texels of one layer alone are drawn", tests=OF_BOTH_SUITES),
    Fault(GL_SAMPLER, "GL_TEXTURE_COMPARE_FUNC, «GL_LEQUAL»", "GL_GREATER", "gl:native lights what is in shadow", tests=OF_NATIVE),
    Fault(GL_SAMPLER, "GL_TEXTURE_MAG_FILTER, «GL_LINEAR»", "GL_NEAREST", "gl:native weighs no texels", tests=OF_SUITE_GL),
    Fault("backends/gl/image.c", "GL_TEXTURE_BASE_LEVEL, «first - 1»", "0", "gl:native makes levels that it was given", tests=OF_SUITE_GL),
    Fault("backends/vulkan/api/texels.c", "1, &blit, «VK_FILTER_LINEAR»", "VK_FILTER_NEAREST", "vulkan:native takes single texels for a level", tests=OF_SUITE_VK),
    Fault("core/techniques/streaks/textures.c", "ok = «halves(desc, level)» || write_level(", "true", "vulkan:native makes a splash's last level of its middle column", tests=("streaks, levels, vulkan native",)),
    Fault("backends/gl/api/query.c", "glDrawArrays(GL_POINTS, items.first, «items.count»);", "1", "a query of gl:native draws one item", tests=OF_SUITE_GL),
    Fault(GL_SAMPLER, "wrap = «sampling == RG_SAMPLED_TILED» ?", "false", "gl:native repeats no texture", tests=OF_NATIVE),
    Fault(GL, "glFrontFace(«GL_CW»);", "GL_CCW", "gl:native culls front for back", tests=OF_NATIVE),
    Fault(VK_SAMPLER, ".compareOp = «VK_COMPARE_OP_LESS_OR_EQUAL»,", "VK_COMPARE_OP_GREATER", "vulkan:native lights what is in shadow", tests=OF_NATIVE),
    Fault(VK_SAMPLER, "wrap = «sampling == RG_SAMPLED_TILED»", "false", "vulkan:native repeats no texture", tests=OF_NATIVE),
    Fault(VK_STATE, ".frontFace = «VK_FRONT_FACE_COUNTER_CLOCKWISE»,", "VK_FRONT_FACE_CLOCKWISE", "vulkan:native culls front for back", tests=OF_NATIVE),
    Fault(MANIFESTS, "return walk->is_failing ? RG_LIST_FAILED : «RG_LIST_BROKEN»;", "RG_LIST_FAILED", "a file that is broken is the driver's fault", tests=OF_FAILING),
    Fault(MANIFESTS, "name another\", walk->named_by);\n        return «RG_LIST_BROKEN»;", "RG_LIST_FAILED", "a variable that names a driver without a device is the driver's fault", tests=OF_FAILING),
    Fault("backends/opencl/api/search.c", "        note(search, «RG_MANIFEST_BROKEN»,\n             \"no OpenCL device: PoCL cannot", "RG_MANIFEST_FAILED", "a cache that takes no files is PoCL's fault", tests=OF_FAILING),
    Fault("backends/gl/api/drivers.c", "add_linker_error(why, why_size)) {\n        state = «RG_MANIFEST_BROKEN»;", "RG_MANIFEST_FAILED", "a library of Mesa's that is damaged is Mesa's fault", tests=OF_FAILING),
    Fault("core/device/device.c", "(count == RG_LIST_BROKEN ? «rg_setup_error» : rg_driver_error)", "rg_driver_error", "what is broken is told as an error of a driver's", tests=OF_FAILING),
    Fault(MANIFESTS, "return walk.is_named_broken ? «end_of(&walk)» : count;", "count", "a named driver that fails beside a good one is passed over", tests=OF_FAILING),
    Fault(MANIFESTS, "if («walk->named_by»)", "false", "a named driver without a device is absent", tests=OF_FAILING),
    Fault(MANIFESTS, "if («*broken»)", "false", "a driver that cannot be loaded is absent", tests=OF_FAILING),
    Fault(MANIFESTS, "return «!is_named && *walk.broken» && *paths;", "false", "one damaged file takes all drivers along", tests=OF_FAILING),
    Fault("backends/gl/api/drivers.c", "    if («search->grave»)", "false", "another driver of Mesa's than the one asked for is taken", tests=OF_FAILING),
    Fault("backends/opencl/api/search.c", "if («devices && !*devices»)", "true", "PoCL without a cache is absent", tests=OF_FAILING),
    Fault(GL, "glDepthFunc(«GL_LESS»);", "GL_LEQUAL", "gl: of equal depths the last stays", tests=OF_GL),
    Fault(GL, "blend == RG_BLEND_ADD ? GL_ONE : «GL_ONE_MINUS_SRC_ALPHA»", "GL_ONE_MINUS_SRC_COLOR", "gl: what is over is blended by its colour", tests=OF_GL),
    Fault(GL, "glDepthMask(«depth == RG_DEPTH_WRITE»);", "GL_TRUE", "gl: a depth that is tested is written", tests=OF_GL),
    Fault(GL, "if (memcmp(now->scissor, wanted->scissor, sizeof(now->scissor)) != 0)\n        «glScissor(wanted->scissor[0], wanted->scissor[1], wanted->scissor[2], wanted->scissor[3]);»", "glScissor(0, 0, wanted->width, wanted->height);", "gl: scissors are ignored", tests=OF_GL),
    Fault(TARGET, ".behind = rg_draw_counts(draw) ? depth : 0,\n        .layer = «draw->layer»,", "0", "gl: every layer is the first", tests=OF_GL),
    Fault("backends/gl/time.c", "«glFinish();»", "glFlush();", "gl: a sync does not wait", tests=("gl",)),
    Fault(VK, "const bool whole = «!draw->x1»;", "true", "vulkan: scissors are ignored", tests=OF_VK),
    Fault(VK, ".y = (float)-((RG_VIEWPORT_PX - «height») / 2),", "width", "vulkan: pictures that are not square are shifted", tests=OF_VK),
    Fault(VK_TIME, "*time_ns = (int64_t)((long double)vk->ticks_total * «vk->limits.timestampPeriod»);", "0.1f", "vulkan: ticks are tenths of nanoseconds", tests=("vulkan", "device suite, kernels, vulkan")),
    Fault(VK_IMAGE, ".mipLevels = «(uint32_t)desc->levels»,", "1u", "vulkan: images have one level", tests=("device suite, images, vulkan",)),
    Fault(ROUNDING, "!own && «device->info.tier != RG_T0» &&", "true", "devices that compute as C does are asked how they divide", tests=OF_ROUNDING),
    Fault(ROUNDING, "if («!device->backend->rough» || driver)", "false", "devices of exact languages are asked how they divide", tests=OF_ROUNDING),
    Fault(ROUNDING, "ok && !*is_rough && «roots < 2»", "roots < 1", "inexact roots are not noticed", tests=OF_ROUNDING),
    Fault(ROUNDING, "*is_rough = ok && «!all_are_exact(o, roots)»;", "false", "no driver rounds badly", tests=OF_ROUNDING),
    Fault(KERNEL, "return «forms[i].form»;", "forms[i].form == RG_CODE_ROUNDED_FRAGMENT_SPIRV ? RG_CODE_FRAGMENT_SPIRV : forms[i].form", "fragments are the driver's to round", tests=OF_ROUNDING),
    Fault(KERNEL, "found = «kind_of(kind, ways)»;", "kind", "modules are the driver's to round", tests=OF_ROUNDING),
    Fault("backends/gl/program.c", "rg_kernel_code(kernel, kind, «ways»,", "ways & ~RG_CODE_ROUNDS", "gl: programs are the driver's to round", tests=OF_ROUNDING),
    Fault("backends/vulkan/program.c", "rg_kernel_code(kernel, kind, «ways»,", "ways & ~RG_CODE_ROUNDS", "vulkan: programs are the driver's to round", tests=OF_ROUNDING),
    Fault(BLENDING, "bool is_exact = «device->info.tier == RG_T0»;", "false", "devices that draw as cpu:reference does are asked how they blend", tests=OF_BLENDING),
    Fault(BLENDING, "*is_exact = ok && «!memcmp(t->due, t->drawn, (size_t)TEXELS * (size_t)rg_format_size(format))»;", "true", "no driver blends otherwise", tests=OF_BLENDING),
    Fault(BLENDING, "device->blends = wanted || «(can && !is_exact)»;", "false", "drivers that blend otherwise go on blending", tests=OF_BLENDING),
    Fault(BLENDING, "if («wanted && !can»)", "false", "programs blend where the driver has no way", tests=OF_BLENDING),
    Fault(GL, ".blend = «device->pub.blends ? RG_BLEND_OFF : draw->blend»,", "draw->blend", "gl: what programs blend is blended once more", tests=OWN_GL),
    Fault("backends/gl/pass.c", "ways |= «RG_CODE_BLENDS»;", "0", "gl: what programs are to blend nobody blends", tests=OWN_GL),
    Fault("backends/vulkan/api/pipeline.c", "blend_state(«state->target.blends ? RG_BLEND_OFF : state->blend»)", "state->blend", "vulkan: what programs blend is blended once more", tests=OWN_VK),
    Fault("backends/vulkan/program.c", "(device->pub.blends ? «RG_CODE_BLENDS» : 0)", "0", "vulkan: what programs are to blend nobody blends", tests=OWN_VK),
    Fault(CL_BUF, "staged ? CL_FALSE : CL_TRUE,\n                                       «offset», size, staged", "0", "opencl: writes begin at 0", tests=OF_CL),
    Fault(CL_PASS, "return (width + group «- 1») / group * group;", "- group", "opencl: the last work group is left out", tests=OF_CL),
    Fault("backends/opencl/bins.c", "scan(bins, run) && «walk(bins, run, true)»;", "true", "opencl: a GPU's list of primitives is not filled", tests=("opencl",)),
    Fault(CL_TIME, "*time_ns = (int64_t)end_ns;", "*time_ns = (int64_t)end_ns / 1000;", "opencl: time is in microseconds", tests=OF_CL),
    Fault(GL_STATE, "enable(GL_DEPTH_CLAMP, «state->depth_clamp»);", "false", "gl: depth is never clamped", tests=OF_FIXED_GL),
    Fault(GL_STATE, "glPolygonOffset((float)state->offset_slope_16 / 16, «(float)state->offset_units»);", "4.0f", "gl: every offset is 4 units", tests=OF_FIXED_GL),
    Fault(GL_STATE, "glSampleMaski(0, «~(GLbitfield)state->samples_off»);", "~(GLbitfield)0", "gl: the sample mask is ignored", tests=OF_FIXED_GL),
    Fault(GL_TEXTURE, "GL_TEXTURE_LOD_BIAS, «(float)state->bias_16 / 16»);", "0.0f", "gl: the bias of levels is ignored", tests=OF_FIXED_GL),
    Fault(GL_TARGET, "state->blit == 1 + RG_FIXED_LINEAR ? «GL_LINEAR» : GL_NEAREST", "GL_NEAREST", "gl: a blit never filters", tests=OF_FIXED_GL),
    Fault(VK_PIPELINE, ".depthClampEnable = «s->depth_clamp»,", "VK_FALSE", "vulkan: depth is never clamped", tests=OF_FIXED_VK),
    Fault(VK_PIPELINE, ".pNext = s->provokes_last ? «&d->provoking» : NULL,", "NULL", "vulkan: the first vertex always provokes", tests=OF_FIXED_VK),
    Fault(VK_TEXTURE, ".mipLodBias = «(float)s->bias_16 / 16»,", "0.0f", "vulkan: the bias of levels is ignored", tests=OF_FIXED_VK),
    Fault(VK_RECORD, "fixed->begin_feedback(commands, 0, 0, NULL, NULL);\n    }\n    «call(job);»", ";", "vulkan: nothing is drawn", tests=OF_FIXED_VK),
    Fault("shaders/fixed/parts.c", "if («size > texel && !memcmp(part, part + texel, size - texel)»)", "true", "every picture is constant", tests=OF_FIXED_GL + OF_FIXED_VK),
    Fault("shaders/fixed/texels.c", "RG_FIXED_CONSTANT   ? «constant[i % 4]»", "(uint8_t)i", "a constant texture is not constant", tests=OF_FIXED_GL + OF_FIXED_VK),
    Fault("harness/devices/measure/serving/fixed_pairs.c", "if («told->digest != told->other»)", "false", "every closed case holds", tests=("fixed functions",)),
    Fault("shaders/fixed/texels.c", "if («state->flip && layer == 0 && level == 0»)", "false", "no bit of a texture is flipped", tests=OF_FIXED_GL + OF_FIXED_VK),
    Fault("shaders/fixed/vertices.c", "if («flip»)", "false", "no bit of a vertex is flipped", tests=OF_FIXED_GL + OF_FIXED_VK),
    Fault("harness/compare/doctor/fixed.c", "rg_exit_of_all(«counts»)", "(int[RG_OUTCOME_COUNT]){[RG_OK] = 1}", "a crash of a draw passes", tests=("command line, fixed",)),
    Fault("harness/compare/doctor/fixed.c", "rg_fixed_goes_on(device, ended, rg_fixed_pairs() «- drawn»)", "- 0", "draws that were tried are told as not tried", tests=("command line, fixed",)),
    # --- bounds of draws ---
    Fault(ROUND, "    a = rg_span_scale(«rg_span_clamp(a, 0, 1)», most);", "a", "values beyond 1 have codes", tests=OF_BOUNDS),
    Fault(ROUND, "return (struct rg_span){«floor(a.low + near_code)» / most,", "rint(a.low)", "only the nearest code is allowed", tests=OF_BOUNDS),
    Fault(COVER, "if («outline->facing && distance < -slack»)", "false", "all places near a triangle may be covered", tests=OF_BOUNDS),
    Fault(COVER, "if («distance <= slack»)", "distance <= 0", "the grid moves no edge inwards", tests=OF_BOUNDS),
    Fault(COVER, "plane < «4» && count; plane++)", "2", "nothing is clipped by distances", tests=OF_BOUNDS),
    Fault(PLANE, "const double far = reach «+ reach_of(plane, x, y)»;", "+ 0", "the grid shifts no values", tests=OF_BOUNDS),
    Fault(PLANE, "return is_inside ? «within(all, values)» : all;", "all", "values inside a triangle go beyond its corners'", tests=OF_BOUNDS),
    Fault(PLANE, "const struct rg_span m = {«fmax(slope[X].low, slope[Y].low)»,", "0", "an offset may leave the slope out", tests=OF_BOUNDS),
    Fault(TEXTURE, "texture->weight = «rg_precision_step(scene->precision->subtexel_bits)»;", "0", "weights are exact", tests=OF_BOUNDS),
    Fault(TEXTURE, "return turned < px ? turned : «2 * px - 1 - turned»;", "turned - px", "mirroring repeats in bounds", tests=OF_BOUNDS),
    Fault(TEXTURE, "    if («state->lod_most_16»)\n", "false", "no LOD is clamped in bounds", tests=OF_BOUNDS),
    Fault(TEXTURE, "rg_span_widen(lod, LOGARITHM), «rg_span_at(state->bias_16 / 16.0)»);", "rg_span_at(0)", "no LOD has a bias in bounds", tests=OF_BOUNDS),
    Fault(DECODE, "const bool has_four = «always_four || a > b»;", "a > b", "BC3 has blocks of three colours", tests=OF_BOUNDS),
    Fault(DECODE, "const int half = b[3] & 1 ? «y / 2» : x / 2;", "x / 2", "halves of ETC2 lie side by side", tests=OF_BOUNDS),
    Fault(DECODE, "    else if («beyond == 0»)\n", "false", "ETC2 has no T", tests=OF_BOUNDS),
    Fault(CUBE, "    if («in_x || in_y»)\n", "false", "texels beyond an edge are those of a corner", tests=OF_BOUNDS),
    Fault(CUBE, "place[faces[face].axis] = «faces[face].sign» *", "1", "faces meet where the cube has none", tests=OF_BOUNDS),
    Fault(MERGE, "passes == RG_COVER_YES ? now : «rg_span_join(*old, now)»;", "now", "what may be covered surely is", tests=OF_BOUNDS),
    Fault(MERGE, "operation == RG_FIXED_DECREMENT ? «(value + 255) & 255»", "value", "stencils do not wrap in bounds", tests=OF_BOUNDS),
    Fault(MERGE, "if («state->write_off >> c & 1»)", "false", "every channel is written in bounds", tests=OF_BOUNDS),
    Fault(BOUNDS, "if (!(value >= part->values[i].low && «value <= part->values[i].high»))", "true", "no value is too great", tests=OF_BOUNDS),
    Fault(BOUNDS, "    if («used != size»)", "false", "a picture of another size is read", tests=OF_BOUNDS),
    Fault(SECTIONS, "beyond->count > 0 &&\n            «beyond->count <= faults[i].most»)", "true", "a known fault explains any number of values", tests=OF_BOUNDS),
    Fault(SECTIONS, "«!strcmp(beyond->part, faults[i].part)» &&", "true", "a known fault explains a picture of another size", tests=OF_BOUNDS),
    Fault("shaders/fixed/bounds/decode.c", "code + «(i < 2 ? 0 : MIXED_ERROR * fabs(second[c] - first[c]))»;", "0", "a GPU that mixes BC1's green in fewer bits fails", tests=OF_BOUNDS),
    Fault(SECTIONS, "«strstr(device, faults[i].device)» &&", "device", "a known fault is of every driver", tests=OF_BOUNDS),
    Fault(CORNERS, "return sum * 0.125 «+ 0.25»;", "+ 0", "vertex formats are too dark in bounds", tests=OF_FIXED_GL + OF_FIXED_VK),
    Fault(SHADE, "    case RG_FIXED_FRAGMENT_FLAT:\n        «flat(f, out);»", "colour(f, out);", "flat colours are smooth in bounds", tests=OF_FIXED_GL + OF_FIXED_VK),
    Fault(SCENE, "const int from = «scissor[c]», to", "0", "scissors are ignored in bounds", tests=OF_FIXED_GL + OF_FIXED_VK),
    Fault(JUDGED, "else if («told->beyond.count && !*told->known»)", "told->beyond.count", "a known fault fails a draw", tests=("fixed functions", "features in doctor")),
    Fault(JUDGED, "left->is_within[i] = «told.is_bounded && !told.beyond.count»;", "told.is_bounded", "a known fault may differ between drivers", tests=("fixed functions in doctor",)),
    Fault("core/device/device.c", "rg_doing_begin(\"drawing feature\", «feature»);", "\"\"", "a crash does not name its feature", tests=("command line, fixed",)),
]
