//! Programs as functions of C and kernels of CUDA, with the bits of the library in both formats.
//!
//! The text is C99 and C++ at once, calls no library but `fabs`, `floor` and `sqrt` of `math.h`, and allocates nothing.
//! Elementary functions are the formulas of `src/scalar/`, recorded as programs and printed. A compiler must not
//! contract products and sums (`-ffp-contract=off`, which `-std=c99` implies in GCC; `--fmad=false` for CUDA).
use super::blocks::{Block, Functions, elementary, needed, wrapped};
use super::graph::{Format, Graph, Id, Node};
use super::record::graph_of;
use super::recorded::Recorded;
use super::source::{self, Dialect, expression, lines};
use crate::Unrecordable;
use crate::scalar::float::{REDUCED, sin_cos_reduced, sin_cos_short};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::LazyLock;

/// The words that C, C++ and CUDA keep for themselves, and those with a meaning in the text of a program.
const RESERVED: &str = include_str!("reserved.txt");

/// The function for angles beyond 800000. In place of every sine and cosine it makes a kernel of CUDA three times as
/// long, and NVRTC takes six times as long.
const RARE: &str = "void program_far(";

/// A language with the grammar of C.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Language {
    C,
    Cuda,
}

/// An argument of a program: its name, and how many numbers it has.
pub(crate) type Part = (String, usize);

/// Returns `Ok` for a name that a function may have.
pub(crate) fn checked(name: &str) -> Result<(), Unrecordable> {
    source::checked(name, RESERVED.split_whitespace())
}

/// Returns the name of a format in C.
fn type_of(format: Format) -> &'static str {
    match format {
        Format::F32 => "float",
        Format::F64 => "double",
    }
}

/// Returns the declaration of the function of a program, with a comment on its numbers.
pub(crate) fn header(name: &str, recorded: &Recorded, input: impl Fn(usize) -> String) -> String {
    let kind = type_of(recorded.value.graph.format);
    let guard = format!("GEOGRAD_{}_H", name.to_ascii_uppercase());
    let about = comment(recorded, input);
    format!(
        "#ifndef {guard}\n#define {guard}\n\n#ifdef __cplusplus\nextern \"C\" {{\n#endif\n\n{about}\
         void {name}(const {kind} *x, {kind} *out);\n\n#ifdef __cplusplus\n}}\n#endif\n\n#endif\n"
    )
}

/// Returns the program as a function of C, from numbers to numbers in the order of fields.
pub(crate) fn function(name: &str, recorded: &Recorded, input: impl Fn(usize) -> String) -> String {
    let mut text = "// Written by geograd. Compile it without contraction: -ffp-contract=off.\n\
        #include <math.h>\n#include <string.h>\n\n\
        #ifdef __cplusplus\nextern \"C\" {\n#endif\n\n"
        .to_owned();
    body(Language::C, name, recorded, input, &mut text);
    text.push_str("\n#ifdef __cplusplus\n}\n#endif\n");
    text
}

