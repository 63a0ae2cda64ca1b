//! Boxes as plain numbers, for bounds of distances.

/// The ends of a box: the least and the largest `x`, then those of `y`.
pub(crate) type Ends = [[f64; 2]; 2];

/// A box without points.
pub(crate) const NOWHERE: Ends = [[f64::INFINITY, f64::NEG_INFINITY]; 2];

/// Returns the interval around two; NaN in the second one counts for nothing.
#[inline(always)]
pub(crate) fn join(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let low = if b[0] < a[0] { b[0] } else { a[0] };
    [low, if b[1] > a[1] { b[1] } else { a[1] }]
}

/// Returns the box around two.
#[inline(always)]
pub(crate) fn joined(a: Ends, b: Ends) -> Ends {
    [0, 1].map(|k| join(a[k], b[k]))
}

/// Returns the squared distance of two boxes.
#[inline(always)]
pub(crate) fn squared_gap(a: Ends, b: Ends) -> f64 {
    let more = |a: f64, b: f64| if a > b { a } else { b };
    let gap = |a: [f64; 2], b: [f64; 2]| more(more(a[0] - b[1], b[0] - a[1]), 0.0);
    let (x, y) = (gap(a[0], b[0]), gap(a[1], b[1]));
    x * x + y * y
}
