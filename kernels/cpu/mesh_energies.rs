//! Measures and energies of one mesh, with gradients for its vertices and sparse Hessians.
//!
//! Terms are computed on all threads and added in their order, in double precision, so that bits are equal for any number
//! of threads. Derivatives are those of duals.
//!
//! ```
//! use geograd::Vec3;
//! use geograd::kernels::Cpu;
//! use geograd::mesh::{Mesh, MeshEnergy};
//! let vertices = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (0.0, 2.0, 0.0)].map(|(x, y, z)| Vec3::new(x, y, z));
//! let mesh = Mesh::new(&vertices, &[[0, 1, 2]])?;
//! let cpu = Cpu::new();
//! assert_eq!(cpu.mesh_energy(MeshEnergy::Area, &mesh)?, 4.0);
//! assert_eq!(cpu.mesh_energy_slopes(MeshEnergy::Area, &mesh)?[1], Vec3::new(1.0, 0.0, 0.0));
//! let energy = MeshEnergy::Springs { edges: &[[0, 1]], lengths: &[3.0] };
//! assert_eq!(cpu.mesh_energy(energy, &mesh)?, 0.5);
//! // The second derivative by the x of vertex 1, twice.
//! assert!(cpu.mesh_energy_hessian(energy, &mesh)?.contains(&(3, 3, 1.0)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
use crate::error::{Argument, Error, Field, Flaw, Validate};
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::checked::check_upstream;
use crate::kernels::cpu::mesh_batches::{each, rounded};
use crate::kernels::row::item::counts::expect;
use crate::kernels::row::item::rows::numbers;
use crate::mesh::{Mesh, MeshEnergy, bending_of_hinge, cone_volume, dirichlet_of_face, plain};
use crate::{Jet, Real, Scalar, Triangle3, Vec3};

/// A number with its derivatives by four vertices.
type Slope = Jet<f64, 12>;
/// A number with its second derivatives by four vertices.
type Bend = Jet<Slope, 12>;

/// An entry of a sparse matrix: row, column, value. Vertex `v` has the rows and columns from `3 v` on, for x, y and z.
pub type Entry<T> = (u32, u32, T);

/// The number of terms whose second derivatives are in memory at once.
const BLOCK: usize = 1 << 14;

/// One term of a sum: its vertices, how many of the four count, and its constants.
struct Term {
    vertices: [u32; 4],
    count: usize,
    constants: [f64; 3],
}

/// An energy over one mesh.
struct Terms<'a, T> {
    energy: MeshEnergy<'a>,
    mesh: &'a Mesh<'a, T>,
    apex: Vec3<f64>,
}

