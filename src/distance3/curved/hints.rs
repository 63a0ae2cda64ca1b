//! The numbers that a search of curved solids hands to its replay, and the record of its decisions.
use super::piece::Place;
use super::solid_pair::Found;
use super::touch::{Frame, MOST, System, Touch, Units, lit};
use crate::arrays::Each;
use crate::{Scalar, Vec3};

/// The number of hints.
pub const HINTS: usize = 23 + MOST * MOST;

/// The decisions of a search of curved solids: the pieces that touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CurvedRecord {
    /// The numbers of the pieces; none for solids that are not finite.
    pub pieces: Option<[u32; 2]>,
    /// `true` if both places are on their pieces, which are stationary there.
    pub settled: bool,
}

/// The hints of a search of curved solids.
#[derive(Clone, Copy, Debug)]
pub struct Hints<S> {
    /// The units of the search.
    pub scale: S,
    /// For each solid one if the directions across its axis begin with that across x, zero if across y.
    pub by_x: [S; 2],
    /// The touch.
    pub touch: Touch<S>,
    /// The constants of the equations.
    pub frame: Frame<S>,
    /// The inverse of the matrix of the equations: changes of the unknowns by residuals.
    pub inverse: [[S; MOST]; MOST],
}

/// Reads numbers one after another.
struct Reader<'a, S>(&'a [S]);

impl<S: Scalar> Reader<'_, S> {
    fn one(&mut self) -> S {
        let (first, rest) = self.0.split_first().unwrap_or((&self.0[0], &[]));
        self.0 = rest;
        *first
    }
    fn two(&mut self) -> [S; 2] {
        [self.one(), self.one()]
    }
    fn vector(&mut self) -> Vec3<S> {
        Vec3::new(self.one(), self.one(), self.one())
    }
    fn place(&mut self) -> Place<S> {
        Place {
            y: [self.one(), self.one(), self.one()],
            s: self.one(),
            pull: self.one(),
        }
    }
}

impl<S: Scalar> Hints<S> {
    /// Returns the hints from a list.
    pub fn load(numbers: &[S; HINTS]) -> Self {
        let mut from = Reader(numbers);
        let (scale, by_x) = (from.one(), from.two());
        let touch = Touch {
            normal: from.vector(),
            a: from.place(),
            b: from.place(),
        };
        let first = from.vector();
        let (over, axis) = (from.two(), from.two());
        let mut inverse = [[S::zero(); MOST]; MOST];
        for (row, numbers) in inverse.iter_mut().zip(from.0.chunks_exact(MOST)) {
            row.copy_from_slice(numbers);
        }
        Hints {
            scale,
            by_x,
            touch,
            frame: Frame {
                tangents: [first, touch.normal.cross(first)],
                units: [0, 1].each_as(|k: usize| Units {
                    over: over[k],
                    axis: axis[k],
                }),
            },
            inverse,
        }
    }
    /// Returns the hints as a list.
    pub fn store(&self) -> [S; HINTS] {
        let Hints {
            scale,
            by_x: [by_x_of_a, by_x_of_b],
            touch: Touch { normal, a, b },
            frame,
            inverse,
        } = self;
        let (first, [of_a, of_b]) = (frame.tangents[0], &frame.units);
        let head: [&[S]; 8] = [
            &[*scale, *by_x_of_a, *by_x_of_b],
            &[normal.x, normal.y, normal.z],
            &a.y,
            &[a.s, a.pull],
            &b.y,
            &[b.s, b.pull],
            &[first.x, first.y, first.z],
            &[of_a.over, of_b.over, of_a.axis, of_b.axis],
        ];
        let mut all = [S::zero(); HINTS];
        let mut rest = &mut all[..];
        for numbers in head.into_iter().chain(inverse.iter().map(|row| &row[..])) {
            let (here, behind) = rest.split_at_mut(numbers.len());
            here.copy_from_slice(numbers);
            rest = behind;
        }
        all
    }
}

/// Returns a place of constants.
fn constant<S: Scalar>(place: &Place<f64>) -> Place<S> {
    Place {
        y: place.y.each_as(S::lit),
        s: S::lit(place.s),
        pull: S::lit(place.pull),
    }
}

/// Returns the hints of a touch, given the equations about it, the units, and how directions across axes begin.
#[inline]
pub fn of<S: Scalar, const N: usize>(
    found: &Found,
    system: &System<N>,
    scale: S,
    by_x: [S; 2],
) -> (CurvedRecord, Hints<S>) {
    let record = CurvedRecord {
        pieces: Some(found.pieces.map(|piece| piece as u32)),
        settled: found.settled,
    };
    let Frame { tangents, units } = &system.frame;
    // Numbers as constants whose squares are finite in the format.
    let most = S::format().largest().sqrt();
    let bounded = |x: f64| S::lit(x.clamp(-most, most));
    let mut inverse = [[S::zero(); MOST]; MOST];
    for (row, by) in inverse.iter_mut().zip(system.inverse()).take(system.count) {
        for (x, by) in row.iter_mut().zip(by).take(system.count) {
            *x = bounded(by);
        }
    }
    let hints = Hints {
        scale,
        by_x,
        touch: Touch {
            normal: lit(found.touch.normal),
            a: constant(&found.touch.a),
            b: constant(&found.touch.b),
        },
        frame: Frame {
            tangents: tangents.each_as(lit),
            units: units.each_as(|units| Units {
                over: bounded(units.over),
                axis: bounded(units.axis),
            }),
        },
        inverse,
    };
    (record, hints)
}

/// Returns the record and hints of solids that are not finite: units of one, the others zero.
pub fn none<S: Scalar>() -> (CurvedRecord, Hints<S>) {
    let record = CurvedRecord {
        pieces: None,
        settled: false,
    };
    let mut all = [S::zero(); HINTS];
    all[0] = S::one();
    (record, Hints::load(&all))
}
