//! The depth of two hulls that clearly overlap: a polytope that is expanded in the difference of both (van den Bergen
//! 2001), from a fat tetrahedron, with a proof of what it finds.
//!
//! The points of b less those of a have a hull, the origin inside. Its nearest facet is the plane that parts the hulls
//! by the least move. Faces of a polytope in it bound that distance from below, planes along its facets from above.
use super::body::unit;
use super::highest_point::PointColumns;
use super::hull_record::{FeaturePair, HullFeatures, spanning};
use super::near_features::long;
use super::parting_planes::Plane;
use super::patch;
use crate::hull::hull_search;
use crate::{Vec2, Vec3};

/// A face of the polytope.
#[derive(Clone, Copy)]
struct Face {
    /// Its corners, counter-clockwise seen from outside.
    corners: [u16; 3],
    /// The sides of other faces across the edges from each corner to the next one.
    beside: [Side; 3],
    normal: Vec3<f64>,
    /// The height of its plane over the origin.
    height: f64,
    /// `true` if it is no face any more.
    gone: bool,
}

/// A side of a face: the edge from a corner to the next one.
#[derive(Clone, Copy)]
struct Side(u16);

impl Side {
    /// Returns the side of a face that begins at one of its corners.
    fn new(face: usize, corner: usize) -> Self {
        Side((4 * face + corner) as u16)
    }
    /// Returns the numbers of the face and of the corner in it.
    fn parts(self) -> (usize, usize) {
        (usize::from(self.0 / 4), usize::from(self.0 % 4))
    }
}

/// An edge around faces below a point: its ends, and the side of the face beyond.
#[derive(Clone, Copy)]
struct Border {
    from: u16,
    to: u16,
    beyond: Side,
}

/// The most corners of the polytope; hulls of 32 corners need about twenty.
const CORNERS: usize = 64;
/// The number of corners and of faces, also those that are gone, for which there is room at first.
const ROOM: [usize; 2] = [16, 20];
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
    a: PointColumns<'a>,
    b: PointColumns<'a>,
    corners: Vec<Vec3<f64>>,
    faces: Vec<Face>,
    /// The heights of faces of which it is not known if something is above them; infinite for all others.
    open: Vec<f64>,
    /// The edges around the faces below a point, counter-clockwise.
    border: Vec<Border>,
}

impl Polytope<'_> {
    /// Returns the highest difference along a direction.
    fn support(&self, way: Vec3<f64>) -> Vec3<f64> {
        let ((_, of_a), (_, of_b)) = (self.a.highest(-way), self.b.highest(way));
        of_b - of_a
    }
    /// Adds a face; `None` for a sliver.
    fn add(&mut self, corners: [usize; 3], beside: [Side; 3]) -> Option<()> {
        let [p, q, r] = corners.map(|k| self.corners[k]);
        let (u, v, w) = (q - p, r - p, r - q);
        let product = u.cross(v);
        let longest = u
            .length_squared()
            .max(v.length_squared())
            .max(w.length_squared());
        let square = product.length_squared();
        if square <= SLIVER * SLIVER * (longest * longest) {
            return None;
        }
        let normal = product * (1.0 / square.sqrt());
        let height = normal.dot(p);
        self.open.push(height);
        self.faces.push(Face {
            corners: corners.map(|k| k as u16),
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
        let side = Side::new;
        self.add([0, b, c], [side(1, 2), side(2, 2), side(3, 2)])?;
        self.add([0, 3, b], [side(3, 1), side(2, 0), side(0, 0)])?;
        self.add([b, 3, c], [side(1, 1), side(3, 0), side(0, 1)])?;
        self.add([c, 3, 0], [side(2, 1), side(1, 0), side(0, 2)])
    }
    /// Takes a face away, with all around it that are below a point, and keeps the sides around these, in order
    /// counter-clockwise, beginning with a side of the face.
    fn take(&mut self, number: usize, first: usize, count: usize, apex: Vec3<f64>) {
        self.faces[number].gone = true;
        self.open[number] = f64::INFINITY;
        for k in first..first + count {
            let face = &self.faces[number];
            let k = if k < 3 { k } else { k - 3 };
            let beyond = face.beside[k];
            let (other, side) = beyond.parts();
            let beside = &self.faces[other];
            if beside.gone {
                continue;
            }
            if beside.normal.dot(apex) - beside.height > ABOVE {
                self.take(other, side + 1, 2, apex);
            } else {
                let next = if k == 2 { 0 } else { k + 1 };
                self.border.push(Border {
                    from: face.corners[k],
                    to: face.corners[next],
                    beyond,
                });
            }
        }
    }
    /// Extends the polytope to a point above a face.
    fn extend(&mut self, start: usize, apex: Vec3<f64>) -> Option<()> {
        let number = self.corners.len();
        if number == CORNERS {
            return None;
        }
        self.corners.push(apex);
        self.border.clear();
        self.take(start, 0, 3, apex);
        let (first, count) = (self.faces.len(), self.border.len());
        let mut last = self.border.last()?.to;
        for k in 0..count {
            let Border { from, to, beyond } = self.border[k];
            // Rounding may put faces below the point that are not in one piece.
            if from != last {
                return None;
            }
            last = to;
            let next = first + if k + 1 < count { k + 1 } else { 0 };
            let before = first + if k > 0 { k - 1 } else { count - 1 };
            let corners = [usize::from(from), usize::from(to), number];
            self.add(corners, [beyond, Side::new(next, 2), Side::new(before, 1)])?;
            let (other, side) = beyond.parts();
            self.faces[other].beside[side] = Side::new(first + k, 0);
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
        // Every point of a closed surface around the origin is as far from that as the lowest of its faces.
        let alone = self.faces.iter().fold(true, |alone, face| {
            let turned = (face.normal - best.normal).length_squared();
            let around = face.height >= best.height - ABOVE;
            let another = (face.height <= best.height + clear) & (turned > SLIVER * SLIVER);
            alone & (face.gone | around & !another)
        });
        alone.then_some(best)
    }
}

/// Returns the points that are as high along a direction as one of them; `None` where rounding may decide which ones they
/// are, or which of them are corners.
fn top(
    points: &PointColumns<'_>,
    way: Vec3<f64>,
    highest: usize,
    (slack, clear): (f64, f64),
) -> Option<Vec<usize>> {
    let height = way.dot(points.point(highest));
    let least = height - slack.max(2.0 * ABOVE);
    let count = points.count_above(way, least);
    if points.count_above(way, height - clear) != count {
        return None;
    }
    if count == 1 {
        return Some(vec![highest]);
    }
    let mut all = Vec::with_capacity(count);
    points.above(way, least, |k| all.push(k));
    let is_clear = |[i, j, k]: [usize; 3]| {
        let [i, j, k] = [i, j, k].map(|k| points.point(k));
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
    let clear = CLEAR.max(4.0 * slack);
    let mut polytope = Polytope {
        a: *a,
        b: *b,
        corners: Vec::with_capacity(ROOM[0]),
        faces: Vec::with_capacity(ROOM[1]),
        open: Vec::with_capacity(ROOM[1]),
        border: Vec::with_capacity(ROOM[0]),
    };
    let face = polytope.expand(first, clear)?;
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
