#include "core/base/text/wrap.h"

#include <string.h>

int rg_wrap(const char *text, int columns, const char **rest)
{
    int length = (int)strlen(text);
    if (length > columns) {
        length = columns;
        while (length > 0 && text[length] != ' ')
            length--;
        length = length > 0 ? length : columns;
    }
    *rest = text + length + strspn(text + length, " ");
    return length;
}
