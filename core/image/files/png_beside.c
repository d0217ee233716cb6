#include "core/image/files/png_beside.h"

#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

#include "core/image/extras.h"

// In the order of enum rg_png_chunk.
static const char names[RG_PNG_CHUNKS][5] = {"gAMA", "cHRM", "sRGB", "iCCP",
                                             "cICP", "pHYs", "oFFs", "eXIf"};

// --- reading chunks ---

// Digests a frame's bytes without its sequence number, with which both kinds of frame chunks begin.
static bool digest_frame(struct rg_png_beside *beside, const png_unknown_chunk *chunk)
{
    const bool is_head = !memcmp(chunk->name, "fcTL", 5);
    if (!is_head && memcmp(chunk->name, "fdAT", 5) != 0)
        return false;
    if (!beside->animation && (beside->animation = XXH3_createState()))
        XXH3_64bits_reset(beside->animation);
    beside->frames += is_head;
    if (beside->animation && chunk->size > 4)
        XXH3_64bits_update(beside->animation, chunk->data + 4, chunk->size - 4);
    return true;
}

// A profile is a name, a zero, a byte for the compression, and a zlib stream. A stream that cannot
// be inflated is digested as it is.
static void digest_profile(struct rg_png_beside *beside, const png_unknown_chunk *chunk)
{
    enum { MOST_BYTES = 16 << 20 };
    const uint8_t *name_end = memchr(chunk->data, 0, chunk->size);
    const size_t head = name_end ? (size_t)(name_end - chunk->data) + 2 : chunk->size;
    struct libdeflate_decompressor *inflater = libdeflate_alloc_decompressor();
    uint8_t *profile = head < chunk->size ? malloc(MOST_BYTES) : NULL;
    size_t bytes = 0;
    const bool is_whole =
        inflater && profile &&
        libdeflate_zlib_decompress(inflater, chunk->data + head, chunk->size - head, profile,
                                   MOST_BYTES, &bytes) == LIBDEFLATE_SUCCESS;
    beside->profile_bytes = (uint32_t)(is_whole ? bytes : chunk->size);
    beside->profile =
        is_whole ? XXH3_64bits(profile, bytes) : XXH3_64bits(chunk->data, chunk->size);
    free(profile);
    libdeflate_free_decompressor(inflater);
}

static int take_chunk(png_structp png, png_unknown_chunkp chunk)
{
    struct rg_png_beside *beside = png_get_user_chunk_ptr(png);
    const bool is_said = chunk->size > 0 && !(chunk->location & PNG_AFTER_IDAT);
    for (int i = 0; i < RG_PNG_CHUNKS; i++)
        if (!memcmp(chunk->name, names[i], 5) && !beside->chunks[i].is_there && is_said) {
            const size_t most = sizeof(beside->chunks[i].bytes);
            beside->chunks[i].is_there = true;
            beside->chunks[i].size = (uint32_t)chunk->size;
            memcpy(beside->chunks[i].bytes, chunk->data, chunk->size < most ? chunk->size : most);
            if (i == RG_PNG_ICCP)
                digest_profile(beside, chunk);
        }
    digest_frame(beside, chunk);
    return 1;
}

void rg_png_beside_collect(struct rg_png_beside *beside, png_structp png)
{
    png_set_read_user_chunk_fn(png, beside, take_chunk);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_ALWAYS, (png_const_bytep)names,
                                RG_PNG_CHUNKS);
    // Damaged chunks are dropped, because their content is unknown.
    png_set_crc_action(png, PNG_CRC_DEFAULT, PNG_CRC_ERROR_QUIT);
}

// --- interpreting chunks ---

static uint32_t big_endian(const uint8_t *c)
{
    return (uint32_t)c[0] << 24 | (uint32_t)c[1] << 16 | (uint32_t)c[2] << 8 | c[3];
}

static bool has(const struct rg_png_beside *beside, enum rg_png_chunk chunk, uint32_t size)
{
    return beside->chunks[chunk].is_there && beside->chunks[chunk].size == size;
}

// Code points of ITU-T H.273; powers and sRGB's curve are supported. False for others.
static bool take_cicp(const uint8_t *c, struct rg_picture *picture)
{
    enum { REC709 = 1, GAMMA_22 = 4, GAMMA_28 = 5, LINEAR = 8, SRGB = 13 };
    const double power = c[1] == GAMMA_22 ? 2.2 : c[1] == GAMMA_28 ? 2.8 : c[1] == LINEAR ? 1 : 0;
    const bool is = (c[1] == SRGB || power > 0) && c[0] == REC709 && c[2] == 0 && c[3] == 1;
    picture->gamma = is ? power : 0;
    return is;
}

// The standard tells writers of sRGB to give readers without sRGB 1/2.2, and many programs write
// this instead of sRGB. So 1/2.2, however rounded, means sRGB.
static bool tell_gamma(uint32_t gamma, struct rg_picture *picture)
{
    if (gamma == 0)
        return rg_extras_add(&picture->extras, false, "curve (gAMA)", "0");
    picture->gamma = gamma == 45454 || gamma == 45455 ? 0 : 100000.0 / gamma;
    return true;
}

