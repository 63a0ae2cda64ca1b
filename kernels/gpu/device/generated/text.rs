//! Kernels around a generated function: what every thread reads, calls and writes.
use super::operation::{Body, Generated};
use super::suppress::masks;
use crate::ad::program::WGSL;
use crate::kernels::cpu::lane::TILE;
use std::fmt::Write;

/// Threads per workgroup: few, as large programs need many registers.
pub(super) const GROUP: usize = 64;
pub(super) use crate::kernels::gpu::device::work::MOST_GROUPS;
/// Rows that a thread of all pairs walks through.
pub(super) const ROWS: usize = 16;
/// Rows (or columns) that a thread of an adjoint walks through.
pub(super) const STRIP: usize = 256;
/// Derivatives that are added before their sum is added to that of others, so that rounding grows slowly.
const STEP: usize = 16;

/// The kernel around the function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(in super::super) enum Form {
    /// Item i of every column.
    Aligned,
    /// The same of columns that stay, each in a buffer of its own.
    Columns,
    /// Every row with every column.
    Pairs,
    /// Sums of derivatives of every row of the first list.
    RowDerivatives,
    /// Sums of derivatives of every row of the second list.
    ColumnDerivatives,
    /// Which pairs are above a threshold, as bits.
    Masks,
    /// Instructions of every item.
    Replay,
    /// The edges of every path.
    Fold,
    /// Derivatives of every path.
    FoldDerivatives,
}

impl Form {
    /// The name of its entry point.
    pub fn entry(self) -> &'static str {
        match self {
            Form::Aligned => "aligned_main",
            Form::Columns => "columns_main",
            Form::Pairs => "pairs_main",
            Form::RowDerivatives => "row_slopes_main",
            Form::ColumnDerivatives => "column_slopes_main",
            Form::Masks => "masks_main",
            Form::Replay => "replay_main",
            Form::Fold => "fold_main",
            Form::FoldDerivatives => "fold_slopes_main",
        }
    }
    /// The function that it calls.
    pub(super) fn body(self, made: &Generated<f32>) -> &Body {
        match self {
            Form::RowDerivatives => &made.bodies[1],
            Form::ColumnDerivatives => &made.bodies[2],
            _ => &made.bodies[0],
        }
    }
    /// The shader.
    pub fn text(self, made: &Generated<f32>) -> String {
        let body = self.body(made);
        let kernel = match self {
            Form::RowDerivatives | Form::ColumnDerivatives => derivatives(made, body, self),
            Form::Pairs => pairs(made, body),
            Form::Columns => super::columns::text(made),
            Form::Masks => masks(made, body),
            _ => aligned(made),
        };
        format!("{WGSL}\n{}\n{PLACE}{kernel}", body.text)
    }
}

/// The place of a number: items in tiles, field after field within a tile, as on the processor.
const PLACE: &str = "\
fn place(item: u32, fields: u32) -> u32 {
    return item / 16u * 16u * fields + item % 16u;
}
";
const _: () = assert!(TILE == 16);

/// The bindings of a kernel: what is read, and what is written.
pub(super) fn bindings(parameters: usize, read: &[&str], written: &[&str]) -> String {
    let mut text = format!(
        "@group(0) @binding(0) var<uniform> params: array<vec4u, {}>;\n",
        parameters.max(1)
    );
    let all = read.iter().map(|name| (name, "read"));
    let all = all.chain(written.iter().map(|name| (name, "read_write")));
    for (k, (name, access)) in all.enumerate() {
        let _ = writeln!(
            text,
            "@group(0) @binding({}) var<storage, {access}> {name}: array<f32>;",
            k + 1
        );
    }
    text
}

/// So many numbers of an item, from a place on.
pub(super) fn numbers(buffer: &str, at: &str, count: usize) -> impl Iterator<Item = String> {
    let (buffer, at) = (buffer.to_owned(), at.to_owned());
    (0..count).map(move |k| format!("{buffer}[{at} + {}u]", k * TILE))
}

/// A call of the function, which takes one number at least.
pub(super) fn call(name: &str, mut inputs: Vec<String>) -> String {
    if inputs.is_empty() {
        inputs.push("0.0".to_owned());
    }
    format!(
        "{name}(array<f32, {}>({}))",
        inputs.len(),
        inputs.join(", ")
    )
}

