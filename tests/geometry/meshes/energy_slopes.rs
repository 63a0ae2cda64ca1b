//! Measures and energies of meshes by other formulas, their derivatives against num-dual's and against differences.
use super::mesh_shapes::{all, bumpy_sphere, cube, one_face, tetrahedron};
use crate::space::draw::Random;
use geograd::error::Error;
use geograd::kernels::Cpu;
use geograd::mesh::{Mesh, MeshEnergy, hinge_angle};
use geograd::{Pack, Scalar, Vec3, gradient};
use geograd_tests::with_threads;
use num_dual::{Dual64, HyperDual64};

/// A sphere with bumps of another shape, whose faces are of all sizes.
fn crumpled(random: &mut Random) -> (Vec<Vec3<f64>>, Vec<[u32; 3]>) {
    let owned = bumpy_sphere(1);
    let crumple = |&v: &Vec3<f64>| v + random.vector(0.1) + Vec3::new(3.0, -2.0, 1.0);
    (owned.vertices.iter().map(crumple).collect(), owned.faces)
}

fn angle_at(a: Vec3<f64>, b: Vec3<f64>, c: Vec3<f64>) -> f64 {
    let (p, q) = ((b - a).normalize_or_zero(), (c - a).normalize_or_zero());
    p.dot(q).clamp(-1.0, 1.0).acos()
}

#[test]
fn measures_are_those_of_other_formulas() {
    let mut random = Random(0xe4e6_5eed_0000_0001);
    for _ in 0..20 {
        let (vertices, faces) = crumpled(&mut random);
        let mesh = Mesh::new(&vertices, &faces).unwrap();
        let values: Vec<f64> = vertices.iter().map(|_| random.within(-1.0, 1.0)).collect();
        let (mut area, mut volume, mut moment, mut energy) = (0.0, 0.0, 0.0, 0.0);
        for corners in &faces {
            let [a, b, c] = corners.map(|i| vertices[i as usize]);
            let [x, y, z] = [b - c, c - a, a - b].map(Vec3::length);
            let s = 0.5 * (x + y + z);
            // Heron.
            let own = (s * (s - x) * (s - y) * (s - z)).sqrt();
            area += own;
            // The prism down to z = 0, and the flow of x²/2 along x.
            let seen = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
            volume += seen / 6.0 * (a.z + b.z + c.z);
            let side = (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y);
            let squares = a.x * a.x + b.x * b.x + c.x * c.x + a.x * b.x + b.x * c.x + c.x * a.x;
            moment += side * squares / 24.0;
            for k in 0..3 {
                let [i, j, l] = [0, 1, 2].map(|m| corners[(k + m) % 3] as usize);
                let angle = angle_at(vertices[l], vertices[i], vertices[j]);
                energy += 0.25 * (values[i] - values[j]).powi(2) / angle.tan();
            }
        }
        let close = |found: f64, expected: f64| {
            assert!(
                (found - expected).abs() < 1e-10 * (1.0 + expected.abs()),
                "{found} {expected}"
            );
        };
        close(mesh.area(), area);
        close(mesh.volume(), volume);
        close(mesh.centroid().x, moment / volume);
        close(mesh.dirichlet(&values), energy);
        let cpu = Cpu::new();
        for (energy, own) in [
            (MeshEnergy::Area, mesh.area()),
            (MeshEnergy::Volume, mesh.volume()),
            (
                MeshEnergy::Dirichlet { values: &values },
                mesh.dirichlet(&values),
            ),
        ] {
            assert_eq!(
                cpu.mesh_energy(energy, &mesh).unwrap().to_bits(),
                own.to_bits()
            );
        }
        let edges = mesh.edges();
        let lengths: Vec<f64> = edges.iter().map(|_| random.within(0.5, 1.5)).collect();
        let springs = MeshEnergy::Springs {
            edges: &edges,
            lengths: &lengths,
        };
        let each = edges.iter().zip(&lengths).map(|(&[i, j], rest)| {
            0.5 * ((vertices[i as usize] - vertices[j as usize]).length() - rest).powi(2)
        });
        close(cpu.mesh_energy(springs, &mesh).unwrap(), each.sum());
    }
}

