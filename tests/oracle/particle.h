// Particles of streaks in double precision, from the text of C. Creus, "Real-time realistic rain
// rendering", 2010, sections 4.2 and 4.4, without kernels/.
#ifndef RG_TESTS_ORACLE_PARTICLE_H
#define RG_TESTS_ORACLE_PARTICLE_H

// Lengths in metres; s along the fall, from the rain space's top.
struct particle_space {
    double half_x, half_y; // of the rain space
    double top, height;    // of the local space
    double streak;         // from a drop to the upper end of its streak
    double speed, splash_s;
    double eye_x, eye_y, radius;
    int exact;
};

enum particle_state { PARTICLE_NOTHING, PARTICLE_DROP, PARTICLE_SPLASH };

struct particle_seen {
    double x, y, s;
    enum particle_state state;
    double age_s;    // of a splash
    double margin_m; // the distance of a length from the next change of state
};

// The state of a particle over a surface at `hit`. It began at clip coordinates (x, y), `start` of
// the way through the local space; all have run `run` of the way.
struct particle_seen particle_oracle(const struct particle_space *space, double x, double y,
                                     double start, double run, double hit);

#endif
