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
export function iou(x) {
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
    const v3 = x[3];
    const v4 = v3 * v1;
    const v5 = v2 > v4 ? v2 : v4;
    const v6 = x[7];
    const v7 = v6 * v1;
    const v8 = x[8];
    const v9 = v8 * v1;
    const v10 = v7 > v9 ? v7 : v9;
    const v11 = v5 < v10 ? v5 : v10;
    const v12 = 0.0;
    const v13 = v11 <= v12;
    const v14 = v5 > v10 ? v5 : v10;
    const v15 = 1.734723475976807e-18;
    const v16 = v14 * v15;
    const v17 = v11 > v16 ? v11 : v16;
    const v18 = v13 ? v14 : v17;
    const v19 = v18 <= v12;
    const v20 = 1.0;
    const v21 = v19 ? v20 : v18;
    const v22 = program_binade(v21);
    const v23 = v19 ? v20 : v22;
    const v24 = v2 * v23;
    const v25 = v24 + v24;
    const v26 = v4 * v23;
    const v27 = v26 + v26;
    const v28 = v25 * v27;
    const v29 = v7 * v23;
    const v30 = v29 + v29;
    const v31 = v9 * v23;
    const v32 = v31 + v31;
    const v33 = v30 * v32;
    const v34 = v28 + v33;
    const v35 = x[4];
    const v36 = program_cos(v35);
    const v37 = x[9];
    const v38 = program_cos(v37);
    const v39 = v36 * v38;
    const v40 = program_sin(v35);
    const v41 = program_sin(v37);
    const v42 = v40 * v41;
    const v43 = v39 + v42;
    const v44 = Math.abs(v43);
    const v45 = v36 * v41;
    const v46 = v40 * v38;
    const v47 = v45 - v46;
    const v48 = Math.abs(v47);
    const v49 = v44 < v48;
    const v50 = v49 ? v31 : v29;
    const v51 = v49 ? v47 : v43;
    const v52 = v51 < v12;
    const v53 = -v43;
    const v54 = v49 ? v53 : v47;
    const v55 = -v54;
    const v56 = v52 ? v55 : v54;
    const v57 = Math.abs(v56);
    const v58 = 4e-16;
    const v59 = v57 < v58;
    const v60 = -v51;
    const v61 = v52 ? v60 : v51;
    const v62 = v59 ? v20 : v61;
    const v63 = v50 * v62;
    const v64 = v49 ? v29 : v31;
    const v65 = v59 ? v12 : v56;
    const v66 = Math.abs(v65);
    const v67 = v64 * v66;
    const v68 = v63 + v67;
    const v69 = v24 + v68;
    const v70 = x[5];
    const v71 = x[0];
    const v72 = v70 - v71;
    const v73 = v23 * v72;
    const v74 = Math.abs(v73);
    const v75 = 4.611686018427388e18;
    const v76 = v74 <= v75;
    const v77 = v73 < v12;
    const v78 = -4.611686018427388e18;
    const v79 = v77 ? v78 : v75;
    const v80 = v76 ? v73 : v79;
    const v81 = v36 * v80;
    const v82 = x[6];
    const v83 = x[1];
    const v84 = v82 - v83;
    const v85 = v23 * v84;
    const v86 = Math.abs(v85);
    const v87 = v86 <= v75;
    const v88 = v85 < v12;
    const v89 = v88 ? v78 : v75;
    const v90 = v87 ? v85 : v89;
    const v91 = v40 * v90;
    const v92 = v81 + v91;
    const v93 = Math.abs(v92);
    const v94 = v69 <= v93;
    const v95 = v64 * v62;
    const v96 = v50 * v66;
    const v97 = v95 + v96;
    const v98 = v26 + v97;
    const v99 = v36 * v90;
    const v100 = v40 * v80;
    const v101 = v99 - v100;
    const v102 = Math.abs(v101);
    const v103 = v98 <= v102;
    const v104 = v94 || v103;
    const v105 = v24 * v62;
    const v106 = v26 * v66;
    const v107 = v105 + v106;
    const v108 = v50 + v107;
    const v109 = v92 * v62;
    const v110 = v101 * v65;
    const v111 = v109 + v110;
    const v112 = Math.abs(v111);
    const v113 = v108 <= v112;
    const v114 = v26 * v62;
    const v115 = v24 * v66;
    const v116 = v114 + v115;
    const v117 = v64 + v116;
    const v118 = v101 * v62;
    const v119 = v92 * v65;
    const v120 = v118 - v119;
    const v121 = Math.abs(v120);
    const v122 = v117 <= v121;
    const v123 = v113 || v122;
    const v124 = v104 || v123;
    const v125 = v50 + v50;
    const v126 = v64 + v64;
    const v127 = v125 * v126;
    const v128 = v28 < v127 ? v28 : v127;
    const v129 = -v26;
    const v130 = v101 > v129 ? v101 : v129;
    const v131 = v130 < v26 ? v130 : v26;
    const v132 = v101 - v131;
    const v133 = v50 * v65;
    const v134 = v133 - v95;
    const v135 = v132 + v134;
    const v136 = v26 + v131;
    const v137 = -v136;
    const v138 = v135 > v137 ? v135 : v137;
    const v139 = v26 - v131;
    const v140 = v138 < v139 ? v138 : v139;
    const v141 = v95 + v133;
    const v142 = v132 - v141;
    const v143 = v142 > v137 ? v142 : v137;
    const v144 = v143 < v139 ? v143 : v139;
    const v145 = v140 - v144;
    const v146 = -v24;
    const v147 = v92 > v146 ? v92 : v146;
    const v148 = v147 < v24 ? v147 : v24;
    const v149 = v92 - v148;
    const v150 = v64 * v65;
    const v151 = v63 - v150;
    const v152 = v149 - v151;
    const v153 = v59 ? v20 : v56;
    const v154 = v62 / v153;
    const v155 = v59 ? v12 : v154;
    const v156 = v142 - v144;
    const v157 = v155 * v156;
    const v158 = v152 - v157;
    const v159 = v24 + v148;
    const v160 = -v159;
    const v161 = v158 > v160 ? v158 : v160;
    const v162 = v24 - v148;
    const v163 = v161 < v162 ? v161 : v162;
    const v164 = v63 + v150;
    const v165 = v149 + v164;
    const v166 = v135 - v140;
    const v167 = v155 * v166;
    const v168 = v165 - v167;
    const v169 = v168 > v160 ? v168 : v160;
    const v170 = v169 < v162 ? v169 : v162;
    const v171 = v163 + v170;
    const v172 = v145 * v171;
    const v173 = v132 - v134;
    const v174 = v173 > v137 ? v173 : v137;
    const v175 = v174 < v139 ? v174 : v139;
    const v176 = v132 + v141;
    const v177 = v176 > v137 ? v176 : v137;
    const v178 = v177 < v139 ? v177 : v139;
    const v179 = v175 - v178;
    const v180 = v149 + v151;
    const v181 = v176 - v178;
    const v182 = v155 * v181;
    const v183 = v180 - v182;
    const v184 = v183 > v160 ? v183 : v160;
    const v185 = v184 < v162 ? v184 : v162;
    const v186 = v149 - v164;
    const v187 = v173 - v175;
    const v188 = v155 * v187;
    const v189 = v186 - v188;
    const v190 = v189 > v160 ? v189 : v160;
    const v191 = v190 < v162 ? v190 : v162;
    const v192 = v185 + v191;
    const v193 = v179 * v192;
    const v194 = v172 + v193;
    const v195 = v178 - v140;
    const v196 = v65 / v62;
    const v197 = v196 * v166;
    const v198 = v165 + v197;
    const v199 = v198 > v160 ? v198 : v160;
    const v200 = v199 < v162 ? v199 : v162;
    const v201 = v196 * v181;
    const v202 = v180 + v201;
    const v203 = v202 > v160 ? v202 : v160;
    const v204 = v203 < v162 ? v203 : v162;
    const v205 = v200 + v204;
    const v206 = v195 * v205;
    const v207 = v144 - v175;
    const v208 = v196 * v187;
    const v209 = v186 + v208;
    const v210 = v209 > v160 ? v209 : v160;
    const v211 = v210 < v162 ? v210 : v162;
    const v212 = v196 * v156;
    const v213 = v152 + v212;
    const v214 = v213 > v160 ? v213 : v160;
    const v215 = v214 < v162 ? v214 : v162;
    const v216 = v211 + v215;
    const v217 = v207 * v216;
    const v218 = v206 + v217;
    const v219 = v194 + v218;
    const v220 = v170 - v163;
    const v221 = v158 - v163;
    const v222 = v168 - v170;
    const v223 = v221 + v222;
    const v224 = v220 * v223;
    const v225 = v196 * v224;
    const v226 = v191 - v185;
    const v227 = v183 - v185;
    const v228 = v189 - v191;
    const v229 = v227 + v228;
    const v230 = v226 * v229;
    const v231 = v196 * v230;
    const v232 = v225 + v231;
    const v233 = v204 - v200;
    const v234 = v198 - v200;
    const v235 = v202 - v204;
    const v236 = v234 + v235;
    const v237 = v233 * v236;
    const v238 = v215 - v211;
    const v239 = v209 - v211;
    const v240 = v213 - v215;
    const v241 = v239 + v240;
    const v242 = v238 * v241;
    const v243 = v237 + v242;
    const v244 = v155 * v243;
    const v245 = v232 - v244;
    const v246 = v219 + v245;
    const v247 = v1 * v246;
    const v248 = v128 < v247;
    const v249 = v248 ? v128 : v247;
    const v250 = v249 < v12;
    const v251 = v124 || v250;
    const v252 = v251 ? v12 : v249;
    const v253 = v34 - v252;
    const v254 = 3.560118173611523e-307;
    const v255 = v253 <= v254;
    const v256 = v255 ? v20 : v253;
    const v257 = v252 / v256;
    const v258 = v255 ? v12 : v257;
    const v259 = v258 + 0.0;
    const v260 = 1.7976931348623157e308;
    const v261 = v12 === v235;
    const v262 = v234 * v235;
    const v263 = v12 < v262;
    const v264 = v155 * v235;
    const v265 = v178 + v264;
    const v266 = v265 < v140;
    const v267 = v266 ? v140 : v265;
    const v268 = v178 < v267;
    const v269 = v263 || v268;
    const v270 = v269 ? v178 : v267;
    const v271 = v261 ? v178 : v270;
    const v272 = v12 === v234;
    const v273 = v155 * v234;
    const v274 = v140 + v273;
    const v275 = v274 < v140;
    const v276 = v275 ? v140 : v274;
    const v277 = v178 < v276;
    const v278 = v263 || v277;
    const v279 = v278 ? v178 : v276;
    const v280 = v272 ? v140 : v279;
    const v281 = v271 - v280;
    const v282 = v160 === v200;
    const v283 = v162 === v200;
    const v284 = v282 || v283;
    const v285 = v272 && v284;
    const v286 = v59 && v285;
    const v287 = v1 * v281;
    const v288 = v286 ? v287 : v12;
    const v289 = v281 - v288;
    const v290 = v12 === v239;
    const v291 = v239 * v240;
    const v292 = v12 < v291;
    const v293 = v155 * v239;
    const v294 = v175 + v293;
    const v295 = v294 < v144;
    const v296 = v295 ? v144 : v294;
    const v297 = v175 < v296;
    const v298 = v292 || v297;
    const v299 = v298 ? v175 : v296;
    const v300 = v290 ? v175 : v299;
    const v301 = v12 === v240;
    const v302 = v155 * v240;
    const v303 = v144 + v302;
    const v304 = v303 < v144;
    const v305 = v304 ? v144 : v303;
    const v306 = v175 < v305;
    const v307 = v292 || v306;
    const v308 = v307 ? v175 : v305;
    const v309 = v301 ? v144 : v308;
    const v310 = v300 - v309;
    const v311 = v160 === v211;
    const v312 = v162 === v211;
    const v313 = v311 || v312;
    const v314 = v290 && v313;
    const v315 = v59 && v314;
    const v316 = v1 * v310;
    const v317 = v315 ? v316 : v12;
    const v318 = v310 - v317;
    const v319 = v289 - v318;
    const v320 = v181 * v187;
    const v321 = v12 < v320;
    const v322 = v185 - v191;
    const v323 = v321 ? v12 : v322;
    const v324 = v12 === v181;
    const v325 = v137 === v178;
    const v326 = v139 === v178;
    const v327 = v325 || v326;
    const v328 = v324 && v327;
    const v329 = v59 && v328;
    const v330 = v1 * v323;
    const v331 = v329 ? v330 : v12;
    const v332 = v323 - v331;
    const v333 = v156 * v166;
    const v334 = v12 < v333;
    const v335 = v334 ? v12 : v220;
    const v336 = v12 === v156;
    const v337 = v137 === v144;
    const v338 = v139 === v144;
    const v339 = v337 || v338;
    const v340 = v336 && v339;
    const v341 = v59 && v340;
    const v342 = v1 * v335;
    const v343 = v341 ? v342 : v12;
    const v344 = v335 - v343;
    const v345 = v332 - v344;
    const v346 = v196 * v345;
    const v347 = v319 - v346;
    const v348 = v247 < v12;
    const v349 = v124 || v348;
    const v350 = v20 / v256;
    const v351 = v255 ? v12 : v350;
    const v352 = v258 * v351;
    const v353 = v351 + v352;
    const v354 = v349 ? v12 : v353;
    const v355 = v347 * v354;
    const v356 = v260 < v355;
    const v357 = v356 ? v260 : v355;
    const v358 = -1.7976931348623157e308;
    const v359 = v357 < v358;
    const v360 = v359 ? v358 : v357;
    const v361 = v36 * v360;
    const v362 = v196 * v319;
    const v363 = v345 + v362;
    const v364 = v363 * v354;
    const v365 = v260 < v364;
    const v366 = v365 ? v260 : v364;
    const v367 = v366 < v358;
    const v368 = v367 ? v358 : v366;
    const v369 = v40 * v368;
    const v370 = v361 - v369;
    const v371 = v23 * v370;
    const v372 = -v371;
    const v373 = v260 < v372;
    const v374 = v373 ? v260 : v372;
    const v375 = v374 < v358;
    const v376 = v375 ? v358 : v374;
    const v377 = v260 < v376;
    const v378 = v377 ? v260 : v376;
    const v379 = v378 < v358;
    const v380 = v379 ? v358 : v378;
    const v381 = v380 + 0.0;
    const v382 = v40 * v360;
    const v383 = v36 * v368;
    const v384 = v382 + v383;
    const v385 = v23 * v384;
    const v386 = -v385;
    const v387 = v260 < v386;
    const v388 = v387 ? v260 : v386;
    const v389 = v388 < v358;
    const v390 = v389 ? v358 : v388;
    const v391 = v260 < v390;
    const v392 = v391 ? v260 : v390;
    const v393 = v392 < v358;
    const v394 = v393 ? v358 : v392;
    const v395 = v394 + 0.0;
    const v396 = v221 * v222;
    const v397 = v12 < v396;
    const v398 = v222 < v12;
    const v399 = -v145;
    const v400 = v398 ? v399 : v145;
    const v401 = Math.abs(v222);
    const v402 = Math.abs(v221);
    const v403 = v401 - v402;
    const v404 = v196 * v403;
    const v405 = v397 ? v400 : v404;
    const v406 = v334 ? v12 : v405;
    const v407 = v227 * v228;
    const v408 = v12 < v407;
    const v409 = v228 < v12;
    const v410 = -v179;
    const v411 = v409 ? v410 : v179;
    const v412 = Math.abs(v228);
    const v413 = Math.abs(v227);
    const v414 = v412 - v413;
    const v415 = v196 * v414;
    const v416 = v408 ? v411 : v415;
    const v417 = v321 ? v12 : v416;
    const v418 = v406 + v417;
    const v419 = v234 < v12;
    const v420 = v280 - v140;
    const v421 = -v420;
    const v422 = v419 ? v421 : v420;
    const v423 = v235 < v12;
    const v424 = v178 - v271;
    const v425 = -v424;
    const v426 = v423 ? v425 : v424;
    const v427 = v422 + v426;
    const v428 = v240 < v12;
    const v429 = v309 - v144;
    const v430 = -v429;
    const v431 = v428 ? v430 : v429;
    const v432 = v239 < v12;
    const v433 = v175 - v300;
    const v434 = -v433;
    const v435 = v432 ? v434 : v433;
    const v436 = v431 + v435;
    const v437 = v427 - v436;
    const v438 = v418 + v437;
    const v439 = v288 + v317;
    const v440 = v438 + v439;
    const v441 = v1 * v354;
    const v442 = v440 * v441;
    const v443 = v260 < v442;
    const v444 = v443 ? v260 : v442;
    const v445 = v444 < v358;
    const v446 = v445 ? v358 : v444;
    const v447 = v258 + v258;
    const v448 = v26 * v351;
    const v449 = v260 < v448;
    const v450 = v449 ? v260 : v448;
    const v451 = v450 < v358;
    const v452 = v451 ? v358 : v450;
    const v453 = v447 * v452;
    const v454 = -v453;
    const v455 = v260 < v454;
    const v456 = v455 ? v260 : v454;
    const v457 = v456 < v358;
    const v458 = v457 ? v358 : v456;
    const v459 = v446 + v458;
    const v460 = v23 * v459;
    const v461 = v260 < v460;
    const v462 = v461 ? v260 : v460;
    const v463 = v462 < v358;
    const v464 = v463 ? v358 : v462;
    const v465 = v260 < v464;
    const v466 = v465 ? v260 : v464;
    const v467 = v466 < v358;
    const v468 = v467 ? v358 : v466;
    const v469 = v468 + 0.0;
    const v470 = v166 < v12;
    const v471 = -v170;
    const v472 = v470 ? v471 : v170;
    const v473 = v156 < v12;
    const v474 = -v163;
    const v475 = v473 ? v474 : v163;
    const v476 = v472 - v475;
    const v477 = v334 ? v12 : v476;
    const v478 = v187 < v12;
    const v479 = -v191;
    const v480 = v478 ? v479 : v191;
    const v481 = v181 < v12;
    const v482 = -v185;
    const v483 = v481 ? v482 : v185;
    const v484 = v480 - v483;
    const v485 = v321 ? v12 : v484;
    const v486 = v477 + v485;
    const v487 = v166 * v181;
    const v488 = v12 < v487;
    const v489 = -v204;
    const v490 = v481 ? v489 : v204;
    const v491 = -v200;
    const v492 = v470 ? v491 : v200;
    const v493 = v490 - v492;
    const v494 = v488 ? v12 : v493;
    const v495 = v156 * v187;
    const v496 = v12 < v495;
    const v497 = -v215;
    const v498 = v473 ? v497 : v215;
    const v499 = -v211;
    const v500 = v478 ? v499 : v211;
    const v501 = v498 - v500;
    const v502 = v496 ? v12 : v501;
    const v503 = v494 + v502;
    const v504 = v486 + v503;
    const v505 = v343 + v331;
    const v506 = v504 + v505;
    const v507 = v506 * v441;
    const v508 = v260 < v507;
    const v509 = v508 ? v260 : v507;
    const v510 = v509 < v358;
    const v511 = v510 ? v358 : v509;
    const v512 = v24 * v351;
    const v513 = v260 < v512;
    const v514 = v513 ? v260 : v512;
    const v515 = v514 < v358;
    const v516 = v515 ? v358 : v514;
    const v517 = v447 * v516;
    const v518 = -v517;
    const v519 = v260 < v518;
    const v520 = v519 ? v260 : v518;
    const v521 = v520 < v358;
    const v522 = v521 ? v358 : v520;
    const v523 = v511 + v522;
    const v524 = v23 * v523;
    const v525 = v260 < v524;
    const v526 = v525 ? v260 : v524;
    const v527 = v526 < v358;
    const v528 = v527 ? v358 : v526;
    const v529 = v260 < v528;
    const v530 = v529 ? v260 : v528;
    const v531 = v530 < v358;
    const v532 = v531 ? v358 : v530;
    const v533 = v532 + 0.0;
    const v534 = v1 * v192;
    const v535 = v149 - v150;
    const v536 = v534 - v535;
    const v537 = v332 * v536;
    const v538 = v1 * v171;
    const v539 = v149 + v150;
    const v540 = v538 - v539;
    const v541 = v344 * v540;
    const v542 = v537 - v541;
    const v543 = v309 + v300;
    const v544 = v1 * v543;
    const v545 = v132 - v133;
    const v546 = v544 - v545;
    const v547 = v318 * v546;
    const v548 = v280 + v271;
    const v549 = v1 * v548;
    const v550 = v132 + v133;
    const v551 = v549 - v550;
    const v552 = v289 * v551;
    const v553 = v547 - v552;
    const v554 = v542 + v553;
    const v555 = v20 / v62;
    const v556 = v555 * v555;
    const v557 = v554 * v556;
    const v558 = v557 * v354;
    const v559 = v260 < v558;
    const v560 = v559 ? v260 : v558;
    const v561 = v560 < v358;
    const v562 = v561 ? v358 : v560;
    const v563 = v92 * v368;
    const v564 = v260 < v563;
    const v565 = v564 ? v260 : v563;
    const v566 = v565 < v358;
    const v567 = v566 ? v358 : v565;
    const v568 = v101 * v360;
    const v569 = v260 < v568;
    const v570 = v569 ? v260 : v568;
    const v571 = v570 < v358;
    const v572 = v571 ? v358 : v570;
    const v573 = v567 - v572;
    const v574 = v562 + v573;
    const v575 = -v574;
    const v576 = v260 < v575;
    const v577 = v576 ? v260 : v575;
    const v578 = v577 < v358;
    const v579 = v578 ? v358 : v577;
    const v580 = v260 < v579;
    const v581 = v580 ? v260 : v579;
    const v582 = v581 < v358;
    const v583 = v582 ? v358 : v581;
    const v584 = v583 + 0.0;
    const v585 = v260 < v371;
    const v586 = v585 ? v260 : v371;
    const v587 = v586 < v358;
    const v588 = v587 ? v358 : v586;
    const v589 = v260 < v588;
    const v590 = v589 ? v260 : v588;
    const v591 = v590 < v358;
    const v592 = v591 ? v358 : v590;
    const v593 = v592 + 0.0;
    const v594 = v260 < v385;
    const v595 = v594 ? v260 : v385;
    const v596 = v595 < v358;
    const v597 = v596 ? v358 : v595;
    const v598 = v260 < v597;
    const v599 = v598 ? v260 : v597;
    const v600 = v599 < v358;
    const v601 = v600 ? v358 : v599;
    const v602 = v601 + 0.0;
    const v603 = v344 + v332;
    const v604 = v555 * v603;
    const v605 = v289 + v318;
    const v606 = v555 * v605;
    const v607 = v49 ? v604 : v606;
    const v608 = v607 * v441;
    const v609 = v260 < v608;
    const v610 = v609 ? v260 : v608;
    const v611 = v610 < v358;
    const v612 = v611 ? v358 : v610;
    const v613 = v31 * v351;
    const v614 = v260 < v613;
    const v615 = v614 ? v260 : v613;
    const v616 = v615 < v358;
    const v617 = v616 ? v358 : v615;
    const v618 = v447 * v617;
    const v619 = -v618;
    const v620 = v260 < v619;
    const v621 = v620 ? v260 : v619;
    const v622 = v621 < v358;
    const v623 = v622 ? v358 : v621;
    const v624 = v612 + v623;
    const v625 = v23 * v624;
    const v626 = v260 < v625;
    const v627 = v626 ? v260 : v625;
    const v628 = v627 < v358;
    const v629 = v628 ? v358 : v627;
    const v630 = v260 < v629;
    const v631 = v630 ? v260 : v629;
    const v632 = v631 < v358;
    const v633 = v632 ? v358 : v631;
    const v634 = v633 + 0.0;
    const v635 = v49 ? v606 : v604;
    const v636 = v635 * v441;
    const v637 = v260 < v636;
    const v638 = v637 ? v260 : v636;
    const v639 = v638 < v358;
    const v640 = v639 ? v358 : v638;
    const v641 = v29 * v351;
    const v642 = v260 < v641;
    const v643 = v642 ? v260 : v641;
    const v644 = v643 < v358;
    const v645 = v644 ? v358 : v643;
    const v646 = v447 * v645;
    const v647 = -v646;
    const v648 = v260 < v647;
    const v649 = v648 ? v260 : v647;
    const v650 = v649 < v358;
    const v651 = v650 ? v358 : v649;
    const v652 = v640 + v651;
    const v653 = v23 * v652;
    const v654 = v260 < v653;
    const v655 = v654 ? v260 : v653;
    const v656 = v655 < v358;
    const v657 = v656 ? v358 : v655;
    const v658 = v260 < v657;
    const v659 = v658 ? v260 : v657;
    const v660 = v659 < v358;
    const v661 = v660 ? v358 : v659;
    const v662 = v661 + 0.0;
    const v663 = v260 < v562;
    const v664 = v663 ? v260 : v562;
    const v665 = v664 < v358;
    const v666 = v665 ? v358 : v664;
    const v667 = v260 < v666;
    const v668 = v667 ? v260 : v666;
    const v669 = v668 < v358;
    const v670 = v669 ? v358 : v668;
    const v671 = v670 + 0.0;
    return [v259, v381, v395, v469, v533, v584, v593, v602, v634, v662, v671];
}
