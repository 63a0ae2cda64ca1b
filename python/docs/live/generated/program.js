// Written by geograd: what programs in 64-bit floats call.

// The bits of a number, to read and to write; the high word is first.
export const program_bits = new DataView(new ArrayBuffer(8));

// The number with these words.
export function program_of_words(high, low) {
    program_bits.setUint32(0, high);
    program_bits.setUint32(4, low);
    return program_bits.getFloat64(0);
}

// The high word of a number.
export function program_high_word(x) {
    program_bits.setFloat64(0, x);
    return program_bits.getUint32(0);
}

// Two to a whole power from -1022 to 1023.
export function program_power_of_two(k) {
    return program_of_words((k + 1023) << 20, 0);
}

// The exponent of a normal positive number.
export function program_exponent(x) {
    return (program_high_word(x) >>> 20) - 1023;
}

// The significand of a normal positive number, in [1, 2).
export function program_significand(x) {
    const high = program_high_word(x);
    return program_of_words((high & 0xfffff) | 0x3ff00000, program_bits.getUint32(4));
}

// 2/pi in parts of 24 bits, and pi/2 (fdlibm, k_rem_pio2.c).
export const program_two_over_pi = [
    0xa2f983, 0x6e4e44, 0x1529fc, 0x2757d1, 0xf534dd, 0xc0db62, 0x95993c, 0x439041, 0xfe5163, 0xabdebb, 0xc561b7,
    0x246e3a, 0x424dd2, 0xe00649, 0x2eea09, 0xd1921c, 0xfe1deb, 0x1cb129, 0xa73ee8, 0x8235f5, 0x2ebb44, 0x84e99c,
    0x7026b4, 0x5f7e41, 0x3991d6, 0x398353, 0x39f49c, 0x845f8b, 0xbdf928, 0x3b1ff8, 0x97ffde, 0x05980f, 0xef2f11,
    0x8b5a0a, 0x6d1f6d, 0x367ecf, 0x27cb09, 0xb74f46, 0x3f669e, 0x5fea2d, 0x7527ba, 0xc7ebe5, 0xf17b3d, 0x0739f7,
    0x8a5292, 0xea6bfb, 0x5fb11f, 0x8d5d08, 0x560330, 0x46fc7b, 0x6babf0, 0xcfbc20, 0x9af436, 0x1da9e3, 0x91615e,
    0xe61b08, 0x659985, 0x5f14a0, 0x68408d, 0xffd880, 0x4d7327, 0x310606, 0x1556ca, 0x73a8c9, 0x60e27b, 0xc08c6b,
];
export const program_half_pi = [
    1.57079625129699707031e+00, 7.54978941586159635335e-08, 5.39030252995776476554e-15, 3.28200341580791294123e-22,
    1.27065575308067607349e-29,
];

