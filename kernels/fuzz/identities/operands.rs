//! The arguments of an identity: the ranges of their numbers, and their drawing.
use crate::Real;
use crate::ad::check::symmetry::moved_by;
use crate::ad::declared::{Kind, Motion};
use crate::ad::sample::Draw;
use crate::ad::sample::lattice::{lattice, places};
use crate::kernels::fuzz::tested::Tested;
use std::ops::Range;

/// The ranges of the numbers of two arguments.
#[derive(Clone, Debug)]
pub(super) struct ArgumentRanges {
    kinds: Vec<Kind>,
    /// The index of the first number of the second argument.
    second: usize,
    /// The number of coordinates of a point: 2 in the plane, 3 in space.
    pub dimension: usize,
    /// `true` for Bézier curves as second argument, on which only the first and the last of their points are.
    has_controls: bool,
}

impl ArgumentRanges {
    /// Returns the parts of a row with two arguments of fixed size in the plane or in space.
    pub fn of(row: &Tested) -> Option<Self> {
        let kinds = (row.operation.kinds[0])();
        let layouts = row.operation.layouts::<f64>();
        let [a, b] = &layouts[..] else { return None };
        let has = |kind| kinds.contains(&kind);
        let dimension = match (
            has(Kind::Y) || has(Kind::DirectionY),
            has(Kind::Z) || has(Kind::DirectionZ),
        ) {
            (_, true) => 3,
            (true, false) => 2,
            _ => return None,
        };
        (a.fields() + b.fields() == kinds.len()).then(|| ArgumentRanges {
            second: a.fields(),
            kinds,
            dimension,
            has_controls: matches!(&b.name()[..], "Quadratic2" | "Cubic2"),
        })
    }

    /// Returns the range of an argument's numbers.
    pub fn range(&self, k: usize) -> Range<usize> {
        match k {
            0 => 0..self.second,
            _ => self.second..self.kinds.len(),
        }
    }

    /// Returns the ranges of the points of the second argument that belong to it: centres, ends and vertices.
    pub fn own_points(&self) -> Vec<Range<usize>> {
        let range = self.range(1);
        let mut places = places(&self.kinds[range.clone()]);
        if self.has_controls {
            places = [places[0], places[places.len() - 1]].into();
        }
        let place = |(at, n)| range.start + at..range.start + at + n;
        places.into_iter().map(place).collect()
    }

    /// Returns the numbers of an argument shrunk to its first point; `None` for unbounded shapes.
    pub fn shrunk(&self, x: &[f64], k: usize) -> Option<(Vec<f64>, Vec<f64>)> {
        let range = self.range(k);
        let endless = |kind: &Kind| {
            matches!(
                kind,
                Kind::DirectionX
                    | Kind::DirectionY
                    | Kind::DirectionZ
                    | Kind::Offset
                    | Kind::Number
            )
        };
        let kinds = &self.kinds[range.clone()];
        if kinds.iter().any(endless) {
            return None;
        }
        let (first, n) = *places(kinds).first()?;
        let mut shape = x[range].to_vec();
        let point = shape[first..first + n].to_vec();
        for (at, n) in places(kinds) {
            shape[at..at + n].copy_from_slice(&point[..n]);
        }
        for (x, kind) in shape.iter_mut().zip(kinds) {
            if *kind == Kind::Length {
                *x = 0.0;
            }
        }
        Some((shape, point))
    }

    /// Returns `true` for an input that the row accepts and for which it declares properties.
    pub fn is_valid<T: Real>(&self, row: &Tested, x: &[f64]) -> bool {
        let numbers: Vec<T> = x.iter().map(|&x| T::lit(x)).collect();
        let layouts = row.operation.layouts::<T>();
        (0..2).all(|k| layouts[k].check(&numbers[self.range(k)]).is_ok())
            && row.operation.is_inside(x)
    }

    /// Returns a random input in a format; `None` if the numbers are not valid.
    pub fn draw<T: Real>(&self, row: &Tested, draw: &mut Draw) -> Option<Vec<f64>> {
        let mut x = lattice(&self.kinds, draw);
        match draw.below(4) {
            // Rotated and moved as a whole, so that equal numbers differ by rounding.
            0 => {
                let turn = match self.dimension {
                    2 => Motion::Rotation,
                    _ => [Motion::RotationX, Motion::RotationY, Motion::Rotation][draw.below(3)],
                };
                x = moved_by(turn, draw.within(-3.0, 3.0), &self.kinds, &x);
                x = moved_by(
                    Motion::TranslationX,
                    draw.within(-1.0, 1.0),
                    &self.kinds,
                    &x,
                );
            }
            // A few roundings off the grid, or thin.
            1 => {
                let by = T::format().epsilon() * draw.magnitude(0.5, 64.0);
                for (x, kind) in x.iter_mut().zip(&self.kinds) {
                    if kind.is_place() && draw.once_in(2) {
                        *x += by * (draw.below(3) as f64 - 1.0);
                    }
                }
            }
            _ => {}
        }
        let x: Vec<f64> = x.into_iter().map(|x| T::lit(x).widen()).collect();
        self.is_valid::<T>(row, &x).then_some(x)
    }
}
