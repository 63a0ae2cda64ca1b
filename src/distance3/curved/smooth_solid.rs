//! Solids whose surfaces consist of smooth pieces.
use super::piece::{Piece, PieceKind};
use crate::scalar::largest;
use crate::{Scalar, Vec3};

/// A convex solid, as its place and a few lengths.
#[derive(Clone, Copy, Debug)]
pub enum Solid<S> {
    /// An ellipsoid: its centre, its axes with length one, and half the extents along them.
    Ball {
        center: Vec3<S>,
        ways: [Vec3<S>; 3],
        half: [S; 3],
    },
    /// A cylinder: an end, the vector to the other one, and two directions across it.
    Cylinder {
        start: Vec3<S>,
        axis: Vec3<S>,
        ways: [Vec3<S>; 2],
        radius: S,
    },
    /// A cone: the apex, the vector to the middle of the base, and two directions across it.
    Cone {
        apex: Vec3<S>,
        axis: Vec3<S>,
        ways: [Vec3<S>; 2],
        radius: S,
    },
    /// A flat disc, and two directions in it.
    Disc {
        center: Vec3<S>,
        ways: [Vec3<S>; 2],
        radius: S,
    },
    /// A box.
    Box {
        center: Vec3<S>,
        ways: [Vec3<S>; 3],
        half: [S; 3],
    },
    /// The hull of the first one to four corners.
    Simplex { corners: [Vec3<S>; 4], count: usize },
}

/// The corners of a simplex's edges.
pub const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
/// The corners of a simplex's faces.
pub const FACES: [[usize; 3]; 4] = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]];

/// Returns one if directions across a vector begin with that across x, zero if across y: whichever the vector is farther
/// from.
pub fn begins_by_x<S: Scalar>(axis: Vec3<S>) -> S {
    let along = axis.constant().normalize_or_zero();
    let steep = along.x.magnitude().below(S::lit(0.6));
    S::select(steep, S::one(), S::zero())
}

/// Returns two directions of length one across a vector and each other, given [how they begin](begins_by_x).
pub fn across<S: Scalar>(axis: Vec3<S>, by_x: S) -> [Vec3<S>; 2] {
    let along = axis.normalize_or_zero();
    let helper = Vec3::new(by_x, S::one() - by_x, S::zero());
    let first = along.cross(helper).normalize_or_zero();
    [first, along.cross(first)]
}

