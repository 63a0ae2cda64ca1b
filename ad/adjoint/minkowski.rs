//! Adjoint of Minkowski sums: cotangents of the vertices of a result go back to both polygons.
use super::boolean::{overlay_vjp, valid_vjp};
use super::offset::pulled_before;
use crate::minkowski::{MinkowskiTrace, SumLaid, ValidMinkowskiTrace};
use crate::polygon::Rings;
use crate::{Polygon, Scalar, Vec2};

/// Writes the cotangents of both inputs of [`minkowski_replay`](crate::minkowski::minkowski_replay), one per vertex, from
/// those of the vertices of the result, one ring after the other.
///
/// The union passes a cotangent to sums of two vertices, and a sum to both of these; a mirrored one gets the negative.
///
/// # Panics
///
/// When the record is of other inputs, or a list of cotangents is too short.
pub fn minkowski_vjp<'a, S: Scalar>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    trace: &MinkowskiTrace,
    out_bar: &[Vec2<S>],
    a_bar: &mut [Vec2<S>],
    b_bar: &mut [Vec2<S>],
) {
    let of_result = |a: &Polygon<S>, b: &Polygon<S>, to_a: &mut [_], to_b: &mut [_]| {
        overlay_vjp(a, b, &trace.result, out_bar, to_a, to_b);
    };
    pulled([a.into(), b.into()], &trace.laid, of_result, [a_bar, b_bar]);
}

/// Writes the cotangents of both inputs of [`valid_minkowski_replay`](crate::minkowski::valid_minkowski_replay), one per
/// vertex, from those of the vertices of the result, one part and one ring after the other.
///
/// # Panics
///
/// When the record is of other inputs, or a list of cotangents is too short.
pub fn valid_minkowski_vjp<'a, S: Scalar>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    trace: &ValidMinkowskiTrace,
    out_bar: &[Vec2<S>],
    a_bar: &mut [Vec2<S>],
    b_bar: &mut [Vec2<S>],
) {
    let of_result = |a: &Polygon<S>, b: &Polygon<S>, to_a: &mut [_], to_b: &mut [_]| {
        valid_vjp(a, b, &trace.result, out_bar, to_a, to_b);
    };
    pulled([a.into(), b.into()], &trace.laid, of_result, [a_bar, b_bar]);
}

fn pulled<S: Scalar>(
    inputs: [Rings<'_, S>; 2],
    laid: &SumLaid,
    of_result: impl FnOnce(&Polygon<S>, &Polygon<S>, &mut [Vec2<S>], &mut [Vec2<S>]),
    into: [&mut [Vec2<S>]; 2],
) {
    let polygons = laid.polygons(inputs);
    let sums = laid.inputs(&polygons);
    let zeros = |of: &Polygon<S>| vec![Vec2::zero(); of.vertices().len()];
    let mut sum_bars = [zeros(&sums[0]), zeros(&sums[1])];
    let [to_a, to_b] = &mut sum_bars;
    of_result(&sums[0], &sums[1], to_a, to_b);
    let mut bars = [zeros(&polygons[0]), zeros(&polygons[1])];
    for (rings, sum_bars) in laid.rings.iter().zip(&sum_bars) {
        for (&[i, j], &bar) in rings.iter().flatten().zip(sum_bars) {
            bars[0][i as usize] += bar;
            bars[1][j as usize] += if laid.is_mirrored { -bar } else { bar };
        }
    }
    for (k, to) in into.into_iter().enumerate() {
        pulled_before(inputs[k], &laid.before[k], &bars[k], to);
    }
}
