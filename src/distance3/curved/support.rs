//! Convex solids of plain numbers by their supports.
use super::super::mix::Mix;
use super::bend::Bend;
use super::by_normal::TURNED;
use super::piece::{Piece, PieceKind, Place, shares};
use super::smooth_solid::Solid;
use crate::{Scalar, Vec3};

/// A convex solid of plain numbers.
pub trait Supported {
    /// Returns the farthest point in a direction of any length.
    fn support(&self, way: Vec3<f64>) -> Vec3<f64>;
    /// Returns a point inside.
    fn middle(&self) -> Vec3<f64>;
    /// Returns about half of the largest extent.
    fn size(&self) -> f64;
    /// Returns the number of pieces.
    fn pieces(&self) -> usize;
    /// Returns a piece by its number, seen along its outer normal.
    fn piece(&self, k: usize, normal: Vec3<f64>) -> Piece<f64>;
    /// Returns the same about a place, seen along two directions across the normal.
    fn bend(
        &self,
        k: usize,
        place: &Place<f64>,
        normal: Vec3<f64>,
        across: &[Vec3<f64>; 2],
    ) -> Bend {
        Bend::of(&self.piece(k, normal), place, across)
    }
    /// Returns the point at a place of a piece.
    fn point(&self, k: usize, place: &Place<f64>, normal: Vec3<f64>) -> Vec3<f64> {
        self.piece(k, normal).at(place)
    }
    /// Returns the place on a piece that is as near as clamping makes it.
    fn clamped(&self, k: usize, place: &Place<f64>) -> Place<f64>;
    /// Returns a point in the middle of a piece.
    fn middle_of(&self, _: usize, piece: &Piece<f64>) -> Vec3<f64> {
        match piece.kind {
            PieceKind::Line | PieceKind::Side => piece.from + piece.along * 0.5,
            _ => piece.from,
        }
    }
    /// Returns the farthest point in a direction, and a code of the corner, the end or the rim that it is on.
    fn coded(&self, way: Vec3<f64>) -> (Vec3<f64>, usize) {
        (self.support(way), 0)
    }
    /// Returns the number of the piece that the nearest point is on, and a place, given the points whose mean it is, that
    /// mean, and the outer normal; `None` where it is not clear.
    fn likely(&self, mix: &Mix, at: Vec3<f64>, normal: Vec3<f64>) -> Option<(usize, Place<f64>)>;
    /// Returns the same of the piece that is the second most likely; `None` without one.
    fn less_likely(&self, _: &Mix, _: Vec3<f64>, _: Vec3<f64>) -> Option<(usize, Place<f64>)> {
        None
    }
    /// Returns the dimension of the set of highest points along a normal, within a slack.
    fn flatness(&self, _normal: Vec3<f64>, _slack: f64) -> usize {
        0
    }
    /// Returns `true` if no other points than those of a piece with a dimension are nearly as high along a normal, where
    /// this matters for derivatives.
    fn is_plain(&self, _normal: Vec3<f64>, _dimension: usize) -> bool {
        true
    }
    /// Returns `true` if directions around an axis may be nearly as good as each other; their search needs the pieces.
    fn may_be_round(&self) -> bool {
        true
    }
    /// Returns `true` if a piece moves with the normal so steadily that rounding of it is rounding of the point.
    fn is_steady(&self, _piece: usize, _normal: Vec3<f64>) -> bool {
        true
    }
    /// Returns the number by which a replay evaluates a piece, and a point's place on that.
    fn replayed(&self, k: usize, place: &Place<f64>) -> (usize, Place<f64>) {
        (k, *place)
    }
}

/// Returns the vector with length one; zero for zero.
fn unit([x, y]: [f64; 2]) -> [f64; 2] {
    let length = Scalar::hypot(x, y);
    match length > 0.0 {
        true => [x / length, y / length],
        false => [0.0; 2],
    }
}

/// The square of a length above which it is computed by its square.
const LONG: f64 = 1e-200;

/// Returns the farthest point of a disc about the origin.
#[inline(always)]
fn on_circle(ways: [Vec3<f64>; 2], radius: f64, way: Vec3<f64>) -> Vec3<f64> {
    let [x, y] = ways.map(|own| own.dot(way));
    let square = x * x + y * y;
    if square > LONG {
        let by = radius / square.sqrt();
        return ways[0] * (x * by) + ways[1] * (y * by);
    }
    let [x, y] = unit([x, y]);
    (ways[0] * x + ways[1] * y) * radius
}

