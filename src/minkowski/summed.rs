//! Searches of Minkowski sums.
use super::sum_trace::{SumLaid, SumRings};
use super::{MinkowskiTrace, ValidMinkowskiTrace, valid_minkowski_replay};
use crate::boolean::{BooleanOperation, Owner, overlay_search, valid_search};
use crate::error::{Argument, Error, Field, Flaw};
use crate::offset::united;
use crate::polygon::{Fill, Polygon, Rings};
use crate::predicate::{Turn, turn_between, wide_place};
use crate::{Scalar, Vec2};
use std::collections::HashMap;

/// A ring that does not touch itself, with the numbers of its vertices.
struct SumRing {
    points: Vec<Vec2<f64>>,
    numbers: Vec<u32>,
    is_hole: bool,
}

impl SumRing {
    fn number(&self, k: usize) -> u32 {
        self.numbers[k % self.numbers.len()]
    }
    /// Returns both ends of the edge that leaves a vertex.
    fn edge(&self, k: usize) -> [Vec2<f64>; 2] {
        let n = self.points.len();
        [self.points[k % n], self.points[(k + 1) % n]]
    }
}

/// Returns the rings of a polygon, mirrored if asked for. A ring that touches itself in a vertex is several: one of them may
/// be around a hole.
fn rings<S: Scalar<Mask = bool>>(polygon: &Polygon<S>, is_mirrored: bool) -> Vec<SumRing> {
    let place = |v: Vec2<S>| {
        let at = wide_place(v);
        // Without negative zeros.
        Vec2::zero() + if is_mirrored { -at } else { at }
    };
    let points: Vec<_> = polygon.vertices().iter().map(|&v| place(v)).collect();
    let mut all = Vec::new();
    let mut first = 0;
    for ring in polygon.rings().iter() {
        // The vertices of the walk so far, and where each of their places is among them.
        let (mut open, mut places): (Vec<u32>, _) = (Vec::new(), HashMap::new());
        let key = |k: u32| [points[k as usize].x, points[k as usize].y].map(f64::to_bits);
        let mut add = |numbers: Vec<u32>| {
            let points: Vec<_> = numbers.iter().map(|&k| points[k as usize]).collect();
            let is_hole = crate::ring::signed_area(&points) < 0.0;
            if numbers.len() > 2 {
                all.push(SumRing {
                    points,
                    numbers,
                    is_hole,
                });
            }
        };
        for number in first..first + ring.len() as u32 {
            if let Some(&since) = places.get(&key(number)) {
                let own: Vec<u32> = open.split_off(since);
                for &k in &own {
                    places.remove(&key(k));
                }
                add(own);
            }
            places.insert(key(number), open.len());
            open.push(number);
        }
        add(open);
        first += ring.len() as u32;
    }
    all
}

/// Returns `1` if a direction is between those of two edges that follow each other, where they turn left; `-1` where they
/// turn right, else `0`. Of equal directions the one at the end counts, or with `from_start` the one at the start.
fn turns_over(
    before: [Vec2<f64>; 2],
    after: [Vec2<f64>; 2],
    way: [Vec2<f64>; 2],
    from_start: bool,
) -> i32 {
    let (low, high, sign) = match turn_between(before, after) {
        Turn::Left => (before, after, 1),
        Turn::Right => (after, before, -1),
        Turn::Straight => return 0,
    };
    let side = |a, b| match turn_between(a, b) {
        Turn::Left => Some(true),
        Turn::Right => None,
        Turn::Straight if (a[1] - a[0]).dot(b[1] - b[0]) > 0.0 => Some(false),
        Turn::Straight => None,
    };
    // `true` strictly between, `false` in line with an end.
    let is_between = match (side(low, way), side(way, high)) {
        (Some(true), Some(true)) => true,
        (Some(false), Some(true)) => from_start,
        (Some(true), Some(false)) => !from_start,
        _ => false,
    };
    if is_between { sign } else { 0 }
}

