//! Distances of solids and of other meshes from meshes: against every face one by one, and slopes against differences.
use super::mesh_shapes::{Owned, all, bumpy_sphere, cube, one_face};
use crate::space::draw::Random;
use geograd::kernels::Cpu;
use geograd::kernels::mesh_solids::{PairBars, SolidItem};
use geograd::mesh::{FacePair, Mesh, MeshSolid, MeshSurface, MeshTree, SolidBounds, pair_distance};
use geograd::{
    Aabb3, Capsule3, Hull3, Obb3, Pack, Pose3, Rotation3, RoundBox3, Segment3, Sphere, Tetrahedron,
    Triangle3, Vec3,
};
use geograd_tests::with_threads;

/// A place on, above or around a mesh, and a size.
fn place(owned: &Owned, random: &mut Random, k: usize) -> (Vec3<f64>, f64) {
    let t = owned
        .mesh()
        .triangle(random.below(owned.faces.len()) as u32);
    let size = [0.0, 1e-3, 0.1, 2.0][random.below(4)];
    let on = match k % 4 {
        0 => t.a,
        1 => t.a.lerp(t.b, 0.5),
        2 => t.a + (t.b - t.a) * 0.25 + (t.c - t.a) * 0.5,
        _ => random.vector(2.0),
    };
    let away = [0.0, 1e-3, 0.5, 30.0][random.below(4)];
    (on + random.vector(away), size)
}

pub fn turn(random: &mut Random) -> Rotation3<f64> {
    Rotation3::from_rotation_vector(random.vector(3.0))
}

/// Compares what a solid brackets with the distances of triangles, up to some numbers.
fn judge_bracket<B: MeshSolid<f64> + std::fmt::Debug>(
    solid: &B,
    triangles: impl Iterator<Item = Triangle3<f64>>,
    up_to: &[f64],
) {
    let bracket = solid.bracket();
    for triangle in triangles {
        let measured = solid.distance_from(triangle);
        for &most in up_to {
            let [low, high] = bracket(triangle, most);
            let told =
                || format!("{solid:?} {triangle:?} up to {most}: {measured} of {low} to {high}");
            match measured <= most {
                true => assert!(low <= measured && measured <= high, "{}", told()),
                false => assert!(low <= measured || low > most, "{}", told()),
            }
            assert!(high > 0.0 || measured == 0.0, "{}", told());
        }
    }
}

/// Corners on a grid: bodies that touch, lie in one plane, have no extent.
#[test]
fn brackets_hold_the_distances_of_grids() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for k in 0..150 {
        let scale = [1.0, 1e-9, 1e9][k % 3];
        let far = [0.0, 1e6][random.below(2)] * scale;
        let mut corner = || {
            let mut one = || (random.below(5) as f64 - 2.0) * scale;
            Vec3::new(one() + far, one(), one())
        };
        let triangles: Vec<_> = (0..20)
            .map(|_| Triangle3::new(corner(), corner(), corner()))
            .collect();
        let up_to = [0.0, 0.5 * scale, scale, f64::INFINITY];
        let all = || triangles.iter().copied();
        let (a, b) = (corner(), corner());
        judge_bracket(&Triangle3::new(a, b, corner()), all(), &up_to);
        judge_bracket(&Tetrahedron::new(a, b, corner(), corner()), all(), &up_to);
        judge_bracket(&Segment3::new(a, b).bounding(), all(), &up_to);
        let corners: Vec<_> = (0..1 + k % 12).map(|_| corner()).collect();
        judge_bracket(&Hull3::<f64, 12>::from_vertices(&corners), all(), &up_to);
        let size = Vec3::new(1.0, 2.0, (k % 4) as f64) * scale;
        judge_bracket(&Obb3::new(a, size, Rotation3::identity()), all(), &up_to);
        let turned = Obb3::new(a, size, turn(&mut random));
        judge_bracket(&turned, triangles.into_iter(), &up_to);
    }
}

