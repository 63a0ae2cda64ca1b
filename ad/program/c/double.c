// The root; zero for zero and below.
static double program_root(double x) {
    return x <= 0.0 ? 0.0 : sqrt(x);
}

// The power of two that brings a positive number into [2, 4): exponent field e becomes 2 * bias + 1 - e.
static double program_binade(double x) {
    const double normal = x < 2.2250738585072014e-308 ? 2.2250738585072014e-308 : x;
    return program_of_bits(0x7ff0000000000000ull - (program_bits(normal) & 0x7ff0000000000000ull));
}

// The high half of the significand.
static double program_high(double x) {
    return program_of_bits(program_bits(x) & 0xfffffffff8000000ull);
}
