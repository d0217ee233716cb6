// Whether numbers were drawn by chance independently of each other, whatever each one's
// distribution is.
#ifndef RG_TESTS_ORACLE_CHANCE_H
#define RG_TESTS_ORACLE_CHANCE_H

enum { ORACLE_COLUMNS = 8 };

// How much more the columns of `count` numbers depend on each other than chance explains. Numbers
// are replaced by their ranks, and each pair and triple of columns is counted in 64 cells. Returns
// the largest chi-square's distance from its mean, in standard deviations: a pair's has 49 degrees
// of freedom, a triple's 54, and independent columns stay below 5. 2 to ORACLE_COLUMNS columns, of
// at least 640 numbers each. INFINITY with more columns, or without memory.
double oracle_dependence(const double *const *columns, int column_count, int count);

#endif
