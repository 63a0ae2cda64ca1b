//! The piece on which an iteration by supports says that the nearest point is.
use super::super::mix::Mix;
use super::by_normal::TURNED;
use super::piece::{Piece, PieceKind, Place, along, within};
use super::smooth_solid::{EDGES, FACES, Solid};
use super::support::start;
use crate::Vec3;

/// The sine of the angle between a normal and an axis below which a round piece moves too fast with the normal.
const STEADY: f64 = 1e-3;
/// The size of an ellipsoid below which squares are too small in some formats, relative to the pair's.
const TINY: f64 = 1e-3;
/// The share of the radius below which a point is on the flat end.
const INNER: f64 = 0.75;

/// Returns the sine of the angle between a normal and the axis of a circle.
fn steep(ways: &[Vec3<f64>; 2], normal: Vec3<f64>) -> f64 {
    let [x, y] = ways.map(|way| way.dot(normal));
    (x * x + y * y).sqrt()
}

/// Returns `true` if the support of an ellipsoid moves with a normal as steadily as its digits need.
fn is_steady_ball(ways: &[Vec3<f64>; 3], half: &[f64; 3], normal: Vec3<f64>) -> bool {
    let along = [0, 1, 2].map(|k| half[k] * ways[k].dot(normal));
    let most = half.iter().copied().fold(0.0, f64::max);
    let square = along.iter().map(|x| x * x).sum::<f64>();
    let least = STEADY * most.max(TINY);
    square > least * least
}

impl Solid<f64> {
    /// Returns the code of the support in a direction: the end, the corner, else zero.
    pub fn code(&self, way: Vec3<f64>, point: Vec3<f64>) -> usize {
        match *self {
            Solid::Ball { .. } | Solid::Disc { .. } => 0,
            Solid::Cylinder { axis, .. } => usize::from(axis.dot(way) > 0.0),
            Solid::Cone { apex, .. } => usize::from(point != apex),
            Solid::Box { ways, .. } => {
                let bit = |k: usize| usize::from(ways[k].dot(way) > 0.0) << k;
                bit(0) | bit(1) | bit(2)
            }
            Solid::Simplex { corners, count } => {
                let found = corners[..count].iter().position(|&corner| corner == point);
                found.unwrap_or(0)
            }
        }
    }
    /// Returns the flat end or the rim of a circle, with its number, whichever is more likely to have a point near another
    /// one, or the other one; `None` for a rim that moves too fast with the normal.
    fn end_or_rim(
        [end, rim]: [usize; 2],
        (center, ways, radius): (Vec3<f64>, &[Vec3<f64>; 2], f64),
        (at, normal): (Vec3<f64>, Vec3<f64>),
        likely: bool,
    ) -> Option<(usize, Place<f64>)> {
        let steep = steep(ways, normal);
        let [x, y] = ways.map(|way| way.dot(at - center));
        let is_inner = steep < 0.5 && x * x + y * y < INNER * INNER * radius * radius;
        match (is_inner || steep <= STEADY) == likely {
            true => {
                let piece = Piece::plane(PieceKind::Face, center, *ways, [radius; 2]);
                Some((end, start(&piece, at, normal, true)))
            }
            false => (steep > STEADY).then_some((TURNED + rim, Place::zero())),
        }
    }
    /// Returns the number of a piece and a place on it, given the points whose mean is the nearest one, that point, and the
    /// outer normal, or of the second most likely one; `None` where it is not clear.
    pub fn likely_piece(
        &self,
        mix: &Mix,
        (at, normal): (Vec3<f64>, Vec3<f64>),
        likely: bool,
    ) -> Option<(usize, Place<f64>)> {
        let circle =
            |numbers: [usize; 2], center: Vec3<f64>, ways: &[Vec3<f64>; 2], radius: f64| {
                Solid::end_or_rim(numbers, (center, ways, radius), (at, normal), likely)
            };
        match *self {
            Solid::Disc {
                center,
                ways,
                radius,
            } => circle([0, 1], center, &ways, radius),
            Solid::Cylinder {
                start,
                axis,
                ways,
                radius,
            } => match *mix.codes() {
                [0] => circle([0, 2], start, &ways, radius),
                [_] => circle([1, 3], start + axis, &ways, radius),
                _ => (likely && steep(&ways, normal) > STEADY)
                    .then_some((TURNED + 4, along(mix.weight(1)))),
            },
            Solid::Cone {
                apex,
                axis,
                ways,
                radius,
            } => match *mix.codes() {
                [0] => likely.then_some((3, Place::zero())),
                [_] => circle([0, 1], apex + axis, &ways, radius),
                _ => (likely && steep(&ways, normal) > STEADY)
                    .then_some((TURNED + 2, along(mix.weight(1)))),
            },
            _ if !likely => None,
            Solid::Ball { ways, half, .. } => {
                is_steady_ball(&ways, &half, normal).then_some((TURNED, Place::zero()))
            }
            Solid::Box { .. } => of_box(mix),
            Solid::Simplex { count, .. } => of_simplex(self, count, mix),
        }
    }
    /// Returns `true` if a piece moves with a normal as steadily as its digits need; others than [these](TURNED) do.
    pub fn is_steady_piece(&self, k: usize, normal: Vec3<f64>) -> bool {
        match self {
            _ if k < TURNED => true,
            Solid::Ball { ways, half, .. } => is_steady_ball(ways, half, normal),
            Solid::Disc { ways, .. } | Solid::Cylinder { ways, .. } | Solid::Cone { ways, .. } => {
                steep(ways, normal) > STEADY
            }
            Solid::Box { .. } | Solid::Simplex { .. } => true,
        }
    }
    /// Returns the dimension of the set of highest points along a normal, within a slack: 0 for a point, 1 for a segment.
    pub fn flat(&self, normal: Vec3<f64>, slack: f64) -> usize {
        match *self {
            Solid::Ball { .. } => 0,
            Solid::Disc { ways, radius, .. } => match radius * steep(&ways, normal) <= slack {
                true => 2,
                false => 0,
            },
            Solid::Cylinder {
                axis, ways, radius, ..
            } => match radius * steep(&ways, normal) <= slack {
                true => 2,
                false => usize::from(axis.dot(normal).abs() <= slack),
            },
            Solid::Cone {
                axis, ways, radius, ..
            } => {
                let steep = radius * steep(&ways, normal);
                match steep <= slack {
                    true => 2,
                    false => usize::from((axis.dot(normal) + steep).abs() <= slack),
                }
            }
            Solid::Box { ways, half, .. } => {
                let level = |k: &usize| (ways[*k].dot(normal) * half[*k]).abs() <= slack;
                (0..3).filter(level).count()
            }
            Solid::Simplex { corners, count } => {
                let heights = corners.map(|corner| normal.dot(corner - corners[0]));
                let own = &heights[..count];
                let top = own.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let level = own.iter().filter(|&&height| height >= top - slack);
                (level.count() - 1).min(2)
            }
        }
    }
}

