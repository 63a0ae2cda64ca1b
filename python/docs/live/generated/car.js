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

// The root; zero for zero and below. Engines use the processor's, which is the nearest number.
function program_root(x) {
    return x <= 0 ? 0 : Math.sqrt(x);
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
 * @param {ArrayLike<number>} x point.x, point.y, heading
 * @returns {number[]} 4 numbers, all NaN if a number of x is NaN
 */
export function car(x) {
    let sum = 0;
    for (let i = 0; i < 3; i += 1) {
        sum += x[i];
    }
    if (sum !== sum) {
        return new Array(4).fill(NaN);
    }
    const v0 = -1.7976931348623157e308;
    const v1 = x[1];
    const v2 = x[2];
    const v3 = program_cos(v2);
    const v4 = v1 * v3;
    const v5 = x[0];
    const v6 = program_sin(v2);
    const v7 = v5 * v6;
    const v8 = v4 - v7;
    const v9 = v8 - v8;
    const v10 = v5 * v3;
    const v11 = v1 * v6;
    const v12 = v10 + v11;
    const v13 = v12 - v12;
    const v14 = Math.abs(v13);
    const v15 = Math.abs(v9);
    const v16 = v14 > v15 ? v14 : v15;
    const v17 = -v12;
    const v18 = Math.abs(v17);
    const v19 = -v8;
    const v20 = Math.abs(v19);
    const v21 = v18 > v20 ? v18 : v20;
    const v22 = 2.4;
    const v23 = v21 + v22;
    const v24 = v16 > v23 ? v16 : v23;
    const v25 = 0.0;
    const v26 = v24 <= v25;
    const v27 = 1.0;
    const v28 = v26 ? v27 : v24;
    const v29 = program_binade(v28);
    const v30 = v9 * v29;
    const v31 = v13 * v29;
    const v32 = v25 * v31;
    const v33 = v30 + v32;
    const v34 = v8 * v29;
    const v35 = 0.3;
    const v36 = v35 * v29;
    const v37 = v34 + v36;
    const v38 = v12 * v29;
    const v39 = v25 * v36;
    const v40 = v38 + v39;
    const v41 = v25 * v40;
    const v42 = v37 + v41;
    const v43 = v33 + v42;
    const v44 = -v43;
    const v45 = v36 - v34;
    const v46 = v39 - v38;
    const v47 = v25 * v46;
    const v48 = v45 + v47;
    const v49 = v33 - v48;
    const v50 = v25 * v30;
    const v51 = v31 + v50;
    const v52 = 2.1;
    const v53 = v52 * v29;
    const v54 = v38 + v53;
    const v55 = v25 * v53;
    const v56 = v34 + v55;
    const v57 = v25 * v56;
    const v58 = v54 + v57;
    const v59 = v51 + v58;
    const v60 = -v59;
    const v61 = v53 - v38;
    const v62 = v55 - v34;
    const v63 = v25 * v62;
    const v64 = v61 + v63;
    const v65 = v51 - v64;
    const v66 = v60 < v65;
    const v67 = v66 ? v65 : v60;
    const v68 = v49 < v67;
    const v69 = v68 ? v67 : v49;
    const v70 = v44 < v69;
    const v71 = v70 ? v69 : v44;
    const v72 = v0 < v71;
    const v73 = v31 + v38;
    const v74 = v30 + v34;
    const v75 = v25 * v74;
    const v76 = v73 + v75;
    const v77 = Math.abs(v76);
    const v78 = v53 < v77;
    const v79 = v76 < v25;
    const v80 = v53 + v76;
    const v81 = v76 - v53;
    const v82 = v79 ? v80 : v81;
    const v83 = v78 ? v82 : v25;
    const v84 = v25 * v73;
    const v85 = v74 - v84;
    const v86 = Math.abs(v85);
    const v87 = v36 < v86;
    const v88 = v85 < v25;
    const v89 = v36 + v85;
    const v90 = v85 - v36;
    const v91 = v88 ? v89 : v90;
    const v92 = v87 ? v91 : v25;
    const v93 = v25 * v92;
    const v94 = v83 - v93;
    const v95 = v44 === v69;
    const v96 = v70 || v95;
    const v97 = v49 === v67;
    const v98 = v68 || v97;
    const v99 = v65 === v60;
    const v100 = v66 || v99;
    const v101 = -1.0;
    const v102 = v100 ? v27 : v101;
    const v103 = v98 ? v102 : v25;
    const v104 = -0.0;
    const v105 = v96 ? v103 : v104;
    const v106 = v94 * v105;
    const v107 = v25 * v83;
    const v108 = v92 + v107;
    const v109 = v100 ? v25 : v104;
    const v110 = v98 ? v109 : v27;
    const v111 = v96 ? v110 : v101;
    const v112 = v108 * v111;
    const v113 = v106 + v112;
    const v114 = v113 < v25;
    const v115 = v94 * v94;
    const v116 = v108 * v108;
    const v117 = v115 + v116;
    const v118 = 2.0194839173657902e-28;
    const v119 = v117 <= v118;
    const v120 = v65 - v59;
    const v121 = v99 ? v120 : v67;
    const v122 = v49 + v121;
    const v123 = v68 ? v121 : v49;
    const v124 = v97 ? v122 : v123;
    const v125 = v124 - v43;
    const v126 = v70 ? v124 : v44;
    const v127 = v95 ? v125 : v126;
    const v128 = 2.0;
    const v129 = v99 ? v128 : v27;
    const v130 = v27 + v129;
    const v131 = v68 ? v129 : v27;
    const v132 = v97 ? v130 : v131;
    const v133 = v27 + v132;
    const v134 = v70 ? v132 : v27;
    const v135 = v95 ? v133 : v134;
    const v136 = v27 / v135;
    const v137 = v127 * v136;
    const v138 = v137 < v25;
    const v139 = !v138;
    const v140 = v119 && v139;
    const v141 = v114 && v140;
    const v142 = -v94;
    const v143 = Math.abs(v142);
    const v144 = -v108;
    const v145 = Math.abs(v144);
    const v146 = v143 > v145 ? v143 : v145;
    const v147 = v146 <= v25;
    const v148 = v147 ? v27 : v146;
    const v149 = program_binade(v148);
    const v150 = v27 / v149;
    const v151 = v94 * v149;
    const v152 = v151 * v151;
    const v153 = v108 * v149;
    const v154 = v153 * v153;
    const v155 = v152 + v154;
    const v156 = program_root(v155);
    const v157 = v150 * v156;
    const v158 = v157 <= v25;
    const v159 = 1.4210854715202004e-14;
    const v160 = v159 - v137;
    const v161 = v160 - v137;
    const v162 = v157 <= v161;
    const v163 = v138 && v162;
    const v164 = v158 || v163;
    const v165 = v141 || v164;
    const v166 = v72 && v165;
    const v167 = v25 < v137;
    const v168 = v158 && v167;
    const v169 = v168 ? v25 : v137;
    const v170 = v166 ? v169 : v157;
    const v171 = v170 / v29;
    const v172 = v171 + 0.0;
    const v173 = v12 + v8;
    const v174 = v173 === v173;
    const v175 = v174 ? v27 : v173;
    const v176 = v172 * v175;
    const v177 = 0.12;
    const v178 = v176 - v177;
    const v179 = 0.2;
    const v180 = v179 <= v8;
    const v181 = v8 < v27;
    const v182 = v180 && v181;
    const v183 = 0.5;
    const v184 = v8 - v27;
    const v185 = -0.8749999999999999;
    const v186 = v184 * v185;
    const v187 = v183 + v186;
    const v188 = v12 < v187;
    const v189 = v182 && v188;
    const v190 = -1.5;
    const v191 = v8 - v179;
    const v192 = 0.7499999999999999;
    const v193 = v191 * v192;
    const v194 = v190 + v193;
    const v195 = v12 < v194;
    const v196 = v182 && v195;
    const v197 = v196 ? v101 : v27;
    const v198 = -v197;
    const v199 = v189 ? v198 : v197;
    const v200 = 0.6;
    const v201 = v190 - v12;
    const v202 = Math.abs(v201);
    const v203 = v179 - v8;
    const v204 = Math.abs(v203);
    const v205 = v202 > v204 ? v202 : v204;
    const v206 = -0.9;
    const v207 = v206 - v12;
    const v208 = Math.abs(v207);
    const v209 = v27 - v8;
    const v210 = Math.abs(v209);
    const v211 = v208 > v210 ? v208 : v210;
    const v212 = v205 > v211 ? v205 : v211;
    const v213 = v16 > v212 ? v16 : v212;
    const v214 = v213 <= v25;
    const v215 = v214 ? v27 : v213;
    const v216 = program_binade(v215);
    const v217 = v200 * v216;
    const v218 = v217 * v217;
    const v219 = 0.8;
    const v220 = v219 * v216;
    const v221 = v220 * v220;
    const v222 = v218 + v221;
    const v223 = 2.4308653429145085e-63;
    const v224 = v222 <= v223;
    const v225 = v13 * v216;
    const v226 = v201 * v216;
    const v227 = v225 - v226;
    const v228 = v217 * v227;
    const v229 = v9 * v216;
    const v230 = v203 * v216;
    const v231 = v229 - v230;
    const v232 = v220 * v231;
    const v233 = v228 + v232;
    const v234 = v224 ? v27 : v222;
    const v235 = v233 / v234;
    const v236 = v224 ? v183 : v235;
    const v237 = v25 < v236;
    const v238 = v236 < v27;
    const v239 = v237 && v238;
    const v240 = !v224;
    const v241 = v239 && v240;
    const v242 = v217 * v231;
    const v243 = v220 * v227;
    const v244 = v242 - v243;
    const v245 = v244 / v234;
    const v246 = v220 * v245;
    const v247 = -v246;
    const v248 = v236 > v25 ? v236 : v25;
    const v249 = v248 < v27 ? v248 : v27;
    const v250 = v217 * v249;
    const v251 = v227 - v250;
    const v252 = v241 ? v247 : v251;
    const v253 = -v252;
    const v254 = Math.abs(v253);
    const v255 = v217 * v245;
    const v256 = v220 * v249;
    const v257 = v231 - v256;
    const v258 = v241 ? v255 : v257;
    const v259 = -v258;
    const v260 = Math.abs(v259);
    const v261 = v254 > v260 ? v254 : v260;
    const v262 = v261 <= v25;
    const v263 = v262 ? v27 : v261;
    const v264 = program_binade(v263);
    const v265 = v27 / v264;
    const v266 = v252 * v264;
    const v267 = v266 * v266;
    const v268 = v258 * v264;
    const v269 = v268 * v268;
    const v270 = v267 + v269;
    const v271 = program_root(v270);
    const v272 = v265 * v271;
    const v273 = v272 / v216;
    const v274 = v273 + 0.0;
    const v275 = v25 < v274;
    const v276 = v275 ? v274 : v25;
    const v277 = v276 + 0.0;
    const v278 = v175 * v277;
    const v279 = 1.4;
    const v280 = v183 - v12;
    const v281 = Math.abs(v280);
    const v282 = v281 > v210 ? v281 : v210;
    const v283 = v211 > v282 ? v211 : v282;
    const v284 = v16 > v283 ? v16 : v283;
    const v285 = v284 <= v25;
    const v286 = v285 ? v27 : v284;
    const v287 = program_binade(v286);
    const v288 = v279 * v287;
    const v289 = v288 * v288;
    const v290 = v25 * v287;
    const v291 = v290 * v290;
    const v292 = v289 + v291;
    const v293 = v292 <= v223;
    const v294 = v13 * v287;
    const v295 = v207 * v287;
    const v296 = v294 - v295;
    const v297 = v288 * v296;
    const v298 = v9 * v287;
    const v299 = v209 * v287;
    const v300 = v298 - v299;
    const v301 = v290 * v300;
    const v302 = v297 + v301;
    const v303 = v293 ? v27 : v292;
    const v304 = v302 / v303;
    const v305 = v293 ? v183 : v304;
    const v306 = v25 < v305;
    const v307 = v305 < v27;
    const v308 = v306 && v307;
    const v309 = !v293;
    const v310 = v308 && v309;
    const v311 = v288 * v300;
    const v312 = v290 * v296;
    const v313 = v311 - v312;
    const v314 = v313 / v303;
    const v315 = v290 * v314;
    const v316 = -v315;
    const v317 = v305 > v25 ? v305 : v25;
    const v318 = v317 < v27 ? v317 : v27;
    const v319 = v288 * v318;
    const v320 = v296 - v319;
    const v321 = v310 ? v316 : v320;
    const v322 = -v321;
    const v323 = Math.abs(v322);
    const v324 = v288 * v314;
    const v325 = v290 * v318;
    const v326 = v300 - v325;
    const v327 = v310 ? v324 : v326;
    const v328 = -v327;
    const v329 = Math.abs(v328);
    const v330 = v323 > v329 ? v323 : v329;
    const v331 = v330 <= v25;
    const v332 = v331 ? v27 : v330;
    const v333 = program_binade(v332);
    const v334 = v27 / v333;
    const v335 = v321 * v333;
    const v336 = v335 * v335;
    const v337 = v327 * v333;
    const v338 = v337 * v337;
    const v339 = v336 + v338;
    const v340 = program_root(v339);
    const v341 = v334 * v340;
    const v342 = v341 / v287;
    const v343 = v342 + 0.0;
    const v344 = v25 < v343;
    const v345 = v344 ? v343 : v25;
    const v346 = v345 + 0.0;
    const v347 = v175 * v346;
    const v348 = v278 < v347 ? v278 : v347;
    const v349 = v278 === v278;
    const v350 = v349 ? v27 : v278;
    const v351 = v348 * v350;
    const v352 = v347 === v347;
    const v353 = v352 ? v27 : v347;
    const v354 = v351 * v353;
    const v355 = 0.7;
    const v356 = 1.2;
    const v357 = v356 - v12;
    const v358 = Math.abs(v357);
    const v359 = v358 > v204 ? v358 : v204;
    const v360 = v282 > v359 ? v282 : v359;
    const v361 = v16 > v360 ? v16 : v360;
    const v362 = v361 <= v25;
    const v363 = v362 ? v27 : v361;
    const v364 = program_binade(v363);
    const v365 = v355 * v364;
    const v366 = v365 * v365;
    const v367 = -0.8;
    const v368 = v367 * v364;
    const v369 = v368 * v368;
    const v370 = v366 + v369;
    const v371 = v370 <= v223;
    const v372 = v13 * v364;
    const v373 = v280 * v364;
    const v374 = v372 - v373;
    const v375 = v365 * v374;
    const v376 = v9 * v364;
    const v377 = v209 * v364;
    const v378 = v376 - v377;
    const v379 = v368 * v378;
    const v380 = v375 + v379;
    const v381 = v371 ? v27 : v370;
    const v382 = v380 / v381;
    const v383 = v371 ? v183 : v382;
    const v384 = v25 < v383;
    const v385 = v383 < v27;
    const v386 = v384 && v385;
    const v387 = !v371;
    const v388 = v386 && v387;
    const v389 = v365 * v378;
    const v390 = v368 * v374;
    const v391 = v389 - v390;
    const v392 = v391 / v381;
    const v393 = v368 * v392;
    const v394 = -v393;
    const v395 = v383 > v25 ? v383 : v25;
    const v396 = v395 < v27 ? v395 : v27;
    const v397 = v365 * v396;
    const v398 = v374 - v397;
    const v399 = v388 ? v394 : v398;
    const v400 = -v399;
    const v401 = Math.abs(v400);
    const v402 = v365 * v392;
    const v403 = v368 * v396;
    const v404 = v378 - v403;
    const v405 = v388 ? v402 : v404;
    const v406 = -v405;
    const v407 = Math.abs(v406);
    const v408 = v401 > v407 ? v401 : v407;
    const v409 = v408 <= v25;
    const v410 = v409 ? v27 : v408;
    const v411 = program_binade(v410);
    const v412 = v27 / v411;
    const v413 = v399 * v411;
    const v414 = v413 * v413;
    const v415 = v405 * v411;
    const v416 = v415 * v415;
    const v417 = v414 + v416;
    const v418 = program_root(v417);
    const v419 = v412 * v418;
    const v420 = v419 / v364;
    const v421 = v420 + 0.0;
    const v422 = v25 < v421;
    const v423 = v422 ? v421 : v25;
    const v424 = v423 + 0.0;
    const v425 = v175 * v424;
    const v426 = v354 < v425 ? v354 : v425;
    const v427 = v354 === v354;
    const v428 = v427 ? v27 : v354;
    const v429 = v426 * v428;
    const v430 = v425 === v425;
    const v431 = v430 ? v27 : v425;
    const v432 = v429 * v431;
    const v433 = -2.7;
    const v434 = v359 > v205 ? v359 : v205;
    const v435 = v16 > v434 ? v16 : v434;
    const v436 = v435 <= v25;
    const v437 = v436 ? v27 : v435;
    const v438 = program_binade(v437);
    const v439 = v433 * v438;
    const v440 = v439 * v439;
    const v441 = v25 * v438;
    const v442 = v441 * v441;
    const v443 = v440 + v442;
    const v444 = v443 <= v223;
    const v445 = v13 * v438;
    const v446 = v357 * v438;
    const v447 = v445 - v446;
    const v448 = v439 * v447;
    const v449 = v9 * v438;
    const v450 = v203 * v438;
    const v451 = v449 - v450;
    const v452 = v441 * v451;
    const v453 = v448 + v452;
    const v454 = v444 ? v27 : v443;
    const v455 = v453 / v454;
    const v456 = v444 ? v183 : v455;
    const v457 = v25 < v456;
    const v458 = v456 < v27;
    const v459 = v457 && v458;
    const v460 = !v444;
    const v461 = v459 && v460;
    const v462 = v439 * v451;
    const v463 = v441 * v447;
    const v464 = v462 - v463;
    const v465 = v464 / v454;
    const v466 = v441 * v465;
    const v467 = -v466;
    const v468 = v456 > v25 ? v456 : v25;
    const v469 = v468 < v27 ? v468 : v27;
    const v470 = v439 * v469;
    const v471 = v447 - v470;
    const v472 = v461 ? v467 : v471;
    const v473 = -v472;
    const v474 = Math.abs(v473);
    const v475 = v439 * v465;
    const v476 = v441 * v469;
    const v477 = v451 - v476;
    const v478 = v461 ? v475 : v477;
    const v479 = -v478;
    const v480 = Math.abs(v479);
    const v481 = v474 > v480 ? v474 : v480;
    const v482 = v481 <= v25;
    const v483 = v482 ? v27 : v481;
    const v484 = program_binade(v483);
    const v485 = v27 / v484;
    const v486 = v472 * v484;
    const v487 = v486 * v486;
    const v488 = v478 * v484;
    const v489 = v488 * v488;
    const v490 = v487 + v489;
    const v491 = program_root(v490);
    const v492 = v485 * v491;
    const v493 = v492 / v438;
    const v494 = v493 + 0.0;
    const v495 = v25 < v494;
    const v496 = v495 ? v494 : v25;
    const v497 = v496 + 0.0;
    const v498 = v175 * v497;
    const v499 = v432 < v498 ? v432 : v498;
    const v500 = v432 === v432;
    const v501 = v500 ? v27 : v432;
    const v502 = v499 * v501;
    const v503 = v498 === v498;
    const v504 = v503 ? v27 : v498;
    const v505 = v502 * v504;
    const v506 = v199 * v505;
    const v507 = 0.1;
    const v508 = v506 - v507;
    const v509 = v178 < v508 ? v178 : v508;
    const v510 = v178 === v178;
    const v511 = v510 ? v27 : v178;
    const v512 = v509 * v511;
    const v513 = v508 === v508;
    const v514 = v513 ? v27 : v508;
    const v515 = v512 * v514;
    const v516 = -1.3;
    const v517 = v516 - v12;
    const v518 = Math.abs(v517);
    const v519 = -0.42;
    const v520 = v519 - v8;
    const v521 = Math.abs(v520);
    const v522 = v518 > v521 ? v518 : v521;
    const v523 = v16 > v522 ? v16 : v522;
    const v524 = v523 <= v25;
    const v525 = v524 ? v27 : v523;
    const v526 = program_binade(v525);
    const v527 = v517 * v526;
    const v528 = v13 * v526;
    const v529 = v527 - v528;
    const v530 = Math.abs(v529);
    const v531 = v520 * v526;
    const v532 = v9 * v526;
    const v533 = v531 - v532;
    const v534 = Math.abs(v533);
    const v535 = v530 > v534 ? v530 : v534;
    const v536 = v535 <= v25;
    const v537 = v536 ? v27 : v535;
    const v538 = program_binade(v537);
    const v539 = v27 / v538;
    const v540 = v529 * v538;
    const v541 = v540 * v540;
    const v542 = v533 * v538;
    const v543 = v542 * v542;
    const v544 = v541 + v543;
    const v545 = program_root(v544);
    const v546 = v539 * v545;
    const v547 = v546 / v526;
    const v548 = 0.42;
    const v549 = v547 - v548;
    const v550 = v549 + 0.0;
    const v551 = v175 * v550;
    const v552 = 1.35;
    const v553 = v552 - v12;
    const v554 = Math.abs(v553);
    const v555 = v554 > v521 ? v554 : v521;
    const v556 = v16 > v555 ? v16 : v555;
    const v557 = v556 <= v25;
    const v558 = v557 ? v27 : v556;
    const v559 = program_binade(v558);
    const v560 = v553 * v559;
    const v561 = v13 * v559;
    const v562 = v560 - v561;
    const v563 = Math.abs(v562);
    const v564 = v520 * v559;
    const v565 = v9 * v559;
    const v566 = v564 - v565;
    const v567 = Math.abs(v566);
    const v568 = v563 > v567 ? v563 : v567;
    const v569 = v568 <= v25;
    const v570 = v569 ? v27 : v568;
    const v571 = program_binade(v570);
    const v572 = v27 / v571;
    const v573 = v562 * v571;
    const v574 = v573 * v573;
    const v575 = v566 * v571;
    const v576 = v575 * v575;
    const v577 = v574 + v576;
    const v578 = program_root(v577);
    const v579 = v572 * v578;
    const v580 = v579 / v559;
    const v581 = v580 - v548;
    const v582 = v581 + 0.0;
    const v583 = v175 * v582;
    const v584 = v551 < v583 ? v551 : v583;
    const v585 = v551 === v551;
    const v586 = v585 ? v27 : v551;
    const v587 = v584 * v586;
    const v588 = v583 === v583;
    const v589 = v588 ? v27 : v583;
    const v590 = v587 * v589;
    const v591 = v515 < v590 ? v515 : v590;
    const v592 = v515 === v515;
    const v593 = v592 ? v27 : v515;
    const v594 = v591 * v593;
    const v595 = v590 === v590;
    const v596 = v595 ? v27 : v590;
    const v597 = v594 * v596;
    const v598 = v597 + 0.0;
    const v599 = 7.458340731200207e-155;
    const v600 = v579 <= v599;
    const v601 = v25 < v577;
    const v602 = !v600;
    const v603 = v601 && v602;
    const v604 = v600 || v603;
    const v605 = v551 < v583;
    const v606 = !v605;
    const v607 = v604 && v606;
    const v608 = v551 <= v583;
    const v609 = v546 <= v599;
    const v610 = v25 < v544;
    const v611 = !v609;
    const v612 = v610 && v611;
    const v613 = v609 || v612;
    const v614 = v608 && v613;
    const v615 = v607 || v614;
    const v616 = v515 < v590;
    const v617 = !v616;
    const v618 = v615 && v617;
    const v619 = !v95;
    const v620 = !v70;
    const v621 = v619 && v620;
    const v622 = v95 || v621;
    const v623 = v70 && v619;
    const v624 = v95 || v623;
    const v625 = !v97;
    const v626 = !v68;
    const v627 = v625 && v626;
    const v628 = v97 || v627;
    const v629 = v624 && v628;
    const v630 = v622 || v629;
    const v631 = v68 && v625;
    const v632 = v97 || v631;
    const v633 = v624 && v632;
    const v634 = !v99;
    const v635 = v66 && v634;
    const v636 = v99 || v635;
    const v637 = !v66;
    const v638 = v634 && v637;
    const v639 = v99 || v638;
    const v640 = v636 || v639;
    const v641 = v633 && v640;
    const v642 = v630 || v641;
    const v643 = v166 && v642;
    const v644 = v78 || v87;
    const v645 = v157 <= v599;
    const v646 = v25 < v155;
    const v647 = !v645;
    const v648 = v646 && v647;
    const v649 = v645 || v648;
    const v650 = !v166;
    const v651 = v649 && v650;
    const v652 = v644 && v651;
    const v653 = v643 || v652;
    const v654 = v515 <= v590;
    const v655 = v178 <= v508;
    const v656 = v654 && v655;
    const v657 = v653 && v656;
    const v658 = v618 || v657;
    const v659 = v178 < v508;
    const v660 = !v659;
    const v661 = v654 && v660;
    const v662 = v432 < v498;
    const v663 = !v662;
    const v664 = v661 && v663;
    const v665 = v664 || v618;
    const v666 = v432 <= v498;
    const v667 = v666 && v661;
    const v668 = v354 < v425;
    const v669 = !v668;
    const v670 = v667 && v669;
    const v671 = v665 || v670;
    const v672 = v354 <= v425;
    const v673 = v672 && v667;
    const v674 = v278 < v347;
    const v675 = !v674;
    const v676 = v673 && v675;
    const v677 = v671 || v676;
    const v678 = v278 <= v347;
    const v679 = v678 && v673;
    const v680 = v677 || v679;
    const v681 = v639 && v633;
    const v682 = v630 || v681;
    const v683 = v636 && v633;
    const v684 = v682 || v683;
    const v685 = v166 && v684;
    const v686 = v652 || v685;
    const v687 = v686 && v656;
    const v688 = v680 || v687;
    const v689 = v688 || v658;
    const v690 = v658 || v689;
    const v691 = v579 <= v25;
    const v692 = v691 ? v27 : v579;
    const v693 = v562 / v692;
    const v694 = v593 * v596;
    const v695 = v515 < v590 ? 0 : v515 === v590 ? v694 * 0.5 : v694;
    const v696 = v589 * v695;
    const v697 = v586 * v696;
    const v698 = v551 < v583 ? 0 : v551 === v583 ? v697 * 0.5 : v697;
    const v699 = v175 * v698;
    const v700 = v699 / v559;
    const v701 = v693 * v700;
    const v702 = v600 ? v701 : v25;
    const v703 = v572 * v700;
    const v704 = v183 * v703;
    const v705 = v601 ? v578 : v27;
    const v706 = v704 / v705;
    const v707 = v601 ? v706 : v25;
    const v708 = v573 * v707;
    const v709 = v708 + v708;
    const v710 = v571 * v709;
    const v711 = v603 ? v710 : v25;
    const v712 = v702 + v711;
    const v713 = v559 * v712;
    const v714 = -v713;
    const v715 = v607 ? v714 : v25;
    const v716 = v546 <= v25;
    const v717 = v716 ? v27 : v546;
    const v718 = v529 / v717;
    const v719 = v551 < v583 ? v697 : v551 === v583 ? v697 * 0.5 : 0;
    const v720 = v175 * v719;
    const v721 = v720 / v526;
    const v722 = v718 * v721;
    const v723 = v609 ? v722 : v25;
    const v724 = v539 * v721;
    const v725 = v183 * v724;
    const v726 = v610 ? v545 : v27;
    const v727 = v725 / v726;
    const v728 = v610 ? v727 : v25;
    const v729 = v540 * v728;
    const v730 = v729 + v729;
    const v731 = v538 * v730;
    const v732 = v612 ? v731 : v25;
    const v733 = v723 + v732;
    const v734 = v526 * v733;
    const v735 = -v734;
    const v736 = v614 ? v735 : v25;
    const v737 = v715 + v736;
    const v738 = v616 ? v25 : v737;
    const v739 = v25 < v497;
    const v740 = v492 <= v25;
    const v741 = v740 ? v27 : v492;
    const v742 = v472 / v741;
    const v743 = -v742;
    const v744 = v739 ? v743 : v25;
    const v745 = -v744;
    const v746 = v745 + 0.0;
    const v747 = v515 < v590 ? v694 : v515 === v590 ? v694 * 0.5 : 0;
    const v748 = v514 * v747;
    const v749 = v511 * v748;
    const v750 = v178 < v508 ? 0 : v178 === v508 ? v749 * 0.5 : v749;
    const v751 = v199 * v750;
    const v752 = v504 * v751;
    const v753 = v501 * v752;
    const v754 = v432 < v498 ? 0 : v432 === v498 ? v753 * 0.5 : v753;
    const v755 = v746 * v754;
    const v756 = v664 ? v755 : v25;
    const v757 = v738 + v756;
    const v758 = v25 < v424;
    const v759 = v419 <= v25;
    const v760 = v759 ? v27 : v419;
    const v761 = v399 / v760;
    const v762 = -v761;
    const v763 = v758 ? v762 : v25;
    const v764 = -v763;
    const v765 = v764 + 0.0;
    const v766 = v432 < v498 ? v753 : v432 === v498 ? v753 * 0.5 : 0;
    const v767 = v431 * v766;
    const v768 = v428 * v767;
    const v769 = v354 < v425 ? 0 : v354 === v425 ? v768 * 0.5 : v768;
    const v770 = v765 * v769;
    const v771 = v670 ? v770 : v25;
    const v772 = v757 + v771;
    const v773 = v25 < v346;
    const v774 = v341 <= v25;
    const v775 = v774 ? v27 : v341;
    const v776 = v321 / v775;
    const v777 = -v776;
    const v778 = v773 ? v777 : v25;
    const v779 = -v778;
    const v780 = v779 + 0.0;
    const v781 = v354 < v425 ? v768 : v354 === v425 ? v768 * 0.5 : 0;
    const v782 = v353 * v781;
    const v783 = v350 * v782;
    const v784 = v278 < v347 ? 0 : v278 === v347 ? v783 * 0.5 : v783;
    const v785 = v780 * v784;
    const v786 = v676 ? v785 : v25;
    const v787 = v772 + v786;
    const v788 = v25 < v277;
    const v789 = v272 <= v25;
    const v790 = v789 ? v27 : v272;
    const v791 = v252 / v790;
    const v792 = -v791;
    const v793 = v788 ? v792 : v25;
    const v794 = -v793;
    const v795 = v794 + 0.0;
    const v796 = v278 < v347 ? v783 : v278 === v347 ? v783 * 0.5 : 0;
    const v797 = v795 * v796;
    const v798 = v679 ? v797 : v25;
    const v799 = v787 + v798;
    const v800 = v158 ? v27 : v157;
    const v801 = v108 / v800;
    const v802 = v178 < v508 ? v749 : v178 === v508 ? v749 * 0.5 : 0;
    const v803 = v175 * v802;
    const v804 = v803 / v29;
    const v805 = v801 * v804;
    const v806 = v645 ? v805 : v25;
    const v807 = v150 * v804;
    const v808 = v183 * v807;
    const v809 = v646 ? v156 : v27;
    const v810 = v808 / v809;
    const v811 = v646 ? v810 : v25;
    const v812 = v153 * v811;
    const v813 = v812 + v812;
    const v814 = v149 * v813;
    const v815 = v648 ? v814 : v25;
    const v816 = v806 + v815;
    const v817 = v94 / v800;
    const v818 = v817 * v804;
    const v819 = v645 ? v818 : v25;
    const v820 = v151 * v811;
    const v821 = v820 + v820;
    const v822 = v149 * v821;
    const v823 = v648 ? v822 : v25;
    const v824 = v819 + v823;
    const v825 = v25 * v824;
    const v826 = v816 - v825;
    const v827 = v25 * v826;
    const v828 = -v827;
    const v829 = v87 ? v828 : v25;
    const v830 = v25 * v816;
    const v831 = v824 + v830;
    const v832 = v78 ? v831 : v25;
    const v833 = v829 + v832;
    const v834 = v166 ? v25 : v833;
    const v835 = v136 * v804;
    const v836 = v623 ? v835 : v25;
    const v837 = v95 ? v835 : v25;
    const v838 = v836 + v837;
    const v839 = v97 ? v838 : v25;
    const v840 = v631 ? v838 : v25;
    const v841 = v839 + v840;
    const v842 = v99 ? v841 : v25;
    const v843 = v635 ? v841 : v25;
    const v844 = v842 + v843;
    const v845 = -v835;
    const v846 = v95 ? v845 : v25;
    const v847 = v621 ? v845 : v25;
    const v848 = v846 + v847;
    const v849 = v25 * v848;
    const v850 = v627 ? v838 : v25;
    const v851 = v850 + v839;
    const v852 = v25 * v851;
    const v853 = v849 + v852;
    const v854 = -v841;
    const v855 = v99 ? v854 : v25;
    const v856 = v638 ? v854 : v25;
    const v857 = v855 + v856;
    const v858 = v853 + v857;
    const v859 = v844 + v858;
    const v860 = v166 ? v859 : v25;
    const v861 = v834 + v860;
    const v862 = v29 * v861;
    const v863 = v687 ? v862 : v25;
    const v864 = v799 + v863;
    const v865 = v851 + v848;
    const v866 = v25 * v865;
    const v867 = v844 + v857;
    const v868 = v866 + v867;
    const v869 = v166 ? v868 : v25;
    const v870 = v869 + v834;
    const v871 = v29 * v870;
    const v872 = v657 ? v871 : v25;
    const v873 = v738 + v872;
    const v874 = v864 + v873;
    const v875 = v874 - v873;
    const v876 = v3 * v875;
    const v877 = v566 / v692;
    const v878 = v877 * v700;
    const v879 = v600 ? v878 : v25;
    const v880 = v575 * v707;
    const v881 = v880 + v880;
    const v882 = v571 * v881;
    const v883 = v603 ? v882 : v25;
    const v884 = v879 + v883;
    const v885 = v559 * v884;
    const v886 = v607 ? v885 : v25;
    const v887 = v533 / v717;
    const v888 = v887 * v721;
    const v889 = v609 ? v888 : v25;
    const v890 = v542 * v728;
    const v891 = v890 + v890;
    const v892 = v538 * v891;
    const v893 = v612 ? v892 : v25;
    const v894 = v889 + v893;
    const v895 = v526 * v894;
    const v896 = v614 ? v895 : v25;
    const v897 = v886 + v896;
    const v898 = -v897;
    const v899 = v616 ? v25 : v898;
    const v900 = v478 / v741;
    const v901 = -v900;
    const v902 = v739 ? v901 : v25;
    const v903 = -v902;
    const v904 = v903 + 0.0;
    const v905 = v904 * v754;
    const v906 = v664 ? v905 : v25;
    const v907 = v899 + v906;
    const v908 = v405 / v760;
    const v909 = -v908;
    const v910 = v758 ? v909 : v25;
    const v911 = -v910;
    const v912 = v911 + 0.0;
    const v913 = v912 * v769;
    const v914 = v670 ? v913 : v25;
    const v915 = v907 + v914;
    const v916 = v327 / v775;
    const v917 = -v916;
    const v918 = v773 ? v917 : v25;
    const v919 = -v918;
    const v920 = v919 + 0.0;
    const v921 = v920 * v784;
    const v922 = v676 ? v921 : v25;
    const v923 = v915 + v922;
    const v924 = v258 / v790;
    const v925 = -v924;
    const v926 = v788 ? v925 : v25;
    const v927 = -v926;
    const v928 = v927 + 0.0;
    const v929 = v928 * v796;
    const v930 = v679 ? v929 : v25;
    const v931 = v923 + v930;
    const v932 = v87 ? v826 : v25;
    const v933 = v25 * v831;
    const v934 = v78 ? v933 : v25;
    const v935 = v932 + v934;
    const v936 = v166 ? v25 : v935;
    const v937 = v25 * v857;
    const v938 = v865 + v937;
    const v939 = v25 * v844;
    const v940 = v938 + v939;
    const v941 = v166 ? v940 : v25;
    const v942 = v936 + v941;
    const v943 = v29 * v942;
    const v944 = v687 ? v943 : v25;
    const v945 = v931 + v944;
    const v946 = -v885;
    const v947 = v607 ? v946 : v25;
    const v948 = -v895;
    const v949 = v614 ? v948 : v25;
    const v950 = v947 + v949;
    const v951 = v616 ? v25 : v950;
    const v952 = v25 * v867;
    const v953 = v865 + v952;
    const v954 = v166 ? v953 : v25;
    const v955 = v954 + v936;
    const v956 = v29 * v955;
    const v957 = v657 ? v956 : v25;
    const v958 = v951 + v957;
    const v959 = v945 + v958;
    const v960 = v959 - v958;
    const v961 = v6 * v960;
    const v962 = v876 - v961;
    const v963 = v690 ? v962 : v25;
    const v964 = v963 + 0.0;
    const v965 = v3 * v960;
    const v966 = v6 * v875;
    const v967 = v965 + v966;
    const v968 = v690 ? v967 : v25;
    const v969 = v968 + 0.0;
    const v970 = v1 * v875;
    const v971 = v5 * v960;
    const v972 = v970 - v971;
    const v973 = v3 * v972;
    const v974 = v1 * v960;
    const v975 = v5 * v875;
    const v976 = v974 + v975;
    const v977 = v6 * v976;
    const v978 = v973 - v977;
    const v979 = v690 ? v978 : v25;
    const v980 = v979 + 0.0;
    return [v598, v964, v969, v980];
}
