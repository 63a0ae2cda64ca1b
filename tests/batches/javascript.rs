//! Programs as JavaScript, run by Node: the bits of the library, of values and of derivatives.
use crate::written::{cases, straight};
use geograd::ad::program::{Program, Sym};
use geograd::ad::sample::Draw;
use geograd::{Error, Obb2, Scalar, Unrecordable, Vec2};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A folder for modules and their cases, written for Node.
struct Folder {
    path: PathBuf,
    cases: String,
}

impl Folder {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        std::fs::create_dir_all(&path).unwrap();
        Folder {
            path,
            cases: String::new(),
        }
    }
    /// Adds a module that exports `of`, with its inputs and the expected results.
    fn add(&mut self, name: &str, module: &str, inputs: &[Vec<f64>], expected: &[Vec<f64>]) {
        std::fs::write(self.path.join(format!("{name}.mjs")), module).unwrap();
        let numbers = inputs.iter().chain(expected).flatten();
        let bytes: Vec<u8> = numbers.flat_map(|x| x.to_ne_bytes()).collect();
        std::fs::write(self.path.join(format!("{name}.bin")), bytes).unwrap();
        let comma = if self.cases.is_empty() { "" } else { "," };
        let (takes, gives, count) = (inputs[0].len(), expected[0].len(), inputs.len());
        let _ = write!(
            self.cases,
            "{comma}{{\"name\":\"{name}\",\"inputs\":{takes},\"outputs\":{gives},\"count\":{count}}}"
        );
    }
    /// Runs all modules and asserts that no result differs; without Node it says so.
    fn run(self) {
        std::fs::write(self.path.join("cases.json"), format!("[{}]", self.cases)).unwrap();
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("batches/javascript.mjs");
        let ran = Command::new("node").arg(script).arg(&self.path).output();
        let Ok(ran) = ran else {
            eprintln!("SKIPPED: node is not installed, so no module of JavaScript was run");
            return;
        };
        let (out, errors) = (
            String::from_utf8_lossy(&ran.stdout),
            String::from_utf8_lossy(&ran.stderr),
        );
        eprint!("{out}");
        assert!(ran.status.success(), "{errors}");
        std::fs::remove_dir_all(&self.path).unwrap();
    }
}

#[test]
fn every_straight_line_has_its_bits_in_javascript() {
    let mut folder = Folder::new("rows");
    for row in straight() {
        for case in cases::<f64>(row) {
            let module = case.program.javascript("of").expect(&case.name);
            folder.add(&case.name, &module, &case.inputs, &case.expected);
        }
    }
    folder.run();
}

#[test]
fn elementary_functions_have_their_bits_in_javascript() {
    let all = Program::trace(|[x, y]: [Sym<f64>; 2]| {
        let [(sin_high, sin_low), (cos_high, cos_low)] = x.sin_cos_parts();
        let (high, low) = x.parts();
        let parts = [sin_high, sin_low, cos_high, cos_low, high, low];
        let simple = [x.sin(), x.cos(), y.atan2(x), x.exp(), x.ln(), x.root()];
        let others = [x.magnitude().binade(), x.least(y), x.most(y), x.over(y)];
        (parts, simple, others)
    })
    .unwrap();
    let mut draw = Draw::new(5);
    let mut inputs: Vec<Vec<f64>> = Vec::new();
    let ends = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        f64::MAX,
        f64::MIN_POSITIVE,
        5e-324,
        8e5,
        800_000.1,
        1.5e6,
    ];
    for x in ends {
        inputs.extend(ends.map(|y| vec![x, y]));
        inputs.extend(ends.map(|y| vec![-x, y]));
    }
    for i in 0..4000 {
        let mut number = || {
            let size = match i % 5 {
                0 => draw.within(-1.0, 1.0),
                1 => draw.within(-12.0, 12.0),
                2 => draw.within(-300.0, 300.0),
                // Angles that the digits of 2/π reduce: some near a multiple of a quarter turn.
                3 => return (draw.within(5e5, 1e9)).floor() * std::f64::consts::FRAC_PI_2,
                _ => return draw.within(-800.0, 800.0),
            };
            let sign = draw.within(-1.0, 1.0).signum();
            sign * Scalar::exp(size * std::f64::consts::LN_10)
        };
        inputs.push(vec![number(), number()]);
    }
    let flat = |x: &Vec<f64>| {
        let (parts, simple, others) = all.eval([x[0], x[1]]);
        [&parts[..], &simple[..], &others[..]].concat()
    };
    let expected: Vec<Vec<f64>> = inputs.iter().map(flat).collect();
    let mut folder = Folder::new("elementary");
    folder.add("all", &all.javascript("of").unwrap(), &inputs, &expected);
    folder.run();
}

#[test]
fn a_module_has_what_it_needs_and_no_more() {
    let sum = Program::trace(|v: Vec2<Sym<f64>>| v.x + v.y).unwrap();
    let module = sum.javascript("sum").unwrap();
    assert!(!module.contains("program_"), "{module}");
    assert!(module.contains("x x, y"), "{module}");
    let turn = Program::trace(|v: Obb2<Sym<f64>>| v.heading.sin()).unwrap();
    let module = turn.javascript("turn").unwrap();
    assert!(module.contains("function program_sin(x)"), "{module}");
    assert!(
        module.contains("function program_rest_of_large"),
        "{module}"
    );
    assert!(!module.contains("program_exp("), "{module}");
    for name in ["Math", "let", "await", "program_sin", "a b", "", "__x", "ä"] {
        let refused = turn.javascript(name).unwrap_err();
        assert_eq!(refused, Error::Program(Unrecordable::Name), "{name}");
    }
}
