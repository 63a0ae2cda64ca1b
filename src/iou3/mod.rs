//! The family of IoU losses in space, and an overlap that has slopes for boxes apart.
//!
//! | function | is | range | paper |
//! | --- | --- | --- | --- |
//! | [`giou`] | IoU less the share of the enclosing shape that is in neither box | `(−1, 1]` | Rezatofighi et al., *Generalized intersection over union*, CVPR 2019 |
//! | [`diou`] | IoU less the squared distance of the centres over the enclosing box's squared diagonal | `(−1, 1]` | Zheng et al., *Distance-IoU loss*, AAAI 2020 |
//! | [`ciou`], [`ciou_fixed_weight`] | DIoU less a weighted difference of the proportions | `(−2, 1]` | the same |
//! | [`eiou`] | DIoU less squared differences of the sizes over the enclosing box's | `(−4, 1]` | Zhang et al., *Focal and efficient IoU loss*, 2021 |
//! | [`alpha_iou`] | a power of IoU | `[0, 1]` | He et al., *Alpha-IoU*, NeurIPS 2021 |
//! | [`separation_aware`] | IoU, or for boxes apart minus their separation over itself and their size | `(−1, 1]` | here |
//!
//! The papers define them in the plane; here areas are volumes and the proportions are those of all three
//! pairs of sizes. Losses are one minus these.
//!
//! Any kind of box serves ([`Solid`]); [`Enclosing`] says what is put around a pair. Kinks are those of IoU
//! and of the enclosing shape.
use crate::overlap3::{iou_aabb3, iou_obb3, iou_yaw};
use crate::shape::{Aabb3, Obb3, YawBox3};
use crate::{Scalar, Vec3};

mod enclosing;
mod separation;

pub use enclosing::{Enclosing, smallest_rectangle};
pub use separation::{penetration_or_gap, separation_aware};

/// A kind of box in space that the family of losses is for.
pub trait Solid<S: Scalar>: Copy + Into<Obb3<S>> {
    /// Intersection over union.
    #[must_use]
    fn overlap(self, other: Self) -> S;
    /// The volume.
    #[must_use]
    fn own_volume(self) -> S;
    /// The size along the box's own axes.
    #[must_use]
    fn own_size(self) -> Vec3<S>;
    /// The centre.
    #[must_use]
    fn middle(self) -> Vec3<S>;
    /// The size of the chosen shape around both boxes: of the box, or of the upright prism whose ground has
    /// the area of `x · y` and the proportions of the rectangle around it.
    #[must_use]
    fn enclosing(self, other: Self, kind: Enclosing) -> Vec3<S>;
    /// The size of what both share, for a kind that shares boxes; zero where they are apart.
    #[doc(hidden)]
    #[inline]
    fn shared_box(self, _other: Self) -> Option<Vec3<S>> {
        None
    }
}

impl<S: Scalar> Solid<S> for Aabb3<S> {
    #[inline]
    fn overlap(self, other: Self) -> S {
        iou_aabb3(self, other)
    }
    #[inline]
    fn own_volume(self) -> S {
        self.volume()
    }
    #[inline]
    fn own_size(self) -> Vec3<S> {
        self.size()
    }
    #[inline]
    fn middle(self) -> Vec3<S> {
        self.center()
    }
    #[inline]
    fn enclosing(self, other: Self, kind: Enclosing) -> Vec3<S> {
        enclosing::of_bounds(self, other, kind)
    }
    #[inline]
    fn shared_box(self, other: Self) -> Option<Vec3<S>> {
        let apart = (self.max.x.at_most(other.min.x) | other.max.x.at_most(self.min.x))
            | (self.max.y.at_most(other.min.y) | other.max.y.at_most(self.min.y))
            | (self.max.z.at_most(other.min.z) | other.max.z.at_most(self.min.z));
        let meet = self.meet(other).size();
        let held = |x: S| S::select(apart, S::zero(), x);
        Some(Vec3::new(held(meet.x), held(meet.y), held(meet.z)))
    }
}

impl<S: Scalar> Solid<S> for YawBox3<S> {
    #[inline]
    fn overlap(self, other: Self) -> S {
        iou_yaw(self, other)
    }
    #[inline]
    fn own_volume(self) -> S {
        self.volume()
    }
    #[inline]
    fn own_size(self) -> Vec3<S> {
        self.size
    }
    #[inline]
    fn middle(self) -> Vec3<S> {
        self.center
    }
    #[inline]
    fn enclosing(self, other: Self, kind: Enclosing) -> Vec3<S> {
        enclosing::of_upright(self, other, kind)
    }
}

