//! Inputs of checks: seeded random inputs and hard cases of every shape.
//!
//! A generator of our own keeps the library free of dependencies and the samples equal on every machine. Random pairs
//! are snapped to each other now and then, so that ties, touching sides and near ties occur by themselves. Whole inputs
//! are moved far away and scaled, because digits are lost there.
mod clouds;
mod curved_solids;
#[cfg_attr(
    not(feature = "check"),
    expect(dead_code, reason = "only the harness asks for all of it")
)]
pub(crate) mod drawn;
mod hulls;
#[cfg(feature = "check")]
pub(crate) mod lattice;
mod own_shapes;
pub(crate) mod several;
mod solid_boxes;
#[cfg(feature = "proptest")]
pub mod strategy;

use crate::ad::declared::Kind;
use crate::{Pack, Real, Scalar};
use std::f64::consts::FRAC_PI_2;

pub use crate::ad::sample::drawn::{hard_cases, random};

/// A small seeded generator of random numbers (SplitMix64).
#[derive(Clone, Debug)]
pub struct Draw(u64);

impl Draw {
    /// Creates a generator from a seed; one seed gives equal numbers on every machine.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let mut draw = Draw(seed);
        draw.bits();
        draw
    }
    /// Returns sixty-four random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// Returns a number in `[0, 1)`.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }
    /// Returns a number in `[low, high)`.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
    /// Returns a positive number in `[low, high)`, all magnitudes alike.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        self.within(low.ln(), high.ln()).exp()
    }
    /// Returns a whole number below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }
    /// Returns `true` once in `n` times.
    pub fn once_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }
}

/// An input the harness can make up by itself.
pub trait Sample: Pack<Scalar = f64> + std::fmt::Debug + 'static {
    /// Returns a random shape, of about unit size near the origin.
    fn ordinary(draw: &mut Draw) -> Self;
    /// Returns a random shape that is much longer than wide.
    fn thin(draw: &mut Draw) -> Self {
        Self::ordinary(draw)
    }
    /// Returns another shape that touches this one, exactly or up to rounding.
    fn beside(&self, _draw: &mut Draw) -> Self {
        self.clone()
    }
    /// Returns a random shape whose parts touch.
    fn touching(draw: &mut Draw) -> Self {
        Self::ordinary(draw)
    }
    /// Returns a random shape of any of these kinds, mostly an ordinary one.
    fn draw(draw: &mut Draw) -> Self {
        if draw.once_in(10) {
            Self::thin(draw)
        } else {
            Self::ordinary(draw)
        }
    }
    /// Returns the cases at which geometry fails.
    fn hard() -> Vec<Self>;
    /// Returns the kind of each number.
    fn kinds(&self) -> Vec<Kind>;
    /// Returns for each number the length over which the function may be expected to change.
    fn scales(&self) -> Vec<f64>;
    /// Returns for each number the largest number of the same unit that it is added to: the size of the shape for its
    /// coordinates, one for angles.
    fn extents(&self) -> Vec<f64> {
        let (kinds, scales) = (self.kinds(), self.scales());
        let largest = (0..kinds.len())
            .filter(|&i| kinds[i].is_length())
            .fold(0.0_f64, |m, i| m.max(scales[i]));
        let extent = |kind: &Kind| if kind.is_length() { largest } else { 1.0 };
        kinds.iter().map(extent).collect()
    }
    /// Returns for each number its unit: the size of the smaller shape for lengths, one for angles.
    fn units(&self) -> Vec<f64> {
        self.extents()
    }
    /// Returns `true` if it is valid.
    fn inside(&self) -> bool;
    /// Returns the outlines that a picture of it shows.
    fn outlines(&self) -> Vec<Vec<[f64; 2]>> {
        Vec::new()
    }
    /// Returns the samplers of its parts, one for every shape of a tuple.
    #[doc(hidden)]
    fn samplers() -> Vec<Sampler> {
        vec![Sampler::of::<Self>()]
    }
}

/// The sampling of a shape without its type: its numbers as lists.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(
    not(feature = "check"),
    expect(dead_code, reason = "only the harness asks for all of it")
)]
pub struct Sampler {
    /// A random one.
    pub(crate) draw: fn(&mut Draw) -> Vec<f64>,
    /// Another one that touches this one.
    pub(crate) beside: fn(&[f64], &mut Draw) -> Vec<f64>,
    pub(crate) hard: fn() -> Vec<Vec<f64>>,
    pub(crate) kinds: fn() -> Vec<Kind>,
    pub(crate) scales: fn(&[f64]) -> Vec<f64>,
    pub(crate) extents: fn(&[f64]) -> Vec<f64>,
    pub(crate) inside: fn(&[f64]) -> bool,
}

