// Tells whether the camera is inside a solid.
#include "core/scene/vector.h"
#include "core/techniques/cartoon/instance.h"

static void corner_of(const struct rg_mesh *mesh, int face, int k, double corner[3])
{
    const float *p = mesh->positions + 3 * (size_t)mesh->indices[3 * (size_t)face + (size_t)k];
    for (int c = 0; c < 3; c++)
        corner[c] = (double)p[c];
}

// 1 if a ray leaves a solid through the face, -1 if it enters one, 0 if it misses (Moeller and
// Trumbore, 1997).
static int crossing(const struct rg_mesh *mesh, int face, const double from[3], const double ray[3])
{
    double a[3], u[3], v[3], t[3], p[3], q[3];
    corner_of(mesh, face, 0, a);
    corner_of(mesh, face, 1, u);
    corner_of(mesh, face, 2, v);
    for (int c = 0; c < 3; c++) {
        u[c] -= a[c];
        v[c] -= a[c];
        t[c] = from[c] - a[c];
    }
    rg_cross(ray, v, p);
    rg_cross(t, u, q);
    const double det = rg_dot(u, p);
    if (det == 0)
        return 0;
    const double b = rg_dot(t, p) / det, c = rg_dot(ray, q) / det, far = rg_dot(v, q) / det;
    const bool is_met = far > 0 && b >= 0 && c >= 0 && b + c <= 1;
    return is_met ? (det < 0 ? 1 : -1) : 0;
}

bool cartoon_is_inside(const struct rg_mesh *mesh, const float eye[3])
{
    // A ray from inside a solid leaves once more than it enters, in any direction. Two rays are
    // tested, because one may also cross a single sheet.
    static const double rays[2][3] = {{0.0131, 1, 0.0173}, {0.8117, 0.0931, 0.5813}};
    const double from[3] = {(double)eye[0], (double)eye[1], (double)eye[2]};
    bool is_inside = true;
    for (int i = 0; i < 2 && is_inside; i++) {
        int left = 0;
        for (int face = 0; face < mesh->face_count; face++)
            left += crossing(mesh, face, from, rays[i]);
        is_inside = left > 0;
    }
    return is_inside;
}
