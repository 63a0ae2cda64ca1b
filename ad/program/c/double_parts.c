static double program_sin_high(double x) {
    return program_high(program_sin(x));
}

static double program_sin_low(double x) {
    const double sine = program_sin(x);
    return sine - program_high(sine);
}

static double program_cos_high(double x) {
    return program_high(program_cos(x));
}

static double program_cos_low(double x) {
    const double cosine = program_cos(x);
    return cosine - program_high(cosine);
}
