//! Templates of all pairs around a body, generated or by hand: sizes, and the functions that name the body's numbers.
use super::operation::{Generated, ShaderBody};
use super::text::{GROUP, KernelForm, ROWS, SummedLists, call};
use crate::kernels::gpu::device::written::{
    self, BINDINGS, GROUP_VJP, PARAMS, REDUCE, STEP, STRIP_VJP, SeedSource, sizes, step_vjp,
};
use std::fmt::Write;

/// The number of derivatives in a sum of their own, so that the rounding error grows slowly.
const STEP_SLOPES: usize = 16;

/// The numbers of threads and of walked shapes of a kernel.
#[derive(Clone, Copy, Debug)]
pub(in crate::kernels::gpu::device) struct Size {
    /// The number of threads of a workgroup.
    group: usize,
    /// The number of own shapes of a workgroup.
    pub own: usize,
    /// The number of walked shapes in workgroup memory at a time.
    step: usize,
    /// The number of walked shapes of a thread.
    pub strip: usize,
}

impl Generated<f32> {
    /// Returns the size of a kernel of all pairs.
    pub(in crate::kernels::gpu::device) fn size(&self, form: KernelForm) -> Size {
        // Large programs need many registers, so their workgroups have few threads.
        let (group, step) = match self.kind {
            Some(_) => (written::GROUP, STEP),
            None => (GROUP, ROWS),
        };
        let size = Size {
            group,
            own: group,
            step,
            strip: step,
        };
        match form {
            KernelForm::Reduce(..) | KernelForm::ReduceGroups(..) => Size {
                strip: written::STRIP,
                ..size
            },
            KernelForm::Derivatives(SummedLists::Both(slots), _) => Size {
                group: GROUP_VJP,
                own: 2 * GROUP_VJP,
                step: step_vjp(slots),
                strip: STRIP_VJP,
            },
            KernelForm::Derivatives(..) => Size {
                step: STEP_SLOPES,
                strip: STRIP_VJP,
                ..size
            },
            _ => size,
        }
    }
    /// Returns the lists whose derivatives each kernel of an adjoint sums: a body by hand computes both at once.
    pub(super) fn passes(&self, slots: usize) -> Vec<SummedLists> {
        match self.kind {
            Some(_) => vec![SummedLists::Both(slots)],
            None => vec![SummedLists::Rows, SummedLists::Columns],
        }
    }
}

/// Returns the kernel of a form of all pairs.
pub(super) fn text(made: &Generated<f32>, body: &ShaderBody, form: KernelForm) -> String {
    let size = made.size(form);
    let (own, has_seed, slots) = match form {
        KernelForm::Reduce(_, own_rows) | KernelForm::ReduceGroups(_, own_rows) => {
            (usize::from(!own_rows), false, 0)
        }
        KernelForm::Derivatives(SummedLists::Rows, _) => (0, true, 0),
        KernelForm::Derivatives(SummedLists::Columns, _) => (1, true, 0),
        KernelForm::Derivatives(SummedLists::Both(slots), _) => (1, true, slots),
        _ => (1, false, 0),
    };
    let mut text = sizes(size.group, size.step, size.strip);
    let _ = writeln!(
        text,
        "const OWN_ROWS: bool = {};\nconst SLOTS: u32 = {}u;",
        own == 0,
        slots.max(1),
    );
    text += PARAMS;
    text += BINDINGS;
    text += include_str!("../../wgsl/walked.wgsl");
    text += &shapes(made, body, own, has_seed);
    match form {
        KernelForm::Reduce(take, _) | KernelForm::ReduceGroups(take, _) => {
            text += match form {
                KernelForm::Reduce(..) => REDUCE,
                _ => include_str!("../../wgsl/reduce_groups.wgsl"),
            };
            text += include_str!("../../wgsl/reduce_shapes.wgsl");
            text += take.text();
        }
        KernelForm::Derivatives(of, seed) => {
            text += &bars(made, body, of);
            text += seed.text();
            match of {
                SummedLists::Both(slots) => {
                    text += match seed {
                        SeedSource::Matrix => include_str!("../../wgsl/total_unused.wgsl"),
                        SeedSource::Factor => include_str!("../../wgsl/total_kept.wgsl"),
                    };
                    text += include_str!("../../wgsl/vjp.wgsl");
                    text += match slots {
                        0 => include_str!("../../wgsl/sum_workgroup.wgsl"),
                        _ => include_str!("../../wgsl/sum_subgroup.wgsl"),
                    };
                }
                _ => text += include_str!("../../wgsl/slopes.wgsl"),
            }
        }
        _ => {
            text += include_str!("../../wgsl/pairs.wgsl");
            text += &put_pair(body);
        }
    }
    text
}