impl<S: Scalar> Solid<S> for Obb3<S> {
    #[inline]
    fn overlap(self, other: Self) -> S {
        iou_obb3(self, other)
    }
    #[inline]
    fn own_volume(self) -> S {
        self.volume()
    }
    #[inline]
    fn own_size(self) -> Vec3<S> {
        self.size
    }
    #[inline]
    fn middle(self) -> Vec3<S> {
        self.center
    }
    #[inline]
    fn enclosing(self, other: Self, kind: Enclosing) -> Vec3<S> {
        enclosing::of_any(self, other, kind)
    }
}

/// `x / y`, zero with slope zero where y is zero.
#[inline(always)]
fn share<S: Scalar>(x: S, y: S) -> S {
    let empty = y.at_most(S::zero());
    S::select(empty, S::zero(), x.over(S::select(empty, S::one(), y)))
}

/// Lengths in a common unit, so that their products stay finite.
#[inline(always)]
fn scaled<S: Scalar>(lengths: [Vec3<S>; 5]) -> [Vec3<S>; 5] {
    let mut size = S::Primal::zero();
    for v in lengths {
        size = size.most(v.x.primal().magnitude());
        size = size.most(v.y.primal().magnitude());
        size = size.most(v.z.primal().magnitude());
    }
    let zero = size.at_most(S::Primal::zero());
    let scale = S::Primal::select(zero, S::Primal::one(), size).binade();
    lengths.map(|v| v * S::from_primal(scale))
}

/// What the terms of the family are made of, in a common unit.
struct Terms<S> {
    iou: S,
    between: Vec3<S>,
    size_a: Vec3<S>,
    size_b: Vec3<S>,
    around: Vec3<S>,
    shared: Option<Vec3<S>>,
}

#[inline(always)]
fn terms<S: Scalar, B: Solid<S>>(a: B, b: B, kind: Enclosing) -> Terms<S> {
    terms_with(a.overlap(b), a, b, kind)
}

/// The same for boxes whose overlap is known.
#[inline(always)]
fn terms_with<S: Scalar, B: Solid<S>>(iou: S, a: B, b: B, kind: Enclosing) -> Terms<S> {
    let meet = a.shared_box(b);
    let lengths = [
        b.middle() - a.middle(),
        a.own_size(),
        b.own_size(),
        a.enclosing(b, kind),
        meet.unwrap_or(Vec3::zero()),
    ];
    let [between, size_a, size_b, around, shared] = scaled(lengths);
    Terms {
        iou,
        between,
        size_a,
        size_b,
        around,
        shared: meet.map(|_| shared),
    }
}

/// Generalized IoU of two boxes, in `(−1, 1]`.
///
/// ```
/// use geograd::{Vec3, iou3::{Enclosing, giou}, shape::Aabb3};
/// let a = Aabb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 1.0));
/// let b = Aabb3::new(Vec3::new(3.0, 0.0, 0.0), Vec3::new(4.0, 1.0, 1.0));
/// assert_eq!(giou(a, a, Enclosing::Aabb), 1.0);
/// assert_eq!(giou(a, b, Enclosing::Aabb), -0.5);
/// ```
#[must_use]
#[inline]
pub fn giou<S: Scalar, B: Solid<S>>(a: B, b: B, kind: Enclosing) -> S {
    giou_of(&terms(a, b, kind)).canonical()
}

#[inline(always)]
fn giou_of<S: Scalar>(t: &Terms<S>) -> S {
    let volume = |v: Vec3<S>| v.x * v.y * v.z;
    let (volume_a, volume_b, around) = (volume(t.size_a), volume(t.size_b), volume(t.around));
    let shared = match t.shared {
        Some(shared) => volume(shared),
        // I/U = i and U = A + B − I.
        None => (volume_a + volume_b) * t.iou.over(S::one() + t.iou),
    };
    // Around less the union, in differences that are exactly zero for a box within the other.
    let (larger, smaller) = (volume_a.most(volume_b), volume_a.least(volume_b));
    let waste = (around - larger) - (smaller - shared);
    // Rounding can leave the shape around a little smaller than what it encloses.
    let short = waste.below(S::zero());
    let waste = S::select(short, waste.with_primal(S::Primal::zero()), waste);
    t.iou - share(waste, around)
}

#[inline(always)]
fn diou_of<S: Scalar>(t: &Terms<S>) -> S {
    t.iou - share(t.between.length_squared(), t.around.length_squared())
}

/// Distance-IoU of two boxes, in `(−1, 1]`.
#[must_use]
#[inline]
pub fn diou<S: Scalar, B: Solid<S>>(a: B, b: B, kind: Enclosing) -> S {
    diou_of(&terms(a, b, kind)).canonical()
}