/// Adds the closed walks of the convolution of two rings.
fn convolve(a: &SumRing, b: &SumRing, to: &mut SumRings) {
    let (n, m) = (a.points.len(), b.points.len());
    // Steps of sums, from one pair of vertices to the next.
    let mut steps: Vec<[usize; 2]> = Vec::new();
    let state = |i: usize, j: usize| (i % n) * m + j % m;
    let mut add = |sign: i32, from: usize, to: usize| match sign {
        1 => steps.push([from, to]),
        -1 => steps.push([to, from]),
        _ => {}
    };
    for i in 0..n {
        for j in 0..m {
            // As if all directions of the second ring were turned left by an infinitely small angle.
            let of_a = turns_over(b.edge(j + m - 1), b.edge(j), a.edge(i), false);
            add(of_a, state(i, j), state(i + 1, j));
            let of_b = turns_over(a.edge(i + n - 1), a.edge(i), b.edge(j), true);
            add(of_b, state(i, j), state(i, j + 1));
        }
    }
    // As many steps end at a pair as begin there, so walks that use each step once close.
    steps.sort_unstable();
    let first_from = |from: usize| steps.partition_point(|step| step[0] < from);
    let mut used = vec![false; steps.len()];
    for start in 0..steps.len() {
        let (mut walk, mut k) = (Vec::new(), start);
        while !used[k] {
            used[k] = true;
            let [from, to] = steps[k];
            walk.push([a.number(from / m), b.number(from % m)]);
            let mut next = first_from(to);
            while next < steps.len() && steps[next][0] == to && used[next] {
                next += 1;
            }
            if next == steps.len() || steps[next][0] != to {
                break;
            }
            k = next;
        }
        if walk.len() > 2 {
            to.push(walk);
        }
    }
}

/// Returns the copies of all rings of one polygon at each vertex of the holes of another one. `flip` says that the copies
/// are of the first one.
fn copies(holes: &[SumRing], of: &[SumRing], flip: bool, to: &mut SumRings) {
    for hole in holes.iter().filter(|ring| ring.is_hole) {
        for k in 0..hole.points.len() {
            for ring in of {
                let pair = |j: usize| match flip {
                    false => [hole.number(k), ring.number(j)],
                    true => [ring.number(j), hole.number(k)],
                };
                to.push((0..ring.points.len()).map(pair).collect());
            }
        }
    }
}

fn laid<S: Scalar<Mask = bool>>(
    inputs: [Rings<'_, S>; 2],
    fill: Fill,
    is_mirrored: bool,
) -> Result<(SumLaid, [Polygon<S>; 2]), Error> {
    let one = |owner: Owner| {
        united(inputs[owner as usize], fill).map_err(|error| match (owner, error) {
            (Owner::B, Error::Invalid { item, flaw, .. }) => Error::Invalid {
                argument: Argument::B,
                item,
                flaw,
            },
            (_, other) => other,
        })
    };
    let mut laid = SumLaid {
        before: [one(Owner::A)?, one(Owner::B)?],
        is_mirrored,
        rings: Default::default(),
    };
    let polygons = laid.polygons(inputs);
    let [a, b] = [0, 1].map(|k| rings(&polygons[k], is_mirrored && k == 1));
    let [sums, whole] = &mut laid.rings;
    for one in &a {
        for other in &b {
            convolve(one, other, sums);
        }
    }
    copies(&a, &b, false, whole);
    copies(&b, &a, true, whole);
    let made = laid.inputs(&polygons);
    if !made
        .iter()
        .flat_map(Polygon::vertices)
        .all(|v| v.is_finite())
    {
        return Err(Error::Invalid {
            argument: Argument::B,
            item: 0,
            flaw: Flaw::Broken(Field::VALUE, "moves a vertex beyond the largest number"),
        });
    }
    // Walks there and back enclose nothing.
    for (own, made) in laid.rings.iter_mut().zip(&made) {
        let mut rings = made.rings().iter();
        own.retain(|_| {
            rings
                .next()
                .is_some_and(|ring| Rings::from(ring).validate().is_ok())
        });
    }
    let made = laid.inputs(&polygons);
    Ok((laid, made))
}

fn searched<S: Scalar<Mask = bool>>(
    inputs: [Rings<'_, S>; 2],
    fill: Fill,
    is_mirrored: bool,
) -> Result<MinkowskiTrace, Error> {
    let (laid, [a, b]) = laid(inputs, fill, is_mirrored)?;
    let result = overlay_search(&a, &b, BooleanOperation::Union, Fill::NonZero)?;
    Ok(MinkowskiTrace { laid, result })
}

fn valid_searched<S: Scalar<Mask = bool>>(
    inputs: [Rings<'_, S>; 2],
    fill: Fill,
    is_mirrored: bool,
) -> Result<ValidMinkowskiTrace, Error> {
    let (laid, [a, b]) = laid(inputs, fill, is_mirrored)?;
    let result = valid_search(&a, &b, BooleanOperation::Union, Fill::NonZero)?;
    Ok(ValidMinkowskiTrace { laid, result })
}

/// Returns the record of the Minkowski sum of two polygons of any kind. See the [module](super).
///
/// # Errors
///
/// [`Error::Invalid`] with the input and [`Flaw::Ring`] for a coordinate that is not finite and for a ring of fewer than
/// three distinct vertices; with the second one if a sum exceeds the largest number.
pub fn minkowski_search<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    fill: Fill,
) -> Result<MinkowskiTrace, Error> {
    searched([a.into(), b.into()], fill, false)
}

/// Returns the record of the no-fit polygon of two polygons of any kind: of all moves of the second one by which it touches
/// or overlaps the first one.
///
/// # Errors
///
/// See [`minkowski_search`].
pub fn no_fit_search<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    fill: Fill,
) -> Result<MinkowskiTrace, Error> {
    searched([a.into(), b.into()], fill, true)
}

/// Returns the record of a [`minkowski_sum`] that is valid by the OGC's rules.
///
/// # Errors
///
/// See [`minkowski_search`].
pub fn valid_minkowski_search<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    fill: Fill,
) -> Result<ValidMinkowskiTrace, Error> {
    valid_searched([a.into(), b.into()], fill, false)
}

