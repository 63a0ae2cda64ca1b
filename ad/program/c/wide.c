// Two to a whole power from -1022 to 1023.
static double program_power_of_two(double k) {
    return program_of_bits((unsigned long long)((long long)k + 1023) << 52);
}

// The exponent of a normal positive number.
static double program_exponent(double x) {
    return (double)((long long)(program_bits(x) >> 52) - 1023);
}

// The significand of a normal positive number, in [1, 2).
static double program_significand(double x) {
    return program_of_bits((program_bits(x) & 0xfffffffffffffull) | 0x3ff0000000000000ull);
}

// 2/pi in parts of 24 bits, and pi/2 (fdlibm, k_rem_pio2.c).
static const int program_two_over_pi[66] = {
    0xa2f983, 0x6e4e44, 0x1529fc, 0x2757d1, 0xf534dd, 0xc0db62, 0x95993c, 0x439041, 0xfe5163, 0xabdebb, 0xc561b7,
    0x246e3a, 0x424dd2, 0xe00649, 0x2eea09, 0xd1921c, 0xfe1deb, 0x1cb129, 0xa73ee8, 0x8235f5, 0x2ebb44, 0x84e99c,
    0x7026b4, 0x5f7e41, 0x3991d6, 0x398353, 0x39f49c, 0x845f8b, 0xbdf928, 0x3b1ff8, 0x97ffde, 0x05980f, 0xef2f11,
    0x8b5a0a, 0x6d1f6d, 0x367ecf, 0x27cb09, 0xb74f46, 0x3f669e, 0x5fea2d, 0x7527ba, 0xc7ebe5, 0xf17b3d, 0x0739f7,
    0x8a5292, 0xea6bfb, 0x5fb11f, 0x8d5d08, 0x560330, 0x46fc7b, 0x6babf0, 0xcfbc20, 0x9af436, 0x1da9e3, 0x91615e,
    0xe61b08, 0x659985, 0x5f14a0, 0x68408d, 0xffd880, 0x4d7327, 0x310606, 0x1556ca, 0x73a8c9, 0x60e27b, 0xc08c6b
};
static const double program_half_pi[5] = {
    1.57079625129699707031e+00, 7.54978941586159635335e-08, 5.39030252995776476554e-15, 3.28200341580791294123e-22,
    1.27065575308067607349e-29
};

// The quarter turns next to a positive angle beyond 2^20 pi/2, and the rest in two parts: by the digits of 2/pi that
// count (fdlibm, k_rem_pio2.c, Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved. Permission to use,
// copy, modify, and distribute this software is freely granted, provided that this notice is preserved.)
static int program_rest_of_large(double angle, double rest[2]) {
    const int exponent = (int)program_exponent(angle) - 23;
    double x[3], q[20], parts[20], products[20] = {0.0}, unit, sum;
    int digits[20], last = 2, top = 4, turns = 0, sign = 0, zero, i, j, k;
    // The angle in parts of 24 bits.
    double z = program_significand(angle) * 8388608.0;
    for (i = 0; i < 3; i += 1) {
        x[i] = i < 2 ? (double)(int)z : z;
        z = (z - x[i]) * 16777216.0;
    }
    while (x[last] == 0.0) {
        last -= 1;
    }
    const int skipped = exponent < 3 ? 0 : (exponent - 3) / 24;
    int scale = exponent - 24 * (skipped + 1);
    int made = 0;
    for (;;) {
        // Products with the parts of 2/pi.
        for (; made <= top; made += 1) {
            sum = 0.0;
            for (j = 0; j <= last; j += 1) {
                const int at = skipped + made - j;
                sum += x[j] * (at < 0 ? 0.0 : (double)program_two_over_pi[at]);
            }
            q[made] = sum;
        }
        // In whole numbers, from the last one to the first.
        z = q[top];
        for (i = 0, j = top; j > 0; i += 1, j -= 1) {
            const double carried = (double)(int)(5.9604644775390625e-8 * z);
            digits[i] = (int)(z - 16777216.0 * carried);
            z = q[j - 1] + carried;
        }
        z *= program_power_of_two(scale);
        z -= 8.0 * floor(z * 0.125);
        turns = (int)z;
        z -= turns;
        sign = 0;
        if (scale > 0) {
            const int whole = digits[top - 1] >> (24 - scale);
            turns += whole;
            digits[top - 1] -= whole << (24 - scale);
            sign = digits[top - 1] >> (23 - scale);
        } else if (scale == 0) {
            sign = digits[top - 1] >> 23;
        } else if (z >= 0.5) {
            sign = 2;
        }
        // Above one half: one turn more, and the rest from there.
        if (sign > 0) {
            int carry = 0;
            turns += 1;
            for (i = 0; i < top; i += 1) {
                if (carry) {
                    digits[i] = 0xffffff - digits[i];
                } else if (digits[i] != 0) {
                    carry = 1;
                    digits[i] = 0x1000000 - digits[i];
                }
            }
            if (scale > 0) {
                digits[top - 1] &= scale == 1 ? 0x7fffff : 0x3fffff;
            }
            if (sign == 2) {
                z = 1.0 - z;
                if (carry) {
                    z -= program_power_of_two(scale);
                }
            }
        }
        zero = z == 0.0;
        for (i = 4; i < top; i += 1) {
            zero = zero && digits[i] == 0;
        }
        if (!zero) {
            break;
        }
        // All digits cancelled: more of 2/pi is needed.
        k = 1;
        while (digits[4 - k] == 0) {
            k += 1;
        }
        top += k;
    }
    if (z == 0.0) {
        do {
            top -= 1;
            scale -= 24;
        } while (digits[top] == 0);
    } else {
        z *= program_power_of_two(-scale);
        if (z >= 16777216.0) {
            const double carried = (double)(int)(5.9604644775390625e-8 * z);
            digits[top] = (int)(z - 16777216.0 * carried);
            top += 1;
            scale += 24;
            digits[top] = (int)carried;
        } else {
            digits[top] = (int)z;
        }
    }
    // Times pi/2, the small terms first.
    unit = program_power_of_two(scale);
    for (i = top; i >= 0; i -= 1) {
        parts[i] = unit * digits[i];
        unit *= 5.9604644775390625e-8;
    }
    for (i = top; i >= 0; i -= 1) {
        sum = 0.0;
        for (k = 0; k <= 4 && k <= top - i; k += 1) {
            sum += program_half_pi[k] * parts[i + k];
        }
        products[top - i] = sum;
    }
    rest[0] = 0.0;
    for (i = top; i >= 0; i -= 1) {
        rest[0] += products[i];
    }
    rest[1] = products[0] - rest[0];
    for (i = 1; i <= top; i += 1) {
        rest[1] += products[i];
    }
    if (sign != 0) {
        rest[0] = -rest[0];
        rest[1] = -rest[1];
    }
    return turns;
}

