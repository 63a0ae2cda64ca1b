//! Programs as C and CUDA: compiled by the compilers of the system, with all warnings, they have the library's bits.
use crate::written::{Case, cases, elementary, numbers, replays, searches, straight};
use geograd::ad::program::{Program, Sym};
use geograd::kernels::dynamic;
use geograd::{Error, Obb2, Real, Scalar, Unrecordable, Vec2};
use geograd_tests::list::share_of;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A folder with functions, their cases, and a program that runs all.
struct Folder {
    path: PathBuf,
    includes: String,
    runs: String,
    sources: Vec<PathBuf>,
}

impl Folder {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).unwrap();
        Folder {
            path,
            includes: String::new(),
            runs: String::new(),
            sources: Vec::new(),
        }
    }
    /// Adds a function with its inputs and the expected results.
    fn add<T: Number>(
        &mut self,
        name: &str,
        [header, source]: [&str; 2],
        inputs: &[Vec<T>],
        expected: &[Vec<T>],
    ) {
        let file = |ending: &str| self.path.join(format!("{name}.{ending}"));
        std::fs::write(file("h"), header).unwrap();
        std::fs::write(file("c"), source).unwrap();
        let numbers = inputs.iter().chain(expected).flatten();
        let bytes: Vec<u8> = numbers.flat_map(|&x| x.bytes()).collect();
        std::fs::write(file("bin"), bytes).unwrap();
        self.sources.push(file("c"));
        let (takes, gives, count) = (inputs[0].len(), expected[0].len(), inputs.len());
        let _ = writeln!(self.includes, "#include \"{name}.h\"");
        let kind = T::C;
        let _ = writeln!(
            self.runs,
            "    RUN({kind}, {name}, {takes}, {gives}, {count});"
        );
    }
    /// Adds a program under a name of its own.
    fn add_case<T: Number>(&mut self, case: &Case<T>) {
        let name = format!("{}_{}", case.name, T::C);
        let header = case.program.c_header(&name).expect(&name);
        let source = case.program.c(&name).expect(&name);
        self.add(&name, [&header, &source], &case.inputs, &case.expected);
    }
    /// Compiles and runs all functions, and asserts that no result differs; without a compiler it says so.
    fn run(self, compiler: &str, options: &[&str]) {
        let main = self.path.join("main.c");
        let text = format!(
            "#include \"{}/batches/c_source.c\"\n{}\nint main(void) {{\n{}    \
             printf(\"%ld numbers, %d wrong\\n\", results, wrong);\n    return wrong != 0;\n}}\n",
            env!("CARGO_MANIFEST_DIR"),
            self.includes,
            self.runs
        );
        std::fs::write(&main, text).unwrap();
        let built = Command::new(compiler)
            .args(options)
            .args([
                "-Wall",
                "-Wextra",
                "-Werror",
                "-pedantic",
                "-O0",
                "-ffp-contract=off",
            ])
            .args(["-I".as_ref(), self.path.as_os_str()])
            .arg(&main)
            .args(&self.sources)
            .args(["-lm", "-o"])
            .arg(self.path.join("all"))
            .output();
        let Ok(built) = built else {
            eprintln!("SKIPPED: {compiler} is not installed, so no function of C was run");
            return;
        };
        let errors = String::from_utf8_lossy(&built.stderr);
        assert!(built.status.success(), "{errors}");
        let ran = Command::new(self.path.join("all"))
            .current_dir(&self.path)
            .output();
        let ran = ran.expect("the program was built");
        eprint!("{}", String::from_utf8_lossy(&ran.stdout));
        let errors = String::from_utf8_lossy(&ran.stderr);
        assert!(ran.status.success(), "{errors}");
        std::fs::remove_dir_all(&self.path).unwrap();
    }
}

/// A format: its name in C, and the bytes of a number.
trait Number: Real {
    const C: &'static str;
    fn bytes(self) -> Vec<u8>;
}
impl Number for f32 {
    const C: &'static str = "float";
    fn bytes(self) -> Vec<u8> {
        self.to_ne_bytes().to_vec()
    }
}
impl Number for f64 {
    const C: &'static str = "double";
    fn bytes(self) -> Vec<u8> {
        self.to_ne_bytes().to_vec()
    }
}

