// Decompressing and unpacking the chunks of an EXR file: faster than the library's own routines,
// and correct for RGBA halves, whose channels version 3.1.5 reverses.
#ifndef RG_CORE_IMAGE_FILES_EXR_UNPACK_H
#define RG_CORE_IMAGE_FILES_EXR_UNPACK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <openexr.h>

// A thread's state between chunks. Zero it at first; rg_exr_unpacker_release frees it.
struct rg_exr_unpacker {
    struct libdeflate_decompressor *inflater;
    uint8_t *scratch;
    size_t scratch_bytes;
    exr_result_t (*decompress)(exr_decode_pipeline_t *); // the library's, for other compressions
};

// Replaces the routines that exr_decoding_choose_default_routines chose. Channels with a
// decode_to_ptr are written there as floats, by the strides set for them.
void rg_exr_take_over(struct rg_exr_unpacker *unpacker, exr_decode_pipeline_t *decode);
void rg_exr_unpacker_release(struct rg_exr_unpacker *unpacker);

#endif
