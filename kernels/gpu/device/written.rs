//! The shaders: which files make one, and the constants put in front of them.
//!
//! A shader is its constants and its files, one after the other. Constants are written down in Rust
//! alone.
use crate::clip::{FAR, LARGEST_INVERSE, frame, is_ordinary};
use crate::kernels::cpu::plan::Compiled;
use crate::kernels::op::Op;
use crate::overlap::Denominator;
use crate::ring::Measure;
use crate::scalar::float::Float;
use crate::{Aabb2, Fixed, Obb2, Scalar};
use std::fmt::Write;

/// Items per tile of a buffer: a run of 64 numbers is 256 bytes, where WebGPU lets a binding begin.
pub(super) const TILE: usize = 64;
/// Threads per workgroup.
pub(super) const GROUP: usize = 256;
/// The same for adjoints, whose threads take two columns each: with what one needs in registers, a
/// larger workgroup would leave room for no second one.
pub(super) const GROUP_VJP: usize = GROUP / 2;
/// Walked shapes kept close to the threads at a time.
pub(super) const STEP: usize = 64;
/// Walked columns of a matrix kept close to the threads at a time: whole sectors of memory, of every
/// thread's row.
const STEP_MATRIX: usize = 8;
/// The same for adjoints, which keep sums beside them, one of 20 bytes per walked shape and slot:
/// at most 10 KiB, of the 16 KiB that WebGPU guarantees.
const fn step_vjp(slots: usize) -> usize {
    if slots > 32 { 8 } else { 16 }
}
/// Walked shapes per thread in reductions: few enough that a hundred thousand rows fill a large
/// GPU, many enough that the partial results stay small.
pub(super) const STRIP: usize = 1024;
/// Counts per thread when they are turned into places.
const RUN: usize = 16;
/// The same for adjoints, whose upstream matrix makes every step dearer.
pub(super) const STRIP_VJP: usize = 256;
/// Vertices from which on a ring is long: more than one thread works on it.
pub(super) const LONG: usize = 1024;
/// Vertices of a long ring per workgroup.
pub(super) const SPAN: usize = 2048;
/// Spans along the first dimension of a dispatch.
pub(super) const ROW: usize = 32_768;
/// The most quads a frame has.
pub(super) const MOST_QUADS: usize = 2;

/// Boxes that kernels by hand take.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Kind {
    /// [`Obb2`].
    Rotated,
    /// [`Aabb2`].
    AxisAligned,
}

impl Kind {
    /// How many groups of four numbers a prepared shape has.
    pub fn quads(self) -> usize {
        match self {
            Kind::Rotated => 2,
            Kind::AxisAligned => 1,
        }
    }
    /// How many numbers a shape has.
    pub fn fields(self) -> usize {
        match self {
            Kind::Rotated => Obb2::<f32>::LEN,
            Kind::AxisAligned => Aabb2::<f32>::LEN,
        }
    }
    /// The shape in WGSL.
    fn text(self) -> &'static str {
        match self {
            Kind::Rotated => include_str!("../wgsl/obb2.wgsl"),
            Kind::AxisAligned => include_str!("../wgsl/aabb.wgsl"),
        }
    }
    /// A shape, prepared; and whether plain products of its numbers stay far from over- and underflow.
    ///
    /// The processor does that, once per upload: its sines and cosines come from `f64`, so a GPU
    /// starts from the very numbers that a batch on the processor starts from, for huge headings
    /// and for long thin boxes too, and no driver's trigonometry matters.
    pub fn prepared(self, numbers: &[f32]) -> ([[f32; 4]; MOST_QUADS], bool) {
        match self {
            Kind::Rotated => {
                let shape = Obb2::load(numbers);
                // Sine and cosine are the sums of their parts.
                let f = frame(shape);
                let quads = [
                    [f.center.x, f.center.y, f.half.x, f.half.y],
                    [f.cos_high, f.cos_low, f.sin_high, f.sin_low],
                ];
                (quads, is_ordinary(shape))
            }
            Kind::AxisAligned => {
                let own = Aabb2::load(numbers);
                let quad = [own.min.x, own.min.y, own.max.x, own.max.y];
                ([quad, [0.0; 4]], true)
            }
        }
    }
}

/// A score of all pairs of two lists of boxes that has kernels by hand: mirrors of its Rust source in WGSL.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Mirror {
    pub kind: Kind,
    /// The divisor of the area of intersection.
    pub over: Denominator,
}

