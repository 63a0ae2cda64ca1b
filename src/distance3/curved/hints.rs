//! The numbers that a search of curved solids hands to its replay, and the record of its decisions.
use super::piece::Place;
use super::solid_pair::Found;
use super::touch::{Constants, Frame, MOST, Touch, Units};
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
pub struct Hints<'a, S> {
    /// The units of the search.
    pub scale: S,
    /// For each solid one if the directions across its axis begin with that across x, zero if across y.
    pub by_x: [S; 2],
    /// The touch.
    pub touch: Touch<S>,
    /// The constants of the equations.
    pub frame: Frame<S>,
    /// The inverse of the matrix of the equations, row by row: changes of the unknowns by residuals.
    pub inverse: &'a [S],
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

impl<'a, S: Scalar> Hints<'a, S> {
    /// Returns the hints from a list.
    pub fn load(numbers: &'a [S; HINTS]) -> Self {
        let mut from = Reader(numbers);
        let (scale, by_x) = (from.one(), from.two());
        let touch = Touch {
            normal: from.vector(),
            a: from.place(),
            b: from.place(),
        };
        let first = from.vector();
        let (over, axis) = (from.two(), from.two());
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
            inverse: from.0,
        }
    }
}

/// Returns the record of a touch and the list of its hints, given the constants of its replay, the units, and how directions
/// across axes begin.
#[inline]
pub fn of<S: Scalar, const N: usize>(
    found: &Found,
    constants: &Constants<N>,
    scale: S,
    by_x: [S; 2],
) -> (CurvedRecord, [S; HINTS]) {
    let record = CurvedRecord {
        pieces: Some(found.pieces.map(|piece| piece as u32)),
        settled: found.settled,
    };
    let Touch { normal, a, b } = &found.touch;
    let (first, [of_a, of_b]) = (constants.frame.tangents[0], &constants.frame.units);
    let mut all = [S::zero(); HINTS];
    (all[0], all[1], all[2]) = (scale, by_x[0], by_x[1]);
    let head = [
        [normal.x, normal.y, normal.z],
        a.y,
        [a.s, a.pull, b.y[0]],
        [b.y[1], b.y[2], b.s],
        [b.pull, first.x, first.y],
    ];
    for (place, &x) in all[3..].iter_mut().zip(head.as_flattened()) {
        *place = S::lit(x);
    }
    all[18] = S::lit(first.z);
    // Numbers as constants whose squares are finite in the format.
    let most = S::format().largest().sqrt();
    let bounded = |x: f64| S::lit(x.clamp(-most, most));
    let units = [of_a.over, of_b.over, of_a.axis, of_b.axis];
    for (place, x) in all[19..].iter_mut().zip(units) {
        *place = bounded(x);
    }
    let rows = all[HINTS - MOST * MOST..].chunks_exact_mut(MOST);
    for (row, by) in rows.zip(&constants.inverse).take(constants.count) {
        for (place, x) in row.iter_mut().zip(by).take(constants.count) {
            *place = bounded(*x);
        }
    }
    (record, all)
}

/// Returns the record and hints of solids that are not finite: units of one, the others zero.
pub fn none<S: Scalar>() -> (CurvedRecord, [S; HINTS]) {
    let record = CurvedRecord {
        pieces: None,
        settled: false,
    };
    let mut all = [S::zero(); HINTS];
    all[0] = S::one();
    (record, all)
}
