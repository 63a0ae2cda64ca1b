//! How batches compute an operation: what is prepared once per shape, what is computed per pair.
use crate::error::{Error, Flaw, Validate};
use crate::kernels::cpu::boxes::{AABB2, BOUNDS, OBB2, frame_fields};
use crate::kernels::cpu::lane::{Lane, Results, TILE, Tiles};
use crate::kernels::op::Op;
use crate::kernels::real::Real;
use crate::kernels::row::{Leaf, Row, leaves_of};
use crate::overlap::{Denominator, score_framed};
use crate::{Aabb2, Fixed, Obb2, Pack, ad, clip};
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
pub type Prepare<T> = fn(Tiles<'_, T>, &mut [Lane<T>]);

/// What is done once for every shape of a column.
pub struct Preparation<T> {
    /// Numbers of a shape.
    pub fields: usize,
    /// How a shape is prepared, and how many numbers that gives; `None` to leave it as it is.
    pub frame: Option<(usize, Prepare<T>)>,
    /// The bounds of prepared shapes; `None` where pairs that are apart have results to compute.
    pub bounds: Option<Prepare<T>>,
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

/// How batches compute an operation.
pub struct Plan<T> {
    /// For every shape that it takes.
    pub arguments: Vec<Preparation<T>>,
    /// Numbers of every shape of a result.
    pub outputs: Vec<usize>,
    /// Results of prepared shapes.
    pub scores: Box<dyn Maker<T>>,
    /// Results and slopes of prepared shapes; slopes times what further inputs say, one for every
    /// shape of a result, if there are any.
    pub slopes: Box<dyn Maker<T>>,
    /// Results of shapes that kernels do not serve.
    pub rare: Option<Rare<T>>,
}

impl<T> Plan<T> {
    /// Numbers of a result.
    pub fn result_fields(&self) -> usize {
        self.outputs.iter().sum()
    }
    /// Numbers of a result with slopes.
    pub fn slope_fields(&self) -> usize {
        self.result_fields() + self.arguments.iter().map(|x| x.fields).sum::<usize>()
    }
}

/// What a batch computes of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Want {
    /// Its result.
    Value,
    /// Its result and the gradient of that, which is one number.
    ValueGrad,
    /// Slopes times a cotangent of the result.
    Vjp,
}

/// An operation as batches see it.
pub struct Face<T> {
    pub(crate) plan: Arc<Plan<T>>,
    pub(crate) want: Want,
}

impl<T> Face<T> {
    /// Numbers that its maker puts down per item.
    pub(crate) fn made(&self) -> usize {
        match self.want {
            Want::Value => self.plan.result_fields(),
            Want::ValueGrad | Want::Vjp => self.plan.slope_fields(),
        }
    }
    /// Numbers of every shape that it gives.
    pub(crate) fn gives(&self) -> Vec<usize> {
        let plan = &self.plan;
        let slopes = plan.arguments.iter().map(|x| x.fields);
        match self.want {
            Want::Value => plan.outputs.clone(),
            Want::ValueGrad => plan.outputs.iter().copied().chain(slopes).collect(),
            Want::Vjp => slopes.collect(),
        }
    }
    /// How many numbers come before those that it gives.
    pub(crate) fn skipped(&self) -> usize {
        match self.want {
            Want::Value | Want::ValueGrad => 0,
            Want::Vjp => self.plan.result_fields(),
        }
    }
    /// What computes it.
    pub(crate) fn maker(&self) -> &dyn Maker<T> {
        match self.want {
            Want::Value => &*self.plan.scores,
            Want::ValueGrad | Want::Vjp => &*self.plan.slopes,
        }
    }
    /// Numbers of every cotangent that it takes.
    pub(crate) fn cotangents(&self) -> &[usize] {
        match self.want {
            Want::Value | Want::ValueGrad => &[],
            Want::Vjp => &self.plan.outputs,
        }
    }
}

/// An operation that has compiled kernels.
#[derive(Clone, Copy, Debug)]
pub enum Compiled {
    /// A score of rotated boxes.
    Obb2(Denominator),
    /// A score of axis-aligned boxes.
    Aabb2(Denominator),
}

/// The plan of an operation with compiled kernels.
pub fn of_compiled<T: Real>(compiled: Compiled) -> Plan<T> {
    match compiled {
        Compiled::Obb2(over) => of_obb2(over),
        Compiled::Aabb2(over) => of_aabb2(over),
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
        check: |numbers| Obb2::load(numbers).validate(),
        is_rare: |numbers| !clip::is_ordinary(Obb2::load(numbers)),
    };
    Plan {
        arguments: vec![shape(), shape()],
        outputs: vec![1],
        scores: Box::new(Scores(over, kernels.obb2_scores)),
        slopes: Box::new(Slopes(over, kernels.obb2_slopes)),
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
            bars.0.store(&mut out[1..]);
            bars.1.store(&mut out[1 + OBB2..]);
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
        check: |numbers| Aabb2::load(numbers).validate(),
        is_rare: |_| false,
    };
    Plan {
        arguments: vec![shape(), shape()],
        outputs: vec![1],
        scores: Box::new(Scores(over, kernels.aabb2_scores)),
        slopes: Box::new(Slopes(over, kernels.aabb2_slopes)),
        rare: None,
    }
}

/// Something that computes one item: its numbers, the cotangent of its result or nothing, and room for
/// a result, or for a result and slopes.
pub type Each<T> = fn(&[T], Option<&[T]>, &mut [T]);

/// Computes item by item.
struct Plain<T> {
    each: Each<T>,
    /// Numbers of every shape that it takes, and of every shape that it gives.
    arguments: Vec<usize>,
    outputs: Vec<usize>,
    /// Whether slopes are asked for.
    slopes: bool,
}

/// An item of a tile.
fn item<T: Copy>(input: &Tiles<'_, T>, t: usize, i: usize, fields: usize, numbers: &mut Vec<T>) {
    let tile = input.lanes[t * input.step..].iter().take(fields);
    numbers.extend(tile.map(|lane| lane.0[i]));
}

impl<T: Real> Maker<T> for Plain<T> {
    fn make(&self, _: &mut Room<T>, inputs: &[Tiles<'_, T>], mut out: Results<'_, T>) {
        let (shapes, cotangents) = inputs.split_at(self.arguments.len());
        let result: usize = self.outputs.iter().sum();
        let input: usize = self.arguments.iter().sum();
        let (mut numbers, mut seed) = (Vec::new(), Vec::new());
        let mut one = vec![T::default(); if self.slopes { result + input } else { result }];
        for t in 0..out.tiles {
            for i in 0..TILE {
                numbers.clear();
                seed.clear();
                for (shape, &fields) in shapes.iter().zip(&self.arguments) {
                    item(shape, t, i, fields, &mut numbers);
                }
                for (cotangent, &fields) in cotangents.iter().zip(&self.outputs) {
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

/// An operation that is computed item by item.
pub fn of_items<T: Real>(
    arguments: Vec<Leaf<T>>,
    outputs: Vec<usize>,
    each: [Each<T>; 2],
) -> Plan<T> {
    let fields: Vec<usize> = arguments.iter().map(|leaf| leaf.fields).collect();
    let maker = |slopes| {
        Box::new(Plain {
            each: each[usize::from(slopes)],
            arguments: fields.clone(),
            outputs: outputs.clone(),
            slopes,
        })
    };
    Plan {
        scores: maker(false),
        slopes: maker(true),
        arguments: arguments.into_iter().map(Preparation::plain).collect(),
        outputs: outputs.clone(),
        rare: None,
    }
}

/// The plan of an operation.
pub fn of_op<O, T: Real, R>() -> Plan<T>
where
    R: Row<Scalar = T>,
    O: Op<In<T> = R>,
    O::Out<T>: Row,
{
    if let Some(compiled) = O::compiled() {
        return of_compiled(compiled);
    }
    let outputs = leaves_of::<O::Out<T>>()
        .iter()
        .map(|leaf| leaf.fields)
        .collect();
    of_items(
        leaves_of::<R>(),
        outputs,
        [
            |x, _, out| O::eval(R::load(x)).store(out),
            |x, out_bar, out| {
                let out_bar = match out_bar {
                    Some(out_bar) => O::Out::<T>::load(out_bar),
                    None => O::Out::<T>::filled(T::one()),
                };
                if let Some((value, bars)) = O::adjoint(R::load(x), out_bar) {
                    let (result, slopes) = out.split_at_mut(O::Out::<T>::LEN);
                    value.store(result);
                    bars.store(slopes);
                }
            },
        ],
    )
}

/// Plans of operations that were asked for, by operation and format.
static PLANS: RwLock<Option<HashMap<(TypeId, TypeId), Arc<dyn Any + Send + Sync>>>> =
    RwLock::new(None);

/// What batches compute of an operation.
pub fn face_of<O, R: Row>(want: Want) -> Result<Face<R::Scalar>, Error>
where
    O: Op<In<<R as Pack>::Scalar> = R>,
    O::Out<R::Scalar>: Row,
{
    let key = (TypeId::of::<O>(), TypeId::of::<R::Scalar>());
    let known = PLANS.read().unwrap_or_else(PoisonError::into_inner);
    let known = known.as_ref().and_then(|plans| plans.get(&key)).cloned();
    if let Some(plan) = known.and_then(|plan| plan.downcast::<Plan<R::Scalar>>().ok()) {
        return Ok(Face { plan, want });
    }
    let plan = Arc::new(of_op::<O, R::Scalar, R>());
    let mut plans = PLANS.write().unwrap_or_else(PoisonError::into_inner);
    plans.get_or_insert_default().insert(key, plan.clone());
    Ok(Face { plan, want })
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
