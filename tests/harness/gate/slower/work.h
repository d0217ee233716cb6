// Real work of a known amount.
#ifndef RG_TESTS_HARNESS_GATE_SLOWER_WORK_H
#define RG_TESTS_HARNESS_GATE_SLOWER_WORK_H

// Does `loops` multiplications, each of which waits for the one before it.
void rg_test_work(long loops);

#endif
