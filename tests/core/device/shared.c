#include "tests/core/device/suite.h"

#include <stdio.h>

const char *suite_device = "cpu:reference";

uint32_t noise(uint32_t i)
{
    i = (i ^ (i >> 16)) * 0x7feb352du;
    i = (i ^ (i >> 15)) * 0x846ca68bu;
    return i ^ (i >> 16);
}

uint32_t *noise_words(int count, uint32_t seed)
{
    uint32_t *words = malloc((size_t)count * 4);
    for (int i = 0; i < count; i++)
        words[i] = noise((uint32_t)i + seed);
    return words;
}

struct rg_buf *make_buf(struct rg_device *device, const void *words, int count, const char *name)
{
    struct rg_buf *buf = rg_buf_create_with(device, words, (int64_t)count * 4, name);
    assert_non_null(buf);
    return buf;
}

struct rg_buf *filled_buf(struct rg_device *device, uint32_t value, int count, const char *name)
{
    uint32_t *words = malloc((size_t)count * 4);
    for (int i = 0; i < count; i++)
        words[i] = value;
    struct rg_buf *buf = make_buf(device, words, count, name);
    free(words);
    return buf;
}

uint32_t *read_words(struct rg_buf *buf, int count)
{
    uint32_t *words = malloc((size_t)count * 4);
    memset(words, 0xca, (size_t)count * 4);
    assert_true(rg_buf_read(buf, 0, words, (int64_t)count * 4));
    return words;
}

static char lines[8192];
static int lines_heard;

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level, (void)user;
    const size_t used = strlen(lines);
    snprintf(lines + used, sizeof(lines) - used, "%s%s", lines_heard ? "\n" : "", line);
    lines_heard++;
}

void listen(void)
{
    lines_heard = 0;
    lines[0] = 0;
    rg_log_listen(hear, NULL);
}

const char *heard_all(void)
{
    rg_log_listen(NULL, NULL);
    return lines;
}

const char *heard(void)
{
    heard_all();
    if (lines_heard > 1)
        fail_msg("%d messages instead of one: %s", lines_heard, lines);
    return lines;
}
