// Drops are released, move, stick and fade; splashes begin and end; slots are assigned. Each step
// is checked against the state before it, in double precision.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "tests/core/techniques/cartoon/rain/rig.h"
#include "tests/oracle/chance.h"
#include "tests/tools/expect.h"

#define SIZE_PX 96

static struct rg_device *device;

// A step: the rain before and after it.
struct step {
    struct cartoon *c;
    struct rig_rain was, is;
    double now_s; // at the step's end
};

static void each_step(const char *settings, int from, int to, void (*look)(const struct step *s))
{
    struct cartoon *c = rig_open(device, settings, SIZE_PX, SIZE_PX);
    rig_step(c, from);
    for (int i = from; i < to; i++) {
        struct step s = {.c = c, .was = rig_look(c)};
        rig_step(c, 1);
        s.is = rig_look(c);
        s.now_s = (double)(i + 1) / c->settings.rain.steps_s;
        look(&s);
        rig_free(&s.was);
        rig_free(&s.is);
    }
    rig_close(c);
}

// --- motion ---

static struct rainfall_air air_at(const struct step *s)
{
    const struct cartoon_rain_settings *rules = &s->c->settings.rain;
    const bool is_constant = !rules->drag;
    double wind[2];
    cartoon_wind_at(rules, &s->c->rain.script, (uint32_t)s->c->settings.seed, s->now_s, wind);
    const double over = is_constant ? rules->wind_s : 1;
    return (struct rainfall_air){is_constant,     rules->gravity_m_s2, rules->drag_m_s2,
                                 rules->drag_1_m, wind[0] / over,      wind[1] / over};
}

static void expect_vector(const char *what, float x, float y, float z, struct rainfall_vector due,
                          double within)
{
    const struct rainfall_vector found = {(double)x, (double)y, (double)z};
    rig_expect(what, rainfall_length(rainfall_sum(found, due, -1)), 0, within);
}

static void expect_fallen(const struct step *s, const cartoon_raindrop *was,
                          const cartoon_raindrop *is)
{
    const struct rainfall_air air = air_at(s);
    const double dt = 1.0 / s->c->settings.rain.steps_s;
    const struct rainfall_vector a = rainfall_acceleration(&air, rig_velocity(was));
    expect_vector("where it was", is->from_x, is->from_y, is->from_z, rig_place(was), 0);
    expect_vector("acceleration", is->ax, is->ay, is->az, a, 1e-4);
    expect_vector("velocity", is->vx, is->vy, is->vz, rainfall_sum(rig_velocity(was), a, dt), 1e-5);
    assert_int_equal(is->age, was->age + 1);
    if (is->state == CARTOON_COLLISION)
        return;
    expect_vector("place", is->x, is->y, is->z, rainfall_sum(rig_place(was), rig_velocity(was), dt),
                  1e-5);
    const bool is_low = (double)is->y < -0.5;
    if (is->state !=
        (is_low || is->age >= s->c->rain.params.life_steps ? CARTOON_DEATH : CARTOON_DROP))
        fail_msg("at %.4f m, %d steps old: state %u", (double)is->y, is->age, is->state);
}

static void expect_faded(const struct step *s, const cartoon_raindrop *was,
                         const cartoon_raindrop *is)
{
    const struct cartoon_rain_settings *rules = &s->c->settings.rain;
    const int steps = (int)fmax(lround(rules->fade_s * rules->steps_s), 1);
    expect_vector("a drop that sticks", is->x, is->y, is->z, rig_place(was), 0);
    assert_int_equal(is->stuck, was->stuck + 1);
    rig_expect("alpha", (double)is->alpha, 1 - (double)is->stuck / steps, 1e-6);
    assert_int_equal(is->state, is->stuck < steps ? CARTOON_STICKED : CARTOON_DEATH);
}

static void look_at_motion(const struct step *s)
{
    for (int i = 0; i < s->is.drop_slots; i++) {
        const cartoon_raindrop *was = &s->was.drops[i], *is = &s->is.drops[i];
        if (was->state == CARTOON_DROP)
            expect_fallen(s, was, is);
        else if (was->state != CARTOON_DEATH)
            expect_faded(s, was, is);
    }
}

