// Pictures as the original database has them, for tests to write.
#ifndef RG_TESTS_CORE_SCENE_ATLAS_CODES_H
#define RG_TESTS_CORE_SCENE_ATLAS_CODES_H

#include <stdint.h>

// Writes a grey PNG of 16 bits a pixel; on failure it fails the test.
void write_codes(const char *path, int width, int height, const uint16_t *codes);

#endif
