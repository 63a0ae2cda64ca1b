//! Measures and energies of meshes: sums over faces and edges of straight lines.
use super::mesh_column::Mesh;
use crate::{Scalar, Triangle3, Vec3};

/// A measure or an energy of a mesh: a sum over its faces, or over given edges.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum MeshEnergy<'a> {
    /// The area of all faces, at least 0. Kinks: faces without area, with derivative zero.
    Area,
    /// The volume inside a closed mesh: six times it is the sum of the determinants of all faces. It is negative where
    /// faces look inward. Derivatives of a mesh that is not closed are those of the cones over its faces from the first
    /// corner of the first one, which stays where it is.
    Volume,
    /// Half of the sum of squared differences of edges from their lengths at rest. Kinks: edges without length, with
    /// derivative zero.
    Springs {
        /// The edges, each two vertices; [`Mesh::edges`] gives all of a mesh.
        edges: &'a [[u32; 2]],
        /// The length of each at rest.
        lengths: &'a [f64],
    },
    /// Half of the integral of the squared gradient of a function that is linear on each face (Pinkall and Polthier,
    /// Computing discrete minimal surfaces and their conjugates, 1993), at least 0. Faces without area have none.
    Dirichlet {
        /// The function at each vertex.
        values: &'a [f64],
    },
    /// Half of the sum over inner edges of the squared angle between the normals of both faces, less the angle at rest,
    /// times three times the squared length over the area of both (Grinspun and others, Discrete shells, 2003). Kinks:
    /// faces folded onto each other, where the angle jumps; faces without area count as flat.
    Bending {
        /// The hinges; [`Mesh::hinges`] gives all of a mesh.
        hinges: &'a [[u32; 4]],
        /// The angle of each at rest, in radians, from −π to π; positive where faces look away from each other.
        angles: &'a [f64],
    },
}

/// Returns a divisor that is not zero.
#[inline]
fn safe<S: Scalar>(x: S) -> S {
    S::select(x.equals(S::zero()), S::one(), x)
}

/// Returns the determinant of a face's corners from an apex over six: the volume of the cone over it.
#[must_use]
pub fn cone_volume<S: Scalar>(apex: Vec3<S>, triangle: Triangle3<S>) -> S {
    let [a, b, c] = triangle.corners().map(|corner| corner - apex);
    a.dot(b.cross(c)) * S::lit(1.0 / 6.0)
}

/// Returns half of the integral of the squared gradient of a linear function over a face; zero for a face without area.
#[must_use]
pub fn dirichlet_of_face<S: Scalar>(triangle: Triangle3<S>, [u, v, w]: [S; 3]) -> S {
    let Triangle3 { a, b, c } = triangle;
    let area = triangle.area();
    let turned = (c - b) * u + (a - c) * v + (b - a) * w;
    let found = turned.length_squared().over(safe(area * S::lit(8.0)));
    S::select(area.equals(S::zero()), S::zero(), found)
}

/// Returns the angle from the normal of one face to that of the other, in radians from −π to π, about the edge that they
/// share: positive where they look away from each other, zero where they are flat.
///
/// The hinge is the edge's start and end in the direction of the first face, then the third corners of both faces. Kinks:
/// faces folded onto each other, where it jumps from π to −π; faces without area, where it is zero.
///
/// ```
/// use geograd::Vec3;
/// use geograd::mesh::hinge_angle;
/// let [a, b, c, d] = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, -1.0)].map(|(x, y, z)| Vec3::new(x, y, z));
/// assert_eq!(hinge_angle([a, b, c, d]), std::f64::consts::FRAC_PI_2);
/// ```
#[must_use]
pub fn hinge_angle<S: Scalar>([a, b, c, d]: [Vec3<S>; 4]) -> S {
    let edge = b - a;
    let (first, second) = (edge.cross(c - a), (d - a).cross(edge));
    first
        .cross(second)
        .dot(edge)
        .atan2(first.dot(second) * edge.length())
}

/// Returns the bending energy of one hinge, for its angle at rest; zero where both faces have no area.
#[must_use]
pub fn bending_of_hinge<S: Scalar>(hinge: [Vec3<S>; 4], rest: S) -> S {
    let [a, b, c, d] = hinge;
    let area = Triangle3 { a, b, c }.area() + Triangle3 { a: b, b: a, c: d }.area();
    let bend = hinge_angle(hinge) - rest;
    let found = (bend * bend * (b - a).length_squared() * S::lit(1.5)).over(safe(area));
    S::select(area.equals(S::zero()), S::zero(), found)
}