static void drops_fall_as_newton_has_it(void **state)
{
    (void)state;
    each_step("scene=house2 drops_s=1500", 0, 100, look_at_motion);
    each_step("scene=house2 drops_s=700 wind_m_s=7 wind_turn_deg=70 spread_deg=20 steps_s=45 "
              "fade_s=0.4",
              30, 80, look_at_motion);
    each_step("scene=house2 drops_s=700 drag=quadratic wind=random wind_m_s=5 gust=1", 30, 90,
              look_at_motion);
}

// In still air a drop reaches the speed at which k v^2 carries all its weight.
static void quadratic_drag_has_a_terminal_speed(void **state)
{
    (void)state;
    struct cartoon *c = rig_open(device,
                                 "drops_s=200 drag=quadratic top_m=150 speed_m_s=2 "
                                 "drag_1_m=0.3 spread_deg=0",
                                 32, 32);
    rig_step(c, 240);
    struct rig_rain rain = rig_look(c);
    int old = 0;
    for (int i = 0; i < rain.drop_slots; i++)
        if (rain.drops[i].state == CARTOON_DROP && rain.drops[i].age > 150) {
            rig_expect("terminal speed", -(double)rain.drops[i].vy, sqrt(9.81 / 0.3), 0.01);
            old++;
        }
    assert_above(old, 100);
    rig_free(&rain);
    rig_close(c);
}

// --- release ---

// The number of drops is rate times time, with no fraction lost.
static void drops_are_released_to_the_fraction(void **state)
{
    (void)state;
    static const struct {
        const char *settings;
        int64_t rate, steps_s, steps;
    } cases[] = {{"drops_s=7", 7, 60, 200},
                 {"drops_s=6001", 6001, 60, 50},
                 {"drops_s=1000 steps_s=37", 1000, 37, 80},
                 {"drops_s=0", 0, 60, 5},
                 {"drops_s=59", 59, 60, 130}};
    for (int i = 0; i < 5; i++) {
        struct cartoon *c = rig_open(device, cases[i].settings, 32, 32);
        for (int64_t n = 1; n <= cases[i].steps; n++) {
            rig_step(c, 1);
            assert_int_equal(rig_tally(c, CARTOON_RELEASED), n * cases[i].rate / cases[i].steps_s);
        }
        assert_int_equal(rig_tally(c, CARTOON_REFUSED) + rig_tally(c, CARTOON_SPRAY_REFUSED), 0);
        rig_close(c);
    }
}

static void expect_mean(const char *what, double sum, int count, double mean, double deviation)
{
    rig_expect(what, sum / count, mean, 4.5 * deviation / sqrt(count));
}

// Places are uniform in their space and directions in their cone; sizes are squares of uniform
// numbers.
static void drops_start_by_chance(void **state)
{
    (void)state;
    enum { X, Y, Z, X2, SIZE, SIZE2, DOWN, EAST, NORTH, EAST2, CROSS, SUMS };
    struct cartoon *c = rig_open(device, "drops_s=600000 spread_deg=30 scene=house2", 32, 32);
    double sums[SUMS] = {0}, least = 1, most = 0, lowest = 1;
    rig_step(c, 1);
    struct rig_rain rain = rig_look(c);
    const float *low = c->diorama->mesh->low, *high = c->diorama->mesh->high;
    int count = 0;
    for (int i = 0; i < rain.drop_slots; i++) {
        const cartoon_raindrop *d = &rain.drops[i];
        if (d->state == CARTOON_DEATH)
            continue;
        const double x = ((double)d->from_x - (double)low[0]) / (double)(high[0] - low[0]);
        const double y = (double)d->from_y - c->rain.fall_m;
        const double z = ((double)d->from_z - (double)low[2]) / (double)(high[2] - low[2]);
        const double speed = 8 * (0.8 + 0.2 * (double)d->size), dt = 1.0 / 60;
        const double vx = ((double)d->x - (double)d->from_x) / dt / speed;
        const double vy = ((double)d->y - (double)d->from_y) / dt / speed;
        const double vz = ((double)d->z - (double)d->from_z) / dt / speed;
        rig_expect("speed at first", sqrt(vx * vx + vy * vy + vz * vz), 1, 3e-4);
        const double due[SUMS] = {
            x,  y,  z,       x * x, (double)d->size, (double)d->size * (double)d->size, -vy,
            vx, vz, vx * vx, x * y};
        for (int k = 0; k < SUMS; k++)
            sums[k] += due[k];
        least = fmin(least, fmin(x, fmin(y, z)));
        most = fmax(most, fmax(x, fmax(y, z)));
        lowest = fmin(lowest, -vy);
        count++;
    }
    assert_int_equal(count, 10000);
    const double edge = cos(acos(-1) / 6), across2 = (1 - (1 + edge + edge * edge) / 3) / 2;
    expect_mean("x", sums[X], count, 0.5, 0.289);
    expect_mean("y", sums[Y], count, 0.5, 0.289);
    expect_mean("z", sums[Z], count, 0.5, 0.289);
    expect_mean("x squared", sums[X2], count, 1.0 / 3, 0.3);
    expect_mean("x times y", sums[CROSS], count, 0.25, 0.22);
    expect_mean("size", sums[SIZE], count, 1.0 / 3, 0.3);
    expect_mean("size squared", sums[SIZE2], count, 0.2, 0.27);
    expect_mean("down", sums[DOWN], count, (1 + edge) / 2, 0.039);
    expect_mean("east", sums[EAST], count, 0, sqrt(across2));
    expect_mean("north", sums[NORTH], count, 0, sqrt(across2));
    expect_mean("east squared", sums[EAST2], count, across2, 0.07);
    rig_expect("the cone's edge", lowest, edge, 1e-3);
    assert_above(least, -1e-4);
    assert_below(least, 0.002);
    assert_below(most, 1 + 1e-4);
    assert_above(most, 0.998);
    rig_free(&rain);
    rig_close(c);
}

