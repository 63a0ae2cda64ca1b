//! Verbs of curves as methods of the shapes: those of the piece that each is.
use super::bezier::{Cubic2, Quadratic2};
use super::circle_arc::Arc2;
use super::curve_nearest::CurvePlace;
use super::curve_piece::CurvePiece;
use crate::{Aabb2, Scalar, Vec2};

macro_rules! verbs {
    ($($shape:ident)*) => { $(
        impl<S: Scalar<Mask = bool>> $shape<S> {
            /// Returns the smallest axis-aligned box around the curve, as [`CurvePiece::bounding`].
            #[must_use]
            pub fn bounding(self) -> Aabb2<S> {
                CurvePiece::from(self).bounding()
            }
            /// Returns the place that is nearest to a point, as [`CurvePiece::closest`].
            #[must_use]
            pub fn closest(self, point: Vec2<S>) -> CurvePlace {
                CurvePiece::from(self).closest(point)
            }
            /// Returns the distance of a point, at least 0, as [`CurvePiece::distance`].
            #[must_use]
            pub fn distance(self, point: Vec2<S>) -> S {
                CurvePiece::from(self).distance(point)
            }
        }
    )* };
}
verbs! { Quadratic2 Cubic2 Arc2 }

macro_rules! length {
    ($($shape:ident)*) => { $(
        impl<S: Scalar<Mask = bool>> $shape<S> {
            /// Returns the length, at least 0, as [`CurvePiece::length`].
            #[must_use]
            pub fn length(self) -> S {
                CurvePiece::from(self).length()
            }
        }
    )* };
}
length! { Quadratic2 Cubic2 }
