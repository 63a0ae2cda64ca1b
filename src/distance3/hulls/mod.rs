//! Distances of convex hulls: from each other, and from every shape that is the hull of a few corners with a radius.
//!
//! A search on plain numbers finds the features that are nearest, a corner, an edge or a face of each, or that lie in
//! the planes that part the hulls best where these overlap. It iterates where they are clearly apart (GJK) or clearly
//! overlap (EPA), with bounds from both sides as proof; else, and without a proof, it compares all faces and edges, whose
//! order exact predicates decide. The replay evaluates the distance of these features, with first and second derivatives
//! by pose and by vertices.
//!
//! Features that are equally near share the derivative and the point equally, corners up to a few roundings of the size: for
//! parallel faces all corners of their overlap, crossings of edges included. Of more than sixteen the first sixteen
//! do. Planes that are equally deep share the derivative; direction and points are those of the first. Of repeated
//! vertices the first has the derivative, which is one of those between the one-sided ones. In a gap that is mostly
//! rounding the direction is the mean of those of the features, with length one.
//!
//! ```
//! use geograd::distance3::{penetration, signed_distance};
//! use geograd::{Hull3, Obb3, Rotation3, Vec3};
//! let [x, y, z] = [Vec3::new(2.0_f64, 0.0, 0.0), Vec3::new(0.0, 3.0, 0.0), Vec3::new(0.0, 0.0, 4.0)];
//! let wedge: Hull3<f64, 8> = Hull3::from_vertices(&[Vec3::zero(), x, y, z]);
//! let cube = |x: f64| Obb3::new(Vec3::new(x, 0.5, 0.5), Vec3::new(1.0, 1.0, 1.0), Rotation3::identity());
//! assert!((signed_distance(cube(-1.5), wedge) - 1.0).abs() < 1e-15);
//! let out = penetration(cube(-0.25), wedge);
//! assert!((out.depth - 0.25).abs() < 1e-15 && (out.direction.x - 1.0).abs() < 1e-15);
//! ```
//!
//! The search decides in `f64`, also for `f32`. Numbers over other formats have the features of the first vertices.
mod body;
mod corner_slopes;
mod expansion;
mod facing_ring;
mod highest_point;
mod hull_record;
mod hull_replay;
mod hull_search;
mod near_features;
mod parting_planes;
mod patch;

use super::apart::Apart;
use super::aside;
use super::core::Core3;
use super::cored::InflatedCore;
use super::facing::{Patch, PatchName, SIDES};
use super::half_space::Bounded;
use super::near::Low;
use super::relation::Relation;
use super::spot::{plain, vanish};
use crate::arrays::Each;
use crate::distance::share::Best;
use crate::scalar::{Guard, noted};
use crate::{Hull3, Pack, Scalar, Vec3};
pub(super) use body::{Body as HullBody, Face as HullFace};
pub(crate) use corner_slopes::{ByCorners, by_turn, corner_slopes};
use facing_ring::facing;
pub(super) use highest_point::{PointColumns, PointGroups};
pub(super) use hull_record::around;
pub(crate) use hull_record::spanning;
pub use hull_record::{FeaturePair, HullFeatures, HullRecord};
use hull_search::HullPair;
pub(super) use patch::ring as patch_ring;

/// The corners of a shape.
pub(crate) trait CornerList<S: Scalar> {
    /// Returns their number, which is not zero.
    fn count(&self) -> usize;
    /// Returns a corner, by a number below that.
    fn at(&self, k: usize) -> Vec3<S>;
}

/// Corners that are computed at once.
pub(crate) struct FixedCorners<A>(pub A);

impl<S: Scalar, A: AsRef<[Vec3<S>]>> CornerList<S> for FixedCorners<A> {
    #[inline]
    fn count(&self) -> usize {
        self.0.as_ref().len()
    }
    #[inline]
    fn at(&self, k: usize) -> Vec3<S> {
        self.0.as_ref()[k]
    }
}

/// Vertices, each relative to a point when it is read.
pub(crate) struct HullCorners<'a, S> {
    vertices: &'a [Vec3<S>],
    from: Vec3<S>,
}

impl<S: Scalar> CornerList<S> for HullCorners<'_, S> {
    #[inline]
    fn count(&self) -> usize {
        self.vertices.len()
    }
    #[inline]
    fn at(&self, k: usize) -> Vec3<S> {
        self.vertices[k] - self.from
    }
}

/// A convex shape with corners: their hull, inflated by a radius.
pub(crate) trait Cornered: Copy + Pack<Scalar: Scalar> {
    /// The corners relative to a point.
    type Corners<'a>: CornerList<Self::Scalar>
    where
        Self: 'a;
    /// `true` if the radius may be other than zero.
    const ROUNDED: bool;
    /// Returns the centre, if the corners are computed from one.
    fn middle(&self) -> Option<Vec3<Self::Scalar>>;
    /// Returns the corners relative to a point.
    fn corners_from(&self, from: Vec3<Self::Scalar>) -> Self::Corners<'_>;
    /// Returns the radius of the inflation.
    fn inflation(&self) -> Self::Scalar;
    /// Returns a guard with its numbers.
    #[inline]
    fn with_guard(&self, guard: Guard<Self::Scalar>) -> Guard<Self::Scalar> {
        guard.and(self)
    }
    /// Returns the growth of the extent along a direction by sides of length zero: the value zero, with the derivative
    /// by these sides.
    fn widening(&self, normal: Vec3<Self::Scalar>) -> Self::Scalar;
}

