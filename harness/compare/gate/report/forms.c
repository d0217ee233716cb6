#include "harness/compare/gate/report/forms.h"

#include <errno.h>
#include <string.h>

#include "core/base/files/file.h"
#include "core/base/log.h"

#define FORM(id, where, name, about, excludes, write) {RG_WHERE_##where, name, write},
const struct rg_report_form rg_report_forms[] = {RG_REPORT_FORMS(FORM)};

static FILE *open_end(const char *path, const char *variable)
{
    const char *why;
    FILE *out = rg_file_append(path, &why);
    if (!out)
        rg_system_error(errno, "%s: cannot be opened: %s; $%s must name a file", path, why,
                        variable);
    return out;
}

bool rg_report_can_append(const char *path, const char *variable)
{
    FILE *out = open_end(path, variable);
    return out && fclose(out) == 0;
}

bool rg_report_append(const struct rg_report *report, const struct rg_report_form *form,
                      const char *path)
{
    FILE *out = open_end(path, form->name);
    if (!out)
        return false;
    const bool is_made = form->write(report, out);
    const bool is_held = !ferror(out);
    return (fclose(out) == 0 && is_held)
               ? is_made
               : rg_system_error(errno, "%s: cannot be written: %s; free some disk", path,
                                 strerror(errno));
}
