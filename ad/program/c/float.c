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