/// Returns the program as a kernel of CUDA over rows, with results of `gives` numbers:
/// `NAME(count, inner, of_a, a_step, a_inner, ..., out0, ...)`. Row `i inner + j` of a result is computed from the row of
/// `of_a` at `i a_step + j a_inner`, so that rows may be apart, repeat, or be those of a matrix of pairs. Rows of a result
/// follow each other.
pub(crate) fn kernel(
    name: &str,
    recorded: &Recorded,
    arguments: &[Part],
    gives: &[usize],
    input: impl Fn(usize) -> String,
) -> String {
    let kind = type_of(recorded.value.graph.format);
    let (takes, results) = (recorded.inputs, recorded.value.outputs.len());
    let mut text =
        "// Written by geograd. Compile it without contraction: --fmad=false.\n\n".to_owned();
    body(Language::Cuda, "program_of_row", recorded, input, &mut text);
    let _ = write!(
        text,
        "\nextern \"C\" __global__ void {name}(long long count, long long inner"
    );
    for (argument, _) in arguments {
        let _ = write!(
            text,
            ", const {kind} *of_{argument}, long long {argument}_step, long long {argument}_inner"
        );
    }
    for k in 0..gives.len() {
        let _ = write!(text, ", {kind} *out{k}");
    }
    let _ = write!(
        text,
        ") {{\n\
         \x20   const long long row = (long long)blockIdx.x * blockDim.x + threadIdx.x;\n\
         \x20   {kind} x[{}], y[{}];\n\
         \x20   if (row >= count) {{\n        return;\n    }}\n\
         \x20   const long long i = inner == 1 ? row : row / inner, j = row - i * inner;\n",
        takes.max(1),
        results.max(1)
    );
    let copy = |text: &mut String, width: usize, to: &str, of: &str| {
        let _ = write!(
            text,
            "    for (int k = 0; k < {width}; k += 1) {{\n        {to} = {of};\n    }}\n"
        );
    };
    let mut from = 0;
    for (argument, width) in arguments {
        let of = format!("of_{argument}[i * {argument}_step + j * {argument}_inner + k]");
        copy(&mut text, *width, &format!("x[{from} + k]"), &of);
        from += width;
    }
    text.push_str("    program_of_row(x, y);\n");
    from = 0;
    for (k, width) in gives.iter().enumerate() {
        let to = format!("out{k}[row * {width} + k]");
        copy(&mut text, *width, &to, &format!("y[{from} + k]"));
        from += width;
    }
    text.push_str("}\n");
    text
}

/// Returns the comment on the function of a program.
fn comment(recorded: &Recorded, input: impl Fn(usize) -> String) -> String {
    let (takes, gives) = (recorded.inputs, recorded.value.outputs.len());
    let mut text = format!("/* x: {takes} numbers\n");
    for line in wrapped((0..takes).map(input)) {
        let _ = writeln!(text, " *    {line}");
    }
    let _ = writeln!(
        text,
        " * out: {gives} numbers, all NaN if a number of x is NaN; it may be x itself */"
    );
    text
}

/// Writes the declarations that a program needs, and its function.
fn body(
    language: Language,
    name: &str,
    recorded: &Recorded,
    input: impl Fn(usize) -> String,
    text: &mut String,
) {
    let (graph, outputs) = (&recorded.value.graph, &recorded.value.outputs);
    let (kind, takes, gives) = (type_of(graph.format), recorded.inputs, outputs.len());
    let turned = turned(graph);
    let mut code = String::new();
    for angle in turned.keys() {
        let _ = writeln!(code, "    double turned{angle}[2];");
    }
    let dialect = C {
        format: graph.format,
        takes: &[],
        turned,
    };
    let known = lines(&dialect, graph, &mut code);
    for (i, &x) in outputs.iter().enumerate() {
        let _ = writeln!(code, "    out[{i}] = {};", known[x as usize]);
    }
    // A kernel calls its function, and others call that of C.
    let qualifier = match language {
        Language::C => "",
        Language::Cuda => "static ",
    };
    let [zero, _] = dialect.shares();
    // NaN in, NaN out, by the sum that `Guard` has.
    let function = format!(
        "{}{qualifier}void {name}(const {kind} *x, {kind} *out) {{\n\
         \x20   {kind} sum = {zero};\n    int i;\n\
         \x20   for (i = 0; i < {takes}; i += 1) {{\n        sum += x[i];\n    }}\n\
         \x20   if (sum != sum) {{\n\
         \x20       for (i = 0; i < {gives}; i += 1) {{\n            out[i] = sum;\n        }}\n\
         \x20       return;\n    }}\n{code}}}\n",
        comment(recorded, input)
    );
    let mut all = String::new();
    for block in needed(prelude(language, graph.format), &function) {
        let _ = writeln!(all, "{block}\n");
    }
    all.push_str(&function);
    match language {
        Language::C => text.push_str(&all),
        // Functions and tables of the device.
        Language::Cuda => {
            let device = all.lines().map(|line| match line.strip_prefix("static ") {
                Some(rest) if rest.starts_with(RARE) => {
                    format!("static __device__ __noinline__ {rest}\n")
                }
                Some(rest) => format!("static __device__ {rest}\n"),
                None => format!("{line}\n"),
            });
            text.extend(device);
        }
    }
}