#[test]
fn every_straight_line_has_its_bits_in_c() {
    let mut folder = Folder::new("rows_of_c");
    // Compilers take most of the time.
    for row in share_of(straight(), 12) {
        for case in cases::<f64>(row) {
            folder.add_case(&case);
        }
        for case in cases::<f32>(row) {
            folder.add_case(&case);
        }
    }
    for row in share_of(searches(), 24) {
        for case in replays::<f64>(row).iter().take(1) {
            folder.add_case(case);
        }
    }
    folder.run("cc", &["-std=c99"]);
}

#[test]
fn elementary_functions_have_their_bits_in_c_and_cpp() {
    for (compiler, options) in [
        ("cc", &["-std=c99"][..]),
        ("c++", &["-x", "c++", "-std=c++11"][..]),
    ] {
        let mut folder = Folder::new(&format!("elementary_of_{compiler}"));
        let wide = Program::trace(elementary::<Sym<f64>>).unwrap();
        let inputs = numbers::<f64>();
        let results = inputs.iter().map(|x| wide.eval([x[0], x[1]]).to_vec());
        let results: Vec<_> = results.collect();
        let texts = [wide.c_header("wide").unwrap(), wide.c("wide").unwrap()];
        folder.add("wide", [&texts[0], &texts[1]], &inputs, &results);
        // Above, one call computes both of an angle.
        let apart = |[x, y]: [Sym<f64>; 2]| [x.sin(), y.cos()];
        let apart = Program::trace(apart).unwrap();
        let results = inputs.iter().map(|x| apart.eval([x[0], x[1]]).to_vec());
        let results: Vec<_> = results.collect();
        let texts = [apart.c_header("apart").unwrap(), apart.c("apart").unwrap()];
        folder.add("apart", [&texts[0], &texts[1]], &inputs, &results);
        let single = Program::trace(elementary::<Sym<f32>>).unwrap();
        let inputs = numbers::<f32>();
        let results = inputs.iter().map(|x| single.eval([x[0], x[1]]).to_vec());
        let results: Vec<_> = results.collect();
        let texts = [
            single.c_header("single").unwrap(),
            single.c("single").unwrap(),
        ];
        folder.add("single", [&texts[0], &texts[1]], &inputs, &results);
        folder.run(compiler, options);
    }
}

#[test]
fn a_function_has_what_it_needs_and_no_more() {
    let sum = Program::trace(|v: Vec2<Sym<f64>>| v.x + v.y).unwrap();
    let source = sum.c("total").unwrap();
    assert!(!source.contains("program_"), "{source}");
    assert!(source.contains("*    x, y"), "{source}");
    let turn = Program::trace(|v: Obb2<Sym<f32>>| v.heading.sin()).unwrap();
    let source = turn.c("turn").unwrap();
    assert!(
        source.contains("static float program_sin(float x)"),
        "{source}"
    );
    assert!(source.contains("program_rest_of_large"), "{source}");
    assert!(!source.contains("program_wide_exp"), "{source}");
    let far = "static __device__ __noinline__ void program_far(";
    assert!(turn.cuda("turn").unwrap().contains(far));
    // A sine and a cosine of one angle share a call, one of them alone has its own.
    let both = Program::trace(|v: Vec2<Sym<f64>>| v.y.cos() * v.y.sin() + v.x.sin()).unwrap();
    let source = both.c("both").unwrap();
    assert_eq!(source.matches("(program_sin_cos(").count(), 1, "{source}");
    assert_eq!(source.matches("= program_sin(").count(), 1, "{source}");
    assert!(!source.contains("program_cos("), "{source}");
    let kernel = both.cuda("both").unwrap();
    assert_eq!(kernel.matches("(program_sin_cos(").count(), 1, "{kernel}");
    for name in [
        "int",
        "float",
        "template",
        "sqrt",
        "program_sin",
        "a b",
        "",
        "__x",
        "ä",
    ] {
        for refused in [turn.c(name), turn.c_header(name), turn.cuda(name)] {
            assert_eq!(
                refused.unwrap_err(),
                Error::Program(Unrecordable::Name),
                "{name}"
            );
        }
    }
}

