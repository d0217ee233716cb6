// The places where particles land, against the faces of a mesh in double precision: shower landing
// DEVICE.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "kernels/dialect/image/format.h"
#include "tests/core/techniques/shower/rig.h"

#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

enum { WIDTH = 64, HEIGHT = 36, MAP_PX = 128, PLACES = 500 };

// An open mesh: a pyramid with one side missing, beside a sloping roof on nothing.
static const char *write_mesh(void)
{
    static const char text[] = "v -3 0 -3\nv 1 0 -3\nv 1 0 1\nv -3 0 1\nv -1 3 -1\n"
                               "v 2 1 -2\nv 4 2 -2\nv 4 2 2\nv 2 1 2\n"
                               "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 6 7 8\nf 6 8 9\n";
    const char *path = in_folder("open.obj");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_at_least(fputs(text, file), 0);
    assert_equals(fclose(file), 0);
    return path;
}

// The height of a triangle at a place; false if the place is beside it.
static bool is_over(const double t[3][3], double x, double z, double *height)
{
    const double ax = t[1][0] - t[0][0], az = t[1][2] - t[0][2];
    const double bx = t[2][0] - t[0][0], bz = t[2][2] - t[0][2];
    const double area = ax * bz - az * bx, px = x - t[0][0], pz = z - t[0][2];
    const double b = (px * bz - pz * bx) / area, c = (ax * pz - az * px) / area;
    if (fabs(area) < 1e-9 || b < 0 || c < 0 || b + c > 1)
        return false;
    *height = t[0][1] + b * (t[1][1] - t[0][1]) + c * (t[2][1] - t[0][1]);
    return true;
}

// The height of the highest face at a place; the ground plane is below all faces.
static double height_at(const struct city_faces *faces, double x, double z)
{
    double most = 0;
    for (int i = 0; i < 2 * faces->face_count; i++) {
        static const int corners[2][3] = {{0, 1, 2}, {0, 2, 3}};
        const float *face = faces->corners + (i / 2) * SCENERY_FACE_WORDS;
        double t[3][3], height;
        for (int k = 0; k < 3; k++)
            for (int axis = 0; axis < 3; axis++)
                t[k][axis] = (double)face[3 * corners[i % 2][k] + axis];
        if (is_over((const double(*)[3])t, x, z, &height))
            most = fmax(most, height);
    }
    return most;
}

// Whether the height is smooth around a place, so that no edge is near.
static bool is_smooth(const struct city_faces *faces, double x, double z)
{
    const double near_m = 0.02, height = height_at(faces, x, z);
    for (int i = 0; i < 4; i++) {
        const double other =
            height_at(faces, x + (i & 1 ? near_m : -near_m), z + (i & 2 ? near_m : -near_m));
        if (fabs(other - height) > 0.2)
            return false;
    }
    return true;
}

static struct shower *open_mesh(const char *settings)
{
    char all[600];
    snprintf(all, sizeof(all),
             "geometry=on scene=%s map_px=%d shadows=off shadow_map_px=16 particles=%d variation=0 "
             "drop_height_m=10 view_angle_deg=60 eye_x_m=0 eye_y_m=100 eye_z_m=230 heading_deg=0 "
             "wind_m_s=0 system=traditional crop=point motion=uniform %s",
             write_mesh(), MAP_PX, PLACES, settings);
    return pour_open(all, WIDTH, HEIGHT);
}

// Places at centres of the map's texels, which the viewer sees and which have no edge near.
static int find_places(struct shower *s, struct oracle_drop *places)
{
    const struct city_faces *f = &scenery_city(s->scene)->faces;
    const struct oracle_rain r = pour_oracle(s);
    int count = 0;
    for (int i = 0; i < MAP_PX * MAP_PX && count < PLACES; i += 23) {
        struct oracle_drop d = {.fall_m_s = 1};
        d.x = (double)f->low[0] +
              (i % MAP_PX + 0.5) / MAP_PX * ((double)f->high[0] - (double)f->low[0]);
        d.z = (double)f->low[2] +
              ((double)(i / MAP_PX) + 0.5) / MAP_PX * ((double)f->high[2] - (double)f->low[2]);
        d.y = height_at(f, d.x, d.z);
        if (oracle_inside(&r, &d) > 1 && is_smooth(f, d.x, d.z))
            places[count++] = d;
    }
    return count;
}

// Puts particles so that the next step takes them a little above or below a place. Counts those
// that move freely.
static int stay_of(struct shower *s, const struct oracle_drop *places, int count, double above_m)
{
    struct oracle_drop before[PLACES] = {{0}};
    for (int i = 0; i < count; i++) {
        before[i] = places[i];
        before[i].y += before[i].fall_m_s * s->settings.step_s + above_m;
    }
    pour_put(s, before, count);
    pour_step(s, 1);
    struct oracle_drop *after = pour_read(s);
    int stay = 0;
    for (int i = 0; i < count; i++)
        stay += fabs(after[i].x - before[i].x) < 1e-4 && fabs(after[i].z - before[i].z) < 1e-4 &&
                fabs(after[i].y - places[i].y - above_m) < 1e-3;
    free(after);
    return stay;
}

