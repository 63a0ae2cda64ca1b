//! Pieces without coordinates of length one about a place, and Newton's step for two of them.
//!
//! A piece is a point there, how it moves with the outer normal, and how it moves along the piece by no, one or two
//! shares. With up to two shares in all the equations of a [touch](super::touch) have solutions in closed form.
use super::piece::{Piece, PieceKind, Place};
use super::touch::{Constants, Frame, Touch, Units};
use crate::Vec3;
use crate::arrays::Each;

/// The most unknowns: two of the normal and two shares.
pub const FEW: usize = 4;
/// A determinant of two equations above which they are independent, relative to its terms.
const CLEAR: f64 = 1e-6;

/// A piece about a place, seen along two directions across its outer normal.
#[derive(Clone, Copy, Debug)]
pub struct Bend {
    /// The point at the place.
    pub at: Vec3<f64>,
    /// How the point moves with the normal along both directions: a symmetric matrix by its xx, xy and yy.
    pub turn: [f64; 3],
    /// How the point moves by each share.
    pub steps: [Vec3<f64>; 2],
    /// The number of shares: of an edge or a line of a side one, of a face its two coordinates.
    pub shares: usize,
}

impl Bend {
    /// Returns a point that moves with the normal alone.
    #[inline(always)]
    pub fn point(at: Vec3<f64>, turn: [f64; 3]) -> Self {
        Bend {
            at,
            turn,
            steps: [Vec3::zero(); 2],
            shares: 0,
        }
    }
    /// Returns a piece about a place.
    #[inline(always)]
    pub fn of(piece: &Piece<f64>, place: &Place<f64>, across: &[Vec3<f64>; 2]) -> Self {
        let mut bend = Bend::point(piece.at(place), [0.0; 3]);
        match piece.kind {
            PieceKind::Face => {
                bend.steps = [0, 1].each_as(|k: usize| piece.ways[k] * piece.sizes[k]);
                bend.shares = 2;
            }
            kind if kind.has_axis() => {
                bend.steps[0] = piece.by_share(place);
                bend.shares = 1;
            }
            _ => {}
        }
        if piece.kind.turns() {
            let long = match piece.kind {
                PieceKind::Ruled => piece.size(0, place.s),
                _ => 1.0,
            };
            let [x, y, z] = piece.ways;
            let [by_p, by_q] = across.each_as(|t| (x * t.x + y * t.y + z * t.z) * long);
            let [p, q] = *across;
            bend.turn = [p.dot(by_p), p.dot(by_q), q.dot(by_q)];
        }
        bend
    }
}

/// Returns two directions of length one across a normal of length one and each other (Duff and others 2017).
#[inline(always)]
pub fn across(normal: Vec3<f64>) -> [Vec3<f64>; 2] {
    let Vec3 { x, y, z } = normal;
    let sign = 1.0_f64.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    [
        Vec3::new(1.0 + sign * x * x * a, sign * b, -sign * x),
        Vec3::new(b, sign + y * y * a, -y),
    ]
}

/// Returns the inverse of a matrix of two rows; `None` where its equations depend on each other.
#[inline(always)]
fn inverse([[a, b], [c, d]]: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    let (product, other) = (a * d, b * c);
    let rest = product - other;
    let over = 1.0 / rest;
    let clear = rest.abs() > CLEAR * product.abs().max(other.abs());
    clear.then_some([[d * over, -b * over], [-c * over, a * over]])
}

#[inline(always)]
fn times([[a, b], [c, d]]: &[[f64; 2]; 2], [x, y]: [f64; 2]) -> [f64; 2] {
    [a * x + b * y, c * x + d * y]
}

/// The equations of two pieces about a touch, whose matrix is
///
/// ```text
/// |  H   G |   changes of the normal     residuals of the vector between the points
/// | -Gᵀ  0 | · changes of the shares  =  slopes of the pieces along the outer normals
/// ```
#[derive(Clone, Copy, Debug)]
pub struct BentPair {
    /// Two directions across the normal.
    across: [Vec3<f64>; 2],
    /// The matrix H, which is symmetric.
    turn: [[f64; 2]; 2],
    /// The columns of G.
    steps: [[f64; 2]; 2],
    shares: usize,
    /// An inverse: of H without shares; with one of -G and H across it as rows; with two of -Gᵀ.
    inverse: [[f64; 2]; 2],
}

