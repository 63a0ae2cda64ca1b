//! Cotangents of nearest points of meshes, solids and other meshes, against differences of whole queries.
use super::mesh_shapes::{Owned, bumpy_sphere, cube, one_face};
use super::near_solids::{moved, pairs_of_meshes, stepped, turn, with_stepped};
use crate::space::draw::Random;
use geograd::distance3::PointPair3;
use geograd::kernels::Cpu;
use geograd::kernels::mesh_solids::{PairBars, SolidPoints};
use geograd::mesh::{Mesh, MeshTree};
use geograd::{Aabb3, Capsule3, Obb3, Pack, Pose3, RoundBox3, Segment3, Sphere, Vec3};

/// The step of differences.
const STEP: f64 = 1e-6;

/// Returns the sum of both points, each number times a weight.
fn weighed(pair: &PointPair3<f64>, by: &PointPair3<f64>) -> f64 {
    pair.on_a.dot(by.on_a) + pair.on_b.dot(by.on_b)
}

fn weights(random: &mut Random) -> PointPair3<f64> {
    PointPair3 {
        on_a: random.vector(1.0),
        on_b: random.vector(1.0),
    }
}

/// Returns cotangents along a way, which are as long as the shape has numbers.
fn along<P: Pack<Scalar = f64> + Clone>(bar: &P, way: &[f64]) -> f64 {
    let (mut sum, mut way) = (0.0, way.iter());
    bar.clone()
        .each(&mut |bar| sum += *bar * way.next().expect("is long enough"));
    sum
}

fn of_vertices(bars: &[Vec3<f64>], ways: &[Vec3<f64>]) -> f64 {
    bars.iter().zip(ways).map(|(bar, way)| bar.dot(*way)).sum()
}

/// Returns `false` where nearest points jump, which both differences tell by their size or by each other.
fn agrees(name: &str, slope: f64, sides: [f64; 2]) -> bool {
    let size = 1.0 + slope.abs();
    if (sides[0] - sides[1]).abs() > 1e-3 * size {
        return false;
    }
    let middle = 0.5 * (sides[0] + sides[1]);
    let error = (middle - slope).abs();
    assert!(error <= 1e-4 * size, "{name}: {slope} {sides:?}");
    true
}

/// Returns how many solids have been compared.
fn judge<B>(owned: &Owned, name: &str, solids: &[B], random: &mut Random) -> usize
where
    B: SolidPoints<f64> + Pack<Scalar = f64, With<f64> = B>,
{
    let (mesh, cpu) = (owned.mesh(), Cpu::new());
    let tree = MeshTree::new(&mesh);
    let surface = tree.on(&mesh).unwrap();
    let ways: Vec<_> = owned.vertices.iter().map(|_| random.vector(1.0)).collect();
    let faces = cpu.nearest_faces_to(&surface, solids).unwrap();
    let up: Vec<_> = solids.iter().map(|_| weights(random)).collect();
    let found = cpu.solid_closest_points(&surface, solids, &faces).unwrap();
    let mut judged = 0;
    for (k, &solid) in solids.iter().enumerate() {
        // The curvature of nearest points grows without bound near contact.
        if surface.distance_to(solid) < 0.02 {
            continue;
        }
        let bars = cpu.solid_closest_points_vjp(&surface, &[solid], &[faces[k]], &[up[k]]);
        let bars = bars.unwrap();
        let way: Vec<f64> = (0..64).map(|_| random.within(-1.0, 1.0)).collect();
        let slope = of_vertices(&bars.vertices, &ways) + along(&bars.queries[0], &way);
        let sides = [STEP, -STEP].map(|step| {
            let vertices = stepped(owned, &ways, step);
            let mesh = Mesh::new(&vertices, &owned.faces).unwrap();
            let tree = MeshTree::new(&mesh);
            let there = tree.on(&mesh).unwrap();
            let there = there.closest_points_to(moved(&solid, &way, step));
            (weighed(&there, &up[k]) - weighed(&found[k], &up[k])) / step
        });
        judged += usize::from(agrees(&format!("{}, {name} {k}", owned.name), slope, sides));
    }
    judged
}

