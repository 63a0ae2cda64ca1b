//! Aligned batches of columns on the GPU: each column is read in place, from its own buffer.
use super::operation::Generated;
use super::text::{GROUP, bindings, call, numbers, results};
use std::fmt::Write;

/// Returns the shader: one thread per item. Parameters are the number of items; for every column its start and whether
/// it has more than one item; for every result its start. All results are in one buffer. An unused column has no
/// binding.
pub(super) fn text(made: &Generated<f32>) -> String {
    let columns = made.widths.len();
    let read = made
        .widths
        .iter()
        .enumerate()
        .filter(|(_, width)| **width > 0);
    let names: Vec<String> = read.map(|(k, _)| format!("column{k}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut text = bindings(1 + columns + made.gives.len(), &names, &["outputs"]);
    let _ = write!(
        text,
        "
@compute @workgroup_size({GROUP})
fn columns_main(@builtin(global_invocation_id) thread: vec3u) {{
    let item = thread.x;
    if item >= params[0].x {{
        return;
    }}
"
    );
    let mut inputs = Vec::new();
    for (k, &width) in made
        .widths
        .iter()
        .enumerate()
        .filter(|(_, width)| **width > 0)
    {
        let at = k + 1;
        let _ = writeln!(
            text,
            "    let c{k} = params[{at}].x + place(item * params[{at}].y, {width}u);"
        );
        inputs.extend(numbers(&format!("column{k}"), &format!("c{k}"), width));
    }
    let _ = writeln!(text, "    let y = {};", call("body", inputs));
    text + &results(&made.gives, 1 + columns) + "}\n"
}
