//! The touch of two solids that are clearly apart, or overlap clearly, where it is regular: most of them.
//!
//! An iteration by supports says after a few steps which pieces are near. Newton's step on these converges by the square;
//! where it does not, the iteration goes on. The same proof as of other searches decides: the gap of the supports along
//! the normal is the distance of two points of the solids. Solids that are apart have one least distance, so that it does
//! not matter how its place was guessed. Solids that overlap have other directions, too: an expansion bounds their depth,
//! and directions beside the touch and around the axes are tried, as in the full search.
use super::super::gjk::{CodedDifference, gap_until, of_triangle};
use super::super::mix::Mix;
use super::expand::exits;
use super::piece::{Piece, PieceKind, Place};
use super::solid_pair::{Found, Solids};
use super::touch::{FEW, System, Touch};
use crate::Vec3;

/// The relative gaps of both bounds of the squared distance at which Newton's steps are tried.
const TRIES: [f64; 3] = [5e-2, 1e-3, 1e-5];
/// The number of Newton's steps of a try.
const STEPS: usize = 6;
/// The length of the last step, whose square is none.
const LAST: f64 = 1e-7;
/// The error up to which a touch is exact, relative to the size.
const EXACT: f64 = 1e-13;
/// The distance above which solids are clearly apart, and the depth of those that clearly overlap, relative to the size.
const APART: f64 = 1e-6;

/// Returns the dimension of a piece that has a flat part.
fn dimension(kind: PieceKind) -> usize {
    match kind {
        PieceKind::Face => 2,
        PieceKind::Line | PieceKind::Side | PieceKind::Ruled => 1,
        PieceKind::Point | PieceKind::Rim | PieceKind::Ball | PieceKind::Own => 0,
    }
}

/// Returns by how much clamping has moved a place.
fn shift(p: &Place<f64>, q: &Place<f64>) -> f64 {
    (p.y[0] - q.y[0]).abs() + (p.y[1] - q.y[1]).abs() + (p.s - q.s).abs()
}

