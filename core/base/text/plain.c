#include "core/base/text/plain.h"

int rg_control_at(const char *text)
{
    const unsigned char *c = (const unsigned char *)text;
    if (*c == 0xc2 && c[1] >= 0x80 && c[1] < 0xa0)
        return c[1];
    return *c < ' ' || *c == 127 ? *c : -1;
}

void rg_plain(char *text)
{
    for (unsigned char *c = (unsigned char *)text; *c; c++) {
        if (*c == '\n' || *c == '\r' || *c == '\t')
            *c = ' ';
        else if (rg_control_at((const char *)c) >= 0x80)
            c[0] = c[1] = '?';
        else if (rg_control_at((const char *)c) >= 0)
            *c = '?';
    }
}