// The quarter turns next to a positive angle beyond 2^20 pi/2, and the rest in two parts: by the digits of 2/pi that
// count (fdlibm, k_rem_pio2.c, Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved. Permission to use,
// copy, modify, and distribute this software is freely granted, provided that this notice is preserved.)
export function program_rest_of_large(angle) {
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
export function program_rest(x) {
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
export function program_far(angle) {
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

// The power of two that brings a positive number into [2, 4): exponent field e becomes 2 * bias + 1 - e.
export function program_binade(x) {
    const normal = x < 2.2250738585072014e-308 ? 2.2250738585072014e-308 : x;
    return program_of_words(0x7ff00000 - (program_high_word(normal) & 0x7ff00000), 0);
}

// The sine.
export function program_sin(x) {
    if (!(Math.abs(x) <= 800000.0)) {
        return program_far(x)[0];
    }
    const v0 = 2.0;
    const v1 = 6755399441055744.0;
    const v2 = x;
    const v3 = 0.6366197723675814;
    const v4 = v2 * v3;
    const v5 = v1 + v4;
    const v6 = v5 - v1;
    const v7 = 0.25;
    const v8 = v6 * v7;
    const v9 = v1 + v8;
    const v10 = v9 - v1;
    const v11 = 4.0;
    const v12 = v10 * v11;
    const v13 = v6 - v12;
    const v14 = v13 * v13;
    const v15 = v0 < v14;
    const v16 = -1.0;
    const v17 = v13 === v16;
    const v18 = v15 || v17;
    const v19 = 1.0;
    const v20 = v19 === v14;
    const v21 = 1.5707963267341256;
    const v22 = v6 * v21;
    const v23 = v2 - v22;
    const v24 = 6.077100506303966e-11;
    const v25 = v6 * v24;
    const v26 = v23 - v25;
    const v27 = 2.0222662487959506e-21;
    const v28 = v6 * v27;
    const v29 = v26 - v28;
    const v30 = v29 * v29;
    const v31 = 0.5;
    const v32 = v30 * v31;
    const v33 = v19 - v32;
    const v34 = v19 - v33;
    const v35 = v34 - v32;
    const v36 = -1.1359647557788195e-11;
    const v37 = v30 * v36;
    const v38 = 2.087572321298175e-9;
    const v39 = v37 + v38;
    const v40 = v30 * v39;
    const v41 = -2.7557314351390663e-7;
    const v42 = v40 + v41;
    const v43 = v30 * v42;
    const v44 = 2.480158728947673e-5;
    const v45 = v43 + v44;
    const v46 = v30 * v45;
    const v47 = -0.001388888888887411;
    const v48 = v46 + v47;
    const v49 = v30 * v48;
    const v50 = 0.0416666666666666;
    const v51 = v49 + v50;
    const v52 = v30 * v30;
    const v53 = v51 * v52;
    const v54 = v35 + v53;
    const v55 = v33 + v54;
    const v56 = 1.58969099521155e-10;
    const v57 = v30 * v56;
    const v58 = -2.5050760253406863e-8;
    const v59 = v57 + v58;
    const v60 = v30 * v59;
    const v61 = 2.7557313707070068e-6;
    const v62 = v60 + v61;
    const v63 = v30 * v62;
    const v64 = -0.0001984126982985795;
    const v65 = v63 + v64;
    const v66 = v30 * v65;
    const v67 = 0.00833333333332249;
    const v68 = v66 + v67;
    const v69 = v30 * v68;
    const v70 = -0.16666666666666632;
    const v71 = v69 + v70;
    const v72 = v29 * v30;
    const v73 = v71 * v72;
    const v74 = v29 + v73;
    const v75 = v20 ? v55 : v74;
    const v76 = -v75;
    const v77 = v18 ? v76 : v75;
    return v77;
}

// The cosine.
export function program_cos(x) {
    if (!(Math.abs(x) <= 800000.0)) {
        return program_far(x)[1];
    }
    const v0 = 2.0;
    const v1 = 6755399441055744.0;
    const v2 = x;
    const v3 = 0.6366197723675814;
    const v4 = v2 * v3;
    const v5 = v1 + v4;
    const v6 = v5 - v1;
    const v7 = 0.25;
    const v8 = v6 * v7;
    const v9 = v1 + v8;
    const v10 = v9 - v1;
    const v11 = 4.0;
    const v12 = v10 * v11;
    const v13 = v6 - v12;
    const v14 = v13 * v13;
    const v15 = v0 < v14;
    const v16 = 1.0;
    const v17 = v16 === v13;
    const v18 = v15 || v17;
    const v19 = v16 === v14;
    const v20 = 1.5707963267341256;
    const v21 = v6 * v20;
    const v22 = v2 - v21;
    const v23 = 6.077100506303966e-11;
    const v24 = v6 * v23;
    const v25 = v22 - v24;
    const v26 = 2.0222662487959506e-21;
    const v27 = v6 * v26;
    const v28 = v25 - v27;
    const v29 = v28 * v28;
    const v30 = 1.58969099521155e-10;
    const v31 = v29 * v30;
    const v32 = -2.5050760253406863e-8;
    const v33 = v31 + v32;
    const v34 = v29 * v33;
    const v35 = 2.7557313707070068e-6;
    const v36 = v34 + v35;
    const v37 = v29 * v36;
    const v38 = -0.0001984126982985795;
    const v39 = v37 + v38;
    const v40 = v29 * v39;
    const v41 = 0.00833333333332249;
    const v42 = v40 + v41;
    const v43 = v29 * v42;
    const v44 = -0.16666666666666632;
    const v45 = v43 + v44;
    const v46 = v28 * v29;
    const v47 = v45 * v46;
    const v48 = v28 + v47;
    const v49 = 0.5;
    const v50 = v29 * v49;
    const v51 = v16 - v50;
    const v52 = v16 - v51;
    const v53 = v52 - v50;
    const v54 = -1.1359647557788195e-11;
    const v55 = v29 * v54;
    const v56 = 2.087572321298175e-9;
    const v57 = v55 + v56;
    const v58 = v29 * v57;
    const v59 = -2.7557314351390663e-7;
    const v60 = v58 + v59;
    const v61 = v29 * v60;
    const v62 = 2.480158728947673e-5;
    const v63 = v61 + v62;
    const v64 = v29 * v63;
    const v65 = -0.001388888888887411;
    const v66 = v64 + v65;
    const v67 = v29 * v66;
    const v68 = 0.0416666666666666;
    const v69 = v67 + v68;
    const v70 = v29 * v29;
    const v71 = v69 * v70;
    const v72 = v53 + v71;
    const v73 = v51 + v72;
    const v74 = v19 ? v48 : v73;
    const v75 = -v74;
    const v76 = v18 ? v75 : v74;
    return v76;
}

// The root; zero for zero and below. Engines use the processor's, which is the nearest number.
export function program_root(x) {
    return x <= 0 ? 0 : Math.sqrt(x);
}

// The exponential.
export function program_exp(x) {
    if (!(x === x)) {
        return x;
    }
    const v0 = 1.0;
    const v1 = x;
    const v2 = -746.0;
    const v3 = v1 > v2 ? v1 : v2;
    const v4 = 710.0;
    const v5 = v3 < v4 ? v3 : v4;
    const v6 = 1.4426950408889634;
    const v7 = v5 * v6;
    const v8 = 6755399441055744.0;
    const v9 = v7 + v8;
    const v10 = v9 - v8;
    const v11 = 0.6931471803691238;
    const v12 = v10 * v11;
    const v13 = v5 - v12;
    const v14 = 1.9082149292705877e-10;
    const v15 = v10 * v14;
    const v16 = v13 - v15;
    const v17 = v13 - v16;
    const v18 = v17 - v15;
    const v19 = v16 * v16;
    const v20 = 1.6059043836821613e-10;
    const v21 = v16 * v20;
    const v22 = 2.08767569878681e-9;
    const v23 = v21 + v22;
    const v24 = v16 * v23;
    const v25 = 2.505210838544172e-8;
    const v26 = v24 + v25;
    const v27 = v16 * v26;
    const v28 = 2.755731922398589e-7;
    const v29 = v27 + v28;
    const v30 = v16 * v29;
    const v31 = 2.755731922398589e-6;
    const v32 = v30 + v31;
    const v33 = v16 * v32;
    const v34 = 2.48015873015873e-5;
    const v35 = v33 + v34;
    const v36 = v16 * v35;
    const v37 = 0.0001984126984126984;
    const v38 = v36 + v37;
    const v39 = v16 * v38;
    const v40 = 0.001388888888888889;
    const v41 = v39 + v40;
    const v42 = v16 * v41;
    const v43 = 0.008333333333333333;
    const v44 = v42 + v43;
    const v45 = v16 * v44;
    const v46 = 0.041666666666666664;
    const v47 = v45 + v46;
    const v48 = v16 * v47;
    const v49 = 0.16666666666666666;
    const v50 = v48 + v49;
    const v51 = v16 * v50;
    const v52 = 0.5;
    const v53 = v51 + v52;
    const v54 = v19 * v53;
    const v55 = v18 + v54;
    const v56 = v16 + v55;
    const v57 = v0 + v56;
    const v58 = v10 * v52;
    const v59 = v8 + v58;
    const v60 = v59 - v8;
    const v61 = v10 - v60;
    return v57 * program_power_of_two(v60) * program_power_of_two(v61);
}

// The number, or 2^54 times it if it is subnormal.
export function program_normal(x) {
    const v0 = x;
    const v1 = 2.2250738585072014e-308;
    const v2 = v0 < v1;
    const v3 = 1.8014398509481984e16;
    const v4 = v0 * v3;
    const v5 = v2 ? v4 : v0;
    return v5;
}

// The logarithm of x, with the exponent and the significand of its normal number.
export function program_ln_from(x, exponent, significand) {
    const v0 = 0.0;
    const v1 = x;
    const v2 = v0 < v1;
    const v3 = 1.7976931348623157e308;
    const v4 = v1 <= v3;
    const v5 = v2 && v4;
    const v6 = exponent;
    const v7 = 2.2250738585072014e-308;
    const v8 = v1 < v7;
    const v9 = 54.0;
    const v10 = v8 ? v9 : v0;
    const v11 = v6 - v10;
    const v12 = 1.4142135623730951;
    const v13 = significand;
    const v14 = v12 < v13;
    const v15 = 1.0;
    const v16 = v14 ? v15 : v0;
    const v17 = v11 + v16;
    const v18 = 0.6931471803691238;
    const v19 = v17 * v18;
    const v20 = 0.5;
    const v21 = v13 * v20;
    const v22 = v14 ? v21 : v13;
    const v23 = v22 - v15;
    const v24 = v23 * v23;
    const v25 = v20 * v24;
    const v26 = 2.0;
    const v27 = v23 + v26;
    const v28 = v23 / v27;
    const v29 = v28 * v28;
    const v30 = 0.14798198605116586;
    const v31 = v29 * v30;
    const v32 = 0.15313837699209373;
    const v33 = v31 + v32;
    const v34 = v29 * v33;
    const v35 = 0.1818357216161805;
    const v36 = v34 + v35;
    const v37 = v29 * v36;
    const v38 = 0.22222198432149784;
    const v39 = v37 + v38;
    const v40 = v29 * v39;
    const v41 = 0.2857142874366239;
    const v42 = v40 + v41;
    const v43 = v29 * v42;
    const v44 = 0.3999999999940942;
    const v45 = v43 + v44;
    const v46 = v29 * v45;
    const v47 = 0.6666666666666735;
    const v48 = v46 + v47;
    const v49 = v29 * v48;
    const v50 = v25 + v49;
    const v51 = v28 * v50;
    const v52 = 1.9082149292705877e-10;
    const v53 = v17 * v52;
    const v54 = v51 + v53;
    const v55 = v25 - v54;
    const v56 = v55 - v23;
    const v57 = v19 - v56;
    const v58 = v0 === v1;
    const v59 = -Infinity;
    const v60 = v3 < v1;
    const v61 = Infinity;
    const v62 = NaN;
    const v63 = v60 ? v61 : v62;
    const v64 = v58 ? v59 : v63;
    const v65 = v5 ? v57 : v64;
    return v65;
}

// The natural logarithm.
export function program_ln(x) {
    const normal = program_normal(x);
    return program_ln_from(x, program_exponent(normal), program_significand(normal));
}