impl<'a, T: Real> Terms<'a, T> {
    fn new(energy: MeshEnergy<'a>, mesh: &'a Mesh<'a, T>) -> Result<Self, Error> {
        check(energy, mesh.vertices().len())?;
        let apex = plain(mesh.apex());
        Ok(Terms { energy, mesh, apex })
    }
    fn count(&self) -> usize {
        match self.energy {
            MeshEnergy::Springs { edges, .. } => edges.len(),
            MeshEnergy::Bending { hinges, .. } => hinges.len(),
            _ => self.mesh.faces().len(),
        }
    }
    fn term(&self, k: usize) -> Term {
        let (vertices, count, constants) = match self.energy {
            MeshEnergy::Springs { edges, lengths } => {
                let [from, to] = edges[k];
                ([from, to, to, to], 2, [lengths[k], 0.0, 0.0])
            }
            MeshEnergy::Bending { hinges, angles } => (hinges[k], 4, [angles[k], 0.0, 0.0]),
            MeshEnergy::Dirichlet { values } => {
                let [a, b, c] = self.mesh.faces()[k];
                ([a, b, c, c], 3, [a, b, c].map(|i| values[i as usize]))
            }
            MeshEnergy::Area | MeshEnergy::Volume => {
                let [a, b, c] = self.mesh.faces()[k];
                ([a, b, c, c], 3, [0.0; 3])
            }
        };
        Term {
            vertices,
            count,
            constants,
        }
    }
    /// Returns the value of a term at vertices with or without derivatives.
    fn value<S: Scalar>(&self, places: [Vec3<S>; 4], constants: [f64; 3]) -> S {
        let [a, b, c, _] = places;
        let [p, q, r] = constants.map(S::lit);
        let face = Triangle3 { a, b, c };
        match self.energy {
            MeshEnergy::Area => face.area(),
            MeshEnergy::Volume => cone_volume(self.apex_of(), face),
            MeshEnergy::Springs { .. } => {
                let longer = (b - a).length() - p;
                (longer * longer).halved()
            }
            MeshEnergy::Dirichlet { .. } => dirichlet_of_face(face, [p, q, r]),
            MeshEnergy::Bending { .. } => bending_of_hinge(places, p),
        }
    }
    fn apex_of<S: Scalar>(&self) -> Vec3<S> {
        let Vec3 { x, y, z } = self.apex;
        Vec3::new(S::lit(x), S::lit(y), S::lit(z))
    }
    fn places(&self, term: &Term) -> [Vec3<f64>; 4] {
        let vertices = self.mesh.vertices();
        term.vertices.map(|i| plain(vertices[i as usize]))
    }
    fn slopes(&self, k: usize) -> [Vec3<f64>; 4] {
        let term = self.term(k);
        let seeded = seeded(self.places(&term), |value, k| Slope {
            value,
            derivative: std::array::from_fn(|j| f64::from(u8::from(j == k))),
        });
        by_vertex(self.value(seeded, term.constants).derivative, term.count)
    }
    fn bend(&self, k: usize) -> [[f64; 12]; 12] {
        let term = self.term(k);
        let seeded = seeded(self.places(&term), |value, k| {
            let unit = |j: usize| f64::from(u8::from(j == k));
            let constant = |value: f64| Slope {
                value,
                derivative: [0.0; 12],
            };
            Bend {
                value: Slope {
                    value,
                    derivative: std::array::from_fn(unit),
                },
                derivative: std::array::from_fn(|j| constant(unit(j))),
            }
        });
        let found: Bend = self.value(seeded, term.constants);
        // Both halves round differently.
        let half = |i: usize, j: usize| found.derivative[i].derivative[j] * 0.5;
        std::array::from_fn(|i| std::array::from_fn(|j| half(i, j) + half(j, i)))
    }
}

/// Returns vertices whose twelve numbers have derivatives of their own.
fn seeded<S: Scalar>(places: [Vec3<f64>; 4], seed: impl Fn(f64, usize) -> S) -> [Vec3<S>; 4] {
    std::array::from_fn(|i| {
        let Vec3 { x, y, z } = places[i];
        Vec3::new(seed(x, 3 * i), seed(y, 3 * i + 1), seed(z, 3 * i + 2))
    })
}

/// Returns derivatives vertex by vertex; those beyond the count repeat the last one and get nothing.
fn by_vertex(all: [f64; 12], count: usize) -> [Vec3<f64>; 4] {
    let vector = |i: usize| match i < count {
        true => Vec3::new(all[3 * i], all[3 * i + 1], all[3 * i + 2]),
        false => Vec3::zero(),
    };
    [0, 1, 2, 3].map(vector)
}

fn broken(argument: &'static str, item: usize, rule: &'static str) -> Error {
    Error::Invalid {
        argument: Argument::Named(argument),
        item,
        flaw: Flaw::Broken(Field::VALUE, rule),
    }
}