// A drop's place, size and direction are drawn independently of each other.
static void drops_start_anywhere_in_any_way(void **state)
{
    (void)state;
    enum { X, Y, Z, SIZE, DOWN, TURN, COLUMNS, MOST = 10000 };
    static double of[COLUMNS][MOST];
    const double *columns[COLUMNS];
    struct cartoon *c = rig_open(device, "drops_s=600000 spread_deg=30 scene=house2", 32, 32);
    rig_step(c, 1);
    struct rig_rain rain = rig_look(c);
    int count = 0;
    for (int i = 0; i < rain.drop_slots && count < MOST; i++) {
        const cartoon_raindrop *d = &rain.drops[i];
        if (d->state == CARTOON_DEATH)
            continue;
        const double vx = (double)(d->x - d->from_x), vy = (double)(d->y - d->from_y),
                     vz = (double)(d->z - d->from_z);
        const double row[COLUMNS] = {(double)d->from_x,
                                     (double)d->from_y,
                                     (double)d->from_z,
                                     (double)d->size,
                                     -vy / hypot(hypot(vx, vy), vz),
                                     atan2(vz, vx)};
        for (int k = 0; k < COLUMNS; k++)
            of[k][count] = row[k];
        count++;
    }
    assert_int_equal(count, MOST);
    for (int k = 0; k < COLUMNS; k++)
        columns[k] = of[k];
    assert_below(oracle_dependence(columns, COLUMNS, count), 5);
    rig_free(&rain);
    rig_close(c);
}

// --- slots ---

// The list holds living drops in the order of their slots, then released drops, which take the
// first free slots.
static void look_at_lists(const struct step *s)
{
    const cartoon_rain_params *p = &s->c->rain.params;
    const uint32_t first =
        (uint32_t)cartoon_released_before(&s->c->settings.rain, s->c->base.frame - 1);
    int living = 0, released = 0;
    for (int i = 0; i < s->was.drop_slots; i++)
        if (s->was.drops[i].state != CARTOON_DEATH)
            assert_int_equal(s->is.living[living++], i);
    for (int i = 0; i < s->was.drop_slots && released < p->released; i++) {
        if (s->was.drops[i].state != CARTOON_DEATH)
            continue;
        assert_int_equal(s->is.living[living++], i);
        assert_int_equal(s->is.drops[i].number, first + (uint32_t)released++);
        assert_int_equal(s->is.drops[i].age, 1);
    }
    assert_int_equal(living, s->c->rain.drops);
    int sprays = 0, splashed = 0;
    for (int i = 0; i < s->was.spray_slots; i++)
        if (s->was.sprays[i].state != CARTOON_DEATH)
            assert_int_equal(s->is.living[p->drop_slots + sprays++], i);
    for (int k = 0, slot = 0; k < living; k++) {
        const cartoon_raindrop *d = &s->is.drops[s->is.living[k]];
        if (d->state != CARTOON_COLLISION)
            continue;
        while (s->was.sprays[slot].state != CARTOON_DEATH)
            slot++;
        assert_int_equal(s->is.living[p->drop_slots + sprays++], slot);
        const cartoon_spray *spray = &s->is.sprays[slot++];
        assert_equals(spray->x, d->x);
        assert_equals(spray->y, d->y);
        assert_equals(spray->z, d->z);
        assert_equals(spray->weight, d->size);
        splashed++;
    }
    for (int i = 0; i < s->is.spray_slots; i++)
        splashed -= s->is.sprays[i].state != CARTOON_DEATH && !s->is.sprays[i].age;
    assert_int_equal(splashed, 0);
}

