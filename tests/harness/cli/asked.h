// Commands without devices: what they ask of the functions that do the work is noted down instead.
// Those are stand-ins; the ones that all commands share are here.
#ifndef RG_TESTS_HARNESS_CLI_ASKED_H
#define RG_TESTS_HARNESS_CLI_ASKED_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "harness/devices/frames/subject.h"

// What the last command asked for, printed, and logged last.
extern char asked_seen[4096], asked_logged[1024];
extern const char *asked_printed;
// The status of opening devices, that of those left out, and what closing them adds.
extern int asked_opening, asked_left_out, asked_closing;
// The devices that are opened: "first" and "second".
extern struct rg_device asked_devices[2];

void asked_note(const char *format, ...) __attribute__((format(printf, 1, 2)));
// The text, or "-" for NULL and "".
const char *asked_text(const char *text);

// "flow seed 1, 512x512"
void asked_note_subject(const struct rg_subject *subject);

// Runs the command with the words of a line, in an empty folder; its exit status.
int asked_run(const char *line);
// Runs it, and compares what it asked for, and its status.
void asked_expect(const char *line, const char *seen, int exit);

// Makes and removes the folder.
int asked_setup(void **state);
int asked_teardown(void **state);

#endif