impl<S: Scalar> Solid<S> {
    /// Returns the number of pieces.
    pub fn pieces(&self) -> usize {
        match self {
            Solid::Ball { .. } => 1,
            Solid::Cylinder { .. } => 5,
            Solid::Cone { .. } => 4,
            Solid::Disc { .. } => 2,
            Solid::Box { .. } => 26,
            Solid::Simplex { count, .. } => [0, 1, 3, 7, 14][*count],
        }
    }
    /// Returns a piece by its number.
    pub fn piece(&self, k: usize) -> Piece<S> {
        let circle = |kind, from, ways, radius| Piece::plane(kind, from, ways, [radius; 2]);
        match *self {
            Solid::Ball { center, ways, half } => Piece {
                kind: PieceKind::Ball,
                ways,
                sizes: half,
                ..Piece::point(center)
            },
            Solid::Cylinder {
                start,
                axis,
                ways,
                radius,
            } => match k {
                0 => circle(PieceKind::Face, start, ways, radius),
                1 => circle(PieceKind::Face, start + axis, ways, radius),
                2 => circle(PieceKind::Rim, start, ways, radius),
                3 => circle(PieceKind::Rim, start + axis, ways, radius),
                _ => Piece {
                    along: axis,
                    ..circle(PieceKind::Side, start, ways, radius)
                },
            },
            Solid::Cone {
                apex,
                axis,
                ways,
                radius,
            } => match k {
                0 => circle(PieceKind::Face, apex + axis, ways, radius),
                1 => circle(PieceKind::Rim, apex + axis, ways, radius),
                2 => Piece {
                    along: axis,
                    taper: radius,
                    ..circle(PieceKind::Side, apex, ways, S::zero())
                },
                _ => Piece::point(apex),
            },
            Solid::Disc {
                center,
                ways,
                radius,
            } => match k {
                0 => circle(PieceKind::Face, center, ways, radius),
                _ => circle(PieceKind::Rim, center, ways, radius),
            },
            Solid::Box { center, ways, half } => of_box(center, ways, half, k),
            Solid::Simplex { corners, count } => of_simplex(corners, count, k),
        }
    }
    /// Returns the largest magnitude of a coordinate or length, without derivative.
    pub fn reach(&self) -> S::Primal {
        let of = |v: Vec3<S>| largest([v.x, v.y, v.z]);
        match *self {
            Solid::Ball { center, half, .. } | Solid::Box { center, half, .. } => {
                of(center).most(largest(half))
            }
            Solid::Cylinder {
                start: from,
                axis,
                radius,
                ..
            }
            | Solid::Cone {
                apex: from,
                axis,
                radius,
                ..
            } => of(from).most(of(axis)).most(largest([radius])),
            Solid::Disc { center, radius, .. } => of(center).most(largest([radius])),
            Solid::Simplex { corners, count } => corners[..count]
                .iter()
                .fold(S::Primal::zero(), |most, &corner| most.most(of(corner))),
        }
    }
    /// Returns the solid relative to a point, in other units.
    pub fn placed(self, from: Vec3<S>, scale: S) -> Self {
        let at = |point: Vec3<S>| (point - from) * scale;
        match self {
            Solid::Ball { center, ways, half } => Solid::Ball {
                center: at(center),
                ways,
                half: half.map(|half| half * scale),
            },
            Solid::Cylinder {
                start,
                axis,
                ways,
                radius,
            } => Solid::Cylinder {
                start: at(start),
                axis: axis * scale,
                ways,
                radius: radius * scale,
            },
            Solid::Cone {
                apex,
                axis,
                ways,
                radius,
            } => Solid::Cone {
                apex: at(apex),
                axis: axis * scale,
                ways,
                radius: radius * scale,
            },
            Solid::Disc {
                center,
                ways,
                radius,
            } => Solid::Disc {
                center: at(center),
                ways,
                radius: radius * scale,
            },
            Solid::Box { center, ways, half } => Solid::Box {
                center: at(center),
                ways,
                half: half.map(|half| half * scale),
            },
            Solid::Simplex { corners, count } => Solid::Simplex {
                corners: corners.map(at),
                count,
            },
        }
    }
    /// Returns the solid with every number as a wide one; `None` where one is not finite, or of another format.
    pub fn widened(&self) -> Option<Solid<f64>> {
        let one = |x: S| x.widened().filter(|x| x.is_finite());
        let all = |v: Vec3<S>| Some(Vec3::new(one(v.x)?, one(v.y)?, one(v.z)?));
        let two = |v: [Vec3<S>; 2]| Some([all(v[0])?, all(v[1])?]);
        let three = |v: [Vec3<S>; 3]| Some([all(v[0])?, all(v[1])?, all(v[2])?]);
        let lengths = |x: [S; 3]| Some([one(x[0])?, one(x[1])?, one(x[2])?]);
        Some(match *self {
            Solid::Ball { center, ways, half } => Solid::Ball {
                center: all(center)?,
                ways: three(ways)?,
                half: lengths(half)?,
            },
            Solid::Cylinder {
                start,
                axis,
                ways,
                radius,
            } => Solid::Cylinder {
                start: all(start)?,
                axis: all(axis)?,
                ways: two(ways)?,
                radius: one(radius)?,
            },
            Solid::Cone {
                apex,
                axis,
                ways,
                radius,
            } => Solid::Cone {
                apex: all(apex)?,
                axis: all(axis)?,
                ways: two(ways)?,
                radius: one(radius)?,
            },
            Solid::Disc {
                center,
                ways,
                radius,
            } => Solid::Disc {
                center: all(center)?,
                ways: two(ways)?,
                radius: one(radius)?,
            },
            Solid::Box { center, ways, half } => Solid::Box {
                center: all(center)?,
                ways: three(ways)?,
                half: lengths(half)?,
            },
            Solid::Simplex { corners, count } => {
                let [p, q, r, s] = corners.map(all);
                Solid::Simplex {
                    corners: [p?, q?, r?, s?],
                    count,
                }
            }
        })
    }
}

/// Returns a piece of a box: eight corners, twelve edges, six faces.
fn of_box<S: Scalar>(center: Vec3<S>, ways: [Vec3<S>; 3], half: [S; 3], k: usize) -> Piece<S> {
    let arm = |j: usize, plus: usize| match plus {
        0 => -(ways[j] * half[j]),
        _ => ways[j] * half[j],
    };
    if k < 8 {
        return Piece::point(center + arm(0, k & 1) + arm(1, k & 2) + arm(2, k & 4));
    }
    if k < 20 {
        let (j, side) = ((k - 8) / 4, (k - 8) % 4);
        let from = center + arm((j + 1) % 3, side & 1) + arm((j + 2) % 3, side & 2) + arm(j, 0);
        return Piece::line(from, arm(j, 1) + arm(j, 1));
    }
    let j = (k - 20) / 2;
    let (p, q) = ((j + 1) % 3, (j + 2) % 3);
    let middle = center + arm(j, (k - 20) % 2);
    Piece::plane(
        PieceKind::Face,
        middle,
        [ways[p], ways[q]],
        [half[p], half[q]],
    )
}

/// Returns a piece of a simplex: corners, then edges, then faces.
fn of_simplex<S: Scalar>(corners: [Vec3<S>; 4], count: usize, k: usize) -> Piece<S> {
    let edges = [0, 0, 1, 3, 6][count];
    if k < count {
        return Piece::point(corners[k]);
    }
    if k < count + edges {
        let [i, j] = EDGES[k - count];
        return Piece::line(corners[i], corners[j] - corners[i]);
    }
    let [from, i, j] = FACES[k - count - edges].map(|i| corners[i]);
    let (u, v) = (i - from, j - from);
    let units = [u.normalize_or_zero(), v.normalize_or_zero()];
    Piece::plane(PieceKind::Face, from, units, [u.length(), v.length()])
}