static void slots_are_given_in_order(void **state)
{
    (void)state;
    each_step("scene=house2 drops_s=2000 collide=faithful", 0, 130, look_at_lists);
}

static void look_at_balance(const struct step *s)
{
    int falling = 0, stuck = 0, sprays = 0;
    for (int i = 0; i < s->is.drop_slots; i++) {
        falling += s->is.drops[i].state == CARTOON_DROP;
        stuck += s->is.drops[i].state > CARTOON_DROP;
    }
    for (int i = 0; i < s->is.spray_slots; i++)
        sprays += s->is.sprays[i].state != CARTOON_DEATH;
    uint32_t tally[CARTOON_TALLY];
    for (int i = 0; i < CARTOON_TALLY; i++)
        tally[i] = rig_tally(s->c, i);
    assert_int_equal(falling, tally[CARTOON_RELEASED] - tally[CARTOON_HITS] - tally[CARTOON_LEFT]);
    assert_int_equal(stuck, tally[CARTOON_HITS] - tally[CARTOON_FADED]);
    assert_int_equal(sprays, tally[CARTOON_SPLASHED] - tally[CARTOON_SPRAY_ENDED]);
    assert_int_equal(tally[CARTOON_SPLASHED], tally[CARTOON_HITS]);
}

static void every_drop_is_accounted_for(void **state)
{
    (void)state;
    each_step("scene=house2 drops_s=3000", 60, 130, look_at_balance);
    each_step("scene=car drops_s=3000 collide=faithful spin_deg=20", 60, 130, look_at_balance);
}

// --- splashes ---

static void expect_new(const struct step *s, const cartoon_spray *spray, const uint16_t *normals,
                       const struct rainfall_eye *eye)
{
    const struct rainfall_vector at = {(double)spray->x, (double)spray->y, (double)spray->z};
    const struct rainfall_spot spot = rainfall_spot_of(eye, at);
    const struct rainfall_vector n = {(double)spray->nx, (double)spray->ny, (double)spray->nz};
    const double pi = acos(-1), edge = fmin(fabs(spot.x_px - round(spot.x_px)),
                                            fabs(spot.y_px - round(spot.y_px)));
    assert_int_equal(spray->texture, 0);
    rig_expect("alpha of a new splash", (double)spray->alpha, 1, 0);
    if (edge > 0.01) {
        const uint16_t *texel = normals + 4 * ((int)spot.y_px * SIZE_PX + (int)spot.x_px);
        const bool is_sky = !texel[3];
        expect_vector("normal", spray->nx, spray->ny, spray->nz,
                      is_sky ? (struct rainfall_vector){0, 1, 0}
                             : (struct rainfall_vector){rig_half(texel[0]), rig_half(texel[1]),
                                                        rig_half(texel[2])},
                      1e-6);
    }
    const cartoon_raindrop *d = NULL;
    for (int i = 0; i < s->is.drop_slots; i++)
        if (s->is.drops[i].state == CARTOON_COLLISION && s->is.drops[i].x == spray->x &&
            s->is.drops[i].z == spray->z)
            d = &s->is.drops[i];
    assert_non_null(d);
    const struct rainfall_vector v = rig_velocity(d);
    const double cosine = -rainfall_dot(v, n) / rainfall_length(v) / rainfall_length(n);
    const double angle = acos(fmin(fmax(cosine, -1), 1));
    rig_expect("angle", (double)spray->angle, angle, 2e-3);
    if (fabs(angle - pi / 6) > 0.003 && fabs(angle - pi / 3) > 0.003)
        assert_int_equal(spray->pattern, angle < pi / 6 ? 0 : angle < pi / 3 ? 1 : 2);
}

