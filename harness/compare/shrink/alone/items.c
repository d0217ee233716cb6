static struct { // of the draw: the first item, state, place in the targets, kind
    unsigned first, blend, depth, cull, x, y, across, down, width, height, layer, level, points;
} draw;

static void read_run(const char *line) {
    sscanf(line, "draw first %u items %u blend %u depth %u cull %u scissor %u %u %u %u target %u x %u layer %u level %u points %u", &draw.first,
        &items, &draw.blend, &draw.depth, &draw.cull, &draw.x, &draw.y, &draw.across, &draw.down, &draw.width, &draw.height, &draw.layer,
        &draw.level, &draw.points);
}

