// The host's matrices: 4x4, row by row, acting on columns: there = matrix * (x, y, z, 1).
//
// What kernels read is 16 floats, in the order of an m4 (kernels/dialect/matrix.h). What is
// reckoned with first is a struct rg_matrix of doubles, so that it is rounded once.
#ifndef RG_CORE_SCENE_MATRIX_H
#define RG_CORE_SCENE_MATRIX_H

#include <stdbool.h>

#include "kernels/dialect/matrix.h"

struct rg_matrix {
    double rows[4][4];
};

struct rg_matrix rg_matrix_of(const float rows[16]);
void rg_matrix_round(const struct rg_matrix *matrix, float rows[16]);

// left * right: first `right` acts, then `left`.
struct rg_matrix rg_matrix_product(const struct rg_matrix *left, const struct rg_matrix *right);
// What undoes a matrix. False, with no message, if nothing does; `inverse` is undefined then.
bool rg_matrix_inverse(const struct rg_matrix *matrix, struct rg_matrix *inverse);
// The same of a matrix that turns and moves alone: its turn transposed, so that lengths stay.
struct rg_matrix rg_matrix_back(const struct rg_matrix *matrix);

// The same product of floats, each operation rounded. `product` may be `left` or `right`.
void rg_matrix_multiply(const float left[16], const float right[16], float product[16]);
// The point that a matrix takes to a point of clip space, each operation in floats. False, with no
// message, if there is none.
bool rg_matrix_undo(const float to_clip[16], const float clip[3], float at[3]);
// From pixels and depth to the world, over w: the matrix's inverse, behind the viewport's. In
// double precision, since far away all depends on the last digits. False, with no message, if there
// is none.
bool rg_matrix_from_pixel(const m4 *to_clip, int width, int height, m4 *from_pixel);
// The product of turns alone, in double precision. `product` is neither of the two.
void rg_turn_multiply(const double left[3][3], const double right[3][3], double product[3][3]);

// Between what the host keeps and what kernels read.
m4 rg_m4_of(const float rows[16]);
void rg_m4_rows(const m4 *matrix, float rows[16]);

#endif
