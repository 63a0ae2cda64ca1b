// The twelve high bits of the significand of a double, which a float holds.
static double program_wide_high(double x) {
    return program_of_bits(program_bits(x) & 0xfffffe0000000000ull);
}

static float program_sin(float x) {
    return (float)program_wide_sin(x);
}

static float program_cos(float x) {
    return (float)program_wide_cos(x);
}

static float program_sin_high(float x) {
    return (float)program_wide_high(program_wide_sin(x));
}

static float program_sin_low(float x) {
    const double sine = program_wide_sin(x);
    return (float)(sine - program_wide_high(sine));
}

static float program_cos_high(float x) {
    return (float)program_wide_high(program_wide_cos(x));
}

static float program_cos_low(float x) {
    const double cosine = program_wide_cos(x);
    return (float)(cosine - program_wide_high(cosine));
}

static float program_atan2(float y, float x) {
    return (float)program_wide_atan2(y, x);
}

static float program_exp(float x) {
    return (float)program_wide_exp(x);
}

static float program_ln(float x) {
    return (float)program_wide_ln(x);
}