static void look_at_splashes(const struct step *s)
{
    const struct cartoon_rain_settings *rules = &s->c->settings.rain;
    const int life = (int)fmax(lround(rules->splash_s * rules->steps_s), 1);
    const struct rainfall_eye eye = rig_eye(s->c);
    uint16_t *normals = rig_texels(s->c, "normal_map", 0, 0);
    for (int i = 0; i < s->is.spray_slots; i++) {
        const cartoon_spray *was = &s->was.sprays[i], *is = &s->is.sprays[i];
        if (was->state == CARTOON_DEATH) {
            if (is->state != CARTOON_DEATH)
                expect_new(s, is, normals, &eye);
            continue;
        }
        assert_int_equal(is->age, was->age + 1);
        assert_int_equal(is->state == CARTOON_DEATH, is->age >= life);
        rig_expect("alpha of a splash", (double)is->alpha, 1 - (double)is->age / life, 1e-6);
        if (is->age < life)
            assert_int_equal(is->texture, (int)floor(6.0 * is->age / life + 1e-9));
    }
    free(normals);
    free((void *)eye.depth);
}

static void splashes_live_and_fade(void **state)
{
    (void)state;
    each_step("scene=house2 drops_s=1000", 70, 110, look_at_splashes);
    each_step("scene=house2 drops_s=1000 collide=faithful splash_s=0.35 wind_m_s=9", 70, 110,
              look_at_splashes);
}

// A preset's settings hold unless a later assignment changes them.
static void presets_stand_for_settings(void **state)
{
    (void)state;
    static const char *const settings[] = {"preset=car", "preset=table drops_s=500",
                                           "wind_m_s=3 preset=park2"};
    static const struct {
        int drops_s;
        double wind_m_s;
    } due[] = {{15000, 0}, {500, 5}, {18000, 6}};
    for (int i = 0; i < 3; i++) {
        struct cartoon *c = rig_open(device, settings[i], 32, 32);
        assert_int_equal(c->settings.preset, i + 1);
        assert_int_equal(c->settings.rain.drops_s, due[i].drops_s);
        rig_expect("wind", c->settings.rain.wind_m_s, due[i].wind_m_s, 0);
        rig_close(c);
    }
}

// --- wind ---

static void put_script(const char *path, const char *text)
{
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    assert_at_least(fputs(text, out), 0);
    assert_true(!fclose(out));
}

static void wind_goes_by_its_script(void **state)
{
    (void)state;
    char path[] = "/tmp/raingauge-wind-XXXXXX", settings[128];
    const int file = mkstemp(path);
    assert_at_least(file, 0);
    assert_true(!close(file));
    put_script(path, "# two gusts\n0 4 0\n1 8 90 # it turns\n\n3 0 90\n");
    snprintf(settings, sizeof(settings), "drops_s=0 wind=script wind_script=%s", path);
    struct cartoon *c = rig_open(device, settings, 32, 32);
    static const double due[][3] = {{-1, 4, 0}, {0.5, 6, 45}, {2, 4, 90}, {9, 0, 90}};
    for (int i = 0; i < 4; i++) {
        double wind[2];
        cartoon_wind_at(&c->settings.rain, &c->rain.script, 1, due[i][0], wind);
        const double turn = due[i][2] * acos(-1) / 180;
        rig_expect("wind along x", wind[0], due[i][1] * cos(turn), 1e-9);
        rig_expect("wind along z", wind[1], -due[i][1] * sin(turn), 1e-9);
    }
    rig_close(c);
    unlink(path);
}

