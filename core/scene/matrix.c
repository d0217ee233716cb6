#include "core/scene/matrix.h"

#include <math.h>
#include <string.h>

struct rg_matrix rg_matrix_of(const float rows[16])
{
    struct rg_matrix matrix;
    for (int i = 0; i < 16; i++)
        matrix.rows[i / 4][i % 4] = (double)rows[i];
    return matrix;
}

void rg_matrix_round(const struct rg_matrix *matrix, float rows[16])
{
    for (int i = 0; i < 16; i++)
        rows[i] = (float)matrix->rows[i / 4][i % 4];
}

struct rg_matrix rg_matrix_product(const struct rg_matrix *left, const struct rg_matrix *right)
{
    struct rg_matrix product = {{{0}}};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            for (int k = 0; k < 4; k++)
                product.rows[i][j] += left->rows[i][k] * right->rows[k][j];
    return product;
}

// One step of Gauss-Jordan elimination: turns column c of `rows` into that of the unit matrix.
// False if the matrix is singular.
static bool eliminate(double rows[4][8], int c)
{
    int pivot = c;
    for (int r = c + 1; r < 4; r++)
        if (fabs(rows[r][c]) > fabs(rows[pivot][c]))
            pivot = r;
    const double by = rows[pivot][c];
    if (!(fabs(by) > 1e-12))
        return false;
    for (int k = 0; k < 8; k++) {
        const double swapped = rows[c][k];
        rows[c][k] = rows[pivot][k] / by;
        if (pivot != c)
            rows[pivot][k] = swapped;
    }
    for (int r = 0; r < 4; r++) {
        const double times = rows[r][c];
        for (int k = 0; r != c && k < 8; k++)
            rows[r][k] -= times * rows[c][k];
    }
    return true;
}

bool rg_matrix_inverse(const struct rg_matrix *matrix, struct rg_matrix *inverse)
{
    double rows[4][8] = {{0}};
    for (int i = 0; i < 4; i++) {
        memcpy(rows[i], matrix->rows[i], sizeof(matrix->rows[i]));
        rows[i][4 + i] = 1;
    }
    for (int c = 0; c < 4; c++)
        if (!eliminate(rows, c))
            return false;
    for (int i = 0; i < 4; i++)
        memcpy(inverse->rows[i], rows[i] + 4, sizeof(inverse->rows[i]));
    return true;
}

struct rg_matrix rg_matrix_back(const struct rg_matrix *matrix)
{
    struct rg_matrix back = {{{0}}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            back.rows[i][j] = matrix->rows[j][i];
            back.rows[i][3] -= matrix->rows[j][i] * matrix->rows[j][3];
        }
    back.rows[3][3] = 1;
    return back;
}

void rg_matrix_multiply(const float left[16], const float right[16], float product[16])
{
    float made[16];
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            const float *row = left + 4 * i;
            made[4 * i + j] = row[0] * right[j] + row[1] * right[4 + j] + row[2] * right[8 + j] +
                              row[3] * right[12 + j];
        }
    memcpy(product, made, sizeof(made));
}

bool rg_matrix_undo(const float to_clip[16], const float clip[3], float at[3])
{
    const struct rg_matrix clipped = rg_matrix_of(to_clip);
    struct rg_matrix inverse;
    if (!rg_matrix_inverse(&clipped, &inverse))
        return false;
    double to[4];
    for (int i = 0; i < 4; i++)
        to[i] = inverse.rows[i][0] * (double)clip[0] + inverse.rows[i][1] * (double)clip[1] +
                inverse.rows[i][2] * (double)clip[2] + inverse.rows[i][3];
    for (int c = 0; c < 3; c++)
        at[c] = (float)(to[c] / to[3]);
    return isfinite(at[0]) && isfinite(at[1]) && isfinite(at[2]);
}

bool rg_matrix_from_pixel(const m4 *to_clip, int width, int height, m4 *from_pixel)
{
    float rows[16];
    rg_m4_rows(to_clip, rows);
    const struct rg_matrix clip = rg_matrix_of(rows);
    struct rg_matrix from;
    if (!rg_matrix_inverse(&clip, &from))
        return false;
    for (int i = 0; i < 4; i++) {
        double *row = from.rows[i];
        row[3] = row[3] - row[0] - row[1];
        row[0] = row[0] * 2 / width;
        row[1] = row[1] * 2 / height;
    }
    rg_matrix_round(&from, rows);
    *from_pixel = rg_m4_of(rows);
    return true;
}

void rg_turn_multiply(const double left[3][3], const double right[3][3], double product[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            product[i][j] =
                left[i][0] * right[0][j] + left[i][1] * right[1][j] + left[i][2] * right[2][j];
}

m4 rg_m4_of(const float rows[16])
{
    m4 matrix;
    memcpy(&matrix, rows, sizeof(matrix));
    return matrix;
}

void rg_m4_rows(const m4 *matrix, float rows[16])
{
    memcpy(rows, matrix, sizeof(*matrix));
}