#[test]
fn nearest_points_of_solids_have_the_slopes_of_differences() {
    if !geograd_tests::is_due("nearest_points_of_solids_have_the_slopes_of_differences") {
        return;
    }
    let mut random = Random(0x50f1_d5ea_0000_0013);
    let mut judged = [0; 6];
    for owned in [cube(), one_face(), bumpy_sphere(2)] {
        let random = &mut random;
        let centers: Vec<_> = (0..30).map(|_| random.vector(2.5)).collect();
        let balls: Vec<_> = centers.iter().map(|&at| Sphere::new(at, 0.2)).collect();
        judged[0] += judge(&owned, "balls", &balls, random);
        let ends: Vec<_> = centers.iter().map(|&at| at + random.vector(1.0)).collect();
        let both = || centers.iter().zip(&ends);
        let capsules: Vec<_> = both().map(|(&a, &b)| Capsule3::new(a, b, 0.1)).collect();
        judged[1] += judge(&owned, "capsules", &capsules, random);
        let segments: Vec<_> = both().map(|(&a, &b)| Segment3::new(a, b)).collect();
        judged[2] += judge(&owned, "segments", &segments, random);
        let boxes: Vec<_> = centers
            .iter()
            .map(|&at| Obb3::new(at, Vec3::new(0.4, 0.2, 0.7), turn(random)))
            .collect();
        judged[3] += judge(&owned, "boxes", &boxes, random);
        let rounded: Vec<_> = boxes
            .iter()
            .map(|&inner| RoundBox3::new(inner, 0.05))
            .collect();
        judged[4] += judge(&owned, "round boxes", &rounded, random);
        let half = Vec3::new(0.2, 0.1, 0.3);
        let upright: Vec<_> = centers
            .iter()
            .map(|&at| Aabb3::new(at - half, at + half))
            .collect();
        judged[5] += judge(&owned, "upright boxes", &upright, random);
    }
    assert!(judged.iter().all(|&count| count >= 15), "{judged:?}");
}

#[test]
fn nearest_points_of_meshes_have_the_slopes_of_differences() {
    let (mut random, cpu) = (Random(0x50f1_d5ea_0000_0014), Cpu::new());
    let mut judged = 0;
    for (first, second) in pairs_of_meshes() {
        let both = [&first, &second];
        let ways =
            both.map(|own| -> Vec<_> { own.vertices.iter().map(|_| random.vector(1.0)).collect() });
        let run = |pose: Pose3<f64>, step: f64, up: &PointPair3<f64>| {
            with_stepped(both, &ways, step, |surfaces| {
                let [own, other] = surfaces;
                let pairs = cpu.nearest_pairs(own, other, &[pose]).unwrap();
                let apart = cpu.pair_distances(surfaces, &[pose], &pairs).unwrap()[0];
                let spots = cpu.pair_closest_points(surfaces, &[pose], &pairs).unwrap();
                let bars = cpu.pair_closest_points_vjp(surfaces, &[pose], &pairs, &[*up]);
                (apart, weighed(&spots[0], up), bars.unwrap())
            })
        };
        for k in 0..20 {
            let pose = Pose3::new(random.vector(4.0), turn(&mut random));
            let way: Vec<f64> = (0..7).map(|_| random.within(-1.0, 1.0)).collect();
            let up = weights(&mut random);
            let (apart, here, PairBars { poses, vertices }) = run(pose, 0.0, &up);
            if apart < 0.02 {
                continue;
            }
            let of = |k: usize| of_vertices(&vertices[k], &ways[k]);
            let slope = of(0) + of(1) + along(&poses[0], &way);
            let sides = [STEP, -STEP]
                .map(|step| (run(moved(&pose, &way, step), step, &up).1 - here) / step);
            judged += usize::from(agrees(&format!("{} {k}", first.name), slope, sides));
        }
    }
    assert!(judged > 30, "{judged}");
}
