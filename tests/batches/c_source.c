// Runs functions that geograd wrote and compares their results with the library's, bit for bit. For each there is
// NAME.bin: the numbers of every input, and then those of every expected result.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int wrong = 0;
static long results = 0;

static char *read(const char *path, long bytes) {
    FILE *file = fopen(path, "rb");
    char *all = (char *)malloc((size_t)bytes + 1);
    if (file == NULL || all == NULL || fread(all, 1, (size_t)bytes + 1, file) != (size_t)bytes) {
        fprintf(stderr, "%s has not %ld bytes\n", path, bytes);
        exit(2);
    }
    fclose(file);
    return all;
}

#define RUN(T, NAME, INPUTS, OUTPUTS, COUNT) \
    do { \
        T *numbers = (T *)read(#NAME ".bin", (long)sizeof(T) * (INPUTS + OUTPUTS) * COUNT), out[OUTPUTS]; \
        for (long i = 0; i < COUNT; i += 1) { \
            const T *expected = numbers + INPUTS * COUNT + OUTPUTS * i; \
            NAME(numbers + INPUTS * i, out); \
            for (int j = 0; j < OUTPUTS; j += 1, results += 1) { \
                const int nan = out[j] != out[j] && expected[j] != expected[j]; \
                if (!nan && memcmp(out + j, expected + j, sizeof(T)) != 0 && ++wrong <= 20) { \
                    fprintf(stderr, "%s, input %ld: result %d is %.17g in place of %.17g\n", #NAME, i, j, \
                        (double)out[j], (double)expected[j]); \
                } \
            } \
        } \
        free(numbers); \
    } while (0)
