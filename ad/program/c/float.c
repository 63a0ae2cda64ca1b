// The root; zero for zero and below.
static float program_root(float x) {
    return x <= 0.0f ? 0.0f : sqrtf(x);
}

// The power of two that brings a positive number into [2, 4): exponent field e becomes 2 * bias + 1 - e.
static float program_binade(float x) {
    const float normal = x < 1.17549435e-38f ? 1.17549435e-38f : x;
    return program_float_of_bits(0x7f800000u - (program_bits_of_float(normal) & 0x7f800000u));
}

// The high half of the significand.
static float program_high(float x) {
    return program_float_of_bits(program_bits_of_float(x) & 0xfffff000u);
}

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
