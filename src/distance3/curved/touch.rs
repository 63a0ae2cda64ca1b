//! The equations of two pieces that touch, and Newton's step for them.
//!
//! Unknown are the normal `n` (two coordinates across it) and the places on both pieces. The vector `b − a` between the
//! points is along `n`, and both pieces are stationary there: `n · ∂a = 0` and `n · ∂b = 0`, with a multiplier where
//! coordinates have length one. These are the conditions for a stationary value of `n · (b − a)`, the signed distance,
//! so that an error of a step counts by its square. No equation has a root, and all are regular where a solid is flat
//! or has no extent, and where the distance is zero.
use super::piece::{Piece, PieceKind, Place, shares};
use crate::arrays::Each;
use crate::{Scalar, Vec3};

/// The most unknowns: two of the normal, four of each place.
pub const MOST: usize = 10;
/// A pivot below which an equation depends on others, relative to its largest coefficient.
const DEPENDENT: f64 = 1e-12;
/// A largest coefficient below which an equation says nothing; its inverse is finite in every format.
const NONE: f64 = 1e-18;

/// A normal from a to b, and the places of the points that touch along it.
#[derive(Clone, Copy, Debug)]
pub struct Touch<S> {
    /// The normal, of length one.
    pub normal: Vec3<S>,
    /// The place on a's piece.
    pub a: Place<S>,
    /// The place on b's piece.
    pub b: Place<S>,
}

/// Constants by which a piece's equations are multiplied, so that none vanishes with the solid's size.
#[derive(Clone, Copy, Debug)]
pub struct Units<S> {
    /// One over the largest half extent of an ellipsoid; 0 if that is zero.
    pub over: S,
    /// The unit of the equation by the share of the axis: one over its length.
    pub axis: S,
}

impl Units<f64> {
    fn of(piece: &Piece<f64>, place: &Place<f64>) -> Self {
        let length = match piece.kind.has_axis() {
            true => piece.by_share(place).length(),
            false => 0.0,
        };
        let most = match piece.kind {
            PieceKind::Ball => piece.sizes.iter().copied().fold(0.0, f64::max),
            _ => 0.0,
        };
        Units {
            over: if most > 0.0 { 1.0 / most } else { 0.0 },
            axis: if length > 0.0 { 1.0 / length } else { 0.0 },
        }
    }
}

/// The constants of the equations about a touch.
#[derive(Clone, Copy, Debug)]
pub struct Frame<S> {
    /// Two directions of length one across the normal and each other.
    pub tangents: [Vec3<S>; 2],
    /// The units of both pieces' equations.
    pub units: [Units<S>; 2],
}

/// The constants of a replay's step: of the equations about a touch, and the inverse of their matrix.
#[derive(Clone, Copy, Debug)]
pub struct Constants<const N: usize> {
    /// The constants of the equations.
    pub frame: Frame<f64>,
    /// The inverse: changes of the unknowns by residuals.
    pub inverse: [[f64; N]; N],
    /// The number of unknowns.
    pub count: usize,
}

/// Returns two directions of length one across a direction and each other.
pub fn tangents(normal: Vec3<f64>) -> [Vec3<f64>; 2] {
    let axis = match normal.x.abs() < 0.6 {
        true => Vec3::new(1.0, 0.0, 0.0),
        false => Vec3::new(0.0, 1.0, 0.0),
    };
    let first = normal.cross(axis);
    let first = first * (1.0 / first.length_squared().sqrt());
    [first, normal.cross(first)]
}

/// The equations about a touch: their derivatives by all unknowns, decomposed. Equations that depend on others are left
/// out, with as many unknowns, which keep their values.
#[derive(Clone, Copy)]
pub struct System {
    matrix: [[f64; MOST]; MOST],
    /// The number of unknowns.
    pub count: usize,
    /// The number of independent equations.
    pub rank: usize,
    rows: [usize; MOST],
    columns: [usize; MOST],
    /// Its constants.
    pub frame: Frame<f64>,
}

