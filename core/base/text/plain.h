// Text from outside, made fit for a terminal.
#ifndef RG_CORE_BASE_TEXT_PLAIN_H
#define RG_CORE_BASE_TEXT_PLAIN_H

// The code of the control character of ASCII or of Unicode (U+0080 to U+009F) that begins here in
// UTF-8; -1: none does.
int rg_control_at(const char *text);

// Line breaks and tabs become spaces, and other control characters question marks, in place: names
// from files may not steer a terminal.
void rg_plain(char *text);

#endif
