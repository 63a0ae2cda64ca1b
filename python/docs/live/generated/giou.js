// Written by geograd. In 64-bit floats, with the bits of the library.

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

// The power of two that brings a positive number into [2, 4): exponent field e becomes 2 * bias + 1 - e.
function program_binade(x) {
    const normal = x < 2.2250738585072014e-308 ? 2.2250738585072014e-308 : x;
    return program_of_words(0x7ff00000 - (program_high_word(normal) & 0x7ff00000), 0);
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

// The sine.
function program_sin(x) {
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
function program_cos(x) {
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

/**
 * @param {ArrayLike<number>} x a.x, a.y, a.width, a.height, a.heading, b.x, b.y, b.width, b.height, b.heading
 * @returns {number[]} 11 numbers, all NaN if a number of x is NaN
 */
export function giou(x) {
    let sum = 0;
    for (let i = 0; i < 10; i += 1) {
        sum += x[i];
    }
    if (sum !== sum) {
        return new Array(11).fill(NaN);
    }
    const v0 = x[2];
    const v1 = 0.5;
    const v2 = v0 * v1;
    const v3 = 1.7976931348623157e308;
    const v4 = x[5];
    const v5 = v4 * v1;
    const v6 = x[0];
    const v7 = v6 * v1;
    const v8 = v5 - v7;
    const v9 = Math.abs(v8);
    const v10 = x[6];
    const v11 = v10 * v1;
    const v12 = x[1];
    const v13 = v12 * v1;
    const v14 = v11 - v13;
    const v15 = Math.abs(v14);
    const v16 = v9 > v15 ? v9 : v15;
    const v17 = 0.0;
    const v18 = v16 <= v17;
    const v19 = 1.0;
    const v20 = v18 ? v19 : v16;
    const v21 = program_binade(v20);
    const v22 = 1048576.0;
    const v23 = v21 * v22;
    const v24 = v3 < v23;
    const v25 = v24 ? v3 : v23;
    const v26 = -1.7976931348623157e308;
    const v27 = v25 < v26;
    const v28 = v27 ? v26 : v25;
    const v29 = x[3];
    const v30 = v29 * v1;
    const v31 = v2 > v30 ? v2 : v30;
    const v32 = x[7];
    const v33 = v32 * v1;
    const v34 = x[8];
    const v35 = v34 * v1;
    const v36 = v33 > v35 ? v33 : v35;
    const v37 = v31 > v36 ? v31 : v36;
    const v38 = v37 <= v17;
    const v39 = v31 < v36 ? v31 : v36;
    const v40 = v39 <= v17;
    const v41 = 1.734723475976807e-18;
    const v42 = v37 * v41;
    const v43 = v39 > v42 ? v39 : v42;
    const v44 = v40 ? v37 : v43;
    const v45 = v44 <= v17;
    const v46 = v45 ? v19 : v44;
    const v47 = program_binade(v46);
    const v48 = v45 ? v19 : v47;
    const v49 = 1125899906842624.0;
    const v50 = v38 ? v19 : v37;
    const v51 = program_binade(v50);
    const v52 = v49 * v51;
    const v53 = v3 < v52;
    const v54 = v53 ? v3 : v52;
    const v55 = v54 < v26;
    const v56 = v55 ? v26 : v54;
    const v57 = v38 ? v48 : v56;
    const v58 = v57 < v48;
    const v59 = v58 ? v57 : v48;
    const v60 = v28 < v59;
    const v61 = v60 ? v28 : v59;
    const v62 = 9.094947017729282e-13;
    const v63 = v59 * v62;
    const v64 = v62 * v63;
    const v65 = v61 < v64;
    const v66 = v65 ? v64 : v61;
    const v67 = v2 * v66;
    const v68 = v67 + v67;
    const v69 = v30 * v66;
    const v70 = v69 + v69;
    const v71 = v68 * v70;
    const v72 = v33 * v66;
    const v73 = v72 + v72;
    const v74 = v35 * v66;
    const v75 = v74 + v74;
    const v76 = v73 * v75;
    const v77 = v71 + v76;
    const v78 = x[4];
    const v79 = program_cos(v78);
    const v80 = x[9];
    const v81 = program_cos(v80);
    const v82 = v79 * v81;
    const v83 = program_sin(v78);
    const v84 = program_sin(v80);
    const v85 = v83 * v84;
    const v86 = v82 + v85;
    const v87 = Math.abs(v86);
    const v88 = v79 * v84;
    const v89 = v83 * v81;
    const v90 = v88 - v89;
    const v91 = Math.abs(v90);
    const v92 = v87 < v91;
    const v93 = v92 ? v74 : v72;
    const v94 = v92 ? v90 : v86;
    const v95 = v94 < v17;
    const v96 = -v86;
    const v97 = v92 ? v96 : v90;
    const v98 = -v97;
    const v99 = v95 ? v98 : v97;
    const v100 = Math.abs(v99);
    const v101 = 4e-16;
    const v102 = v100 < v101;
    const v103 = -v94;
    const v104 = v95 ? v103 : v94;
    const v105 = v102 ? v19 : v104;
    const v106 = v93 * v105;
    const v107 = v92 ? v72 : v74;
    const v108 = v102 ? v17 : v99;
    const v109 = Math.abs(v108);
    const v110 = v107 * v109;
    const v111 = v106 + v110;
    const v112 = v67 + v111;
    const v113 = v4 - v6;
    const v114 = v66 * v113;
    const v115 = Math.abs(v114);
    const v116 = 4.611686018427388e18;
    const v117 = v115 <= v116;
    const v118 = v114 < v17;
    const v119 = -4.611686018427388e18;
    const v120 = v118 ? v119 : v116;
    const v121 = v117 ? v114 : v120;
    const v122 = v79 * v121;
    const v123 = v10 - v12;
    const v124 = v66 * v123;
    const v125 = Math.abs(v124);
    const v126 = v125 <= v116;
    const v127 = v124 < v17;
    const v128 = v127 ? v119 : v116;
    const v129 = v126 ? v124 : v128;
    const v130 = v83 * v129;
    const v131 = v122 + v130;
    const v132 = Math.abs(v131);
    const v133 = v112 <= v132;
    const v134 = v107 * v105;
    const v135 = v93 * v109;
    const v136 = v134 + v135;
    const v137 = v69 + v136;
    const v138 = v79 * v129;
    const v139 = v83 * v121;
    const v140 = v138 - v139;
    const v141 = Math.abs(v140);
    const v142 = v137 <= v141;
    const v143 = v133 || v142;
    const v144 = v67 * v105;
    const v145 = v69 * v109;
    const v146 = v144 + v145;
    const v147 = v93 + v146;
    const v148 = v131 * v105;
    const v149 = v140 * v108;
    const v150 = v148 + v149;
    const v151 = Math.abs(v150);
    const v152 = v147 <= v151;
    const v153 = v69 * v105;
    const v154 = v67 * v109;
    const v155 = v153 + v154;
    const v156 = v107 + v155;
    const v157 = v140 * v105;
    const v158 = v131 * v108;
    const v159 = v157 - v158;
    const v160 = Math.abs(v159);
    const v161 = v156 <= v160;
    const v162 = v152 || v161;
    const v163 = v143 || v162;
    const v164 = v93 + v93;
    const v165 = v107 + v107;
    const v166 = v164 * v165;
    const v167 = v71 < v166 ? v71 : v166;
    const v168 = -v69;
    const v169 = v140 > v168 ? v140 : v168;
    const v170 = v169 < v69 ? v169 : v69;
    const v171 = v140 - v170;
    const v172 = v93 * v108;
    const v173 = v172 - v134;
    const v174 = v171 + v173;
    const v175 = v69 + v170;
    const v176 = -v175;
    const v177 = v174 > v176 ? v174 : v176;
    const v178 = v69 - v170;
    const v179 = v177 < v178 ? v177 : v178;
    const v180 = v134 + v172;
    const v181 = v171 - v180;
    const v182 = v181 > v176 ? v181 : v176;
    const v183 = v182 < v178 ? v182 : v178;
    const v184 = v179 - v183;
    const v185 = -v67;
    const v186 = v131 > v185 ? v131 : v185;
    const v187 = v186 < v67 ? v186 : v67;
    const v188 = v131 - v187;
    const v189 = v107 * v108;
    const v190 = v106 - v189;
    const v191 = v188 - v190;
    const v192 = v102 ? v19 : v99;
    const v193 = v105 / v192;
    const v194 = v102 ? v17 : v193;
    const v195 = v181 - v183;
    const v196 = v194 * v195;
    const v197 = v191 - v196;
    const v198 = v67 + v187;
    const v199 = -v198;
    const v200 = v197 > v199 ? v197 : v199;
    const v201 = v67 - v187;
    const v202 = v200 < v201 ? v200 : v201;
    const v203 = v106 + v189;
    const v204 = v188 + v203;
    const v205 = v174 - v179;
    const v206 = v194 * v205;
    const v207 = v204 - v206;
    const v208 = v207 > v199 ? v207 : v199;
    const v209 = v208 < v201 ? v208 : v201;
    const v210 = v202 + v209;
    const v211 = v184 * v210;
    const v212 = v171 - v173;
    const v213 = v212 > v176 ? v212 : v176;
    const v214 = v213 < v178 ? v213 : v178;
    const v215 = v171 + v180;
    const v216 = v215 > v176 ? v215 : v176;
    const v217 = v216 < v178 ? v216 : v178;
    const v218 = v214 - v217;
    const v219 = v188 + v190;
    const v220 = v215 - v217;
    const v221 = v194 * v220;
    const v222 = v219 - v221;
    const v223 = v222 > v199 ? v222 : v199;
    const v224 = v223 < v201 ? v223 : v201;
    const v225 = v188 - v203;
    const v226 = v212 - v214;
    const v227 = v194 * v226;
    const v228 = v225 - v227;
    const v229 = v228 > v199 ? v228 : v199;
    const v230 = v229 < v201 ? v229 : v201;
    const v231 = v224 + v230;
    const v232 = v218 * v231;
    const v233 = v211 + v232;
    const v234 = v217 - v179;
    const v235 = v108 / v105;
    const v236 = v235 * v205;
    const v237 = v204 + v236;
    const v238 = v237 > v199 ? v237 : v199;
    const v239 = v238 < v201 ? v238 : v201;
    const v240 = v235 * v220;
    const v241 = v219 + v240;
    const v242 = v241 > v199 ? v241 : v199;
    const v243 = v242 < v201 ? v242 : v201;
    const v244 = v239 + v243;
    const v245 = v234 * v244;
    const v246 = v183 - v214;
    const v247 = v235 * v226;
    const v248 = v225 + v247;
    const v249 = v248 > v199 ? v248 : v199;
    const v250 = v249 < v201 ? v249 : v201;
    const v251 = v235 * v195;
    const v252 = v191 + v251;
    const v253 = v252 > v199 ? v252 : v199;
    const v254 = v253 < v201 ? v253 : v201;
    const v255 = v250 + v254;
    const v256 = v246 * v255;
    const v257 = v245 + v256;
    const v258 = v233 + v257;
    const v259 = v209 - v202;
    const v260 = v197 - v202;
    const v261 = v207 - v209;
    const v262 = v260 + v261;
    const v263 = v259 * v262;
    const v264 = v235 * v263;
    const v265 = v230 - v224;
    const v266 = v222 - v224;
    const v267 = v228 - v230;
    const v268 = v266 + v267;
    const v269 = v265 * v268;
    const v270 = v235 * v269;
    const v271 = v264 + v270;
    const v272 = v243 - v239;
    const v273 = v237 - v239;
    const v274 = v241 - v243;
    const v275 = v273 + v274;
    const v276 = v272 * v275;
    const v277 = v254 - v250;
    const v278 = v248 - v250;
    const v279 = v252 - v254;
    const v280 = v278 + v279;
    const v281 = v277 * v280;
    const v282 = v276 + v281;
    const v283 = v194 * v282;
    const v284 = v271 - v283;
    const v285 = v258 + v284;
    const v286 = v1 * v285;
    const v287 = v167 < v286;
    const v288 = v287 ? v167 : v286;
    const v289 = v288 < v17;
    const v290 = v163 || v289;
    const v291 = v290 ? v17 : v288;
    const v292 = v77 - v291;
    const v293 = 3.560118173611523e-307;
    const v294 = v292 <= v293;
    const v295 = v294 ? v19 : v292;
    const v296 = v291 / v295;
    const v297 = v294 ? v17 : v296;
    const v298 = v131 + v111;
    const v299 = v67 === v298;
    const v300 = v298 < v67;
    const v301 = v300 ? v19 : v17;
    const v302 = v299 ? v1 : v301;
    const v303 = v111 - v131;
    const v304 = v67 === v303;
    const v305 = v303 < v67;
    const v306 = v305 ? v19 : v17;
    const v307 = v304 ? v1 : v306;
    const v308 = v302 + v307;
    const v309 = v108 < v17;
    const v310 = -v140;
    const v311 = v309 ? v310 : v140;
    const v312 = v136 + v311;
    const v313 = v69 === v312;
    const v314 = v312 < v69;
    const v315 = v314 ? v19 : v17;
    const v316 = v313 ? v1 : v315;
    const v317 = v136 - v311;
    const v318 = v69 === v317;
    const v319 = v317 < v69;
    const v320 = v319 ? v19 : v17;
    const v321 = v318 ? v1 : v320;
    const v322 = v316 + v321;
    const v323 = v308 + v322;
    const v324 = v67 * v69;
    const v325 = v323 * v324;
    const v326 = 4.0;
    const v327 = v93 + v150;
    const v328 = v146 === v327;
    const v329 = v327 < v146;
    const v330 = v329 ? v19 : v17;
    const v331 = v328 ? v1 : v330;
    const v332 = v93 - v150;
    const v333 = v146 === v332;
    const v334 = v332 < v146;
    const v335 = v334 ? v19 : v17;
    const v336 = v333 ? v1 : v335;
    const v337 = v331 + v336;
    const v338 = -v159;
    const v339 = v309 ? v338 : v159;
    const v340 = v107 + v339;
    const v341 = v155 === v340;
    const v342 = v340 < v155;
    const v343 = v342 ? v19 : v17;
    const v344 = v341 ? v1 : v343;
    const v345 = v107 - v339;
    const v346 = v155 === v345;
    const v347 = v345 < v155;
    const v348 = v347 ? v19 : v17;
    const v349 = v346 ? v1 : v348;
    const v350 = v344 + v349;
    const v351 = v337 + v350;
    const v352 = v326 - v351;
    const v353 = v93 * v107;
    const v354 = v352 * v353;
    const v355 = v325 + v354;
    const v356 = v337 - v322;
    const v357 = v134 * v356;
    const v358 = v322 - v350;
    const v359 = v135 * v358;
    const v360 = v357 - v359;
    const v361 = v67 * v360;
    const v362 = v350 - v308;
    const v363 = v106 * v362;
    const v364 = v308 - v337;
    const v365 = v110 * v364;
    const v366 = v363 - v365;
    const v367 = v69 * v366;
    const v368 = v361 + v367;
    const v369 = v355 + v368;
    const v370 = v344 - v349;
    const v371 = v135 * v370;
    const v372 = v331 - v336;
    const v373 = v134 * v372;
    const v374 = v371 - v373;
    const v375 = v302 - v307;
    const v376 = v69 * v375;
    const v377 = v374 - v376;
    const v378 = v131 * v377;
    const v379 = v106 * v370;
    const v380 = v110 * v372;
    const v381 = v379 + v380;
    const v382 = v316 - v321;
    const v383 = v67 * v382;
    const v384 = v381 + v383;
    const v385 = v311 * v384;
    const v386 = v378 - v385;
    const v387 = v369 + v386;
    const v388 = v387 < v292;
    const v389 = v388 ? v292 : v387;
    const v390 = v389 <= v293;
    const v391 = v389 - v292;
    const v392 = v390 ? v19 : v389;
    const v393 = v391 / v392;
    const v394 = v390 ? v17 : v393;
    const v395 = v297 - v394;
    const v396 = v395 + 0.0;
    const v397 = v286 < v17;
    const v398 = v163 || v397;
    const v399 = v19 / v392;
    const v400 = v390 ? v17 : v399;
    const v401 = -v400;
    const v402 = v398 ? v17 : v401;
    const v403 = v17 === v274;
    const v404 = v273 * v274;
    const v405 = v17 < v404;
    const v406 = v194 * v274;
    const v407 = v217 + v406;
    const v408 = v407 < v179;
    const v409 = v408 ? v179 : v407;
    const v410 = v217 < v409;
    const v411 = v405 || v410;
    const v412 = v411 ? v217 : v409;
    const v413 = v403 ? v217 : v412;
    const v414 = v17 === v273;
    const v415 = v194 * v273;
    const v416 = v179 + v415;
    const v417 = v416 < v179;
    const v418 = v417 ? v179 : v416;
    const v419 = v217 < v418;
    const v420 = v405 || v419;
    const v421 = v420 ? v217 : v418;
    const v422 = v414 ? v179 : v421;
    const v423 = v413 - v422;
    const v424 = v199 === v239;
    const v425 = v201 === v239;
    const v426 = v424 || v425;
    const v427 = v414 && v426;
    const v428 = v102 && v427;
    const v429 = v1 * v423;
    const v430 = v428 ? v429 : v17;
    const v431 = v423 - v430;
    const v432 = v17 === v278;
    const v433 = v278 * v279;
    const v434 = v17 < v433;
    const v435 = v194 * v278;
    const v436 = v214 + v435;
    const v437 = v436 < v183;
    const v438 = v437 ? v183 : v436;
    const v439 = v214 < v438;
    const v440 = v434 || v439;
    const v441 = v440 ? v214 : v438;
    const v442 = v432 ? v214 : v441;
    const v443 = v17 === v279;
    const v444 = v194 * v279;
    const v445 = v183 + v444;
    const v446 = v445 < v183;
    const v447 = v446 ? v183 : v445;
    const v448 = v214 < v447;
    const v449 = v434 || v448;
    const v450 = v449 ? v214 : v447;
    const v451 = v443 ? v183 : v450;
    const v452 = v442 - v451;
    const v453 = v199 === v250;
    const v454 = v201 === v250;
    const v455 = v453 || v454;
    const v456 = v432 && v455;
    const v457 = v102 && v456;
    const v458 = v1 * v452;
    const v459 = v457 ? v458 : v17;
    const v460 = v452 - v459;
    const v461 = v431 - v460;
    const v462 = v220 * v226;
    const v463 = v17 < v462;
    const v464 = v224 - v230;
    const v465 = v463 ? v17 : v464;
    const v466 = v17 === v220;
    const v467 = v176 === v217;
    const v468 = v178 === v217;
    const v469 = v467 || v468;
    const v470 = v466 && v469;
    const v471 = v102 && v470;
    const v472 = v1 * v465;
    const v473 = v471 ? v472 : v17;
    const v474 = v465 - v473;
    const v475 = v195 * v205;
    const v476 = v17 < v475;
    const v477 = v476 ? v17 : v259;
    const v478 = v17 === v195;
    const v479 = v176 === v183;
    const v480 = v178 === v183;
    const v481 = v479 || v480;
    const v482 = v478 && v481;
    const v483 = v102 && v482;
    const v484 = v1 * v477;
    const v485 = v483 ? v484 : v17;
    const v486 = v477 - v485;
    const v487 = v474 - v486;
    const v488 = v235 * v487;
    const v489 = v461 - v488;
    const v490 = v398 ? v17 : v489;
    const v491 = v402 * v490;
    const v492 = -1.1235582092889473e307;
    const v493 = v491 > v492 ? v491 : v492;
    const v494 = 1.1235582092889473e307;
    const v495 = v493 < v494 ? v493 : v494;
    const v496 = v292 === v389;
    const v497 = v292 * v400;
    const v498 = v496 ? v19 : v497;
    const v499 = v400 * v498;
    const v500 = v377 * v499;
    const v501 = -v500;
    const v502 = v501 > v492 ? v501 : v492;
    const v503 = v502 < v494 ? v502 : v494;
    const v504 = v495 + v503;
    const v505 = v17 * v400;
    const v506 = v505 > v492 ? v505 : v492;
    const v507 = v506 < v494 ? v506 : v494;
    const v508 = v504 + v507;
    const v509 = v19 / v295;
    const v510 = v294 ? v17 : v509;
    const v511 = v291 * v510;
    const v512 = v510 * v511;
    const v513 = v510 + v512;
    const v514 = v398 ? v17 : v513;
    const v515 = v514 * v490;
    const v516 = v515 > v492 ? v515 : v492;
    const v517 = v516 < v494 ? v516 : v494;
    const v518 = v17 * v512;
    const v519 = -v518;
    const v520 = v519 > v492 ? v519 : v492;
    const v521 = v520 < v494 ? v520 : v494;
    const v522 = v517 + v521;
    const v523 = v508 + v522;
    const v524 = v79 * v523;
    const v525 = v235 * v461;
    const v526 = v487 + v525;
    const v527 = v398 ? v17 : v526;
    const v528 = v402 * v527;
    const v529 = v528 > v492 ? v528 : v492;
    const v530 = v529 < v494 ? v529 : v494;
    const v531 = -v384;
    const v532 = v309 ? v384 : v531;
    const v533 = v499 * v532;
    const v534 = -v533;
    const v535 = v534 > v492 ? v534 : v492;
    const v536 = v535 < v494 ? v535 : v494;
    const v537 = v530 + v536;
    const v538 = v507 + v537;
    const v539 = v514 * v527;
    const v540 = v539 > v492 ? v539 : v492;
    const v541 = v540 < v494 ? v540 : v494;
    const v542 = v521 + v541;
    const v543 = v538 + v542;
    const v544 = v83 * v543;
    const v545 = v524 - v544;
    const v546 = v66 * v545;
    const v547 = -v546;
    const v548 = v3 < v547;
    const v549 = v548 ? v3 : v547;
    const v550 = v549 < v26;
    const v551 = v550 ? v26 : v549;
    const v552 = v3 < v551;
    const v553 = v552 ? v3 : v551;
    const v554 = v553 < v26;
    const v555 = v554 ? v26 : v553;
    const v556 = v555 + 0.0;
    const v557 = v83 * v523;
    const v558 = v79 * v543;
    const v559 = v557 + v558;
    const v560 = v66 * v559;
    const v561 = -v560;
    const v562 = v3 < v561;
    const v563 = v562 ? v3 : v561;
    const v564 = v563 < v26;
    const v565 = v564 ? v26 : v563;
    const v566 = v3 < v565;
    const v567 = v566 ? v3 : v565;
    const v568 = v567 < v26;
    const v569 = v568 ? v26 : v567;
    const v570 = v569 + 0.0;
    const v571 = v260 * v261;
    const v572 = v17 < v571;
    const v573 = v261 < v17;
    const v574 = -v184;
    const v575 = v573 ? v574 : v184;
    const v576 = Math.abs(v261);
    const v577 = Math.abs(v260);
    const v578 = v576 - v577;
    const v579 = v235 * v578;
    const v580 = v572 ? v575 : v579;
    const v581 = v476 ? v17 : v580;
    const v582 = v266 * v267;
    const v583 = v17 < v582;
    const v584 = v267 < v17;
    const v585 = -v218;
    const v586 = v584 ? v585 : v218;
    const v587 = Math.abs(v267);
    const v588 = Math.abs(v266);
    const v589 = v587 - v588;
    const v590 = v235 * v589;
    const v591 = v583 ? v586 : v590;
    const v592 = v463 ? v17 : v591;
    const v593 = v581 + v592;
    const v594 = v273 < v17;
    const v595 = v422 - v179;
    const v596 = -v595;
    const v597 = v594 ? v596 : v595;
    const v598 = v274 < v17;
    const v599 = v217 - v413;
    const v600 = -v599;
    const v601 = v598 ? v600 : v599;
    const v602 = v597 + v601;
    const v603 = v279 < v17;
    const v604 = v451 - v183;
    const v605 = -v604;
    const v606 = v603 ? v605 : v604;
    const v607 = v278 < v17;
    const v608 = v214 - v442;
    const v609 = -v608;
    const v610 = v607 ? v609 : v608;
    const v611 = v606 + v610;
    const v612 = v602 - v611;
    const v613 = v593 + v612;
    const v614 = v430 + v459;
    const v615 = v613 + v614;
    const v616 = v398 ? v17 : v615;
    const v617 = v402 * v616;
    const v618 = v617 > v492 ? v617 : v492;
    const v619 = v618 < v494 ? v618 : v494;
    const v620 = v69 * v323;
    const v621 = v360 + v620;
    const v622 = v311 * v382;
    const v623 = v621 - v622;
    const v624 = v499 * v623;
    const v625 = -v624;
    const v626 = v625 > v492 ? v625 : v492;
    const v627 = v626 < v494 ? v626 : v494;
    const v628 = v619 + v627;
    const v629 = v69 * v326;
    const v630 = v400 * v629;
    const v631 = v630 > v492 ? v630 : v492;
    const v632 = v631 < v494 ? v631 : v494;
    const v633 = v628 + v632;
    const v634 = v514 * v616;
    const v635 = v634 > v492 ? v634 : v492;
    const v636 = v635 < v494 ? v635 : v494;
    const v637 = v512 * v629;
    const v638 = -v637;
    const v639 = v638 > v492 ? v638 : v492;
    const v640 = v639 < v494 ? v639 : v494;
    const v641 = v636 + v640;
    const v642 = v633 + v641;
    const v643 = v1 * v642;
    const v644 = v66 * v643;
    const v645 = v3 < v644;
    const v646 = v645 ? v3 : v644;
    const v647 = v646 < v26;
    const v648 = v647 ? v26 : v646;
    const v649 = v3 < v648;
    const v650 = v649 ? v3 : v648;
    const v651 = v650 < v26;
    const v652 = v651 ? v26 : v650;
    const v653 = v652 + 0.0;
    const v654 = v205 < v17;
    const v655 = -v209;
    const v656 = v654 ? v655 : v209;
    const v657 = v195 < v17;
    const v658 = -v202;
    const v659 = v657 ? v658 : v202;
    const v660 = v656 - v659;
    const v661 = v476 ? v17 : v660;
    const v662 = v226 < v17;
    const v663 = -v230;
    const v664 = v662 ? v663 : v230;
    const v665 = v220 < v17;
    const v666 = -v224;
    const v667 = v665 ? v666 : v224;
    const v668 = v664 - v667;
    const v669 = v463 ? v17 : v668;
    const v670 = v661 + v669;
    const v671 = v205 * v220;
    const v672 = v17 < v671;
    const v673 = -v243;
    const v674 = v665 ? v673 : v243;
    const v675 = -v239;
    const v676 = v654 ? v675 : v239;
    const v677 = v674 - v676;
    const v678 = v672 ? v17 : v677;
    const v679 = v195 * v226;
    const v680 = v17 < v679;
    const v681 = -v254;
    const v682 = v657 ? v681 : v254;
    const v683 = -v250;
    const v684 = v662 ? v683 : v250;
    const v685 = v682 - v684;
    const v686 = v680 ? v17 : v685;
    const v687 = v678 + v686;
    const v688 = v670 + v687;
    const v689 = v485 + v473;
    const v690 = v688 + v689;
    const v691 = v398 ? v17 : v690;
    const v692 = v402 * v691;
    const v693 = v692 > v492 ? v692 : v492;
    const v694 = v693 < v494 ? v693 : v494;
    const v695 = v67 * v323;
    const v696 = v366 + v695;
    const v697 = v131 * v375;
    const v698 = v696 - v697;
    const v699 = v499 * v698;
    const v700 = -v699;
    const v701 = v700 > v492 ? v700 : v492;
    const v702 = v701 < v494 ? v701 : v494;
    const v703 = v694 + v702;
    const v704 = v67 * v326;
    const v705 = v400 * v704;
    const v706 = v705 > v492 ? v705 : v492;
    const v707 = v706 < v494 ? v706 : v494;
    const v708 = v703 + v707;
    const v709 = v514 * v691;
    const v710 = v709 > v492 ? v709 : v492;
    const v711 = v710 < v494 ? v710 : v494;
    const v712 = v512 * v704;
    const v713 = -v712;
    const v714 = v713 > v492 ? v713 : v492;
    const v715 = v714 < v494 ? v714 : v494;
    const v716 = v711 + v715;
    const v717 = v708 + v716;
    const v718 = v1 * v717;
    const v719 = v66 * v718;
    const v720 = v3 < v719;
    const v721 = v720 ? v3 : v719;
    const v722 = v721 < v26;
    const v723 = v722 ? v26 : v721;
    const v724 = v3 < v723;
    const v725 = v724 ? v3 : v723;
    const v726 = v725 < v26;
    const v727 = v726 ? v26 : v725;
    const v728 = v727 + 0.0;
    const v729 = v1 * v231;
    const v730 = v188 - v189;
    const v731 = v729 - v730;
    const v732 = v474 * v731;
    const v733 = v1 * v210;
    const v734 = v188 + v189;
    const v735 = v733 - v734;
    const v736 = v486 * v735;
    const v737 = v732 - v736;
    const v738 = v451 + v442;
    const v739 = v1 * v738;
    const v740 = v171 - v172;
    const v741 = v739 - v740;
    const v742 = v460 * v741;
    const v743 = v422 + v413;
    const v744 = v1 * v743;
    const v745 = v171 + v172;
    const v746 = v744 - v745;
    const v747 = v431 * v746;
    const v748 = v742 - v747;
    const v749 = v737 + v748;
    const v750 = v19 / v105;
    const v751 = v750 * v750;
    const v752 = v749 * v751;
    const v753 = v398 ? v17 : v752;
    const v754 = v402 * v753;
    const v755 = v754 > v492 ? v754 : v492;
    const v756 = v755 < v494 ? v755 : v494;
    const v757 = v131 * v370;
    const v758 = v67 * v358;
    const v759 = v757 - v758;
    const v760 = v106 * v759;
    const v761 = v69 * v362;
    const v762 = v311 * v370;
    const v763 = v761 - v762;
    const v764 = v135 * v763;
    const v765 = v760 - v764;
    const v766 = v69 * v364;
    const v767 = v311 * v372;
    const v768 = v766 + v767;
    const v769 = v134 * v768;
    const v770 = v67 * v356;
    const v771 = v131 * v372;
    const v772 = v770 - v771;
    const v773 = v110 * v772;
    const v774 = v769 + v773;
    const v775 = v765 - v774;
    const v776 = -v775;
    const v777 = v309 ? v776 : v775;
    const v778 = v499 * v777;
    const v779 = -v778;
    const v780 = v779 > v492 ? v779 : v492;
    const v781 = v780 < v494 ? v780 : v494;
    const v782 = v756 + v781;
    const v783 = v507 + v782;
    const v784 = v514 * v753;
    const v785 = v784 > v492 ? v784 : v492;
    const v786 = v785 < v494 ? v785 : v494;
    const v787 = v521 + v786;
    const v788 = v783 + v787;
    const v789 = v131 * v543;
    const v790 = v789 > v492 ? v789 : v492;
    const v791 = v790 < v494 ? v790 : v494;
    const v792 = v140 * v523;
    const v793 = v792 > v492 ? v792 : v492;
    const v794 = v793 < v494 ? v793 : v494;
    const v795 = v791 - v794;
    const v796 = v788 + v795;
    const v797 = -v796;
    const v798 = v3 < v797;
    const v799 = v798 ? v3 : v797;
    const v800 = v799 < v26;
    const v801 = v800 ? v26 : v799;
    const v802 = v3 < v801;
    const v803 = v802 ? v3 : v801;
    const v804 = v803 < v26;
    const v805 = v804 ? v26 : v803;
    const v806 = v805 + 0.0;
    const v807 = v3 < v546;
    const v808 = v807 ? v3 : v546;
    const v809 = v808 < v26;
    const v810 = v809 ? v26 : v808;
    const v811 = v3 < v810;
    const v812 = v811 ? v3 : v810;
    const v813 = v812 < v26;
    const v814 = v813 ? v26 : v812;
    const v815 = v814 + 0.0;
    const v816 = v3 < v560;
    const v817 = v816 ? v3 : v560;
    const v818 = v817 < v26;
    const v819 = v818 ? v26 : v817;
    const v820 = v3 < v819;
    const v821 = v820 ? v3 : v819;
    const v822 = v821 < v26;
    const v823 = v822 ? v26 : v821;
    const v824 = v823 + 0.0;
    const v825 = v486 + v474;
    const v826 = v750 * v825;
    const v827 = v431 + v460;
    const v828 = v750 * v827;
    const v829 = v92 ? v826 : v828;
    const v830 = v398 ? v17 : v829;
    const v831 = v402 * v830;
    const v832 = v831 > v492 ? v831 : v492;
    const v833 = v832 < v494 ? v832 : v494;
    const v834 = v93 * v352;
    const v835 = v105 * v772;
    const v836 = v109 * v768;
    const v837 = v835 - v836;
    const v838 = v834 + v837;
    const v839 = v107 * v352;
    const v840 = v105 * v763;
    const v841 = v109 * v759;
    const v842 = v840 + v841;
    const v843 = v839 + v842;
    const v844 = v92 ? v838 : v843;
    const v845 = v499 * v844;
    const v846 = -v845;
    const v847 = v846 > v492 ? v846 : v492;
    const v848 = v847 < v494 ? v847 : v494;
    const v849 = v833 + v848;
    const v850 = v74 * v326;
    const v851 = v400 * v850;
    const v852 = v851 > v492 ? v851 : v492;
    const v853 = v852 < v494 ? v852 : v494;
    const v854 = v849 + v853;
    const v855 = v514 * v830;
    const v856 = v855 > v492 ? v855 : v492;
    const v857 = v856 < v494 ? v856 : v494;
    const v858 = v512 * v850;
    const v859 = -v858;
    const v860 = v859 > v492 ? v859 : v492;
    const v861 = v860 < v494 ? v860 : v494;
    const v862 = v857 + v861;
    const v863 = v854 + v862;
    const v864 = v1 * v863;
    const v865 = v66 * v864;
    const v866 = v3 < v865;
    const v867 = v866 ? v3 : v865;
    const v868 = v867 < v26;
    const v869 = v868 ? v26 : v867;
    const v870 = v3 < v869;
    const v871 = v870 ? v3 : v869;
    const v872 = v871 < v26;
    const v873 = v872 ? v26 : v871;
    const v874 = v873 + 0.0;
    const v875 = v92 ? v828 : v826;
    const v876 = v398 ? v17 : v875;
    const v877 = v402 * v876;
    const v878 = v877 > v492 ? v877 : v492;
    const v879 = v878 < v494 ? v878 : v494;
    const v880 = v92 ? v843 : v838;
    const v881 = v499 * v880;
    const v882 = -v881;
    const v883 = v882 > v492 ? v882 : v492;
    const v884 = v883 < v494 ? v883 : v494;
    const v885 = v879 + v884;
    const v886 = v72 * v326;
    const v887 = v400 * v886;
    const v888 = v887 > v492 ? v887 : v492;
    const v889 = v888 < v494 ? v888 : v494;
    const v890 = v885 + v889;
    const v891 = v514 * v876;
    const v892 = v891 > v492 ? v891 : v492;
    const v893 = v892 < v494 ? v892 : v494;
    const v894 = v512 * v886;
    const v895 = -v894;
    const v896 = v895 > v492 ? v895 : v492;
    const v897 = v896 < v494 ? v896 : v494;
    const v898 = v893 + v897;
    const v899 = v890 + v898;
    const v900 = v1 * v899;
    const v901 = v66 * v900;
    const v902 = v3 < v901;
    const v903 = v902 ? v3 : v901;
    const v904 = v903 < v26;
    const v905 = v904 ? v26 : v903;
    const v906 = v3 < v905;
    const v907 = v906 ? v3 : v905;
    const v908 = v907 < v26;
    const v909 = v908 ? v26 : v907;
    const v910 = v909 + 0.0;
    const v911 = v3 < v788;
    const v912 = v911 ? v3 : v788;
    const v913 = v912 < v26;
    const v914 = v913 ? v26 : v912;
    const v915 = v3 < v914;
    const v916 = v915 ? v3 : v914;
    const v917 = v916 < v26;
    const v918 = v917 ? v26 : v916;
    const v919 = v918 + 0.0;
    return [v396, v556, v570, v653, v728, v806, v815, v824, v874, v910, v919];
}