impl System {
    /// Returns the system of two pieces near a touch.
    pub fn new(pieces: [&Piece<f64>; 2], touch: &Touch<f64>) -> Self {
        let places = [&touch.a, &touch.b];
        let gap = touch
            .normal
            .dot(pieces[1].at(&touch.b) - pieces[0].at(&touch.a));
        let mut system = System {
            matrix: [[0.0; MOST]; MOST],
            count: 2,
            rank: 0,
            rows: std::array::from_fn(|k| k),
            columns: std::array::from_fn(|k| k),
            frame: Frame {
                tangents: tangents(touch.normal),
                units: [0, 1].map(|side: usize| Units::of(pieces[side], places[side])),
            },
        };
        system.matrix[0][0] = -gap;
        system.matrix[1][1] = -gap;
        system.add(pieces[0], places[0], touch.normal, 0);
        system.add(pieces[1], places[1], -touch.normal, 1);
        system.decompose();
        system
    }
    /// Adds the unknowns and equations of a piece with an outer normal.
    fn add(&mut self, piece: &Piece<f64>, place: &Place<f64>, normal: Vec3<f64>, side: usize) {
        let (sign, units) = (if side == 0 { -1.0 } else { 1.0 }, self.frame.units[side]);
        // The equations by coordinates have shares of the largest half extent of an ellipsoid as units.
        let shares = match piece.kind {
            PieceKind::Ball => shares(&piece.sizes),
            _ => [1.0; 3],
        };
        let (kind, at) = (piece.kind, self.count);
        let ways = kind.ways();
        let (pull, share) = (at + ways, at + ways + usize::from(kind.is_round()));
        let m = &mut self.matrix;
        for j in 0..ways {
            let step = piece.ways[j] * piece.size(j, place.s);
            for (k, tangent) in self.frame.tangents.iter().enumerate() {
                m[k][at + j] = sign * tangent.dot(step);
                m[at + j][k] = -sign * tangent.dot(piece.ways[j]) * shares[j];
            }
            if kind.is_round() {
                m[at + j][at + j] = -place.pull;
                m[at + j][pull] = -place.y[j];
                m[pull][at + j] = -place.y[j];
            }
            if kind.has_axis() {
                m[share][at + j] = normal.dot(piece.ways[j]) * piece.taper * units.axis;
            }
        }
        if kind.has_axis() {
            let step = piece.by_share(place);
            for (k, tangent) in self.frame.tangents.iter().enumerate() {
                m[k][share] = sign * tangent.dot(step);
                m[share][k] = -sign * tangent.dot(step) * units.axis;
            }
        }
        if kind.turns() {
            let [x, y, z] = match kind {
                PieceKind::Ruled => piece.ways.each_as(|way| way * piece.size(0, place.s)),
                _ => piece.ways,
            };
            for (row, tangent) in m.iter_mut().zip(&self.frame.tangents) {
                for (place, &t) in row.iter_mut().zip(&self.frame.tangents) {
                    *place -= tangent.dot(x * t.x + y * t.y + z * t.z);
                }
            }
        }
        self.count = share + usize::from(kind.has_axis());
    }
    /// Decomposes the matrix, the largest pivot first.
    fn decompose(&mut self) {
        let (n, m) = (self.count, &mut self.matrix);
        let mut scales = [0.0; MOST];
        for (scale, row) in scales.iter_mut().zip(&*m).take(n) {
            let most = row[..n].iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            *scale = if most > NONE { 1.0 / most } else { 0.0 };
        }
        while self.rank < n {
            let (mut best, mut place) = (0.0, (self.rank, self.rank));
            for i in self.rank..n {
                for j in self.rank..n {
                    let size = m[self.rows[i]][self.columns[j]].abs() * scales[self.rows[i]];
                    if size > best {
                        (best, place) = (size, (i, j));
                    }
                }
            }
            if best <= DEPENDENT {
                break;
            }
            self.rows.swap(self.rank, place.0);
            self.columns.swap(self.rank, place.1);
            let (row, column) = (self.rows[self.rank], self.columns[self.rank]);
            for &other in &self.rows[self.rank + 1..n] {
                let factor = m[other][column] / m[row][column];
                for &j in &self.columns[self.rank + 1..n] {
                    m[other][j] -= factor * m[row][j];
                }
                m[other][column] = factor;
            }
            self.rank += 1;
        }
    }
    /// Returns the changes of the unknowns that make up for residuals.
    pub fn solve(&self, residuals: &[f64; MOST]) -> [f64; MOST] {
        let factor = |i: usize, j: usize| self.matrix[self.rows[i]][self.columns[j]];
        let mut sums = [0.0; MOST];
        for i in 0..self.rank {
            let all = residuals[self.rows[i]];
            sums[i] = (0..i).fold(all, |sum, j| sum - sums[j] * factor(i, j));
        }
        let mut changes = [0.0; MOST];
        for i in (0..self.rank).rev() {
            let later = i + 1..self.rank;
            let sum = later.fold(sums[i], |sum, j| {
                sum - changes[self.columns[j]] * factor(i, j)
            });
            let pivot = self.matrix[self.rows[i]][self.columns[i]];
            changes[self.columns[i]] = sum * (1.0 / pivot);
        }
        changes
    }
    /// Returns the constants of a replay. Rows and columns of equations that are left out are zero.
    pub fn constants(&self) -> Constants<MOST> {
        let mut inverse = [[0.0; MOST]; MOST];
        for k in 0..self.count {
            let mut residuals = [0.0; MOST];
            residuals[k] = 1.0;
            for (row, change) in inverse.iter_mut().zip(self.solve(&residuals)) {
                row[k] = change;
            }
        }
        Constants {
            frame: self.frame,
            inverse,
            count: self.count,
        }
    }
}

