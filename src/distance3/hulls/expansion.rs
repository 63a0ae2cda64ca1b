//! The depth of two hulls that clearly overlap: a polytope that is expanded in the difference of both (van den Bergen
//! 2001), from a fat tetrahedron, with a proof of what it finds.
//!
//! The points of b less those of a have a hull, the origin inside. Its nearest facet is the plane that parts the hulls
//! by the least move. Faces of a polytope in it bound that distance from below, planes along its facets from above.
use super::body::unit;
use super::highest_point::PointColumns;
use super::hull_record::{FeaturePair, HullFeatures, spanning};
use super::parting_planes::Plane;
use super::patch::{self, Side};
use crate::hull::hull_search;
use crate::{Vec2, Vec3};

/// A face of the polytope.
#[derive(Clone, Copy)]
struct Face {
    /// Its corners, counter-clockwise seen from outside.
    corners: [usize; 3],
    /// The faces across the edges from each corner to the next one.
    beside: [usize; 3],
    normal: Vec3<f64>,
    /// The height of its plane over the origin.
    height: f64,
    /// `true` if it is no face any more.
    gone: bool,
}

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

/// The polytope so far, of points with coordinates of about one.
struct Polytope<'a> {
    a: &'a PointColumns,
    b: &'a PointColumns,
    corners: Vec<Vec3<f64>>,
    faces: Vec<Face>,
    /// The heights of faces of which it is not known if something is above them; infinite for all others.
    open: Vec<f64>,
    /// The faces below a point.
    seen: Vec<usize>,
    /// The edges around them, each with the face beyond it.
    border: Vec<(usize, usize, usize)>,
}

impl Polytope<'_> {
    /// Returns the highest difference along a direction.
    fn support(&self, way: Vec3<f64>) -> Vec3<f64> {
        let ((_, of_a), (_, of_b)) = (self.a.highest(-way), self.b.highest(way));
        of_b - of_a
    }
    /// Adds a face; `None` for a sliver.
    fn add(&mut self, corners: [usize; 3], beside: [usize; 3]) -> Option<()> {
        let [p, q, r] = corners.map(|k| self.corners[k]);
        let (u, v, w) = (q - p, r - p, r - q);
        let product = u.cross(v);
        let longest = u
            .length_squared()
            .max(v.length_squared())
            .max(w.length_squared());
        let length = product.length();
        if length <= SLIVER * longest {
            return None;
        }
        let normal = product * (1.0 / length);
        let height = normal.dot(p);
        self.open.push(height);
        self.faces.push(Face {
            corners,
            beside,
            normal,
            height,
            gone: false,
        });
        Some(())
    }
    /// Makes a tetrahedron of differences that are far apart; `None` for a flat one.
    fn start(&mut self) -> Option<()> {
        let first = self.support(Vec3::new(1.0, 0.0, 0.0));
        let second = self.support(-first - Vec3::new(1.0, 0.0, 0.0));
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
        let third = farther(self.support(aside), self.support(-aside), aside);
        let up = unit((second - first).cross(third - first));
        let fourth = farther(self.support(up), self.support(-up), up);
        let height = up.dot(fourth - first);
        self.corners.extend([first, second, third, fourth]);
        self.enclose(height)?;
        (height.abs() > SLIVER).then_some(())
    }
    /// Begins with a tetrahedron; `None` for a flat one.
    fn around(&mut self, corners: [Vec3<f64>; 4]) -> Option<()> {
        let [first, second, third, fourth] = corners;
        self.corners.extend(corners);
        let height = (second - first).cross(third - first).dot(fourth - first);
        self.enclose(height)?;
        let fat = |face: &Face| {
            let heights = corners.map(|corner| face.normal.dot(corner) - face.height);
            heights.into_iter().fold(0.0, f64::min) < -FAT
        };
        self.faces.iter().all(fat).then_some(())
    }
    /// Adds the faces of the tetrahedron of all four corners, given the side of the last one.
    fn enclose(&mut self, height: f64) -> Option<()> {
        // The last corner is behind the first face.
        let [b, c] = if height < 0.0 { [1, 2] } else { [2, 1] };
        self.add([0, b, c], [1, 2, 3])?;
        self.add([0, 3, b], [3, 2, 0])?;
        self.add([b, 3, c], [1, 3, 0])?;
        self.add([c, 3, 0], [2, 1, 0])
    }
    /// Extends the polytope to a point above a face.
    fn extend(&mut self, start: usize, apex: Vec3<f64>) -> Option<()> {
        let number = self.corners.len();
        if number == CORNERS {
            return None;
        }
        self.corners.push(apex);
        self.seen.clear();
        self.border.clear();
        self.seen.push(start);
        self.faces[start].gone = true;
        self.open[start] = f64::INFINITY;
        let mut read = 0;
        while read < self.seen.len() {
            let Face {
                corners, beside, ..
            } = self.faces[self.seen[read]];
            for k in 0..3 {
                let other = &mut self.faces[beside[k]];
                if other.gone {
                    continue;
                }
                if other.normal.dot(apex) - other.height > ABOVE {
                    other.gone = true;
                    self.open[beside[k]] = f64::INFINITY;
                    self.seen.push(beside[k]);
                } else {
                    self.border
                        .push((corners[k], corners[(k + 1) % 3], beside[k]));
                }
            }
            read += 1;
        }
        let first = self.faces.len();
        for k in 0..self.border.len() {
            let (from, to, other) = self.border[k];
            let next = self.border.iter().position(|&(start, ..)| start == to)?;
            let last = self.border.iter().position(|&(_, end, _)| end == from)?;
            self.add([from, to, number], [other, first + next, first + last])?;
            let other = &mut self.faces[other];
            for edge in 0..3 {
                if other.corners[edge] == to && other.corners[(edge + 1) % 3] == from {
                    other.beside[edge] = first + k;
                }
            }
        }
        Some(())
    }
    /// Expands the polytope until nothing is above its lowest faces, all those up to a height over the lowest one.
    /// Returns the lowest face; `None` without a proof.
    fn expand(&mut self, first: Option<[Vec3<f64>; 4]>, clear: f64) -> Option<Face> {
        if first.and_then(|corners| self.around(corners)).is_none() {
            self.corners.clear();
            self.faces.clear();
            self.open.clear();
            self.start()?;
        }
        let mut best: Option<Face> = None;
        loop {
            let (mut k, mut least) = (0, f64::INFINITY);
            for (face, &height) in self.open.iter().enumerate() {
                if height < least {
                    (k, least) = (face, height);
                }
            }
            let known = best.map_or(f64::INFINITY, |best| best.height + clear);
            if least >= known {
                break;
            }
            let face = self.faces[k];
            let apex = self.support(face.normal);
            if face.normal.dot(apex) - face.height <= ABOVE {
                self.open[k] = f64::INFINITY;
                best = best.or(Some(face));
            } else {
                self.extend(k, apex)?;
            }
        }
        let best = best?;
        let left = || self.faces.iter().filter(|face| !face.gone);
        // Every point of a closed surface around the origin is as far from that as the lowest of its faces.
        let around = |face: &Face| face.height >= best.height - ABOVE;
        let another = |face: &Face| {
            face.height <= best.height + clear && (face.normal - best.normal).length() > SLIVER
        };
        (left().all(around) && !left().any(another)).then_some(best)
    }
}