/// Checks the columns of an energy.
fn check(energy: MeshEnergy<'_>, vertices: usize) -> Result<(), Error> {
    let is_outside = |&vertex: &u32| vertex as usize >= vertices;
    let (name, constants, count) = match energy {
        MeshEnergy::Area | MeshEnergy::Volume => return Ok(()),
        MeshEnergy::Dirichlet { values } => ("values", values, vertices),
        MeshEnergy::Springs { edges, lengths } => {
            if let Some(k) = edges.iter().position(|edge| edge.iter().any(is_outside)) {
                return Err(broken("edges", k, "is not a pair of vertices of the mesh"));
            }
            ("lengths", lengths, edges.len())
        }
        MeshEnergy::Bending { hinges, angles } => {
            if let Some(k) = hinges.iter().position(|hinge| hinge.iter().any(is_outside)) {
                return Err(broken("hinges", k, "is not four vertices of the mesh"));
            }
            ("angles", angles, hinges.len())
        }
    };
    expect(Argument::Named(name), count, constants.len())?;
    for (item, number) in constants.iter().enumerate() {
        number.validate().map_err(|flaw| Error::Invalid {
            argument: Argument::Named(name),
            item,
            flaw,
        })?;
    }
    Ok(())
}

/// Returns the sums of entries at equal places, in the order of rows and columns.
fn merged<T: Real>(mut entries: Vec<Entry<f64>>) -> Vec<Entry<T>> {
    // Stable, so that sums have the order of terms.
    entries.sort_by_key(|&(row, column, _)| (row, column));
    let same = |p: &Entry<f64>, q: &Entry<f64>| (p.0, p.1) == (q.0, q.1);
    let sums = entries.chunk_by(same).map(|entries| {
        let (row, column, _) = entries[0];
        let sum: f64 = entries.iter().map(|entry| entry.2).sum();
        (row, column, T::nearest(sum))
    });
    sums.collect()
}

impl Cpu {
    /// Returns a measure or an energy of a mesh.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] for a column of another length, [`Error::Invalid`] for a constant that is not finite and for an
    /// edge or a hinge with a vertex that the mesh does not have.
    pub fn mesh_energy<T: Real>(
        &self,
        energy: MeshEnergy<'_>,
        mesh: &Mesh<'_, T>,
    ) -> Result<T, Error> {
        let terms = Terms::new(energy, mesh)?;
        let all = each(terms.count(), 0.0, |k| {
            let term = terms.term(k);
            terms.value(terms.places(&term), term.constants)
        });
        Ok(T::nearest(all.iter().sum()))
    }

    /// Returns the derivatives of an energy by all vertices.
    ///
    /// # Errors
    ///
    /// As [`mesh_energy`](Cpu::mesh_energy).
    pub fn mesh_energy_slopes<T: Real>(
        &self,
        energy: MeshEnergy<'_>,
        mesh: &Mesh<'_, T>,
    ) -> Result<Vec<Vec3<T>>, Error> {
        let terms = Terms::new(energy, mesh)?;
        let all = each(terms.count(), [Vec3::zero(); 4], |k| terms.slopes(k));
        let mut sums = vec![Vec3::zero(); mesh.vertices().len()];
        for (k, slopes) in all.into_iter().enumerate() {
            for (vertex, slope) in terms.term(k).vertices.into_iter().zip(slopes) {
                sums[vertex as usize] += slope;
            }
        }
        Ok(sums.into_iter().map(rounded).collect())
    }

    /// Returns the second derivatives of an energy as a sparse symmetric matrix: every entry once, in the order of rows and
    /// columns, both halves.
    ///
    /// # Errors
    ///
    /// As [`mesh_energy`](Cpu::mesh_energy), and [`Error::TooLarge`] for more rows than 2³².
    pub fn mesh_energy_hessian<T: Real>(
        &self,
        energy: MeshEnergy<'_>,
        mesh: &Mesh<'_, T>,
    ) -> Result<Vec<Entry<T>>, Error> {
        let terms = Terms::new(energy, mesh)?;
        if mesh.vertices().len() > u32::MAX as usize / 3 {
            return Err(Error::TooLarge);
        }
        let mut entries = Vec::new();
        for start in (0..terms.count()).step_by(BLOCK) {
            let count = BLOCK.min(terms.count() - start);
            let all = each(count, [[0.0; 12]; 12], |k| terms.bend(start + k));
            for (k, bend) in all.into_iter().enumerate() {
                let Term {
                    vertices, count, ..
                } = terms.term(start + k);
                let row = |i: usize| 3 * vertices[i / 3] + (i % 3) as u32;
                for (i, values) in bend.iter().enumerate().take(3 * count) {
                    for (j, &value) in values.iter().enumerate().take(3 * count) {
                        entries.push((row(i), row(j), value));
                    }
                }
            }
        }
        Ok(merged(entries))
    }