impl Mirror {
    /// The mirror of an operation, if it has one.
    pub fn of(compiled: Compiled) -> Option<Self> {
        match compiled {
            Compiled::Obb2(over) => Some(Mirror {
                kind: Kind::Rotated,
                over,
            }),
            Compiled::Aabb2(over) => Some(Mirror {
                kind: Kind::AxisAligned,
                over,
            }),
            _ => None,
        }
    }
}

/// For kernels in which the score does not matter.
pub(super) const ANY: Mirror = Mirror {
    kind: Kind::AxisAligned,
    over: Denominator::Union,
};

/// The sums of a measure of rings beside products of vertices (moments, lengths), and in WGSL the measure of a ring with
/// its derivative at a vertex.
const fn mirror_of(measure: Measure) -> (bool, bool, &'static str) {
    match measure {
        Measure::SignedArea => (false, false, include_str!("../wgsl/signed_area.wgsl")),
        Measure::Perimeter => (false, true, include_str!("../wgsl/perimeter.wgsl")),
        Measure::Centroid => (true, false, include_str!("../wgsl/centroid.wgsl")),
    }
}

/// The task of a shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Kernel {
    Pairs,
    Vjp(Seed),
    Fold,
    /// A reduction of two lists.
    Reduce(Take),
    /// A reduction of a matrix that is there already.
    ReduceMatrix(Take),
    Gather,
    /// A measure of rings.
    Ragged(Measure),
}

/// The factors of derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Seed {
    Matrix,
    /// One factor for all; the scores are added up as well.
    Factor,
}

/// The result that a reduction takes from scores.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Take {
    Best,
    Count,
    Found,
    Sum,
}

impl Take {
    /// All of them.
    pub(super) const ALL: [Take; 4] = [Take::Best, Take::Count, Take::Found, Take::Sum];
    /// The WGSL that reduces scores.
    pub(super) fn text(self) -> &'static str {
        match self {
            Take::Best => include_str!("../wgsl/take_best.wgsl"),
            Take::Count => include_str!("../wgsl/take_count.wgsl"),
            Take::Found => include_str!("../wgsl/take_found.wgsl"),
            Take::Sum => include_str!("../wgsl/take_sum.wgsl"),
        }
    }
}

/// The walk of a reduction, whatever gives the scores and whatever is taken of them.
pub(super) const REDUCE: &str = include_str!("../wgsl/reduce.wgsl");
const PAIRS: &str = include_str!("../wgsl/pairs.wgsl");

/// Everything a shader depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Source {
    pub kernel: Kernel,
    pub mirror: Mirror,
    /// `true` if shapes may be such that plain products of their numbers over- or underflow.
    pub extreme: bool,
    /// `true` if threads stand for rows, and not for columns.
    pub own_rows: bool,
    /// Slots for sums of rows: the most subgroups an adjoint's workgroup can have; zero without
    /// subgroups.
    pub slots: usize,
}

impl Source {
    pub fn of(kernel: Kernel, mirror: Mirror) -> Self {
        Source {
            kernel,
            mirror,
            extreme: false,
            own_rows: false,
            slots: 0,
        }
    }
}

/// A number as WGSL reads it back to the same bits.
fn literal(x: f32) -> String {
    format!("{x:e}f")
}

/// The constants of every shader.
pub(super) fn constants(group: usize, step: usize, strip: usize) -> String {
    // All ones, without the low half of the significand.
    let high_half = Float::high(f32::from_bits(u32::MAX)).to_bits();
    let mut text = String::new();
    for (name, value) in [
        ("TILE", TILE as u32),
        ("GROUP", group as u32),
        ("STEP", step as u32),
        ("STRIP", strip as u32),
        ("RUN", RUN as u32),
        ("LONG", LONG as u32),
        ("SPAN", SPAN as u32),
        ("ROW", ROW as u32),
        ("HIGH_HALF", high_half),
        ("UNION", Denominator::Union as u32),
        ("FIRST", Denominator::First as u32),
    ] {
        let _ = writeln!(text, "const {name}: u32 = {value}u;");
    }
    for (name, value) in [
        ("LARGEST", f32::MAX),
        ("EMPTY", <f32 as Scalar>::EMPTY as f32),
        ("SMALLEST_NORMAL", f32::MIN_POSITIVE),
        ("FAR", FAR as f32),
        ("LARGEST_INVERSE", LARGEST_INVERSE as f32),
        ("PARALLEL", <f32 as Scalar>::PARALLEL as f32),
    ] {
        let _ = writeln!(text, "const {name}: f32 = {};", literal(value));
    }
    text
}

