//! How far results of a GPU may lie from those of the CPU: derived, not tuned.
use crate::shapes::{Draw, Draws, Score, fields};
use geograd::overlap::Denominator;
use geograd::{Fixed, Pack};

pub const EPSILON: f64 = f32::EPSILON as f64;

/// Roundings on the longest way from an input to a result, each of at most an epsilon: six for the
/// place of a centre, three for a corner, four for the end of an edge, a division (two and a half
/// on a GPU), and sums of eight terms. A GPU may fuse or not where the CPU does the other.
pub const ROUNDINGS: f64 = 32.0;

/// How far results of a pair may lie apart.
///
/// An area of intersection changes by the displacement of its border times its length. With L the
/// longest side of both boxes, W the larger of their shorter sides, and l the longer side of the
/// smaller box: short sides and edges across are displaced by at most k·ε·L along a border of at
/// most min(W, l); long edges by k·ε·W, and by 2⁻³⁵·L for the relative heading, whose products
/// carry low parts, along at most l. A ratio divides that by its denominator and adds its own
/// roundings.
pub fn value_bound<O: Score>(a: O::Shape, b: O::Shape, value: f64) -> f64 {
    let ((long_a, short_a), (long_b, short_b)) = (a.sides(), b.sides());
    let (long, small) = (long_a.max(long_b), long_a.min(long_b));
    let wide = short_a.max(short_b).min(small);
    let border = ROUNDINGS * (2.0 * EPSILON * long * wide + (-35_f64).exp2() * long * small);
    let over = match O::OVER {
        Denominator::None => return border + ROUNDINGS * EPSILON * value,
        Denominator::Union => (long_a * short_a).max(long_b * short_b),
        Denominator::First => long_a * short_a,
    };
    let share = if over > 0.0 { 2.0 * border / over } else { 0.0 };
    (share + ROUNDINGS * EPSILON).min(1.0)
}

/// The same numbers up to how a driver compiled another kernel around the same function.
pub fn close(x: f32, y: f32) -> bool {
    (f64::from(x) - f64::from(y)).abs() <= ROUNDINGS * EPSILON * f64::from(y).abs().max(1e-3)
}

/// The derivatives of a pair in `f64`, the fields of b after those of a.
fn wide_derivatives<O: Score>(a: &[f64], b: &[f64]) -> Vec<f64> {
    let pair = O::In::<f64>::load(&[a, b].concat());
    let one = O::Out::<f64>::filled(1.0);
    O::adjoint::<f64>(pair, one).map_or(Vec::new(), |found: (O::Out<f64>, O::In<f64>)| {
        found.1.scalars()
    })
}

/// How far each derivative may lie from the CPU's: both are the exact derivatives of inputs moved by at most
/// k·ε of the longest side (rounding is a displacement of borders), and round a few times
/// themselves. Derivatives jump at kinks, so inputs are moved every which way and the spread is taken,
/// except where rounding has no say in which side of a kink it is.
/// A ratio's derivative with respect to a size is the difference of two terms as large as the ratio over
/// that size, which may cancel; an area's is one of lengths of borders up to the longer side of the smaller box.
pub fn derivative_bounds<O: Score>(
    a: O::Shape,
    b: O::Shape,
    value: f64,
    draws: &mut Draws,
) -> Vec<f64> {
    let (a_fields, b_fields) = (fields(a), fields(b));
    let exact = wide_derivatives::<O>(&a_fields, &b_fields);
    let reach = ROUNDINGS * EPSILON * a.sides().0.max(b.sides().0);
    let mut spread: Vec<f64> = vec![0.0; exact.len()];
    let trials = if a.decides_exactly(b) { 0 } else { 24 };
    for trial in 0..trials {
        let size = reach * 0.25_f64.powi(trial % 3);
        let mut moved = |fields: &[f64]| -> Vec<f64> {
            let step = |(k, &x): (usize, &f64)| {
                let by = size * (2.0 * f64::from(draws.next()) - 1.0);
                // Sizes stay positive; a heading is displaced relative to the sides.
                match (O::Shape::LEN, k) {
                    (5, 2 | 3) => x + by.abs(),
                    (5, 4) => x + by / reach.max(1e-30) * ROUNDINGS * EPSILON,
                    _ => x + by,
                }
            };
            fields.iter().enumerate().map(step).collect()
        };
        let near = wide_derivatives::<O>(&moved(&a_fields), &moved(&b_fields));
        for ((spread, exact), near) in spread.iter_mut().zip(&exact).zip(&near) {
            *spread = spread.max((exact - near).abs());
        }
    }
    let largest = exact.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let term = |shape: O::Shape| match shape.sides().1 {
        _ if O::OVER == Denominator::None => a.sides().0.min(b.sides().0),
        short if short > 0.0 => value / short,
        _ => 0.0,
    };
    let terms = largest.max(term(a)).max(term(b));
    let bound = |x: &f64| 2.0 * x + ROUNDINGS * EPSILON * terms;
    spread.iter().map(bound).collect()
}
