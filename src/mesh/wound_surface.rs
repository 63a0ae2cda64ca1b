//! Winding numbers of meshes, open ones, too, with derivatives that the border alone has.
//!
//! *Value.* Strips from the border to infinity along −x close a mesh. A closed one has a whole winding number, which a ray
//! along x gives: faces that it leaves, less those that it enters; it passes beside all strips. So the winding number is
//! that whole one plus the solid angles of the strips over 4π (Martens and Bessmeltsev, One-shot method for computing
//! generalized winding numbers, Computer Graphics Forum 44, 2025; as a sum of crossings and a border's integral Martens,
//! Trettner and Bessmeltsev, The antipodal method, 2026). Crossings and signs of strips are exact and agree, as for one
//! point that is moved by less than any number.
//!
//! *Derivative.* The solid angle changes by what the border sweeps. With the edge from `a` to `b`, seen from the point,
//! and `D = |a||b| + a·b`, a moved start has `b×a / (|a| D)`, a moved end `b×a / (|b| D)`.
use super::enclosed_point::crossings;
use super::face_search::SearchRoom;
use super::mesh_border::{BorderEdge, MeshBorder};
use super::mesh_column::plain;
use super::mesh_fault::MeshFault;
use super::mesh_surface::MeshSurface;
use crate::predicate::{Turn, turn};
use crate::{Lanes, Scalar, Triangle3, Vec2, Vec3};
use robust::{Coord3D, orient3d};
use std::f64::consts::PI;

/// The two nodes of Gauss and Legendre in [0, 1]: exact for derivatives up to the fourth.
const NODES: [f64; 2] = [0.211_324_865_405_187_13, 0.788_675_134_594_812_9];

/// Returns the signed solid angle of a triangle as seen from a point, from −2π to 2π: positive where corners run clockwise
/// for the one who looks, as those of a closed mesh do from inside.
///
/// It is by van Oosterom and Strackee, The solid angle of a plane triangle, 1983. Kinks: the triangle, across which it
/// jumps by 4π; there it is zero, and so is that of any point of its plane and that of a triangle without area. The sign
/// is exact for numbers without derivatives.
///
/// ```
/// use geograd::mesh::solid_angle;
/// use geograd::{Triangle3, Vec3};
/// let octant = Triangle3 { a: Vec3::new(1.0, 0.0, 0.0), b: Vec3::new(0.0, 1.0, 0.0), c: Vec3::new(0.0, 0.0, 1.0) };
/// let eighth = solid_angle(Vec3::zero(), octant);
/// assert!((eighth - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
/// ```
#[must_use]
pub fn solid_angle<S: Scalar<Mask = bool>>(point: Vec3<S>, triangle: Triangle3<S>) -> S {
    let [a, b, c] = triangle.corners().map(|corner| corner - point);
    let corner = |v: Vec3<S>| {
        let Vec3 { x, y, z } = plain(v);
        Coord3D { x, y, z }
    };
    let [p, q, r, o] = [triangle.a, triangle.b, triangle.c, point].map(corner);
    let exact = orient3d(p, q, r, o);
    if exact == 0.0 {
        return S::zero();
    }
    // Positive for a point behind the triangle.
    let six = a.dot(b.cross(c));
    let six = six.with_primal(S::Primal::lit(exact));
    let (x, y, z) = (a.length(), b.length(), c.length());
    let rest = x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
    six.atan2(rest) * S::lit(2.0)
}

/// Returns the derivatives of an edge's solid angle by its start and its end, both seen from a point.
#[inline]
pub(crate) fn edge_slopes<S: Scalar<Mask = bool>>(a: Vec3<S>, b: Vec3<S>) -> [Vec3<S>; 2] {
    let (n, along) = (b.cross(a), a.dot(b));
    let (x, y) = (a.length(), b.length());
    // Both are equal; one of them has no difference.
    let square = n.length_squared();
    let divisor = if along.below(S::zero()) {
        square.over(x * y - along)
    } else {
        x * y + along
    };
    if divisor.equals(S::zero()) {
        return [Vec3::zero(); 2];
    }
    let n = n * S::one().over(divisor);
    [n * S::one().over(x), n * S::one().over(y)]
}

