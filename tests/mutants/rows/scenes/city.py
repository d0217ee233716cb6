"""The city: its surfaces, faces, chunks, lamps and the visible share of the sky."""
from fault import Fault

TESTS = ("city", "surfaces of the city", "openness", "dioramas", "city, depth, cpu", "city, look, cpu", "city, around, cpu", "streaks lights, reach, cpu")

BUILD, CHUNKS, OPEN = "core/scene/city/build.c", "core/scene/city/chunks.c", "core/scene/city/openness.c"
AROUND = "core/techniques/scenery/environment.c"

ROWS = [
    Fault(BUILD, "is_level(n) ? 1 / tile_m : «-1 / tile_m», 0, 0", "1 / tile_m", "textures of walls stand on their head"),
    Fault(BUILD, "const double at = «-stepped * from»;", "stepped * from", "textures begin on the other side"),
    Fault(BUILD, "return kind == SCENERY_KIND_ASPHALT ? «3» : kind", "0", "roads stay dry"),
    Fault(BUILD, "(r * 31 + 127) / 255 | «(g * 63 + 127) / 255 << 5» |", "(g * 31 + 127) / 255 << 5", "tints have half their green"),
    Fault(BUILD, "f->triangle_count += «memcmp(to + 6, to + 9, 3 * sizeof(float)) ? 2 : 1»;", "2", "triangles count as two"),
    Fault(BUILD, "{u.y * v.z - u.z * v.y, «u.z * v.x - u.x * v.z», u.x * v.y - u.y * v.x}", "u.x * v.z - u.z * v.x", "normals point down"),
    Fault(BUILD, "z «- radius * sin(angle)»};", "+ radius * sin(angle)", "posts are inside out"),
    Fault(BUILD, "if (sides >> i & 1)\n            «city_quad(b, c[k[0]], c[k[1]], c[k[2]], c[k[3]], look);»", "city_quad(b, c[k[3]], c[k[2]], c[k[1]], c[k[0]], look);", "boxes are inside out"),
    Fault(BUILD, "put_corner(lamp->direction, «direction»);", "at", "lamps shine away from the city's middle"),
    Fault(CHUNKS, "if (!chunk || chunk->count == CITY_CHUNK_FACES ||\n            «cell_and_way != keys[i - 1].order >> PLACE_BITS»)", "false", "chunks leave their cell"),
    Fault(CHUNKS, "const bool alike = «cell_and_way % 8 < 6»;", "true", "every chunk looks one way"),
    Fault(CHUNKS, "low[i % 3] = «rg_min(low[i % 3], c[i])»;", "c[i]", "a chunk begins at its last corner"),
    Fault(CHUNKS, "i < 6 && «scenery_kind(look) != SCENERY_KIND_LEAVES»; i++)", "true", "leaves are left out by their normal"),
    Fault(CHUNKS, "surface_of[i] = f->surface_of[«keys[i].face»];", "i", "faces lose their surfaces when they are sorted"),
    Fault(OPEN, "if (at[0] >= b->low[0] && «at[0] <= b->high[0]» &&", "true", "houses hide the sky up to the city's end"),
    Fault(OPEN, "steepest[level] / sqrtf(1 + «steepest[level] * steepest[level]»);", "steepest[level]", "a wall hides less of the sky"),
    Fault(OPEN, "const float over = 1 / (SCENERY_OPEN_CELL_M «* (float)step»);", "* 1", "what is far hides as much as what is near"),
    Fault(OPEN, "(uint32_t)points[i + below] << «16» |", "8", "a cell's corners are mixed up"),
    Fault(AROUND, "(size_t)(«size - 1 - x»)", "x", "the city's environment is mirrored"),
    Fault(AROUND, "{0, 1, 0}, {0, 1, 0}, {0, 0, «-1»}", "1", "the sky of the city's environment is turned"),
    Fault(AROUND, "{0, 0, 1},  {0, 0, «-1»}};\n    const float up", "1", "the city's environment shows the same before and behind"),
    Fault(AROUND, "around->levels, «around->blur_rad», path", "0.0", "instances share an environment that another lens blurs"),
]
