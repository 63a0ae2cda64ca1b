//! The least and the greatest of many, with all that they carry; exact ties share equally.
use crate::{Scalar, Vec2};

/// Values that can be added up and divided: a [`Best`] carries one.
#[doc(hidden)]
pub trait Carry<S: Scalar>: Copy {
    /// Returns the sum where `tie`, else `self` where `keep`, else `other`.
    fn join(self, other: Self, keep: S::Mask, tie: S::Mask) -> Self;
    /// Multiplies all numbers by a factor.
    fn times(self, factor: S) -> Self;
}

impl<S: Scalar> Carry<S> for S {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn join(self, other: S, keep: S::Mask, tie: S::Mask) -> S {
        S::select(tie, self + other, S::select(keep, self, other))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn times(self, factor: S) -> S {
        self * factor
    }
}

impl<S: Scalar> Carry<S> for Vec2<S> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn join(self, other: Self, keep: S::Mask, tie: S::Mask) -> Self {
        join(self, other, keep, tie)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn times(self, factor: S) -> Self {
        self * factor
    }
}

impl<S: Scalar, A: Carry<S>, B: Carry<S>> Carry<S> for (A, B) {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn join(self, other: Self, keep: S::Mask, tie: S::Mask) -> Self {
        let ((a, b), (c, d)) = (self, other);
        (a.join(c, keep, tie), b.join(d, keep, tie))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn times(self, factor: S) -> Self {
        (self.0.times(factor), self.1.times(factor))
    }
}

/// A value by which candidates are compared, the sum of the data of the best ones, and their number.
#[derive(Clone, Copy, Debug)]
pub struct Best<S, C> {
    /// The value that is compared.
    pub value: S,
    /// The sum of the data of the best ones.
    pub sum: C,
    /// The number of best ones.
    pub count: S,
}

impl<S: Scalar, C: Carry<S>> Best<S, C> {
    /// Creates the best of one candidate.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn of(value: S, carried: C) -> Self {
        Best {
            value,
            sum: carried,
            count: S::one(),
        }
    }
    /// Returns the smaller of two; all of both where they are equal.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn less(self, other: Self) -> Self {
        let keep = self.value.below(other.value);
        self.join(other, keep)
    }
    /// Returns the larger of two; all of both where they are equal.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn most(self, other: Self) -> Self {
        let keep = other.value.below(self.value);
        self.join(other, keep)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn join(self, other: Self, keep: S::Mask) -> Self {
        let tie = self.value.equals(other.value);
        Best {
            value: S::select(keep, self.value, other.value),
            sum: self.sum.join(other.sum, keep, tie),
            count: self.count.join(other.count, keep, tie),
        }
    }
    /// Returns the smallest of at least one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn least(candidates: impl Iterator<Item = Self>) -> Self {
        candidates
            .reduce(Self::less)
            .expect("a core has at least one corner")
    }
    /// Returns the largest of at least one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn most_of(candidates: impl Iterator<Item = Self>) -> Self {
        candidates
            .reduce(Self::most)
            .expect("a core has at least one face")
    }
    /// Returns the mean of the values that the best ones carry.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn mean(self) -> C {
        self.sum.times(S::one().over(self.count))
    }
}

/// Two points, one of each core, that are nearest to each other.
#[derive(Clone, Copy, Debug)]
pub struct Nearest<S> {
    /// The vector from the point on a to the point on b.
    pub apart: Vec2<S>,
    /// The one on a.
    pub on_a: Vec2<S>,
    /// The one on b.
    pub on_b: Vec2<S>,
}

/// The number of roundings of the unit by which heights over collinear faces may differ, if all sizes are at most four.
const ROUNDED: f64 = 16.0;

/// The distance in front of a face at which some points begin.
#[derive(Clone, Copy, Debug)]
pub struct Ahead<S> {
    /// The distance from the face's line; negative behind it.
    pub ahead: S,
    /// The first of the points.
    pub on_b: Vec2<S>,
}

