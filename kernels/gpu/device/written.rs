//! The shaders: their source files, and the constants in front of them.
//!
//! A shader is its constants followed by its files. Constants are defined in Rust alone.
use crate::ad::program::wgsl::literal;
use crate::clip::{FAR, LARGEST_INVERSE};
use crate::overlap::Denominator;
use crate::ring::Measure;
use crate::{Real, Scalar};
use std::fmt::Write;

/// The number of threads of a workgroup.
pub(super) const GROUP: usize = 256;
/// The number of threads of an adjoint's workgroup. Each takes two columns, so a larger workgroup would leave too few
/// registers for a second one.
pub(super) const GROUP_VJP: usize = GROUP / 2;
/// The number of walked shapes in workgroup memory at a time.
pub(super) const STEP: usize = 64;
/// The number of walked columns of a matrix in workgroup memory at a time: whole sectors of memory, of every thread's
/// row.
const STEP_MATRIX: usize = 8;
/// Returns the number of walked shapes in workgroup memory for adjoints, which also store sums there, 20 bytes per
/// walked shape and slot: at most 10 KiB of the 16 KiB that WebGPU guarantees.
pub(super) const fn step_vjp(slots: usize) -> usize {
    if slots > 32 { 8 } else { 16 }
}
/// The number of walked shapes per thread in reductions: few enough that a hundred thousand rows fill a large GPU, many
/// enough that the partial results stay small.
pub(super) const STRIP: usize = 1024;
/// The number of counts per thread in their prefix sum.
const RUN: usize = 16;
/// The number of walked shapes per thread of adjoints, which also read an upstream matrix.
pub(super) const STRIP_VJP: usize = 256;
/// The number of vertices from which on a ring is long: several threads compute it.
pub(super) const LONG: usize = 1024;
/// The number of vertices of a long ring per workgroup.
pub(super) const SPAN: usize = 2048;
/// The number of spans along the first dimension of a dispatch.
pub(super) const ROW: usize = 32_768;
/// Returns whether a measure of rings needs sums of moments, and of lengths. Returns also its WGSL: the measure of a
/// ring, and the derivative at a vertex.
const fn mirror_of(measure: Measure) -> (bool, bool, &'static str) {
    match measure {
        Measure::SignedArea => (false, false, include_str!("../wgsl/signed_area.wgsl")),
        Measure::Area => (false, false, include_str!("../wgsl/area.wgsl")),
        Measure::Perimeter => (false, true, include_str!("../wgsl/perimeter.wgsl")),
        Measure::Centroid => (true, false, include_str!("../wgsl/centroid.wgsl")),
    }
}

/// The task of a shader that has no body of two shapes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Kernel {
    /// The sum of partial sums.
    Fold,
    /// A reduction of a stored matrix, by threads for rows or for columns.
    ReduceMatrix(Take, bool),
    Gather,
    /// A measure of rings.
    Ragged(Measure),
}

/// The factors of derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum SeedSource {
    Matrix,
    /// One factor for all pairs.
    Factor,
}

impl SeedSource {
    /// Returns the WGSL of the factor of a pair.
    pub(super) fn text(self) -> &'static str {
        match self {
            SeedSource::Matrix => include_str!("../wgsl/seed_matrix.wgsl"),
            SeedSource::Factor => include_str!("../wgsl/seed_factor.wgsl"),
        }
    }
}

/// The kind of result that a reduction computes from scores.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Take {
    Best,
    Count,
    Found,
    Sum,
}

impl Take {
    /// All kinds.
    pub(super) const ALL: [Take; 4] = [Take::Best, Take::Count, Take::Found, Take::Sum];
    /// The kinds that reductions within groups have.
    pub(super) const OF_GROUPS: [Take; 3] = [Take::Best, Take::Count, Take::Found];
    /// Returns the WGSL that reduces scores.
    pub(super) fn text(self) -> &'static str {
        match self {
            Take::Best => include_str!("../wgsl/take_best.wgsl"),
            Take::Count => include_str!("../wgsl/take_count.wgsl"),
            Take::Found => include_str!("../wgsl/take_found.wgsl"),
            Take::Sum => include_str!("../wgsl/take_sum.wgsl"),
        }
    }
}

/// The walk of a reduction, for every source and every kind of result.
pub(super) const REDUCE: &str = include_str!("../wgsl/reduce.wgsl");

