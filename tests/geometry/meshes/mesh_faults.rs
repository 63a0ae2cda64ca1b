//! Meshes that are refused, and queries without an answer.
use super::mesh_shapes::{cube, one_face};
use crate::space::draw::Random;
use geograd::mesh::{ClosedMesh, Mesh, MeshFault, MeshTree};
use geograd::{Ray3, Vec3};

#[test]
fn faults_name_face_and_vertex() {
    let mut vertices = cube().vertices;
    let faces = cube().faces;
    let of = |vertices: &[Vec3<f64>], faces: &[[u32; 3]]| Mesh::new(vertices, faces).unwrap_err();
    assert_eq!(of(&vertices, &[]), MeshFault::Empty);
    let expected = MeshFault::NoVertex {
        face: 1,
        corner: 2,
        vertex: 8,
    };
    assert_eq!(of(&vertices, &[faces[0], [0, 1, 8]]), expected);
    assert_eq!(
        expected.to_string(),
        "corner 2 of face 1 is vertex 8, which the mesh does not have"
    );
    vertices[5].z = f64::NAN;
    assert_eq!(of(&vertices, &faces), MeshFault::NotFinite { vertex: 5 });
    vertices[3].x = f64::INFINITY;
    assert_eq!(of(&vertices, &faces), MeshFault::NotFinite { vertex: 3 });
}

#[test]
fn closed_meshes_name_their_holes() {
    let (vertices, mut faces) = (cube().vertices, cube().faces);
    faces.pop();
    let mesh = Mesh::new(&vertices, &faces).unwrap();
    let fault = ClosedMesh::new(&mesh).unwrap_err();
    assert_eq!(
        fault,
        MeshFault::Open {
            face: 2,
            edge: [5, 7]
        }
    );
    faces.push([1, 5, 7]);
    let mesh = Mesh::new(&vertices, &faces).unwrap();
    let fault = ClosedMesh::new(&mesh).unwrap_err();
    assert_eq!(
        fault,
        MeshFault::Crowded {
            face: 11,
            edge: [5, 7]
        }
    );
    faces[11] = [1, 7, 5];
    faces.push([1, 7, 5]);
    let mesh = Mesh::new(&vertices, &faces).unwrap();
    let fault = ClosedMesh::new(&mesh).unwrap_err();
    assert_eq!(
        fault,
        MeshFault::Crowded {
            face: 12,
            edge: [1, 7]
        }
    );
    faces[12] = [3, 3, 7];
    let mesh = Mesh::new(&vertices, &faces).unwrap();
    assert!(matches!(
        ClosedMesh::new(&mesh),
        Err(MeshFault::Crowded { .. })
    ));
}

#[test]
fn trees_of_other_meshes_are_refused() {
    let (cube, face) = (cube(), one_face());
    let (mesh, other) = (cube.mesh(), face.mesh());
    let mut tree = MeshTree::new(&mesh);
    let fault = MeshFault::OtherTree {
        expected: [3, 1],
        found: [8, 12],
    };
    assert_eq!(tree.on(&other).unwrap_err(), fault);
    assert_eq!(tree.refit(&other).unwrap_err(), fault);
    assert!(tree.on(&mesh).is_ok());
}

#[test]
fn queries_that_are_not_finite() {
    let owned = cube();
    let mesh = owned.mesh();
    let tree = MeshTree::new(&mesh);
    let surface = tree.on(&mesh).unwrap();
    let nowhere = Vec3::new(f64::NAN, 0.0, 0.0);
    assert!(surface.distance(nowhere).is_nan());
    assert!(surface.closest_point(nowhere).x.is_nan());
    assert!(!surface.encloses(nowhere));
    let ahead = Vec3::new(0.0, 0.0, 1.0);
    assert_eq!(surface.hit_face(Ray3::new(nowhere, ahead)), None);
    assert_eq!(surface.hit_face(Ray3::new(ahead, Vec3::zero())), None);
    // Far away every face is compared.
    for far in [1e5, 1e10, 1e20, 1e40] {
        let found = surface.distance(Vec3::new(0.5, far, 0.25));
        assert!((found - (far - 1.0)).abs() <= 1e-15 * far, "{far}: {found}");
        // From farther away the cube is smaller than the roundings of exact signs.
        if far > 1e10 {
            continue;
        }
        let ray = Ray3::new(Vec3::new(0.5, far, 0.25), Vec3::new(0.0, -2.0, 0.0));
        let hit = surface.first_hit(ray).unwrap().hit;
        assert!(
            (2.0 * hit.parameter - (far - 1.0)).abs() <= 1e-15 * far,
            "{far}: {hit:?}"
        );
    }
}

/// Far queries find many faces equally near; any of them gives the distance, so that the order of faces does not show.
#[test]
fn far_queries_in_any_order_of_faces() {
    let mut random = Random(0x0dd0_ba11_5eed_0001);
    let owned = cube();
    for far in [1e8, 1e13, 1e16, 1e20, 1e40] {
        let mut queries: Vec<_> = (0..20).map(|_| random.vector(far)).collect();
        // Over faces and beside them, where the length of the way there absorbs that of edges.
        for (x, y) in [
            (0.5, 0.25),
            (0.25, 0.75),
            (0.5, 0.5),
            (1.5, 0.25),
            (-0.25, 3.0),
        ] {
            for far in [far, -far] {
                queries.push(Vec3::new(x, y, far));
                queries.push(Vec3::new(x, far, y));
                queries.push(Vec3::new(far, x, y));
            }
        }
        for start in 0..owned.faces.len() {
            let mut faces = owned.faces.clone();
            faces.rotate_left(start);
            faces
                .iter_mut()
                .for_each(|face| face.rotate_left(start % 3));
            let mesh = Mesh::new(&owned.vertices, &faces).unwrap();
            let tree = MeshTree::new(&mesh);
            let surface = tree.on(&mesh).unwrap();
            for &p in &queries {
                let inside = Vec3::new(
                    p.x.clamp(0.0, 1.0),
                    p.y.clamp(0.0, 1.0),
                    p.z.clamp(0.0, 1.0),
                );
                let (found, expected) = (surface.distance(p), (p - inside).length());
                assert!(
                    (found - expected).abs() <= 1e-15 * far,
                    "{p}: {found} {expected}"
                );
                assert!(
                    (surface.closest_point(p) - p).length() <= (1.0 + 1e-15) * expected,
                    "{p}"
                );
            }
        }
    }
}
