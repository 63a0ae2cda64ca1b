//! Closest points of a million places on five meshes against every face one by one, by a formula of its own.
use super::Dice;
use super::meshes::{Faces, knot, ring, tube};
use geograd::Vec3;
use geograd::kernels::Cpu;
use geograd::kernels::cpu::mesh_batches::MeshDistance;
use geograd::mesh::{Mesh, MeshTree};

/// The number of queries of each mesh.
const QUERIES: usize = 200_000;

/// The squared distance of a point from a triangle: from its plane over it, else from its edges. Whole numbers stay whole
/// for triangles with a right angle and legs of one.
fn square(p: Vec3<f64>, [a, b, c]: [Vec3<f64>; 3]) -> f64 {
    let (u, v, w) = (b - a, c - a, p - a);
    let (uu, uv, vv, wu, wv) = (u.dot(u), u.dot(v), v.dot(v), w.dot(u), w.dot(v));
    let over = uu * vv - uv * uv;
    let (s, r) = ((vv * wu - uv * wv) / over, (uu * wv - uv * wu) / over);
    if s >= 0.0 && r >= 0.0 && s + r <= 1.0 {
        return (a + u * s + v * r - p).length_squared();
    }
    let from = |a: Vec3<f64>, b: Vec3<f64>| {
        let way = b - a;
        let t = (way.dot(p - a) / way.length_squared()).clamp(0.0, 1.0);
        (a + way * t - p).length_squared()
    };
    from(a, b).min(from(b, c)).min(from(c, a))
}

/// The surface of a cube of whole numbers, two faces a unit square.
fn cube(side: u32) -> Faces {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for face in 0..6 {
        let (axis, high) = (face % 3, face / 3);
        let first = vertices.len() as u32;
        for i in 0..=side {
            for j in 0..=side {
                let mut at = [0.0; 3];
                at[axis] = f64::from(side * high as u32);
                at[(axis + 1) % 3] = f64::from(i);
                at[(axis + 2) % 3] = f64::from(j);
                vertices.push(Vec3::new(at[0], at[1], at[2]));
            }
        }
        let corner = |i: u32, j: u32| first + i * (side + 1) + j;
        for i in 0..side {
            for j in 0..side {
                let (a, b) = (corner(i, j), corner(i + 1, j));
                let (c, d) = (corner(i + 1, j + 1), corner(i, j + 1));
                faces.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    (vertices, faces)
}

/// A field of heights, with cliffs.
fn terrain(dice: &mut Dice, side: u32) -> Faces {
    let mut vertices = Vec::new();
    for k in 0..side * side {
        let (x, y) = (f64::from(k % side), f64::from(k / side));
        let cliff = if k % 7 == 0 { 3.0 } else { 0.4 };
        vertices.push(Vec3::new(x, y, dice.within(-cliff, cliff)) * 0.05);
    }
    let quads = (0..side - 1).flat_map(|i| (0..side - 1).map(move |j| (i, j)));
    let faces = quads.flat_map(|(i, j)| {
        let at = |i: u32, j: u32| j * side + i;
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    (vertices, faces.collect())
}

fn judge(name: &str, (vertices, faces): &Faces, points: &[Vec3<f64>], is_exact: bool) -> usize {
    let mesh = Mesh::new(vertices, faces).expect("is valid");
    let tree = MeshTree::new(&mesh);
    let surface = tree.on(&mesh).expect("is its tree");
    let cpu = Cpu::new();
    let records = cpu.nearest_faces(&surface, points).expect("valid points");
    let plain = MeshDistance::Plain;
    let apart = cpu.mesh_distances(plain, &surface, points, &records);
    let apart = apart.expect("own records");
    let triangles: Vec<_> = faces
        .iter()
        .map(|f| f.map(|i| vertices[i as usize]))
        .collect();
    let (mut wrong, mut ties) = (0, 0);
    for (k, &p) in points.iter().enumerate() {
        let squares = triangles.iter().map(|&own| square(p, own));
        let (mut least, mut lowest, mut count) = (f64::INFINITY, 0, 0);
        for (face, square) in squares.enumerate() {
            count += usize::from(square == least);
            if square < least {
                (least, lowest, count) = (square, face, 1);
            }
        }
        ties += usize::from(count > 1);
        let is_right = match is_exact {
            true => apart[k] == least.sqrt() && records[k].face as usize == lowest,
            false => (apart[k] - least.sqrt()).abs() <= 1e-14 * (1.0 + p.length()),
        };
        if !is_right && wrong < 3 {
            eprintln!(
                "{name}: {p} {} for {}, face {lowest}",
                apart[k],
                least.sqrt()
            );
        }
        wrong += usize::from(!is_right);
    }
    println!(
        "| {name} | {} | {} | {ties} | {wrong} |",
        faces.len(),
        points.len()
    );
    wrong
}

/// Prints how many are wrong, which none may be.
pub fn run() {
    let mut dice = Dice(31);
    println!(
        "| mesh | faces | queries | exact ties | wrong |\n| --- | ---: | ---: | ---: | ---: |"
    );
    let whole = cube(8);
    let halves = (0..QUERIES).map(|_| {
        let mut one = || (dice.within(-4.0, 20.0)).round() * 0.5;
        Vec3::new(one(), one(), one())
    });
    let mut wrong = judge(
        "cube of whole numbers",
        &whole,
        &halves.collect::<Vec<_>>(),
        true,
    );
    let meshes = [
        ("ring", tube(ring, 0.1, [50, 20])),
        ("knot", tube(knot, 0.05, [100, 10])),
        ("thin ring", tube(ring, 1e-4, [100, 6])),
        ("terrain with cliffs", terrain(&mut dice, 30)),
    ];
    for (name, mesh) in &meshes {
        let points: Vec<_> = (0..QUERIES)
            .map(|k| {
                let size = [1e-6, 1e-2, 0.1, 2.0][k % 4];
                let from = mesh.0[k * 7919 % mesh.0.len()];
                from + Vec3::new(
                    dice.within(-size, size),
                    dice.within(-size, size),
                    dice.within(-size, size),
                )
            })
            .collect();
        wrong += judge(name, mesh, &points, false);
    }
    assert_eq!(wrong, 0, "closest points are wrong");
}
