//! The search for the features of two hulls that decide about their relation.
use super::super::gjk::{CornerDifference, Gap, gap};
use super::body::Body;
use super::expansion;
use super::highest_point::PointColumns;
use super::hull_record::{FeaturePair, HullFeatures, HullRecord, spanning};
use super::near_features::{Near, edges, from_edge, long, nearest, of_edges};
use super::parting_planes as planes;
use super::patch;
use crate::Vec3;
use crate::distance::edge::scale_of;
use crate::scalar::largest;

/// The share of the size above which hulls are certainly apart, or overlap.
const CLEAR: f64 = 1e-3;
/// The share of the size above which hulls are apart whose nearest features are proved, and so many roundings.
const APART: f64 = 1e-7;
/// The height over the lowest corner below which a corner may be nearest, where hulls are clearly apart.
const LOW: f64 = 1e-11;
/// The error of heights along a vector of length one.
const DIGITS: f64 = 8.0 * f64::EPSILON;
/// The number of roundings by which distances may differ that are equal.
const TIED: f64 = 8.0;
/// The number of roundings that a distance may have if planes decide the direction.
const TOUCH: f64 = 32.0;

/// Returns the points in units of a power of two in which the largest distance from the first one is about one, and as
/// columns relative to that.
fn scaled(a: &mut [Vec3<f64>], b: &mut [Vec3<f64>]) -> [PointColumns; 2] {
    let from = a[0];
    let size = a.iter().chain(b.iter()).fold(0.0_f64, |most, &p| {
        let arm = p - from;
        most.max(largest([arm.x, arm.y, arm.z]))
    });
    let scale = scale_of::<f64>(size);
    for point in a.iter_mut().chain(&mut *b) {
        *point = *point * scale;
    }
    [&*a, &*b].map(|points| PointColumns::new(points, a[0]))
}

