//! The shader of a form: a function, and the kernel around it.
use super::operation::Generated;
use super::suppress::masks;
use super::template;
use super::text::{GROUP, KernelForm, bindings, call, numbers, results};
use crate::kernels::cpu::lane::TILE;
use std::fmt::Write;

impl KernelForm {
    /// Returns the shader.
    pub fn text(self, made: &Generated<f32>) -> String {
        let body = self.body(made);
        let kernel = match self {
            KernelForm::Pairs
            | KernelForm::Reduce(..)
            | KernelForm::ReduceGroups(..)
            | KernelForm::Derivatives(..) => {
                return format!(
                    "{}{}\n{}",
                    made.head,
                    body.text,
                    template::text(made, body, self)
                );
            }
            KernelForm::Columns => super::columns::text(made),
            KernelForm::Masks => masks(made, body),
            _ => aligned(made),
        };
        format!("{}{}\n{PLACE}{kernel}", made.head, body.text)
    }
}

/// The index of a number: items in tiles, field after field within a tile, as on the CPU.
const PLACE: &str = "\
fn place(item: u32, fields: u32) -> u32 {
    return item / 16u * 16u * fields + item % 16u;
}
";
const _: () = assert!(TILE == 16);

/// Returns the shader of aligned items: one thread per item. Parameters are the number of items; for every column its
/// start and whether it has more than one item; for every result its start.
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
        // The shader must use a binding, or its layout would omit it.
        inputs.push("inputs[0] * 0.0".to_owned());
    }
    let _ = writeln!(text, "    let y = {};", call("body", inputs));
    text + &results(&made.gives, 1 + columns) + "}\n"
}
