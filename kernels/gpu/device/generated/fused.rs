//! Reductions of all pairs by a generated function: the templates of kernels by hand around another body.
use super::operation::Generated;
use super::text::{GROUP, bound, call, numbers};
use crate::ad::program::WGSL;
use crate::kernels::gpu::device::written::{PARAMS, REDUCE, STRIP, Take, constants};
use std::fmt::Write;

const BODY: &str = include_str!("../../wgsl/reduce_body.wgsl");

/// Numbers that are walked and kept near the threads at a time: 8 KiB of the 16 that WebGPU guarantees.
const NEAR: usize = 2048;
/// Walked shapes that are kept near the threads at most.
const MOST_NEAR: usize = 16;

/// The shader that takes this of the results of a function; threads stand for rows or for columns.
pub(super) fn text(made: &Generated<f32>, take: Take, own_rows: bool) -> String {
    let (own, walked) = if own_rows { (0, 1) } else { (1, 0) };
    let names = ["a_numbers", "b_numbers"];
    // Arrays of none do not exist.
    let [wide, width] = [own, walked].map(|k| made.widths[k].max(1));
    let step = (NEAR / width).clamp(1, MOST_NEAR);
    let mut text = format!(
        "{WGSL}\n{}\n{}",
        made.bodies[0].text,
        constants(GROUP, step, STRIP)
    );
    let _ = write!(
        text,
        "const WALKED: u32 = {width}u;\n{PARAMS}{REDUCE}{BODY}"
    );
    let mut at = [
        numbers(names[0], "at", made.widths[0]),
        numbers(names[1], "at", made.widths[1]),
    ];
    let mut own_numbers: Vec<String> = at[own].by_ref().collect();
    if own_numbers.is_empty() {
        own_numbers.push("0.0".to_owned());
    }
    let walked_number = match made.widths[walked] {
        0 => "0.0".to_owned(),
        _ => format!("{}[at]", names[walked]),
    };
    let mut inputs = Vec::new();
    for k in [0, 1] {
        let number = |i: usize| match k == own {
            true => format!("own[{i}]"),
            false => format!("near[{i}u * STEP + i]"),
        };
        inputs.extend((0..made.widths[k]).map(number));
    }
    let unread = bound(made, names[0], names[1]);
    let _ = write!(
        text,
        "
alias Own = array<f32, {wide}>;

fn own_at(item: u32) -> Own {{
{unread}    let at = place(item, {wide}u);
    return Own({});
}}

fn walked_number(at: u32) -> f32 {{
    return {walked_number};
}}

fn score_at(own: Own, start: u32, i: u32, here: u32) -> f32 {{
    let y = {};
    return y[0];
}}
",
        own_numbers.join(", "),
        call("body", inputs)
    );
    text + take.text()
}
