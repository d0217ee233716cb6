// Text from outside, made fit for a terminal.
#ifndef RG_CORE_BASE_TEXT_PLAIN_H
#define RG_CORE_BASE_TEXT_PLAIN_H

// Line breaks and tabs become spaces, and other control characters question marks, in place: names
// from files may not steer a terminal.
void rg_plain(char *text);

#endif
