//! The family of IoU losses in space, and an overlap that has derivatives for boxes apart.
//!
//! The papers define them in the plane; here areas are volumes and the proportions are those of all three
//! pairs of sizes. With `I` the volume of intersection, `U` that of the union, `C` that of the enclosing
//! shape, `d` the distance of the centres, `D` the diameter of the enclosing shape, and `Δsᵢ` the
//! differences of the boxes' own sizes:
//!
//! | function | is | paper |
//! | --- | --- | --- |
//! | [`giou`] | `I/U − (C − U)/C` | Rezatofighi et al., *Generalized intersection over union*, CVPR 2019 |
//! | [`diou`] | `I/U − (d/D)²` | Zheng et al., *Distance-IoU loss*, AAAI 2020 |
//! | [`ciou`] | `diou − αv`, v the mean over the pairs (x, y), (y, z), (z, x) of `4/π² (Δ atan p/q)²` | the same |
//! | [`ciou_fixed_weight`] | the same, without the derivative of `α` | the same |
//! | [`eiou`] | `diou − Σ (Δsᵢ/Sᵢ)²`, `Sᵢ` by the enclosing shape | Zhang et al., *Focal and efficient IoU loss*, 2021 |
//! | [`alpha_iou`] | a power of IoU | He et al., *Alpha-IoU*, NeurIPS 2021 |
//! | [`separation_aware`] | IoU, or for boxes apart minus their separation over itself and their size | here |
//!
//! Every kind of box works ([`Solid`]); [`Enclosing`] chooses the shape around a pair. Operations of a plain name put
//! around axis-aligned boxes the published shape, the box around both, and around boxes that turn one that turns with
//! them, so that their scores are invariant under the rotations that the boxes have. Suffixes name every other
//! enclosing shape. `ciou` and `eiou` build on the `diou` of the same row.
//!
//! | boxes | enclosing shape | volume, diameter, lengths for sizes | operations |
//! | --- | --- | --- | --- |
//! | `Aabb3` | [`Aabb`](Enclosing::Aabb) | those of the box around both | `giou_aabb3`, `diou_aabb3`, `ciou_aabb3`, `eiou_aabb3` |
//! | `YawBox3` | [`Hull`](Enclosing::Hull) | hull of the grounds times joint height H; `D² = g² + H²` with the hull's diameter g; `g, g, H` | `giou_yaw`, `diou_yaw`, `ciou_yaw`, `eiou_yaw` |
//! | `YawBox3` | [`Rectangle`](Enclosing::Rectangle) | rectangle of least area around the grounds times H; the same with its diagonal g | `giou_rectangle_yaw`, `diou_rectangle_yaw`, `ciou_rectangle_yaw`, `eiou_rectangle_yaw` |
//! | `YawBox3` | [`Aabb`](Enclosing::Aabb) | those of the box along the world's axes; a size that is longer counts instead of the side | `giou_aabb_yaw`, `diou_aabb_yaw`, `ciou_aabb_yaw`, `eiou_aabb_yaw` |
//! | `Obb3` | [`Rectangle`](Enclosing::Rectangle) | those of the smaller box along the axes of either; a size that is longer counts instead of the side | `giou_obb3`, `diou_obb3`, `ciou_obb3`, `eiou_obb3` |
//! | `Obb3` | [`Aabb`](Enclosing::Aabb) | those of the box along the world's axes; a size that is longer counts instead of the side | `giou_aabb_obb3`, `diou_aabb_obb3`, `ciou_aabb_obb3`, `eiou_aabb_obb3` |
//!
//! | `giou` | `diou` | `ciou` | `eiou` |
//! | --- | --- | --- | --- |
//! | `[−1, 1]` | `[−1, 1]` | `[−3/2, 1]` | `[−13/4, 1]` by the box around `Aabb3`, `[−7/2, 1]` by a ground's diameter, else `[−4, 1]` |
//!
//! Losses are one minus these. Identical boxes of positive volume have exactly 1 with derivative zero (except for
//! `giou` by the world's axes of turned boxes). GIoU is −1 only where rounding makes it so, DIoU also for two points. A
//! term with a denominator of zero is zero with derivative zero. An enclosing shape that is so thin that its volume (of
//! [`Obb3`]) or its ground's area underflows counts as empty: it has no GIoU term.
//!
//! Values and derivatives are finite where every length and coordinate is zero or of a magnitude from 2⁻²⁰ to 2²⁰ in
//! `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
//!
//! Kinks are those of IoU and of the enclosing shape; of boxes of any orientation DIoU, CIoU and EIoU jump where
//! another enclosing box becomes the smaller one. Exact ties share the derivative: at one kink it lies between the
//! slopes of both sides. Several kinks can meet, as for boxes along the same axes with faces in one plane. Each then
//! shares by itself, and the sum may lie outside the slopes of both sides. If rectangles of least area tie, DIoU, CIoU
//! and EIoU take the mean diagonal and mean sides, which may belong to none of them.
use crate::iou::weighted;
use crate::shape::Obb3;
use crate::{Scalar, Vec3};

