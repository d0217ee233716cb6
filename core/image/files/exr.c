#include <errno.h>
#include <openexr.h>
#include <stdio.h>
#include <string.h>

#include "core/image/files/exr_unpack.h"
#include "core/image/files/format.h"
#include "core/image/reader/reply.h"

// Initializers of newer OpenEXR name the first field alone.
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"

// State of reading one file, for OpenEXRCore's callbacks and the loop over chunks.
struct exr_job {
    exr_context_t exr;
    struct rg_picture *picture;
    exr_attr_box2i_t window;
    const char *names[4]; // names of the file's channels, in the picture's order
    bool tiled;
    int chunk_width, chunk_height; // pixels
    int across, down;              // chunks
    struct rg_why *why;
};

static void on_error(exr_const_context_t exr, exr_result_t code, const char *message)
{
    (void)exr;
    (void)code;
    (void)message;
}

// One sentence for a failed call, because the library's own messages name files and come several at
// a time.
static bool failed(struct rg_why *why, const char *step, exr_result_t code)
{
    return rg_why_system(why, code == EXR_ERR_OUT_OF_MEMORY ? ENOMEM : EINVAL,
                         "EXR %s: %s; write it again", step, exr_get_default_error_message(code));
}

static exr_context_initializer_t initializer(void)
{
    exr_context_initializer_t with = EXR_DEFAULT_CONTEXT_INITIALIZER;
    with.error_handler_fn = on_error;
    with.max_image_width = RG_PICTURE_MAX_SIDE_PX;
    with.max_image_height = RG_PICTURE_MAX_SIDE_PX;
    // Level 2 takes a third of the default's time and makes a twentieth more bytes.
    with.zip_level = 2;
    return with;
}

// Fills job->names with the channels to read and returns their number: R, G, B and A, or Y and A,
// or V and A. 0, with `why` set: none of these.
static int choose_channels(struct exr_job *job, const exr_attr_chlist_t *list)
{
    static const char *const sets[][5] = {{"R", "G", "B", "A"}, {"Y", "A"}, {"V", "A"}};
    for (size_t s = 0; s < sizeof(sets) / sizeof(sets[0]); s++) {
        int found = 0, needed = s ? 1 : 3;
        for (int wanted = 0; sets[s][wanted]; wanted++)
            for (int c = 0; c < list->num_channels; c++)
                if (!strcmp(list->entries[c].name.str, sets[s][wanted]) && found == wanted)
                    job->names[found++] = sets[s][wanted];
        if (found >= needed)
            return found;
    }
    return rg_why_set(job->why,
                      "has no channels R, G and B, nor Y; its first of %d is \"%s\"; "
                      "rename them",
                      list->num_channels, list->num_channels ? list->entries[0].name.str : "");
}

// Finds how the part is cut into chunks; false with `why` set.
static bool find_chunks(struct exr_job *job, int64_t width, int64_t height)
{
    exr_storage_t storage;
    exr_get_storage(job->exr, 0, &storage);
    job->tiled = storage == EXR_STORAGE_TILED;
    if (job->tiled) {
        uint32_t tile_width, tile_height;
        exr_tile_level_mode_t levels;
        exr_tile_round_mode_t round;
        exr_get_tile_descriptor(job->exr, 0, &tile_width, &tile_height, &levels, &round);
        job->chunk_width = (int)tile_width;
        job->chunk_height = (int)tile_height;
    } else {
        job->chunk_width = (int)width;
        exr_get_scanlines_per_chunk(job->exr, 0, &job->chunk_height);
    }
    if (job->chunk_width < 1 || job->chunk_height < 1)
        return rg_why_set(job->why, "EXR header: tiles without a size; write it again");
    job->across = (int)((width + job->chunk_width - 1) / job->chunk_width);
    job->down = (int)((height + job->chunk_height - 1) / job->chunk_height);
    return true;
}