/// Compares the search with all faces, one by one.
fn judge<B: SolidItem<f64> + std::fmt::Debug>(
    surface: &MeshSurface<'_, f64>,
    name: &str,
    solids: &[B],
) {
    let (mesh, cpu) = (surface.mesh(), Cpu::new());
    let found = cpu.nearest_faces_to(surface, solids).unwrap();
    let distances = cpu.solid_distances(surface, solids, &found).unwrap();
    let touching = cpu.touching(surface, solids).unwrap();
    // Batches begin with a number of solids.
    let many = |k: usize| k % solids.len();
    let (repeated, faces): (Vec<B>, Vec<u32>) =
        (0..99).map(|k| (solids[many(k)], found[many(k)])).unzip();
    let repeated = cpu.solid_distances(surface, &repeated, &faces).unwrap();
    for (k, distance) in repeated.into_iter().enumerate() {
        assert_eq!(
            distance.to_bits(),
            distances[many(k)].to_bits(),
            "{name}: {k}"
        );
    }
    for (k, solid) in solids.iter().enumerate() {
        let measured: Vec<f64> = (0..mesh.faces().len() as u32)
            .map(|face| solid.distance_from(mesh.triangle(face)))
            .collect();
        let least = measured.iter().copied().fold(f64::INFINITY, f64::min);
        let lowest = measured.iter().position(|&x| x == least).unwrap();
        assert_eq!(found[k] as usize, lowest, "{name}: {solid:?}");
        assert_eq!(distances[k].to_bits(), least.to_bits(), "{name}: {solid:?}");
        assert_eq!(surface.distance_to(*solid).to_bits(), least.to_bits());
        assert_eq!(touching[k], least == 0.0, "{name}: {solid:?}");
        let triangles = (0..measured.len() as u32).map(|face| mesh.triangle(face));
        judge_bracket(solid, triangles, &[0.0, least, f64::INFINITY]);
        for most in [0.0, least, 0.3] {
            let within = surface.faces_within(*solid, most);
            let expected: Vec<u32> = (0..measured.len() as u32)
                .filter(|&face| measured[face as usize] <= most)
                .collect();
            assert_eq!(within, expected, "{name}: {solid:?} {most}");
        }
    }
}

