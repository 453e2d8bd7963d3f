/* Entropies, information and occupancies of cells in C, as they are usually written.
 *
 *     elementwise f64|f32 FUNCTION FILE
 *
 * FILE holds CELLS arguments as they lie in memory: probabilities other than 0 and 1 for `entropy`, log-odds for
 * `information_from_log_odds` and `occupancy_from_log_odds`. Prints name, seconds, mean of the results, with tabs between.
 * `cargo bench --bench peers` compiles it with several flags and runs it. */
#define _POSIX_C_SOURCE 199309L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tgmath.h>
#include <time.h>

enum { CELLS = 1 << 16, RUNS = 400 };

/* Eq. 1; and the information and the occupancy by e^-|l| and e^-l, with no care near 0. */
#define FUNCTIONS(FLOAT)                                                                              \
    static void entropy_##FLOAT(const FLOAT *restrict p, FLOAT *restrict out) {                       \
        const FLOAT one = 1, per_bit = (FLOAT)1.4426950408889634;                                     \
        for (int k = 0; k < CELLS; k++)                                                               \
            out[k] = -per_bit * (p[k] * log(p[k]) + (one - p[k]) * log(one - p[k]));                  \
    }                                                                                                 \
    static void information_from_log_odds_##FLOAT(const FLOAT *restrict l, FLOAT *restrict out) {     \
        const FLOAT one = 1, per_bit = (FLOAT)1.4426950408889634;                                     \
        for (int k = 0; k < CELLS; k++) {                                                             \
            FLOAT a = fabs(l[k]), e = exp(-a);                                                        \
            out[k] = one - per_bit * (log(one + e) + a * e / (one + e));                              \
        }                                                                                             \
    }                                                                                                 \
    static void occupancy_from_log_odds_##FLOAT(const FLOAT *restrict l, FLOAT *restrict out) {       \
        const FLOAT one = 1;                                                                          \
        for (int k = 0; k < CELLS; k++) out[k] = one / (one + exp(-l[k]));                            \
    }                                                                                                 \
    static double mean_##FLOAT(const FLOAT *out) {                                                    \
        double sum = 0;                                                                               \
        for (int k = 0; k < CELLS; k++) sum += out[k];                                                \
        return sum / CELLS;                                                                           \
    }
FUNCTIONS(double)
FUNCTIONS(float)

/* Processor time of this thread: unlike the clock, it stands still while others run. */
static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#define REPORT(NAME, FLOAT)                                               \
    if (strcmp(function, #NAME) == 0) {                                   \
        double least = 1e9;                                               \
        for (int run = 0; run < RUNS; run++) {                            \
            double start = now();                                         \
            NAME##_##FLOAT(cells, out);                                   \
            __asm__ volatile("" : : "r"(cells), "r"(out) : "memory");     \
            double took = now() - start;                                  \
            least = took < least ? took : least;                          \
        }                                                                 \
        printf("%s\t%.9g\t%.17g\n", "as written", least, mean_##FLOAT(out)); \
    }

int main(int count, char **arguments) {
    if (count != 4) return 2;
    const char *function = arguments[2];
    int single = strcmp(arguments[1], "f32") == 0;
    FILE *file = fopen(arguments[3], "rb");
    size_t size = single ? 4 : 8;
    void *cells = malloc(CELLS * size), *out = malloc(CELLS * size);
    if (!file || !cells || !out || fread(cells, size, CELLS, file) != CELLS) return 1;
    if (single) {
        REPORT(entropy, float)
        REPORT(information_from_log_odds, float)
        REPORT(occupancy_from_log_odds, float)
    } else {
        REPORT(entropy, double)
        REPORT(information_from_log_odds, double)
        REPORT(occupancy_from_log_odds, double)
    }
    return 0;
}
