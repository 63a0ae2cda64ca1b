//! Programs as JavaScript, run by Node: the bits of the library, of values and of derivatives.
use geograd::ad::program::{Program, Sym};
use geograd::ad::sample::Draw;
use geograd::kernels::dynamic::{Mode, Rows, Sort};
use geograd::{Error, Obb2, Scalar, Unrecordable, Vec2};
use geograd_tests::list::{self, Tested, are_sampled, columns};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Inputs of a row.
const COUNT: usize = 30;

/// The rows whose text has each helper of modules, and some of the longest.
const ALWAYS: &[&str] = &[
    "iou_obb2",
    "giou_obb2",
    "ciou_obb2",
    "iou_obb3",
    "signed_distance_obb2",
    "kullback_leibler_obb2",
];

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

/// Items of a batch, of which the results are columns.
fn by_item(results: &[Vec<f64>], count: usize) -> Vec<Vec<f64>> {
    let item = |i: usize| {
        let own = |column: &Vec<f64>| {
            let width = column.len() / count;
            column[i * width..(i + 1) * width].to_vec()
        };
        results.iter().flat_map(own).collect()
    };
    (0..count).map(item).collect()
}

/// Adds the value of a row and its derivatives: the gradient of one number, of more the adjoint.
fn add(folder: &mut Folder, row: &Tested) {
    let (operation, name) = (&row.operation, row.name());
    let program = operation.program::<f64>().expect(name);
    let mut hard = row.hard().into_iter().step_by(7).take(COUNT / 2);
    let drawn = |draw: &mut Draw| hard.next().unwrap_or_else(|| row.random(draw));
    let mut items = list::inputs::<f64>(row, COUNT, drawn);
    let batch = |mode: Mode, items: &[Vec<f64>], widths: &[usize]| {
        let function = operation.function::<f64>(mode).expect(name);
        let mut lists = columns(row, items);
        if mode == Mode::Vjp {
            let from = lists.iter().map(|x| x.len() / items.len()).sum::<usize>();
            lists.push(items.iter().flat_map(|x| x[from..].to_vec()).collect());
        }
        let lists = lists.iter().zip(widths);
        let rows: Vec<_> = lists.map(|(list, &width)| Rows::new(list, width)).collect();
        by_item(&function.aligned(&rows).expect(name), items.len())
    };
    let mut widths: Vec<usize> = operation
        .layouts::<f64>()
        .iter()
        .map(|x| x.fields())
        .collect();
    let module = program.javascript("of").expect(name);
    let value = batch(Mode::Value, &items, &widths);
    folder.add(name, &module, &items, &value);
    let outputs = list::outputs(row);
    let (derivatives, mode) = match outputs {
        1 => (program.value_grad().expect(name), Mode::ValueGrad),
        _ => (program.vjp().expect(name), Mode::Vjp),
    };
    if mode == Mode::Vjp {
        let mut draw = Draw::new(3);
        for item in &mut items {
            item.extend((0..outputs).map(|_| draw.within(-2.0, 2.0)));
        }
        widths.push(outputs);
    }
    let expected = batch(mode, &items, &widths);
    let module = derivatives.javascript("of").expect(name);
    folder.add(&format!("{name}_derivatives"), &module, &items, &expected);
}

#[test]
fn every_straight_line_has_its_bits_in_javascript() {
    let mut all = list::rows();
    all.retain(|row| row.operation.sort == Sort::Straight);
    // Shapes with whole numbers have no program.
    all.retain(|row| row.operation.program::<f64>().is_ok());
    let chosen = are_sampled(all.iter().map(|row| row.name()).collect(), ALWAYS);
    let mut folder = Folder::new("rows");
    for row in all.iter().filter(|row| chosen.contains(row.name())) {
        add(&mut folder, row);
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
