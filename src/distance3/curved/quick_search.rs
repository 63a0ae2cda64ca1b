//! The touch of two solids that are clearly apart, where it is regular: most of them.
//!
//! An iteration by supports says after a few steps which pieces are near. Newton's step on these converges by the square;
//! where it does not, the iteration goes on. The same proof as of other searches decides: the gap of the supports along
//! the normal is the distance of two points of the solids. Solids that are apart have one least distance, so that it does
//! not matter how its place was guessed.
use super::super::gjk::{CodedDifference, Gap, gap_until};
use super::super::mix::Mix;
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
/// The distance above which solids are clearly apart, relative to the size.
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
    /// Returns the touch to which Newton's steps lead from the pieces that an iteration has reached, if it is proved to be
    /// the only one, and the equations about it.
    fn guessed(&self, gap: &Gap<CodedDifference>) -> Option<(Found, System<FEW>)> {
        let mut mixes = [Mix::default(); 2];
        let (mut on_a, mut on_b) = (Vec3::zero(), Vec3::zero());
        for (corner, weight) in gap.weighted() {
            mixes[0].add(corner.codes[0], weight);
            mixes[1].add(corner.codes[1], weight);
            on_a += corner.a * weight;
            on_b += corner.b * weight;
        }
        let normal = gap.way * (1.0 / gap.way.length_squared().sqrt());
        let (i, a) = self.a.likely(&mixes[0], on_a, normal)?;
        let (j, b) = self.b.likely(&mixes[1], on_b, -normal)?;
        let mut touch = Touch { normal, a, b };
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
                return self.proved([i, j], &touch).map(|found| (found, system));
            }
        }
        None
    }
    /// Returns the touch of two pieces with its value, if that is proved and the touch is the only one.
    fn proved(&self, pieces: [usize; 2], touch: &Touch<f64>) -> Option<Found> {
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
        let exact = error <= EXACT * self.size && value > APART * self.size && off <= LAST * LAST;
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
    /// Returns the only touch of solids that are clearly apart, and the equations about it, if it is found at once.
    pub fn quick(&self) -> Option<(Found, System<FEW>)> {
        let way = self.b.middle() - self.a.middle();
        let lowest = |way: Vec3<f64>| {
            let ((a, of_a), (b, of_b)) = (self.a.coded(way), self.b.coded(-way));
            CodedDifference {
                way: b - a,
                a,
                b,
                codes: [of_a, of_b],
            }
        };
        let length = way.length();
        let is_apart = length > APART * self.size;
        if !is_apart {
            return None;
        }
        let start = lowest(way);
        let (mut found, mut tried) = (None, 0);
        gap_until(lowest, start, way.dot(start.way) / length, |gap, off| {
            let due = tried < TRIES.len() && off <= TRIES[tried] && gap.least > 0.0;
            if due {
                while tried < TRIES.len() && off <= TRIES[tried] {
                    tried += 1;
                }
                found = self.guessed(gap);
            }
            found.is_some() || tried == TRIES.len()
        });
        found
    }
}
