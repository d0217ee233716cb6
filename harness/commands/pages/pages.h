// Pages generated from the tables of commands, options, techniques and papers.
#ifndef RG_HARNESS_COMMANDS_PAGES_PAGES_H
#define RG_HARNESS_COMMANDS_PAGES_PAGES_H

// Prints the manual page raingauge(1) to stdout.
void rg_print_manual(void);

// Prints the word lists for completion.bash, which the build appends.
void rg_print_completion(void);

#endif