impl<S: Scalar> Frame<S> {
    /// Returns by how much a touch misses the equations.
    pub fn residuals(&self, pieces: [&Piece<S>; 2], touch: &Touch<S>) -> [S; MOST] {
        let mut out = [S::zero(); MOST];
        let way = pieces[1].at(&touch.b) - pieces[0].at(&touch.a);
        let gap = touch.normal.dot(way);
        for (out, &tangent) in out.iter_mut().zip(&self.tangents) {
            // The vector across the normal, seen along constant directions.
            *out = tangent.dot(way) - tangent.dot(touch.normal) * gap;
        }
        let mut at = 2;
        let sides = [(&touch.a, touch.normal), (&touch.b, -touch.normal)];
        for ((piece, (place, normal)), units) in pieces.into_iter().zip(sides).zip(&self.units) {
            for j in 0..piece.kind.ways() {
                let along = normal.dot(piece.ways[j]);
                let along = match piece.kind == PieceKind::Ball {
                    true => {
                        let any = units.over.above(S::zero());
                        S::select(any, along * piece.sizes[j] * units.over, along)
                    }
                    false => along,
                };
                out[at] = match piece.kind.is_round() {
                    true => along - place.pull * place.y[j],
                    false => along,
                };
                at += 1;
            }
            if piece.kind.is_round() {
                let ways = 0..piece.kind.ways();
                let rest = ways.fold(S::one(), |rest, j| rest - place.y[j] * place.y[j]);
                out[at] = rest.halved();
                at += 1;
            }
            if piece.kind.has_axis() {
                out[at] = normal.dot(piece.by_share(place)) * units.axis;
                at += 1;
            }
        }
        out
    }
    /// Returns a touch less some changes; coordinates of length one keep it.
    pub fn moved(&self, kinds: [PieceKind; 2], touch: &Touch<S>, changes: &[S]) -> Touch<S> {
        let mut next = *touch;
        for (&tangent, &change) in self.tangents.iter().zip(changes) {
            next.normal -= tangent * change;
        }
        // The length is about one, so that its square is in the format.
        next.normal = next.normal * S::one().over(next.normal.length_squared().root());
        let mut at = 2;
        for (kind, place) in kinds.into_iter().zip([&mut next.a, &mut next.b]) {
            let ways = 0..kind.ways();
            for j in ways.clone() {
                place.y[j] -= changes[at + j];
            }
            at += kind.ways();
            if kind.is_round() {
                place.pull -= changes[at];
                at += 1;
                let [x, y, z] = place.y;
                let unit = match kind.ways() {
                    2 => Vec3::new(x, y, S::zero()),
                    _ => Vec3::new(x, y, z),
                };
                let Vec3 { x, y, z } = unit.normalize_or_zero();
                place.y = [x, y, z];
            }
            if kind.has_axis() {
                place.s -= changes[at];
                at += 1;
            }
        }
        next
    }
}