// Refuses, by its name, anything in any part that no reader here can read.
static bool is_readable(const struct exr_job *job, int part)
{
    const exr_attr_chlist_t *list;
    exr_storage_t storage;
    uint32_t width, height;
    exr_tile_level_mode_t levels = EXR_TILE_ONE_LEVEL;
    exr_tile_round_mode_t round;
    if (exr_get_storage(job->exr, part, &storage) || exr_get_channels(job->exr, part, &list))
        return rg_why_set(job->why, "EXR header: the channels are missing");
    if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
        return rg_why_set(job->why, "holds deep data; flatten it");
    bool has_luminance = false, has_chroma = false;
    for (int c = 0; c < list->num_channels; c++) {
        const exr_attr_chlist_entry_t *entry = &list->entries[c];
        has_luminance = has_luminance || !strcmp(entry->name.str, "Y");
        has_chroma = has_chroma || !strcmp(entry->name.str, "RY") || !strcmp(entry->name.str, "BY");
    }
    exr_get_tile_descriptor(job->exr, part, &width, &height, &levels, &round);
    if (levels == EXR_TILE_RIPMAP_LEVELS)
        return rg_why_set(job->why, "holds a ripmap; write it with one level");
    if (has_luminance && has_chroma)
        return rg_why_set(job->why, "holds luminance and chroma (Y, RY, BY); write it as R, G, B");
    for (int c = 0; c < list->num_channels; c++)
        if (list->entries[c].x_sampling != 1 || list->entries[c].y_sampling != 1)
            return rg_why_set(job->why, "channel %.60s is subsampled; write it at full resolution",
                              list->entries[c].name.str);
    return true;
}

static bool is_rec709(const exr_attr_chromaticities_t *c)
{
    return c->red_x == 0.64f && c->red_y == 0.33f && c->green_x == 0.3f && c->green_y == 0.6f &&
           c->blue_x == 0.15f && c->blue_y == 0.06f && c->white_x == 0.3127f &&
           c->white_y == 0.329f;
}

// Whether the file has only the picture, in a compression that the library (3.1.5) decodes
// correctly. Its routine for B44 is wrong for floats, and it has none for DWAA and DWAB.
static bool is_plain(const struct exr_job *job, const exr_attr_chlist_t *list, int channels)
{
    exr_attr_box2i_t display;
    exr_compression_t compression;
    uint32_t tile_width, tile_height;
    exr_tile_level_mode_t levels = EXR_TILE_ONE_LEVEL;
    exr_tile_round_mode_t round;
    const exr_attribute_t *colours;
    float aspect = 1;
    int parts = 0;
    exr_get_count(job->exr, &parts);
    exr_get_display_window(job->exr, 0, &display);
    exr_get_compression(job->exr, 0, &compression);
    exr_get_pixel_aspect_ratio(job->exr, 0, &aspect);
    exr_get_tile_descriptor(job->exr, 0, &tile_width, &tile_height, &levels, &round);
    bool is = parts == 1 && list->num_channels == channels && compression < EXR_COMPRESSION_B44 &&
              !display.min.x && !display.min.y && aspect == 1 && levels == EXR_TILE_ONE_LEVEL &&
              !memcmp(&display, &job->window, sizeof(display));
    for (int c = 0; is && c < list->num_channels; c++)
        is = list->entries[c].pixel_type != EXR_PIXEL_UINT;
    return is && (exr_get_attribute_by_name(job->exr, 0, "ICCProfile", &colours)) &&
           (exr_get_attribute_by_name(job->exr, 0, "chromaticities", &colours) ||
            (colours->type == EXR_ATTR_CHROMATICITIES && is_rec709(colours->chromaticities)));
}

// The reader that takes the texels.
enum reader { NOBODY, THIS, OPENIMAGEIO };

static enum reader choose_reader(struct exr_job *job, int *channels)
{
    const exr_attr_chlist_t *list;
    int parts = 0;
    exr_get_count(job->exr, &parts);
    for (int part = 0; part < parts; part++)
        if (!is_readable(job, part))
            return NOBODY;
    if (exr_get_data_window(job->exr, 0, &job->window) || exr_get_channels(job->exr, 0, &list)) {
        rg_why_set(job->why, "EXR header: the window or the channels are missing");
        return NOBODY;
    }
    *channels = choose_channels(job, list);
    return !*channels ? NOBODY : is_plain(job, list, *channels) ? THIS : OPENIMAGEIO;
}

