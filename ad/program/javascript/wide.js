// The bits of a number, to read and to write; the high word is first.
const program_bits = new DataView(new ArrayBuffer(8));

// The number with these words.
function program_of_words(high, low) {
    program_bits.setUint32(0, high);
    program_bits.setUint32(4, low);
    return program_bits.getFloat64(0);
}

// The high word of a number.
function program_high_word(x) {
    program_bits.setFloat64(0, x);
    return program_bits.getUint32(0);
}

// Two to a whole power from -1022 to 1023.
function program_power_of_two(k) {
    return program_of_words((k + 1023) << 20, 0);
}

// The exponent of a normal positive number.
function program_exponent(x) {
    return (program_high_word(x) >>> 20) - 1023;
}

// The significand of a normal positive number, in [1, 2).
function program_significand(x) {
    const high = program_high_word(x);
    return program_of_words((high & 0xfffff) | 0x3ff00000, program_bits.getUint32(4));
}

// 2/pi in parts of 24 bits, and pi/2 (fdlibm, k_rem_pio2.c).
const program_two_over_pi = [
    0xa2f983, 0x6e4e44, 0x1529fc, 0x2757d1, 0xf534dd, 0xc0db62, 0x95993c, 0x439041, 0xfe5163, 0xabdebb, 0xc561b7,
    0x246e3a, 0x424dd2, 0xe00649, 0x2eea09, 0xd1921c, 0xfe1deb, 0x1cb129, 0xa73ee8, 0x8235f5, 0x2ebb44, 0x84e99c,
    0x7026b4, 0x5f7e41, 0x3991d6, 0x398353, 0x39f49c, 0x845f8b, 0xbdf928, 0x3b1ff8, 0x97ffde, 0x05980f, 0xef2f11,
    0x8b5a0a, 0x6d1f6d, 0x367ecf, 0x27cb09, 0xb74f46, 0x3f669e, 0x5fea2d, 0x7527ba, 0xc7ebe5, 0xf17b3d, 0x0739f7,
    0x8a5292, 0xea6bfb, 0x5fb11f, 0x8d5d08, 0x560330, 0x46fc7b, 0x6babf0, 0xcfbc20, 0x9af436, 0x1da9e3, 0x91615e,
    0xe61b08, 0x659985, 0x5f14a0, 0x68408d, 0xffd880, 0x4d7327, 0x310606, 0x1556ca, 0x73a8c9, 0x60e27b, 0xc08c6b,
];
const program_half_pi = [
    1.57079625129699707031e+00, 7.54978941586159635335e-08, 5.39030252995776476554e-15, 3.28200341580791294123e-22,
    1.27065575308067607349e-29,
];

