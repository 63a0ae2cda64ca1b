//! How batches compute an operation: what is prepared once per shape, what is computed per pair.
use crate::kernels::cpu::boxes::{AABB2, BOUNDS, OBB2, frame_fields};
use crate::kernels::cpu::lane::{Lane, Results, TILE, Tiles};
use crate::kernels::op::PairOp;
use crate::kernels::real::Real;
use crate::overlap::{Denominator, score_framed};
use crate::{Fixed, Obb2, ad, clip};
use std::marker::PhantomData;

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
pub type Prepare<T> = fn(Tiles<'_, T>, &mut [Lane<T>]);

/// What is done once for every shape of a list.
pub struct Preparation<T> {
    /// Numbers of a shape.
    pub fields: usize,
    /// How a shape is prepared, and how many numbers that gives; `None` to leave it as it is.
    pub frame: Option<(usize, Prepare<T>)>,
    /// The bounds of prepared shapes; `None` where pairs that are apart have results to compute.
    pub bounds: Option<Prepare<T>>,
    /// Whether numbers are those of valid shapes of ordinary size, told quickly.
    pub all_ordinary: fn(&[T]) -> bool,
    /// Whether a valid shape is too rare for kernels.
    pub is_rare: fn(&[T]) -> bool,
}

impl<T> Preparation<T> {
    /// Numbers of a prepared shape.
    pub fn frame_fields(&self) -> usize {
        self.frame.as_ref().map_or(self.fields, |frame| frame.0)
    }
}

/// Results of a pair of shapes that kernels do not serve: both shapes, what slopes are multiplied by,
/// and room for a value, or for a value and slopes.
pub type Rare<T> = Box<dyn Fn(&[T], &[T], T, &mut [T]) + Send + Sync>;

/// How batches compute an operation of two shapes with one number as result.
pub struct Plan<T> {
    /// For the first and the second shape.
    pub shapes: [Preparation<T>; 2],
    /// Results of prepared shapes.
    pub scores: Box<dyn Maker<T>>,
    /// Results and slopes of prepared shapes; slopes times what a third input says, if there is one.
    pub slopes: Box<dyn Maker<T>>,
    /// The steepest upstream slope that kernels bear.
    pub steepest: f64,
    /// Results of shapes that kernels do not serve.
    pub rare: Option<Rare<T>>,
}

impl<T> Plan<T> {
    /// Numbers per result with slopes.
    pub fn slope_fields(&self) -> usize {
        1 + self.shapes[0].fields + self.shapes[1].fields
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
pub fn of_obb2<T: Real>(over: Denominator) -> Plan<T> {
    let kernels = T::kernels();
    let shape = || Preparation {
        fields: OBB2,
        frame: Some((frame_fields::<T>(), kernels.obb2_frames)),
        bounds: Some(kernels.obb2_bounds),
        all_ordinary: kernels.all_ordinary_obb2,
        is_rare: |numbers| !clip::is_ordinary(Obb2::from_slice(numbers)),
    };
    Plan {
        shapes: [shape(), shape()],
        scores: Box::new(Scores(over, kernels.obb2_scores)),
        slopes: Box::new(Slopes(over, kernels.obb2_slopes)),
        // Slopes of ordinary boxes are below 10²⁶ in single precision, and their terms.
        steepest: T::LARGEST.powf(0.3125),
        rare: Some(Box::new(move |a, b, out_bar, out| {
            let (a, b) = (
                clip::frame(Obb2::from_slice(a)),
                clip::frame(Obb2::from_slice(b)),
            );
            if let [value] = out {
                *value = score_framed::<T, true>(over, a, b);
                return;
            }
            let (value, bars) =
                ad::adjoint::overlap::score_framed_vjp::<T, true>(over, a, b, out_bar);
            out[0] = value;
            out[1..=OBB2].copy_from_slice(&bars.0.to_array());
            out[1 + OBB2..].copy_from_slice(&bars.1.to_array());
        })),
    }
}

/// Scores of axis-aligned boxes.
pub fn of_aabb2<T: Real>(over: Denominator) -> Plan<T> {
    let kernels = T::kernels();
    let shape = || Preparation {
        fields: AABB2,
        frame: None,
        // The bounds are the shape itself.
        bounds: Some(|shapes, bounds| bounds.copy_from_slice(&shapes.lanes[..bounds.len()])),
        all_ordinary: kernels.all_aabb2,
        is_rare: |_| false,
    };
    Plan {
        shapes: [shape(), shape()],
        scores: Box::new(Scores(over, kernels.aabb2_scores)),
        slopes: Box::new(Slopes(over, kernels.aabb2_slopes)),
        // They serve boxes of any size.
        steepest: 1.0,
        rare: None,
    }
}

/// An operation without compiled kernels, number by number.
struct Plain<O>(PhantomData<O>, bool);

/// An item of a tile.
fn item<T: Real, P: Fixed<Scalar = T>>(tile: &[Lane<T>], i: usize) -> P {
    let mut fields = P::filled(T::default()).to_array();
    for (x, lane) in fields.as_mut().iter_mut().zip(tile) {
        *x = lane.0[i];
    }
    P::from_array(fields)
}

impl<O: PairOp, T: Real> Maker<T> for Plain<O> {
    fn make(&self, _: &mut Room<T>, inputs: &[Tiles<'_, T>], mut out: Results<'_, T>) {
        for t in 0..out.tiles {
            let [a, b] = [inputs[0], inputs[1]].map(|x| &x.lanes[t * x.step..]);
            for i in 0..TILE {
                let (a, b) = (O::frame_a(item(a, i)), O::frame_b(item(b, i)));
                let mut put = |k: usize, x: T| {
                    if let Some(lane) = out.lane(t, k) {
                        lane.0[i] = x.canonical();
                    }
                };
                if !self.1 {
                    put(0, O::value::<T, true>(a, b));
                    continue;
                }
                let (value, bars) = O::grad::<T, true>(a, b);
                let (a_bar, b_bar) = (bars.0.to_array(), bars.1.to_array());
                let out_bar = inputs.get(2).map_or(T::one(), |x| x.lanes[t * x.step].0[i]);
                put(0, value);
                for (k, &x) in a_bar.as_ref().iter().chain(b_bar.as_ref()).enumerate() {
                    put(1 + k, (x * out_bar).saturated());
                }
            }
        }
    }
}

/// An operation without compiled kernels.
pub fn of_any<O: PairOp, T: Real>() -> Plan<T> {
    let shape = |fields| Preparation {
        fields,
        frame: None,
        bounds: None,
        // Whether they are valid only the operation knows.
        all_ordinary: |_| false,
        is_rare: |_| false,
    };
    Plan {
        shapes: [shape(O::A::<T>::LEN), shape(O::B::<T>::LEN)],
        scores: Box::new(Plain::<O>(PhantomData, false)),
        slopes: Box::new(Plain::<O>(PhantomData, true)),
        steepest: 1.0,
        rare: None,
    }
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
        let frames = match &plan.frame {
            Some((_, make)) => {
                let mut frames = vec![Lane::default(); tiles * frame_fields];
                make(Tiles::new(&shapes, fields), &mut frames);
                frames
            }
            None => shapes,
        };
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
            make(frames, &mut bounds);
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
