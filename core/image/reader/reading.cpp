// State of a file while it is read.
#include <cstdio>

#include "core/image/reader/reader.h"

bool Reading::refuse(const std::string &why)
{
    snprintf(reply.why, sizeof(reply.why), "%s", why.empty() ? "no reason is given" : why.c_str());
    return false;
}

void Reading::tell(bool is_applied, const std::string &name, const std::string &value)
{
    std::string line = (is_applied ? "" : "!") + name + "\t" + value;
    for (size_t i = 0; i < line.size(); i++)
        if (((unsigned char)line[i] < ' ' && i != line.size() - value.size() - 1) || line[i] == 127)
            line[i] = '?';
    extras += line + "\n";
}

std::string digest_text(uint64_t digest)
{
    char text[32];
    snprintf(text, sizeof(text), "XXH3 %016llx", (unsigned long long)digest);
    return text;
}
