#include "tests/core/scene/atlas/codes.h"

#include <png.h>
#include <stddef.h>
#include <stdio.h>

#include "tests/tools/expect.h"

void write_codes(const char *path, int width, int height, const uint16_t *codes)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, 16, PNG_COLOR_TYPE_GRAY,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (int r = 0; r < height; r++) {
        unsigned char row[64];
        assert_between(width, 1, 32);
        for (int c = 0; c < width; c++) {
            row[2 * c] = (unsigned char)(codes[r * width + c] >> 8);
            row[2 * c + 1] = (unsigned char)codes[r * width + c];
        }
        png_write_row(png, row);
    }
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    assert_int_equal(fclose(file), 0);
}