static bool prepare(struct exr_job *job, int64_t file_bytes, int channels)
{
    int64_t width = (int64_t)job->window.max.x - job->window.min.x + 1;
    int64_t height = (int64_t)job->window.max.y - job->window.min.y + 1;
    if (!find_chunks(job, width, height))
        return false;
    // Every chunk has an entry of 8 bytes in the chunk table, and a header of 8 at least.
    if ((int64_t)job->across * job->down * 16 > file_bytes)
        return rg_why_set(job->why,
                          "promises %d chunks of pixels, more than its %lld bytes can "
                          "hold; it is cut short: write it again",
                          job->across * job->down, (long long)file_bytes);
    return rg_why_allocate(job->picture, width, height, channels, job->why);
}

// Gives the pipeline the destination of each channel of the chunk whose corner is x, y.
static void aim(const struct exr_job *job, exr_decode_pipeline_t *decode, int64_t x, int64_t y)
{
    const struct rg_picture *picture = job->picture;
    for (int c = 0; c < decode->channel_count; c++) {
        exr_coding_channel_info_t *channel = &decode->channels[c];
        channel->decode_to_ptr = NULL;
        for (int wanted = 0; wanted < picture->channels; wanted++)
            if (!strcmp(channel->channel_name, job->names[wanted]))
                channel->decode_to_ptr =
                    (uint8_t *)(picture->texels + (y * picture->width + x) * picture->channels +
                                wanted);
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = 4;
        channel->user_pixel_stride = picture->channels * 4;
        channel->user_line_stride = picture->width * picture->channels * 4;
    }
}

static exr_result_t read_chunk(const struct exr_job *job, exr_decode_pipeline_t *decode,
                               struct rg_exr_unpacker *unpacker, int chunk, bool *started)
{
    int column = chunk % job->across, row = chunk / job->across;
    int64_t x = (int64_t)column * job->chunk_width, y = (int64_t)row * job->chunk_height;
    exr_chunk_info_t info;
    exr_result_t code =
        job->tiled ? exr_read_tile_chunk_info(job->exr, 0, column, row, 0, 0, &info)
                   : exr_read_scanline_chunk_info(job->exr, 0, (int)(job->window.min.y + y), &info);
    if (code != EXR_ERR_SUCCESS)
        return code;
    bool first = !*started;
    code = first ? exr_decoding_initialize(job->exr, 0, &info, decode)
                 : exr_decoding_update(job->exr, 0, &info, decode);
    if (code != EXR_ERR_SUCCESS)
        return code;
    *started = true;
    aim(job, decode, x, y);
    if (first) {
        code = exr_decoding_choose_default_routines(job->exr, 0, decode);
        rg_exr_take_over(unpacker, decode);
    }
    return code != EXR_ERR_SUCCESS ? code : exr_decoding_run(job->exr, 0, decode);
}

static bool read_chunks(struct exr_job *job)
{
    int chunks = job->across * job->down;
    exr_result_t worst = EXR_ERR_SUCCESS;
#pragma omp parallel
    {
        exr_decode_pipeline_t decode = EXR_DECODE_PIPELINE_INITIALIZER;
        struct rg_exr_unpacker unpacker = {0};
        bool started = false;
        exr_result_t code = EXR_ERR_SUCCESS;
#pragma omp for schedule(dynamic)
        for (int chunk = 0; chunk < chunks; chunk++)
            if (code == EXR_ERR_SUCCESS)
                code = read_chunk(job, &decode, &unpacker, chunk, &started);
        if (started)
            exr_decoding_destroy(job->exr, &decode);
        rg_exr_unpacker_release(&unpacker);
#pragma omp critical
        worst = code != EXR_ERR_SUCCESS ? code : worst;
    }
    return worst == EXR_ERR_SUCCESS || failed(job->why, "pixels", worst);
}

bool rg_exr_read(const char *path, int64_t file_bytes, struct rg_picture *picture,
                 struct rg_why *why)
{
    struct exr_job job = {.picture = picture, .why = why};
    exr_context_initializer_t with = initializer();
    exr_result_t code = exr_start_read(&job.exr, path, &with);
    if (code != EXR_ERR_SUCCESS)
        return failed(why, "header", code);
    int channels = 0;
    const enum reader reader = choose_reader(&job, &channels);
    bool good = reader == THIS && prepare(&job, file_bytes, channels) && read_chunks(&job);
    exr_finish(&job.exr);
    if (reader == OPENIMAGEIO)
        good = rg_oiio_read(path,
                            file_bytes < RG_PICTURE_EXR_BYTES ? RG_PICTURE_EXR_BYTES : file_bytes,
                            picture, why);
    picture->is_associated = good && picture->channels > rg_picture_colours(picture);
    if (!good)
        rg_picture_destroy(picture);
    return good;
}