// The quarter turns next to a positive angle beyond 2^20 pi/2, and the rest in two parts: by the digits of 2/pi that
// count (fdlibm, k_rem_pio2.c, Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved. Permission to use,
// copy, modify, and distribute this software is freely granted, provided that this notice is preserved.)
function program_rest_of_large(angle) {
    const exponent = program_exponent(angle) - 23;
    // The angle in parts of 24 bits.
    const x = [];
    let z = program_significand(angle) * 8388608;
    for (let i = 0; i < 3; i += 1) {
        x.push(i < 2 ? Math.floor(z) : z);
        z = (z - x[i]) * 16777216;
    }
    while (x[x.length - 1] === 0) {
        x.pop();
    }
    const last = x.length - 1;
    const skipped = Math.max(0, Math.trunc((exponent - 3) / 24));
    let scale = exponent - 24 * (skipped + 1);
    // Products with the parts of 2/pi.
    const q = [];
    const add = (i) => {
        let sum = 0;
        for (let j = 0; j <= last; j += 1) {
            const at = skipped + i - j;
            sum += x[j] * (at < 0 ? 0 : program_two_over_pi[at]);
        }
        q.push(sum);
    };
    for (let i = 0; i <= 4; i += 1) {
        add(i);
    }
    let top = 4;
    let digits, turns, sign;
    for (;;) {
        // In whole numbers, from the last one to the first.
        digits = [];
        z = q[top];
        for (let j = top; j > 0; j -= 1) {
            const carried = Math.trunc(5.9604644775390625e-8 * z);
            digits.push(z - 16777216 * carried);
            z = q[j - 1] + carried;
        }
        z *= program_power_of_two(scale);
        z -= 8 * Math.floor(z * 0.125);
        turns = Math.trunc(z);
        z -= turns;
        sign = 0;
        if (scale > 0) {
            const whole = digits[top - 1] >> (24 - scale);
            turns += whole;
            digits[top - 1] -= whole << (24 - scale);
            sign = digits[top - 1] >> (23 - scale);
        } else if (scale === 0) {
            sign = digits[top - 1] >> 23;
        } else if (z >= 0.5) {
            sign = 2;
        }
        // Above one half: one turn more, and the rest from there.
        if (sign > 0) {
            turns += 1;
            let carry = false;
            for (let i = 0; i < top; i += 1) {
                if (carry) {
                    digits[i] = 0xffffff - digits[i];
                } else if (digits[i] !== 0) {
                    carry = true;
                    digits[i] = 0x1000000 - digits[i];
                }
            }
            if (scale > 0) {
                digits[top - 1] &= scale === 1 ? 0x7fffff : 0x3fffff;
            }
            if (sign === 2) {
                z = 1 - z;
                if (carry) {
                    z -= program_power_of_two(scale);
                }
            }
        }
        // All digits cancelled: more of 2/pi is needed.
        if (z !== 0 || digits.slice(4, top).some((digit) => digit !== 0)) {
            break;
        }
        let more = 1;
        while (digits[4 - more] === 0) {
            more += 1;
        }
        for (let i = 0; i < more; i += 1) {
            top += 1;
            add(top);
        }
    }
    if (z === 0) {
        do {
            top -= 1;
            scale -= 24;
        } while (digits[top] === 0);
    } else {
        z *= program_power_of_two(-scale);
        if (z >= 16777216) {
            const carried = Math.trunc(5.9604644775390625e-8 * z);
            digits[top] = z - 16777216 * carried;
            top += 1;
            scale += 24;
            digits[top] = carried;
        } else {
            digits[top] = Math.trunc(z);
        }
    }
    // Times pi/2, the small terms first.
    let unit = program_power_of_two(scale);
    const parts = [];
    for (let i = top; i >= 0; i -= 1) {
        parts[i] = unit * digits[i];
        unit *= 5.9604644775390625e-8;
    }
    const products = [];
    for (let i = top; i >= 0; i -= 1) {
        let sum = 0;
        for (let k = 0; k <= 4 && k <= top - i; k += 1) {
            sum += program_half_pi[k] * parts[i + k];
        }
        products.push(sum);
    }
    let rest = 0;
    for (let i = top; i >= 0; i -= 1) {
        rest += products[i];
    }
    let lacks = products[0] - rest;
    for (let i = 1; i <= top; i += 1) {
        lacks += products[i];
    }
    return sign === 0 ? [turns, rest, lacks] : [turns, -rest, -lacks];
}

// The quarter turns next to an angle beyond 800000, and the rest in two parts (fdlibm, e_rem_pio2.c, with the notice
// above).
function program_rest(x) {
    const field = (program_high_word(x) >>> 20) & 0x7ff;
    if ((program_high_word(x) & 0x7fffffff) >= 0x413921fb) {
        const [turns, rest, lacks] = program_rest_of_large(Math.abs(x));
        return x < 0 ? [-turns, -rest, -lacks] : [turns, rest, lacks];
    }
    const turns = (x * 6.36619772367581382433e-01 + 6755399441055744) - 6755399441055744;
    const cancelled = (y) => field - ((program_high_word(y) >>> 20) & 0x7ff);
    let r = x - turns * 1.57079632673412561417e+00;
    let w = turns * 6.07710050650619224932e-11;
    let rest = r - w;
    if (cancelled(rest) > 16) {
        let t = r;
        w = turns * 6.07710050630396597660e-11;
        r = t - w;
        w = turns * 2.02226624879595063154e-21 - ((t - r) - w);
        rest = r - w;
        if (cancelled(rest) > 49) {
            t = r;
            w = turns * 2.02226624871116645580e-21;
            r = t - w;
            w = turns * 8.47842766036889956997e-32 - ((t - r) - w);
            rest = r - w;
        }
    }
    return [turns, rest, (r - rest) - w];
}

// Sine and cosine of an angle beyond 800000, where the library uses those of fdlibm (k_sin.c, k_cos.c, with the notice
// above).
function program_far(angle) {
    if (!(Math.abs(angle) <= 1.7976931348623157e308)) {
        return [NaN, NaN];
    }
    const [turns, x, y] = program_rest(angle);
    const z = x * x;
    const w = z * z;
    const r = 8.33333333332248946124e-03
        + z * (-1.98412698298579493134e-04 + z * 2.75573137070700676789e-06)
        + z * w * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10);
    const v = z * x;
    const sine = x - ((z * (0.5 * y - v * r) - y) - v * -1.66666666666666324348e-01);
    const t = z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * 2.48015872894767294178e-05))
        + w * w * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11));
    const half = 0.5 * z;
    const whole = 1 - half;
    const cosine = whole + (((1 - whole) - half) + (z * t - x * y));
    switch (turns & 3) {
        case 0: return [sine, cosine];
        case 1: return [cosine, -sine];
        case 2: return [-sine, -cosine];
        default: return [-cosine, sine];
    }
}
