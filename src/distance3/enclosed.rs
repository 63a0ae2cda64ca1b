//! Distances of lines and rays from hulls and curved shapes: by the part of the line that is near a ball around them.
use super::apart::Apart;
use super::curved::{BySupport, SupportFunction};
use super::hulls::Cornered;
use super::relation::Relation;
use super::straight::{Straight, StraightKind};
use crate::scalar::{Guard, most_of};
use crate::shape::{Cone, Cylinder, Disc, Ellipsoid, Line3, Ray3, Segment3};
use crate::{Hull3, Pack, Scalar, Vec3};

/// A shape of space that ends.
trait Enclosed<S: Scalar>: Copy + Pack<Scalar = S> {
    /// Returns the centre of a ball around it, and the radius.
    fn ball(&self) -> (Vec3<S>, S);
    /// Returns the shape relative to the centre of the ball, and that centre, a constant; by default the shape itself.
    fn centered(self) -> (Self, Vec3<S>) {
        (self, Vec3::zero())
    }
    /// Returns a guard with the numbers that matter.
    fn with_guard(&self, guard: Guard<S>) -> Guard<S> {
        guard.and(self)
    }
}

impl<S: Scalar> Enclosed<S> for Ellipsoid<S> {
    fn ball(&self) -> (Vec3<S>, S) {
        let Vec3 { x, y, z } = self.semi_axes;
        (self.center, most_of([x, y, z]))
    }
    fn centered(mut self) -> (Self, Vec3<S>) {
        let from = self.ball().0.constant();
        self.center -= from;
        (self, from)
    }
}

impl<S: Scalar> Enclosed<S> for Disc<S> {
    fn ball(&self) -> (Vec3<S>, S) {
        (self.center, self.radius)
    }
    fn centered(mut self) -> (Self, Vec3<S>) {
        let from = self.ball().0.constant();
        self.center -= from;
        (self, from)
    }
}

impl<S: Scalar> Enclosed<S> for Cylinder<S> {
    fn ball(&self) -> (Vec3<S>, S) {
        let half = (self.end - self.start) * S::lit(0.5);
        (self.start + half, half.length() + self.radius)
    }
    fn centered(mut self) -> (Self, Vec3<S>) {
        let from = self.ball().0.constant();
        self.start -= from;
        self.end -= from;
        (self, from)
    }
}

impl<S: Scalar> Enclosed<S> for Cone<S> {
    fn ball(&self) -> (Vec3<S>, S) {
        let half = (self.base - self.apex) * S::lit(0.5);
        (self.apex + half, half.length() + self.radius)
    }
    fn centered(mut self) -> (Self, Vec3<S>) {
        let from = self.ball().0.constant();
        self.apex -= from;
        self.base -= from;
        (self, from)
    }
}

impl<S: Scalar, const N: usize> Enclosed<S> for Hull3<S, N> {
    fn ball(&self) -> (Vec3<S>, S) {
        let center = self.vertices[0];
        let lengths = self.as_slice().iter().map(|&p| (p - center).length());
        (center, lengths.fold(S::zero(), S::most))
    }
    fn centered(mut self) -> (Self, Vec3<S>) {
        let from = self.vertices[0].constant();
        for vertex in self.vertices.iter_mut().take(self.count) {
            *vertex -= from;
        }
        (self, from)
    }
    fn with_guard(&self, guard: Guard<S>) -> Guard<S> {
        Cornered::with_guard(self, guard)
    }
}

impl<S: Scalar, A: SupportFunction<Scalar = S>> Enclosed<S> for BySupport<A> {
    /// Returns the ball around the axis-aligned box.
    fn ball(&self) -> (Vec3<S>, S) {
        let (zero, one) = (S::zero(), S::one());
        let [x, y, z] = [(one, zero, zero), (zero, one, zero), (zero, zero, one)].map(|axis| {
            let axis = Vec3::new(axis.0, axis.1, axis.2);
            let [low, high] = [-axis, axis].map(|way| axis.dot(self.0.support(way)));
            ((low + high).halved(), (high - low).halved())
        });
        let half = Vec3::new(x.1, y.1, z.1);
        (Vec3::new(x.0, y.0, z.0), half.length())
    }
}

/// The half of the part of a line that matters, in radii of a ball around the other shape.
///
/// The nearest point is no farther than a radius from the foot of the centre. A shift that parts them is no longer than
/// a radius, if it is across the line; past an end it would be longer than the end is beyond the ball.
const HALF: f64 = 2.5;

/// Returns the part of a line or ray that a shape in a ball can be near to. It is as long as it is far, so that its
/// direction has all digits.
fn part<S: Scalar<Mask = bool>>(line: Straight<S>, center: Vec3<S>, radius: S) -> Segment3<S> {
    let near = |line: Straight<S>, reach: S| {
        let [start, end] = line.near(center, reach);
        Segment3::new(start, end)
    };
    let own = radius * S::lit(HALF);
    let first = near(line, own);
    let reach = own.most((first.start - center).length());
    let starts = first.start.x.equals(line.from.x)
        && first.start.y.equals(line.from.y)
        && first.start.z.equals(line.from.z);
    match line.reach == StraightKind::Ray && starts {
        true => near(line, reach),
        // From a point near the shape on: products with a large parameter have few digits.
        false => near(
            Straight {
                from: (first.start + first.end) * S::lit(0.5),
                reach: StraightKind::Line,
                ..line
            },
            reach,
        ),
    }
}

/// Returns the relation of a line or ray and a shape.
fn relate<S, B>(line: Straight<S>, shape: B) -> Relation<S>
where
    S: Scalar<Mask = bool>,
    B: Enclosed<S>,
    Segment3<S>: Apart<B, Scalar = S>,
{
    // Far from the origin the ends of a part of the line would lose digits.
    let (shape, from) = shape.centered();
    let (center, radius) = shape.ball();
    let line = Straight {
        from: line.from - from,
        ..line
    };
    let found = part(line, center, radius).relation(shape);
    Relation {
        on_a: from + found.on_a,
        on_b: from + found.on_b,
        ..found
    }
}

macro_rules! endless {
    ($Line:ident: $([$($generic:tt)*] $B:ty;)*) => { $(
        impl<S: Scalar<Mask = bool>, $($generic)*> Apart<$B> for $Line<S> {
            type Scalar = S;
            fn guarded_with(&self, other: &$B) -> Guard<S> {
                Enclosed::with_guard(other, Guard::of(self))
            }
            fn relation(self, other: $B) -> Relation<S> {
                relate(self.feature(), other)
            }
        }
        impl<S: Scalar<Mask = bool>, $($generic)*> Apart<$Line<S>> for $B {
            type Scalar = S;
            fn guarded_with(&self, other: &$Line<S>) -> Guard<S> {
                Enclosed::with_guard(self, Guard::of(other))
            }
            fn relation(self, other: $Line<S>) -> Relation<S> {
                relate(other.feature(), self).flipped()
            }
        }
    )* };
}
macro_rules! each {
    ($($Line:ident)*) => { $(
        endless! {
            $Line:
            [] Ellipsoid<S>;
            [] Disc<S>;
            [] Cylinder<S>;
            [] Cone<S>;
            [const N: usize] Hull3<S, N>;
            [O: SupportFunction<Scalar = S, With<f64>: SupportFunction<Scalar = f64>>] BySupport<O>;
        }
    )* };
}
each!(Line3 Ray3);
