//! Gradients of the measures of paths of curves, and of distances from them, in time linear in the number of steps.
use crate::ad::forward::{First, gradient};
use crate::curve::{CurvePath, CurvePiece, CurvePlace};
use crate::{Pack, Real, Scalar, Vec2};

/// Returns the path with the place of every number in the list of all.
fn numbered<S: Real>(path: &CurvePath<S>) -> CurvePath<f64> {
    let mut next = 0.0;
    path.remake(&mut |_| {
        next += 1.0;
        next - 1.0
    })
}

/// Adds the numbers of a shape to those of a list at the places that a numbered shape has.
fn add<S: Real>(to: &mut [S], places: &impl Pack<Scalar = f64>, by: &impl Pack<Scalar = S>) {
    for (place, by) in places.scalars().into_iter().zip(by.scalars()) {
        to[place as usize] += by;
    }
}

/// Returns the [length](CurvePath::length) of a path and its derivatives by every number.
///
/// ```
/// use geograd::{Vec2, ad::adjoint::curve_bars::length_grad, curve::CurvePath};
/// let path = CurvePath::at(Vec2::new(0.0, 0.0)).line_to(Vec2::new(0.0, 5.0));
/// let (length, by) = length_grad(&path);
/// assert_eq!((length, by), (5.0, CurvePath::at(Vec2::new(0.0, -1.0)).line_to(Vec2::new(0.0, 1.0))));
/// ```
#[must_use]
pub fn length_grad<S: Real>(path: &CurvePath<S>) -> (S, CurvePath<S>) {
    let (lengths, by) = pulled_lengths(path, |_| S::one());
    let sum = lengths
        .into_iter()
        .fold(S::zero(), |sum, length| sum + length);
    (sum.canonical(), by)
}

/// Returns the [length of each piece](CurvePath::lengths) of a path, and its cotangents from those of the lengths.
///
/// ```
/// use geograd::{Vec2, ad::adjoint::curve_bars::lengths_vjp, curve::CurvePath};
/// let at = |x: f64, y| Vec2::new(x, y);
/// let path = CurvePath::at(at(0.0, 0.0)).line_to(at(0.0, 5.0)).line_to(at(2.0, 5.0));
/// let (lengths, by) = lengths_vjp(&path, &[1.0, 10.0]);
/// assert_eq!(lengths, [5.0, 2.0]);
/// assert_eq!(by, CurvePath::at(at(0.0, -1.0)).line_to(at(-10.0, 1.0)).line_to(at(10.0, 0.0)));
/// ```
///
/// # Panics
///
/// When there are fewer cotangents than pieces.
#[must_use]
pub fn lengths_vjp<S: Real>(path: &CurvePath<S>, upstream: &[S]) -> (Vec<S>, CurvePath<S>) {
    pulled_lengths(path, |piece| upstream[piece])
}

fn pulled_lengths<S: Real>(
    path: &CurvePath<S>,
    upstream: impl Fn(usize) -> S,
) -> (Vec<S>, CurvePath<S>) {
    let mut bars = vec![S::zero(); path.count()];
    let mut lengths = Vec::new();
    for (number, (piece, places)) in path.pieces().zip(numbered(path).pieces()).enumerate() {
        let (length, by) = gradient(CurvePiece::length, piece);
        lengths.push(length);
        let bar = upstream(number);
        add(&mut bars, &places, &by.remake(&mut |x| *x * bar));
    }
    (lengths, path.refill(&bars))
}

/// Returns the [signed area](CurvePath::signed_area) of a path and its derivatives by every number.
///
/// ```
/// use geograd::{Circle, Vec2, ad::adjoint::curve_bars::signed_area_grad, curve::CurvePath};
/// let wheel = CurvePath::circle(Circle::new(Vec2::new(5.0_f64, 1.0), 2.0));
/// let (area, by) = signed_area_grad(&wheel);
/// assert_eq!(area, wheel.signed_area());
/// assert!(by.elements().len() == 4);
/// ```
#[must_use]
pub fn signed_area_grad<S: Real>(path: &CurvePath<S>) -> (S, CurvePath<S>) {
    let mut bars = vec![S::zero(); path.count()];
    for (own, places) in path.started_pieces().zip(numbered(path).started_pieces()) {
        let area = |(piece, start): (CurvePiece<_>, Vec2<_>)| {
            let chord: First<S> = (piece.start() - start).perp_dot(piece.end() - start);
            piece.signed_area() + chord.halved()
        };
        add(&mut bars, &places, &gradient(area, own).1);
    }
    (path.signed_area(), path.refill(&bars))
}

/// Returns the cotangents of a path and of points, from those of the distances of the points from the places that a
/// [search](CurvePath::closest) found. A distance of zero has none.
///
/// ```
/// use geograd::{Vec2, ad::adjoint::curve_bars::distances_vjp, curve::CurvePath};
/// let path = CurvePath::at(Vec2::new(0.0, 0.0)).line_to(Vec2::new(4.0, 0.0));
/// let point = Vec2::new(1.0, 2.0);
/// let place = path.closest(point).expect("it has a piece");
/// let (by_path, by_points) = distances_vjp(&path, &[point], &[place], &[1.0]);
/// assert_eq!(by_path, CurvePath::at(Vec2::new(0.0, -0.75)).line_to(Vec2::new(0.0, -0.25)));
/// assert_eq!(by_points, [Vec2::new(0.0, 1.0)]);
/// ```
///
/// # Panics
///
/// When the path has no such piece, or there are fewer places or cotangents than points.
#[must_use]
pub fn distances_vjp<S: Real>(
    path: &CurvePath<S>,
    points: &[Vec2<S>],
    places: &[CurvePlace],
    upstream: &[S],
) -> (CurvePath<S>, Vec<Vec2<S>>) {
    let mut bars = vec![S::zero(); path.count()];
    let pieces: Vec<_> = path.pieces().zip(numbered(path).pieces()).collect();
    let mut of_point = |k: usize| {
        let (piece, numbers) = pieces[places[k].piece];
        let distance =
            |(piece, point): (CurvePiece<_>, Vec2<_>)| piece.distance_replay(point, places[k]);
        let (_, (by, by_point)) = gradient(distance, (piece, points[k]));
        add(&mut bars, &numbers, &by.remake(&mut |x| *x * upstream[k]));
        by_point * upstream[k]
    };
    let by_points = (0..points.len()).map(&mut of_point).collect();
    (path.refill(&bars), by_points)
}