mod around;
mod enclosing;
mod ground;
mod scored;
mod separation;
mod terms;

pub use enclosing::Enclosing;
pub use ground::smallest_rectangle;
pub use scored::Solid;
pub use separation::{penetration_or_gap, separation_aware};
pub use terms::Terms;

/// Returns the generalised IoU of two boxes, in `[−1, 1]`: IoU less the share of the enclosing shape that neither
/// covers.
///
/// ```
/// use geograd::{Aabb3, Vec3, iou3::{Enclosing, giou}};
/// let a = Aabb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 1.0));
/// let b = Aabb3::new(Vec3::new(3.0, 0.0, 0.0), Vec3::new(4.0, 1.0, 1.0));
/// assert_eq!(giou(a, a, Enclosing::Aabb), 1.0);
/// assert_eq!(giou(a, b, Enclosing::Aabb), -0.5);
/// ```
#[must_use]
#[inline]
pub fn giou<S: Scalar, B: Solid<S>>(a: B, b: B, kind: Enclosing) -> S {
    score_of(Score::Giou, a.overlap(b), a, b, kind).canonical()
}

/// Returns the distance IoU of two boxes, in `[−1, 1]`: IoU less the square of the centres' distance over the diameter
/// of the enclosing shape. Two points have −1.
///
/// ```
/// use geograd::{Vec3, YawBox3, iou3::{Enclosing, diou}};
/// let a = YawBox3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(2.0, 2.0, 2.0), 0.0);
/// let b = YawBox3 { center: Vec3::new(4.0, 0.0, 0.0), ..a };
/// // The ground's hull is six long and two wide, both are two high.
/// assert!((diou(a, b, Enclosing::Hull) + 16.0_f64 / 44.0).abs() < 1e-15);
/// ```
#[must_use]
#[inline]
pub fn diou<S: Scalar, B: Solid<S>>(a: B, b: B, kind: Enclosing) -> S {
    score_of(Score::Diou, a.overlap(b), a, b, kind).canonical()
}

/// Returns the mean over the pairs (x, y), (y, z), (z, x) of `4/π² (atan(p/q) − atan(p'/q'))²`.
#[inline(always)]
fn proportions<S: Scalar>(u: Vec3<S>, v: Vec3<S>) -> S {
    let turn = |p: S, q: S| {
        let none = (p.at_most(S::zero())) & (q.at_most(S::zero()));
        S::select(none, S::one(), p).atan2(S::select(none, S::one(), q))
    };
    let differ = |p: S, q: S, r: S, s: S| (turn(p, q) - turn(r, s)).squared();
    let sum =
        differ(u.x, u.y, v.x, v.y) + (differ(u.y, u.z, v.y, v.z) + differ(u.z, u.x, v.z, v.x));
    sum * S::lit(4.0 / 3.0 / (std::f64::consts::PI * std::f64::consts::PI))
}