/// Returns the sizes of a kernel.
pub(super) fn sizes(group: usize, step: usize, strip: usize) -> String {
    format!(
        "const GROUP: u32 = {group}u;\nconst STEP: u32 = {step}u;\nconst STRIP: u32 = {strip}u;\n\
         const LEAST: f32 = {};\n",
        literal(-f32::MAX)
    )
}

/// Returns the constants of kernels by hand, which Rust and WGSL share.
pub(super) fn policy() -> String {
    // All ones, except the low half of the significand.
    let high_half = Real::high(f32::from_bits(u32::MAX)).to_bits();
    let mut text = String::new();
    for (name, value) in [
        ("HIGH_HALF", high_half),
        ("UNION", Denominator::Union as u32),
        ("FIRST", Denominator::First as u32),
    ] {
        let _ = writeln!(text, "const {name}: u32 = {value}u;");
    }
    for (name, value) in [
        ("LARGEST", f32::MAX),
        ("EMPTY", <f32 as Scalar>::format().empty() as f32),
        ("SMALLEST_NORMAL", f32::MIN_POSITIVE),
        ("FAR", FAR as f32),
        ("LARGEST_INVERSE", LARGEST_INVERSE as f32),
        ("PARALLEL", <f32 as Scalar>::format().parallel() as f32),
    ] {
        let _ = writeln!(text, "const {name}: f32 = {};", literal(value));
    }
    text
}

/// The scalar of kernels by hand.
pub(super) const PRELUDE: &str = include_str!("../wgsl/prelude.wgsl");
/// The WGSL that clips the border of one box to another.
pub(super) const CLIP: &str = include_str!("../wgsl/clip.wgsl");
/// The WGSL of the overlap of two boxes.
pub(super) const OVERLAP: &str = include_str!("../wgsl/overlap.wgsl");
/// The parameters of kernels over two lists.
pub(super) const PARAMS: &str = include_str!("../wgsl/params.wgsl");
/// The buffers that kernels over two lists read and write.
pub(super) const BINDINGS: &str = include_str!("../wgsl/bindings.wgsl");

impl Kernel {
    /// Returns the shader.
    pub(super) fn text(self) -> String {
        let (step, files): (usize, &[&str]) = match self {
            Kernel::Ragged(measure) => return ring_source(measure),
            Kernel::ReduceMatrix(take, _) => (
                STEP_MATRIX,
                &[
                    REDUCE,
                    include_str!("../wgsl/reduce_matrix.wgsl"),
                    take.text(),
                ],
            ),
            Kernel::Fold => (STEP, &[include_str!("../wgsl/fold.wgsl")]),
            Kernel::Gather => (STEP, &[include_str!("../wgsl/gather.wgsl")]),
        };
        let mut text = sizes(GROUP, step, STRIP);
        let own_rows = matches!(self, Kernel::ReduceMatrix(_, true));
        let _ = writeln!(
            text,
            "const RUN: u32 = {RUN}u;\nconst OWN_ROWS: bool = {own_rows};"
        );
        text.extend([PARAMS, BINDINGS]);
        text.extend(files.iter().copied());
        text
    }
}

/// Returns every shader that has no body of two shapes, with its name: for tests without a GPU.
#[doc(hidden)]
#[must_use]
pub fn common_sources() -> Vec<(String, String)> {
    let matrices =
        [false, true].map(|own_rows| Take::ALL.map(|take| Kernel::ReduceMatrix(take, own_rows)));
    let all = [Kernel::Fold, Kernel::Gather];
    let all = all.into_iter().chain(matrices.into_iter().flatten());
    all.map(|kernel| (format!("{kernel:?}"), kernel.text()))
        .collect()
}

/// Returns the shader of a measure of rings.
pub(super) fn ring_source(measure: Measure) -> String {
    let (moments, lengths, body) = mirror_of(measure);
    let mut text = policy() + &sizes(GROUP, STEP, STRIP);
    let _ = writeln!(
        text,
        "const LONG: u32 = {LONG}u;\nconst SPAN: u32 = {SPAN}u;\nconst ROW: u32 = {ROW}u;\n\
         const MOMENTS: bool = {};\nconst LENGTHS: bool = {};\nconst FIELDS: u32 = {}u;",
        moments,
        lengths,
        measure.fields(),
    );
    for file in [
        PRELUDE,
        include_str!("../wgsl/ring.wgsl"),
        body,
        include_str!("../wgsl/ragged.wgsl"),
        include_str!("../wgsl/ragged_long.wgsl"),
    ] {
        text.push_str(file);
    }
    text
}