impl<S: Scalar<Mask = bool>> Mesh<'_, S> {
    fn over_faces<T>(&self, none: T, mut add: impl FnMut(T, Triangle3<S>) -> T) -> T {
        let faces = 0..self.faces().len() as u32;
        faces.fold(none, |sum, face| add(sum, self.triangle(face)))
    }
    /// Returns the first corner of the first face, without derivatives.
    pub(crate) fn apex(&self) -> Vec3<S> {
        let Vec3 { x, y, z } = self.triangle(0).a;
        let [x, y, z] = [x, y, z].map(|x| S::from_primal(x.primal()));
        Vec3::new(x, y, z)
    }
    /// Returns the area of all faces: see [`MeshEnergy::Area`].
    #[must_use]
    pub fn area(&self) -> S {
        self.over_faces(S::zero(), |sum, triangle| sum + triangle.area())
    }
    /// Returns the volume inside a closed mesh: see [`MeshEnergy::Volume`].
    ///
    /// ```
    /// use geograd::Vec3;
    /// use geograd::mesh::Mesh;
    /// let corners = [(0.0, 0.0, 0.0), (3.0, 0.0, 0.0), (0.0, 3.0, 0.0), (0.0, 0.0, 3.0)];
    /// let vertices = corners.map(|(x, y, z)| Vec3::new(x, y, z));
    /// let mesh = Mesh::new(&vertices, &[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
    /// assert_eq!((mesh.volume(), mesh.centroid()), (4.5, Vec3::new(0.75, 0.75, 0.75)));
    /// # Ok::<(), geograd::mesh::MeshFault>(())
    /// ```
    #[must_use]
    pub fn volume(&self) -> S {
        let apex = self.apex();
        self.over_faces(S::zero(), |sum, triangle| sum + cone_volume(apex, triangle))
    }
    /// Returns the centroid of the volume inside a closed mesh; the mean of the vertices of faces, without derivative, for
    /// volume zero.
    #[must_use]
    pub fn centroid(&self) -> Vec3<S> {
        let (volume, moment) = self.over_faces((S::zero(), Vec3::zero()), |sum, triangle| {
            let (volume, moment) = self.cone_moment(triangle);
            (sum.0 + volume, sum.1 + moment)
        });
        self.centroid_of(volume, moment)
    }
    /// Returns the volume of the cone over a face from the [apex](Mesh::apex), and its moment about that.
    pub(crate) fn cone_moment(&self, triangle: Triangle3<S>) -> (S, Vec3<S>) {
        let apex = self.apex();
        let volume = cone_volume(apex, triangle);
        let [a, b, c] = triangle.corners().map(|corner| corner - apex);
        (volume, (a + b + c) * (volume * S::lit(0.25)))
    }
    /// Returns the centroid from the volume and the moment about the apex.
    pub(crate) fn centroid_of(&self, volume: S, moment: Vec3<S>) -> Vec3<S> {
        if volume.equals(S::zero()) {
            let sum = self.over_faces(Vec3::zero(), |sum, triangle| sum + triangle.center());
            let count = S::lit(self.faces().len() as f64);
            let [x, y, z] = [sum.x, sum.y, sum.z].map(|x| S::from_primal(x.over(count).primal()));
            return Vec3::new(x, y, z);
        }
        self.apex() + moment * S::one().over(volume)
    }
    /// Returns half of the integral of the squared gradient of a function, by its values at the vertices: see
    /// [`MeshEnergy::Dirichlet`]. Missing values are zero.
    #[must_use]
    pub fn dirichlet(&self, values: &[S]) -> S {
        let value = |vertex: u32| values.get(vertex as usize).copied().unwrap_or(S::zero());
        let faces = self.faces().iter().enumerate();
        faces.fold(S::zero(), |sum, (face, corners)| {
            sum + dirichlet_of_face(self.triangle(face as u32), corners.map(value))
        })
    }
}

impl<S: Copy> Mesh<'_, S> {
    /// Returns the edges of all faces, each once, from the lower vertex to the higher one, in the order of these.
    ///
    /// ```
    /// use geograd::Vec3;
    /// use geograd::mesh::Mesh;
    /// let vertices = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)].map(|(x, y, z)| Vec3::new(x, y, z));
    /// let mesh = Mesh::new(&vertices, &[[0, 1, 2], [0, 2, 3]])?;
    /// assert_eq!(mesh.edges(), [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]]);
    /// assert_eq!(mesh.hinges(), [[2, 0, 1, 3]]);
    /// # Ok::<(), geograd::mesh::MeshFault>(())
    /// ```
    #[must_use]
    pub fn edges(&self) -> Vec<[u32; 2]> {
        let mut all: Vec<[u32; 2]> = Vec::with_capacity(3 * self.faces().len());
        for &[a, b, c] in self.faces() {
            let edges = [[a, b], [b, c], [c, a]].map(|[i, j]| [i.min(j), i.max(j)]);
            all.extend(edges.iter().filter(|edge| edge[0] != edge[1]));
        }
        all.sort_unstable();
        all.dedup();
        all
    }
    /// Returns the edges that exactly two faces pass, in opposite directions: start and end as the first face has them,
    /// then the third corners of the first and of the second face. They are in the order of the edges.
    #[must_use]
    pub fn hinges(&self) -> Vec<[u32; 4]> {
        let mut passes: Vec<(u32, u32, u32, u32, u32)> = Vec::with_capacity(3 * self.faces().len());
        for (face, &[a, b, c]) in self.faces().iter().enumerate() {
            for (from, to, other) in [(a, b, c), (b, c, a), (c, a, b)] {
                passes.push((from.min(to), from.max(to), face as u32, from, other));
            }
        }
        passes.sort_unstable();
        let edges = passes.chunk_by(|p, q| (p.0, p.1) == (q.0, q.1));
        edges
            .filter_map(|passes| match passes {
                &[(low, high, _, from, first), (.., back, second)]
                    if from != back && low != high =>
                {
                    Some([from, if from == low { high } else { low }, first, second])
                }
                _ => None,
            })
            .collect()
    }
}