// Numbers too large for a direction or a quotient of times are refused. A comment may be long; the
// rest of a line may not.
static void wind_scripts_are_checked(void **state)
{
    (void)state;
    char path[] = "/tmp/raingauge-wind-XXXXXX", text[1024];
    const int file = mkstemp(path);
    assert_at_least(file, 0);
    assert_true(!close(file));
    static const char *const bad[] = {
        "",          "1 2\n",     "1 400 0\n",  "1 2 3\n1 2 3\n",
        "1 2 3 4\n", "1 2 1e7\n", "1 2 -inf\n", "-1e7 2 3\n1e7 2 3\n"};
    struct cartoon_wind_script script;
    for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); i++) {
        put_script(path, bad[i]);
        assert_false(cartoon_wind_read(path, &script));
    }
    snprintf(text, sizeof(text), "1 2 3 # %0500d 4 5 6\n2 3 4\n", 0);
    put_script(path, text);
    assert_true(cartoon_wind_read(path, &script));
    assert_equals(script.count, 2);
    put_script(path, "\xef\xbb\xbf"
                     "1 2 3\n2 3 4\n"); // some editors begin a file like this
    assert_true(cartoon_wind_read(path, &script) && script.count == 2);
    snprintf(text, sizeof(text), "1 2 3 %300s\n2 3 4\n", "");
    put_script(path, text);
    assert_false(cartoon_wind_read(path, &script));
    unlink(path);
}

// A comment of any length is skipped, if the file is within its limit.
static void a_long_wind_script_is_refused(void **state)
{
    (void)state;
    char path[] = "/tmp/raingauge-wind-XXXXXX";
    const int file = mkstemp(path);
    struct cartoon_wind_script script;
    assert_at_least(file, 0);
    put_script(path, "1 2 3\n#");
    assert_int_equal(ftruncate(file, 256 << 10), 0);
    assert_true(cartoon_wind_read(path, &script));
    assert_equals(script.count, 1);
    assert_int_equal(ftruncate(file, (256 << 10) + 1), 0);
    assert_false(cartoon_wind_read(path, &script));
    assert_non_null(strstr(rg_last_error(), "has more than 256 KiB; name a file of winds"));
    close(file);
    unlink(path);
}

// Gusts stay within their share and change smoothly. A seed and a time give the same wind, and a
// gust's strength says nothing of its direction.
static void wind_blows_by_chance(void **state)
{
    (void)state;
    struct cartoon_rain_settings s = {
        .wind = CARTOON_WIND_RANDOM, .wind_m_s = 10, .gust = 0.5, .gust_s = 2};
    const double widest = 20 * acos(-1) / 180;
    double before[2], sum = 0, most_turn = 0, together = 0;
    cartoon_wind_at(&s, NULL, 7, 0, before);
    for (int i = 1; i <= 20000; i++) {
        double wind[2], again[2], other[2];
        cartoon_wind_at(&s, NULL, 7, i * 0.01, wind);
        cartoon_wind_at(&s, NULL, 7, i * 0.01, again);
        cartoon_wind_at(&s, NULL, 8, i * 0.01, other);
        const double speed = hypot(wind[0], wind[1]);
        assert_at_least(speed, 5 - 1e-9);
        assert_at_most(speed, 15 + 1e-9);
        assert_below(hypot(wind[0] - before[0], wind[1] - before[1]), 0.5);
        assert_equals(wind[0], again[0]);
        assert_equals(wind[1], again[1]);
        assert_true(i % 200 == 0 || wind[0] != other[0]);
        const double turn = atan2(-wind[1], wind[0]);
        sum += speed;
        together += (speed - 10) / 5 * turn / widest;
        most_turn = fmax(most_turn, fabs(turn));
        memcpy(before, wind, sizeof(wind));
    }
    rig_expect("mean speed", sum / 20000, 10, 1.2);
    rig_expect("strength times direction", together / 20000, 0, 0.1);
    assert_below(most_turn, widest + 1e-9);
    assert_above(most_turn, 0.7 * widest);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drops_fall_as_newton_has_it),
        cmocka_unit_test(quadratic_drag_has_a_terminal_speed),
        cmocka_unit_test(drops_are_released_to_the_fraction),
        cmocka_unit_test(drops_start_by_chance),
        cmocka_unit_test(drops_start_anywhere_in_any_way),
        cmocka_unit_test(slots_are_given_in_order),
        cmocka_unit_test(every_drop_is_accounted_for),
        cmocka_unit_test(splashes_live_and_fade),
        cmocka_unit_test(presets_stand_for_settings),
        cmocka_unit_test(wind_goes_by_its_script),
        cmocka_unit_test(wind_scripts_are_checked),
        cmocka_unit_test(a_long_wind_script_is_refused),
        cmocka_unit_test(wind_blows_by_chance),
    };
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rg_device_close(device) ? failed : 1;
}
