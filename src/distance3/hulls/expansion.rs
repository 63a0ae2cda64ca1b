//! The depth of two hulls that clearly overlap: a polytope that is expanded in the difference of both (van den Bergen
//! 2001), from a fat tetrahedron, with a proof of what it finds.
//!
//! The points of b less those of a have a hull, the origin inside. Its nearest facet is the plane that parts the hulls
//! by the least move. Faces of a polytope in it bound that distance from below, planes along its facets from above.
use super::super::polytope::{Face, Polytope};
use super::body::unit;
use super::highest_point::PointColumns;
use super::hull_record::{FeaturePair, HullFeatures, spanning};
use super::near_features::long;
use super::parting_planes::Plane;
use super::patch;
use crate::arrays::Each;
use crate::hull::hull_search;
use crate::{Vec2, Vec3};
use smallvec::{SmallVec, smallvec};

/// The most corners of the polytope; hulls of 32 corners need about twenty.
const CORNERS: usize = 64;
/// The sine of the least angle of faces whose normals have digits enough.
const SLIVER: f64 = 1e-6;
/// The least height of a tetrahedron to begin with.
const FAT: f64 = 1e-2;
/// The height over a face's plane that is none.
const ABOVE: f64 = 1e-13;
/// The least height of a corner that is not in a plane, and of other planes over the lowest one.
const CLEAR: f64 = 1e-9;

/// The difference of two hulls with coordinates of about one.
struct Differences<'a> {
    a: PointColumns<'a>,
    b: PointColumns<'a>,
}

impl Differences<'_> {
    /// Returns the highest difference along a direction.
    fn highest(&self, way: Vec3<f64>) -> Vec3<f64> {
        let ((_, of_a), (_, of_b)) = (self.a.highest(-way), self.b.highest(way));
        of_b - of_a
    }
    /// Begins a polytope with differences that are far apart. Returns `false` if they are in a plane.
    fn start(&self, polytope: &mut Polytope<Vec3<f64>>) -> bool {
        let first = self.highest(Vec3::new(1.0, 0.0, 0.0));
        let second = self.highest(-first - Vec3::new(1.0, 0.0, 0.0));
        let along = unit(second - first);
        let least = along.x.abs().min(along.y.abs()).min(along.z.abs());
        let axis = match least {
            x if x == along.x.abs() => Vec3::new(1.0, 0.0, 0.0),
            y if y == along.y.abs() => Vec3::new(0.0, 1.0, 0.0),
            _ => Vec3::new(0.0, 0.0, 1.0),
        };
        let farther = |x: Vec3<f64>, y: Vec3<f64>, way: Vec3<f64>| {
            let off = |d: Vec3<f64>| way.dot(d - first).abs();
            if off(x) >= off(y) { x } else { y }
        };
        let aside = unit(along.cross(axis));
        let third = farther(self.highest(aside), self.highest(-aside), aside);
        let up = unit((second - first).cross(third - first));
        let fourth = farther(self.highest(up), self.highest(-up), up);
        let height = up.dot(fourth - first);
        polytope.begin([first, second, third, fourth], height);
        height.abs() > SLIVER && !polytope.has_slivers
    }
    /// Expands a polytope until nothing is above its lowest faces, all those up to a height over the lowest one. Returns
    /// the lowest face; `None` without a proof.
    fn expanded(&self, first: Option<[Vec3<f64>; 4]>, clear: f64) -> Option<Face> {
        let mut polytope = Polytope::new(ABOVE, SLIVER);
        let is_fat = first.is_some_and(|first| is_fat(&mut polytope, first));
        if !is_fat && !self.start(&mut polytope) {
            return None;
        }
        let mut best: Option<Face> = None;
        while let Some((k, least)) = polytope.lowest() {
            if best.is_some_and(|best| least >= best.height + clear) {
                break;
            }
            let face = polytope.faces[k];
            let apex = self.highest(face.normal);
            if face.normal.dot(apex) - face.height <= ABOVE {
                polytope.open[k] = f64::INFINITY;
                best = best.or(Some(face));
            } else if polytope.corners.len() == CORNERS
                || !polytope.extend(k, apex)
                || polytope.has_slivers
            {
                return None;
            }
        }
        let best = best?;
        // Every point of a closed surface around the origin is as far from that as the lowest of its faces.
        let alone = polytope.faces.iter().fold(true, |alone, face| {
            let turned = (face.normal - best.normal).length_squared();
            let around = face.height >= best.height - ABOVE;
            let another = (face.height <= best.height + clear) & (turned > SLIVER * SLIVER);
            alone & (face.gone | around & !another)
        });
        alone.then_some(best)
    }
}