/// Returns the angle of a sine, a cosine, or a part of one, and its place in what `program_sin_cos` writes.
fn angle_of(node: Node) -> Option<(Id, usize)> {
    use Node::*;
    match node {
        Sin(angle) | SinHigh(angle) | SinLow(angle) => Some((angle, 0)),
        Cos(angle) | CosHigh(angle) | CosLow(angle) => Some((angle, 1)),
        _ => None,
    }
}

/// Returns the angles that have several sines, cosines, or parts of them, each with the first node of all.
fn turned(graph: &Graph) -> BTreeMap<Id, Id> {
    let mut first = BTreeMap::new();
    let mut several = BTreeMap::new();
    for (id, &node) in (0..).zip(graph.nodes()) {
        let Some((angle, _)) = angle_of(node) else {
            continue;
        };
        match first.get(&angle) {
            Some(&earlier) => _ = several.insert(angle, earlier),
            None => _ = first.insert(angle, id),
        }
    }
    several
}

/// Returns the function of a sine and a cosine at once, which share most of their operations. Its branch for large angles
/// keeps compilers from joining two calls.
fn sine_and_cosine(format: Format) -> String {
    let recorded = graph_of(Format::F64, 1, &|x| {
        let (sine, cosine) = match format {
            Format::F32 => sin_cos_short(x[0]),
            Format::F64 => sin_cos_reduced(x[0]),
        };
        vec![sine, cosine]
    });
    let (graph, outputs) = match recorded {
        Ok(made) => made,
        Err(_) => unreachable!("the formulas of scalars are straight lines"),
    };
    let mut code = String::new();
    let known = lines(&C::dialect(&["x"]), &graph, &mut code);
    let [sine, cosine] = [0, 1].map(|k: usize| &known[outputs[k] as usize]);
    format!(
        "// The sine and the cosine.\nstatic void program_sin_cos(double x, double out[2]) {{\n\
         \x20   if (!(fabs(x) <= {REDUCED:?})) {{\n        program_far(x, out);\n        return;\n    }}\n\
         {code}    out[0] = {sine};\n    out[1] = {cosine};\n}}"
    )
}

/// Returns all declarations that programs may need, each after those that it needs.
fn prelude(language: Language, format: Format) -> &'static [Block] {
    static ALL: LazyLock<[Vec<Block>; 4]> = LazyLock::new(|| {
        [
            (Language::C, Format::F32),
            (Language::C, Format::F64),
            (Language::Cuda, Format::F32),
            (Language::Cuda, Format::F64),
        ]
        .map(|(language, format)| {
            let bits = match language {
                Language::C => include_str!("host.c"),
                Language::Cuda => include_str!("device.cu"),
            };
            let [simple, parts] = match format {
                Format::F32 => [include_str!("float.c"), include_str!("float_parts.c")],
                Format::F64 => [include_str!("double.c"), include_str!("double_parts.c")],
            };
            let split = |text: &str| {
                let blocks = text.trim_end().split("\n\n");
                blocks.map(str::to_owned).collect::<Vec<_>>()
            };
            let texts = [
                split(bits),
                split(include_str!("wide.c")),
                split(simple),
                elementary::<C<'_>>(format),
                vec![sine_and_cosine(format)],
                split(parts),
            ];
            let blocks = texts.into_iter().flatten();
            blocks.map(|text| Block::new(text, declared)).collect()
        })
    });
    &ALL[2 * usize::from(language == Language::Cuda) + usize::from(format == Format::F64)]
}

/// Returns the name that a line declares.
fn declared(line: &str) -> Option<&str> {
    let rest = line.strip_prefix("static ")?;
    rest.split(['(', '[']).next()?.rsplit(' ').next()
}

/// The language for a format, with names for the numbers of an input; without names they are those of an array `x`.
struct C<'a> {
    format: Format,
    takes: &'a [&'a str],
    /// The angles whose sines and cosines one call computes, each with the first node of all.
    turned: BTreeMap<Id, Id>,
}

