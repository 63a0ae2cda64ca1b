//! The search for the features of two hulls that decide about their relation.
use super::super::gjk::{CornerDifference, Gap, gap};
use super::super::mix::Mix;
use super::body::{BEYOND, Body, across};
use super::expansion;
use super::highest_point::{PointColumns, PointGroups};
use super::hull_record::{FeaturePair, HullFeatures, HullRecord, around, spanning};
use super::near_features::{edges, from_edge, long, nearest, of_edges};
use super::parting_planes as planes;
use super::patch;
use crate::Vec3;
use crate::arrays::Each;

/// The share of the size above which hulls are certainly apart, or overlap.
const CLEAR: f64 = 1e-3;
/// The share of the size above which hulls are apart, or overlap, whose features are proved, and so many roundings.
const APART: f64 = 1e-7;
/// The height over the lowest corner below which a corner may be nearest, where hulls are clearly apart.
const LOW: f64 = 1e-11;
/// The error of heights along a vector of length one.
const DIGITS: f64 = 8.0 * f64::EPSILON;
/// The share of the size by which distances may differ that are equal: some roundings of `f64`, which decides in every
/// format.
const TIED: f64 = 8.0 * f64::EPSILON;
/// The number of roundings that a distance may have if planes decide the direction.
const TOUCH: f64 = 32.0;

/// The corners of two hulls as columns, relative to the first one, in units of a power of two in which the largest
/// coordinate is about one.
pub(super) struct HullPair {
    groups: PointGroups,
    counts: [usize; 2],
    units: f64,
}

impl HullPair {
    /// Creates room for some numbers of corners, of both one at least.
    #[inline]
    pub fn new(counts: [usize; 2]) -> Self {
        HullPair {
            groups: PointGroups::with_room(counts),
            counts,
            units: 1.0,
        }
    }
    /// Writes the corners, in place. Returns `false` if one is not finite.
    #[inline]
    pub fn fill(&mut self, a: impl Fn(usize) -> Vec3<f64>, b: impl Fn(usize) -> Vec3<f64>) -> bool {
        let from = a(0);
        self.groups.add(self.counts[0], |k| a(k) - from);
        self.groups.add(self.counts[1], |k| b(k) - from);
        let units = self.groups.scale();
        self.units = units.unwrap_or(1.0);
        units.is_some()
    }
    fn columns(&self) -> [PointColumns<'_>; 2] {
        let [a, b] = self.counts;
        [self.groups.columns(0, a), self.groups.columns(a, b)]
    }
}

