// A fuzzer for targets built without libFuzzer: it changes the files of a corpus at random, from a
// seed, and tries them.
//
//   fuzz_TARGET [--runs N] [--seconds S] [--seed N] FILE|FOLDER...
//
// Each file is first tried unchanged. An input that ends the program is kept as TARGET-SEED-RUN in
// the folder FUZZ_FOUND, or else in "."; `fuzz_TARGET --runs 0 FILE` tries it again.
#include <dirent.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "tests/fuzz/heard.h"

enum { MAX_SEEDS = 256, MAX_BYTES = 1 << 16, MAX_CHANGES = 6, LONGEST_S = 300 };

struct bytes {
    uint8_t *data;
    size_t size;
};

static struct bytes seeds[MAX_SEEDS];
static int seed_count;

// The current input, for the signal handler that keeps it.
static uint8_t input[MAX_BYTES];
static size_t input_size;
static char input_name[256];

// --- chance ---

static uint64_t state;

static uint64_t random64(void)
{
    uint64_t z = (state += UINT64_C(0x9e3779b97f4a7c15)); // SplitMix64
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

static size_t below(size_t limit)
{
    return limit ? (size_t)(random64() % limit) : 0;
}

// --- changes ---

static void flip_bit(void)
{
    input[below(input_size)] ^= (uint8_t)(1u << below(8));
}

static void set_number(void)
{
    static const uint64_t numbers[] = {0,      1,      2,          0x7f,       0x80,      0xff,
                                       0x7fff, 0xffff, 0x7fffffff, 0x80000000, 0xffffffff};
    const size_t width = (size_t)1 << below(3), at = below(input_size);
    const uint64_t number = numbers[below(sizeof(numbers) / sizeof(numbers[0]))];
    const bool is_big_endian = below(2);
    for (size_t i = 0; i < width && at + i < input_size; i++)
        input[at + i] = (uint8_t)(number >> (8 * (is_big_endian ? width - 1 - i : i)));
}

static void add_to_byte(void)
{
    input[below(input_size)] += (uint8_t)(below(35) - 17);
}

static void cut_range(void)
{
    const size_t at = below(input_size), most = input_size - at;
    const size_t length = 1 + below(most < 64 || below(8) == 0 ? most : 64);
    const size_t cut = length < most ? length : most;
    memmove(input + at, input + at + cut, input_size - at - cut);
    input_size -= cut;
}

// Inserts a piece of a seed.
static void insert(const uint8_t *piece, size_t length)
{
    const size_t at = below(input_size + 1);
    if (length > MAX_BYTES - input_size)
        return;
    memmove(input + at + length, input + at, input_size - at);
    memcpy(input + at, piece, length);
    input_size += length;
}

static void insert_piece(void)
{
    const struct bytes *seed = &seeds[below((size_t)seed_count)];
    const size_t from = below(seed->size), most = seed->size - from;
    insert(seed->data + from, 1 + below(most < 64 ? most : 64) % (most ? most : 1));
}

static void overwrite_with_piece(void)
{
    const struct bytes *seed = &seeds[below((size_t)seed_count)];
    const size_t from = below(seed->size), at = below(input_size);
    size_t length = 1 + below(32);
    length = length < seed->size - from ? length : seed->size - from;
    length = length < input_size - at ? length : input_size - at;
    memcpy(input + at, seed->data + from, length);
}

// Inserts a word that formats often handle badly.
static void insert_word(void)
{
    static const char *const words[] = {
        "nan",      "-inf",        "1e999",      "-1",
        "1e-320",   "0x1p2000",    "2147483648", "99999999999999999999",
        "null",     "true",        "{}",         "[]",
        "\"\"",     "\"\\u0007\"", "\n",         "\r\n",
        "\t",       " ",           ",",          "\x1b[2J",
        "\xc2\x9b", "\xff",        "%s%n",       "0",
    };
    const char *word = words[below(sizeof(words) / sizeof(words[0]))];
    insert((const uint8_t *)word, strlen(word));
}

// Changes a number that is written in digits.
static void change_digit(void)
{
    for (size_t at = below(input_size), i = 0; i < input_size; i++, at = (at + 1) % input_size)
        if (input[at] >= '0' && input[at] <= '9') {
            input[at] = (uint8_t) "0123456789-.e"[below(13)];
            return;
        }
}

static void change(void)
{
    static void (*const changes[])(void) = {flip_bit,    set_number,   add_to_byte,
                                            cut_range,   insert_piece, overwrite_with_piece,
                                            insert_word, change_digit};
    if (!input_size)
        insert_word();
    else
        changes[below(sizeof(changes) / sizeof(changes[0]))]();
}

// --- the corpus ---

static void add_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    uint8_t *data = malloc(MAX_BYTES);
    if (!file || !data || seed_count == MAX_SEEDS) {
        fprintf(stderr, "%s: cannot be read, or is one file too many\n", path);
        exit(2);
    }
    seeds[seed_count++] = (struct bytes){data, fread(data, 1, MAX_BYTES, file)};
    fclose(file);
}

