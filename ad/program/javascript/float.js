// The root; zero for zero and below.
function program_root(x) {
    return x <= 0 ? 0 : Math.fround(Math.sqrt(x));
}

// The power of two that brings a positive number into [2, 4): exponent field e becomes 2 * bias + 1 - e.
function program_binade(x) {
    const normal = x < 1.1754943508222875e-38 ? 1.1754943508222875e-38 : x;
    program_bits.setFloat32(0, normal);
    program_bits.setUint32(0, 0x7f800000 - (program_bits.getUint32(0) & 0x7f800000));
    return program_bits.getFloat32(0);
}

// The high half of the significand.
function program_high(x) {
    program_bits.setFloat32(0, x);
    program_bits.setUint32(0, program_bits.getUint32(0) & 0xfffff000);
    return program_bits.getFloat32(0);
}

// The twelve high bits of the significand of a number of 64 bits, which 32 bits hold.
function program_wide_high(x) {
    return program_of_words(program_high_word(x) & 0xfffffe00, 0);
}

function program_sin_high(x) {
    return program_wide_high(program_wide_sin(x));
}

function program_sin_low(x) {
    const wide = program_wide_sin(x);
    return Math.fround(wide - program_wide_high(wide));
}

function program_cos_high(x) {
    return program_wide_high(program_wide_cos(x));
}

function program_cos_low(x) {
    const wide = program_wide_cos(x);
    return Math.fround(wide - program_wide_high(wide));
}

function program_sin(x) {
    return Math.fround(program_wide_sin(x));
}

function program_cos(x) {
    return Math.fround(program_wide_cos(x));
}

function program_atan2(y, x) {
    return Math.fround(program_wide_atan2(y, x));
}

function program_exp(x) {
    return Math.fround(program_wide_exp(x));
}

function program_ln(x) {
    return Math.fround(program_wide_ln(x));
}
