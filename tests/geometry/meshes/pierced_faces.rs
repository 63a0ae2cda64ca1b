//! Rays against every face one by one.
use super::mesh_shapes::{Owned, all, queries};
use crate::space::draw::Random;
use geograd::intersection3::first_hit_triangle;
use geograd::kernels::Cpu;
use geograd::mesh::{MeshHit, MeshSurface, MeshTree};
use geograd::{Ray3, Vec3};

/// The parameters and faces of all hits, in order.
fn hits_one_by_one(owned: &Owned, ray: Ray3<f64>) -> Vec<(f64, u32)> {
    let mesh = owned.mesh();
    let mut all: Vec<(f64, u32)> = (0..owned.faces.len() as u32)
        .map(|face| (first_hit_triangle(ray, mesh.triangle(face)), face))
        .filter(|(hit, _)| hit.kind > 0.0)
        .map(|(hit, face)| (hit.parameter, face))
        .collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    all
}

fn assert_hits(
    owned: &Owned,
    surface: &MeshSurface<'_, f64>,
    ray: Ray3<f64>,
    expected: &[(f64, u32)],
) {
    let plain = |hit: &MeshHit<f64>| (hit.hit.parameter, hit.face);
    let found: Vec<(f64, u32)> = surface.all_hits(ray).iter().map(plain).collect();
    assert_eq!(found, expected, "{}: {ray:?}", owned.name);
    let first = surface.first_hit(ray).as_ref().map(plain);
    assert_eq!(first, expected.first().copied(), "{}: {ray:?}", owned.name);
    let all = Cpu::new().hit_faces(surface, &[ray; 33]).unwrap();
    let face = first.map(|(_, face)| face);
    assert!(
        all.iter().all(|own| *own == face),
        "{}: {ray:?}",
        owned.name
    );
}

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
            let expected = hits_one_by_one(&owned, ray);
            on_borders += usize::from(expected.windows(2).any(|x| x[0].0 == x[1].0));
            assert_hits(&owned, &surface, ray, &expected);
            let first = expected.first();
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

/// Rays from 10⁻¹ to 10⁻¹⁷ beside a face, on both sides and in its plane: towards it, away from it and along it.
#[test]
fn hits_of_rays_that_start_beside_a_face() {
    if !geograd_tests::is_due("hits_of_rays_that_start_beside_a_face") {
        return;
    }
    let mut random = Random(0x0246_8ace_1357_9bdf);
    let (mut near, mut misses) = (0, 0);
    for owned in all() {
        let mesh = owned.mesh();
        let tree = MeshTree::new(&mesh);
        let surface = tree.on(&mesh).unwrap();
        let count = if owned.faces.len() > 1000 { 60 } else { 400 };
        for k in 0..count {
            let triangle = mesh.triangle(random.below(owned.faces.len()) as u32);
            let (u, v) = (random.within(0.0, 1.0), random.within(0.0, 1.0));
            let at = triangle.a.lerp(triangle.b, u).lerp(triangle.c, v);
            let normal = triangle.twice_area_normal().normalize_or_zero();
            let height = 0.1_f64.powi(1 + k % 17) * [1.0, -1.0, 0.0][k as usize % 3];
            let along = random.vector(1.0);
            let slope = 0.1_f64.powi(k / 5 % 9) * [1.0, -1.0][k as usize / 2 % 2];
            let flat = along - normal * normal.dot(along);
            let direction = [along, normal * slope + flat, normal * slope][k as usize % 3];
            if direction.length() == 0.0 {
                continue;
            }
            let ray = Ray3::new(at + normal * height, direction);
            let expected = hits_one_by_one(&owned, ray);
            assert_hits(&owned, &surface, ray, &expected);
            near += usize::from(expected.first().is_some_and(|hit| hit.0 < 0.01));
            misses += usize::from(expected.is_empty());
        }
    }
    assert!(near > 500 && misses > 500, "{near} {misses}");
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