/// Returns the length of a vector plus its part along −x, without a difference.
fn lag(v: Vec3<f64>) -> f64 {
    if v.x > 0.0 {
        (v.y * v.y + v.z * v.z) / (v.length() + v.x)
    } else {
        v.length() - v.x
    }
}

/// Returns half of the solid angle of the strip from an edge to infinity along −x, from −π to π, as seen from a point that
/// is moved along y and z by less than any number.
fn half_strip(point: Vec3<f64>, start: Vec3<f64>, end: Vec3<f64>) -> f64 {
    let (a, b) = (start - point, end - point);
    let flat = |v: Vec3<f64>| Vec2::new(v.y, v.z);
    let (p, q) = (flat(a), flat(b));
    let is_ahead = |v: Vec3<f64>, p: Vec2<f64>| v.x > 0.0 && p.x == 0.0 && p.y == 0.0;
    // The way along one axis decides, and that along the other where it does not.
    let sign = |first: f64, second: f64| match first == 0.0 {
        true => (second > 0.0) as i32 - (second < 0.0) as i32,
        false => (first > 0.0) as i32 - (first < 0.0) as i32,
    };
    // A vertex on the ray is seen at the side from which the point has moved.
    let (side, cross, dot) = match (is_ahead(a, p), is_ahead(b, q)) {
        (true, true) => return 0.0,
        (true, false) => (sign(-q.y, q.x), q.y, -q.x),
        (false, true) => (sign(p.y, -p.x), p.y, -p.x),
        (false, false) => {
            let side = match turn(flat(start), flat(end), flat(point)) {
                Turn::Left => 1,
                Turn::Right => -1,
                Turn::Straight => sign(start.z - end.z, end.y - start.y),
            };
            (side, p.perp_dot(q), lag(a) * lag(b) + p.dot(q))
        }
    };
    -f64::from(side) * Scalar::atan2(cross.abs(), dot)
}

/// A mesh with its tree and its border, which has winding numbers. [`MeshBorder::of`] makes it.
///
/// ```
/// use geograd::Vec3;
/// use geograd::mesh::{Mesh, MeshBorder, MeshTree};
/// let corners = [(0.0, 0.0, 0.0), (3.0, 0.0, 0.0), (0.0, 3.0, 0.0), (0.0, 0.0, 3.0)];
/// let vertices = corners.map(|(x, y, z)| Vec3::new(x, y, z));
/// // A tetrahedron without its floor.
/// let mesh = Mesh::new(&vertices, &[[0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
/// let (tree, border) = (MeshTree::new(&mesh), MeshBorder::new(&mesh));
/// let wound = border.of(&tree.on(&mesh)?)?;
/// let inside: f64 = wound.winding_number(Vec3::new(0.2, 0.2, 1.0));
/// assert!(0.7 < inside && inside < 1.0);
/// assert!(wound.signed_distance(Vec3::new(0.2, 0.2, 1.0)) < 0.0);
/// # Ok::<(), geograd::mesh::MeshFault>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct WoundSurface<'a, S> {
    surface: MeshSurface<'a, S>,
    border: &'a MeshBorder,
}

impl MeshBorder {
    /// Returns a surface with this border, ready for winding numbers. The border must be that of the mesh, or of one with
    /// the same faces.
    ///
    /// # Errors
    ///
    /// [`MeshFault::OtherBorder`] for another number of vertices or faces.
    pub fn of<'a, S: Copy>(
        &'a self,
        surface: &MeshSurface<'a, S>,
    ) -> Result<WoundSurface<'a, S>, MeshFault> {
        let mesh = surface.mesh();
        let expected = [mesh.vertices().len(), mesh.faces().len()];
        if expected != self.counts() {
            return Err(MeshFault::OtherBorder {
                expected,
                found: self.counts(),
            });
        }
        Ok(WoundSurface {
            surface: *surface,
            border: self,
        })
    }
}

