"""The checked device and the CPU's backend: refusals, folding, counting, packing, scans, drawing."""
from fault import Fault

TESTS = ("device counting", "device suite, kernels, cpu", "device suite, kernels, cpu_reference", "device suite, images, cpu",
         "device suite, draws, cpu", "device suite, targets, cpu", "drawing, cpu", "stages",
         "device suite, kernels, vulkan", "device suite, draws, vulkan", "device suite, targets, vulkan",
         "command line, renders", "memory", "room")

GRID, PACKING, SCAN, SHARED = "core/device/grid.c", "core/device/packing.c", "core/device/scan.c", "core/device/shared.c"
TARGETS, DEVICE, LIMITS, WORK = "core/device/targets.c", "core/device/device.c", "core/device/limits.c", "core/device/work.c"
MEMORY, TECHNIQUE = "core/base/memory.c", "core/techniques/technique.c"
OBJECTS, PASS, IMAGE, DRAW = "core/device/objects.c", "backends/cpu/pass.c", "backends/cpu/image.c", "backends/cpu/draw.c"
SHADE = "backends/cpu/draw/shade_tmpl.h"

ROWS = [
    Fault(GRID, "require(count > 0 && «origin >= 0» && origin + count", "true", "items may begin below 0"),
    Fault(GRID, "part.origin.height = «run->origin.height + done.height»;", "done.height", "folded rows forget where they begin"),
    Fault(GRID, "part.extent.width = smaller(max_width, «run->extent.width - done.width»);", "run->extent.width", "the last folded part is too wide"),
    Fault(GRID, "work->items += (int64_t)run->extent.width * run->extent.height «* run->extent.depth»;", "* 1", "layers of items are not counted"),
    Fault(GRID, "require(i == j || «!same» || !rg_slot_is_written", "true", "a buffer may be written and read in one run"),
    Fault(GRID, "require(«bound->buf->device == pass->device»,", "true", "another device's buffer is taken"),
    Fault(OBJECTS, "device->work->live_bytes «-= image_bytes(&image->desc)»;", "-= 0", "memory of images that are gone counts"),
    Fault(OBJECTS, "image->device->work->bytes_read += «level_bytes(image, level)»;", "level_bytes(image, 0)", "each level is as large as the first"),
    Fault(OBJECTS, "return «!device->info.software» || rg_memory_take(bytes);", "true", "what devices on the CPU take is not counted"),
    Fault(OBJECTS, "give(device, «(int64_t)buf->size»);", "0", "a buffer that is gone gives nothing back"),
    Fault(OBJECTS, "give(device, «image_bytes(&image->desc)»);", "0", "an image that is gone gives nothing back"),
    Fault(OBJECTS, "work->most_bytes = «work->most_bytes > work->live_bytes» ?", "false", "what lives now is taken for the most that lived"),
    Fault(MEMORY, "return bytes «- bytes / 10»;", "- 0", "no margin is left of what is free"),
    Fault(MEMORY, "end != text && «!*end» && bytes > 0", "true", "a limit of 1e9 bytes is one of 1"),
    Fault(MEMORY, "memory.taken_bytes «+= bytes»;", "+= 0", "what is taken is not counted"),
    Fault(MEMORY, "«memory.is_chosen» ? 0 : less_a_tenth", "false", "the user cannot allow more than is free"),
    Fault(MEMORY, "setenv(variable, text, «1»);", "0", "other processes learn the first limit alone"),
    Fault(OBJECTS, "«work->live_bytes - work->before_bytes + bytes > work->watch_bytes»)", "false", "what is large is taken before it is counted"),
    Fault(TECHNIQUE, "return «rg_memory_allows(bytes)» ||", "true", "what was counted is opened, however much it is"),
    Fault(LIMITS, "«groups[1] > 0» &&", "true", "a device may have no work groups"),
    Fault(LIMITS, "return «size <= most» ||\n           rg_unsupported(\"buffer", "true", "a buffer may be of any size"),
    Fault(LIMITS, "if (desc->width > most->max_px || «desc->height > most->max_px» ||", "false", "an image may be of any height"),
    Fault(LIMITS, "if («++*member_of(count, slot->kind) > allowed»)", "false", "a kernel may have any number of slots"),
    Fault(DEVICE, "return index >= 0 && «index < count» ? (int)index : -1;", "true", "a device behind the last may be asked for"),
    Fault(DEVICE, "return «a->tier > b->tier ? a->tier : b->tier»;", "a->tier", "the first of two devices says what tier is owed"),
    Fault(DEVICE, "!w->live_buffers && «!w->live_images» && !w->live_passes;", "true", "images may be left behind"),
    Fault(SHARED, "while (entry && («entry->kind != kind» || strcmp", "false", "things of other kinds are shared"),
    Fault(SHARED, "entry->holders++;", "entry->holders = 1;", "a thing goes with its first holder"),
    Fault(SCAN, "return count > RG_SCAN_CHUNK ? «(count - 1) / RG_SCAN_CHUNK + 1» : 1;", "count / RG_SCAN_CHUNK", "the last chunk of a scan is left out"),
    Fault(SCAN, "level == top ? scan->nothing : «scan->before[level + 1]», scan->before[level],", "scan->nothing", "chunks of a scan begin at 0"),
    Fault(SCAN, "check_words(sums, (int64_t)count «+ 1») &&", "+ 0", "a scan's total may lie behind its buffer"),
    Fault(PACKING, "const int chunks = (batch + RG_DRAW_CHUNK «- 1») / RG_DRAW_CHUNK;", "- RG_DRAW_CHUNK", "the last chunk of a draw is left out"),
    Fault(PACKING, "const packing_params params = {chunks, chunks_a_query, «corners == 3 ? 3 : 6»};", "3", "queries of quads count triangles", tests=("device suite, draws, vulkan",)),
    Fault(PACKING, "args.first_query = «state->item_begin / whole»;", "0", "answers of queries begin at 0"),
    Fault(PACKING, "if (whole && batch < items)\n        batch = «batch / whole * whole»;", "batch", "a query is cut by a batch", lives="no test draws with queries more items than one batch of 128 MiB holds"),
    Fault(TARGETS, "*width = rg_level_size(image->desc.width, «draw->level»);", "0", "a level is as wide as the image"),
    Fault(TARGETS, "draw->x1 <= width && «draw->y1 <= height»),", "true", "a scissor may leave the target"),
    Fault(TARGETS, "«items % RG_DRAW_CHUNK == 0» && run->origin.width % items == 0,", "true", "queries may begin anywhere"),
    Fault(TARGETS, "return a_query ? (items + a_query «- 1») / a_query : items;", "- a_query", "the last query has no counter"),
    Fault(WORK, "counts->records += «head.item != *last_item»;", "1", "primitives count as records"),
    Fault(WORK, "tally->light_evaluations += counts.fragments «* lights_of(pass->kernel, run)»;", "* 1", "lights are not counted"),
    Fault(PASS, "mine.begin.z = «call->begin.z + part(extent->depth, index, blocks)»;", "call->begin.z", "threads run layers of others",
          lives="an item that is run twice leaves what it left before, but for atomic sums, which no test makes over layers"),
    Fault(PASS, "mine.end.x = call->begin.x + «part(extent->width, index + 1, blocks)»;", "part(extent->width, index + 1, blocks) - (index + 1 == blocks)", "a run's last item is left out"),
    Fault(PASS, "if («notes.slot»)\n        return rg_driver_error", "false", "cpu:reference does not tell of a place out of range"),
    Fault(IMAGE, "memcpy(first + at, pattern, «total - at < step ? total - at : step»);", "total - at < step ? 0 : step", "clearing leaves out the last texels"),
    Fault(DRAW, "cpu_emit(&mine, i, d->end - begin > size ? «begin + size» : d->end);", "begin + size - 1", "a chunk's last item is not drawn"),
    Fault(SHADE, "memset(&s->pixels, 0, «sizeof(s->pixels)»);", "0 * sizeof(s->pixels)", "vectors reach for texels that nobody has set", tests=("values, raster",)),
    Fault(DRAW, "for (int i = draw->item_begin; i < draw->item_end; i += «CPU_BATCH»)", "CPU_BATCH + 1", "counting leaves out items"),
    Fault(DRAW, "counts->records += «items.fate[i] != RG_FATE_DEAD»;", "1", "items that are not seen count as records"),
]
