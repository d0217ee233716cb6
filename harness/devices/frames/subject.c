#include "harness/devices/frames/subject.h"

#include <string.h>
#include <sys/stat.h>

#include "core/base/files/file.h"

bool rg_file_is_own(const char *value)
{
    struct stat st;
    return strpbrk(value, "./") && !stat(value, &st) && S_ISREG(st.st_mode);
}

const struct rg_param *rg_file_own_next(const struct rg_subject *subject, int *at,
                                        char value[RG_PATH_SIZE])
{
    const struct rg_param_table *table = subject->technique->params;
    while (*at < table->count) {
        const struct rg_param *param = &table->rows[(*at)++];
        if (param->kind != RG_PARAM_FILE)
            continue;
        rg_params_text(param, subject->settings, value, RG_PATH_SIZE);
        if (rg_file_is_own(value))
            return param;
    }
    return NULL;
}

bool rg_files_spared_by(const struct rg_subject *subject, const char *output)
{
    char value[RG_PATH_SIZE];
    bool spared = true;
    for (int at = 0; spared && rg_file_own_next(subject, &at, value);)
        spared = rg_file_spares(output, value);
    return spared;
}
