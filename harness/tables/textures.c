// Rows that are about textures.
#include <stdio.h>
#include <string.h>

#include "harness/tables/batch.h"

static const struct rg_texture *find_texture(const struct rg_instance *instance, const char *name)
{
    for (int i = 0; i < instance->texture_count; i++)
        if (!strcmp(instance->textures[i].name, name))
            return &instance->textures[i];
    return NULL;
}

static bool tell_size(struct rg_record *record, const struct rg_instance *instance,
                      const char *name, int level)
{
    const struct rg_texture *texture = find_texture(instance, name);
    char why[RG_DETAIL_SIZE];
    if (!texture) {
        snprintf(why, sizeof(why), "%s has no texture '%s'", record->technique, name);
        return rg_record_end(record, RG_ERROR, why);
    }
    const struct rg_image_desc *desc = &texture->image->desc;
    const int own_level = level - texture->first_level;
    if (own_level < 0) {
        snprintf(why, sizeof(why), "the texture is reduced, and begins with level %d",
                 texture->first_level);
        return rg_record_end(record, RG_UNSUPPORTED, why);
    }
    if (own_level >= desc->levels) {
        snprintf(why, sizeof(why), "the texture ends with level %d",
                 texture->first_level + desc->levels - 1);
        return rg_record_end(record, RG_FAIL, why);
    }
    rg_named_set_number(&record->facts[record->fact_count++], "width_px",
                        rg_level_size(desc->width, own_level));
    rg_named_set_number(&record->facts[record->fact_count++], "height_px",
                        rg_level_size(desc->height, own_level));
    return true;
}

void rg_batch_tell_texture(struct rg_batch *batch, struct rg_place at)
{
    const struct rg_table *table = batch->table;
    const struct rg_subject subject = {rg_technique_find(table->technique),
                                       rg_batch_settings(batch, at), table->width, table->height};
    for (at.device = 0; at.device < batch->kept->devices->count; at.device++) {
        struct rg_record *record = rg_result_at(batch->result, at);
        struct rg_device *device = batch->kept->devices->devices[at.device];
        struct rg_instance *instance =
            subject.settings ? rg_kept_open(batch->kept, device, &subject) : NULL;
        if (instance)
            tell_size(record, instance, table->rows[at.row].name,
                      (int)rg_table_value(table, at.row, "level"));
        else
            rg_record_end_by_error(record);
    }
}