    /// Returns the second derivatives of [`MeshEnergy::Dirichlet`] by the values: the cotangent Laplacian, positive
    /// semidefinite, as a sparse symmetric matrix with one row per vertex. Its product with the values is the gradient.
    #[must_use]
    pub fn mesh_laplacian<T: Real>(&self, mesh: &Mesh<'_, T>) -> Vec<Entry<T>> {
        let all = each(mesh.faces().len(), [[0.0; 3]; 3], |k| {
            let [a, b, c] = mesh.faces()[k].map(|i| plain(mesh.vertices()[i as usize]));
            let four_areas = 4.0 * Triangle3 { a, b, c }.area();
            let edges = [c - b, a - c, b - a];
            let entry = |p: Vec3<f64>, q: Vec3<f64>| match four_areas > 0.0 {
                true => p.dot(q) / four_areas,
                false => 0.0,
            };
            edges.map(|p| edges.map(|q| entry(p, q)))
        });
        let mut entries = Vec::with_capacity(9 * all.len());
        for (corners, values) in mesh.faces().iter().zip(all) {
            for (&row, values) in corners.iter().zip(values) {
                let values = corners.iter().zip(values);
                entries.extend(values.map(|(&column, value)| (row, column, value)));
            }
        }
        merged(entries)
    }

    /// Returns the centroid of the volume inside a mesh: see [`Mesh::centroid`].
    #[must_use]
    pub fn mesh_centroid<T: Real>(&self, mesh: &Mesh<'_, T>) -> Vec3<T> {
        rounded(of_doubles(mesh, |mesh| mesh.centroid()))
    }

    /// Returns the cotangents of vertices from that of the centroid; zero for volume zero.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a cotangent that is not finite.
    pub fn mesh_centroid_vjp<T: Real>(
        &self,
        mesh: &Mesh<'_, T>,
        upstream: Vec3<T>,
    ) -> Result<Vec<Vec3<T>>, Error> {
        check_upstream(&numbers(&[upstream]), 3)?;
        let (bar, apex) = (plain(upstream), plain(mesh.apex()));
        let (volume, arm) = of_doubles(mesh, |mesh| (mesh.volume(), mesh.centroid() - apex));
        let mut sums = vec![Vec3::zero(); mesh.vertices().len()];
        if volume == 0.0 {
            return Ok(sums.into_iter().map(rounded).collect());
        }
        // A face's part is its volume times the mean of its cone's corners, less the centroid, over the whole volume.
        let by = bar * (1.0 / volume);
        let all = each(mesh.faces().len(), [Vec3::zero(); 3], |k| {
            let [a, b, c] = mesh.plain_triangle(k as u32).map(|corner| corner - apex);
            let reach = by.dot((a + b + c) * 0.25 - arm) / 6.0;
            let quarter = by * (0.25 * a.dot(b.cross(c)) / 6.0);
            [b.cross(c), c.cross(a), a.cross(b)].map(|n| n * reach + quarter)
        });
        for (corners, bars) in mesh.faces().iter().zip(all) {
            for (&vertex, bar) in corners.iter().zip(bars) {
                sums[vertex as usize] += bar;
            }
        }
        Ok(sums.into_iter().map(rounded).collect())
    }
}

/// Runs on a mesh in double precision, which has the same faces.
fn of_doubles<T: Real, R>(mesh: &Mesh<'_, T>, run: impl FnOnce(&Mesh<'_, f64>) -> R) -> R {
    let vertices: Vec<Vec3<f64>> = mesh.vertices().iter().map(|&v| plain(v)).collect();
    run(&mesh.with_vertices(&vertices))
}
