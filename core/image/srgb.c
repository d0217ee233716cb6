#include "core/image/srgb.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>

static struct rg_srgb tables;
static pthread_once_t tables_once = PTHREAD_ONCE_INIT;

double rg_srgb_decode(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

double rg_srgb_encode(double linear)
{
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

float *rg_light_of_codes(int codes, double gamma)
{
    float *light = malloc((size_t)codes * sizeof(*light));
    for (int c = 0; light && c < codes; c++) {
        const double code = c / (codes - 1.0);
        light[c] = (float)(gamma > 0 ? pow(code, gamma) : rg_srgb_decode(code));
    }
    return light;
}

static void make_tables(void)
{
    for (int c = 0; c < 256; c++) {
        tables.linear[c] = (float)rg_srgb_decode(c / 255.0);
        tables.encoded[c] = (float)rg_srgb_encode((double)tables.linear[c]);
    }
    for (int c = 1; c < 256; c++) {
        double exact = rg_srgb_decode((c - 0.5) / 255);
        float above = (float)exact;
        tables.threshold[c] = above < exact ? nextafterf(above, 2) : above;
    }
    tables.threshold[256] = INFINITY;
    for (int step = 0, c = 0; step < RG_SRGB_STEPS; step++) {
        uint32_t bits = RG_SRGB_LOWEST_BITS + ((uint32_t)step << 16);
        float start;
        memcpy(&start, &bits, sizeof(start));
        while (start >= tables.threshold[c + 1])
            c++;
        tables.code[step] = (uint8_t)c;
    }
}

const struct rg_srgb *rg_srgb(void)
{
    pthread_once(&tables_once, make_tables);
    return &tables;
}