static bool tell_profile(const struct rg_png_beside *beside, struct rg_picture *picture)
{
    return rg_extras_add(&picture->extras, false, "ICC profile", "%u bytes, XXH3 %016llx",
                         beside->profile_bytes, (unsigned long long)beside->profile);
}

// Whether white, red, green and blue are those of Rec. 709, within the rounding of programs.
static bool tell_primaries(const uint8_t *bytes, struct rg_picture *picture)
{
    static const int srgb[8] = {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000};
    int32_t p[8];
    bool is_srgb = true;
    for (int i = 0; i < 8; i++) {
        p[i] = (int32_t)big_endian(bytes + 4 * i);
        is_srgb = is_srgb && p[i] >= srgb[i] - 100 && p[i] <= srgb[i] + 100;
    }
    return is_srgb ||
           rg_extras_add(&picture->extras, false, "primaries",
                         "white %g %g, red %g %g, green %g %g, blue %g %g", p[0] / 1e5, p[1] / 1e5,
                         p[2] / 1e5, p[3] / 1e5, p[4] / 1e5, p[5] / 1e5, p[6] / 1e5, p[7] / 1e5);
}

// If several chunks describe the colours, the first that a reader can apply counts, by the
// standard.
static bool tell_colours(const struct rg_png_beside *beside, struct rg_picture *picture)
{
    const uint8_t *cicp = beside->chunks[RG_PNG_CICP].bytes;
    if (has(beside, RG_PNG_CICP, 4) && take_cicp(cicp, picture))
        return true;
    if (beside->chunks[RG_PNG_CICP].is_there &&
        !rg_extras_add(&picture->extras, false, "colours (cICP)",
                       "primaries %d, curve %d, matrix %d, full range %d", cicp[0], cicp[1],
                       cicp[2], cicp[3]))
        return false;
    if (beside->chunks[RG_PNG_ICCP].is_there && !tell_profile(beside, picture))
        return false;
    if (beside->chunks[RG_PNG_SRGB].is_there)
        return true;
    return (!has(beside, RG_PNG_GAMA, 4) ||
            tell_gamma(big_endian(beside->chunks[RG_PNG_GAMA].bytes), picture)) &&
           (!has(beside, RG_PNG_CHRM, 32) ||
            tell_primaries(beside->chunks[RG_PNG_CHRM].bytes, picture));
}

// Exif's orientation, from the first directory of the TIFF structure that eXIf holds; 1: upright.
static int orientation(const uint8_t *bytes, uint32_t size)
{
    enum { TAG = 0x0112, ENTRY = 12 };
    const bool is_big = size > 8 && bytes[0] == 'M';
#define SHORT(at) (is_big ? bytes[at] << 8 | bytes[(at) + 1] : bytes[(at) + 1] << 8 | bytes[at])
    const uint32_t low = size > 8 ? (uint32_t)SHORT(is_big ? 6 : 4) : 0;
    const uint32_t high = size > 8 ? (uint32_t)SHORT(is_big ? 4 : 6) : 1;
    if (high || low + 2 > size)
        return 1;
    const int count = SHORT(low);
    for (int i = 0; i < count && low + 2 + ENTRY * (uint32_t)(i + 1) <= size; i++)
        if (SHORT(low + 2 + ENTRY * (uint32_t)i) == TAG)
            return SHORT(low + 2 + ENTRY * (uint32_t)i + 8);
#undef SHORT
    return 1;
}

static bool tell_place(const struct rg_png_beside *beside, struct rg_picture *picture)
{
    const uint8_t *density = beside->chunks[RG_PNG_PHYS].bytes;
    const uint8_t *offset = beside->chunks[RG_PNG_OFFS].bytes;
    const uint32_t exif = beside->chunks[RG_PNG_EXIF].size;
    const uint32_t across = big_endian(density), down = big_endian(density + 4);
    const uint32_t most = sizeof(beside->chunks[0].bytes);
    const int turned = orientation(beside->chunks[RG_PNG_EXIF].bytes, exif < most ? exif : most);
    return (!has(beside, RG_PNG_PHYS, 9) || across == down ||
            rg_extras_add(&picture->extras, true, "pixel aspect ratio", "%.9g",
                          (double)((float)down / (float)across))) &&
           (!has(beside, RG_PNG_OFFS, 9) || !(big_endian(offset) || big_endian(offset + 4)) ||
            rg_extras_add(&picture->extras, true, "offset", "%d, %d %s", (int)big_endian(offset),
                          (int)big_endian(offset + 4), offset[8] ? "micrometres" : "pixels")) &&
           (turned == 1 ||
            rg_extras_add(&picture->extras, true, "orientation (eXIf)", "%d", turned));
}

bool rg_png_beside_tell(const struct rg_png_beside *beside, struct rg_picture *picture)
{
    if (!tell_colours(beside, picture) || !tell_place(beside, picture))
        return false;
    return !beside->frames ||
           (beside->animation &&
            rg_extras_add(&picture->extras, true, "animation", "%d frames, XXH3 %016llx",
                          beside->frames,
                          (unsigned long long)XXH3_64bits_digest(beside->animation)));
}

void rg_png_beside_release(struct rg_png_beside *beside)
{
    XXH3_freeState(beside->animation);
}