/// Begins a polytope with four corners. Returns `false` if they are nearly in a plane.
fn is_fat(polytope: &mut Polytope<Vec3<f64>>, corners: [Vec3<f64>; 4]) -> bool {
    let [first, second, third, fourth] = corners;
    let height = (second - first).cross(third - first).dot(fourth - first);
    polytope.begin(corners, height);
    let is_fat = |face: &Face| {
        let heights = corners.each_as(|corner| face.normal.dot(corner) - face.height);
        heights.into_iter().fold(0.0, f64::min) < -FAT
    };
    !polytope.has_slivers && polytope.faces.iter().all(is_fat)
}

/// The numbers of points that are equally high.
type Top = SmallVec<[usize; 8]>;

/// Returns the points that are as high along a direction as one of them; `None` where rounding may decide which ones they
/// are, or which of them are corners.
fn top(
    points: &PointColumns<'_>,
    way: Vec3<f64>,
    highest: usize,
    (slack, clear): (f64, f64),
) -> Option<Top> {
    let height = way.dot(points.point(highest));
    let least = height - slack.max(2.0 * ABOVE);
    let count = points.count_above(way, least);
    if points.count_above(way, height - clear) != count {
        return None;
    }
    if count == 1 {
        return Some(smallvec![highest]);
    }
    let mut all = Top::with_capacity(count);
    points.above(way, least, |k| all.push(k));
    let is_clear = |[i, j, k]: [usize; 3]| {
        let [i, j, k] = [i, j, k].each_as(|k| points.point(k));
        let (u, v) = (j - i, k - j);
        let most = u.length_squared().max(v.length_squared());
        way.dot(u.cross(v)).abs() > SLIVER * most
    };
    let clear = match all[..] {
        [i, j] => long(points.point(j) - points.point(i)) > SLIVER,
        [i, j, k] => is_clear([i, j, k]),
        _ => {
            let from = points.point(all[0]);
            let first = unit(points.point(all[1]) - from);
            let second = way.cross(first);
            let seen = |k: &usize| {
                let arm = points.point(*k) - from;
                Vec2::new(first.dot(arm), second.dot(arm))
            };
            let ring = hull_search(&all.iter().map(seen).collect::<Vec<_>>());
            let n = ring.len();
            let corner = |k: usize| is_clear([k, k + 1, k + 2].map(|k| all[ring[k % n]]));
            n == all.len() && (0..n).all(corner)
        }
    };
    clear.then_some(all)
}

/// Returns the features of two hulls in the one plane that parts them by the least move, if they overlap by more than a
/// depth, and no rounding decides which plane and which features these are.
pub(super) fn deepest(
    [a, b]: &[PointColumns<'_>; 2],
    first: Option<[Vec3<f64>; 4]>,
    depth: f64,
    slack: f64,
) -> Option<Vec<HullFeatures>> {
    let differences = Differences { a: *a, b: *b };
    // Planes are equally deep up to twice the slack, corners equally high up to it.
    let face = differences.expanded(first, 2.0 * slack + CLEAR)?;
    let clear = slack + CLEAR;
    if face.height < depth {
        return None;
    }
    let normal = -face.normal;
    let (high, low) = (a.highest(normal).0, b.highest(-normal).0);
    let of_a = top(a, normal, high, (slack, clear))?;
    let of_b = top(b, -normal, low, (slack, clear))?;
    let one = |pair, first: &[usize], second: &[usize]| {
        Some(vec![HullFeatures::new(pair, first, second)])
    };
    match (&of_a[..], &of_b[..]) {
        (&[_], &[_, _, _]) => one(
            FeaturePair::CornerFace,
            &of_a,
            &spanning(|k| b.point(k), &of_b, -normal),
        ),
        (&[_, _, _], &[_]) => one(
            FeaturePair::FaceCorner,
            &spanning(|k| a.point(k), &of_a, normal),
            &of_b,
        ),
        (&[i, j], &[k, l]) => {
            let (u, v) = (a.point(j) - a.point(i), b.point(l) - b.point(k));
            let product = u.cross(v);
            let sine = long(product) / (long(u) * long(v));
            let ends = match product.dot(normal) < 0.0 {
                true => [l, k],
                false => [k, l],
            };
            (sine > SLIVER).then(|| vec![HullFeatures::new(FeaturePair::Edges, &of_a, &ends)])
        }
        (&[_] | &[_, _], &[_] | &[_, _]) => None,
        _ => {
            let plane = Plane {
                gap: -face.height,
                normal,
                on_a: of_a[0],
                on_b: of_b[0],
                features: HullFeatures::new(FeaturePair::Corners, &[], &[]),
            };
            let (all_a, all_b) = (a.points(), b.points());
            let side = |points, corners| patch::Side { points, corners };
            let found = patch::features(side(&all_a, &of_a), side(&all_b, &of_b), &plane, slack);
            // Without any the plane's own features stand for them.
            let known = found.iter().all(|one| one.pair != FeaturePair::Corners);
            known.then_some(found)
        }
    }
}