#[test]
fn edges_and_hinges_are_those_of_euler() {
    for owned in [tetrahedron(), cube(), bumpy_sphere(2)] {
        let mesh = owned.mesh();
        let (edges, hinges) = (mesh.edges(), mesh.hinges());
        assert_eq!(owned.vertices.len() + owned.faces.len(), edges.len() + 2);
        assert_eq!(hinges.len(), edges.len());
        for [a, b, c, d] in hinges {
            let is_face = |face: [u32; 3]| {
                owned
                    .faces
                    .iter()
                    .any(|f| (0..3).any(|k| [f[k], f[(k + 1) % 3], f[(k + 2) % 3]] == face))
            };
            assert!(is_face([a, b, c]) && is_face([b, a, d]));
        }
    }
    assert!(one_face().mesh().hinges().is_empty());
}

#[test]
fn angles_are_those_of_normals() {
    let owned = cube();
    let mut sharp = 0;
    for hinge in owned.mesh().hinges() {
        let angle = hinge_angle(hinge.map(|i| owned.vertices[i as usize]));
        let quarter = std::f64::consts::FRAC_PI_2;
        assert!(angle == 0.0 || (angle - quarter).abs() < 1e-15, "{angle}");
        sharp += usize::from(angle != 0.0);
    }
    // The others are the diagonals.
    assert_eq!(sharp, 12);
    let mut random = Random(0xe4e6_5eed_0000_0002);
    for _ in 0..500 {
        let [a, b, c, d] = [0; 4].map(|_| random.vector(1.0));
        let (m, n) = (
            (b - a).cross(c - a).normalize_or_zero(),
            (d - a).cross(b - a).normalize_or_zero(),
        );
        let found = hinge_angle([a, b, c, d]);
        assert!((found.abs() - m.dot(n).clamp(-1.0, 1.0).acos()).abs() < 1e-7);
        assert_eq!(found > 0.0, m.dot(d - a) < 0.0);
    }
}

/// The energies of a mesh as functions of its vertices, for numbers of any kind.
fn energy_of<S: Scalar<Mask = bool>>(
    kind: usize,
    vertices: &[Vec3<S>],
    faces: &[[u32; 3]],
    values: &[f64],
) -> S {
    let mesh = Mesh::new(vertices, faces).unwrap();
    match kind {
        0 => mesh.area(),
        1 => mesh.volume(),
        2 => mesh.dirichlet(&values.iter().map(|&x| S::lit(x)).collect::<Vec<_>>()),
        3 => mesh
            .edges()
            .iter()
            .zip(values)
            .fold(S::zero(), |sum, (&[i, j], &rest)| {
                let longer = (vertices[i as usize] - vertices[j as usize]).length() - S::lit(rest);
                sum + longer * longer * S::lit(0.5)
            }),
        _ => mesh
            .hinges()
            .iter()
            .zip(values)
            .fold(S::zero(), |sum, (hinge, &rest)| {
                let [a, b, c, d] = hinge.map(|i| vertices[i as usize]);
                let area =
                    ((b - a).cross(c - a).length() + (b - a).cross(d - a).length()) * S::lit(0.5);
                let bend = hinge_angle([a, b, c, d]) - S::lit(rest);
                sum + bend * bend * (b - a).length_squared() * S::lit(1.5) / area
            }),
    }
}

