//! How batches compute an operation: what is prepared once per shape, what is computed per pair.
use crate::ad::adjoint::iou::giou_framed_vjp;
use crate::ad::adjoint::upright::score_upright_vjp;
use crate::ad::program::graph::{Graph, Id};
use crate::ad::program::record::record;
use crate::ad::program::recorded::Recorded;
use crate::ad::program::{Plain, Sym};
use crate::error::{Error, Flaw, Validate};
use crate::iou::giou_framed;
use crate::kernels::cpu::boxes::{
    AABB2, BOUNDS, OBB2, SEEN, UPRIGHT, View, is_common_upright, is_solid_obb2,
};
use crate::kernels::cpu::lane::{Lane, Results, TILE, Tiles};
use crate::kernels::cpu::program::Interpreted;
use crate::kernels::cpu::program::split::{Piece, split};
use crate::kernels::cpu::quads::QUAD2;
use crate::kernels::cpu::solids;
use crate::kernels::cpu::upright;
#[cfg(feature = "gpu")]
use crate::kernels::gpu::Generated;
use crate::kernels::op::{self, Op};
use crate::kernels::real::Real;
use crate::kernels::row::{Leaf, Row, leaves_of};
use crate::overlap::{Denominator, score_framed};
use crate::overlap3::score_yaw;
use crate::shape::YawBox3;
use crate::{Aabb2, Fixed, Obb2, Pack, Scalar, Vec2, ad, clip};
use std::any::{Any, TypeId};
use std::collections::HashMap;
use std::sync::{Arc, PoisonError, RwLock};

/// Lanes that a maker may use as it likes, kept from block to block.
pub type Room<T> = Vec<Lane<T>>;

