// The words of CUDA for a compiler of C++: a grid whose threads run one after the other.
#include <cmath>
#include <cstring>

#define __device__
#define __global__
#define __noinline__

struct Place {
    unsigned x;
};

#ifdef GRID
Place blockIdx = {0}, blockDim = {64}, threadIdx = {0};
#else
extern Place blockIdx, blockDim, threadIdx;
#endif

static inline long long __double_as_longlong(double x) {
    long long bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}
static inline double __longlong_as_double(long long bits) {
    double x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}
static inline unsigned __float_as_uint(float x) {
    unsigned bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}
static inline float __uint_as_float(unsigned bits) {
    float x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}

// Runs a kernel over more blocks than there are rows for, and compares its rows as RUN does.
#define RUN_GRID(T, NAME, INPUTS, OUTPUTS, COUNT, ARGUMENTS) \
    do { \
        T *numbers = (T *)read(#NAME ".bin", (long)sizeof(T) * (INPUTS + OUTPUTS) * COUNT); \
        T *all = (T *)malloc(sizeof(T) * OUTPUTS * COUNT); \
        { \
            const T *x = numbers; \
            T *out = all; \
            for (blockIdx.x = 0; blockIdx.x * blockDim.x < COUNT + blockDim.x; blockIdx.x += 1) { \
                for (threadIdx.x = 0; threadIdx.x < blockDim.x; threadIdx.x += 1) { \
                    NAME ARGUMENTS; \
                } \
            } \
        } \
        for (long i = 0; i < OUTPUTS * COUNT; i += 1, results += 1) { \
            const T found = all[i], expected = numbers[INPUTS * COUNT + i]; \
            const int nan = found != found && expected != expected; \
            if (!nan && std::memcmp(&found, &expected, sizeof(T)) != 0 && ++wrong <= 20) { \
                fprintf(stderr, "%s: number %ld is %.17g in place of %.17g\n", #NAME, i, (double)found, \
                    (double)expected); \
            } \
        } \
        free(all); \
        free(numbers); \
    } while (0)