/// Item i of every column: one thread per item. Parameters are how many items; of every column where it
/// begins and whether it has more than one item; of every result where it begins.
fn aligned(made: &Generated<f32>) -> String {
    let columns = made.widths.len();
    let mut text = bindings(1 + columns + made.gives.len(), &["inputs"], &["outputs"]);
    let _ = write!(
        text,
        "
@compute @workgroup_size({GROUP})
fn aligned_main(@builtin(global_invocation_id) thread: vec3u) {{
    let item = thread.x;
    if item >= params[0].x {{
        return;
    }}
"
    );
    let mut inputs = Vec::new();
    for (k, &width) in made.widths.iter().enumerate() {
        let at = k + 1;
        let _ = writeln!(
            text,
            "    let c{k} = params[{at}].x + place(item * params[{at}].y, {width}u);"
        );
        inputs.extend(numbers("inputs", &format!("c{k}"), width));
    }
    if inputs.is_empty() {
        // A binding that nothing uses would be none.
        inputs.push("inputs[0] * 0.0".to_owned());
    }
    let _ = writeln!(text, "    let y = {};", call("body", inputs));
    let mut first = 0;
    for (k, &fields) in made.gives.iter().enumerate() {
        let at = 1 + columns + k;
        let _ = writeln!(
            text,
            "    let r{k} = params[{at}].x + place(item, {fields}u);"
        );
        for field in 0..fields {
            let _ = writeln!(
                text,
                "    outputs[r{k} + {}u] = y[{}];",
                field * TILE,
                first + field
            );
        }
        first += fields;
    }
    text + "}\n"
}

/// The numbers of both shapes of a pair. Shapes that stay are read before the loop, those that are walked
/// through within it.
pub(super) fn both(made: &Generated<f32>, own: usize) -> (String, String, Vec<String>) {
    let (mut outside, mut inside) = (String::new(), String::new());
    let mut inputs = Vec::new();
    for (k, name) in ["a", "b"].into_iter().enumerate() {
        let (text, indent, item) = match k == own {
            true => (&mut outside, "    ", "own"),
            false => (&mut inside, "        ", "walked"),
        };
        let width = made.widths[k];
        let _ = writeln!(
            text,
            "{indent}let {name}_at = place(params[1].{} + {item}, {width}u);",
            if k == 0 { "x" } else { "y" }
        );
        for (i, number) in
            numbers(&format!("{name}_numbers"), &format!("{name}_at"), width).enumerate()
        {
            let _ = writeln!(text, "{indent}let {name}{i} = {number};");
            inputs.push(format!("{name}{i}"));
        }
    }
    (outside, inside, inputs)
}

/// Every row with every column: one thread per column, which walks through some rows. Parameters are how
/// many rows and columns there are here, how many columns the results have and how many numbers a plane of
/// them; then where both lists begin, and where the results.
fn pairs(made: &Generated<f32>, body: &Body) -> String {
    let mut text = bindings(2, &["a_numbers", "b_numbers"], &["outputs"]);
    let (outside, inside, inputs) = both(made, 1);
    let _ = write!(
        text,
        "
@compute @workgroup_size({GROUP})
fn pairs_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {{
    let own = group.x * {GROUP}u + here;
    if own >= params[0].y {{
        return;
    }}
    let first = group.y * {ROWS}u;
    let end = min(first + {ROWS}u, params[0].x);
{outside}    for (var walked = first; walked < end; walked++) {{
{inside}        let y = {};
        let to = (params[1].z + walked) * params[0].z + params[1].w + own;
",
        call("body", inputs)
    );
    for k in 0..body.gives {
        let _ = writeln!(text, "        outputs[to + {k}u * params[0].w] = y[{k}];");
    }
    text + &bound(made, "a_numbers", "b_numbers") + "    }\n}\n"
}

/// Uses of buffers that nothing is read from: a binding that nothing uses would be none.
pub(super) fn bound(made: &Generated<f32>, a: &str, b: &str) -> String {
    let unread = [a, b].into_iter().zip(&made.widths);
    unread
        .filter(|(_, width)| **width == 0)
        .map(|(name, _)| format!("        _ = {name}[0];\n"))
        .collect()
}

/// Sums of derivatives of the shapes of one list: one thread per shape, which walks through a strip of the
/// other list and writes a partial sum. Parameters as for all pairs, then the factor for all results, or
/// whether the upstream matrix has one for each; partial sums go strip by strip, field by field.
fn derivatives(made: &Generated<f32>, body: &Body, form: Form) -> String {
    let (own, own_count, walked_count, at) = match form {
        Form::RowDerivatives => (
            0,
            "x",
            "y",
            "(params[1].z + own) * params[0].z + params[1].w + walked",
        ),
        _ => (
            1,
            "y",
            "x",
            "(params[1].z + walked) * params[0].z + params[1].w + own",
        ),
    };
    let read = ["a_numbers", "b_numbers", "upstream"];
    let mut text = bindings(3, &read, &["sums"]);
    let (outside, inside, mut inputs) = both(made, own);
    inputs.push("seed".to_owned());
    let lines = |line: &dyn Fn(usize) -> String| (0..body.gives).map(line).collect::<String>();
    let variables = lines(&|k| format!("    var total{k} = 0.0;\n    var step{k} = 0.0;\n"));
    let add = lines(&|k| format!("        step{k} += y[{k}];\n"));
    let carry =
        lines(&|k| format!("            total{k} += step{k};\n            step{k} = 0.0;\n"));
    let fields = body.gives;
    let put = lines(&|k| {
        format!(
            "    sums[(group.y * {fields}u + {k}u) * params[0].{own_count} + own] = total{k} + step{k};\n"
        )
    });
    let (entry, result) = (form.entry(), call("body", inputs));
    let unread = bound(made, "a_numbers", "b_numbers");
    let _ = write!(
        text,
        "
@compute @workgroup_size({GROUP})
fn {entry}(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {{
    let own = group.x * {GROUP}u + here;
    if own >= params[0].{own_count} {{
        return;
    }}
    let first = group.y * {STRIP}u;
    let end = min(first + {STRIP}u, params[0].{walked_count});
    let is_one = params[2].y == 1u;
{outside}{variables}    for (var walked = first; walked < end; walked++) {{
{inside}{unread}        var seed = bitcast<f32>(params[2].x);
        if !is_one {{
            seed = upstream[{at}];
        }}
        let y = {result};
{add}        if walked % {STEP}u == {STEP}u - 1u {{
{carry}        }}
    }}
{put}}}
"
    );
    text
}