#[test]
fn slopes_and_hessians_are_those_of_num_dual_and_of_differences() {
    let (cpu, mut random) = (Cpu::new(), Random(0xe4e6_5eed_0000_0003));
    let (vertices, faces) = crumpled(&mut random);
    let mesh = Mesh::new(&vertices, &faces).unwrap();
    let (edges, hinges) = (mesh.edges(), mesh.hinges());
    let values: Vec<f64> = edges.iter().map(|_| random.within(0.1, 1.0)).collect();
    let of_vertices = &values[..vertices.len()];
    let energies = [
        MeshEnergy::Area,
        MeshEnergy::Volume,
        MeshEnergy::Dirichlet {
            values: of_vertices,
        },
        MeshEnergy::Springs {
            edges: &edges,
            lengths: &values,
        },
        MeshEnergy::Bending {
            hinges: &hinges,
            angles: &values,
        },
    ];
    let number =
        |slopes: &[Vec3<f64>], i: usize| [slopes[i / 3].x, slopes[i / 3].y, slopes[i / 3].z][i % 3];
    for (kind, energy) in energies.into_iter().enumerate() {
        let of_kind = if kind == 2 { of_vertices } else { &values };
        let close = |found: f64, expected: f64, error: f64| {
            assert!(
                (found - expected).abs() < error * (1.0 + expected.abs()),
                "{energy:?}: {found} {expected}"
            );
        };
        close(
            cpu.mesh_energy(energy, &mesh).unwrap(),
            energy_of(kind, &vertices, &faces, of_kind),
            1e-12,
        );
        let slopes = cpu.mesh_energy_slopes(energy, &mesh).unwrap();
        let hessian = cpu.mesh_energy_hessian(energy, &mesh).unwrap();
        assert!(hessian.is_sorted_by(|p, q| (p.0, p.1) < (q.0, q.1)));
        let at = |i: usize, j: usize| {
            let found =
                hessian.binary_search_by(|entry| (entry.0 as usize, entry.1 as usize).cmp(&(i, j)));
            found.map_or(0.0, |k| hessian[k].2)
        };
        for _ in 0..30 {
            let i = random.below(3 * vertices.len());
            // One that is near, as most entries are zero.
            let corners = faces
                .iter()
                .find(|face| face.contains(&((i / 3) as u32)))
                .unwrap();
            let j = 3 * corners[random.below(3)] as usize + random.below(3);
            let mut duals: Vec<Vec3<Dual64>> = vertices.iter().map(Pack::lift).collect();
            let mut bends: Vec<Vec3<HyperDual64>> = vertices.iter().map(Pack::lift).collect();
            {
                let v = &mut duals[i / 3];
                [&mut v.x, &mut v.y, &mut v.z][i % 3].eps = 1.0;
                let v = &mut bends[i / 3];
                [&mut v.x, &mut v.y, &mut v.z][i % 3].eps1 = 1.0;
                let v = &mut bends[j / 3];
                [&mut v.x, &mut v.y, &mut v.z][j % 3].eps2 = 1.0;
            }
            close(
                number(&slopes, i),
                energy_of(kind, &duals, &faces, of_kind).eps,
                1e-10,
            );
            close(
                at(i, j),
                energy_of(kind, &bends, &faces, of_kind).eps1eps2,
                1e-9,
            );
            assert_eq!(at(i, j), at(j, i));
            // Differences, of values and of slopes.
            let moved = |step: f64| {
                let mut vertices = vertices.clone();
                let v = &mut vertices[i / 3];
                *[&mut v.x, &mut v.y, &mut v.z][i % 3] += step;
                let mesh = Mesh::new(&vertices, &faces).unwrap();
                (
                    cpu.mesh_energy(energy, &mesh).unwrap(),
                    number(&cpu.mesh_energy_slopes(energy, &mesh).unwrap(), j),
                )
            };
            // The apex of volumes moves with its vertex, which a closed mesh does not feel.
            let (up, down) = (moved(1e-5), moved(-1e-5));
            close(number(&slopes, i), (up.0 - down.0) / 2e-5, 1e-6);
            close(at(i, j), (up.1 - down.1) / 2e-5, 1e-5);
        }
    }
}

#[test]
fn the_laplacian_times_values_is_the_slope_by_values() {
    let (cpu, mut random) = (Cpu::new(), Random(0xe4e6_5eed_0000_0004));
    let (vertices, faces) = crumpled(&mut random);
    let mesh = Mesh::new(&vertices, &faces).unwrap();
    let values: Vec<f64> = vertices.iter().map(|_| random.within(-1.0, 1.0)).collect();
    let matrix = cpu.mesh_laplacian(&mesh);
    let (mut products, mut rows) = (vec![0.0; values.len()], vec![0.0; values.len()]);
    for &(row, column, value) in &matrix {
        products[row as usize] += value * values[column as usize];
        rows[row as usize] += value;
    }
    let half: f64 = products.iter().zip(&values).map(|(p, v)| 0.5 * p * v).sum();
    assert!((half - mesh.dirichlet(&values)).abs() < 1e-12 * (1.0 + half));
    for (k, product) in products.iter().enumerate() {
        assert!(rows[k].abs() < 1e-12);
        let mut duals: Vec<Dual64> = values.iter().map(|&v| v.into()).collect();
        duals[k].eps = 1.0;
        let lifted: Vec<Vec3<Dual64>> = vertices.iter().map(Pack::lift).collect();
        let slope = Mesh::new(&lifted, &faces).unwrap().dirichlet(&duals).eps;
        assert!(
            (slope - product).abs() < 1e-11 * (1.0 + slope.abs()),
            "{slope} {product}"
        );
    }
}

