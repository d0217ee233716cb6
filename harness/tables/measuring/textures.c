// Measures the sizes of textures, for tables about them.
#include <stdio.h>
#include <string.h>

#include "harness/tables/measuring/batch.h"

static bool tell_size(struct rg_record *record, const struct rg_session *session, const char *name,
                      int level)
{
    struct rg_image_desc desc;
    int first_level;
    char why[RG_DETAIL_SIZE];
    if (!rg_session_texture(session, name, &desc, &first_level)) {
        snprintf(why, sizeof(why), "%s has no texture '%s'", record->technique, name);
        return rg_record_end(record, RG_ERROR, why);
    }
    const int own_level = level - first_level;
    if (own_level < 0) {
        snprintf(why, sizeof(why), "the texture is reduced, and begins with level %d", first_level);
        return rg_record_end(record, RG_UNSUPPORTED, why);
    }
    if (own_level >= desc.levels) {
        snprintf(why, sizeof(why), "the texture ends with level %d", first_level + desc.levels - 1);
        return rg_record_end(record, RG_FAIL, why);
    }
    rg_named_set_number(&record->facts[record->fact_count++], "width_px",
                        rg_level_size(desc.width, own_level));
    rg_named_set_number(&record->facts[record->fact_count++], "height_px",
                        rg_level_size(desc.height, own_level));
    return true;
}

void rg_batch_tell_texture(struct rg_batch *batch, struct rg_place at)
{
    const struct rg_table *table = batch->table;
    const struct rg_subject subject = {rg_technique_find(table->technique),
                                       rg_batch_settings(batch, at), table->width, table->height};
    for (at.device = 0; at.device < batch->result->device_count; at.device++) {
        struct rg_record *record = rg_result_at(batch->result, at);
        struct rg_device *device = rg_batch_device(batch, at.device);
        struct rg_session *session =
            subject.settings ? rg_kept_open(batch->kept, device, &subject) : NULL;
        if (session)
            tell_size(record, session, table->rows[at.row].name,
                      (int)rg_table_value(table, at.row, "level"));
        else
            rg_record_end_by_error(record);
    }
}
