#include "harness/frames/messages.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"

// Settings hold no pointer (core/techniques/params.h), so that their bytes are what they are.
void rg_put_subject(struct rg_message *message, const struct rg_subject *subject)
{
    rg_put_text(message, subject->technique->name);
    rg_put_block(message, subject->settings, (int64_t)subject->technique->params->settings_size);
    rg_put_int(message, subject->width);
    rg_put_int(message, subject->height);
}

bool rg_take_subject(struct rg_message *message, struct rg_subject *subject)
{
    int64_t size = 0;
    *subject = (struct rg_subject){.technique = rg_technique_find(rg_take_text(message))};
    void *settings = subject->technique ? rg_take_block(message, &size) : NULL;
    subject->settings = settings;
    subject->width = rg_take_index(message, INT32_MAX);
    subject->height = rg_take_index(message, INT32_MAX);
    if (settings && !message->failed && (size_t)size == subject->technique->params->settings_size)
        return true;
    free(settings);
    subject->settings = NULL;
    return rg_error("a message between processes names no subject");
}

void rg_put_account(struct rg_message *message, const struct rg_account *account)
{
    rg_put_int(message, account->frame);
    rg_put_int(message, account->counter_count);
    for (int i = 0; i < account->counter_count; i++) {
        rg_put_text(message, account->counters[i].name);
        rg_put_int(message, account->counters[i].value);
    }
    rg_put_int(message, account->fact_count);
    for (int i = 0; i < account->fact_count; i++) {
        rg_put_text(message, account->facts[i].name);
        rg_put_text(message, account->facts[i].text);
        RG_PUT(message, account->facts[i].number);
    }
}

bool rg_take_account(struct rg_message *message, struct rg_account *account)
{
    *account = (struct rg_account){.frame = rg_take_int(message)};
    account->counter_count = rg_take_index(message, RG_MAX_COUNTERS + 1);
    for (int i = 0; i < account->counter_count; i++) {
        account->counters[i].name = rg_take_name(message);
        account->counters[i].value = rg_take_int(message);
    }
    account->fact_count = rg_take_index(message, RG_MAX_FACTS + 1);
    for (int i = 0; i < account->fact_count; i++) {
        struct rg_fact *fact = &account->facts[i];
        fact->name = rg_take_name(message);
        snprintf(fact->text, sizeof(fact->text), "%s", rg_take_text(message));
        RG_TAKE(message, fact->number);
    }
    return !message->failed;
}

void rg_put_layout(struct rg_message *message, const struct rg_state *layout)
{
    rg_put_text(message, layout->name ? layout->name : "");
    rg_put_int(message, layout->is_float);
    rg_put_int(message, layout->row);
    rg_put_int(message, layout->margin);
}

bool rg_take_layout(struct rg_message *message, struct rg_state *layout)
{
    const char *name = rg_take_name(message);
    *layout = (struct rg_state){.name = *name ? name : NULL};
    layout->is_float = rg_take_index(message, 2);
    layout->row = rg_take_index(message, INT32_MAX);
    layout->margin = rg_take_index(message, INT32_MAX);
    return !message->failed;
}
