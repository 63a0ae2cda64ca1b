//! Rays against every face one by one.
use super::mesh_shapes::{all, queries};
use crate::space::draw::Random;
use geograd::intersection3::first_hit_triangle;
use geograd::mesh::MeshTree;
use geograd::{Ray3, Vec3};

#[test]
fn hits_are_those_of_all_faces() {
    if !geograd_tests::is_due("hits_are_those_of_all_faces") {
        return;
    }
    let mut random = Random(0x1357_9bdf_0246_8ace);
    let (mut hits, mut misses, mut on_borders) = (0, 0, 0);
    for owned in all() {
        let mesh = owned.mesh();
        let tree = MeshTree::new(&mesh);
        let surface = tree.on(&mesh).unwrap();
        let count = if owned.faces.len() > 1000 { 40 } else { 300 };
        let targets = queries(&owned, &mut random, count);
        for (k, &target) in targets.iter().enumerate() {
            let from = match k % 5 {
                0 => target + Vec3::new(0.0, 0.0, 2.0),
                1 => target + Vec3::new(-3.0, 0.0, 0.0),
                2 => targets[k / 2],
                3 => target + random.vector(1000.0),
                _ => target + random.vector(1.0),
            };
            let direction = (target - from) * [1.0, 0.125, 7.0][k % 3];
            if direction.length() == 0.0 {
                continue;
            }
            let ray = Ray3::new(from, direction);
            let mut expected: Vec<(f64, u32)> = (0..owned.faces.len() as u32)
                .map(|face| (first_hit_triangle(ray, mesh.triangle(face)), face))
                .filter(|(hit, _)| hit.kind > 0.0)
                .map(|(hit, face)| (hit.parameter, face))
                .collect();
            expected.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            on_borders += usize::from(expected.windows(2).any(|x| x[0].0 == x[1].0));
            let found: Vec<(f64, u32)> = surface
                .all_hits(ray)
                .iter()
                .map(|hit| (hit.hit.parameter, hit.face))
                .collect();
            assert_eq!(found, expected, "{}: {ray:?}", owned.name);
            let first = surface
                .first_hit(ray)
                .map(|hit| (hit.hit.parameter, hit.face));
            assert_eq!(first, expected.first().copied(), "{}: {ray:?}", owned.name);
            *(if first.is_some() {
                &mut hits
            } else {
                &mut misses
            }) += 1;
        }
    }
    assert!(
        hits > 1000 && misses > 200 && on_borders > 100,
        "{hits} {misses} {on_borders}"
    );
}

/// Rays along grids, through edges and vertices: exact parity tells inside from outside.
#[test]
fn parity_on_a_grid() {
    let owned = super::mesh_shapes::cube();
    let mesh = owned.mesh();
    let tree = MeshTree::new(&mesh);
    let surface = tree.on(&mesh).unwrap();
    for k in 0..343 {
        let at = [k % 7, k / 7 % 7, k / 49].map(|x| f64::from(x) * 0.25 - 0.25);
        let inside = at.iter().all(|x| (0.0..=1.0).contains(x));
        let border = inside && at.iter().any(|x| [0.0, 1.0].contains(x));
        let [x, y, z] = at;
        let found = surface.encloses(Vec3::new(x, y, z));
        assert!(border || found == inside, "{at:?}: {found}");
    }
}
