//! Programs as JavaScript, run by Node: the bits of the library, of values and of derivatives.
use crate::written::{Case, cases, elementary, numbers, replays, searches, straight};
use geograd::ad::program::{Program, Sym};
use geograd::{Error, Obb2, Real, Scalar, Unrecordable, Vec2};
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
    fn add<T: Real>(&mut self, name: &str, module: &str, inputs: &[Vec<T>], expected: &[Vec<T>]) {
        std::fs::write(self.path.join(format!("{name}.mjs")), module).unwrap();
        let numbers = inputs.iter().chain(expected).flatten();
        // As 64 bits, which hold the numbers of 32.
        let bytes: Vec<u8> = numbers.flat_map(|x| x.widen().to_ne_bytes()).collect();
        std::fs::write(self.path.join(format!("{name}.bin")), bytes).unwrap();
        let comma = if self.cases.is_empty() { "" } else { "," };
        let (takes, gives, count) = (inputs[0].len(), expected[0].len(), inputs.len());
        let _ = write!(
            self.cases,
            "{comma}{{\"name\":\"{name}\",\"inputs\":{takes},\"outputs\":{gives},\"count\":{count}}}"
        );
    }
    /// Adds a program under a name of its own.
    fn add_case<T: Real>(&mut self, case: &Case<T>) {
        let name = format!("{}_{}", case.name, 8 * size_of::<T>());
        let module = case.program.javascript("of").expect(&name);
        self.add(&name, &module, &case.inputs, &case.expected);
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
            folder.add_case(&case);
        }
        for case in cases::<f32>(row) {
            folder.add_case(&case);
        }
    }
    folder.run();
}

#[test]
fn replays_of_searches_have_their_bits_in_javascript() {
    let mut folder = Folder::new("replays");
    for row in searches() {
        for case in replays::<f64>(row) {
            folder.add_case(&case);
        }
        for case in replays::<f32>(row) {
            folder.add_case(&case);
        }
    }
    folder.run();
}

#[test]
fn elementary_functions_have_their_bits_in_javascript() {
    fn add<T: Real>(folder: &mut Folder, name: &str) {
        let all = Program::trace(elementary::<Sym<T>>).unwrap();
        let inputs = numbers::<T>();
        let results = inputs.iter().map(|x| all.eval([x[0], x[1]]).to_vec());
        let expected: Vec<Vec<T>> = results.collect();
        folder.add(name, &all.javascript("of").unwrap(), &inputs, &expected);
    }
    let mut folder = Folder::new("elementary");
    add::<f64>(&mut folder, "wide");
    add::<f32>(&mut folder, "single");
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
    let single = Program::trace(|v: Obb2<Sym<f32>>| v.heading.sin()).unwrap();
    let module = single.javascript("turn").unwrap();
    assert!(module.contains("In 32-bit floats"), "{module}");
    assert!(
        module.contains("return Math.fround(program_wide_sin(x));"),
        "{module}"
    );
    for name in ["Math", "let", "await", "program_sin", "a b", "", "__x", "ä"] {
        let refused = turn.javascript(name).unwrap_err();
        assert_eq!(refused, Error::Program(Unrecordable::Name), "{name}");
    }
}
