#include "core/image/clip/yuv.h"

#include "core/image/srgb.h"

// The weights of red, green and blue in luma, in ten-thousandths.
enum { RED = 2126, GREEN = 7152, BLUE = 722, ALL = RED + GREEN + BLUE };
// The codes that luma spans from black to white, and chroma from end to end; the codes of black and
// of no chroma.
enum { LIGHT_CODES = 219, DIFFERENCE_CODES = 224, BLACK = 16, GREY = 128, RGB_CODES = 255 };

struct rgb {
    int64_t red, green, blue; // codes, or sums of them
};

static int64_t light(struct rgb c)
{
    return RED * c.red + GREEN * c.green + BLUE * c.blue;
}

// base + value / divisor, rounded half up; the sum is above 0.
static uint8_t quantize(int base, int64_t value, int64_t divisor)
{
    return (uint8_t)((2 * (base * divisor + value) + divisor) / (2 * divisor));
}

static uint8_t luma(struct rgb c)
{
    return quantize(BLACK, LIGHT_CODES * light(c), (int64_t)RGB_CODES * ALL);
}

// The chroma code of a colour from the sums of `count` pixels. `weight` is the colour's weight in
// luma, so that the difference is at most ALL - weight.
static uint8_t chroma(int64_t colour, int weight, struct rgb sums, int count)
{
    return quantize(GREY, DIFFERENCE_CODES * (ALL * colour - light(sums)),
                    (int64_t)count * RGB_CODES * 2 * (ALL - weight));
}

static struct rgb codes_at(const struct rg_picture *picture, int x, int y, float exposure)
{
    const struct rg_srgb *srgb = rg_srgb();
    const float *from = picture->texels + ((int64_t)y * picture->width + x) * picture->channels;
    const int next = rg_picture_colours(picture) > 1;
    return (struct rgb){rg_srgb_code(srgb, from[0] * exposure),
                        rg_srgb_code(srgb, from[next] * exposure),
                        rg_srgb_code(srgb, from[2 * next] * exposure)};
}

void rg_yuv_encode(const struct rg_picture *picture, float exposure, uint8_t *yuv)
{
    const int width = picture->width, height = picture->height;
    uint8_t *cb = yuv + (int64_t)width * height;
    uint8_t *cr = cb + (int64_t)((width + 1) / 2) * ((height + 1) / 2);
    for (int top = 0; top < height; top += 2)
        for (int left = 0; left < width; left += 2) {
            struct rgb sums = {0};
            for (int i = 0; i < 4; i++) {
                const int x = left + (i & 1 && left + 1 < width);
                const int y = top + (i & 2 && top + 1 < height);
                const struct rgb c = codes_at(picture, x, y, exposure);
                yuv[(int64_t)y * width + x] = luma(c);
                sums.red += c.red, sums.green += c.green, sums.blue += c.blue;
            }
            *cb++ = chroma(sums.blue, BLUE, sums, 4);
            *cr++ = chroma(sums.red, RED, sums, 4);
        }
}
