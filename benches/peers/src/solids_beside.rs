//! Distances of solids and of other meshes from a mesh next to parry3d.
use super::Dice;
use super::timed::Timed;
use geograd::kernels::Cpu;
use geograd::kernels::mesh_solids::SolidItem;
use geograd::mesh::{Mesh, MeshTree};
use geograd::{Capsule3, Hull3, Obb3, Pose3, Rotation3, Sphere, Vec3};
use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::query;
use parry3d_f64::shape::{Ball, Capsule, ConvexPolyhedron, Cuboid, Shape, TriMesh};
use std::hint::black_box;

/// The number of solids or poses of a call.
const QUERIES: usize = 500;
/// How often all takes its turn.
const ROUNDS: usize = 4;

type Faces = (Vec<Vec3<f64>>, Vec<[u32; 3]>);

fn vector(v: Vec3<f64>) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

fn rotation(dice: &mut Dice) -> Rotation3<f64> {
    let [x, y, z] = [0, 1, 2].map(|_| dice.within(-3.0, 3.0));
    Rotation3::from_rotation_vector(Vec3::new(x, y, z))
}

fn placed(pose: Pose3<f64>) -> Pose {
    let q = pose.rotation.normalized();
    let turn = Rotation::from_xyzw(q.x, q.y, q.z, q.w).normalize();
    Pose::from_parts(vector(pose.translation), turn)
}