impl Supported for Solid<f64> {
    fn support(&self, way: Vec3<f64>) -> Vec3<f64> {
        match *self {
            Solid::Ball { center, ways, half } => {
                let y = [0, 1, 2].map(|k| half[k] * ways[k].dot(way));
                let square = y[0] * y[0] + y[1] * y[1] + y[2] * y[2];
                let over = match square > LONG {
                    true => 1.0 / square.sqrt(),
                    false => {
                        let length = Vec3::new(y[0], y[1], y[2]).length();
                        if length > 0.0 { 1.0 / length } else { 0.0 }
                    }
                };
                (0..3).fold(center, |at, k| at + ways[k] * (half[k] * (y[k] * over)))
            }
            Solid::Disc {
                center,
                ways,
                radius,
            } => center + on_circle(ways, radius, way),
            Solid::Cylinder {
                start,
                axis,
                ways,
                radius,
            } => {
                let end = if axis.dot(way) > 0.0 {
                    axis
                } else {
                    Vec3::zero()
                };
                start + end + on_circle(ways, radius, way)
            }
            Solid::Cone {
                apex,
                axis,
                ways,
                radius,
            } => {
                let rim = axis + on_circle(ways, radius, way);
                if rim.dot(way) > 0.0 { apex + rim } else { apex }
            }
            Solid::Box { center, ways, half } => (0..3).fold(center, |at, k| {
                let high = ways[k].dot(way) > 0.0;
                at + ways[k] * if high { half[k] } else { -half[k] }
            }),
            Solid::Simplex { corners, count } => {
                let mut best = (f64::NEG_INFINITY, corners[0]);
                for &corner in &corners[..count] {
                    let height = way.dot(corner - corners[0]);
                    if height > best.0 {
                        best = (height, corner);
                    }
                }
                best.1
            }
        }
    }
    fn middle(&self) -> Vec3<f64> {
        match *self {
            Solid::Ball { center, .. } | Solid::Disc { center, .. } | Solid::Box { center, .. } => {
                center
            }
            Solid::Cylinder { start, axis, .. } => start + axis * 0.5,
            Solid::Cone { apex, axis, .. } => apex + axis * 0.7,
            Solid::Simplex { corners, count } => {
                let arms = corners[..count].iter().map(|&corner| corner - corners[0]);
                corners[0] + arms.fold(Vec3::zero(), |sum, arm| sum + arm) * (1.0 / count as f64)
            }
        }
    }
    fn size(&self) -> f64 {
        match *self {
            Solid::Ball { half, .. } | Solid::Box { half, .. } => {
                Vec3::new(half[0], half[1], half[2]).length()
            }
            Solid::Disc { radius, .. } => radius,
            Solid::Cylinder { axis, radius, .. } | Solid::Cone { axis, radius, .. } => {
                radius + axis.length()
            }
            Solid::Simplex { corners, count } => {
                let lengths = corners[..count]
                    .iter()
                    .map(|&corner| (corner - corners[0]).length());
                lengths.fold(0.0, f64::max)
            }
        }
    }
    fn pieces(&self) -> usize {
        Solid::pieces(self)
    }
    fn piece(&self, k: usize, normal: Vec3<f64>) -> Piece<f64> {
        self.seen(k, normal, true)
    }
    fn bend(
        &self,
        k: usize,
        place: &Place<f64>,
        normal: Vec3<f64>,
        across: &[Vec3<f64>; 2],
    ) -> Bend {
        self.bent(k, place, normal, across)
    }
    fn point(&self, k: usize, place: &Place<f64>, normal: Vec3<f64>) -> Vec3<f64> {
        self.seen(k, normal, false).at(place)
    }
    fn coded(&self, way: Vec3<f64>) -> (Vec3<f64>, usize) {
        let point = self.support(way);
        (point, self.code(way, point))
    }
    fn likely(&self, mix: &Mix, at: Vec3<f64>, normal: Vec3<f64>) -> Option<(usize, Place<f64>)> {
        self.likely_piece(mix, (at, normal), true)
    }
    fn less_likely(
        &self,
        mix: &Mix,
        at: Vec3<f64>,
        normal: Vec3<f64>,
    ) -> Option<(usize, Place<f64>)> {
        self.likely_piece(mix, (at, normal), false)
    }
    fn flatness(&self, normal: Vec3<f64>, slack: f64) -> usize {
        self.flat(normal, slack)
    }
    fn is_steady(&self, piece: usize, normal: Vec3<f64>) -> bool {
        self.is_steady_piece(piece, normal)
    }
    fn clamped(&self, k: usize, place: &Place<f64>) -> Place<f64> {
        let mut place = *place;
        place.s = place.s.clamp(0.0, 1.0);
        if k < TURNED && Solid::piece(self, k).kind == PieceKind::Face {
            let [x, y, _] = place.y;
            let [x, y] = match self {
                Solid::Box { .. } => [x.clamp(-1.0, 1.0), y.clamp(-1.0, 1.0)],
                Solid::Simplex { .. } => {
                    let [x, y] = [x.max(0.0), y.max(0.0)];
                    let sum = (x + y).max(1.0);
                    [x / sum, y / sum]
                }
                _ => {
                    let length = Scalar::hypot(x, y).max(1.0);
                    [x / length, y / length]
                }
            };
            place.y = [x, y, 0.0];
        }
        place
    }
    fn middle_of(&self, _: usize, piece: &Piece<f64>) -> Vec3<f64> {
        let [p, q, _] = [0, 1, 2].map(|k| piece.ways[k] * piece.sizes[k]);
        match (piece.kind, self) {
            (PieceKind::Face, Solid::Simplex { .. }) => piece.from + (p + q) * (1.0 / 3.0),
            (PieceKind::Line | PieceKind::Side, _) => piece.from + piece.along * 0.5,
            _ => piece.from,
        }
    }
}