#[test]
fn centroids_have_the_slopes_of_duals() {
    let (cpu, mut random) = (Cpu::new(), Random(0xe4e6_5eed_0000_0005));
    let (vertices, faces) = crumpled(&mut random);
    let mesh = Mesh::new(&vertices, &faces).unwrap();
    assert_eq!(cpu.mesh_centroid(&mesh), mesh.centroid());
    let bar = random.vector(1.0);
    let bars = cpu.mesh_centroid_vjp(&mesh, bar).unwrap();
    for (k, found) in bars.iter().enumerate() {
        let of = |v: Vec3<_>| {
            let mut lifted: Vec<_> = vertices.iter().map(Pack::lift).collect();
            lifted[k] = v;
            Mesh::new(&lifted, &faces)
                .unwrap()
                .centroid()
                .dot(bar.lift())
        };
        let (_, expected) = gradient(of, vertices[k]);
        assert!(
            (*found - expected).length() < 1e-12,
            "{k}: {found} {expected}"
        );
    }
}

#[test]
fn hard_meshes_have_finite_numbers_and_any_threads_the_same_bits() {
    if !geograd_tests::is_due("hard_meshes_have_finite_numbers_and_any_threads_the_same_bits") {
        return;
    }
    let cpu = Cpu::new();
    let mut meshes = all();
    meshes.retain(|owned| owned.faces.len() < 1000);
    meshes.push(bumpy_sphere(2));
    for owned in meshes {
        let mesh = owned.mesh();
        let values: Vec<f64> = owned.vertices.iter().map(|v| v.x - 2.0 * v.z).collect();
        let hinges = mesh.hinges();
        let (edges, angles) = (mesh.edges(), vec![0.25; hinges.len()]);
        let lengths = vec![0.5; edges.len()];
        for energy in [
            MeshEnergy::Area,
            MeshEnergy::Volume,
            MeshEnergy::Dirichlet { values: &values },
            MeshEnergy::Springs {
                edges: &edges,
                lengths: &lengths,
            },
            MeshEnergy::Bending {
                hinges: &hinges,
                angles: &angles,
            },
        ] {
            let run = |threads: usize| {
                with_threads(threads, || {
                    let slopes = cpu.mesh_energy_slopes(energy, &mesh).unwrap();
                    (
                        cpu.mesh_energy(energy, &mesh).unwrap(),
                        slopes,
                        cpu.mesh_energy_hessian(energy, &mesh).unwrap(),
                    )
                })
            };
            let (value, slopes, hessian) = run(1);
            assert!(
                value.is_finite() && slopes.iter().all(|v| v.is_finite()),
                "{}",
                owned.name
            );
            assert!(
                hessian.iter().all(|entry| entry.2.is_finite()),
                "{} {energy:?}",
                owned.name
            );
            assert!((value, slopes, hessian) == run(3));
        }
        assert!(
            cpu.mesh_laplacian(&mesh)
                .iter()
                .all(|entry| entry.2.is_finite())
        );
        let bars = cpu
            .mesh_centroid_vjp(&mesh, Vec3::new(1.0, 2.0, 3.0))
            .unwrap();
        assert!(
            bars.iter().all(|v| v.is_finite()) && mesh.centroid().is_finite(),
            "{}",
            owned.name
        );
    }
}

#[test]
fn columns_of_energies_are_checked() {
    let owned = tetrahedron();
    let mesh = owned.mesh();
    let cpu = Cpu::new();
    let of = |energy| cpu.mesh_energy(energy, &mesh).unwrap_err().to_string();
    assert_eq!(
        of(MeshEnergy::Dirichlet { values: &[1.0] }),
        "`values` has 1 items where 4 are needed"
    );
    let edges = [[0, 1], [2, 9]];
    let springs = MeshEnergy::Springs {
        edges: &edges,
        lengths: &[1.0, 1.0],
    };
    assert_eq!(
        of(springs),
        "`edges` item 1: value is not a pair of vertices of the mesh"
    );
    let hinges = [[0, 1, 2, 4]];
    assert_eq!(
        of(MeshEnergy::Bending {
            hinges: &hinges,
            angles: &[0.0]
        }),
        "`hinges` item 0: value is not four vertices of the mesh"
    );
    let springs = MeshEnergy::Springs {
        edges: &edges[..1],
        lengths: &[f64::NAN],
    };
    assert!(matches!(
        cpu.mesh_energy_slopes(springs, &mesh),
        Err(Error::Invalid { item: 0, .. })
    ));
    assert!(
        cpu.mesh_centroid_vjp(&mesh, Vec3::new(0.0, f64::INFINITY, 0.0))
            .is_err()
    );
}
