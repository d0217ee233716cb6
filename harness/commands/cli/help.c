// Prints --help.
#include <stdio.h>
#include <string.h>

#include "harness/commands/cli/command.h"

enum { LINE_WIDTH = 79, LEFT_WIDTH = 30, LEFT_SIZE = 128 };

// "  -o, --output FILE", "      --size WxH", "  TECHNIQUE"
static int left_text(const struct rg_option *row, char text[LEFT_SIZE])
{
    char argument[RG_ARGUMENT_SIZE], letter[] = "   -x,";
    const char *value = rg_option_argument(row, argument);
    if (row->kind == RG_OPTION_OPERAND)
        return snprintf(text, LEFT_SIZE, "  %s", value);
    letter[4] = row->letter;
    return snprintf(text, LEFT_SIZE, "%s --%s%s%s", row->letter ? letter + 1 : "     ", row->name,
                    *value ? " " : "", value);
}

// Prints words from the current column to the line's end, continuing at `column`.
static void print_wrapped(const char *words, int column)
{
    for (int used = column; *words;) {
        const int length = (int)strcspn(words, " ");
        if (used > column && used + 1 + length > LINE_WIDTH) {
            printf("\n%*s", column, "");
            used = column;
        }
        used += printf("%s%.*s", used > column ? " " : "", length, words);
        words += length + (words[length] == ' ');
    }
}

static void print_row(const struct rg_option *row, int column)
{
    char left[LEFT_SIZE], about[RG_ABOUT_SIZE];
    if (row->kind == RG_OPTION_GROUP) {
        printf("\n%s\n", row->about);
        return;
    }
    const int length = left_text(row, left);
    if (length > column - 2)
        printf("%s\n%*s", left, column, "");
    else
        printf("%-*s", column, left);
    print_wrapped(rg_option_about(row, about), column);
    printf("\n");
}

void rg_command_print_help(const struct rg_command *command)
{
    struct rg_option rows[RG_MAX_OPTION_ROWS];
    const int count = rg_option_rows(command->options, rows);
    int column = 0;
    for (int i = 0; i < count; i++) {
        char left[LEFT_SIZE];
        const int length = rows[i].kind == RG_OPTION_GROUP ? 0 : left_text(&rows[i], left) + 2;
        if (length > column && length <= LEFT_WIDTH)
            column = length;
    }
    printf("raingauge %s %s\n%s\n", command->name, command->usage, command->about);
    for (int i = 0; i < count; i++)
        print_row(&rows[i], column);
}