/// Something that computes blocks of items from one or more arguments.
///
/// A compiled kernel is one; a recorded program will be another. It knows nothing of batches.
pub trait Maker<T>: Send + Sync {
    /// Computes as many tiles of results as are asked for. Each input has at least as many tiles, or
    /// one that stands for all.
    fn make(&self, room: &mut Room<T>, inputs: &[Tiles<'_, T>], out: Results<'_, T>);
}

/// Something that is made of each of many shapes, as tiles of numbers.
pub type Prepare<T> = Arc<dyn Fn(Tiles<'_, T>, &mut [Lane<T>]) + Send + Sync>;

/// Something that is made of each of many shapes and of the same shapes prepared.
pub type Outline<T> = Arc<dyn Fn([Tiles<'_, T>; 2], &mut [Lane<T>]) + Send + Sync>;

/// What is done once for every shape of a column.
pub struct Preparation<T> {
    /// Numbers of a shape.
    pub fields: usize,
    /// How a shape is prepared, and how many numbers that gives; `None` to leave it as it is.
    pub frame: Option<(usize, Prepare<T>)>,
    /// The bounds of shapes in the plane; `None` where pairs that are apart have results to compute.
    pub bounds: Option<Outline<T>>,
    /// Whether numbers are those of valid shapes of ordinary size, told quickly. May say no too often.
    pub all_ordinary: fn(&[T]) -> bool,
    /// What is wrong with a shape.
    pub check: fn(&[T]) -> Result<(), Flaw>,
    /// Whether a valid shape is too rare for kernels.
    pub is_rare: fn(&[T]) -> bool,
}

impl<T> Preparation<T> {
    /// Numbers of a prepared shape.
    pub fn frame_fields(&self) -> usize {
        self.frame.as_ref().map_or(self.fields, |frame| frame.0)
    }
    /// A shape that is left as it is.
    pub fn plain(leaf: Leaf<T>) -> Self {
        Preparation {
            fields: leaf.fields,
            frame: None,
            bounds: None,
            // Whether they are valid only the shape knows.
            all_ordinary: |_| false,
            check: leaf.check,
            is_rare: |_| false,
        }
    }
}

/// Results of an item that kernels do not serve: the numbers of its shapes, the cotangent of its
/// result, and room for a result, or for a result and slopes.
pub type Rare<T> = Box<dyn Fn(&[&[T]], &[T], &mut [T]) + Send + Sync>;

/// What is wanted of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Want {
    /// Its result.
    Value,
    /// Its result and the gradient of that, which is one number.
    ValueGrad,
    /// Slopes times a cotangent of the result.
    Vjp,
}

/// How batches compute an operation.
pub struct Face<T> {
    /// For every shape that it takes.
    pub(crate) arguments: Vec<Preparation<T>>,
    /// Numbers of every shape that it gives.
    pub(crate) gives: Vec<usize>,
    /// How many numbers come before those.
    pub(crate) skipped: usize,
    /// Computes results of prepared shapes.
    pub(crate) maker: Box<dyn Maker<T>>,
    /// The steepest cotangent that the maker bears.
    pub(crate) steepest: f64,
    /// Results of shapes, or of cotangents, that the maker does not serve.
    pub(crate) rare: Option<Rare<T>>,
}

impl<T> Face<T> {
    /// Numbers that its maker puts down per item.
    pub(crate) fn made(&self) -> usize {
        self.skipped + self.gives.iter().sum::<usize>()
    }
    /// What is wanted of an operation that takes and gives such shapes. Of slopes the result comes first.
    fn new(
        want: Want,
        arguments: Vec<Preparation<T>>,
        outputs: Vec<usize>,
        maker: Box<dyn Maker<T>>,
    ) -> Self {
        let slopes: Vec<usize> = arguments.iter().map(|x| x.fields).collect();
        let skipped = match want {
            Want::Value | Want::ValueGrad => 0,
            Want::Vjp => outputs.iter().sum(),
        };
        let gives = match want {
            Want::Value => outputs,
            Want::ValueGrad => [outputs, slopes].concat(),
            Want::Vjp => slopes,
        };
        Face {
            arguments,
            gives,
            skipped,
            maker,
            steepest: f64::INFINITY,
            rare: None,
        }
    }
}

/// What batches know of an operation beside its program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compiled {
    /// A score of rotated boxes.
    Obb2(Denominator),
    /// A score of axis-aligned boxes.
    Aabb2(Denominator),
    /// Generalised IoU of rotated boxes.
    Giou,
    /// A score of upright boxes.
    Upright(Denominator),
    /// A score of upright boxes seen from above.
    BirdsEye(Denominator),
    /// The area that two convex quadrilaterals share.
    Quads,
    /// A score of axis-aligned boxes in space: no kernels, but boxes that are apart score zero.
    Aabb3,
    /// The same of boxes of any orientation.
    Obb3,
}

/// How an operation with compiled kernels is computed; `None` where it has none.
fn of_compiled<T: Real>(compiled: Compiled, want: Want) -> Option<Face<T>> {
    match compiled {
        Compiled::Obb2(over) => Some(of_obb2(over, want)),
        Compiled::Aabb2(over) => Some(of_aabb2(over, want)),
        Compiled::Giou => Some(of_giou(want)),
        Compiled::Upright(over) => Some(of_upright(over, want)),
        Compiled::BirdsEye(over) => Some(of_birds_eye(over, want)),
        Compiled::Quads => Some(of_quads(want)),
        Compiled::Aabb3 | Compiled::Obb3 => None,
    }
}

/// The bounds in the plane of shapes whose program alone is known.
fn outline<T: Real>(compiled: Compiled) -> Option<Outline<T>> {
    match compiled {
        Compiled::Aabb3 => Some(Arc::new(|[shapes, _], bounds| {
            solids::aabb3_bounds(shapes, bounds)
        })),
        Compiled::Obb3 => Some(Arc::new(|[shapes, _], bounds| {
            solids::obb3_bounds(shapes, bounds)
        })),
        _ => None,
    }
}

/// A kernel of two boxes: scores.
type ScoresOf<T> = fn(Denominator, Tiles<'_, T>, Tiles<'_, T>, Results<'_, T>);
struct Scores<T>(Denominator, ScoresOf<T>);
impl<T: Real> Maker<T> for Scores<T> {
    fn make(&self, _: &mut Room<T>, inputs: &[Tiles<'_, T>], out: Results<'_, T>) {
        (self.1)(self.0, inputs[0], inputs[1], out);
    }
}

/// A kernel of two boxes: scores with slopes.
type SlopesOf<T> =
    fn(Denominator, Tiles<'_, T>, Tiles<'_, T>, Option<Tiles<'_, T>>, Results<'_, T>);
struct Slopes<T>(Denominator, SlopesOf<T>);
impl<T: Real> Maker<T> for Slopes<T> {
    fn make(&self, _: &mut Room<T>, inputs: &[Tiles<'_, T>], out: Results<'_, T>) {
        (self.1)(self.0, inputs[0], inputs[1], inputs.get(2).copied(), out);
    }
}

/// Scores of rotated boxes.
fn of_obb2<T: Real>(over: Denominator, want: Want) -> Face<T> {
    let kernels = T::kernels();
    let shape = || Preparation {
        fields: OBB2,
        frame: Some(obb2_frames(View::Flat)),
        bounds: Some(obb2_bounds()),
        all_ordinary: kernels.all_ordinary_obb2,
        check: |numbers| Obb2::load(numbers).validate(),
        is_rare: |numbers| !clip::is_ordinary(Obb2::load(numbers)),
    };
    let maker: Box<dyn Maker<T>> = match want {
        Want::Value => Box::new(Scores(over, kernels.obb2_scores)),
        Want::ValueGrad | Want::Vjp => Box::new(Slopes(over, kernels.obb2_slopes)),
    };
    Face {
        // Slopes of ordinary boxes are below 10²⁶ in single precision, and their terms.
        steepest: T::LARGEST.powf(0.3125),
        rare: Some(Box::new(move |shapes, out_bar, out| {
            let [a, b] = [0, 1].map(|k| clip::frame(Obb2::load(shapes[k])));
            let out_bar = out_bar.first().copied().unwrap_or(T::one());
            if let [value] = out {
                *value = score_framed::<T, true>(over, a, b);
                return;
            }
            let (value, bars) =
                ad::adjoint::overlap::score_framed_vjp::<T, true>(over, a, b, out_bar);
            out[0] = value;
            bars.store(&mut out[1..]);
        })),
        ..Face::new(want, vec![shape(), shape()], vec![1], maker)
    }
}

/// How rotated boxes are prepared, and how many numbers that gives.
fn obb2_frames<T: Real>(view: View) -> (usize, Prepare<T>) {
    let frames = T::kernels().obb2_frames;
    let prepare = move |shapes: Tiles<'_, T>, out: &mut [Lane<T>]| frames(shapes, view, out);
    (view.fields::<T>(), Arc::new(prepare))
}

/// The bounds of prepared rotated boxes.
fn obb2_bounds<T: Real>() -> Outline<T> {
    let bounds = T::kernels().obb2_bounds;
    Arc::new(move |[_, frames], out| bounds(frames, out))
}

/// A kernel of two shapes of which there is one: generalised IoU, areas of quadrilaterals.
struct Scored<T>(fn(Tiles<'_, T>, Tiles<'_, T>, Results<'_, T>));
impl<T: Real> Maker<T> for Scored<T> {
    fn make(&self, _: &mut Room<T>, inputs: &[Tiles<'_, T>], out: Results<'_, T>) {
        (self.0)(inputs[0], inputs[1], out);
    }
}
/// The same with slopes.
type SlopesOfOneOf<T> = fn(Tiles<'_, T>, Tiles<'_, T>, Option<Tiles<'_, T>>, Results<'_, T>);
struct SlopesOfOne<T>(SlopesOfOneOf<T>);
impl<T: Real> Maker<T> for SlopesOfOne<T> {
    fn make(&self, _: &mut Room<T>, inputs: &[Tiles<'_, T>], out: Results<'_, T>) {
        (self.0)(inputs[0], inputs[1], inputs.get(2).copied(), out);
    }
}

/// Whether every rotated box is of common size, and none of zero size.
fn all_solid<T: Real>(numbers: &[T]) -> bool {
    let solid = |all: bool, x: &[T]| all & x[2].above(T::default()) & x[3].above(T::default());
    (T::kernels().all_common_obb2)(numbers) && numbers.chunks_exact(OBB2).fold(true, solid)
}

/// Generalised IoU of rotated boxes. Boxes that are apart have results, so there are no bounds.
fn of_giou<T: Real>(want: Want) -> Face<T> {
    let kernels = T::kernels();
    let shape = || Preparation {
        fields: OBB2,
        frame: Some(obb2_frames(View::Flat)),
        bounds: None,
        all_ordinary: all_solid::<T>,
        check: |numbers| Obb2::load(numbers).validate(),
        is_rare: |numbers| !is_solid_obb2(numbers),
    };
    let maker: Box<dyn Maker<T>> = match want {
        Want::Value => Box::new(Scored(kernels.giou_scores)),
        Want::ValueGrad | Want::Vjp => Box::new(SlopesOfOne(kernels.giou_slopes)),
    };
    Face {
        steepest: T::LARGEST.powf(0.3125),
        rare: Some(Box::new(move |shapes, out_bar, out| {
            let [a, b] = [0, 1].map(|k| clip::frame(Obb2::load(shapes[k])));
            let out_bar = out_bar.first().copied().unwrap_or(T::one());
            if let [value] = out {
                *value = giou_framed::<T, true>(a, b);
                return;
            }
            let (value, bars) = giou_framed_vjp::<T, true>(a, b, out_bar);
            out[0] = value;
            bars.store(&mut out[1..]);
        })),
        ..Face::new(want, vec![shape(), shape()], vec![1], maker)
    }
}

/// Areas that convex quadrilaterals share.
fn of_quads<T: Real>(want: Want) -> Face<T> {
    let kernels = T::kernels();
    let shape = || Preparation {
        fields: QUAD2,
        frame: None,
        bounds: None,
        all_ordinary: kernels.all_finite,
        check: |numbers| <[Vec2<T>; 4]>::load(numbers).validate(),
        is_rare: |_| false,
    };
    let maker: Box<dyn Maker<T>> = match want {
        Want::Value => Box::new(Scored(kernels.quad_scores)),
        Want::ValueGrad | Want::Vjp => Box::new(SlopesOfOne(kernels.quad_slopes)),
    };
    Face::new(want, vec![shape(), shape()], vec![1], maker)
}

/// Scores of upright boxes: of what is shared seen from above, then of heights.
struct UprightScores(Denominator);
impl<T: Real> Maker<T> for UprightScores {
    fn make(&self, _: &mut Room<T>, inputs: &[Tiles<'_, T>], mut out: Results<'_, T>) {
        let kernels = T::kernels();
        (kernels.obb2_scores)(Denominator::None, inputs[0], inputs[1], out.again());
        (kernels.upright_scores)(self.0, inputs[0], inputs[1], out);
    }
}

/// The same with slopes.
struct UprightSlopes(Denominator);
impl<T: Real> Maker<T> for UprightSlopes {
    fn make(&self, _: &mut Room<T>, inputs: &[Tiles<'_, T>], mut out: Results<'_, T>) {
        let kernels = T::kernels();
        (kernels.obb2_slopes)(Denominator::None, inputs[0], inputs[1], None, out.again());
        let seeds = inputs.get(2).copied();
        (kernels.upright_slopes)(self.0, inputs[0], inputs[1], seeds, out);
    }
}

/// Scores of upright boxes.
fn of_upright<T: Real>(over: Denominator, want: Want) -> Face<T> {
    let kernels = T::kernels();
    let shape = || Preparation {
        fields: UPRIGHT,
        frame: Some(obb2_frames(View::Upright)),
        bounds: Some(obb2_bounds()),
        all_ordinary: kernels.all_common_upright,
        check: |numbers| YawBox3::load(numbers).validate(),
        is_rare: |numbers| !is_common_upright(numbers),
    };
    let maker: Box<dyn Maker<T>> = match want {
        Want::Value => Box::new(UprightScores(over)),
        Want::ValueGrad | Want::Vjp => Box::new(UprightSlopes(over)),
    };
    Face {
        steepest: T::LARGEST.powf(0.3125),
        rare: Some(Box::new(move |shapes, out_bar, out| {
            let [a, b] = [0, 1].map(|k| YawBox3::load(shapes[k]));
            let out_bar = out_bar.first().copied().unwrap_or(T::one());
            if let [value] = out {
                *value = score_yaw(over, a, b);
                return;
            }
            let (value, bars) = score_upright_vjp(over, a, b, out_bar);
            out[0] = value;
            bars.store(&mut out[1..]);
        })),
        ..Face::new(want, vec![shape(), shape()], vec![1], maker)
    }
}

/// Scores of upright boxes seen from above, with their slopes.
struct BirdsEyeSlopes(Denominator);
impl<T: Real> Maker<T> for BirdsEyeSlopes {
    fn make(&self, _: &mut Room<T>, inputs: &[Tiles<'_, T>], mut out: Results<'_, T>) {
        let seeds = inputs.get(2).copied();
        (T::kernels().obb2_slopes)(self.0, inputs[0], inputs[1], seeds, out.again());
        upright::spread_slopes(&mut out);
    }
}

/// Scores of upright boxes seen from above.
fn of_birds_eye<T: Real>(over: Denominator, want: Want) -> Face<T> {
    let kernels = T::kernels();
    let shape = || Preparation {
        fields: UPRIGHT,
        frame: Some(obb2_frames(View::FromAbove)),
        bounds: Some(obb2_bounds()),
        all_ordinary: kernels.all_common_upright,
        check: |numbers| YawBox3::load(numbers).validate(),
        is_rare: |numbers| !clip::is_ordinary(YawBox3::load(numbers).birds_eye()),
    };
    let maker: Box<dyn Maker<T>> = match want {
        Want::Value => Box::new(Scores(over, kernels.obb2_scores)),
        Want::ValueGrad | Want::Vjp => Box::new(BirdsEyeSlopes(over)),
    };
    let flat = of_obb2::<T>(over, want).rare;
    Face {
        steepest: T::LARGEST.powf(0.3125),
        rare: Some(Box::new(move |shapes, out_bar, out| {
            let Some(flat) = &flat else { return };
            let mut seen = [[T::default(); OBB2]; 2];
            for (seen, shape) in seen.iter_mut().zip(shapes) {
                YawBox3::load(shape).birds_eye().store(seen);
            }
            let seen = seen.each_ref().map(|numbers| &numbers[..]);
            if let [value] = out {
                flat(&seen, out_bar, std::slice::from_mut(value));
                return;
            }
            let mut numbers = [T::default(); 2 * OBB2 + 1];
            flat(&seen, out_bar, &mut numbers);
            out.fill(T::default());
            out[0] = numbers[0];
            for (k, place) in SEEN.into_iter().enumerate() {
                out[1 + place] = numbers[1 + k];
                out[1 + UPRIGHT + place] = numbers[1 + OBB2 + k];
            }
        })),
        ..Face::new(want, vec![shape(), shape()], vec![1], maker)
    }
}

/// Scores of axis-aligned boxes.
fn of_aabb2<T: Real>(over: Denominator, want: Want) -> Face<T> {
    let kernels = T::kernels();
    let shape = || Preparation {
        fields: AABB2,
        frame: None,
        // The bounds are the shape itself.
        bounds: Some(Arc::new(|[shapes, _], bounds| {
            bounds.copy_from_slice(&shapes.lanes[..bounds.len()]);
        })),
        all_ordinary: kernels.all_aabb2,
        check: |numbers| Aabb2::load(numbers).validate(),
        is_rare: |_| false,
    };
    let maker: Box<dyn Maker<T>> = match want {
        Want::Value => Box::new(Scores(over, kernels.aabb2_scores)),
        Want::ValueGrad | Want::Vjp => Box::new(Slopes(over, kernels.aabb2_slopes)),
    };
    Face {
        // They serve boxes of any size.
        steepest: 1.0,
        rare: Some(Box::new(move |shapes, out_bar, out| {
            let [a, b] = [0, 1].map(|k| Aabb2::load(shapes[k]));
            let out_bar = out_bar.first().copied().unwrap_or(T::one());
            let (value, bars) = ad::adjoint::overlap::score_aabb2_vjp(over, a, b, out_bar);
            out[0] = value;
            if out.len() > 1 {
                bars.store(&mut out[1..]);
            }
        })),
        ..Face::new(want, vec![shape(), shape()], vec![1], maker)
    }
}

/// How a recorded program is computed. Its inputs are the numbers of its arguments and then those of
/// cotangents. For all pairs what is made of one argument alone is made once per shape.
pub(crate) fn of_recorded<T: Real>(
    want: Want,
    leaves: Vec<Leaf<T>>,
    outputs: Vec<usize>,
    recorded: &Recorded,
    framed: bool,
) -> Result<Face<T>, Error> {
    let mut fields: Vec<usize> = leaves.iter().map(|leaf| leaf.fields).collect();
    let mut arguments: Vec<_> = leaves.into_iter().map(Preparation::plain).collect();
    if want == Want::Vjp {
        fields.extend(&outputs);
    }
    let value = &recorded.value;
    let maker = |graph: &Graph, fields: &[usize], outputs: &[Id], skipping| {
        Interpreted::new(graph, fields, outputs, skipping).map_err(Error::Program)
    };
    let body = match framed {
        false => maker(&value.graph, &fields, &value.outputs, false)?,
        true => {
            // Cotangents come as they are.
            let (graph, own) = (&value.graph, arguments.len());
            let parts = split(graph, &fields, own, &value.outputs, |_| true);
            for ((argument, frame), &own) in arguments.iter_mut().zip(&parts.frames).zip(&fields) {
                argument.frame = Some(prepared(frame, own)?);
            }
            maker(&parts.body.graph, &parts.widths, &parts.body.outputs, true)?
        }
    };
    Ok(Face::new(want, arguments, outputs, Box::new(body)))
}

/// How frames are made of shapes of so many numbers, and how many numbers those have.
pub(crate) fn prepared<T: Real>(
    frame: &Piece,
    fields: usize,
) -> Result<(usize, Prepare<T>), Error> {
    let made = Interpreted::new(&frame.graph, &[fields], &frame.outputs, false);
    let made = made.map_err(Error::Program)?;
    let prepare = move |shapes: Tiles<'_, T>, frames: &mut [Lane<T>]| {
        made.prepare(&mut Room::new(), &[shapes], frames);
    };
    Ok((frame.outputs.len(), Arc::new(prepare)))
}

/// Something that computes one item: its numbers, the cotangent of its result or nothing, and room for
/// a result, or for a result and slopes.
pub type Each<T> = fn(&[T], Option<&[T]>, &mut [T]);

/// Computes item by item.
struct Items<T> {
    each: Each<T>,
    /// Numbers of every shape that it takes, of all of them, of every cotangent, and put down per item.
    arguments: Vec<usize>,
    taken: usize,
    cotangents: Vec<usize>,
    made: usize,
}

/// Numbers of an item of a tile.
fn item<T: Copy>(input: &Tiles<'_, T>, t: usize, i: usize, fields: usize, numbers: &mut Vec<T>) {
    let tile = input.lanes[t * input.step..].iter().take(fields);
    numbers.extend(tile.map(|lane| lane.0[i]));
}

impl<T: Real> Maker<T> for Items<T> {
    fn make(&self, _: &mut Room<T>, inputs: &[Tiles<'_, T>], mut out: Results<'_, T>) {
        let (shapes, cotangents) = inputs.split_at(self.arguments.len());
        let (mut numbers, mut seed) = (Vec::with_capacity(self.taken), Vec::new());
        let mut one = vec![T::default(); self.made];
        for t in 0..out.tiles {
            for i in 0..TILE {
                numbers.clear();
                seed.clear();
                for (shape, &fields) in shapes.iter().zip(&self.arguments) {
                    item(shape, t, i, fields, &mut numbers);
                }
                for (cotangent, &fields) in cotangents.iter().zip(&self.cotangents) {
                    item(cotangent, t, i, fields, &mut seed);
                }
                (self.each)(&numbers, (!seed.is_empty()).then_some(&seed), &mut one);
                for (k, &x) in one.iter().enumerate() {
                    if let Some(lane) = out.lane(t, k) {
                        lane.0[i] = x.canonical();
                    }
                }
            }
        }
    }
}

/// How an operation is computed item by item.
pub(crate) fn of_items<T: Real>(
    want: Want,
    leaves: Vec<Leaf<T>>,
    outputs: Vec<usize>,
    each: Each<T>,
) -> Face<T> {
    let arguments: Vec<usize> = leaves.iter().map(|leaf| leaf.fields).collect();
    let (taken, result): (usize, usize) = (arguments.iter().sum(), outputs.iter().sum());
    let made = match want {
        Want::Value => result,
        Want::ValueGrad | Want::Vjp => result + taken,
    };
    let items = Items {
        each,
        arguments,
        taken,
        cotangents: outputs.clone(),
        made,
    };
    let plans = leaves.into_iter().map(Preparation::plain).collect();
    Face::new(want, plans, outputs, Box::new(items))
}

/// What is kept of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Known {
    /// The programs of a fold.
    Fold,
    /// How batches compute what is wanted of an edge of a fold.
    Edge(Want),
    /// The program of what is wanted.
    Program(Want),
    /// How batches compute it, aligned or all pairs.
    Face(Want, bool),
    /// What a GPU is given of it, aligned or all pairs.
    #[cfg(feature = "gpu")]
    Shader(Want, bool),
    /// What a GPU is given of a fold.
    #[cfg(feature = "gpu")]
    FoldShader,
}

/// What was asked for before, by operation and format.
type Kept = HashMap<(TypeId, TypeId, Known), Made>;
type Made = Arc<dyn Any + Send + Sync>;
static KNOWN: RwLock<Option<Kept>> = RwLock::new(None);

/// Something that is made once per operation and format.
pub(crate) fn known<O: 'static, T: 'static, X: Send + Sync + 'static>(
    key: Known,
    make: impl Fn() -> Result<X, Error>,
) -> Result<Arc<X>, Error> {
    let key = (TypeId::of::<O>(), TypeId::of::<T>(), key);
    let found = kept(key, &|| Ok(Arc::new(make()?)))?;
    Ok(found
        .downcast()
        .unwrap_or_else(|_| unreachable!("a key stands for one type")))
}

/// What was made before under a key, or is made now.
fn kept(
    key: (TypeId, TypeId, Known),
    make: &dyn Fn() -> Result<Made, Error>,
) -> Result<Made, Error> {
    let known = KNOWN.read().unwrap_or_else(PoisonError::into_inner);
    let found = known.as_ref().and_then(|known| known.get(&key)).cloned();
    drop(known);
    if let Some(found) = found {
        return Ok(found);
    }
    let made = make()?;
    let mut known = KNOWN.write().unwrap_or_else(PoisonError::into_inner);
    known.get_or_insert_default().insert(key, made.clone());
    Ok(made)
}

/// What is wanted of an operation, as a program: the result, or the result and slopes, from the input
/// and then the cotangent.
pub(crate) fn program_of<O: Op, T: Plain>(want: Want) -> Result<Arc<Recorded>, Error> {
    known::<O, T, _>(Known::Program(want), || {
        type In<O, T> = <O as Op>::In<Sym<T>>;
        type Out<O, T> = <O as Op>::Out<Sym<T>>;
        // Without an adjoint by hand the program fails to be finite, which nothing then hides.
        let by_hand = |x, out_bar| {
            let nothing = || {
                (
                    Out::<O, T>::filled(Sym::lit(f64::NAN)),
                    In::<O, T>::filled(Sym::lit(0.0)),
                )
            };
            O::adjoint(x, out_bar).unwrap_or_else(nothing)
        };
        if want == Want::Value {
            return record::<T, In<O, T>, Out<O, T>>(O::eval);
        }
        match (O::SLOPES, want) {
            (op::Slopes::ByHand, Want::Vjp) => {
                record(|(x, out_bar): (In<O, T>, Out<O, T>)| by_hand(x, out_bar))
            }
            (op::Slopes::ByHand, _) => {
                record(|x: In<O, T>| by_hand(x, Out::<O, T>::filled(Sym::lit(1.0))))
            }
            (op::Slopes::Reverse, Want::Vjp) => Ok(program_of::<O, T>(Want::Value)?.value_vjp()),
            (op::Slopes::Reverse, _) => Ok(program_of::<O, T>(Want::Value)?.value_grad()),
            (op::Slopes::Forward, Want::Vjp) => {
                Ok(program_of::<O, T>(Want::Value)?.value_vjp_forwards())
            }
            (op::Slopes::Forward, _) => Ok(program_of::<O, T>(Want::Value)?.value_grad_forwards()),
        }
    })
}

/// How batches compute what is wanted of an operation.
pub fn face_of<O, R: Row>(want: Want, framed: bool) -> Result<Arc<Face<R::Scalar>>, Error>
where
    O: Op<In<<R as Pack>::Scalar> = R>,
    O::Out<R::Scalar>: Row,
{
    known::<O, R::Scalar, _>(Known::Face(want, framed), || {
        if let Some(face) = O::compiled().and_then(|compiled| of_compiled(compiled, want)) {
            return Ok(face);
        }
        let recorded = program_of::<O, R::Scalar>(want)?;
        let outputs = leaves_of::<O::Out<R::Scalar>>();
        let outputs = outputs.iter().map(|leaf| leaf.fields).collect();
        let mut face = of_recorded(want, leaves_of::<R>(), outputs, &recorded, framed)?;
        for argument in &mut face.arguments {
            argument.bounds = O::compiled().and_then(outline);
        }
        Ok(face)
    })
}

/// What a GPU is given of what is wanted of an operation.
#[cfg(feature = "gpu")]
pub fn generated_of<O, R: Row>(want: Want, framed: bool) -> Result<Arc<Generated<R::Scalar>>, Error>
where
    O: Op<In<<R as Pack>::Scalar> = R>,
    O::Out<R::Scalar>: Row,
{
    known::<O, R::Scalar, _>(Known::Shader(want, framed), || {
        let recorded = program_of::<O, R::Scalar>(want)?;
        let outputs = leaves_of::<O::Out<R::Scalar>>();
        let outputs = outputs.iter().map(|leaf| leaf.fields).collect();
        Generated::new(want, leaves_of::<R>(), outputs, &recorded, framed)
    })
}

/// A list of shapes, prepared.
pub struct List<'a, T> {
    /// The shapes' numbers.
    pub numbers: &'a [T],
    /// Numbers per shape.
    pub fields: usize,
    /// How many shapes.
    pub count: usize,
    /// Prepared shapes in tiles.
    pub frames: Vec<Lane<T>>,
    /// Numbers per prepared shape.
    pub frame_fields: usize,
    /// Bounds in tiles; nothing meets those that fill up the last one, everything those of rare
    /// shapes. `None` where they are of no use.
    pub bounds: Option<Vec<Lane<T>>>,
    /// Which shapes kernels do not serve, ascending.
    pub rare: Vec<u32>,
}

impl<'a, T: Real> List<'a, T> {
    /// Prepares shapes. `rare` says whether some may be too rare for kernels.
    pub fn new(plan: &Preparation<T>, numbers: &'a [T], rare: bool, bounded: bool) -> Self {
        let fields = plan.fields;
        let count = numbers.len() / fields;
        let tiles = count.div_ceil(TILE);
        let mut shapes = vec![Lane::default(); tiles * fields];
        (T::kernels().bring)(numbers, fields, &mut shapes);
        let frame_fields = plan.frame_fields();
        let mut frames = Vec::new();
        if let Some((_, make)) = &plan.frame {
            frames = vec![Lane::default(); tiles * frame_fields];
            make(Tiles::new(&shapes, fields), &mut frames);
        }
        let mut list = List {
            numbers,
            fields,
            count,
            frames,
            frame_fields,
            bounds: None,
            rare: Vec::new(),
        };
        if rare {
            let all = numbers.chunks_exact(fields).enumerate();
            let rare = all.filter(|(_, shape)| (plan.is_rare)(shape));
            list.rare = rare.map(|(i, _)| i as u32).collect();
        }
        if let (Some(make), true) = (&plan.bounds, bounded) {
            let mut bounds = vec![Lane::default(); tiles * BOUNDS];
            let frames = Tiles::new(&list.frames, frame_fields);
            make([Tiles::new(&shapes, fields), frames], &mut bounds);
            let (least, most) = (T::lit(f64::NEG_INFINITY), T::lit(f64::INFINITY));
            for (items, [low, high]) in [
                (list.rare.clone(), [least, most]),
                (
                    (count as u32..(tiles * TILE) as u32).collect(),
                    [most, least],
                ),
            ] {
                for i in items {
                    let (t, i) = (i as usize / TILE * BOUNDS, i as usize % TILE);
                    for k in 0..BOUNDS {
                        bounds[t + k].0[i] = if k < 2 { low } else { high };
                    }
                }
            }
            list.bounds = Some(bounds);
        }
        if plan.frame.is_none() {
            list.frames = shapes;
        }
        list
    }
    /// A shape's numbers.
    pub fn shape(&self, i: usize) -> &'a [T] {
        &self.numbers[i * self.fields..][..self.fields]
    }
    /// A prepared shape in every place of a tile.
    pub fn spread(&self, i: usize, tile: &mut [Lane<T>]) {
        let from = &self.frames[i / TILE * self.frame_fields..];
        (T::kernels().spread)(from, i % TILE, tile);
    }
    /// A shape's bounds.
    pub fn bounds_of(&self, i: usize) -> Option<[T; BOUNDS]> {
        let tile = self.bounds.as_ref()?[i / TILE * BOUNDS..].first_chunk::<BOUNDS>()?;
        Some(tile.each_ref().map(|lane| lane.0[i % TILE]))
    }
    /// Whether kernels do not serve a shape.
    pub fn is_rare(&self, i: usize) -> bool {
        self.rare.binary_search(&(i as u32)).is_ok()
    }
}