impl Solids<'_> {
    /// Returns the touch to which Newton's steps lead from a normal and the pieces that points are on whose weighted mean is
    /// the nearest one, if it is proved, and the equations about it. In the last try less likely pieces count, too.
    fn guessed<'d>(
        &self,
        normal: Vec3<f64>,
        weighted: impl Iterator<Item = (&'d CodedDifference, f64)>,
        side: f64,
        is_last: bool,
    ) -> Option<(Found, System<FEW>)> {
        let mut mixes = [Mix::default(); 2];
        let (mut on_a, mut on_b) = (Vec3::zero(), Vec3::zero());
        for (corner, weight) in weighted {
            mixes[0].add(corner.codes[0], weight);
            mixes[1].add(corner.codes[1], weight);
            on_a += corner.a * weight;
            on_b += corner.b * weight;
        }
        let attempt = |of_a: Option<(usize, Place<f64>)>, of_b: Option<(usize, Place<f64>)>| {
            let ((i, a), (j, b)) = (of_a?, of_b?);
            self.stepped([i, j], Touch { normal, a, b }, side)
        };
        let of_a = self.a.likely(&mixes[0], on_a, normal);
        let of_b = self.b.likely(&mixes[1], on_b, -normal);
        let found = attempt(of_a, of_b);
        if found.is_some() || !is_last {
            return found;
        }
        let or_a = self.a.less_likely(&mixes[0], on_a, normal);
        let or_b = self.b.less_likely(&mixes[1], on_b, -normal);
        attempt(or_a, of_b)
            .or_else(|| attempt(of_a, or_b))
            .or_else(|| attempt(or_a, or_b))
    }
    /// Returns the touch of two pieces to which Newton's steps lead from a first one, if it is proved, and the equations
    /// about it.
    fn stepped(
        &self,
        [i, j]: [usize; 2],
        mut touch: Touch<f64>,
        side: f64,
    ) -> Option<(Found, System<FEW>)> {
        for _ in 0..STEPS {
            let [of_a, of_b] = self.pieces([i, j], touch.normal);
            let mut system: System<FEW> = System::equations([&of_a, &of_b], &touch);
            let residuals = system.frame.residuals([&of_a, &of_b], &touch);
            let changes = match system.solve_two(&residuals) {
                Some(changes) => changes,
                None => {
                    system.decompose();
                    if system.rank < system.count {
                        return None;
                    }
                    system.solve(&residuals)
                }
            };
            let square = changes.iter().map(|x| x * x).sum::<f64>();
            if !square.is_finite() {
                return None;
            }
            let (limit, kinds) = (0.5 / square.max(0.25).sqrt(), [of_a.kind, of_b.kind]);
            touch = system
                .frame
                .moved(kinds, &touch, &changes.map(|x| x * limit));
            if square <= LAST * LAST {
                if system.rank == 0 {
                    system.decompose();
                }
                let found = self.proved([i, j], &touch, side);
                return found.map(|found| (found, system));
            }
        }
        None
    }
    /// Returns the touch of two pieces with its value, if that is proved, and clear, with the sign of a side, and no other
    /// points are as near along its normal.
    fn proved(&self, pieces: [usize; 2], touch: &Touch<f64>, side: f64) -> Option<Found> {
        let normal = touch.normal;
        let value = self.value(normal);
        let on = Touch {
            normal,
            a: self.a.clamped(pieces[0], &touch.a),
            b: self.b.clamped(pieces[1], &touch.b),
        };
        let [a, b]: [Piece<f64>; 2] = self.pieces(pieces, normal);
        let error = ((b.at(&on.b) - a.at(&on.a)) - normal * value)
            .length_squared()
            .sqrt();
        let off = shift(&touch.a, &on.a) + shift(&touch.b, &on.b);
        let clear = value * side > APART * self.size;
        let exact = error <= EXACT * self.size && clear && off <= LAST * LAST;
        if !exact {
            return None;
        }
        let own = [dimension(a.kind), dimension(b.kind)];
        let slack = EXACT * self.size;
        let flat = [
            self.a.flatness(normal, slack),
            self.b.flatness(-normal, slack),
        ];
        let level = flat[0] > 0 && flat[1] > 0 && flat != own;
        let plain = self.a.is_plain(normal, own[0]) && self.b.is_plain(-normal, own[1]);
        // Newton's steps may have turned the normal to where a flat ellipsoid or a needle jumps from end to end.
        let [i, j] = pieces;
        let steady = self.a.is_steady(i, normal) && self.b.is_steady(j, -normal);
        (steady && plain && !level).then_some(Found {
            pieces,
            touch: on,
            value,
            error,
            regular: true,
            settled: true,
        })
    }
    /// Returns the point of b less a that is the lowest along a vector, with codes.
    pub(super) fn lowest_coded(&self, way: Vec3<f64>) -> CodedDifference {
        let ((a, of_a), (b, of_b)) = (self.a.coded(way), self.b.coded(-way));
        CodedDifference {
            way: b - a,
            a,
            b,
            codes: [of_a, of_b],
        }
    }
    /// Returns the touch of solids that are clearly apart or overlap clearly, and the equations about it, if it is found at
    /// once.
    pub fn quick(&self) -> Option<(Found, System<FEW>)> {
        let way = self.b.middle() - self.a.middle();
        let length = way.length();
        let is_apart = length > APART * self.size;
        if !is_apart {
            return None;
        }
        let start = self.lowest_coded(way);
        let (mut found, mut tried) = (None, 0);
        let least = way.dot(start.way) / length;
        let seen = gap_until(
            |way| self.lowest_coded(way),
            start,
            least,
            |gap, off| {
                let due = tried < TRIES.len() && off <= TRIES[tried] && gap.least > 0.0;
                if due {
                    while tried < TRIES.len() && off <= TRIES[tried] {
                        tried += 1;
                    }
                    let normal = gap.way * (1.0 / gap.way.length_squared().sqrt());
                    found = self.guessed(normal, gap.weighted(), 1.0, tried == TRIES.len());
                }
                found.is_some() || tried == TRIES.len()
            },
        );
        match seen.inside {
            true => self.quick_overlap(),
            false => found,
        }
    }
    /// Returns the touch of solids that clearly overlap, and the equations about it, if it is found at once and no other
    /// direction is better.
    fn quick_overlap(&self) -> Option<(Found, System<FEW>)> {
        let exits = exits(&|way| self.lowest_coded(way));
        let (best, corners) = (exits.all[0], exits.face?);
        let (weights, _) = of_triangle(corners.map(|corner| corner.way));
        let weighted = corners.iter().zip(weights);
        let weighted = weighted.filter(|(_, weight)| *weight > 0.0);
        let (found, system) = self.guessed(best.normal, weighted, -1.0, true)?;
        let depth = -found.value;
        let deepest = depth <= best.depth + EXACT * self.size;
        let alone = exits.all[1..].iter().all(|exit| exit.depth >= depth);
        let none_better = || {
            self.better(&found)
                .or_else(|| self.around(&found))
                .is_none()
        };
        (deepest && alone && none_better()).then_some((found, system))
    }
}
