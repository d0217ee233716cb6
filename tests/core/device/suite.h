// Shared by the files of the device suite. A test's *state is the open device.
#ifndef RG_TESTS_CORE_DEVICE_SUITE_H
#define RG_TESTS_CORE_DEVICE_SUITE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/outcome.h"
#include "core/device/device.h"

#define COUNT_OF(array) ((int)(sizeof(array) / sizeof((array)[0])))

extern const char *suite_device; // as on the command line

// Each file's tests.
struct suite_tests {
    const struct CMUnitTest *tests;
    int count;
};
extern const struct suite_tests buffer_tests, image_tests, texel_tests, kernel_tests, refusal_tests,
    lifetime_tests, scan_tests, probe_tests, draw_tests, target_tests, filter_tests, large_tests,
    light_tests, layer_tests, lack_tests, tally_tests, query_tests, range_tests, sampled_tests,
    native_filter_tests, around_tests, place_tests, pass_tests;

// Seeded words that look random.
uint32_t noise(uint32_t i);
uint32_t *noise_words(int count, uint32_t seed); // the caller frees them

struct rg_buf *make_buf(struct rg_device *device, const void *words, int count, const char *name);
// A buffer of `count` words set to `value`.
struct rg_buf *filled_buf(struct rg_device *device, uint32_t value, int count, const char *name);
uint32_t *read_words(struct rg_buf *buf, int count); // the caller frees them

// listen() collects messages from then on instead of printing them. heard() ends that and returns
// the line that came; more than one line fails the test. heard_all() returns any number of lines,
// one below the other.
void listen(void);
const char *heard(void);
const char *heard_all(void);

// The call must fail with one line that contains `part`, which names the object.
#define assert_refused(call, part)                                                                 \
    do {                                                                                           \
        listen();                                                                                  \
        bool accepted_ = (call);                                                                   \
        const char *line_ = heard();                                                               \
        if (accepted_ || !strstr(line_, part))                                                     \
            fail_msg("%s: %s, '%s' does not say '%s'", #call, accepted_ ? "accepted" : "refused",  \
                     line_, part);                                                                 \
    } while (0)

// As assert_refused, and the device must lack it: the fault is nobody's.
#define assert_lacks(call, part)                                                                   \
    do {                                                                                           \
        assert_refused(call, part);                                                                \
        assert_int_equal(rg_failure_take().fault, RG_FAULT_NONE);                                  \
    } while (0)

#endif
