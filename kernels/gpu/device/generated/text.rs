//! Text of kernels around a generated function: the reads, the call and the writes of a thread.
use super::operation::{Generated, ShaderBody};
use crate::kernels::cpu::lane::TILE;
use std::collections::HashMap;
use std::fmt::Write;
use std::sync::{Arc, OnceLock, Weak};

/// The number of threads of a workgroup: few, since large programs need many registers.
pub(in crate::kernels::gpu::device) const GROUP: usize = 64;
pub(super) use crate::kernels::gpu::device::work::MOST_GROUPS;
use crate::kernels::gpu::device::written::{SeedSource, Take};
/// The least number of rows that a thread of all pairs walks through.
pub(super) const ROWS: usize = 16;

/// The lists whose derivatives a kernel sums.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(in crate::kernels::gpu::device) enum SummedLists {
    /// The first one.
    Rows,
    /// The second one.
    Columns,
    /// Both, with the number of slots for sums of rows: the largest number of subgroups of a workgroup; 0 without
    /// subgroups.
    Both(usize),
}

/// The form of a kernel around a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(in super::super) enum KernelForm {
    /// Item i of every column.
    Aligned,
    /// Item i of columns on the GPU, each in a buffer of its own.
    Columns,
    /// Every row with every column.
    Pairs,
    /// Sums of derivatives of the shapes of lists, with a factor for every pair or one for all.
    Derivatives(SummedLists, SeedSource),
    /// A reduction of every row with every column, by threads for rows or for columns.
    Reduce(Take, bool),
    /// A reduction within groups, by threads for rows or for columns.
    ReduceGroups(Take, bool),
    /// Bits that say which pairs are above a threshold.
    Masks,
    /// The instructions of every item.
    Replay,
    /// The edges of every path.
    Fold,
    /// The derivatives of every path.
    FoldDerivatives,
}

impl KernelForm {
    /// Returns the name of the entry point.
    pub fn entry(self) -> &'static str {
        match self {
            KernelForm::Aligned => "aligned_main",
            KernelForm::Columns => "columns_main",
            KernelForm::Pairs => "pairs_main",
            KernelForm::Derivatives(SummedLists::Both(_), _) => "pairs_vjp_main",
            KernelForm::Derivatives(..) => "slopes_main",
            KernelForm::Reduce(..) | KernelForm::ReduceGroups(..) => "reduce_main",
            KernelForm::Masks => "masks_main",
            KernelForm::Replay => "replay_main",
            KernelForm::Fold => "fold_main",
            KernelForm::FoldDerivatives => "fold_slopes_main",
        }
    }
    /// Returns the function that it calls.
    pub(super) fn body(self, made: &Generated<f32>) -> &ShaderBody {
        match self {
            KernelForm::Derivatives(SummedLists::Rows, _) => &made.bodies[1],
            KernelForm::Derivatives(SummedLists::Columns, _) => &made.bodies[2],
            _ => &made.bodies[0],
        }
    }
}

/// Returns the bindings of a kernel: of buffers to read, and of buffers to write.
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

/// Returns the expressions of `count` numbers of an item, beginning at index `at`.
pub(super) fn numbers(buffer: &str, at: &str, count: usize) -> impl Iterator<Item = String> {
    let (buffer, at) = (buffer.to_owned(), at.to_owned());
    (0..count).map(move |k| format!("{buffer}[{at} + {}u]", k * TILE))
}

/// Returns the expression of a call of the function, which takes at least one number.
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

/// Returns the numbers of both shapes of a pair. Own shapes are read before the loop, walked ones within it.
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

/// Returns statements that use the buffers from which nothing is read, since the layout omits an unused binding.
pub(super) fn bound(made: &Generated<f32>, a: &str, b: &str) -> String {
    let unread = [a, b].into_iter().zip(&made.widths);
    unread
        .filter(|(_, width)| **width == 0)
        .map(|(name, _)| format!("        _ = {name}[0];\n"))
        .collect()
}

/// Returns statements that store the results `y` of an item at the indices in the parameters from number `parameter`
/// on.
pub(super) fn results(gives: &[usize], parameter: usize) -> String {
    let (mut text, mut first) = (String::new(), 0);
    for (k, &fields) in gives.iter().enumerate() {
        let at = parameter + k;
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
    text
}

/// The place of a pipeline: the first thread that asks compiles it, and others wait for it alone. Maps of such places are
/// locked for the look-up only, since a driver can take seconds.
pub(in crate::kernels::gpu::device) type Pipeline = Arc<OnceLock<wgpu::ComputePipeline>>;

/// Pipelines of generated kernels, by the number of the program and the form of the kernel.
pub(in crate::kernels::gpu::device) type Pipelines =
    HashMap<(u64, KernelForm), (Weak<u64>, Pipeline)>;
