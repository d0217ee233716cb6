// What is made of the tables of commands, options, techniques and papers.
#ifndef RG_HARNESS_COMMANDS_PAGES_PAGES_H
#define RG_HARNESS_COMMANDS_PAGES_PAGES_H

// The manual page raingauge(1), for man, to stdout.
void rg_print_manual(void);

// The words that completion.bash, which the build puts behind them, completes with.
void rg_print_completion(void);

#endif