/// Returns the complete IoU of two boxes, in `[−3/2, 1]`: [`diou`] less `α v`, where v is the mean over the pairs (x,
/// y), (y, z), (z, x) of `4/π² (atan(p/q) − atan(p'/q'))²` and `α = v / (1 − IoU + v)`. It has all derivatives, those
/// of α too. The ratio of two zero sizes is that of a square.
#[must_use]
#[inline]
pub fn ciou<S: Scalar, B: Solid<S>>(a: B, b: B, kind: Enclosing) -> S {
    score_of(Score::Ciou, a.overlap(b), a, b, kind).canonical()
}

/// Returns the complete IoU, in `[−3/2, 1]`, whose weight α counts as constant: no derivative goes through it, as its
/// authors train. The value is that of [`ciou`]; the derivatives are those of no function.
#[must_use]
#[inline]
pub fn ciou_fixed_weight<S: Scalar, B: Solid<S>>(a: B, b: B, kind: Enclosing) -> S {
    let iou = a.overlap(b);
    let terms = a.terms(b, iou, kind);
    let v = proportions(a.own_size(), b.own_size());
    (iou - terms.way - weighted(v, iou, true)).canonical()
}

/// Returns the efficient IoU of two boxes, in `[−4, 1]`: [`diou`] less the squared differences of the sizes along the
/// boxes' own axes over the squares of lengths of the enclosing shape. For a box these are its sides, or the size
/// itself where a box is turned so that this is longer. For a hull or rectangle times a height they are the diameter of
/// the ground for x and y, the height for z.
///
/// ```
/// use geograd::{Vec3, YawBox3, iou3::{Enclosing, eiou}};
/// let a = YawBox3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(4.0, 3.0, 2.0), 0.0);
/// let b = YawBox3 { size: Vec3::new(2.0, 3.0, 1.0), ..a };
/// // A quarter of the volume; the ground's diagonal is 5, the height 2.
/// assert!((eiou(a, b, Enclosing::Hull) - (0.25 - 4.0 / 25.0 - 0.25_f64)).abs() < 1e-15);
/// ```
#[must_use]
#[inline]
pub fn eiou<S: Scalar, B: Solid<S>>(a: B, b: B, kind: Enclosing) -> S {
    score_of(Score::Eiou, a.overlap(b), a, b, kind).canonical()
}

/// A score computed from the boxes' IoU and a formula of their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Score {
    /// [`giou`].
    Giou,
    /// [`diou`].
    Diou,
    /// [`ciou`].
    Ciou,
    /// [`eiou`].
    Eiou,
    /// [`separation_aware`].
    Separation,
}

/// Returns a score of boxes whose IoU is known.
#[inline(always)]
fn score_of<S: Scalar, B: Solid<S>>(score: Score, iou: S, a: B, b: B, kind: Enclosing) -> S {
    let terms = a.terms(b, iou, kind);
    match score {
        Score::Giou => iou - terms.outside,
        Score::Diou => iou - terms.way,
        Score::Ciou => {
            let v = proportions(a.own_size(), b.own_size());
            iou - terms.way - weighted(v, iou, false)
        }
        Score::Eiou | Score::Separation => iou - terms.way - terms.gaps,
    }
}

/// Returns a score of boxes of any orientation whose IoU is known: with derivatives by that and by all else.
#[inline(always)]
pub(crate) fn score_with_iou<S: Scalar>(
    score: Score,
    kind: Enclosing,
    iou: S,
    a: Obb3<S>,
    b: Obb3<S>,
) -> S {
    match score {
        Score::Separation => separation::or_overlap(a, b, || iou),
        _ => score_of(score, iou, a, b, kind),
    }
}

/// Returns `xᵅ` of an overlap x in `[0, 1]`, for `α > 0`; zero with derivative zero at zero. The power of an IoU is the
/// α-IoU.
#[must_use]
#[inline]
pub fn alpha_iou<S: Scalar>(overlap: S, alpha: S) -> S {
    let none = overlap.at_most(S::zero());
    let power = (S::select(none, S::one(), overlap).ln() * alpha).exp();
    S::select(none, S::zero(), power).canonical()
}
