//! The search for the features of two hulls that decide about their relation.
use super::body::Body;
use super::gjk::{Gap, gap};
use super::hull_record::{FeaturePair, HullFeatures, HullRecord, spanning};
use super::near_features::{Near, edges, from_edge, nearest, of_edges};
use super::parting_planes as planes;
use super::patch;
use crate::Vec3;
use crate::distance::edge::scale_of;
use crate::scalar::largest;

/// The share of the size above which hulls are certainly apart, or overlap.
const CLEAR: f64 = 1e-3;
/// The height over the lowest corner below which a corner may be nearest, where hulls are clearly apart.
const LOW: f64 = 1e-11;
/// The number of roundings by which distances may differ that are equal.
const TIED: f64 = 8.0;
/// The number of roundings that a distance may have if planes decide the direction.
const TOUCH: f64 = 32.0;

/// Returns the points in units of a power of two in which the largest distance from the first one is about one.
fn scaled(a: &mut [Vec3<f64>], b: &mut [Vec3<f64>]) {
    let from = a[0];
    let size = a.iter().chain(b.iter()).fold(0.0_f64, |most, &p| {
        let arm = p - from;
        most.max(largest([arm.x, arm.y, arm.z]))
    });
    let scale = scale_of::<f64>(size);
    for point in a.iter_mut().chain(b) {
        *point = *point * scale;
    }
}

/// Returns the features that decide about the relation of two hulls of plain numbers, which are replayed in a format
/// with this rounding. Both have a corner at least.
pub(super) fn search(mut a: Vec<Vec3<f64>>, mut b: Vec<Vec3<f64>>, rounding: f64) -> HullRecord {
    scaled(&mut a, &mut b);
    let slack = TIED * rounding;
    let seen = gap(&a, &b);
    let apart = !seen.inside && seen.least > CLEAR;
    if apart && let Some(features) = few(&a, &b, seen, slack) {
        return HullRecord::new(&[features], false);
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
        let found = patch::features(&of_a, &of_b, plane, slack);
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

/// Returns the corners lowest along a direction, if they are three at most.
fn lowest(points: &[Vec3<f64>], way: Vec3<f64>, slack: f64) -> Option<(f64, Vec<usize>)> {
    let heights = points.iter().map(|&point| way.dot(point - points[0]));
    let least = heights.clone().fold(f64::INFINITY, f64::min);
    let low = heights
        .enumerate()
        .filter(|(_, height)| *height <= least + slack);
    let corners: Vec<usize> = low.map(|(k, _)| k).take(4).collect();
    (corners.len() < 4).then_some((least, corners))
}

/// Returns the nearest features of hulls that are apart, of the few corners that are the nearest along the vector
/// between them; `None` for more corners, for ties, and where the bound from below is not reached.
fn few(a: &[Vec3<f64>], b: &[Vec3<f64>], seen: Gap, slack: f64) -> Option<HullFeatures> {
    const REACHED: f64 = 1e-12;
    let way = seen.way * (1.0 / seen.way.length());
    let low = LOW.max(4.0 * slack);
    let (high_a, of_a) = lowest(a, -way, low)?;
    let (low_b, of_b) = lowest(b, way, low)?;
    let least = way.dot(b[0] - a[0]) + low_b + high_a;
    let mut all: Vec<Near> = Vec::new();
    let mut add = |distance: Option<f64>, features: HullFeatures| {
        all.extend(distance.map(|distance| Near { distance, features }));
    };
    let sides = |corners: &[usize]| -> Vec<[usize; 2]> {
        let n = corners.len();
        let all = [(0, 1), (1, 2), (0, 2)];
        let held = all.iter().filter(|&&(_, to)| to < n);
        held.map(|&(from, to)| [corners[from], corners[to]])
            .collect()
    };
    let (sides_a, sides_b) = (sides(&of_a), sides(&of_b));
    for &i in &of_a {
        for &j in &of_b {
            let distance = (b[j] - a[i]).length();
            add(
                Some(distance),
                HullFeatures::new(FeaturePair::Corners, &[i], &[j]),
            );
        }
        for side in &sides_b {
            let distance = from_edge(side.map(|k| b[k]), a[i]);
            add(
                distance,
                HullFeatures::new(FeaturePair::CornerEdge, &[i], side),
            );
        }
    }
    for side in &sides_a {
        for &j in &of_b {
            let distance = from_edge(side.map(|k| a[k]), b[j]);
            add(
                distance,
                HullFeatures::new(FeaturePair::EdgeCorner, side, &[j]),
            );
        }
        for other in &sides_b {
            let distance = of_edges(side.map(|k| a[k]), other.map(|k| b[k]));
            add(distance, edges(a, *side, b, *other));
        }
    }
    if let [_, _, _] = of_a[..] {
        let face = spanning(a, &of_a, way);
        for &j in &of_b {
            let features = HullFeatures::new(FeaturePair::FaceCorner, &face, &[j]);
            add(over(face.map(|k| a[k]), b[j]), features);
        }
    }
    if let [_, _, _] = of_b[..] {
        let face = spanning(b, &of_b, -way);
        for &i in &of_a {
            let features = HullFeatures::new(FeaturePair::CornerFace, &[i], &face);
            add(over(face.map(|k| b[k]), a[i]), features);
        }
    }
    let best = all
        .iter()
        .map(|near| near.distance)
        .fold(f64::INFINITY, f64::min);
    let mut tied = all.iter().filter(|near| near.distance <= best + slack);
    match (tied.next(), tied.next()) {
        (Some(near), None) if (best - least).abs() <= REACHED => Some(near.features),
        _ => None,
    }
}

/// Returns the height of a point over a triangle, if its foot is inside.
fn over([a, b, c]: [Vec3<f64>; 3], point: Vec3<f64>) -> Option<f64> {
    let normal = super::body::across(b - a, c - a);
    let inside = |p: Vec3<f64>, q: Vec3<f64>| normal.dot((q - p).cross(point - p)) > 0.0;
    (inside(a, b) && inside(b, c) && inside(c, a)).then(|| normal.dot(point - a).abs())
}
