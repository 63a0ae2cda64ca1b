//! Pieces of round solids that move with the normal, so that their points need no coordinates: three unknowns less for
//! an ellipsoid, two for a rim or a side.
use super::piece::{Piece, PieceKind};
use super::smooth_solid::Solid;
use crate::{Scalar, Vec3};

/// The difference of the numbers of a piece that moves with the normal and of the same one by coordinates.
pub const TURNED: usize = 32;

/// The support of a round surface about the origin along a normal, and its derivatives by the normal's coordinates.
struct Turn<S> {
    arm: Vec3<S>,
    ways: [Vec3<S>; 3],
}

impl<S: Scalar> Turn<S> {
    /// Returns that of an ellipsoid. Derivatives are zero unless they are asked for.
    #[inline(always)]
    fn of_ball(ways: [Vec3<S>; 3], half: [S; 3], normal: Vec3<S>, slopes: bool) -> Self {
        let along = |k: usize| half[k] * ways[k].dot(normal);
        let y = Vec3::new(along(0), along(1), along(2));
        // The search takes it for halves that are not tiny.
        let over = S::one().over(y.length_squared().root());
        let [x, y, z] = [y.x, y.y, y.z];
        let arm = ways[0] * (half[0] * x * over)
            + ways[1] * (half[1] * y * over)
            + ways[2] * (half[2] * z * over);
        let mut turn = Turn {
            arm,
            ways: [Vec3::zero(); 3],
        };
        if slopes {
            let long = |k: usize| ways[k] * (half[k] * half[k]);
            let [p, q, r] = [long(0), long(1), long(2)];
            let column = |x: S, y: S, z: S, own: S| (p * x + q * y + r * z - arm * own) * over;
            let [u, v, w] = ways;
            turn.ways = [
                column(u.x, v.x, w.x, arm.x),
                column(u.y, v.y, w.y, arm.y),
                column(u.z, v.z, w.z, arm.z),
            ];
        }
        turn
    }
    /// Returns that of a circle.
    #[inline(always)]
    fn of_circle(ways: [Vec3<S>; 2], radius: S, normal: Vec3<S>, slopes: bool) -> Self {
        let (x, y) = (ways[0].dot(normal), ways[1].dot(normal));
        let over = S::one().over((x * x + y * y).root());
        let (x, y) = (x * over, y * over);
        let mut turn = Turn {
            arm: (ways[0] * x + ways[1] * y) * radius,
            ways: [Vec3::zero(); 3],
        };
        if slopes {
            let aside = ways[1] * x - ways[0] * y;
            let by = aside * (radius * over);
            turn.ways = [by * aside.x, by * aside.y, by * aside.z];
        }
        turn
    }
    /// Returns the piece about a centre.
    #[inline(always)]
    fn about(self, center: Vec3<S>) -> Piece<S> {
        Piece {
            kind: PieceKind::Own,
            ways: self.ways,
            ..Piece::point(center + self.arm)
        }
    }
}

impl<S: Scalar> Solid<S> {
    /// Returns a piece by its number, seen along its outer normal. One that moves with the normal has derivatives by it
    /// if they are asked for.
    #[inline(always)]
    pub fn seen(&self, k: usize, normal: Vec3<S>, slopes: bool) -> Piece<S> {
        let Some(k) = k.checked_sub(TURNED) else {
            return self.piece(k);
        };
        match *self {
            Solid::Ball { center, ways, half } => {
                Turn::of_ball(ways, half, normal, slopes).about(center)
            }
            Solid::Disc {
                center,
                ways,
                radius,
            } => Turn::of_circle(ways, radius, normal, slopes).about(center),
            Solid::Cylinder {
                start,
                axis,
                ways,
                radius,
            } => {
                let turn = Turn::of_circle(ways, radius, normal, slopes);
                match k {
                    2 => turn.about(start),
                    3 => turn.about(start + axis),
                    _ => Piece {
                        kind: PieceKind::Ruled,
                        along: axis,
                        sizes: [S::one(), S::zero(), S::zero()],
                        ..turn.about(start)
                    },
                }
            }
            Solid::Cone {
                apex,
                axis,
                ways,
                radius,
            } => {
                let turn = Turn::of_circle(ways, radius, normal, slopes);
                match k {
                    1 => turn.about(apex + axis),
                    _ => Piece {
                        kind: PieceKind::Ruled,
                        from: apex,
                        along: axis + turn.arm,
                        taper: S::one(),
                        ..turn.about(apex)
                    },
                }
            }
            Solid::Box { .. } | Solid::Simplex { .. } => self.piece(k),
        }
    }
}
