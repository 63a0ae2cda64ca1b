//! The shader of a form: the function, and the kernel around it.
use super::operation::{Body, Generated};
use super::suppress::masks;
use super::text::{Form, GROUP, ROWS, STRIP, bindings, both, bound, call, numbers, results};
use crate::ad::program::WGSL;
use crate::kernels::cpu::lane::TILE;
use std::fmt::Write;

/// Derivatives that are added before their sum is added to that of others, so that rounding grows slowly.
const STEP: usize = 16;

impl Form {
    /// The shader.
    pub fn text(self, made: &Generated<f32>) -> String {
        let body = self.body(made);
        if let Form::Reduce(take, own_rows) = self {
            return super::fused::text(made, take, own_rows);
        }
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
    text + &results(&made.gives, 1 + columns) + "}\n"
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