#[test]
fn searches_find_the_nearest_face_of_all() {
    if !geograd_tests::is_due("searches_find_the_nearest_face_of_all") {
        return;
    }
    let mut random = Random(0x50f1_d5ea_0000_0001);
    let mut meshes = all();
    meshes.pop();
    meshes.push(bumpy_sphere(3));
    for owned in meshes {
        let mesh = owned.mesh();
        let tree = MeshTree::new(&mesh);
        let surface = tree.on(&mesh).unwrap();
        let count = if owned.faces.len() > 1000 { 3 } else { 25 };
        let places: Vec<_> = (0..count).map(|k| place(&owned, &mut random, k)).collect();
        let random = &mut random;
        let mut each = |name: &str, kind: usize| {
            let at = |&(v, size): &(Vec3<f64>, f64), random: &mut Random| match kind {
                0 => (v, v + random.vector(size)),
                _ => (v - random.vector(size), v),
            };
            let ends: Vec<_> = places.iter().map(|own| at(own, random)).collect();
            let name = &format!("{}, {name}", owned.name);
            let radii: Vec<_> = places.iter().map(|own| own.1 * 0.3).collect();
            let inner = |k: usize, random: &mut Random| {
                let size = Vec3::new(1.0, 0.1, 0.5) * places[k].1;
                Obb3::new(places[k].0, size, turn(random))
            };
            match kind {
                0 => {
                    let own = |k: usize| Sphere::new(places[k].0, places[k].1);
                    judge(&surface, name, &(0..count).map(own).collect::<Vec<_>>());
                }
                1 => {
                    let own = |k: usize| Capsule3::new(ends[k].0, ends[k].1, radii[k]);
                    judge(&surface, name, &(0..count).map(own).collect::<Vec<_>>());
                }
                2 => {
                    let own = |k: usize| Segment3::new(ends[k].0, ends[k].1);
                    judge(&surface, name, &(0..count).map(own).collect::<Vec<_>>());
                }
                3 => {
                    let own: Vec<_> = (0..count).map(|k| inner(k, random)).collect();
                    judge(&surface, name, &own);
                }
                4 => {
                    let own: Vec<_> = (0..count)
                        .map(|k| RoundBox3::new(inner(k, random), radii[k]))
                        .collect();
                    judge(&surface, name, &own);
                }
                5 => {
                    let own = |k: usize| {
                        let half = Vec3::new(1.0, 0.5, 0.2) * places[k].1;
                        Aabb3::new(places[k].0 - half, places[k].0 + half)
                    };
                    judge(&surface, name, &(0..count).map(own).collect::<Vec<_>>());
                }
                6 => {
                    let own: Vec<Hull3<f64, 12>> = (0..count)
                        .map(|k| {
                            let corner = |_| places[k].0 + random.vector(places[k].1);
                            let corners: Vec<_> = (0..12).map(corner).collect();
                            Hull3::from_vertices(&corners)
                        })
                        .collect();
                    judge(&surface, name, &own);
                }
                7 => {
                    let own: Vec<_> = (0..count)
                        .map(|k| {
                            let mut corner = || places[k].0 + random.vector(places[k].1);
                            Triangle3::new(corner(), corner(), corner())
                        })
                        .collect();
                    judge(&surface, name, &own);
                }
                _ => {
                    let own: Vec<_> = (0..count)
                        .map(|k| {
                            let mut corner = || places[k].0 + random.vector(places[k].1);
                            Tetrahedron::new(corner(), corner(), corner(), corner())
                        })
                        .collect();
                    judge(&surface, name, &own);
                }
            }
        };
        for (kind, name) in [
            "balls",
            "capsules",
            "segments",
            "boxes",
            "round boxes",
            "upright boxes",
            "hulls",
            "triangles",
            "tetrahedra",
        ]
        .into_iter()
        .enumerate()
        {
            each(name, kind);
        }
    }
}

/// Beyond the range of single precision in a tree's frame all faces are compared.
#[test]
fn solids_beyond_single_precision_are_compared_with_all_faces() {
    let owned = bumpy_sphere(1);
    let mesh = owned.mesh();
    let tree = MeshTree::new(&mesh);
    let surface = tree.on(&mesh).unwrap();
    let far = Vec3::new(1e30, -2e28, 0.0);
    let solids = [
        Sphere::new(far, 1.0),
        Sphere::new(Vec3::zero(), 1e25),
        Sphere::new(far * 1e-14, 2.0),
        Sphere::new(far * 1e-17, 1e12),
    ];
    judge(&surface, "far", &solids);
    assert_eq!(surface.nearest_face_to(Sphere::new(far * f64::NAN, 1.0)), 0);
    assert!(
        surface
            .distance_to(Sphere::new(far * f64::NAN, 1.0))
            .is_nan()
    );
    assert!(!surface.is_touching(Sphere::new(far * f64::NAN, 1.0)));
}

fn poses(random: &mut Random, count: usize) -> Vec<Pose3<f64>> {
    (0..count)
        .map(|k| match k % 6 {
            0 => Pose3::identity(),
            1 => Pose3::new(Vec3::new(1.0, 0.0, 0.0), Rotation3::identity()),
            2 => Pose3::new(random.vector(0.4), turn(random)),
            3 => Pose3::new(random.vector(3.0), turn(random)),
            4 => Pose3::new(random.vector(1e4), turn(random)),
            _ => Pose3::new(Vec3::new(0.0, 2.5, 1e-9), Rotation3::from_yaw(0.5)),
        })
        .collect()
}

