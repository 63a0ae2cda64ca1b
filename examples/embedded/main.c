/* A car stands too near to its neighbours, and moves along the gradient of its clearance until half a metre is free.
 * geograd wrote car.c and car.h; this program needs nothing else of it. */
#include "car.h"
#include <stdio.h>
#include <string.h>

/* A box: x and y of its centre, length and width in metres, heading in radians. */
enum { X, Y, LENGTH, WIDTH, HEADING, NUMBERS };

static const float others[][NUMBERS] = {
    {5.2f, 0.1f, 4.4f, 1.8f, 0.04f},    /* the car in front */
    {-5.3f, -0.2f, 4.6f, 1.9f, -0.02f}, /* the car behind */
    {0.0f, -1.6f, 24.0f, 0.6f, 0.0f},   /* the kerb */
};
enum { OTHERS = sizeof others / sizeof others[0] };

/* Returns the clearance from the nearest box, and its derivatives by the numbers of the own one. */
static float clearance(const float own[NUMBERS], float gradient[NUMBERS]) {
    float x[2 * NUMBERS], out[1 + 2 * NUMBERS], least = 1e6f;
    int i;
    memcpy(x, own, NUMBERS * sizeof x[0]);
    for (i = 0; i < OTHERS; i += 1) {
        memcpy(x + NUMBERS, others[i], sizeof others[i]);
        car(x, out);
        if (out[0] < least) {
            least = out[0];
            memcpy(gradient, out + 1, NUMBERS * sizeof out[0]);
        }
    }
    return least;
}

int main(void) {
    float own[NUMBERS] = {0.9f, -0.2f, 4.2f, 1.8f, 0.1f}, by[NUMBERS] = {0.0f};
    const float wanted = 0.5f;
    int step;
    for (step = 0; step < 100; step += 1) {
        const float found = clearance(own, by);
        const float steepness = by[X] * by[X] + by[Y] * by[Y] + by[HEADING] * by[HEADING];
        const float missing = wanted - found;
        printf("%3d: x %6.3f, y %6.3f, heading %6.3f, clearance %6.3f m\n", step, (double)own[X], (double)own[Y],
            (double)own[HEADING], (double)found);
        if (missing < 0.001f) {
            return 0;
        }
        own[X] += missing * by[X] / steepness;
        own[Y] += missing * by[Y] / steepness;
        own[HEADING] += missing * by[HEADING] / steepness;
    }
    return 1;
}