impl<'a, S: Copy> WoundSurface<'a, S> {
    /// Returns the surface.
    #[must_use]
    #[inline]
    pub fn surface(&self) -> &MeshSurface<'a, S> {
        &self.surface
    }
    /// Returns the border.
    #[must_use]
    #[inline]
    pub fn border(&self) -> &'a MeshBorder {
        self.border
    }
}

impl<S: Scalar<Mask = bool>> WoundSurface<'_, S> {
    /// Returns the winding number of the mesh around a point: the sum of the [solid angles](solid_angle) of all faces over
    /// 4π. It is 1 inside a closed mesh and 0 outside, exactly; around a point on a face it is the mean of both sides, on
    /// an edge or a vertex the share of the directions that lead inside. NaN for a point that is not finite.
    ///
    /// The absolute error is some roundings times the number of border edges; near an edge of the border, where the number
    /// depends on the direction to it, the roundings of that direction. Derivatives are those of the border: zero
    /// for a closed mesh, by points and by vertices. The value jumps by 1 across faces, and derivatives do not. Kinks: edges
    /// of the border, where the derivative is infinite, and zero on the edge itself. Derivatives up to the fourth are
    /// exact.
    #[must_use]
    pub fn winding_number(&self, point: Vec3<S>) -> S {
        let mut sum = S::lit(self.plain_winding_number(plain(point)));
        let still = |v: Vec3<S>| {
            let [x, y, z] = [v.x, v.y, v.z].map(|x| S::from_primal(x.primal()));
            Vec3::new(x, y, z)
        };
        let vertices = self.surface.mesh().vertices();
        for edge in self.border.edges() {
            let ends = [edge.from, edge.to].map(|i| vertices[i as usize] - point);
            let places = ends.map(still);
            let moves = [ends[0] - places[0], ends[1] - places[1]];
            for node in NODES {
                let [a, b] = [0, 1].map(|k| places[k] + moves[k] * S::lit(node));
                let [by_start, by_end] = edge_slopes(a, b);
                let swept = by_start.dot(moves[0]) + by_end.dot(moves[1]);
                sum += swept * S::lit(f64::from(edge.times) / (8.0 * PI));
            }
        }
        sum
    }
    /// Returns the winding number in double precision.
    pub(crate) fn plain_winding_number(&self, point: Vec3<f64>) -> f64 {
        if !point.is_finite() {
            return f64::NAN;
        }
        let (mesh, tree) = (self.surface.mesh(), self.surface.tree());
        let mut room = SearchRoom::default();
        let Some([leaves, enters]) = crossings::<Lanes<f32, 4>, S>(mesh, tree, point, &mut room)
        else {
            let angle = |face: u32| {
                let [a, b, c] = mesh.plain_triangle(face);
                solid_angle(point, Triangle3 { a, b, c })
            };
            return (0..mesh.faces().len() as u32).map(angle).sum::<f64>() / (4.0 * PI);
        };
        let strip = |edge: &BorderEdge| {
            let [start, end] = [edge.from, edge.to].map(|i| plain(mesh.vertices()[i as usize]));
            f64::from(edge.times) * half_strip(point, start, end)
        };
        let strips: f64 = self.border.edges().iter().map(strip).sum();
        f64::from(leaves) - f64::from(enters) + strips / (2.0 * PI)
    }
    /// Returns the distance of a point from the mesh, negative where the winding number is above ½: for meshes that are
    /// not closed, whose faces meet in threes, or that cross themselves.
    ///
    /// Derivatives are those of the distance. Kinks: the mesh itself, where the derivative is zero, and the medial axis.
    /// The sign changes, and the value jumps, where the winding number of an open mesh is ½ away from its faces: in its
    /// holes.
    #[must_use]
    pub fn signed_distance(&self, point: Vec3<S>) -> S {
        let distance = self.surface.distance(point);
        if self.is_inside(point) {
            -distance
        } else {
            distance
        }
    }
    /// Returns `true` where the winding number is above ½.
    pub(crate) fn is_inside(&self, point: Vec3<S>) -> bool {
        self.plain_winding_number(plain(point)) > 0.5
    }
}