/// Returns the nearest points of two hulls, beginning with the vector between their middles.
fn nearest_points([a, b]: &[PointColumns<'_>; 2]) -> Gap<CornerDifference> {
    let lowest = |way: Vec3<f64>| {
        let (of_a, of_b) = (a.highest(way), b.highest(-way));
        CornerDifference {
            way: of_b.1 - of_a.1,
            a: of_a.0,
            b: of_b.0,
        }
    };
    let way = b.middle() - a.middle();
    let first = lowest(way);
    let length = way.length();
    let least = match length > 0.0 {
        true => first.way.dot(way) / length,
        false => 0.0,
    };
    gap(lowest, first, least)
}

/// Returns the features that decide about the relation of two hulls of plain numbers, which are replayed in a format
/// with this rounding, given their columns and a function that returns their corners.
pub(super) fn search(
    pair: &HullPair,
    corners: impl FnOnce() -> [Vec<Vec3<f64>>; 2],
    rounding: f64,
) -> HullRecord {
    let columns = pair.columns();
    let seen = nearest_points(&columns);
    let clear = APART.max(4.0 * TOUCH * rounding);
    if !seen.inside
        && seen.least > clear
        && let Some(features) = few(&columns, &seen)
    {
        return HullRecord::new(&[features], false);
    }
    if seen.inside
        && let Some(features) = expansion::deepest(&columns, seen.around(), clear, TIED)
    {
        return HullRecord::new(&features, true);
    }
    search_all(pair, &seen, corners(), rounding)
}

/// Returns what [`search`] does where the nearest corners do not decide.
fn search_all(
    pair: &HullPair,
    seen: &Gap<CornerDifference>,
    [mut a, mut b]: [Vec<Vec3<f64>>; 2],
    rounding: f64,
) -> HullRecord {
    let apart = !seen.inside && seen.least > CLEAR;
    for point in a.iter_mut().chain(&mut b) {
        *point = *point * pair.units;
    }
    let (of_a, of_b) = (Body::of(&a, rounding), Body::of(&b, rounding));
    let planes = match apart {
        true => Vec::new(),
        false => planes::best(&of_a, &of_b, TIED, rounding),
    };
    let deepest = planes.first().map_or(f64::NEG_INFINITY, |plane| plane.gap);
    let overlap = seen.inside && (f64::MIN..-CLEAR).contains(&deepest);
    if !overlap {
        let (near, distance) = nearest(&of_a, &of_b, TIED);
        // Moved by their depth, hulls that overlap touch: without the move they are no farther apart.
        let touch = TOUCH * rounding;
        let behind = deepest < 0.0 && distance <= touch - 2.0 * deepest;
        let parted = !seen.inside && seen.least > touch;
        if planes.is_empty() || parted || distance > touch && !behind {
            let features: Vec<HullFeatures> = near.iter().map(|near| near.features).collect();
            return HullRecord::new(&alone(features), false);
        }
    }
    let mut all = Vec::new();
    for (number, plane) in planes.iter().enumerate() {
        let found = patch::features((&of_a).into(), (&of_b).into(), plane, TIED);
        all.extend(found.into_iter().map(|features| HullFeatures {
            plane: number.min(255) as u8,
            ..features
        }));
    }
    HullRecord::new(&all, true)
}

/// Returns one of several features that are all the same.
fn alone(mut all: Vec<HullFeatures>) -> Vec<HullFeatures> {
    if all.iter().all(|&features| features == all[0]) {
        all.truncate(1);
    }
    all
}

/// The corners of a hull whose weighted mean is its nearest point, three at most, in increasing order.
struct Nearest {
    corners: [usize; 3],
    weights: [f64; 3],
    count: usize,
}

impl Nearest {
    /// Returns the corners of a mean; `None` of more than three.
    fn of(mix: &Mix) -> Option<Self> {
        let codes = mix.codes();
        if codes.len() > 3 {
            return None;
        }
        let mut corners = [usize::MAX; 3];
        corners[..codes.len()].copy_from_slice(codes);
        let [p, q, r] = corners;
        let (p, q) = (p.min(q), p.max(q));
        let (q, r) = (q.min(r), q.max(r));
        let corners = [p.min(q), p.max(q), r];
        Some(Nearest {
            corners,
            weights: corners.each_as(|corner| mix.weight(corner)),
            count: codes.len(),
        })
    }
    fn corners(&self) -> &[usize] {
        &self.corners[..self.count]
    }
    /// Returns `true` if all of them are no lower than a height along a direction.
    fn is_above(&self, columns: &PointColumns<'_>, (way, least): (Vec3<f64>, f64)) -> bool {
        let mut corners = self.corners().iter();
        corners.all(|&k| way.dot(columns.point(k)) >= least)
    }
    /// Returns the least weight.
    fn least(&self) -> f64 {
        self.weights[..self.count]
            .iter()
            .fold(1.0, |least, &weight| weight.min(least))
    }
}

/// Returns the nearest features of hulls that are apart, those of the corners whose mean the iteration has found to be
/// nearest; `None` where other corners may be as near, and where the bound from below is not reached.
fn few([a, b]: &[PointColumns<'_>; 2], seen: &Gap<CornerDifference>) -> Option<HullFeatures> {
    // A hundredth of the error that a distance may have, relative to the size.
    const REACHED: f64 = 1e-12;
    let length = long(seen.way);
    let way = seen.way * (1.0 / length);
    // A short vector has few digits.
    let low = LOW.max(DIGITS / length);
    let mut mixes = [Mix::default(); 2];
    for (corner, weight) in seen.weighted() {
        mixes[0].add(corner.a, weight);
        mixes[1].add(corner.b, weight);
    }
    let of_a = Nearest::of(&mixes[0])?;
    let of_b = Nearest::of(&mixes[1])?;
    let high = (way, way.dot(a.point(seen.low.a)) - low);
    let deep = (-way, -way.dot(b.point(seen.low.b)) - low);
    let level = [a.count_above(high.0, high.1), b.count_above(deep.0, deep.1)];
    let least = way.dot(seen.low.way);
    let is_reached = |distance: f64| (distance - least).abs() <= REACHED;
    if level != [of_a.count, of_b.count] {
        let (distance, features) = match (level[0], level[1]) {
            (4.., 1) => {
                let corner = of_b.corners[0];
                let (face, distance) = wide_face(a, high, low, b.point(corner))?;
                let features = HullFeatures::new(FeaturePair::FaceCorner, &face, &[corner]);
                (distance, features)
            }
            (1, 4..) => {
                let corner = of_a.corners[0];
                let (face, distance) = wide_face(b, deep, low, a.point(corner))?;
                let features = HullFeatures::new(FeaturePair::CornerFace, &[corner], &face);
                (distance, features)
            }
            _ => return None,
        };
        return is_reached(distance).then_some(features);
    }
    let (from, to) = (
        of_a.corners.each_as(|k| a.point(k)),
        of_b.corners.each_as(|k| b.point(k)),
    );
    let own = |pair| HullFeatures::new(pair, of_a.corners(), of_b.corners());
    let (distance, aside, features) = match (of_a.count, of_b.count) {
        (1, 1) => (
            long(to[0] - from[0]),
            f64::INFINITY,
            own(FeaturePair::Corners),
        ),
        (1, 2) => (
            from_edge([to[0], to[1]], from[0])?,
            (to[1] - to[0]).length_squared(),
            own(FeaturePair::CornerEdge),
        ),
        (2, 1) => (
            from_edge([from[0], from[1]], to[0])?,
            (from[1] - from[0]).length_squared(),
            own(FeaturePair::EdgeCorner),
        ),
        (2, 2) => {
            let (u, v) = ([from[0], from[1]], [to[0], to[1]]);
            let distance = of_edges(u, v)?;
            let (u, v) = (u[1] - u[0], v[1] - v[0]);
            let aside = u.cross(v).length_squared() / u.length_squared().max(v.length_squared());
            let [i, j, _] = of_a.corners;
            let [k, l, _] = of_b.corners;
            (
                distance,
                aside,
                edges(|k| a.point(k), [i, j], |k| b.point(k), [k, l]),
            )
        }
        (1, 3) => {
            let face = spanning(|k| b.point(k), of_b.corners(), -way);
            let (distance, aside) = over(face.each_as(|k| b.point(k)), from[0])?;
            (
                distance,
                aside,
                HullFeatures::new(FeaturePair::CornerFace, of_a.corners(), &face),
            )
        }
        (3, 1) => {
            let face = spanning(|k| a.point(k), of_a.corners(), way);
            let (distance, aside) = over(face.each_as(|k| a.point(k)), to[0])?;
            (
                distance,
                aside,
                HullFeatures::new(FeaturePair::FaceCorner, &face, of_b.corners()),
            )
        }
        _ => return None,
    };
    let weight = of_a.least().min(of_b.least());
    let alone = is_aside(weight * weight * aside, distance);
    let level = of_a.is_above(a, high) && of_b.is_above(b, deep);
    (alone && level && is_reached(distance)).then_some(features)
}

/// Returns `true` if a point at a distance from another feature is nearer to it than to what is beside its foot, given the
/// square of how far that is.
fn is_aside(square: f64, distance: f64) -> bool {
    square > 4.0 * TIED * (distance + TIED)
}

/// Returns three corners of the highest face along a direction, over which a point is, and the point's height. The face has
/// all corners that are no lower than a height, up to a slack; `None` if they are not in a plane, and near its border.
fn wide_face(
    columns: &PointColumns<'_>,
    (way, least): (Vec3<f64>, f64),
    slack: f64,
    point: Vec3<f64>,
) -> Option<([usize; 3], f64)> {
    let (points, mut corners) = (columns.points(), Vec::new());
    columns.above(way, least, |k| corners.push(k));
    let ring = patch::ring(&points, &corners, (corners[0], way), slack);
    if ring.len() != corners.len() {
        return None;
    }
    let face = around(&points, &ring, (way, way), point);
    let [p, q, r] = face.map(|k| points[k]);
    let normal = across(q - p, r - p);
    let distance = normal.dot(point - p).abs();
    let inside = |k: usize| {
        let (from, to) = (points[ring[k]], points[ring[(k + 1) % ring.len()]]);
        let side = normal.dot((to - from).cross(point - from));
        let flat = normal.dot(from - p).abs() <= BEYOND;
        flat && side > 0.0 && is_aside(side * side / (to - from).length_squared(), distance)
    };
    (0..ring.len()).all(inside).then_some((face, distance))
}

/// Returns the height of a point over a triangle, if its foot is inside, and the square of the least height of a corner
/// over the opposite side.
fn over([a, b, c]: [Vec3<f64>; 3], point: Vec3<f64>) -> Option<(f64, f64)> {
    let normal = across(b - a, c - a);
    let inside = |p: Vec3<f64>, q: Vec3<f64>| normal.dot((q - p).cross(point - p)) > 0.0;
    let longest = [b - a, c - b, a - c].each_as(|side| side.length_squared());
    let longest = longest.into_iter().fold(0.0, f64::max);
    let aside = (b - a).cross(c - a).length_squared() / longest;
    (inside(a, b) && inside(b, c) && inside(c, a)).then(|| (normal.dot(point - a).abs(), aside))
}
