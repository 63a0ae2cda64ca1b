// The root; zero for zero and below. Engines use the processor's, which is the nearest number.
function program_root(x) {
    return x <= 0 ? 0 : Math.sqrt(x);
}

// The power of two that brings a positive number into [2, 4): exponent field e becomes 2 * bias + 1 - e.
function program_binade(x) {
    const normal = x < 2.2250738585072014e-308 ? 2.2250738585072014e-308 : x;
    return program_of_words(0x7ff00000 - (program_high_word(normal) & 0x7ff00000), 0);
}

// The high half of the significand.
function program_high(x) {
    const high = program_high_word(x);
    return program_of_words(high, program_bits.getUint32(4) & 0xf8000000);
}

function program_sin_high(x) {
    return program_high(program_sin(x));
}

function program_sin_low(x) {
    const sine = program_sin(x);
    return sine - program_high(sine);
}

function program_cos_high(x) {
    return program_high(program_cos(x));
}

function program_cos_low(x) {
    const cosine = program_cos(x);
    return cosine - program_high(cosine);
}