const PRELUDE: &str = include_str!("../wgsl/prelude.wgsl");
/// The parameters of kernels over two lists.
pub(super) const PARAMS: &str = include_str!("../wgsl/params.wgsl");
const BATCH: &str = include_str!("../wgsl/batch.wgsl");

/// The shader of all pairs.
pub(super) fn pair_source(source: Source) -> String {
    let Mirror { kind, over } = source.mirror;
    let (group, step, strip) = match source.kernel {
        Kernel::Vjp(_) => (GROUP_VJP, step_vjp(source.slots), STRIP_VJP),
        Kernel::ReduceMatrix(_) => (GROUP, STEP_MATRIX, STRIP),
        _ => (GROUP, STEP, STRIP),
    };
    let mut text = constants(group, step, strip);
    let _ = writeln!(
        text,
        "const QUADS: u32 = {}u;\nconst FIELDS: u32 = {}u;\nconst SLOTS: u32 = {}u;\n\
         const DENOMINATOR: u32 = {}u;\nconst IS_RATIO: bool = {};\nconst EXTREME: bool = {};\n\
         const OWN_ROWS: bool = {};",
        kind.quads(),
        kind.fields(),
        source.slots.max(1),
        over as u32,
        over != Denominator::None,
        source.extreme,
        source.own_rows,
    );
    let clip = include_str!("../wgsl/clip.wgsl");
    let overlap = include_str!("../wgsl/overlap.wgsl");
    for file in [PRELUDE, clip, overlap, kind.text(), PARAMS, BATCH] {
        text.push_str(file);
    }
    let files: &[&str] = match source.kernel {
        Kernel::Pairs => &[PAIRS, include_str!("../wgsl/put_value.wgsl")],
        Kernel::Vjp(seed) => &[
            include_str!("../wgsl/vjp.wgsl"),
            match seed {
                Seed::Matrix => include_str!("../wgsl/seed_matrix.wgsl"),
                Seed::Factor => include_str!("../wgsl/seed_factor.wgsl"),
            },
            match source.slots {
                0 => include_str!("../wgsl/sum_workgroup.wgsl"),
                _ => include_str!("../wgsl/sum_subgroup.wgsl"),
            },
        ],
        Kernel::Reduce(take) => &[
            REDUCE,
            include_str!("../wgsl/reduce_shapes.wgsl"),
            take.text(),
        ],
        Kernel::ReduceMatrix(take) => &[
            REDUCE,
            include_str!("../wgsl/reduce_matrix.wgsl"),
            take.text(),
        ],
        Kernel::Fold => &[include_str!("../wgsl/fold.wgsl")],
        Kernel::Gather | Kernel::Ragged(_) => &[include_str!("../wgsl/gather.wgsl")],
    };
    text.extend(files.iter().copied());
    text
}

/// The shader of a measure of rings.
pub(super) fn ring_source(measure: Measure) -> String {
    let (moments, lengths, body) = mirror_of(measure);
    let mut text = constants(GROUP, STEP, STRIP);
    let _ = writeln!(
        text,
        "const MOMENTS: bool = {};\nconst LENGTHS: bool = {};\nconst FIELDS: u32 = {}u;",
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

/// Every shader by hand that all pairs of an operation can need, with a name: for tests that have no GPU.
#[doc(hidden)]
#[must_use]
pub fn pair_sources<O: Op>() -> Vec<(String, String)> {
    compiled_sources(O::compiled())
}

/// The same by its compiled kernels.
pub(super) fn compiled_sources(compiled: Option<Compiled>) -> Vec<(String, String)> {
    let mut all = Vec::new();
    let Some(mirror) = compiled.and_then(Mirror::of) else {
        return all;
    };
    let mut kernels = vec![
        Kernel::Pairs,
        Kernel::Vjp(Seed::Matrix),
        Kernel::Vjp(Seed::Factor),
        Kernel::Fold,
        Kernel::Gather,
    ];
    kernels.extend(Take::ALL.map(Kernel::Reduce));
    kernels.extend(Take::ALL.map(Kernel::ReduceMatrix));
    for kernel in kernels {
        for (extreme, own_rows, slots) in [(false, false, 0), (true, true, 8)] {
            let source = Source {
                extreme,
                own_rows,
                slots,
                ..Source::of(kernel, mirror)
            };
            all.push((format!("{source:?}"), pair_source(source)));
        }
    }
    all
}