#[test]
fn searches_find_the_nearest_pair_of_all() {
    if !geograd_tests::is_due("searches_find_the_nearest_pair_of_all") {
        return;
    }
    let mut random = Random(0x50f1_d5ea_0000_0002);
    let cpu = Cpu::new();
    let mut met = 0;
    let mut others = all();
    others.truncate(8);
    others.push(bumpy_sphere(1));
    for (i, first) in others.iter().enumerate() {
        for second in &others[i..] {
            let meshes = [first.mesh(), second.mesh()];
            // Another unit than the first one's.
            let small: Vec<_> = second.vertices.iter().map(|&v| v * 0.3).collect();
            let meshes = [meshes[0], Mesh::new(&small, &second.faces).unwrap()];
            let trees = [MeshTree::new(&meshes[0]), MeshTree::new(&meshes[1])];
            let surfaces = [
                &trees[0].on(&meshes[0]).unwrap(),
                &trees[1].on(&meshes[1]).unwrap(),
            ];
            let poses = poses(&mut random, 6);
            let found = cpu.nearest_pairs(surfaces[0], surfaces[1], &poses).unwrap();
            let distances = cpu.pair_distances(surfaces, &poses, &found).unwrap();
            let meeting = cpu.meeting(surfaces[0], surfaces[1], &poses).unwrap();
            for (k, &pose) in poses.iter().enumerate() {
                let mut best = (
                    f64::INFINITY,
                    FacePair {
                        first: 0,
                        second: 0,
                    },
                );
                let mut within = Vec::new();
                for a in 0..first.faces.len() as u32 {
                    for b in 0..second.faces.len() as u32 {
                        let own = pair_distance(meshes[0].triangle(a), meshes[1].triangle(b), pose);
                        let pair = FacePair {
                            first: a,
                            second: b,
                        };
                        if own < best.0 {
                            best = (own, pair);
                        }
                        if own <= 0.2 {
                            within.push(pair);
                        }
                    }
                }
                let name = format!("{}, {}: {pose:?}", first.name, second.name);
                assert_eq!(found[k], best.1, "{name}");
                assert_eq!(distances[k].to_bits(), best.0.to_bits(), "{name}");
                assert_eq!(meeting[k], best.0 == 0.0, "{name}");
                let near = surfaces[0].pairs_within(surfaces[1], pose, 0.2);
                assert_eq!(near, within, "{name}");
                let single = surfaces[0].distance_between(surfaces[1], pose);
                assert_eq!(single.to_bits(), best.0.to_bits(), "{name}");
                met += usize::from(best.0 == 0.0);
            }
        }
    }
    assert!(met > 50, "{met}");
}

/// Two closed meshes of which one is inside of the other have the distance of their faces.
#[test]
fn meshes_inside_of_others_have_a_distance() {
    let owned = cube();
    let mesh = owned.mesh();
    let small: Vec<_> = owned.vertices.iter().map(|&v| v * 0.25).collect();
    let inner = Mesh::new(&small, &owned.faces).unwrap();
    let trees = [MeshTree::new(&mesh), MeshTree::new(&inner)];
    let (outer, inner) = (trees[0].on(&mesh).unwrap(), trees[1].on(&inner).unwrap());
    let at = Vec3::new(0.25, 0.375, 0.375);
    let pose = Pose3::new(at, Rotation3::identity());
    assert_eq!(outer.distance_between(&inner, pose), 0.25);
    assert_eq!(outer.distance_to(Sphere::new(at, 0.125)), 0.125);
    assert!(!outer.is_meeting(&inner, pose));
}

/// The derivative of a sum of results along a move of everything, against differences of whole queries.
fn compare(name: &str, slope: f64, sides: [f64; 2]) {
    let [low, high] = [sides[0].min(sides[1]), sides[0].max(sides[1])];
    let room = 3e-5 * (1.0 + slope.abs());
    assert!(
        low - room <= slope && slope <= high + room,
        "{name}: {slope} {sides:?}"
    );
}