impl BentPair {
    /// Returns the equations of two pieces along a normal; `None` if some depend on each other.
    #[inline(always)]
    pub fn new([a, b]: [&Bend; 2], across: [Vec3<f64>; 2], gap: f64) -> Option<Self> {
        let mut steps = [[0.0; 2]; 2];
        for (k, step) in a.steps[..a.shares].iter().enumerate() {
            steps[k] = across.each_as(|t| -t.dot(*step));
        }
        for (k, step) in b.steps[..b.shares].iter().enumerate() {
            *steps.get_mut(a.shares + k)? = across.each_as(|t| t.dot(*step));
        }
        let [xx, xy, yy] = [0, 1, 2].each_as(|k: usize| -(a.turn[k] + b.turn[k]));
        let turn = [[xx - gap, xy], [xy, yy - gap]];
        let [[gx, gy], other] = steps;
        let shares = a.shares + b.shares;
        let inverse = match shares {
            0 => inverse(turn),
            1 => inverse([[-gx, -gy], times(&turn, [-gy, gx])]),
            _ => inverse([[-gx, -gy], other.map(|x| -x)]),
        };
        inverse.map(|inverse| BentPair {
            across,
            turn,
            steps,
            shares,
            inverse,
        })
    }
    /// Returns the changes that make up for the residuals of the vector between the points, and for the slopes along the
    /// outer normals by each share: of the normal, and of the shares.
    #[inline(always)]
    pub fn solve(&self, way: [f64; 2], slopes: [f64; 2]) -> [f64; FEW] {
        let [[gx, gy], [hx, hy]] = self.steps;
        let [x, y] = match self.shares {
            0 => times(&self.inverse, way),
            1 => times(&self.inverse, [slopes[0], gx * way[1] - gy * way[0]]),
            _ => times(&self.inverse, slopes),
        };
        let [turned_x, turned_y] = times(&self.turn, [x, y]);
        let rest = [way[0] - turned_x, way[1] - turned_y];
        let [s, t] = match self.shares {
            0 => [0.0; 2],
            1 => [(gx * rest[0] + gy * rest[1]) / (gx * gx + gy * gy), 0.0],
            _ => {
                let over = 1.0 / (gx * hy - gy * hx);
                [
                    (hy * rest[0] - hx * rest[1]) * over,
                    (gx * rest[1] - gy * rest[0]) * over,
                ]
            }
        };
        [x, y, s, t]
    }
    /// Returns the constants of the equations and the inverse of their matrix, in the units of [`Units`], given the bends.
    pub fn constants(&self, [a, b]: [&Bend; 2]) -> Constants<FEW> {
        let mut lengths = [1.0; 2];
        for (length, step) in lengths
            .iter_mut()
            .zip(a.steps[..a.shares].iter().chain(&b.steps[..b.shares]))
        {
            *length = step.length();
        }
        let mut inverse = [[0.0; FEW]; FEW];
        for k in 0..2 + self.shares {
            let (mut way, mut slopes) = ([0.0; 2], [0.0; 2]);
            match k {
                0 | 1 => way[k] = 1.0,
                _ => slopes[k - 2] = lengths[k - 2],
            }
            for (row, change) in inverse.iter_mut().zip(self.solve(way, slopes)) {
                row[k] = change;
            }
        }
        // Equations that are solved have steps of some length.
        let units = [(a, 0), (b, a.shares)].each_as(|(bend, first): (&Bend, usize)| Units {
            over: 0.0,
            axis: match bend.shares {
                1 => 1.0 / lengths[first],
                _ => 0.0,
            },
        });
        Constants {
            frame: Frame {
                tangents: self.across,
                units,
            },
            inverse,
            count: 2 + self.shares,
        }
    }
}

/// Moves the first shares of a place by changes; returns those that remain.
#[inline(always)]
fn shifted(place: &mut Place<f64>, shares: usize, [s, t]: [f64; 2]) -> [f64; 2] {
    match shares {
        0 => [s, t],
        1 => {
            place.s -= s;
            [t, 0.0]
        }
        _ => {
            place.y[0] -= s;
            place.y[1] -= t;
            [0.0; 2]
        }
    }
}

/// Returns a touch less changes of the normal along two directions across it, and of the shares.
#[inline(always)]
pub fn moved(
    touch: &Touch<f64>,
    [p, q]: &[Vec3<f64>; 2],
    shares: [usize; 2],
    [x, y, s, t]: [f64; FEW],
) -> Touch<f64> {
    let mut next = *touch;
    let normal = touch.normal - *p * x - *q * y;
    next.normal = normal * (1.0 / normal.length_squared().sqrt());
    let rest = shifted(&mut next.a, shares[0], [s, t]);
    shifted(&mut next.b, shares[1], rest);
    next
}

/// Returns the step of Newton's method along a normal, with two directions across it: the equations and the changes; `None` if some equations depend on
/// each other.
#[inline(always)]
pub fn step(
    bends: [&Bend; 2],
    normal: Vec3<f64>,
    across: [Vec3<f64>; 2],
) -> Option<(BentPair, [f64; FEW])> {
    let [a, b] = bends;
    let way = b.at - a.at;
    let pair = BentPair::new(bends, across, normal.dot(way))?;
    let mut slopes = [0.0; 2];
    for (k, step) in a.steps[..a.shares].iter().enumerate() {
        slopes[k] = normal.dot(*step);
    }
    for (k, step) in b.steps[..b.shares].iter().enumerate() {
        *slopes.get_mut(a.shares + k)? = -normal.dot(*step);
    }
    let changes = pair.solve(across.each_as(|t| t.dot(way)), slopes);
    Some((pair, changes))
}
