static void read_manifest(FILE *file) {
    for (char line[512]; file && count < 16 && fgets(line, sizeof(line), file);) {
        struct slot *s = &slots[count];
        read_run(line);
        sscanf(line, "constants %u %u", &constants[0], &constants[1]);
        count += sscanf(line, "slot %u type %u format %u aspect %u texel %u size %u x %u layers %u levels %u "
            "view %u filter %u wrap %u compare %u bytes %u %63s %63s",
            &s->at, &s->type, &s->format, &s->aspect, &s->texel, &s->width, &s->height, &s->layers, &s->levels,
            &s->view_type, &s->filter, &s->wrap, &s->compare, &s->size, s->before, s->expected) == 16;
    }
    if (!count || fclose(file)) FAIL(2, "kernel.txt: cannot be read; run this in its folder\n");
}

static int differs(const struct slot *s) {
    unsigned char *due = calloc(1, s->size); if (!due) FAIL(2, "there is no memory\n");
    read_parts(s->before, due, s->size);
    read_parts(s->expected, due, s->size);
    for (unsigned i = 0; i < s->size; i++)
        if (s->bytes[i] != due[i])
            return printf("slot %u: byte %u is %02x, not %02x as in %s\n", s->at, i, s->bytes[i], due[i], s->expected);
    return 0;
}

int main(int argc, char **argv) {
    int differing = 0;
    if (argc > 1 && (argc != 3 || strcmp(argv[1], "--device") || argv[2][strspn(argv[2], "0123456789")])) FAIL(2, "./run [--device N]\n");
    read_manifest(fopen("kernel.txt", "r"));
    open_device(argc == 3 ? (unsigned)atoi(argv[2]) : 0);
    run();
    EACH_SLOT differing |= *s->expected != '-' && differs(s);
    puts(differing ? "it differs" : "it is the same");
    return differing;
}