/// Returns the nearest points of two hulls, beginning with the vector between their middles.
fn nearest_points([a, b]: &[PointColumns; 2]) -> Gap<CornerDifference> {
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
/// with this rounding. Both have a corner at least.
pub(super) fn search(mut a: Vec<Vec3<f64>>, mut b: Vec<Vec3<f64>>, rounding: f64) -> HullRecord {
    let columns = scaled(&mut a, &mut b);
    let slack = TIED * rounding;
    let seen = nearest_points(&columns);
    let apart = !seen.inside && seen.least > CLEAR;
    let proves = !seen.inside && seen.least > APART.max(4.0 * TOUCH * rounding);
    if proves && let Some(features) = few(&columns, &seen, slack) {
        return HullRecord::new(&[features], false);
    }
    if seen.inside
        && let Some(features) = expansion::deepest([&a, &b], &columns, seen.around(), CLEAR, slack)
    {
        return HullRecord::new(&features, true);
    }
    let (of_a, of_b) = (Body::of(&a, rounding), Body::of(&b, rounding));
    let planes = match apart {
        true => Vec::new(),
        false => planes::best(&of_a, &of_b, slack, rounding),
    };
    let deepest = planes.first().map_or(f64::NEG_INFINITY, |plane| plane.gap);
    let overlap = seen.inside && (f64::MIN..-CLEAR).contains(&deepest);
    if !overlap {
        let (near, distance) = nearest(&of_a, &of_b, slack);
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
        let found = patch::features((&of_a).into(), (&of_b).into(), plane, slack);
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

/// The corners of a hull that are the highest along a direction, three at most.
struct High {
    all: [usize; 3],
    count: usize,
}

impl High {
    /// Returns those up to a slack below the highest point along a direction; `None` of more.
    fn of(columns: &PointColumns, way: Vec3<f64>, highest: usize, slack: f64) -> Option<Self> {
        let (mut all, mut count) = ([0; 3], 0);
        let least = way.dot(columns.point(highest)) - slack;
        columns.above(way, least, |k| {
            if let Some(place) = all.get_mut(count) {
                *place = k;
            }
            count += 1;
        });
        (count <= all.len()).then_some(High { all, count })
    }
    fn corners(&self) -> &[usize] {
        &self.all[..self.count]
    }
    /// Returns the segments between them.
    fn sides(&self) -> impl Iterator<Item = [usize; 2]> {
        let [i, j, k] = self.all;
        let count = [0, 0, 1, 3][self.count];
        [[i, j], [j, k], [i, k]].into_iter().take(count)
    }
    fn face(&self) -> Option<[usize; 3]> {
        (self.count == 3).then_some(self.all)
    }
}

/// The nearest of some features, and the distance of the second nearest.
struct Nearest {
    first: Option<Near>,
    second: f64,
}

impl Nearest {
    fn add(&mut self, distance: f64, features: HullFeatures) {
        let least = self.first.map_or(f64::INFINITY, |near| near.distance);
        self.second = self.second.min(least.max(distance));
        if distance < least {
            self.first = Some(Near { distance, features });
        }
    }
}

/// Returns the nearest features of hulls that are apart, of the few corners that are the nearest along the vector
/// between them; `None` for more corners, for ties, and where the bound from below is not reached.
fn few(
    [a, b]: &[PointColumns; 2],
    seen: &Gap<CornerDifference>,
    slack: f64,
) -> Option<HullFeatures> {
    const REACHED: f64 = 1e-12;
    let length = long(seen.way);
    let way = seen.way * (1.0 / length);
    // A short vector has few digits.
    let low = LOW.max(4.0 * slack).max(DIGITS / length);
    let of_a = High::of(a, way, seen.low.a, low)?;
    let of_b = High::of(b, -way, seen.low.b, low)?;
    let mut all = Nearest {
        first: None,
        second: f64::INFINITY,
    };
    for &i in of_a.corners() {
        for &j in of_b.corners() {
            let features = HullFeatures::new(FeaturePair::Corners, &[i], &[j]);
            all.add(long(b.point(j) - a.point(i)), features);
        }
        for side in of_b.sides() {
            if let Some(distance) = from_edge(side.map(|k| b.point(k)), a.point(i)) {
                all.add(
                    distance,
                    HullFeatures::new(FeaturePair::CornerEdge, &[i], &side),
                );
            }
        }
    }
    for side in of_a.sides() {
        for &j in of_b.corners() {
            if let Some(distance) = from_edge(side.map(|k| a.point(k)), b.point(j)) {
                all.add(
                    distance,
                    HullFeatures::new(FeaturePair::EdgeCorner, &side, &[j]),
                );
            }
        }
        for other in of_b.sides() {
            if let Some(distance) = of_edges(side.map(|k| a.point(k)), other.map(|k| b.point(k))) {
                all.add(distance, edges(|k| a.point(k), side, |k| b.point(k), other));
            }
        }
    }
    if let Some(corners) = of_a.face() {
        let face = spanning(|k| a.point(k), &corners, way);
        for &j in of_b.corners() {
            if let Some(distance) = over(face.map(|k| a.point(k)), b.point(j)) {
                all.add(
                    distance,
                    HullFeatures::new(FeaturePair::FaceCorner, &face, &[j]),
                );
            }
        }
    }
    if let Some(corners) = of_b.face() {
        let face = spanning(|k| b.point(k), &corners, -way);
        for &i in of_a.corners() {
            if let Some(distance) = over(face.map(|k| b.point(k)), a.point(i)) {
                all.add(
                    distance,
                    HullFeatures::new(FeaturePair::CornerFace, &[i], &face),
                );
            }
        }
    }
    let near = all.first?;
    let least = way.dot(seen.low.way);
    let alone = all.second > near.distance + slack;
    (alone && (near.distance - least).abs() <= REACHED).then_some(near.features)
}

/// Returns the height of a point over a triangle, if its foot is inside.
fn over([a, b, c]: [Vec3<f64>; 3], point: Vec3<f64>) -> Option<f64> {
    let normal = super::body::across(b - a, c - a);
    let inside = |p: Vec3<f64>, q: Vec3<f64>| normal.dot((q - p).cross(point - p)) > 0.0;
    (inside(a, b) && inside(b, c) && inside(c, a)).then(|| normal.dot(point - a).abs())
}