// The bits of an exponent by which a difference is smaller.
static int program_cancelled(int field, double y) {
    return field - (int)((program_bits(y) >> 52) & 0x7ff);
}

// The quarter turns next to an angle beyond 800000, and the rest in two parts (fdlibm, e_rem_pio2.c, with the notice
// above).
static int program_rest(double x, double rest[2]) {
    const int field = (int)((program_bits(x) >> 52) & 0x7ff);
    double turns, r, w;
    if ((program_bits(x) >> 32 & 0x7fffffff) >= 0x413921fb) {
        const int large = program_rest_of_large(fabs(x), rest);
        if (x < 0.0) {
            rest[0] = -rest[0];
            rest[1] = -rest[1];
            return -large;
        }
        return large;
    }
    turns = (x * 6.36619772367581382433e-01 + 6755399441055744.0) - 6755399441055744.0;
    r = x - turns * 1.57079632673412561417e+00;
    w = turns * 6.07710050650619224932e-11;
    rest[0] = r - w;
    if (program_cancelled(field, rest[0]) > 16) {
        double t = r;
        w = turns * 6.07710050630396597660e-11;
        r = t - w;
        w = turns * 2.02226624879595063154e-21 - ((t - r) - w);
        rest[0] = r - w;
        if (program_cancelled(field, rest[0]) > 49) {
            t = r;
            w = turns * 2.02226624871116645580e-21;
            r = t - w;
            w = turns * 8.47842766036889956997e-32 - ((t - r) - w);
            rest[0] = r - w;
        }
    }
    rest[1] = (r - rest[0]) - w;
    return (int)turns;
}

// Sine and cosine of an angle beyond 800000, where the library uses those of fdlibm (k_sin.c, k_cos.c, with the notice
// above).
static void program_far(double angle, double out[2]) {
    double rest[2], x, y, z, w, r, v, t, sine, half, whole, cosine;
    int turns;
    if (!(fabs(angle) <= 1.7976931348623157e308)) {
        out[0] = out[1] = angle - angle;
        return;
    }
    turns = program_rest(angle, rest);
    x = rest[0];
    y = rest[1];
    z = x * x;
    w = z * z;
    r = 8.33333333332248946124e-03
        + z * (-1.98412698298579493134e-04 + z * 2.75573137070700676789e-06)
        + z * w * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10);
    v = z * x;
    sine = x - ((z * (0.5 * y - v * r) - y) - v * -1.66666666666666324348e-01);
    t = z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * 2.48015872894767294178e-05))
        + w * w * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11));
    half = 0.5 * z;
    whole = 1.0 - half;
    cosine = whole + (((1.0 - whole) - half) + (z * t - x * y));
    switch (turns & 3) {
        case 0: out[0] = sine; out[1] = cosine; return;
        case 1: out[0] = cosine; out[1] = -sine; return;
        case 2: out[0] = -sine; out[1] = -cosine; return;
        default: out[0] = -cosine; out[1] = sine; return;
    }
}
