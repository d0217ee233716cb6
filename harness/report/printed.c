#include "harness/record/named.h"
#include "harness/report/page.h"
#include "harness/tables/papers/papers.h"

static json_t *columns_json(const struct rg_table *table)
{
    json_t *columns = json_array();
    for (int i = 0; i < RG_TABLE_VALUES && table->columns[i]; i++)
        json_array_append_new(columns, json_string(table->columns[i]));
    return columns;
}

static json_t *row_json(const struct rg_table *table, int row)
{
    json_t *values = json_array();
    for (int i = 0; i < RG_TABLE_VALUES && table->columns[i]; i++) {
        char text[RG_NAME_SIZE];
        rg_table_value_text(table, row, i, text, sizeof(text));
        json_array_append_new(values, rg_table_is_choice(table, i)
                                          ? json_string(text)
                                          : rg_number_json(table->rows[row].values[i]));
    }
    return json_pack("{ss? so}", "name", table->rows[row].name, "values", values);
}

static json_t *variants_json(const struct rg_table *table)
{
    json_t *variants = json_array();
    for (const struct rg_table_variant *v = table->variants; v->name; v++)
        json_array_append_new(variants, json_pack("{ss ss?}", "name", v->name, "column", v->fps));
    return variants;
}

json_t *rg_page_printed(const char *id)
{
    const struct rg_table *table = rg_table_find(id);
    if (!table)
        return NULL;
    json_t *rows = json_array();
    for (int row = 0; row < table->row_count; row++)
        json_array_append_new(rows, row_json(table, row));
    return json_pack("{ss ss ss sb ss? si so so so}", "about", table->about, "technique",
                     table->technique, "paper", rg_table_paper(table), "is_published",
                     rg_table_is_published(table), "names", table->names, "keys", table->key_count,
                     "columns", columns_json(table), "rows", rows, "variants",
                     variants_json(table));
}