static void particles_land_on_the_mesh(void **state)
{
    (void)state;
    struct oracle_drop places[PLACES] = {{0}};
    struct shower *s = open_mesh("landing=mesh");
    pour_step(s, 1);
    const int count = find_places(s, places);
    int high = 0;
    for (int i = 0; i < count; i++)
        high += places[i].y > 0.02;
    print_message("%d places, %d of them on the mesh\n", count, high);
    assert_above(count, 200);
    assert_above(high, 60);
    assert_int_equal(stay_of(s, places, count, 0.01), count);
    assert_int_equal(stay_of(s, places, count, -0.01), 0);
    pour_close(s);
    s = open_mesh("landing=plane");
    pour_step(s, 1);
    assert_int_equal(stay_of(s, places, count, -0.01), high); // inside the mesh, above the plane
    pour_close(s);
}

// Promoted particles enter at the top of their column and land on the mesh again.
static void promoted_particles_rise_from_the_mesh(void **state)
{
    (void)state;
    struct oracle_drop places[PLACES] = {{0}};
    struct shower *s = open_mesh("renewal=promotion");
    pour_step(s, 1);
    const int count = find_places(s, places);
    for (int i = 0; i < count; i++)
        places[i].y += places[i].fall_m_s * s->settings.step_s - 0.5;
    pour_put(s, places, count);
    pour_step(s, 1);
    const struct oracle_rain r = pour_oracle(s);
    struct oracle_drop *after = pour_read(s);
    for (int i = 0; i < count; i++) {
        const struct oracle_sight at = oracle_sight_of(&r, &after[i]);
        const double top = r.eye[1] + at.ahead * tan(r.beta / 2);
        pour_expect("x", after[i].x, places[i].x, 1e-4);
        pour_expect("z", after[i].z, places[i].z, 1e-4);
        pour_expect("height", after[i].y, top - 0.5, 0.01);
    }
    free(after);
    pour_close(s);
}

// The light that drops add to a picture.
static double drawn_by(struct shower *s, const struct oracle_drop *drops, int count)
{
    static uint16_t texels[2][WIDTH * HEIGHT * 4];
    double sum = 0;
    for (int k = 0; k < 2; k++) {
        pour_put(s, drops, k ? count : 0);
        assert_true(s->base.technique->draw(&s->base));
        assert_true(rg_image_read(s->base.target, 0, 0, texels[k]));
    }
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++)
        sum += (double)rg_unpack_half(texels[1][i]) - (double)rg_unpack_half(texels[0][i]);
    return sum;
}

// Drops in front of the mesh are seen, and those behind it are not.
static void the_mesh_hides_drops(void **state)
{
    (void)state;
    struct oracle_drop front[PLACES] = {{0}}, behind[PLACES] = {{0}};
    struct shower *s = open_mesh("landing=plane light=30 opacity=1 drop_width_m=1 shape=segments");
    pour_step(s, 1);
    const struct city_faces *f = &scenery_city(s->scene)->faces;
    const struct oracle_rain r = pour_oracle(s);
    int count = 0;
    double peak[3] = {0};
    for (int i = 0; i < f->face_count * 4; i++) // the highest corner is the pyramid's top
        if ((double)f->corners[3 * i + 1] > peak[1])
            for (int axis = 0; axis < 3; axis++)
                peak[axis] = (double)f->corners[3 * i + axis];
    for (int i = 0; i < 20; i++) {
        const double share = 0.25 + 0.01 * i; // of the height: rays to the eye meet the mesh
        const struct oracle_drop low = {peak[0], peak[1] * share, peak[2], 10};
        struct oracle_sight at = oracle_sight_of(&r, &low);
        at.ahead *= 1.1;
        behind[count] = oracle_drop_at(&r, &at);
        at.ahead *= 0.3 / 1.1;
        front[count] = oracle_drop_at(&r, &at);
        front[count].fall_m_s = behind[count].fall_m_s = 10;
        behind[count].y -= 10; // far enough to hide the whole drop
        count++;
    }
    assert_above(drawn_by(s, front, count), 100);
    assert_below(fabs(drawn_by(s, behind, count)), 1);
    pour_close(s);
}

static int set_up_folder(void **state)
{
    return make_folder(state);
}

static int remove_all(void **state)
{
    unlink(in_folder("open.obj"));
    return remove_folder(state);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(particles_land_on_the_mesh),
        cmocka_unit_test(promoted_particles_rise_from_the_mesh),
        cmocka_unit_test(the_mesh_hides_drops),
    };
    if (set_up_folder(NULL))
        return 1;
    const int status = pour_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
    return remove_all(NULL) ? 1 : status;
}
