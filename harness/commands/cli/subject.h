// A command's subject: the technique in its arguments, with the settings of --set.
#ifndef RG_HARNESS_COMMANDS_CLI_SUBJECT_H
#define RG_HARNESS_COMMANDS_CLI_SUBJECT_H

#include "core/techniques/technique.h"
#include "harness/commands/cli/option.h"

// The technique of this name. NULL, and one logged line, when there is none.
const struct rg_technique *rg_subject_technique(const char *name);

// A technique's defaults with every assignment of --set applied; the caller frees them. NULL, and
// one logged line, when one is refused.
void *rg_subject_settings(const struct rg_technique *technique, const struct rg_words *sets);

// The technique in the first argument, and its settings, which the caller frees. NULL, and one
// logged line, when there is none or a value is refused.
const struct rg_technique *rg_subject_find(const struct rg_words *arguments,
                                           const struct rg_words *sets, void **settings);

#endif
