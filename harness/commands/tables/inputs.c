#include "harness/commands/tables/inputs.h"

#include <stdlib.h>

#include "harness/devices/frames/subject.h"
#include "harness/tables/print.h"

static bool spares(const struct rg_table *table, const void *settings, const char *folder)
{
    const struct rg_subject subject = {.technique = rg_technique_find(table->technique),
                                       .settings = settings};
    char value[RG_PATH_SIZE];
    bool spared = true;
    for (int at = 0; spared && rg_file_own_next(&subject, &at, value);)
        spared = rg_result_spares(table, folder, value);
    return spared;
}

// The settings of a row with assignments applied, which the caller frees. NULL, and one logged
// line, if one is refused.
static void *settings_of(const struct rg_technique *technique, const char *row, const char *set)
{
    void *defaults = rg_settings_create(technique);
    void *of_row = defaults ? rg_settings_copy(technique, defaults, row ? row : "") : NULL;
    void *settings = of_row ? rg_settings_copy(technique, of_row, set ? set : "") : NULL;
    free(of_row);
    free(defaults);
    return settings;
}

static bool table_is_spared(const struct rg_table *table, const char *set, const char *folder)
{
    bool spared = true;
    for (int row = 0; spared && row < table->row_count; row++) {
        void *settings =
            settings_of(rg_technique_find(table->technique), table->rows[row].set, set);
        spared = settings && spares(table, settings, folder);
        free(settings);
    }
    return spared;
}

bool rg_inputs_are_spared(const struct rg_table *const tables[], int count, const char *set,
                          const char *folder)
{
    bool spared = true;
    for (int i = 0; folder && spared && i < count; i++)
        spared = table_is_spared(tables[i], set, folder);
    return spared;
}
