static unsigned long long program_bits(double x) {
    return (unsigned long long)__double_as_longlong(x);
}

static double program_of_bits(unsigned long long bits) {
    return __longlong_as_double((long long)bits);
}

static unsigned program_bits_of_float(float x) {
    return __float_as_uint(x);
}

static float program_float_of_bits(unsigned bits) {
    return __uint_as_float(bits);
}
