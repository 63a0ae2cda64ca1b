//! Pieces of round solids that move with the normal, so that their points need no coordinates: three unknowns less for
//! an ellipsoid, two for a rim or a side.
use super::bend::Bend;
use super::piece::{Piece, PieceKind, Place};
use super::smooth_solid::Solid;
use crate::arrays::Each;
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

impl Solid<f64> {
    /// Returns a piece about a place, by its number, seen along its outer normal and two directions across it.
    #[inline]
    pub fn bent(
        &self,
        k: usize,
        place: &Place<f64>,
        normal: Vec3<f64>,
        across: &[Vec3<f64>; 2],
    ) -> Bend {
        let Some(turned) = k.checked_sub(TURNED) else {
            return Bend::of(&self.piece(k), place, across);
        };
        let circle = |ways: &[Vec3<f64>; 2], radius: f64| {
            let [x, y] = ways.each_as(|way| way.dot(normal));
            let over = 1.0 / (x * x + y * y).sqrt();
            let (x, y) = (x * over, y * over);
            let aside = ways[1] * x - ways[0] * y;
            let [p, q] = across.each_as(|t| t.dot(aside));
            let by = radius * over;
            let arm = (ways[0] * x + ways[1] * y) * radius;
            (arm, [by * p * p, by * p * q, by * q * q])
        };
        match self {
            Solid::Ball { center, ways, half } => {
                let along = [0, 1, 2].each_as(|k: usize| half[k] * ways[k].dot(normal));
                let [x, y, z] = along;
                let over = 1.0 / (x * x + y * y + z * z).sqrt();
                let arm =
                    (ways[0] * (half[0] * x) + ways[1] * (half[1] * y) + ways[2] * (half[2] * z))
                        * over;
                // The sum over the axes less the part along the arm.
                let [p, q] =
                    across.each_as(|t| [0, 1, 2].each_as(|k: usize| half[k] * ways[k].dot(t)));
                let [of_p, of_q] = across.each_as(|t| t.dot(arm));
                let dot = |[x, y, z]: [f64; 3], [u, v, w]: [f64; 3]| x * u + y * v + z * w;
                let turn = [
                    (dot(p, p) - of_p * of_p) * over,
                    (dot(p, q) - of_p * of_q) * over,
                    (dot(q, q) - of_q * of_q) * over,
                ];
                Bend::point(*center + arm, turn)
            }
            Solid::Disc {
                center,
                ways,
                radius,
            } => {
                let (arm, turn) = circle(ways, *radius);
                Bend::point(*center + arm, turn)
            }
            Solid::Cylinder {
                start,
                axis,
                ways,
                radius,
            } => {
                let (arm, turn) = circle(ways, *radius);
                match turned {
                    2 => Bend::point(*start + arm, turn),
                    3 => Bend::point(*start + *axis + arm, turn),
                    _ => Bend {
                        steps: [*axis, Vec3::zero()],
                        shares: 1,
                        ..Bend::point(*start + arm + *axis * place.s, turn)
                    },
                }
            }
            Solid::Cone {
                apex,
                axis,
                ways,
                radius,
            } => {
                let (arm, turn) = circle(ways, *radius);
                let slant = *axis + arm;
                match turned {
                    1 => Bend::point(*apex + slant, turn),
                    _ => Bend {
                        steps: [slant, Vec3::zero()],
                        shares: 1,
                        ..Bend::point(*apex + slant * place.s, turn.map(|x| x * place.s))
                    },
                }
            }
            Solid::Box { .. } | Solid::Simplex { .. } => {
                Bend::of(&self.piece(turned), place, across)
            }
        }
    }
}
