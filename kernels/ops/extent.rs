//! Extents of convex polygons as operations.
use crate::kernels::decided::Decided;
use crate::kernels::op::{Answer, Jumps, Motion, Promise};
use crate::measure::extent::{Farthest, diameter_decided, diameter_replay};
use crate::{ConvexPolygon, Scalar};

/// The [diameter](crate::measure::extent::diameter_decided) of a convex polygon of up to `N` vertices: the
/// largest distance of two of them, which are its record.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DiameterOfPolygon<const N: usize>;

impl<const N: usize> Decided for DiameterOfPolygon<N> {
    const NAME: &'static str = "diameter_of_polygon";
    type In<S: Scalar> = ConvexPolygon<S, N>;
    type Out<S: Scalar> = S;
    type Record = Farthest;
    const PROMISES: &'static [Promise] = &[
        Promise::new(Motion::TranslationX, Answer::Stays),
        Promise::new(Motion::TranslationY, Answer::Stays),
        Promise::new(Motion::Rotation, Answer::Stays),
        Promise::new(Motion::Scaling, Answer::Power(1)),
    ];
    const JUMPS: Jumps = Jumps::Never;
    fn decide<S: Scalar<Mask = bool>>(polygon: ConvexPolygon<S, N>) -> Farthest {
        // A polygon without vertices is as wide as its first place, which is at the origin.
        let nothing = Farthest { from: 0, to: 0 };
        diameter_decided(polygon.as_slice()).map_or(nothing, |found| found.1)
    }
    fn replay<S: Scalar>(polygon: ConvexPolygon<S, N>, record: Farthest) -> S {
        diameter_replay(&polygon.vertices, record)
    }
}

crate::__runs_decided!([const N: usize] DiameterOfPolygon<N>: crate::ConvexPolygon<T, N> => T);