/// Moves every number of a shape by another one's.
pub fn moved<P: Pack<Scalar = f64, With<f64> = P>>(shape: &P, way: &[f64], step: f64) -> P {
    let mut way = way.iter();
    shape.remake(&mut |&x| x + way.next().unwrap() * step)
}

/// Returns the vertices of a mesh, moved along ways.
pub fn stepped(owned: &Owned, ways: &[Vec3<f64>], step: f64) -> Vec<Vec3<f64>> {
    let all = owned.vertices.iter().zip(ways);
    all.map(|(&v, &way)| v + way * step).collect()
}

/// Calls a function with two meshes whose vertices are moved along ways.
pub fn with_stepped<R>(
    both: [&Owned; 2],
    ways: &[Vec<Vec3<f64>>; 2],
    step: f64,
    run: impl FnOnce([&MeshSurface<'_, f64>; 2]) -> R,
) -> R {
    let vertices = [0, 1].map(|k| stepped(both[k], &ways[k], step));
    let meshes = [0, 1].map(|k| Mesh::new(&vertices[k], &both[k].faces).unwrap());
    let trees = meshes.map(|mesh| MeshTree::new(&mesh));
    run([
        &trees[0].on(&meshes[0]).unwrap(),
        &trees[1].on(&meshes[1]).unwrap(),
    ])
}

/// Pairs of meshes that poses place beside each other.
pub fn pairs_of_meshes() -> [(Owned, Owned); 3] {
    [
        (cube(), bumpy_sphere(1)),
        (bumpy_sphere(2), one_face()),
        (bumpy_sphere(1), bumpy_sphere(2)),
    ]
}

#[test]
fn distances_of_solids_have_the_slopes_of_differences() {
    if !geograd_tests::is_due("distances_of_solids_have_the_slopes_of_differences") {
        return;
    }
    fn judge<B>(owned: &Owned, name: &str, solids: &[B], random: &mut Random) -> usize
    where
        B: SolidItem<f64> + Pack<Scalar = f64, With<f64> = B>,
    {
        let (mesh, cpu) = (owned.mesh(), Cpu::new());
        let tree = MeshTree::new(&mesh);
        let surface = tree.on(&mesh).unwrap();
        let ways: Vec<_> = owned.vertices.iter().map(|_| random.vector(1.0)).collect();
        let mut judged = 0;
        for &solid in solids {
            let here = surface.distance_to(solid);
            // Curvature of the distance limits differences near contact.
            if here < 0.02 {
                continue;
            }
            let way: Vec<f64> = (0..64).map(|_| random.within(-1.0, 1.0)).collect();
            let faces = [surface.nearest_face_to(solid)];
            let bars = cpu.solid_distances_vjp(&surface, &[solid], &faces, &[1.0]);
            let bars = bars.unwrap();
            let mut slope = 0.0;
            for (bar, way) in bars.vertices.iter().zip(&ways) {
                slope += bar.dot(*way);
            }
            let mut numbers = way.iter();
            let mut by_solid = 0.0;
            bars.queries[0]
                .clone()
                .each(&mut |bar| by_solid += *bar * numbers.next().unwrap());
            let side = |step: f64| {
                let vertices = stepped(owned, &ways, step);
                let mesh = Mesh::new(&vertices, &owned.faces).unwrap();
                let tree = MeshTree::new(&mesh);
                let there = tree
                    .on(&mesh)
                    .unwrap()
                    .distance_to(moved(&solid, &way, step));
                (there - here) / step
            };
            let sides = [side(1e-6), side(-1e-6)];
            compare(&format!("{}, {name}", owned.name), slope + by_solid, sides);
            judged += 1;
        }
        judged
    }
    let mut random = Random(0x50f1_d5ea_0000_0003);
    let mut judged = 0;
    for owned in [cube(), one_face(), bumpy_sphere(2)] {
        let centers: Vec<_> = (0..30).map(|_| random.vector(2.5)).collect();
        let of = |k: usize| centers[k];
        let random = &mut random;
        let balls: Vec<_> = (0..30).map(|k| Sphere::new(of(k), 0.2)).collect();
        judged += judge(&owned, "balls", &balls, random);
        let capsules: Vec<_> = (0..30)
            .map(|k| Capsule3::new(of(k), of(k) + random.vector(1.0), 0.1))
            .collect();
        judged += judge(&owned, "capsules", &capsules, random);
        let boxes: Vec<_> = (0..30)
            .map(|k| Obb3::new(of(k), Vec3::new(0.4, 0.2, 0.7), turn(random)))
            .collect();
        judged += judge(&owned, "boxes", &boxes, random);
        let rounded: Vec<_> = boxes.iter().map(|&b| RoundBox3::new(b, 0.05)).collect();
        judged += judge(&owned, "round boxes", &rounded, random);
        let hulls: Vec<Hull3<f64, 8>> = (0..30)
            .map(|k| {
                let corners: Vec<_> = (0..8).map(|_| of(k) + random.vector(0.4)).collect();
                Hull3::from_vertices(&corners)
            })
            .collect();
        judged += judge(&owned, "hulls", &hulls, random);
    }
    assert!(judged > 250, "{judged}");
}

#[test]
fn distances_of_meshes_have_the_slopes_of_differences() {
    let (mut random, cpu) = (Random(0x50f1_d5ea_0000_0004), Cpu::new());
    let mut judged = 0;
    for (first, second) in pairs_of_meshes() {
        let both = [&first, &second];
        let ways =
            both.map(|own| -> Vec<_> { own.vertices.iter().map(|_| random.vector(1.0)).collect() });
        let run = |pose: Pose3<f64>, step: f64| {
            with_stepped(both, &ways, step, |surfaces| {
                let pairs = cpu
                    .nearest_pairs(surfaces[0], surfaces[1], &[pose])
                    .unwrap();
                let values = cpu.pair_distances(surfaces, &[pose], &pairs).unwrap();
                let bars = cpu.pair_distances_vjp(surfaces, &[pose], &pairs, &[1.0]);
                let spots = cpu.pair_closest_points(surfaces, &[pose], &pairs).unwrap();
                let apart = (spots[0].on_a - spots[0].on_b).length();
                // Points of crossing faces are apart.
                let is_right = (apart - values[0]).abs() <= 1e-12 * (1.0 + apart);
                assert!(is_right || values[0] == 0.0);
                (values[0], bars.unwrap())
            })
        };
        for _ in 0..20 {
            let pose = Pose3::new(random.vector(4.0), turn(&mut random));
            let way: Vec<f64> = (0..7).map(|_| random.within(-1.0, 1.0)).collect();
            let (here, bars) = run(pose, 0.0);
            if here < 0.02 {
                continue;
            }
            let PairBars { poses, vertices } = bars;
            let mut slope = 0.0;
            for k in 0..2 {
                for (bar, way) in vertices[k].iter().zip(&ways[k]) {
                    slope += bar.dot(*way);
                }
            }
            let mut numbers = way.iter();
            poses[0]
                .clone()
                .each(&mut |bar| slope += *bar * numbers.next().unwrap());
            let side = |step: f64| (run(moved(&pose, &way, step), step).0 - here) / step;
            compare(first.name, slope, [side(1e-6), side(-1e-6)]);
            judged += 1;
        }
    }
    assert!(judged > 30, "{judged}");
}

#[test]
fn threads_change_no_bit_of_solids_and_pairs() {
    if !geograd_tests::is_due("threads_change_no_bit_of_solids_and_pairs") {
        return;
    }
    let mut random = Random(0x50f1_d5ea_0000_0005);
    let owned = bumpy_sphere(3);
    let mesh = owned.mesh();
    let tree = MeshTree::new(&mesh);
    let surface = &tree.on(&mesh).unwrap();
    let capsules: Vec<_> = (0..400)
        .map(|_| {
            let at = random.vector(2.0);
            Capsule3::new(at, at + random.vector(0.5), 0.1)
        })
        .collect();
    let poses = poses(&mut random, 60);
    let up: Vec<f64> = (0..400).map(|_| random.within(-1.0, 1.0)).collect();
    let run = |threads: usize| {
        with_threads(threads, || {
            let cpu = Cpu::new();
            let faces = cpu.nearest_faces_to(surface, &capsules).unwrap();
            let by_solids = cpu.solid_distances_vjp(surface, &capsules, &faces, &up);
            let pairs = cpu.nearest_pairs(surface, surface, &poses).unwrap();
            let by_poses = cpu.pair_distances_vjp([surface; 2], &poses, &pairs, &up[..60]);
            format!(
                "{faces:?} {:?} {pairs:?} {:?}",
                by_solids.unwrap(),
                by_poses.unwrap()
            )
        })
    };
    let one = run(1);
    assert!(one == run(2) && one == run(5));
}

/// A solid of a user, by its bounds and its distance.
#[derive(Clone, Copy)]
struct Spot(Vec3<f64>);

impl MeshSolid<f64> for Spot {
    fn bounds(&self) -> SolidBounds {
        SolidBounds::upright(Aabb3::new(self.0, self.0))
    }
    fn measure(&self) -> impl Fn(Triangle3<f64>) -> f64 + '_ {
        |face| geograd::distance3::distance(face, self.0)
    }
    fn distance_from(&self, face: Triangle3<f64>) -> f64 {
        geograd::distance3::distance(face, self.0)
    }
    fn closest_from(&self, face: Triangle3<f64>) -> geograd::distance3::PointPair3<f64> {
        geograd::distance3::closest_points(face, self.0)
    }
}

#[test]
fn own_solids_have_the_distances_of_points() {
    let mut random = Random(0x50f1_d5ea_0000_0006);
    for owned in all() {
        let mesh = owned.mesh();
        let tree = MeshTree::new(&mesh);
        let surface = tree.on(&mesh).unwrap();
        for k in 0..40 {
            let (at, _) = place(&owned, &mut random, k);
            let (own, expected) = (surface.distance_to(Spot(at)), surface.distance(at));
            let size = 1.0 + at.length();
            assert!(
                (own - expected).abs() <= 1e-14 * size,
                "{}: {at}",
                owned.name
            );
        }
    }
}

#[test]
fn faults_of_solids_name_them() {
    let owned = cube();
    let mesh = owned.mesh();
    let tree = MeshTree::new(&mesh);
    let surface = &tree.on(&mesh).unwrap();
    let cpu = Cpu::new();
    let ball = Sphere::new(Vec3::new(0.0, 0.0, 3.0), 1.0);
    let bad = Sphere::new(Vec3::new(0.0, f64::NAN, 3.0), 1.0);
    let told = |text: String, parts: &[&str]| {
        for part in parts {
            assert!(text.contains(part), "{text}");
        }
    };
    let fault = cpu.nearest_faces_to(surface, &[ball, bad]).unwrap_err();
    told(fault.to_string(), &["solids", "1", "y"]);
    let fault = cpu.solid_distances(surface, &[ball, ball], &[0, 12]);
    told(
        fault.unwrap_err().to_string(),
        &["faces", "1", "is not a face"],
    );
    let fault = cpu.faces_within(surface, &[ball], -1.0).unwrap_err();
    told(fault.to_string(), &["most", "negative"]);
    let pose = Pose3::<f64>::identity();
    let pair = FacePair {
        first: 3,
        second: 12,
    };
    let fault = cpu.pair_distances([surface; 2], &[pose], &[pair]);
    told(
        fault.unwrap_err().to_string(),
        &["pairs", "0", "is not a face"],
    );
    let fault = cpu.solid_distances_vjp(surface, &[ball], &[0], &[f64::NAN]);
    told(fault.unwrap_err().to_string(), &["upstream"]);
    assert!(surface.faces_within(ball, -1.0).is_empty());
}