impl Sampler {
    /// Returns the sampler of a shape of fixed size.
    #[must_use]
    pub fn of<X: Sample>() -> Self {
        // Hard cases are shapes of every kind.
        fn like<X: Sample>(x: &[f64]) -> Option<X> {
            let first = X::hard().into_iter().next()?;
            (first.scalars().len() == x.len()).then(|| first.refill(x))
        }
        Sampler {
            draw: |draw| X::draw(draw).scalars(),
            beside: |x, draw| like::<X>(x).map_or_else(Vec::new, |x| x.beside(draw).scalars()),
            hard: || X::hard().iter().map(Pack::scalars).collect(),
            kinds: || {
                let first = X::hard().into_iter().next();
                first.map_or_else(Vec::new, |x| x.kinds())
            },
            scales: |x| like::<X>(x).map_or_else(Vec::new, |x| x.scales()),
            extents: |x| like::<X>(x).map_or_else(Vec::new, |x| x.extents()),
            inside: |x| like::<X>(x).is_some_and(|x| x.inside()),
        }
    }
    /// Returns the scalars of a random shape.
    #[must_use]
    pub fn draw(&self, draw: &mut Draw) -> Vec<f64> {
        (self.draw)(draw)
    }
    /// Returns the scalars of the cases at which geometry fails.
    #[must_use]
    pub fn hard(&self) -> Vec<Vec<f64>> {
        (self.hard)()
    }
    /// Returns the sampler of a lone number.
    #[must_use]
    pub fn number() -> Self {
        Sampler::of::<f64>()
    }
}

/// A family of inputs to draw.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Family {
    /// The mixture that the harness itself draws: some of each other family.
    #[default]
    Any,
    /// The cases at which geometry fails.
    Hard,
    /// Shapes of about unit size near the origin.
    Ordinary,
    /// Much longer than wide.
    Thin,
    /// From 10⁻¹² to 10⁻⁴ in size.
    Tiny,
    /// From 10⁴ to 10¹² in size.
    Huge,
    /// As far from the origin as 10² to 10⁶ of their own size.
    Far,
    /// Several shapes, of which the second touches the first.
    Touching,
}

/// Puts a whole input elsewhere: rotation about the origin of the plane, then scaling, then translation along x and y.
///
/// The moved input need not be equivalent: heights and rotations of space stay as they are.
/// [`moved_by`](crate::ad::check::symmetry::moved_by) has the motions of space.
#[must_use]
pub fn moved(x: &[f64], kinds: &[Kind], angle: f64, scale: f64, shift: [f64; 2]) -> Vec<f64> {
    let (sin, cos) = if angle == 0.0 {
        (0.0, 1.0)
    } else {
        angle.sin_cos()
    };
    (0..x.len())
        .map(|i| match kinds[i] {
            Kind::X => (cos * x[i] - sin * x[i + 1]) * scale + shift[0],
            Kind::Y => (sin * x[i - 1] + cos * x[i]) * scale + shift[1],
            Kind::Z | Kind::Length | Kind::Offset => x[i] * scale,
            Kind::Angle | Kind::AngleX | Kind::AngleY => x[i] + angle,
            Kind::DirectionX => cos * x[i] - sin * x[i + 1],
            Kind::DirectionY => sin * x[i - 1] + cos * x[i],
            _ => x[i],
        })
        .collect()
}

/// A placement of an input: an angle by which it is turned, a scale, and a translation.
type Placement = (f64, f64, [f64; 2]);
/// The placements of hard cases: turned by an angle, scaled, moved away.
const PLACES: [Placement; 7] = [
    (0.0, 1.0, [0.0, 0.0]),
    (0.0, 1.0, [1e5, 3.0]),
    (0.0, 1e-4, [0.0, 0.0]),
    (0.0, 1e-12, [0.0, 0.0]),
    (0.0, 1e5, [-7e5, 1e5]),
    (0.3, 1.0, [0.0, 0.0]),
    (FRAC_PI_2, 1.0, [0.0, 0.0]),
];

/// Returns simpler inputs, simplest first: fewer elements, then fewer digits. For shrinking.
pub fn simpler<S: Real, X: Pack<Scalar = S>>(x: &X) -> impl Iterator<Item = X> {
    let list: Vec<f64> = x.scalars().iter().map(|x| x.widen()).collect();
    let refilled = |list: Vec<f64>| {
        let list: Vec<S> = list.iter().map(|&x| <S as Scalar>::lit(x)).collect();
        x.refill(&list)
    };
    x.fewer().chain(fewer_digits(list).map(refilled))
}

/// Lists with fewer digits in one of their numbers, simplest first.
pub(crate) fn fewer_digits(list: Vec<f64>) -> impl Iterator<Item = Vec<f64>> {
    (0..list.len()).flat_map(move |i| {
        let (at, list) = (list[i], list.clone());
        let power = if at == 0.0 {
            1.0
        } else {
            10_f64.powi(at.abs().log10().floor() as i32)
        };
        let simple = [
            0.0,
            at.signum(),
            at.round(),
            (at / power).round() * power,
            (at * 64.0).round() / 64.0,
        ];
        // Simpler means fewer digits, or it might go round in circles.
        let simple = simple.into_iter().filter(move |s| digits(*s) < digits(at));
        simple.map(move |simple| {
            let mut simpler = list.clone();
            simpler[i] = simple;
            simpler
        })
    })
}

/// Returns the length of a number when written out.
fn digits(x: f64) -> usize {
    if x == 0.0 { 0 } else { format!("{x:e}").len() }
}