/// Returns the record of a [`no_fit_polygon`] that is valid by the OGC's rules.
///
/// # Errors
///
/// See [`minkowski_search`].
pub fn valid_no_fit_search<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    fill: Fill,
) -> Result<ValidMinkowskiTrace, Error> {
    valid_searched([a.into(), b.into()], fill, true)
}

/// Returns the Minkowski sum of two polygons of any kind, as polygons that are valid by the OGC's rules: one per part, its
/// outer ring first, counter-clockwise, then its holes, clockwise. See the [module](super).
///
/// ```
/// use geograd::{Aabb2, Vec2, minkowski::minkowski_sum, polygon::{Fill, area}};
/// let square = Aabb2::new(0.0, 0.0, 2.0, 2.0).corners();
/// let diamond = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)].map(|(x, y)| Vec2::new(x, y));
/// let sum = minkowski_sum(&square, &diamond, Fill::NonZero)?;
/// // An octagon: the square, four rectangles and four triangles.
/// assert_eq!((sum[0].ring(0).len(), area(&sum[0])), (8, 4.0 + 8.0 + 2.0));
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Errors
///
/// See [`minkowski_search`].
pub fn minkowski_sum<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    fill: Fill,
) -> Result<Vec<Polygon<S>>, Error> {
    let (a, b) = (a.into(), b.into());
    valid_minkowski_search(a, b, fill).map(|trace| valid_minkowski_replay(a, b, &trace))
}

/// Returns the no-fit polygon of two polygons of any kind, as polygons that are valid by the OGC's rules: all moves of the
/// second one by which it touches or overlaps the first one. See the [module](super).
///
/// ```
/// use geograd::{Aabb2, minkowski::no_fit_polygon, polygon::{Fill, area}};
/// let (bin, part) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(0.0, 0.0, 1.0, 1.0).corners());
/// let moves = no_fit_polygon(&bin, &part, Fill::NonZero)?;
/// assert_eq!(area(&moves[0]), 25.0);
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Errors
///
/// See [`minkowski_search`].
pub fn no_fit_polygon<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    fill: Fill,
) -> Result<Vec<Polygon<S>>, Error> {
    let (a, b) = (a.into(), b.into());
    valid_no_fit_search(a, b, fill).map(|trace| valid_minkowski_replay(a, b, &trace))
}
