//! Bodies that move, and the bounds of their gaps over some time.
use super::motion3::Motion3;
use crate::distance3::decided::Decided;
use crate::distance3::farthest_distance;
use crate::distance3::half_space::Bounded;
use crate::distance3::relation::Relation;
use crate::scalar::most_of;
use crate::shape::{
    Capsule3, Cone, Cylinder, Disc, Ellipsoid, Hull3, Obb3, Pose3, RoundBox3, Segment3, Sphere,
    Tetrahedron, Triangle3,
};
use crate::{Pack, Scalar, Vec3};

/// A convex shape of space that a pose moves.
pub(crate) trait Body3: Bounded {
    /// Returns the shape moved.
    fn moved(self, pose: Pose3<Self::Scalar>) -> Self;
    /// Returns how far its farthest point is from the origin.
    fn reach(self) -> Self::Scalar
    where
        Self::Scalar: Scalar<Mask = bool>;
}

macro_rules! bodies {
    ($($Shape:ident $(<$N:ident>)?)*) => { $(
        impl<S: Scalar $(, const $N: usize)?> Body3 for $Shape<S $(, $N)?> {
            #[inline]
            fn moved(self, pose: Pose3<S>) -> Self {
                pose * self
            }
            #[inline]
            fn reach(self) -> S
            where
                S: Scalar<Mask = bool>,
            {
                farthest_distance(self, Vec3::zero())
            }
        }
    )* };
}
bodies! {
    Vec3 Segment3 Triangle3 Tetrahedron Obb3 RoundBox3 Sphere Capsule3 Hull3<N> Cylinder Cone Ellipsoid Disc
}

/// Two bodies, each relative to the centre of its turn, and their motions.
#[derive(Clone, Copy)]
pub(crate) struct MovingPair<S, A, B> {
    /// The first body and its motion.
    a: (A, Motion3<S>),
    /// The second body and its motion.
    b: (B, Motion3<S>),
}

impl<S: Scalar, A: Body3<Scalar = S>, B: Body3<Scalar = S>> MovingPair<S, A, B> {
    /// Creates a pair from bodies at time 0.
    pub(crate) fn new((a, of_a): (A, Motion3<S>), (b, of_b): (B, Motion3<S>)) -> Self {
        MovingPair {
            a: (a.moved(of_a.before_center()), of_a),
            b: (b.moved(of_b.before_center()), of_b),
        }
    }
    /// Returns the pair without derivatives.
    pub(super) fn plain<PlainA, PlainB>(&self) -> MovingPair<S::Primal, PlainA, PlainB>
    where
        A: Pack<With<S::Primal> = PlainA>,
        B: Pack<With<S::Primal> = PlainB>,
    {
        MovingPair {
            a: (plain(&self.a.0), plain(&self.a.1)),
            b: (plain(&self.b.0), plain(&self.b.1)),
        }
    }
    /// Returns the bodies at a time.
    pub(super) fn at(&self, t: S) -> (A, B) {
        let ((a, of_a), (b, of_b)) = (self.a, self.b);
        (a.moved(of_a.after_center(t)), b.moved(of_b.after_center(t)))
    }
    /// Returns the decisions about the bodies at a time, and their hints.
    pub(super) fn decided(&self, t: S) -> (A::Decisions, A::Hints)
    where
        S: Scalar<Mask = bool>,
        A: Decided<B>,
    {
        let (a, b) = self.at(t);
        a.decided(&b)
    }
    /// Returns the relation of the bodies at a time from decisions and hints.
    pub(super) fn replayed(
        &self,
        t: S,
        (decisions, hints): &(A::Decisions, A::Hints),
    ) -> Relation<S>
    where
        A: Decided<B>,
    {
        let (a, b) = self.at(t);
        a.replayed(&b, decisions, hints)
    }
    /// Returns the relation of the bodies at a time.
    pub(super) fn relation(&self, t: S) -> Relation<S>
    where
        S: Scalar<Mask = bool>,
        A: Decided<B>,
    {
        self.replayed(t, &self.decided(t))
    }
    /// Returns the gap of the bodies along a direction of length one, at a time.
    pub(super) fn gap(&self, t: S, normal: Vec3<S>) -> S {
        let (a, b) = self.at(t);
        b.lowest(normal).0 + a.lowest(-normal).0
    }
    /// Returns the change of the gap with time, given its direction and the nearest points.
    pub(super) fn rate(&self, t: S, relation: &Relation<S>) -> S {
        let of_a = self.a.1.velocity_at(t, relation.on_a);
        let of_b = self.b.1.velocity_at(t, relation.on_b);
        relation.normal.dot(of_b - of_a)
    }
    /// Returns the bounds of a gap's first and second derivatives by time.
    pub(super) fn bounds(&self) -> Bounds<S>
    where
        S: Scalar<Mask = bool>,
    {
        let [ra, rb] = [self.a.0.reach(), self.b.0.reach()];
        let [wa, wb] = [self.a.1.turn.length(), self.b.1.turn.length()];
        let relative = (self.b.1.velocity - self.a.1.velocity).length();
        let far = |center: Vec3<S>, velocity: Vec3<S>, reach: S| {
            largest_of(center).most(largest_of(center + velocity)) + reach
        };
        let (a, b) = (self.a.1, self.b.1);
        Bounds {
            speed: relative + (wa * ra + wb * rb),
            bend: wa * wa * ra + wb * wb * rb,
            size: far(a.center, a.velocity, ra).most(far(b.center, b.velocity, rb)),
        }
    }
}

/// Returns the largest magnitude of a coordinate.
fn largest_of<S: Scalar>(v: Vec3<S>) -> S {
    most_of([v.x.unsigned(), v.y.unsigned(), v.z.unsigned()])
}

/// Returns a shape without derivatives.
fn plain<S: Scalar, P: Pack<Scalar = S>>(shape: &P) -> P::With<S::Primal> {
    shape.remake(&mut |x| x.primal())
}

/// The bounds of a pair along its motions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds<S> {
    /// The largest change of a gap per unit of time.
    pub(super) speed: S,
    /// The largest second derivative of the gap of one point of each body by time.
    pub(super) bend: S,
    /// The largest magnitude of a coordinate.
    pub(super) size: S,
}

impl<S: Scalar> Bounds<S> {
    /// Returns the least gap over some time, given those at both ends.
    pub(super) fn least(&self, start: S, end: S, time: S) -> S {
        start.least(end) - self.bend * time * time * S::lit(0.125)
    }
    /// Returns the distance that is mostly rounding.
    pub(super) fn rounding(&self) -> S {
        self.size * S::rounding(8.0, 1)
    }
}
