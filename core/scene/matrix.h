// The host's matrices: 4x4, row by row, acting on columns: there = matrix * (x, y, z, 1).
//
// Kernels read 16 floats, in the order of an m4 (kernels/dialect/matrix.h). Products of several
// matrices use struct rg_matrix with doubles and round once.
#ifndef RG_CORE_SCENE_MATRIX_H
#define RG_CORE_SCENE_MATRIX_H

#include <stdbool.h>

#include "kernels/dialect/matrix.h"

struct rg_matrix {
    double rows[4][4];
};

struct rg_matrix rg_matrix_of(const float rows[16]);
void rg_matrix_round(const struct rg_matrix *matrix, float rows[16]);

// left * right, which applies `right` first.
struct rg_matrix rg_matrix_product(const struct rg_matrix *left, const struct rg_matrix *right);
// The inverse of a matrix. False, with no message, if it is singular; `inverse` is then undefined.
bool rg_matrix_inverse(const struct rg_matrix *matrix, struct rg_matrix *inverse);
// The inverse of a matrix that only rotates and moves; the rotation is transposed, so that lengths
// stay.
struct rg_matrix rg_matrix_back(const struct rg_matrix *matrix);

// left * right in floats, each operation rounded. `product` may be `left` or `right`.
void rg_matrix_multiply(const float left[16], const float right[16], float product[16]);
// The point that a matrix maps to a point of clip space, in double precision and rounded once.
// False, with no message, if there is none.
bool rg_matrix_undo(const float to_clip[16], const float clip[3], float at[3]);
// The matrix from pixels and depth to the world, over w: the inverse of the matrix followed by the
// viewport's. In double precision, since far away the last digits count. False, with no message, if
// there is none.
bool rg_matrix_from_pixel(const m4 *to_clip, int width, int height, m4 *from_pixel);
// The product of rotations, in double precision. `product` must be neither of the two.
void rg_turn_multiply(const double left[3][3], const double right[3][3], double product[3][3]);

// Convert between the host's 16 floats and the m4 of kernels.
m4 rg_m4_of(const float rows[16]);
void rg_m4_rows(const m4 *matrix, float rows[16]);

#endif