/// Returns the place of a piece near a point, given its outer normal. Round pieces take the direction from the normal
/// or from the point.
pub fn start(piece: &Piece<f64>, at: Vec3<f64>, normal: Vec3<f64>, by_normal: bool) -> Place<f64> {
    let mut place = Place::zero();
    let arm = at - piece.from;
    if piece.kind.has_axis() {
        let square = piece.along.length_squared();
        let share = piece.along.dot(arm) / square;
        place.s = if square > 0.0 {
            share.clamp(0.0, 1.0)
        } else {
            0.0
        };
    }
    match piece.kind {
        PieceKind::Face => {
            let [u, v, _] = piece.ways;
            let (cosine, p, q) = (u.dot(v), u.dot(arm), v.dot(arm));
            let square = 1.0 - cosine * cosine;
            // Ways along a face without an area are parallel.
            let [x, y] = match square > 1e-14 {
                true => [(p - cosine * q) / square, (q - cosine * p) / square],
                false => [p, 0.0],
            };
            let share = |x: f64, size: f64| if size > 0.0 { x / size } else { 0.0 };
            place.y = [share(x, piece.sizes[0]), share(y, piece.sizes[1]), 0.0];
        }
        PieceKind::Rim | PieceKind::Side => {
            let of = |v: Vec3<f64>| [piece.ways[0].dot(v), piece.ways[1].dot(v)];
            let (along, to) = (of(normal), of(arm));
            let both = if by_normal { [along, to] } else { [to, along] };
            let found = both.into_iter().map(unit).find(|y| *y != [0.0; 2]);
            let [x, y] = found.unwrap_or([1.0, 0.0]);
            place.y = [x, y, 0.0];
            place.pull = along[0] * x + along[1] * y;
        }
        PieceKind::Ball => place = on_ball(piece, arm, normal, by_normal),
        PieceKind::Point | PieceKind::Line | PieceKind::Own | PieceKind::Ruled => {}
    }
    place
}

/// Returns the place on an ellipsoid, as [`start`] does.
fn on_ball(piece: &Piece<f64>, arm: Vec3<f64>, normal: Vec3<f64>, by_normal: bool) -> Place<f64> {
    let shares = shares(&piece.sizes);
    let along = [0, 1, 2].map(|k| shares[k] * piece.ways[k].dot(normal));
    let mut y = along;
    if !by_normal {
        let size = |k: usize| piece.sizes[k];
        y = [0, 1, 2].map(|k| {
            if size(k) > 0.0 {
                piece.ways[k].dot(arm) / size(k)
            } else {
                0.0
            }
        });
        // A point has few digits along the thinnest way, and the others tell its coordinate there.
        let thin = (0..3)
            .min_by(|&i, &j| size(i).total_cmp(&size(j)))
            .unwrap_or(0);
        let rest: f64 = (0..3).filter(|&k| k != thin).map(|k| y[k] * y[k]).sum();
        let high = (1.0 - rest).max(0.0).sqrt();
        y[thin] = if piece.ways[thin].dot(normal) < 0.0 {
            -high
        } else {
            high
        };
    }
    let length = Vec3::new(y[0], y[1], y[2]).length();
    let y = match length > 0.0 {
        true => y.map(|y| y / length),
        false => [1.0, 0.0, 0.0],
    };
    Place {
        y,
        s: 0.0,
        pull: (0..3).map(|k| along[k] * y[k]).sum(),
    }
}