/// Returns the points that are the highest along a direction, and how high they are; `None` where rounding may decide
/// which ones they are, or which of them are corners.
fn top(
    points: &[Vec3<f64>],
    way: Vec3<f64>,
    highest: Vec3<f64>,
    (slack, clear): (f64, f64),
) -> Option<Vec<usize>> {
    let mut all = Vec::with_capacity(4);
    for (k, &point) in points.iter().enumerate() {
        let below = way.dot(highest - point);
        if below.abs() <= slack.max(2.0 * ABOVE) {
            all.push(k);
        } else if below <= clear {
            return None;
        }
    }
    let is_clear = |[i, j, k]: [usize; 3]| {
        let (u, v) = (points[j] - points[i], points[k] - points[j]);
        let most = u.length_squared().max(v.length_squared());
        way.dot(u.cross(v)).abs() > SLIVER * most
    };
    let clear = match all[..] {
        [_] => true,
        [i, j] => (points[j] - points[i]).length() > SLIVER,
        [i, j, k] => is_clear([i, j, k]),
        _ => {
            let first = unit(points[all[1]] - points[all[0]]);
            let second = way.cross(first);
            let seen = |k: &usize| {
                let arm = points[*k] - points[all[0]];
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
    [a, b]: [&[Vec3<f64>]; 2],
    columns: &[PointColumns; 2],
    first: Option<[Vec3<f64>; 4]>,
    depth: f64,
    slack: f64,
) -> Option<Vec<HullFeatures>> {
    let clear = CLEAR.max(4.0 * slack);
    let mut polytope = Polytope {
        a: &columns[0],
        b: &columns[1],
        corners: Vec::with_capacity(CORNERS),
        faces: Vec::with_capacity(4 * CORNERS),
        open: Vec::with_capacity(4 * CORNERS),
        seen: Vec::with_capacity(CORNERS),
        border: Vec::with_capacity(CORNERS),
    };
    let face = polytope.expand(first, clear)?;
    if face.height < depth {
        return None;
    }
    let normal = -face.normal;
    let [high, low] = [columns[0].highest(normal).0, columns[1].highest(-normal).0];
    let of_a = top(a, normal, a[high], (slack, clear))?;
    let of_b = top(b, -normal, b[low], (slack, clear))?;
    let one = |pair, first: &[usize], second: &[usize]| {
        Some(vec![HullFeatures::new(pair, first, second)])
    };
    match (&of_a[..], &of_b[..]) {
        (&[_], &[_, _, _]) => one(
            FeaturePair::CornerFace,
            &of_a,
            &spanning(|k| b[k], &of_b, -normal),
        ),
        (&[_, _, _], &[_]) => one(
            FeaturePair::FaceCorner,
            &spanning(|k| a[k], &of_a, normal),
            &of_b,
        ),
        (&[i, j], &[k, l]) => {
            let (u, v) = (a[j] - a[i], b[l] - b[k]);
            let product = u.cross(v);
            let sine = product.length() / (u.length() * v.length());
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
            let side = |points, corners| Side { points, corners };
            let found = patch::features(side(a, &of_a), side(b, &of_b), &plane, slack);
            // Without any the plane's own features stand for them.
            let known = found.iter().all(|one| one.pair != FeaturePair::Corners);
            known.then_some(found)
        }
    }
}