impl<A: InflatedCore> Cornered for A {
    type Corners<'a>
        = FixedCorners<<A::Core as Core3<A::Scalar>>::Corners>
    where
        A: 'a;
    const ROUNDED: bool = A::ROUND;
    #[inline]
    fn middle(&self) -> Option<Vec3<A::Scalar>> {
        A::Core::CENTERED.then(|| self.core().anchor())
    }
    #[inline]
    fn corners_from(&self, from: Vec3<A::Scalar>) -> Self::Corners<'_> {
        FixedCorners(self.core().placed(from, A::Scalar::one()).corners())
    }
    #[inline]
    fn inflation(&self) -> A::Scalar {
        InflatedCore::radius(self)
    }
    #[inline]
    fn widening(&self, normal: Vec3<A::Scalar>) -> A::Scalar {
        let core = self.core();
        let core = core.placed(core.anchor(), A::Scalar::one());
        core.growth(normal)
    }
}

impl<S: Scalar, const N: usize> Cornered for Hull3<S, N> {
    type Corners<'a>
        = HullCorners<'a, S>
    where
        S: 'a;
    const ROUNDED: bool = false;
    #[inline]
    fn middle(&self) -> Option<Vec3<S>> {
        None
    }
    #[inline]
    fn corners_from(&self, from: Vec3<S>) -> HullCorners<'_, S> {
        const {
            assert!(0 < N && N <= 256, "records have eight bits for a corner");
        }
        HullCorners {
            vertices: &self.vertices[..self.count.clamp(1, N)],
            from,
        }
    }
    #[inline]
    fn inflation(&self) -> S {
        S::zero()
    }
    #[inline]
    fn with_guard(&self, guard: Guard<S>) -> Guard<S> {
        self.as_slice()
            .iter()
            .fold(guard, |guard, vertex| guard.and(vertex))
    }
    #[inline]
    fn widening(&self, _normal: Vec3<S>) -> S {
        S::zero()
    }
}

/// Returns the point to which the corners of two shapes are relative.
fn origin<S: Scalar, A: Cornered<Scalar = S>, B: Cornered<Scalar = S>>(a: &A, b: &B) -> Vec3<S> {
    a.middle().or(b.middle()).unwrap_or(Vec3::zero())
}

/// Returns a corner as plain numbers, exactly; NaN of another format.
fn number<S: Scalar>(corners: &impl CornerList<S>, k: usize) -> Vec3<f64> {
    let Vec3 { x, y, z } = corners.at(k);
    let [x, y, z] = [x, y, z].each_as(|x| x.widened().unwrap_or(f64::NAN));
    Vec3::new(x, y, z)
}

/// Returns the corners as plain numbers, exactly; NaN of another format.
fn all_numbers<S: Scalar>(corners: &impl CornerList<S>) -> Vec<Vec3<f64>> {
    (0..corners.count()).map(|k| number(corners, k)).collect()
}

/// Returns the corners as plain numbers, exactly; `None` where one is not finite, or of another format.
pub(super) fn numbers<S: Scalar>(corners: &impl CornerList<S>) -> Option<Vec<Vec3<f64>>> {
    let all = all_numbers(corners);
    all.iter().all(|point| point.is_finite()).then_some(all)
}

/// Returns the features that decide about the relation of a hull and another shape with corners. Those of shapes that
/// are not finite are their first corners.
#[must_use]
pub(crate) fn hulls_search<S, A, B>(a: &A, b: &B) -> HullRecord
where
    S: Scalar<Mask = bool>,
    A: Cornered<Scalar = S>,
    B: Cornered<Scalar = S>,
{
    let from = origin(a, b);
    let (of_a, of_b) = (a.corners_from(from), b.corners_from(from));
    let mut pair = HullPair::new([of_a.count(), of_b.count()]);
    let record = match pair.fill(|k| number(&of_a, k), |k| number(&of_b, k)) {
        true => hull_search::search(
            &pair,
            || [all_numbers(&of_a), all_numbers(&of_b)],
            S::format().epsilon(),
        ),
        false => HullRecord::new(&[], false),
    };
    noted::<S::Primal>(1, [record.inside.into()]);
    for features in record.features() {
        let HullFeatures { pair, a, b, plane } = *features;
        let ([i, j, k], [l, m, n]) = (a, b);
        noted::<S::Primal>(8, [pair as u8, i, j, k, l, m, n, plane].map(u32::from));
    }
    record
}

