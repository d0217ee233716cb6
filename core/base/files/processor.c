#include "core/base/files/processor.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ARM = 0x41, CAVIUM = 0x43, FUJITSU = 0x46, HISILICON = 0x48, NVIDIA = 0x4e };
enum { QUALCOMM = 0x51, APPLE = 0x61, AMPERE = 0xc0, LINE_SIZE = 256 };

// What lscpu of util-linux calls them.
static const struct part {
    unsigned long implementer, part;
    const char *name;
} parts[] = {
    {ARM, 0xd03, "Cortex-A53"},  {ARM, 0xd04, "Cortex-A35"},         {ARM, 0xd05, "Cortex-A55"},
    {ARM, 0xd07, "Cortex-A57"},  {ARM, 0xd08, "Cortex-A72"},         {ARM, 0xd09, "Cortex-A73"},
    {ARM, 0xd0a, "Cortex-A75"},  {ARM, 0xd0b, "Cortex-A76"},         {ARM, 0xd0c, "Neoverse-N1"},
    {ARM, 0xd0d, "Cortex-A77"},  {ARM, 0xd40, "Neoverse-V1"},        {ARM, 0xd41, "Cortex-A78"},
    {ARM, 0xd44, "Cortex-X1"},   {ARM, 0xd46, "Cortex-A510"},        {ARM, 0xd47, "Cortex-A710"},
    {ARM, 0xd48, "Cortex-X2"},   {ARM, 0xd49, "Neoverse-N2"},        {ARM, 0xd4d, "Cortex-A715"},
    {ARM, 0xd4e, "Cortex-X3"},   {ARM, 0xd4f, "Neoverse-V2"},        {CAVIUM, 0x0af, "ThunderX2"},
    {FUJITSU, 0x001, "A64FX"},   {HISILICON, 0xd01, "TaiShan-v110"}, {NVIDIA, 0x004, "Carmel"},
    {QUALCOMM, 0x001, "Oryon"},  {APPLE, 0x022, "Icestorm-M1"},      {APPLE, 0x023, "Firestorm-M1"},
    {AMPERE, 0xac3, "Ampere-1"}, {AMPERE, 0xac4, "Ampere-1a"},
};

static void name_part(unsigned long implementer, unsigned long part, char *name, size_t size)
{
    for (size_t i = 0; i < sizeof(parts) / sizeof(parts[0]); i++) {
        if (parts[i].implementer == implementer && parts[i].part == part) {
            snprintf(name, size, "%s", parts[i].name);
            return;
        }
    }
    snprintf(name, size, "implementer 0x%lx, part 0x%lx", implementer, part);
}

// Adds a part's name to those of the others, once.
static void add_part(unsigned long implementer, unsigned long part, char *name, size_t size)
{
    char added[64];
    name_part(implementer, part, added, sizeof(added));
    const size_t used = strlen(name);
    if (!strstr(name, added) && used < size)
        snprintf(name + used, size - used, "%s%s", used ? ", " : "", added);
}

// The value of a line "key   : value", without its end; NULL for another key.
static char *value_of(char *line, const char *key)
{
    char *value = strncmp(line, key, strlen(key)) ? NULL : strchr(line, ':');
    if (!value)
        return NULL;
    value += 1 + strspn(value + 1, " \t");
    value[strcspn(value, "\n")] = 0;
    return value;
}

void rg_processor_name(const char *path, char *name, size_t size)
{
    FILE *file = fopen(path, "r");
    char line[LINE_SIZE], *value;
    unsigned long implementer = 0;
    *name = 0;
    while (file && fgets(line, sizeof(line), file)) {
        if ((value = value_of(line, "model name"))) {
            snprintf(name, size, "%.120s", value);
            break;
        }
        if ((value = value_of(line, "CPU implementer")))
            implementer = strtoul(value, NULL, 0);
        else if ((value = value_of(line, "CPU part")))
            add_part(implementer, strtoul(value, NULL, 0), name, size);
    }
    if (file)
        fclose(file);
}