/// Returns the piece of a box: corners that differ along one axis have an edge, along two a face.
fn of_box(mix: &Mix) -> Option<(usize, Place<f64>)> {
    let (all, any) = mix
        .codes()
        .iter()
        .fold((7, 0), |(all, any), &code| (all & code, any | code));
    let free = all ^ any;
    let share = |k: usize| mix.sum(|code| code >> k & 1 == 1);
    let bit = |k: usize| all >> k & 1;
    match free.count_ones() {
        0 => Some((all, Place::zero())),
        1 => {
            let j = free.trailing_zeros() as usize;
            let side = bit((j + 1) % 3) | bit((j + 2) % 3) << 1;
            Some((8 + 4 * j + side, along(share(j))))
        }
        2 => {
            let j = (!free & 7).trailing_zeros() as usize;
            let [x, y] = [(j + 1) % 3, (j + 2) % 3].map(|k| 2.0 * share(k) - 1.0);
            Some((20 + 2 * j + bit(j), within(x, y)))
        }
        _ => None,
    }
}

/// Returns the piece of a simplex with some corners.
fn of_simplex(solid: &Solid<f64>, count: usize, mix: &Mix) -> Option<(usize, Place<f64>)> {
    let edges = [0, 0, 1, 3, 6][count];
    match *mix.codes() {
        [i] => Some((i, Place::zero())),
        [i, j] => {
            let k = EDGES
                .iter()
                .position(|&edge| edge == [i, j] || edge == [j, i])?;
            Some((count + k, along(mix.weight(EDGES[k][1]))))
        }
        [i, j, k] => {
            let has = |face: &[usize; 3]| [i, j, k].iter().all(|corner| face.contains(corner));
            let face = FACES.iter().position(has)?;
            let [_, u, v] = FACES[face];
            let number = count + edges + face;
            (number < solid.pieces()).then_some((number, within(mix.weight(u), mix.weight(v))))
        }
        _ => None,
    }
}
