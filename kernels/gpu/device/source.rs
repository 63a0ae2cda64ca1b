//! The shaders: which files make one, and the constants put in front of them.
//!
//! A shader is its constants and its files, one after the other. Constants are written down in Rust
//! alone.
use crate::clip::{FAR, LARGEST_INVERSE, frame, is_ordinary};
use crate::error::Validate;
use crate::kernels::op::{Op, RingOp};
use crate::kernels::ring::{Centroid, Perimeter, SignedArea};
use crate::kernels::row::Row;
use crate::overlap::Denominator;
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
/// at most 10 KiB, of the 16 KiB that WebGPU promises.
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

/// A shape that batches on a GPU take.
pub trait GpuShape: Row<Scalar = f32, Many = Vec<Self>> + Validate + std::fmt::Debug {
    /// How many groups of four numbers a prepared shape has.
    const QUADS: usize;
    /// The shape in WGSL.
    const WGSL: &'static str;
    /// Prepares the shape.
    ///
    /// The processor does that, once per upload: its sines and cosines come from `f64`, so a GPU
    /// starts from the very numbers that a batch on the processor starts from, for huge headings
    /// and for long thin boxes too, and no driver's trigonometry matters.
    fn quads(self) -> [[f32; 4]; 2];
    /// Whether plain products of its numbers stay far from over- and underflow.
    fn is_ordinary(self) -> bool;
}

impl GpuShape for Obb2<f32> {
    const QUADS: usize = 2;
    const WGSL: &'static str = include_str!("../wgsl/obb2.wgsl");
    #[inline]
    fn quads(self) -> [[f32; 4]; 2] {
        // Sine and cosine are the sums of their parts.
        let f = frame(self);
        [
            [f.center.x, f.center.y, f.half.x, f.half.y],
            [f.cos_high, f.cos_low, f.sin_high, f.sin_low],
        ]
    }
    #[inline]
    fn is_ordinary(self) -> bool {
        is_ordinary(self)
    }
}

impl GpuShape for Aabb2<f32> {
    const QUADS: usize = 1;
    const WGSL: &'static str = include_str!("../wgsl/aabb.wgsl");
    #[inline]
    fn quads(self) -> [[f32; 4]; 2] {
        [[self.min.x, self.min.y, self.max.x, self.max.y], [0.0; 4]]
    }
    #[inline]
    fn is_ordinary(self) -> bool {
        true
    }
}

/// An operation of two shapes that has a mirror in WGSL.
pub trait GpuPair:
    Op<In<f32> = (<Self as GpuPair>::Shape, <Self as GpuPair>::Shape), Out<f32> = f32>
{
    /// Both shapes.
    type Shape: GpuShape;
    /// What the score is divided by.
    const DENOMINATOR: Denominator;
}

/// Lists the operations that have a mirror.
macro_rules! mirrored {
    ($($op:ident: $shape:ident over $over:ident;)*) => { $(
        impl GpuPair for crate::kernels::$op {
            type Shape = $shape<f32>;
            const DENOMINATOR: Denominator = Denominator::$over;
        }
    )* };
}
mirrored! {
    IntersectionAreaObb2: Obb2 over None;
    IouObb2: Obb2 over Union;
    IofObb2: Obb2 over First;
    IntersectionAreaAabb2: Aabb2 over None;
    IouAabb2: Aabb2 over Union;
    IofAabb2: Aabb2 over First;
}

/// An operation of a ring that has a mirror in WGSL.
pub trait GpuRing: RingOp {
    /// Whether it sums moments of edges.
    const MOMENTS: bool;
    /// Whether it sums lengths of edges.
    const LENGTHS: bool;
    /// The measure of a ring and its slope at a vertex, in WGSL.
    const WGSL: &'static str;
}

impl GpuRing for SignedArea {
    const MOMENTS: bool = false;
    const LENGTHS: bool = false;
    const WGSL: &'static str = include_str!("../wgsl/signed_area.wgsl");
}
impl GpuRing for Perimeter {
    const MOMENTS: bool = false;
    const LENGTHS: bool = true;
    const WGSL: &'static str = include_str!("../wgsl/perimeter.wgsl");
}
impl GpuRing for Centroid {
    const MOMENTS: bool = true;
    const LENGTHS: bool = false;
    const WGSL: &'static str = include_str!("../wgsl/centroid.wgsl");
}

/// What a shader does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Kernel {
    Aligned,
    Pairs,
    PairsGrad,
    Vjp(Seed),
    Fold,
    /// Of two lists.
    Reduce(Take),
    /// Of a matrix that is there already.
    ReduceMatrix(Take),
    Gather,
    Ragged,
}