/// Returns the WGSL functions that name the numbers of shapes and call the body.
fn shapes(made: &Generated<f32>, body: &ShaderBody, own: usize, has_seed: bool) -> String {
    let mut text = String::new();
    for (k, shape, function) in [(own, "Own", "own_at"), (1 - own, "Walked", "walked_at")] {
        let (list, width) = (["a_quads", "b_quads"][k], made.widths[k]);
        // WGSL has no empty arrays, and an unused binding would vanish from the layout.
        let quads = width.div_ceil(4).max(1);
        let read = (0..quads).map(|q| format!("    let q{q} = {list}[item * {quads}u + {q}u];\n"));
        let number = |i: usize| format!("q{}.{}", i / 4, ["x", "y", "z", "w"][i % 4]);
        let count = width.max(1);
        let _ = write!(
            text,
            "
alias {shape} = array<f32, {count}>;

fn {function}(item: u32) -> {shape} {{
{}    return {shape}({});
}}
",
            read.collect::<String>(),
            (0..count).map(number).collect::<Vec<_>>().join(", ")
        );
    }
    let mut inputs = Vec::new();
    for k in [0, 1] {
        let shape = if k == own { "own" } else { "walked" };
        inputs.extend((0..made.widths[k]).map(|i| format!("{shape}[{i}]")));
    }
    let mut seed = "";
    if has_seed {
        inputs.push("seed".to_owned());
        seed = ", seed: f32";
    }
    let _ = write!(
        text,
        "
fn body_at(own: Own, walked: Walked{seed}) -> array<f32, {}> {{
    return {};
}}
",
        body.gives,
        call(body.entry, inputs),
    );
    text
}

/// Returns the WGSL function that stores the results of a pair.
fn put_pair(body: &ShaderBody) -> String {
    let gives = body.gives;
    let lines = (0..gives).map(|k| format!("    values[at + {k}u * params.plane] = y[{k}];\n"));
    format!(
        "\nfn put_pair(y: array<f32, {gives}>, at: u32) {{\n{}}}\n",
        lines.collect::<String>()
    )
}

/// Returns the WGSL functions that add and store derivatives.
fn bars(made: &Generated<f32>, body: &ShaderBody, of: SummedLists) -> String {
    let mut text = String::new();
    let gives = body.gives;
    // For own and walked shapes: the number of derivatives, and the index of the first one in the body's result.
    let (own, own_at, walked) = match of {
        SummedLists::Rows | SummedLists::Columns => (gives, 0, None),
        SummedLists::Both(_) => (made.gives[1], 1 + made.gives[0], Some((made.gives[0], 1))),
    };
    let lines =
        |count: usize, line: &dyn Fn(usize) -> String| (0..count).map(line).collect::<String>();
    let mut adders = |name: &str, bar: &str, fields: usize, at: usize| {
        let from_y = lines(fields, &|k| format!("    (*sum)[{k}] += y[{}];\n", at + k));
        let from_bar = lines(fields, &|k| format!("    (*sum)[{k}] += bar[{k}];\n"));
        let _ = write!(
            text,
            "
alias {bar} = array<f32, {fields}>;

fn add_{name}(sum: ptr<function, {bar}>, y: array<f32, {gives}>) {{
{from_y}}}

fn add_{name}_bar(sum: ptr<function, {bar}>, bar: {bar}) {{
{from_bar}}}
"
        );
    };
    adders("own", "OwnBar", own, own_at);
    if let Some((fields, at)) = walked {
        adders("walked", "WalkedBar", fields, at);
    }
    let put = lines(own, &|k| {
        format!("    own_bars[(strip * {own}u + {k}u) * params.own_count + item] = bar[{k}];\n")
    });
    let _ = write!(
        text,
        "
fn put_own(bar: OwnBar, item: u32, strip: u32) {{
{put}}}
"
    );
    if let (SummedLists::Both(slots), Some((fields, _))) = (of, walked) {
        let zero: Vec<String> = (0..fields).map(|k| format!("bar[{k}] == 0.0")).collect();
        let _ = write!(
            text,
            "
const WALKED_BAR: u32 = {fields}u;

fn is_zero(bar: WalkedBar) -> bool {{
    return {};
}}
",
            zero.join(" && ")
        );
        if slots > 0 {
            let sums: Vec<String> = (0..fields)
                .map(|k| format!("subgroupAdd(bar[{k}])"))
                .collect();
            let _ = write!(
                text,
                "
fn subgroup_sums(bar: WalkedBar) -> WalkedBar {{
    return WalkedBar({});
}}
",
                sums.join(", ")
            );
        }
    }
    text
}