static int is_visible(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

static void add(const char *path)
{
    struct stat found;
    struct dirent **entries;
    if (stat(path, &found))
        return; // a target has stored files, generated files, or both
    if (!S_ISDIR(found.st_mode)) {
        add_file(path);
        return;
    }
    const int count = scandir(path, &entries, is_visible, alphasort);
    for (int i = 0; i < count; i++) {
        char one[4096];
        snprintf(one, sizeof(one), "%s/%s", path, entries[i]->d_name);
        add_file(one);
        free(entries[i]);
    }
    if (count >= 0)
        free(entries);
}

// --- the run ---

static void keep_input(int signal_number)
{
    FILE *file = fopen(input_name, "wb");
    if (file) {
        fwrite(input, 1, input_size, file);
        fclose(file);
    }
    fprintf(stderr, "signal %d; the input is kept as %s\n", signal_number, input_name);
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

static void try_input(const char *target, uint64_t seed, long run)
{
    const char *folder = getenv("FUZZ_FOUND");
    snprintf(input_name, sizeof(input_name), "%s/%s-%llu-%ld", folder ? folder : ".", target,
             (unsigned long long)seed, run);
    alarm(LONGEST_S);
    // The copy has exactly the input's size, so that a sanitizer sees a read beyond its end.
    uint8_t *copy = malloc(input_size ? input_size : 1);
    if (!copy)
        abort();
    memcpy(copy, input, input_size);
    LLVMFuzzerTestOneInput(copy, input_size);
    free(copy);
}

static void take_seed(const struct bytes *seed)
{
    memcpy(input, seed->data, seed->size);
    input_size = seed->size;
}

int main(int count, char **words)
{
    const char *slash = strrchr(words[0], '/'), *target = slash ? slash + 1 : words[0];
    long runs = 1000, run = 0;
    double seconds = 1e9;
    uint64_t seed = 1;
    for (int i = 1; i < count; i++) {
        if (!strcmp(words[i], "--runs") && i + 1 < count)
            runs = atol(words[++i]);
        else if (!strcmp(words[i], "--seconds") && i + 1 < count)
            seconds = atof(words[++i]), runs = INT32_MAX;
        else if (!strcmp(words[i], "--seed") && i + 1 < count)
            seed = strtoull(words[++i], NULL, 10);
        else
            add(words[i]);
    }
    if (!seed_count) {
        fprintf(stderr, "%s: no files; name a corpus\n", target);
        return 2;
    }
    signal(SIGABRT, keep_input);
    signal(SIGALRM, keep_input);
    for (int i = 0; i < seed_count; i++) {
        take_seed(&seeds[i]);
        try_input(target, seed, -1 - i);
    }
    const time_t start = time(NULL);
    for (state = seed; run < runs && difftime(time(NULL), start) < seconds; run++) {
        take_seed(&seeds[below((size_t)seed_count)]);
        for (size_t changes = 1 + below(MAX_CHANGES); changes; changes--)
            change();
        try_input(target, seed, run);
    }
    printf("%s: %d files and %ld changed ones, seed %llu\n", target, seed_count, run,
           (unsigned long long)seed);
    for (int i = 0; i < seed_count; i++)
        free(seeds[i].data);
    return 0;
}