impl C<'_> {
    /// Returns a sine or a cosine in the format, or a part of it, from its 64 bits.
    fn part_of(&self, node: Node, whole: &str) -> String {
        let high = match self.format {
            Format::F32 => format!("program_wide_high({whole})"),
            Format::F64 => format!("program_high({whole})"),
        };
        let part = match node {
            Node::SinHigh(_) | Node::CosHigh(_) => high,
            Node::SinLow(_) | Node::CosLow(_) => format!("({whole} - {high})"),
            _ => whole.to_owned(),
        };
        match self.format {
            Format::F32 => format!("(float){part}"),
            Format::F64 => part,
        }
    }
}

impl Functions for C<'_> {
    type Of = C<'static>;
    fn dialect(takes: &'static [&'static str]) -> C<'static> {
        let format = Format::F64;
        let turned = BTreeMap::new();
        C {
            format,
            takes,
            turned,
        }
    }
    fn head(name: &str, takes: &[&str]) -> String {
        let takes: Vec<_> = takes.iter().map(|name| format!("double {name}")).collect();
        format!("static double {name}({})", takes.join(", "))
    }
    fn far(part: usize) -> String {
        format!(
            "    if (!(fabs(x) <= {REDUCED:?})) {{\n        double far[2];\n        program_far(x, far);\n        \
             return far[{part}];\n    }}\n"
        )
    }
}

/// Returns `true` for the nodes that are truths.
fn is_truth(node: Node) -> bool {
    use Node::*;
    matches!(
        node,
        Bool(_) | Lt(..) | Le(..) | Eq(..) | And(..) | Or(..) | Not(_)
    )
}

impl Dialect for C<'_> {
    const SIGNS: [&'static str; 3] = ["==", "&&", "||"];

    fn shares(&self) -> [&'static str; 2] {
        match self.format {
            Format::F32 => ["0.0f", "0.5f"],
            Format::F64 => ["0.0", "0.5"],
        }
    }
    fn defines(&self, node: Node) -> &'static str {
        match (is_truth(node), self.format) {
            (true, _) => "const int",
            (false, Format::F32) => "const float",
            (false, Format::F64) => "const double",
        }
    }
    fn literal(&self, x: f64) -> String {
        if !x.is_finite() {
            let bits = x.to_bits();
            return match self.format {
                Format::F32 => format!("program_float_of_bits({:#x}u)", (x as f32).to_bits()),
                Format::F64 => format!("program_of_bits({bits:#x}ull)"),
            };
        }
        match self.format {
            Format::F32 => format!("{:?}f", x as f32),
            Format::F64 => format!("{x:?}"),
        }
    }
    fn extreme(&self, is_most: bool, a: &str, b: &str) -> String {
        // The functions of `math.h` differ for NaN.
        let sign = if is_most { '>' } else { '<' };
        format!("{a} {sign} {b} ? {a} : {b}")
    }
    fn magnitude(&self, x: &str) -> String {
        match self.format {
            Format::F32 => format!("fabsf({x})"),
            Format::F64 => format!("fabs({x})"),
        }
    }
    fn select(&self, mask: &str, yes: &str, no: &str) -> String {
        format!("{mask} ? {yes} : {no}")
    }
    fn is_number(&self, x: &str) -> String {
        format!("{x} == {x}")
    }
    fn input(&self, place: u32) -> String {
        match self.takes.get(place as usize) {
            Some(&name) => name.to_owned(),
            None => format!("x[{place}]"),
        }
    }
    fn value(&self, id: usize, node: Node, known: &[String]) -> String {
        if let Some((x, place)) = angle_of(node)
            && let Some(&first) = self.turned.get(&x)
        {
            let own = self.part_of(node, &format!("turned{x}[{place}]"));
            return match first as usize == id {
                true => format!("(program_sin_cos({}, turned{x}), {own})", known[x as usize]),
                false => own,
            };
        }
        match node {
            Node::Bool(truth) => u8::from(truth).to_string(),
            Node::Canonical(x) => format!("{} + {}", known[x as usize], self.shares()[0]),
            _ => expression(self, node, known),
        }
    }
}