/// Returns the relation of two shapes from the record of [`hulls_search`]. Ties, within roundings of `f64` in every format,
/// share the derivative equally.
#[must_use]
pub(crate) fn hulls_replay<S, A, B>(a: &A, b: &B, record: &HullRecord) -> Relation<S>
where
    S: Scalar,
    A: Cornered<Scalar = S>,
    B: Cornered<Scalar = S>,
{
    let from = origin(a, b);
    let (of_a, of_b) = (a.corners_from(from), b.corners_from(from));
    let found = hull_replay::replay(&of_a, &of_b, record);
    let growth = vanish(a.widening(found.normal) + b.widening(found.normal));
    let by_growth = found.square.root() * growth;
    let found = Relation {
        apart: found.apart - growth,
        square: found.square - vanish(by_growth + by_growth),
        normal: found.normal,
        on_a: from + found.on_a,
        on_b: from + found.on_b,
    };
    match A::ROUNDED || B::ROUNDED {
        true => {
            let mut ways = ways_of(&of_a);
            ways.extend(ways_of(&of_b));
            let aside = aside::across(ways.iter().copied());
            found.inflated(a.inflation(), b.inflation(), aside)
        }
        false => found,
    }
}

/// Returns the vectors from the first corner to all.
fn ways_of<S: Scalar>(corners: &impl CornerList<S>) -> Vec<Vec3<S::Primal>> {
    let from = plain(corners.at(0));
    let way = |k: usize| plain(corners.at(k)) - from;
    (0..corners.count()).map(way).collect()
}

/// Returns a guard of the numbers of two shapes.
pub(crate) fn hulls_guard<S, A, B>(a: &A, b: &B) -> Guard<S>
where
    S: Scalar,
    A: Cornered<Scalar = S>,
    B: Cornered<Scalar = S>,
{
    b.with_guard(a.with_guard(Guard::new()))
}

/// Returns the longest distance of corners of two shapes, with both radii.
fn farthest<S, A, B>(a: &A, b: &B) -> S
where
    S: Scalar,
    A: Cornered<Scalar = S>,
    B: Cornered<Scalar = S>,
{
    let from = origin(a, b);
    let (of_a, of_b) = (a.corners_from(from), b.corners_from(from));
    let pairs = (0..of_a.count()).flat_map(|i| {
        let (p, all) = (of_a.at(i), &of_b);
        (0..all.count()).map(move |j| {
            let length = (all.at(j) - p).length();
            Best::of(length, length)
        })
    });
    let longest = Best::most_of(pairs).mean();
    (longest + (a.inflation() + b.inflation())).canonical()
}

macro_rules! apart {
    ($([$($generic:tt)*] $A:ty, $B:ty;)*) => { $(
        impl<S: Scalar<Mask = bool>, $($generic)*> Apart<$B> for $A {
            type Scalar = S;
            #[inline]
            fn guarded_with(&self, other: &$B) -> Guard<S> {
                hulls_guard(self, other)
            }
            #[inline]
            fn relation(self, other: $B) -> Relation<S> {
                hulls_replay(&self, &other, &hulls_search(&self, &other))
            }
            #[inline]
            fn facing(&self, other: &$B, normal: Vec3<S>) -> [PatchName; 2] {
                [self.face(normal), other.face(-normal)]
            }
            fn patches(&self, other: &$B, [a, b]: [PatchName; 2], normal: Vec3<S>) -> [Patch<S>; 2] {
                [self.patch(a, normal), other.patch(b, -normal)]
            }
            #[inline]
            fn farthest(self, other: $B) -> S {
                farthest(&self, &other)
            }
        }
    )* };
}
apart! {
    [A: InflatedCore<Scalar = S>, const N: usize] A, Hull3<S, N>;
    [B: InflatedCore<Scalar = S>, const N: usize] Hull3<S, N>, B;
    [const N: usize, const M: usize] Hull3<S, N>, Hull3<S, M>;
}

impl<S: Scalar, const N: usize> Bounded for Hull3<S, N> {
    #[inline]
    fn with_numbers(&self, guard: Guard<S>) -> Guard<S> {
        self.with_guard(guard)
    }
    #[inline]
    fn lowest(self, normal: Vec3<S>) -> (S, Vec3<S>) {
        let from = self.corners_from(Vec3::zero()).at(0);
        let arms = self.as_slice().iter().map(|&corner| {
            let arm = corner - from;
            let height = normal.dot(arm);
            Best::of(height, Low(height, arm))
        });
        let Low(height, arm) = Best::least(arms).mean();
        (normal.dot(from) + height, from + arm)
    }
    fn face(self, toward: Vec3<S>) -> PatchName
    where
        S: Scalar<Mask = bool>,
    {
        let wide = numbers(&FixedCorners([toward])).map(|all| all[0]);
        let points = crate::hull3::numbers(self.as_slice());
        let ring = points
            .zip(wide)
            .map(|(points, toward)| facing(&points, toward, S::format().epsilon()));
        let ring = ring.unwrap_or_default();
        match ring.len() {
            0 => PatchName::Spot,
            n => {
                let count = n.min(SIDES);
                PatchName::corners((0..count).map(|k| ring[k * n / count]))
            }
        }
    }
    fn patch(self, name: PatchName, _: Vec3<S>) -> Patch<S> {
        Patch::named(name, |k| self.vertices[k])
    }
}
