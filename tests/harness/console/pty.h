// A terminal of a test's own: what is written into one end is read as it is from the other.
#ifndef RG_TESTS_HARNESS_CONSOLE_PTY_H
#define RG_TESTS_HARNESS_CONSOLE_PTY_H

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include "tests/tools/expect.h"

struct pty {
    int reader, writer; // the writer is the terminal
};

static inline struct pty pty_open(void)
{
    struct pty pty = {.reader = posix_openpt(O_RDWR | O_NOCTTY)};
    struct termios way;
    assert_at_least(pty.reader, 0);
    assert_int_equal(grantpt(pty.reader), 0);
    assert_int_equal(unlockpt(pty.reader), 0);
    pty.writer = open(ptsname(pty.reader), O_RDWR | O_NOCTTY);
    assert_at_least(pty.writer, 0);
    assert_int_equal(tcgetattr(pty.writer, &way), 0);
    way.c_oflag &= ~(tcflag_t)OPOST; // line ends stay as they are
    assert_int_equal(tcsetattr(pty.writer, TCSANOW, &way), 0);
    assert_int_equal(fcntl(pty.reader, F_SETFL, O_NONBLOCK), 0);
    return pty;
}

static inline void pty_close(struct pty pty)
{
    close(pty.reader);
    close(pty.writer);
}

// What was written since the last call.
static inline const char *pty_read(struct pty pty)
{
    static char text[4096];
    size_t used = 0;
    for (ssize_t got; (got = read(pty.reader, text + used, sizeof(text) - 1 - used)) > 0;)
        used += (size_t)got;
    text[used] = 0;
    return text;
}

#endif