/// The kernel of CUDA, compiled as C++ with a grid of one processor that runs thread after thread.
#[test]
fn kernels_of_cuda_have_the_bits_on_a_grid_of_one_processor() {
    let rows = share_of(straight(), 24);
    let mut all = dynamic_cases::<f64>(&rows);
    all.extend(dynamic_cases::<f32>(&rows));
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("kernels_of_cuda");
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    let (mut declared, mut runs, mut sources) = (String::new(), String::new(), Vec::new());
    for (name, kernel, bytes, run, declaration) in all {
        let source = path.join(format!("{name}.cpp"));
        std::fs::write(&source, format!("#include \"cuda_grid.h\"\n{kernel}")).unwrap();
        std::fs::write(path.join(format!("{name}.bin")), bytes).unwrap();
        declared.push_str(&declaration);
        runs.push_str(&run);
        sources.push(source);
    }
    let folder = env!("CARGO_MANIFEST_DIR");
    let text = format!(
        "#define GRID\n#include \"{folder}/batches/cuda_grid.h\"\n#include \"{folder}/batches/c_source.c\"\n\
         {declared}\nint main() {{\n{runs}    printf(\"%ld numbers, %d wrong\\n\", results, wrong);\n    \
         return wrong != 0;\n}}\n"
    );
    let main = path.join("main.cpp");
    std::fs::write(&main, text).unwrap();
    let built = Command::new("c++")
        .args([
            "-std=c++11",
            "-Wall",
            "-Wextra",
            "-Werror",
            "-O0",
            "-ffp-contract=off",
        ])
        .arg(format!("-I{folder}/batches"))
        .arg(&main)
        .args(&sources)
        .arg("-o")
        .arg(path.join("all"))
        .output();
    let Ok(built) = built else {
        eprintln!("SKIPPED: c++ is not installed, so no kernel of CUDA was run");
        return;
    };
    assert!(
        built.status.success(),
        "{}",
        String::from_utf8_lossy(&built.stderr)
    );
    let ran = Command::new(path.join("all")).current_dir(&path).output();
    let ran = ran.expect("the program was built");
    eprint!("{}", String::from_utf8_lossy(&ran.stdout));
    assert!(
        ran.status.success(),
        "{}",
        String::from_utf8_lossy(&ran.stderr)
    );
    std::fs::remove_dir_all(&path).unwrap();
}

/// The name of a case, its kernel, its numbers, the line that runs it, and its declaration.
type Kernel = (String, String, Vec<u8>, String, String);

/// Returns the derivatives of rows as kernels, with each argument in an array of its own.
fn dynamic_cases<T: Number>(rows: &[&'static geograd_tests::list::Tested]) -> Vec<Kernel> {
    let each = rows.iter().map(|row| {
        let [_, case] = cases::<T>(row);
        let name = format!("{}_{}", case.name, T::C);
        let program: &dynamic::Program<T> = &case.program;
        let kernel = program.cuda(&name).expect(&name);
        let widths: Vec<usize> = program.takes().iter().map(|(_, x)| x.fields()).collect();
        let (takes, gives) = (case.inputs[0].len(), case.expected[0].len());
        let count = case.inputs.len();
        let results = program.gives().to_vec();
        let mut numbers: Vec<T> = case.inputs.concat();
        // Every result has an array of its own.
        let (mut outs, mut types_of_outs) = (Vec::new(), Vec::new());
        let mut from = 0;
        for width in results {
            let own = |item: &Vec<T>| item[from..from + width].to_vec();
            numbers.extend(case.expected.iter().flat_map(own));
            outs.push(format!("out + {from} * {count}"));
            types_of_outs.push(format!("{} *", T::C));
            from += width;
        }
        let bytes = numbers.iter().flat_map(|&x| x.bytes()).collect();
        // Rows of all arguments lie beside each other, so that the step is the sum of widths.
        let mut from = 0;
        let (mut arguments, mut types) = (String::new(), String::new());
        for width in widths {
            let _ = write!(arguments, "x + {from}, {takes}, 0, ");
            let _ = write!(types, "const {} *, long long, long long, ", T::C);
            from += width;
        }
        let kind = T::C;
        let (outs, types_of_outs) = (outs.join(", "), types_of_outs.join(", "));
        let declaration =
            format!("extern \"C\" void {name}(long long, long long, {types}{types_of_outs});\n");
        let run = format!(
            "    RUN_GRID({kind}, {name}, {takes}, {gives}, {count}, ({count}, 1, {arguments}{outs}));\n"
        );
        (name, kernel, bytes, run, declaration)
    });
    each.collect()
}
