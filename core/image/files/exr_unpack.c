#include "core/image/files/exr_unpack.h"

#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

#include "core/image/half.h"

// Converts `count` values of one channel of one line, and writes one into each texel.
static void convert_line(const uint8_t *from, int type, int count, float *to, int stride)
{
    enum { PART = 256 };
    union {
        uint16_t half[PART];
        uint32_t integer[PART];
    } raw;
    float values[PART];
    int size = type == EXR_PIXEL_HALF ? 2 : 4;
    for (int start = 0; start < count; start += PART, from += PART * size) {
        int part = count - start < PART ? count - start : PART;
        memcpy(type == EXR_PIXEL_FLOAT ? (void *)values : (void *)&raw, from,
               (size_t)part * (size_t)size);
        for (int i = 0; type == EXR_PIXEL_HALF && i < part; i++)
            values[i] = rg_float_of_half(raw.half[i]);
        for (int i = 0; type == EXR_PIXEL_UINT && i < part; i++)
            values[i] = (float)raw.integer[i];
        for (int i = 0; i < part; i++)
            to[(int64_t)(start + i) * stride] = values[i];
    }
}

// Replaces the library's routine, which reverses the channels of RGBA halves (3.1.5).
static exr_result_t unpack(exr_decode_pipeline_t *decode)
{
    const uint8_t *from = decode->unpacked_buffer, *end = from + decode->chunk.unpacked_size;
    for (int line = 0; line < decode->chunk.height; line++)
        for (int c = 0; c < decode->channel_count; c++) {
            const exr_coding_channel_info_t *channel = &decode->channels[c];
            if (channel->y_samples > 1 && (decode->chunk.start_y + line) % channel->y_samples)
                continue;
            int64_t bytes = (int64_t)channel->width * channel->bytes_per_element;
            if (end - from < bytes)
                return EXR_ERR_CORRUPT_CHUNK;
            if (channel->decode_to_ptr)
                convert_line(from, channel->data_type, channel->width,
                             (float *)(void *)(channel->decode_to_ptr +
                                               (int64_t)line * channel->user_line_stride),
                             channel->user_pixel_stride / 4);
            from += bytes;
        }
    return EXR_ERR_SUCCESS;
}

// Undoes ZIP's preparation of bytes: differences of neighbours, and even bytes before odd ones.
static void restore_bytes(uint8_t *restrict prepared, size_t count, uint8_t *restrict bytes)
{
    uint8_t value = 128;
    for (size_t i = 0; i < count; i++)
        prepared[i] = value = (uint8_t)(value + prepared[i] - 128);
    size_t half = (count + 1) / 2;
    for (size_t i = 0; i < count / 2; i++) {
        bytes[2 * i] = prepared[i];
        bytes[2 * i + 1] = prepared[half + i];
    }
    if (count % 2)
        bytes[count - 1] = prepared[half - 1];
}

static exr_result_t decompress(exr_decode_pipeline_t *decode)
{
    struct rg_exr_unpacker *unpacker = decode->decoding_user_data;
    size_t bytes = decode->chunk.unpacked_size;
    bool zip = decode->chunk.compression == EXR_COMPRESSION_ZIP ||
               decode->chunk.compression == EXR_COMPRESSION_ZIPS;
    if (!zip || decode->unpacked_buffer == decode->packed_buffer || !decode->unpacked_buffer)
        return unpacker->decompress(decode);
    if (!unpacker->inflater)
        unpacker->inflater = libdeflate_alloc_decompressor();
    if (unpacker->scratch_bytes < bytes) {
        free(unpacker->scratch);
        unpacker->scratch = malloc(bytes);
        unpacker->scratch_bytes = unpacker->scratch ? bytes : 0;
    }
    if (!unpacker->inflater || !unpacker->scratch)
        return EXR_ERR_OUT_OF_MEMORY;
    if (libdeflate_zlib_decompress(unpacker->inflater, decode->packed_buffer,
                                   decode->chunk.packed_size, unpacker->scratch, bytes,
                                   NULL) != LIBDEFLATE_SUCCESS)
        return EXR_ERR_CORRUPT_CHUNK;
    restore_bytes(unpacker->scratch, bytes, decode->unpacked_buffer);
    return EXR_ERR_SUCCESS;
}

void rg_exr_take_over(struct rg_exr_unpacker *unpacker, exr_decode_pipeline_t *decode)
{
    if (!decode->unpack_and_convert_fn) // the library puts floats of one channel in place itself
        return;
    decode->unpack_and_convert_fn = unpack;
    if (!decode->decompress_fn) // an uncompressed file
        return;
    unpacker->decompress = decode->decompress_fn;
    decode->decoding_user_data = unpacker;
    decode->decompress_fn = decompress;
}

void rg_exr_unpacker_release(struct rg_exr_unpacker *unpacker)
{
    if (unpacker->inflater)
        libdeflate_free_decompressor(unpacker->inflater);
    free(unpacker->scratch);
}
