/* The mean information of a map in C, as it is usually written, and the least that reading bytes takes.
 *
 *     maps f64|f32|i8 FILE
 *
 * FILE holds SIDE x SIDE cells as they lie in memory: probabilities other than 0 and 1, or bytes. Prints one line a method:
 * name, seconds, value, with tabs between. `cargo bench --bench peers` compiles it with several flags and runs it. */
#define _POSIX_C_SOURCE 199309L
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tgmath.h>
#include <time.h>

enum { SIDE = 4000 };
static const size_t CELLS = (size_t)SIDE * SIDE;

/* Eq. 4 by two logarithms a cell. A row is summed up in the precision of its cells, the rows in double precision: as fast as
 * sums of that precision alone, which lose digits in large maps. */
#define TWO_LOGARITHMS(NAME, FLOAT)                                                  \
    static double NAME(const FLOAT *cells) {                                         \
        const FLOAT one = 1, half = (FLOAT)0.5, per_bit = (FLOAT)1.4426950408889634; \
        double sum = 0;                                                              \
        long observed = 0;                                                           \
        for (int y = 0; y < SIDE; y++) {                                             \
            const FLOAT *row = cells + (size_t)y * SIDE;                             \
            FLOAT nats = 0;                                                          \
            int count = 0;                                                           \
            for (int x = 0; x < SIDE; x++) {                                         \
                FLOAT p = row[x], q = one - p;                                       \
                nats += p * log(p) + q * log(q);                                     \
                count += p != half;                                                  \
            }                                                                        \
            /* An unknown cell has -1 bit of these, and adds no information. */      \
            sum += SIDE + nats * per_bit;                                            \
            observed += count;                                                       \
        }                                                                            \
        return observed ? sum / (double)observed : 0;                                \
    }
TWO_LOGARITHMS(two_logarithms_f64, double)
TWO_LOGARITHMS(two_logarithms_f32, float)

static double byte_sum(const uint8_t *cells) {
    uint64_t sum = 0;
    for (size_t k = 0; k < CELLS; k++) sum += cells[k];
    return (double)sum;
}

/* Eq. 4 of log-odds of being free times 16, 0 for unknown: how often each byte occurs, then 256 terms. */
static double counted(const uint8_t *cells) {
    uint64_t counts[256] = {0}, observed = 0;
    double sum = 0;
    for (size_t k = 0; k < CELLS; k++) counts[cells[k]]++;
    for (int byte = 0; byte < 256; byte++) {
        int level = (int8_t)byte < -127 ? -127 : (int8_t)byte;
        double p = 1 / (1 + exp(level / 16.0));
        if (level == 0) continue;
        sum += (double)counts[byte] * (1 + p * log2(p) + (1 - p) * log2(1 - p));
        observed += counts[byte];
    }
    return observed ? sum / (double)observed : 0;
}

/* Processor time of this thread: unlike the clock, it stands still while others run. */
static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The least time of the runs of a second, at least five. */
#define REPORT(NAME, CALL)                                                         \
    do {                                                                           \
        double least = 1e9, value = 0, begin = now();                              \
        for (int run = 0; run < 5 || now() - begin < 1; run++) {                   \
            double start = now();                                                  \
            value = CALL;                                                          \
            double took = now() - start;                                           \
            __asm__ volatile("" : : "r"(cells), "x"(value) : "memory");            \
            least = took < least ? took : least;                                   \
        }                                                                          \
        printf("%s\t%.9g\t%.17g\n", NAME, least, value);                           \
    } while (0)

int main(int count, char **arguments) {
    if (count != 3) return 2;
    const char *stored = arguments[1];
    size_t size = strcmp(stored, "f64") == 0 ? 8 : strcmp(stored, "f32") == 0 ? 4 : 1;
    FILE *file = fopen(arguments[2], "rb");
    void *cells = malloc(CELLS * size);
    if (!file || !cells || fread(cells, size, CELLS, file) != CELLS) return 1;
    if (size == 8) REPORT("two logarithms", two_logarithms_f64(cells));
    if (size == 4) REPORT("two logarithms", two_logarithms_f32(cells));
    if (size == 1) REPORT("byte sum", byte_sum(cells));
    if (size == 1) REPORT("bytes counted", counted(cells));
    return 0;
}
