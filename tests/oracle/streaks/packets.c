#include "tests/oracle/streaks/packets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- statistics ---

// The regularised incomplete gamma function Q(a, x): by its series below a + 1, by its continued
// fraction (Lentz) above.
static double upper_gamma(double a, double x)
{
    const double scale = exp(a * log(x) - x - lgamma(a));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (int i = 1; i < 100000 && fabs(term) > sum * 1e-15; i++)
            sum += term *= x / (a + i);
        return 1 - sum * scale;
    }
    double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
    for (int i = 1; i < 100000; i++) {
        const double an = -i * (i - a);
        b += 2;
        d = 1 / (an * d + b);
        c = b + an / c;
        h *= d * c;
        if (fabs(d * c - 1) < 1e-15)
            break;
    }
    return h * scale;
}

double oracle_chi_square_tail(double chi_square, double degrees)
{
    return chi_square <= 0 ? 1 : upper_gamma(degrees / 2, chi_square / 2);
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double oracle_evenness(double *numbers, int64_t count)
{
    qsort(numbers, (size_t)count, sizeof(*numbers), ascending);
    double largest = 0;
    for (int64_t i = 0; i < count; i++) {
        largest = fmax(largest, numbers[i] - (double)i / (double)count);
        largest = fmax(largest, (double)(i + 1) / (double)count - numbers[i]);
    }
    const double root = sqrt((double)count), x = (root + 0.12 + 0.11 / root) * largest;
    double p = 0;
    for (int k = 1; k < 101; k++)
        p += (k % 2 ? 2 : -2) * exp(-2.0 * k * k * x * x);
    return x < 0.2 ? 1 : fmin(fmax(p, 0), 1);
}

uint64_t oracle_random(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

double oracle_uniform(uint64_t *state, double low, double high)
{
    return low + (high - low) * (double)(oracle_random(state) >> 11) * 0x1p-53;
}

// --- space ---

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void unit(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

static void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

// s is along the fall, x is the world's x axis projected across it, and x cross y is s.
struct oracle_frame oracle_frame_at(const double origin[3], const double fall[3])
{
    struct oracle_frame frame;
    memcpy(frame.origin, origin, sizeof(frame.origin));
    double *x = frame.axes[0], *y = frame.axes[1], *s = frame.axes[2];
    memcpy(s, fall, 3 * sizeof(*s));
    unit(s);
    for (int i = 0; i < 3; i++)
        x[i] = (i == 0) - s[0] * s[i];
    unit(x);
    cross(s, x, y);
    return frame;
}

void oracle_to_world(const struct oracle_frame *frame, const double rain[3], double world[3])
{
    for (int i = 0; i < 3; i++) {
        world[i] = frame->origin[i];
        for (int axis = 0; axis < 3; axis++)
            world[i] += rain[axis] * frame->axes[axis][i];
    }
}

struct oracle_camera oracle_camera_at(const double eye[3], const double target[3],
                                      const double up[3], double angle_deg, double aspect,
                                      double near_m)
{
    struct oracle_camera camera = {
        .tangent = tan(angle_deg * acos(-1) / 360), .aspect = aspect, .near_m = near_m};
    for (int i = 0; i < 3; i++) {
        camera.eye[i] = eye[i];
        camera.ahead[i] = target[i] - eye[i];
    }
    unit(camera.ahead);
    cross(camera.ahead, up, camera.right);
    unit(camera.right);
    cross(camera.right, camera.ahead, camera.up);
    return camera;
}

bool oracle_sees(const struct oracle_camera *camera, const double world[3])
{
    const double from[3] = {world[0] - camera->eye[0], world[1] - camera->eye[1],
                            world[2] - camera->eye[2]};
    const double z = dot(from, camera->ahead);
    return z >= camera->near_m &&
           fabs(dot(from, camera->right)) <= z * camera->tangent * camera->aspect &&
           fabs(dot(from, camera->up)) <= z * camera->tangent;
}

bool oracle_sees_column(const struct oracle_camera *camera, const struct oracle_frame *frame,
                        const double place[2], double across, double s_begin, double s_end,
                        int tries, uint64_t *random)
{
    for (int i = 0; i < tries; i++) {
        const double angle = oracle_uniform(random, 0, 2 * acos(-1));
        const double rain[3] = {place[0] + across * cos(angle), place[1] + across * sin(angle),
                                oracle_uniform(random, s_begin, s_end)};
        double world[3];
        oracle_to_world(frame, rain, world);
        if (oracle_sees(camera, world))
            return true;
    }
    return false;
}

double oracle_gradient_mass(double left, double top, double right, double bottom)
{
    enum { STEPS = 256 };
    double sum = 0;
    for (int j = 0; j < STEPS; j++)
        for (int i = 0; i < STEPS; i++) {
            const double x = left + (right - left) * (i + 0.5) / STEPS;
            const double y = top + (bottom - top) * (j + 0.5) / STEPS;
            sum += fmax(0, 1 - hypot(x, y));
        }
    return sum * (right - left) * (bottom - top) / STEPS / STEPS;
}