static exr_result_t write_header(exr_context_t exr, const struct rg_picture *picture,
                                 bool full_float)
{
    static const char *const names[][4] = {
        {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
    int part;
    exr_result_t code = exr_add_part(exr, NULL, EXR_STORAGE_SCANLINE, &part);
    if (code == EXR_ERR_SUCCESS)
        code = exr_initialize_required_attr_simple(exr, part, picture->width, picture->height,
                                                   EXR_COMPRESSION_ZIP);
    for (int c = 0; code == EXR_ERR_SUCCESS && c < picture->channels; c++)
        code = exr_add_channel(exr, part, names[picture->channels - 1][c],
                               full_float ? EXR_PIXEL_FLOAT : EXR_PIXEL_HALF,
                               EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    return code != EXR_ERR_SUCCESS ? code : exr_write_header(exr);
}

static exr_result_t write_chunk(exr_context_t exr, const struct rg_picture *picture, int y,
                                exr_encode_pipeline_t *encode)
{
    exr_chunk_info_t info;
    exr_result_t code = exr_write_scanline_chunk_info(exr, 0, y, &info);
    if (code == EXR_ERR_SUCCESS)
        code = y == 0 ? exr_encoding_initialize(exr, 0, &info, encode)
                      : exr_encoding_update(exr, 0, &info, encode);
    if (code != EXR_ERR_SUCCESS)
        return code;
    for (int c = 0; c < encode->channel_count; c++) {
        exr_coding_channel_info_t *channel = &encode->channels[c];
        static const char order[] = "RGBA";
        const char *at = strchr(order, channel->channel_name[0]);
        int source = picture->channels > 2 ? (int)(at - order) : channel->channel_name[0] == 'A';
        channel->encode_from_ptr =
            (const uint8_t *)(picture->texels + (int64_t)y * picture->width * picture->channels +
                              source);
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = 4;
        channel->user_pixel_stride = picture->channels * 4;
        channel->user_line_stride = picture->width * picture->channels * 4;
    }
    if (y == 0)
        code = exr_encoding_choose_default_routines(exr, 0, encode);
    return code != EXR_ERR_SUCCESS ? code : exr_encoding_run(exr, 0, encode);
}

bool rg_exr_write(const char *path, const struct rg_picture *picture,
                  const struct rg_write_options *options, struct rg_why *why)
{
    exr_context_t exr;
    exr_context_initializer_t with = initializer();
    exr_result_t code = exr_start_write(&exr, path, EXR_WRITE_FILE_DIRECTLY, &with);
    if (code != EXR_ERR_SUCCESS)
        return rg_why_system(why, code == EXR_ERR_OUT_OF_MEMORY ? ENOMEM : errno,
                             "cannot be written: %s", exr_get_default_error_message(code));
    code = write_header(exr, picture, options->full_float);
    int lines = 1;
    if (code == EXR_ERR_SUCCESS)
        code = exr_get_scanlines_per_chunk(exr, 0, &lines);
    exr_encode_pipeline_t encode = EXR_ENCODE_PIPELINE_INITIALIZER;
    bool started = code == EXR_ERR_SUCCESS;
    for (int y = 0; code == EXR_ERR_SUCCESS && y < picture->height; y += lines)
        code = write_chunk(exr, picture, y, &encode);
    int error = errno;
    if (started)
        exr_encoding_destroy(exr, &encode);
    exr_result_t finished = exr_finish(&exr);
    if (code == EXR_ERR_SUCCESS) {
        code = finished;
        error = errno;
    }
    errno = rg_is_want(error) ? error : EIO; // it was opened, so that the disk is at fault
    return code == EXR_ERR_SUCCESS || rg_why_unwritten(why, exr_get_default_error_message(code));
}
