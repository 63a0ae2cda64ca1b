//! Elementary functions have the same bits on every machine: right values of them, and no way to the platform's library.
use geograd::{Lanes, Scalar};

/// Angles to the nearest number, by arithmetic of 200 bits (mpmath).
#[test]
fn angles_are_the_nearest_numbers() {
    let cases: [[f64; 3]; 6] = [
        [1.0, 2.0, 0.463_647_609_000_806_1],
        [
            0.833_765_284_280_119_1,
            5.683_130_712_218_457,
            0.145_669_625_931_378_28,
        ],
        [-3.0, 0.7, -1.341_564_393_517_901_4],
        [1e-300, -1e300, std::f64::consts::PI],
        [5.0, -4.999_999_999_999_999, 2.356_194_490_192_345],
        [1e10, 1.0, 1.570_796_326_694_896_5],
    ];
    for [y, x, angle] in cases {
        assert_eq!(Scalar::atan2(y, x), angle, "{y} {x}");
        assert_eq!(Scalar::atan2(-y, x), -angle, "{y} {x}");
        assert_eq!(Scalar::atan2(Lanes([y; 4]), Lanes([x; 4])).0, [angle; 4]);
    }
    let (zero, infinite, half) = (0.0_f64, f64::INFINITY, std::f64::consts::PI);
    assert_eq!(Scalar::atan2(zero, zero).to_bits(), 0);
    assert_eq!(Scalar::atan2(-zero, -1.0), half);
    assert_eq!(Scalar::atan2(infinite, -infinite), 0.75 * half);
    assert_eq!(Scalar::atan2(-1.0, -infinite), -half);
    assert!(Scalar::atan2(f64::NAN, 1.0).is_nan() && Scalar::atan2(1.0, f64::NAN).is_nan());
}

/// Sines and cosines of angles beyond 800,000, by the same arithmetic, to one unit in the last place.
#[test]
fn sines_of_huge_angles() {
    let cases: [[f64; 3]; 5] = [
        [800_001.0, 0.654_823_199_568_227_1, 0.755_782_096_445_284_8],
        [1e6, -0.349_993_502_171_292_94, 0.936_752_127_533_144_7],
        [1e15, 0.858_272_793_170_235_9, -0.513_193_737_786_970_3],
        [1.7e308, -0.595_256_084_863_207_7, 0.803_536_056_087_918],
        [-3.5e22, -0.242_191_375_633_937_8, 0.970_228_497_606_899_2],
    ];
    for [angle, sin, cos] in cases {
        let found = Scalar::sin_cos(angle);
        for (found, right) in [(found.0, sin), (found.1, cos)] {
            assert!(
                (found - right).abs() <= right.abs() * f64::EPSILON,
                "{angle}: {found}"
            );
        }
        let lanes = Scalar::sin_cos(Lanes([angle; 4]));
        assert_eq!((lanes.0.0, lanes.1.0), ([found.0; 4], [found.1; 4]));
    }
}

/// The lint of clippy.toml judges every method by its type; modules of the harness alone are exempt.
#[test]
fn formulas_call_no_function_of_the_platform() {
    let root = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let text = |file: &str| std::fs::read_to_string(root.join(file)).unwrap();
    let list = text("clippy.toml");
    for format in ["f32", "f64"] {
        for name in [
            "sin", "cos", "tan", "sin_cos", "asin", "acos", "atan", "atan2", "exp", "exp2",
            "exp_m1", "ln", "ln_1p", "log", "log2", "log10", "powf", "cbrt", "hypot", "sinh",
            "cosh", "tanh",
        ] {
            assert!(
                list.contains(&format!("\"{format}::{name}\"")),
                "{format}::{name}"
            );
        }
    }
    assert!(text("src/lib.rs").contains("#![warn(clippy::disallowed_methods)]"));
    let mut exempt = Vec::new();
    let mut open = ["src", "ad", "kernels"]
        .map(|folder| root.join(folder))
        .to_vec();
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(
                std::fs::read_dir(path)
                    .unwrap()
                    .map(|entry| entry.unwrap().path()),
            );
            continue;
        }
        if path.extension().is_none_or(|extension| extension != "rs") {
            continue;
        }
        let text = std::fs::read_to_string(path).unwrap();
        let mut lines = text.lines().peekable();
        while let Some(line) = lines.next() {
            if line.contains("allow(clippy::disallowed_methods)") {
                exempt.push(lines.peek().copied().unwrap_or_default().to_owned());
            }
        }
    }
    exempt.sort_unstable();
    assert_eq!(
        exempt,
        [
            "pub mod check;",
            "pub mod check;",
            "pub mod fuzz;",
            "pub mod sample;"
        ]
    );
}