/// What slopes are multiplied by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Seed {
    Matrix,
    /// One factor for all; the scores are added up as well.
    Factor,
}

/// What a reduction takes of scores.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Take {
    Best,
    Count,
    Found,
    Sum,
}

impl Take {
    fn text(self) -> &'static str {
        match self {
            Take::Best => include_str!("../wgsl/take_best.wgsl"),
            Take::Count => include_str!("../wgsl/take_count.wgsl"),
            Take::Found => include_str!("../wgsl/take_found.wgsl"),
            Take::Sum => include_str!("../wgsl/take_sum.wgsl"),
        }
    }
}

const REDUCE: &str = include_str!("../wgsl/reduce.wgsl");
const PAIRS: &str = include_str!("../wgsl/pairs.wgsl");

/// Everything a shader depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Source {
    pub kernel: Kernel,
    /// The operation's name.
    pub name: &'static str,
    pub extreme: bool,
    /// Whether threads stand for rows, and not for columns.
    pub own_rows: bool,
    /// Slots for sums of rows: the most subgroups an adjoint's workgroup can have; zero without
    /// subgroups.
    pub slots: usize,
}

impl Source {
    pub fn of(kernel: Kernel, name: &'static str) -> Self {
        Source {
            kernel,
            name,
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
fn constants(group: usize, step: usize, strip: usize) -> String {
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
const BATCH: &str = include_str!("../wgsl/batch.wgsl");

/// The shader of an operation of two shapes.
pub(super) fn pair_source<O: GpuPair>(source: Source) -> String {
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
        O::Shape::QUADS,
        O::Shape::LEN,
        source.slots.max(1),
        O::DENOMINATOR as u32,
        O::DENOMINATOR != Denominator::None,
        source.extreme,
        source.own_rows,
    );
    let clip = include_str!("../wgsl/clip.wgsl");
    let overlap = include_str!("../wgsl/overlap.wgsl");
    for file in [PRELUDE, clip, overlap, O::Shape::WGSL, BATCH] {
        text.push_str(file);
    }
    let files: &[&str] = match source.kernel {
        Kernel::Aligned => &[include_str!("../wgsl/aligned.wgsl")],
        Kernel::Pairs => &[PAIRS, include_str!("../wgsl/put_value.wgsl")],
        Kernel::PairsGrad => &[PAIRS, include_str!("../wgsl/put_grad.wgsl")],
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
        Kernel::Gather | Kernel::Ragged => &[include_str!("../wgsl/gather.wgsl")],
    };
    text.extend(files.iter().copied());
    text
}

/// The shader of an operation of rings.
pub(super) fn ring_source<O: GpuRing>() -> String {
    let mut text = constants(GROUP, STEP, STRIP);
    let _ = writeln!(
        text,
        "const MOMENTS: bool = {};\nconst LENGTHS: bool = {};\nconst FIELDS: u32 = {}u;",
        O::MOMENTS,
        O::LENGTHS,
        <O as RingOp>::Out::<f32>::LEN,
    );
    for file in [
        PRELUDE,
        include_str!("../wgsl/ring.wgsl"),
        O::WGSL,
        include_str!("../wgsl/ragged.wgsl"),
        include_str!("../wgsl/ragged_long.wgsl"),
    ] {
        text.push_str(file);
    }
    text
}

/// Every shader an operation of two shapes can need, with a name: for tests that have no GPU.
#[doc(hidden)]
#[must_use]
pub fn pair_sources<O: GpuPair>() -> Vec<(String, String)> {
    let mut all = Vec::new();
    let takes = [Take::Best, Take::Count, Take::Found, Take::Sum];
    let mut kernels = vec![
        Kernel::Aligned,
        Kernel::Pairs,
        Kernel::PairsGrad,
        Kernel::Vjp(Seed::Matrix),
        Kernel::Vjp(Seed::Factor),
        Kernel::Fold,
        Kernel::Gather,
    ];
    kernels.extend(takes.map(Kernel::Reduce));
    kernels.extend(takes.map(Kernel::ReduceMatrix));
    for kernel in kernels {
        for (extreme, own_rows, slots) in [(false, false, 0), (true, true, 8)] {
            let source = Source {
                extreme,
                own_rows,
                slots,
                ..Source::of(kernel, O::NAME)
            };
            all.push((format!("{source:?}"), pair_source::<O>(source)));
        }
    }
    all
}

/// Every shader an operation of rings can need.
#[doc(hidden)]
#[must_use]
pub fn ring_sources<O: GpuRing>() -> Vec<(String, String)> {
    vec![(O::NAME.to_owned(), ring_source::<O>())]
}