/// A face and the points of the other core that are farthest behind it.
///
/// Faces that tie share the derivative of the distance. Normal and points are those of the first face whose ends
/// enclose the points, since the mean of two normals is no normal. Faces that tie within rounding have their points on
/// them, too, if one does: collinear edges of a polygon.
#[derive(Clone, Copy, Debug)]
pub struct Deepest<S> {
    /// The distance in front of the face; negative behind it.
    pub ahead: S,
    /// The face's normal, of length one, from a to b.
    pub normal: Vec2<S>,
    /// The point of a: of its face, or the one farthest behind b's face.
    pub on_a: Vec2<S>,
    /// The point of b: of its face, or the one farthest behind a's face.
    pub on_b: Vec2<S>,
    /// The distance in front of the face of the points that were taken.
    pub level: S,
    /// The distance of the points beyond the end of the face.
    pub beyond: S,
    /// The middle of the face, as a constant.
    pub middle: Vec2<S>,
    /// Half the face's length, as a constant.
    pub half: S,
    /// The normal of the first face that ties, wherever the points are.
    pub lead: Vec2<S>,
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn join<S: Scalar>(a: Vec2<S>, b: Vec2<S>, keep: S::Mask, tie: S::Mask) -> Vec2<S> {
    Vec2::new(a.x.join(b.x, keep, tie), a.y.join(b.y, keep, tie))
}

impl<S: Scalar> Carry<S> for Nearest<S> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn join(self, other: Self, keep: S::Mask, tie: S::Mask) -> Self {
        Nearest {
            apart: join(self.apart, other.apart, keep, tie),
            on_a: join(self.on_a, other.on_a, keep, tie),
            on_b: join(self.on_b, other.on_b, keep, tie),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn times(self, factor: S) -> Self {
        Nearest {
            apart: self.apart * factor,
            on_a: self.on_a * factor,
            on_b: self.on_b * factor,
        }
    }
}

impl<S: Scalar> Carry<S> for Ahead<S> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn join(self, other: Self, keep: S::Mask, tie: S::Mask) -> Self {
        Ahead {
            ahead: self.ahead.join(other.ahead, keep, tie),
            on_b: join(self.on_b, other.on_b, keep, tie),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn times(self, factor: S) -> Self {
        Ahead {
            ahead: self.ahead * factor,
            on_b: self.on_b * factor,
        }
    }
}

impl<S: Scalar> Carry<S> for Deepest<S> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn join(self, other: Self, keep: S::Mask, tie: S::Mask) -> Self {
        let slack = S::rounding(ROUNDED, 1);
        let near = (self.level - other.level).unsigned().at_most(slack);
        let (on_face, other_on) = (self.beyond.at_most(slack), other.beyond.at_most(slack));
        let first = keep | tie & self.beyond.at_most(other.beyond);
        let first = near & on_face & !other_on | first & !(near & !on_face & other_on);
        Deepest {
            ahead: self.ahead.join(other.ahead, keep, tie),
            level: S::select(first, self.level, other.level),
            normal: Vec2::select(first, self.normal, other.normal),
            on_a: Vec2::select(first, self.on_a, other.on_a),
            on_b: Vec2::select(first, self.on_b, other.on_b),
            beyond: S::select(first, self.beyond, other.beyond),
            middle: Vec2::select(first, self.middle, other.middle),
            half: S::select(first, self.half, other.half),
            lead: Vec2::select(keep | tie, self.lead, other.lead),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn times(self, factor: S) -> Self {
        Deepest {
            ahead: self.ahead * factor,
            ..self
        }
    }
}

impl<S: Scalar> Best<S, Nearest<S>> {
    /// Exchanges a and b.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn flipped(mut self) -> Self {
        let Nearest { apart, on_a, on_b } = self.sum;
        self.sum = Nearest {
            apart: -apart,
            on_a: on_b,
            on_b: on_a,
        };
        self
    }
}

impl<S: Scalar> Best<S, Deepest<S>> {
    /// Exchanges a and b.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn flipped(mut self) -> Self {
        self.sum = Deepest {
            ahead: self.sum.ahead,
            normal: -self.sum.normal,
            lead: -self.sum.lead,
            on_a: self.sum.on_b,
            on_b: self.sum.on_a,
            ..self.sum
        };
        self
    }
    /// Returns the larger of two that are faces of different shapes, like [`most`](Best::most) unless both are parallel
    /// and separate the shapes equally.
    ///
    /// With b turned by t from there its own face separates them by `−offset t + (p − h) |t|` more than that of a,
    /// where p and h are half the lengths of the faces of b and a, and offset is the distance of their middles. So for
    /// both signs of t the longer face separates them if the second term is larger; else one of them for each sign, and
    /// the derivative is the mean.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn most_of_faces(self, other: Self) -> Self {
        let zero = S::zero();
        let (a, b) = (self.sum, other.sum);
        let turn = a.normal.perp_dot(b.normal);
        let same = turn.equals(zero) & a.normal.dot(b.normal).above(zero);
        let parallel = self.value.equals(other.value) & same;
        let along = Vec2::new(a.normal.y, -a.normal.x);
        let offset = S::from_primal(along.dot(b.middle - a.middle).primal());
        let more = b.half - a.half;
        let decided = parallel & offset.unsigned().below(more.unsigned());
        let (first, second) = (decided & more.below(zero), decided & more.above(zero));
        let lean = turn * (-more).signed_as(offset).halved();
        let mut both = self.most(other);
        let ahead = both.sum.ahead + S::select(parallel, lean * both.count, zero);
        let choose = |a: S, b: S, both: S| S::select(first, a, S::select(second, b, both));
        both.sum.ahead = choose(a.ahead, b.ahead, ahead);
        both.count = choose(self.count, other.count, both.count);
        both
    }
}