/// The mean over the pairs (x, y), (y, z), (z, x) of `4/π² (atan(p/q) − atan(p'/q'))²`.
#[inline(always)]
fn proportions<S: Scalar>(t: &Terms<S>) -> S {
    let turn = |p: S, q: S| {
        let none = (p.at_most(S::zero())) & (q.at_most(S::zero()));
        S::select(none, S::one(), p).atan2(S::select(none, S::one(), q))
    };
    let (u, v) = (t.size_a, t.size_b);
    let differ = |p: S, q: S, r: S, s: S| (turn(p, q) - turn(r, s)).squared();
    let sum =
        differ(u.x, u.y, v.x, v.y) + (differ(u.y, u.z, v.y, v.z) + differ(u.z, u.x, v.z, v.x));
    sum * S::lit(4.0 / 3.0 / (std::f64::consts::PI * std::f64::consts::PI))
}

/// Complete IoU of two boxes, in `(−2, 1]`: DIoU less `α v`, where v is the mean over the pairs (x, y),
/// (y, z), (z, x) of `4/π² (atan(p/q) − atan(p'/q'))²` and `α = v / (1 − IoU + v)`. All slopes, those of α
/// too. The ratio of two zero sizes is that of a square.
#[must_use]
#[inline]
pub fn ciou<S: Scalar, B: Solid<S>>(a: B, b: B, kind: Enclosing) -> S {
    ciou_of(&terms(a, b, kind)).canonical()
}

#[inline(always)]
fn ciou_of<S: Scalar>(t: &Terms<S>) -> S {
    let v = proportions(t);
    let weight = share(v, (S::one() - t.iou) + v);
    diou_of(t) - weight * v
}

/// Complete IoU, in `(−2, 1]`, whose weight α counts as constant: no slope goes through it, as its authors
/// train. The value is that of [`ciou`]; the slopes are those of no function.
#[must_use]
#[inline]
pub fn ciou_fixed_weight<S: Scalar, B: Solid<S>>(a: B, b: B, kind: Enclosing) -> S {
    let t = terms(a, b, kind);
    let v = proportions(&t);
    let weight = share(v, (S::one() - t.iou) + v).primal();
    (diou_of(&t) - S::from_primal(weight) * v).canonical()
}

/// Efficient IoU of two boxes, in `(−4, 1]`: DIoU less the squared difference of the sizes along each of the
/// boxes' own axes over the square of the enclosing box's size there; or of the larger one of both sizes,
/// where the boxes are turned so that this is more.
#[must_use]
#[inline]
pub fn eiou<S: Scalar, B: Solid<S>>(a: B, b: B, kind: Enclosing) -> S {
    eiou_of(&terms(a, b, kind)).canonical()
}

#[inline(always)]
fn eiou_of<S: Scalar>(t: &Terms<S>) -> S {
    // Of equal ones what is around counts: it is never smaller, but for turned boxes.
    let larger = |x: S, y: S| S::select(x.below(y), y, x);
    let differ = |p: S, q: S, around: S| {
        let all = larger(larger(around, p), q);
        share((p - q).squared(), all.squared())
    };
    let sizes = differ(t.size_a.x, t.size_b.x, t.around.x)
        + differ(t.size_a.y, t.size_b.y, t.around.y)
        + differ(t.size_a.z, t.size_b.z, t.around.z);
    diou_of(t) - sizes
}

/// A score of boxes of any orientation that is made of their IoU and of a formula of their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Score {
    /// [`giou`], within a box along the axes of the world.
    Giou,
    /// [`diou`], likewise.
    Diou,
    /// [`ciou`], likewise.
    Ciou,
    /// [`eiou`], likewise.
    Eiou,
    /// [`separation_aware`].
    Separation,
}

/// A score of boxes whose IoU is known: with slopes by that and by all else.
#[inline(always)]
pub(crate) fn score_with_iou<S: Scalar>(score: Score, iou: S, a: Obb3<S>, b: Obb3<S>) -> S {
    if score == Score::Separation {
        return separation::or_overlap(a, b, || iou);
    }
    let t = terms_with(iou, a, b, Enclosing::Aabb);
    match score {
        Score::Giou => giou_of(&t),
        Score::Diou => diou_of(&t),
        Score::Ciou => ciou_of(&t),
        Score::Eiou | Score::Separation => eiou_of(&t),
    }
}

/// `xᵅ` of an overlap x in `[0, 1]`, for `α > 0`; zero with slope zero at zero. Of IoU it is the α-IoU.
#[must_use]
#[inline]
pub fn alpha_iou<S: Scalar>(overlap: S, alpha: S) -> S {
    let none = overlap.at_most(S::zero());
    let power = (S::select(none, S::one(), overlap).ln() * alpha).exp();
    S::select(none, S::zero(), power).canonical()
}