/// Times solids of one kind.
fn line<B: SolidItem<f64>>(
    name: &str,
    (mesh, tree, other): (&Mesh<'_, f64>, &MeshTree, &TriMesh),
    solids: &[B],
    theirs: &[(Pose, Box<dyn Shape>)],
) {
    let cpu = Cpu::new();
    let surface = tree.on(mesh).expect("is its tree");
    let run = || {
        let faces = cpu.nearest_faces_to(&surface, solids).expect("are valid");
        let all = cpu.solid_distances(&surface, solids, &faces);
        (faces, all.expect("of these solids"))
    };
    let parrys = |(pose, shape): &(Pose, Box<dyn Shape>)| {
        query::distance(&Pose::IDENTITY, other, pose, &**shape)
            .expect("is supported")
            .distance
    };
    let (_, values) = run();
    let apart: Vec<f64> = theirs.iter().map(parrys).collect();
    let worst = values.iter().zip(&apart);
    let worst = worst.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let ones = vec![1.0; solids.len()];
    let timed = [
        Timed::new(1, || drop(black_box(run()))),
        Timed::new(1, || {
            let (faces, _) = run();
            let bars = cpu.solid_distances_vjp(&surface, solids, &faces, &ones);
            drop(black_box(bars));
        }),
        Timed::new(1, || {
            black_box(theirs.iter().map(parrys).sum::<f64>());
        }),
    ];
    told(name, timed, worst, &values);
}

/// Writes a line of the table.
fn told(name: &str, mut timed: [Timed<'_>; 3], worst: f64, values: &[f64]) {
    for _ in 0..ROUNDS {
        timed.iter_mut().for_each(Timed::turn);
    }
    let each = 1.0 / values.len() as f64;
    let [own, gradient, theirs] = timed.map(|own| own.microseconds() * each);
    let meet = values.iter().filter(|&&x| x == 0.0).count();
    println!(
        "| {name} | {own:.2} | {:.2} | {theirs:.2} | {:.1} | {meet} of {} | {worst:.0e} |",
        gradient / own,
        theirs / own,
        values.len()
    );
}

/// Times solids around a mesh, and the mesh beside itself.
pub fn table(name: &str, (vertices, faces): &Faces) {
    let mut dice = Dice(21);
    let mesh = Mesh::new(vertices, faces).expect("is valid");
    let tree = MeshTree::new(&mesh);
    let corners: Vec<_> = vertices.iter().map(|&v| vector(v)).collect();
    let other = TriMesh::new(corners, faces.clone()).expect("is valid");
    let all = (&mesh, &tree, &other);
    for (reach, place) in [(0.02, "near"), (0.6, "around")] {
        let way = |dice: &mut Dice, size: f64| {
            let [x, y, z] = [0, 1, 2].map(|_| dice.within(-size, size));
            Vec3::new(x, y, z)
        };
        let places: Vec<Vec3<f64>> = (0..QUERIES)
            .map(|k| match place {
                "near" => vertices[k * 7919 % vertices.len()] + way(&mut dice, reach),
                _ => way(&mut dice, reach),
            })
            .collect();
        let balls: Vec<_> = places.iter().map(|&v| Sphere::new(v, 0.005)).collect();
        let theirs: Vec<(Pose, Box<dyn Shape>)> = balls
            .iter()
            .map(|own| {
                let ball: Box<dyn Shape> = Box::new(Ball::new(own.radius));
                (Pose::from_translation(vector(own.center)), ball)
            })
            .collect();
        line(&format!("{name}, balls {place}"), all, &balls, &theirs);
        let capsules: Vec<_> = places
            .iter()
            .map(|&v| Capsule3::new(v, v + way(&mut dice, 0.05), 0.005))
            .collect();
        let theirs: Vec<(Pose, Box<dyn Shape>)> = capsules
            .iter()
            .map(|own| {
                let (a, b) = (vector(own.start), vector(own.end));
                let capsule: Box<dyn Shape> = Box::new(Capsule::new(a, b, own.radius));
                (Pose::IDENTITY, capsule)
            })
            .collect();
        line(
            &format!("{name}, capsules {place}"),
            all,
            &capsules,
            &theirs,
        );
        let boxes: Vec<_> = places
            .iter()
            .map(|&v| Obb3::new(v, Vec3::new(0.1, 0.02, 0.03), rotation(&mut dice)))
            .collect();
        let theirs: Vec<(Pose, Box<dyn Shape>)> = boxes
            .iter()
            .map(|own| {
                let cuboid: Box<dyn Shape> = Box::new(Cuboid::new(vector(own.size * 0.5)));
                (placed(own.world_from_local()), cuboid)
            })
            .collect();
        line(&format!("{name}, boxes {place}"), all, &boxes, &theirs);
        let hulls: Vec<Hull3<f64, 16>> = places
            .iter()
            .map(|&v| {
                let corners: Vec<_> = (0..16).map(|_| v + way(&mut dice, 0.02)).collect();
                Hull3::from_vertices(&corners)
            })
            .collect();
        let theirs: Vec<(Pose, Box<dyn Shape>)> = hulls
            .iter()
            .map(|own| {
                let corners: Vec<_> = own.as_slice().iter().map(|&v| vector(v)).collect();
                let hull = ConvexPolyhedron::from_convex_hull(&corners).expect("has a volume");
                (Pose::IDENTITY, Box::new(hull) as Box<dyn Shape>)
            })
            .collect();
        line(
            &format!("{name}, hulls of 16 {place}"),
            all,
            &hulls,
            &theirs,
        );
    }
    for (reach, place) in [(0.2, "crossing"), (1.3, "apart")] {
        let poses: Vec<Pose3<f64>> = (0..QUERIES / 10)
            .map(|_| {
                let turn = rotation(&mut dice);
                let way = turn * Vec3::new(reach, 0.0, 0.0);
                Pose3::new(way, rotation(&mut dice))
            })
            .collect();
        pairs(&format!("{name}, itself {place}"), all, &poses);
    }
}

/// Times poses of a mesh.
fn pairs(
    name: &str,
    (mesh, tree, other): (&Mesh<'_, f64>, &MeshTree, &TriMesh),
    poses: &[Pose3<f64>],
) {
    let cpu = Cpu::new();
    let surface = &tree.on(mesh).expect("is its tree");
    let run = || {
        let pairs = cpu
            .nearest_pairs(surface, surface, poses)
            .expect("are valid");
        let all = cpu.pair_distances([surface; 2], poses, &pairs);
        (pairs, all.expect("of these poses"))
    };
    let theirs: Vec<Pose> = poses.iter().map(|&pose| placed(pose)).collect();
    let parrys = |pose: &Pose| {
        query::distance(&Pose::IDENTITY, other, pose, other)
            .expect("is supported")
            .distance
    };
    let (_, values) = run();
    let worst = values.iter().zip(&theirs);
    let worst = worst
        .map(|(a, pose)| (a - parrys(pose)).abs())
        .fold(0.0, f64::max);
    let ones = vec![1.0; poses.len()];
    let timed = [
        Timed::new(1, || drop(black_box(run()))),
        Timed::new(1, || {
            let (pairs, _) = run();
            let bars = cpu.pair_distances_vjp([surface; 2], poses, &pairs, &ones);
            drop(black_box(bars));
        }),
        Timed::new(1, || {
            black_box(theirs.iter().map(parrys).sum::<f64>());
        }),
    ];
    told(name, timed, worst, &values);
}

/// Writes the head of the table.
pub fn head() {
    println!(
        "\n| mesh, solids | distance, us a query | with gradient, times | parry3d | ratio | meet | largest difference |"
    );
    println!("| --- | ---: | ---: | ---: | ---: | ---: | ---: |");
}
