//! Own convex shapes by their support functions.
use super::super::mix::Mix;
use super::curved_replay::Pieces;
use super::piece::{Piece, PieceKind, Place};
use super::support::Supported;
use super::{Curved, Placed, farthest, relate};
use crate::distance3::apart::Apart;
use crate::distance3::cored::InflatedCore;
use crate::distance3::half_space::Bounded;
use crate::distance3::relation::Relation;
use crate::scalar::{Guard, largest};
use crate::shape::{Cone, Cylinder, Disc, Ellipsoid};
use crate::{Pack, Scalar, Vec3};

/// A convex shape of space by its support function.
///
/// [`BySupport`] gives it distances from all shapes of [this module](super). The point should move smoothly with the
/// direction: then second derivatives are right, too.
///
/// ```
/// use geograd::distance3::{BySupport, SupportFunction, signed_distance};
/// use geograd::{Aabb3, Scalar, Shape, Vec3};
/// /// A ball.
/// #[derive(Clone, Copy, Debug, PartialEq, Shape)]
/// struct Planet<S> {
///     middle: Vec3<S>,
///     radius: S,
/// }
/// impl<S: Scalar> SupportFunction for Planet<S> {
///     fn support(&self, direction: Vec3<S>) -> Vec3<S> {
///         self.middle + direction.normalize_or_zero() * self.radius
///     }
/// }
/// let planet = Planet { middle: Vec3::new(0.0, 0.0, 5.0), radius: 1.0 };
/// let ground = Aabb3::new(Vec3::new(-9.0, -9.0, -1.0), Vec3::new(9.0, 9.0, 0.0));
/// assert!((signed_distance(BySupport(planet), ground) - 4.0_f64).abs() < 1e-12);
/// ```
pub trait SupportFunction: Copy + Pack<Scalar: Scalar> {
    /// Returns the point of the shape that is farthest in a direction of any length but zero.
    fn support(&self, direction: Vec3<Self::Scalar>) -> Vec3<Self::Scalar>;
}

/// An own shape with the verbs of distances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BySupport<A>(pub A);

impl<A: Pack> Pack for BySupport<A> {
    type Scalar = A::Scalar;
    type With<T: Clone> = BySupport<A::With<T>>;
    const LISTS: bool = A::LISTS;
    fn remake<T: Clone>(&self, f: &mut impl FnMut(&A::Scalar) -> T) -> BySupport<A::With<T>> {
        BySupport(self.0.remake(f))
    }
    fn each(&mut self, f: &mut impl FnMut(&mut A::Scalar)) {
        self.0.each(f);
    }
}

/// An own shape in the units of a search.
#[derive(Clone, Copy, Debug)]
pub struct InUnits<A, S> {
    shape: A,
    from: Vec3<S>,
    scale: S,
}

/// The step of a direction for the derivative of the support: its error is about the square, rounding's its inverse.
const STEP: f64 = 1e-5;

impl<S: Scalar, A: SupportFunction<Scalar = S>> InUnits<A, S> {
    fn at(&self, way: Vec3<S>) -> Vec3<S> {
        (self.shape.support(way) - self.from) * self.scale
    }
}

impl<S: Scalar, A: SupportFunction<Scalar = S>> Pieces<S> for InUnits<A, S> {
    fn piece_at(&self, _: usize, normal: Vec3<S>) -> Piece<S> {
        Piece {
            kind: PieceKind::Own,
            ..Piece::point(self.at(normal))
        }
    }
}

/// Returns the directions along the axes.
fn axes<S: Scalar>() -> [Vec3<S>; 3] {
    let (zero, one) = (S::zero(), S::one());
    [
        Vec3::new(one, zero, zero),
        Vec3::new(zero, one, zero),
        Vec3::new(zero, zero, one),
    ]
}

impl<S, A> Placed<S> for InUnits<A, S>
where
    S: Scalar,
    A: SupportFunction<Scalar = S, With<f64>: SupportFunction<Scalar = f64>>,
{
    type Plain = InUnits<A::With<f64>, f64>;
    fn reach(&self) -> S::Primal {
        axes::<S>()
            .into_iter()
            .fold(S::Primal::zero(), |most, axis| {
                let [p, q] = [self.at(axis), self.at(-axis)];
                most.most(largest([p.x, p.y, p.z, q.x, q.y, q.z]))
            })
    }
    fn plain(&self) -> Option<Self::Plain> {
        let mut finite = true;
        let mut one = |x: &S| {
            let wide = x.widened().filter(|x| x.is_finite());
            finite &= wide.is_some();
            wide.unwrap_or(0.0)
        };
        let shape = self.shape.remake(&mut one);
        let Vec3 { x, y, z } = self.from;
        let made = InUnits {
            shape,
            from: Vec3::new(one(&x), one(&y), one(&z)),
            scale: one(&self.scale),
        };
        finite.then_some(made)
    }
}

