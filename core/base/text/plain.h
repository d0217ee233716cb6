// Text from outside, made fit for a terminal.
#ifndef RG_CORE_BASE_TEXT_PLAIN_H
#define RG_CORE_BASE_TEXT_PLAIN_H

// The code of the control character of ASCII or Unicode (U+0080 to U+009F) that begins `text`, in
// UTF-8; -1 where none does.
int rg_control_at(const char *text);

// Replaces line breaks and tabs by spaces and other control characters by question marks, in place:
// names from files must not steer a terminal.
void rg_plain(char *text);

#endif
