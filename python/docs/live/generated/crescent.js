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

/**
 * @param {ArrayLike<number>} x point.x, point.y, bite
 * @returns {number[]} 4 numbers, all NaN if a number of x is NaN
 */
export function crescent(x) {
    let sum = 0;
    for (let i = 0; i < 3; i += 1) {
        sum += x[i];
    }
    if (sum !== sum) {
        return new Array(4).fill(NaN);
    }
    const v0 = 1.0;
    const v1 = -0.2;
    const v2 = x[0];
    const v3 = v1 - v2;
    const v4 = v2 - v2;
    const v5 = Math.abs(v4);
    const v6 = x[1];
    const v7 = v6 - v6;
    const v8 = Math.abs(v7);
    const v9 = v5 > v8 ? v5 : v8;
    const v10 = Math.abs(v3);
    const v11 = -v6;
    const v12 = Math.abs(v11);
    const v13 = v10 > v12 ? v10 : v12;
    const v14 = v9 > v13 ? v9 : v13;
    const v15 = 0.0;
    const v16 = v14 <= v15;
    const v17 = v16 ? v0 : v14;
    const v18 = program_binade(v17);
    const v19 = v3 * v18;
    const v20 = v4 * v18;
    const v21 = v19 - v20;
    const v22 = Math.abs(v21);
    const v23 = v7 * v18;
    const v24 = v6 * v18;
    const v25 = v23 + v24;
    const v26 = -v25;
    const v27 = Math.abs(v26);
    const v28 = v22 > v27 ? v22 : v27;
    const v29 = v28 <= v15;
    const v30 = v29 ? v0 : v28;
    const v31 = program_binade(v30);
    const v32 = v0 / v31;
    const v33 = v21 * v31;
    const v34 = v33 * v33;
    const v35 = v25 * v31;
    const v36 = v35 * v35;
    const v37 = v34 + v36;
    const v38 = program_root(v37);
    const v39 = v32 * v38;
    const v40 = v39 / v18;
    const v41 = 1.7;
    const v42 = v40 - v41;
    const v43 = v42 + 0.0;
    const v44 = 2.6;
    const v45 = x[2];
    const v46 = v44 - v45;
    const v47 = v46 - v2;
    const v48 = Math.abs(v47);
    const v49 = 0.3;
    const v50 = v49 - v6;
    const v51 = Math.abs(v50);
    const v52 = v48 > v51 ? v48 : v51;
    const v53 = v9 > v52 ? v9 : v52;
    const v54 = v53 <= v15;
    const v55 = v54 ? v0 : v53;
    const v56 = program_binade(v55);
    const v57 = v47 * v56;
    const v58 = v4 * v56;
    const v59 = v57 - v58;
    const v60 = Math.abs(v59);
    const v61 = v50 * v56;
    const v62 = v7 * v56;
    const v63 = v61 - v62;
    const v64 = Math.abs(v63);
    const v65 = v60 > v64 ? v60 : v64;
    const v66 = v65 <= v15;
    const v67 = v66 ? v0 : v65;
    const v68 = program_binade(v67);
    const v69 = v0 / v68;
    const v70 = v59 * v68;
    const v71 = v70 * v70;
    const v72 = v63 * v68;
    const v73 = v72 * v72;
    const v74 = v71 + v73;
    const v75 = program_root(v74);
    const v76 = v69 * v75;
    const v77 = v76 / v56;
    const v78 = 1.5;
    const v79 = v77 - v78;
    const v80 = v79 + 0.0;
    const v81 = -v80;
    const v82 = v43 > v81 ? v43 : v81;
    const v83 = v43 === v43;
    const v84 = v83 ? v0 : v43;
    const v85 = v82 * v84;
    const v86 = v81 === v81;
    const v87 = v86 ? v0 : v81;
    const v88 = v85 * v87;
    const v89 = v88 + 0.0;
    const v90 = 7.458340731200207e-155;
    const v91 = v76 <= v90;
    const v92 = v15 < v74;
    const v93 = !v91;
    const v94 = v92 && v93;
    const v95 = v91 || v94;
    const v96 = v81 < v43;
    const v97 = !v96;
    const v98 = v95 && v97;
    const v99 = v76 <= v15;
    const v100 = v99 ? v0 : v76;
    const v101 = v59 / v100;
    const v102 = v84 * v87;
    const v103 = v81 < v43 ? 0 : v81 === v43 ? v102 * 0.5 : v102;
    const v104 = v103 / v56;
    const v105 = v101 * v104;
    const v106 = -v105;
    const v107 = v91 ? v106 : v15;
    const v108 = v69 * v104;
    const v109 = 0.5;
    const v110 = v108 * v109;
    const v111 = v92 ? v75 : v0;
    const v112 = v110 / v111;
    const v113 = -v112;
    const v114 = v92 ? v113 : v15;
    const v115 = v70 * v114;
    const v116 = v115 + v115;
    const v117 = v68 * v116;
    const v118 = v94 ? v117 : v15;
    const v119 = v107 + v118;
    const v120 = v56 * v119;
    const v121 = -v120;
    const v122 = v98 ? v121 : v15;
    const v123 = v81 <= v43;
    const v124 = v39 <= v90;
    const v125 = v15 < v37;
    const v126 = !v124;
    const v127 = v125 && v126;
    const v128 = v124 || v127;
    const v129 = v123 && v128;
    const v130 = v39 <= v15;
    const v131 = v130 ? v0 : v39;
    const v132 = v21 / v131;
    const v133 = v81 < v43 ? v102 : v81 === v43 ? v102 * 0.5 : 0;
    const v134 = v133 / v18;
    const v135 = v132 * v134;
    const v136 = v124 ? v135 : v15;
    const v137 = v32 * v134;
    const v138 = v109 * v137;
    const v139 = v125 ? v38 : v0;
    const v140 = v138 / v139;
    const v141 = v125 ? v140 : v15;
    const v142 = v33 * v141;
    const v143 = v142 + v142;
    const v144 = v31 * v143;
    const v145 = v127 ? v144 : v15;
    const v146 = v136 + v145;
    const v147 = v18 * v146;
    const v148 = -v147;
    const v149 = v129 ? v148 : v15;
    const v150 = v122 + v149;
    const v151 = v150 + v150;
    const v152 = v151 - v150;
    const v153 = v152 + 0.0;
    const v154 = v63 / v100;
    const v155 = v154 * v104;
    const v156 = -v155;
    const v157 = v91 ? v156 : v15;
    const v158 = v72 * v114;
    const v159 = v158 + v158;
    const v160 = v68 * v159;
    const v161 = v94 ? v160 : v15;
    const v162 = v157 + v161;
    const v163 = v56 * v162;
    const v164 = -v163;
    const v165 = v98 ? v164 : v15;
    const v166 = v25 / v131;
    const v167 = v166 * v134;
    const v168 = v124 ? v167 : v15;
    const v169 = v35 * v141;
    const v170 = v169 + v169;
    const v171 = v31 * v170;
    const v172 = v127 ? v171 : v15;
    const v173 = v168 + v172;
    const v174 = v18 * v173;
    const v175 = v129 ? v174 : v15;
    const v176 = v165 + v175;
    const v177 = v176 + v176;
    const v178 = v177 - v176;
    const v179 = v178 + 0.0;
    const v180 = v122 + 0.0;
    return [v89, v153, v179, v180];
}