impl<A: SupportFunction<Scalar = f64>> Supported for InUnits<A, f64> {
    fn support(&self, way: Vec3<f64>) -> Vec3<f64> {
        self.at(way)
    }
    fn middle(&self) -> Vec3<f64> {
        let sum = axes().into_iter().fold(Vec3::zero(), |sum, axis| {
            sum + self.at(axis) + self.at(-axis)
        });
        sum * (1.0 / 6.0)
    }
    fn size(&self) -> f64 {
        let lengths = axes()
            .into_iter()
            .map(|axis| (self.at(axis) - self.at(-axis)).length());
        lengths.fold(0.0, f64::max)
    }
    fn pieces(&self) -> usize {
        1
    }
    fn piece(&self, k: usize, normal: Vec3<f64>) -> Piece<f64> {
        let by = |axis: Vec3<f64>| {
            (self.at(normal + axis * STEP) - self.at(normal - axis * STEP)) * (0.5 / STEP)
        };
        Piece {
            ways: axes().map(by),
            ..self.piece_at(k, normal)
        }
    }
    fn point(&self, _: usize, _: &Place<f64>, normal: Vec3<f64>) -> Vec3<f64> {
        self.at(normal)
    }
    fn likely(&self, _: &Mix, _: Vec3<f64>, _: Vec3<f64>) -> Option<(usize, Place<f64>)> {
        Some((0, Place::zero()))
    }
    fn clamped(&self, _: usize, place: &Place<f64>) -> Place<f64> {
        *place
    }
}

impl<S, A> Curved for BySupport<A>
where
    S: Scalar,
    A: SupportFunction<Scalar = S, With<f64>: SupportFunction<Scalar = f64>>,
{
    type Placed = InUnits<A, S>;
    fn anchor_point(&self) -> Vec3<S> {
        self.0.support(axes()[0])
    }
    fn in_units(&self, from: Vec3<S>, scale: S, _: S) -> InUnits<A, S> {
        InUnits {
            shape: self.0,
            from,
            scale,
        }
    }
}

impl<A: SupportFunction> Bounded for BySupport<A> {
    fn lowest(self, normal: Vec3<A::Scalar>) -> (A::Scalar, Vec3<A::Scalar>) {
        let point = self.0.support(-normal);
        (normal.dot(point), point)
    }
}

macro_rules! own {
    ($([$($generic:tt)*] $A:ty, $B:ty;)*) => { $(
        impl<S: Scalar<Mask = bool>, O: SupportFunction<Scalar = S, With<f64>: SupportFunction<Scalar = f64>>, $($generic)*> Apart<$B>
            for $A
        {
            type Scalar = S;
            fn guarded_with(&self, other: &$B) -> Guard<S> {
                Guard::of(self).and(other)
            }
            fn relation(self, other: $B) -> Relation<S> {
                relate(self, other, true)
            }
            fn relation_without_points(self, other: $B) -> Relation<S> {
                relate(self, other, false)
            }
            fn farthest(self, other: $B) -> S {
                farthest(self, other)
            }
        }
    )* };
}
own! {
    [] BySupport<O>, Ellipsoid<S>;
    [] BySupport<O>, Disc<S>;
    [] BySupport<O>, Cylinder<S>;
    [] BySupport<O>, Cone<S>;
    [] Ellipsoid<S>, BySupport<O>;
    [] Disc<S>, BySupport<O>;
    [] Cylinder<S>, BySupport<O>;
    [] Cone<S>, BySupport<O>;
    [B: InflatedCore<Scalar = S>] BySupport<O>, B;
    [A: InflatedCore<Scalar = S>] A, BySupport<O>;
    [B: SupportFunction<Scalar = S, With<f64>: SupportFunction<Scalar = f64>>] BySupport<O>, BySupport<B>;
}
