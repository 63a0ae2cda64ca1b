//! Meshes that are hard in one way each, and queries on and around them.
use crate::space::draw::Random;
use geograd::Vec3;
use geograd::mesh::Mesh;
use std::collections::HashMap;

/// A mesh that owns its columns.
pub struct Owned {
    pub name: &'static str,
    pub vertices: Vec<Vec3<f64>>,
    pub faces: Vec<[u32; 3]>,
    pub is_closed: bool,
}

impl Owned {
    fn new(name: &'static str, vertices: &[[f64; 3]], faces: &[[u32; 3]], is_closed: bool) -> Self {
        Owned {
            name,
            vertices: vertices
                .iter()
                .map(|&[x, y, z]| Vec3::new(x, y, z))
                .collect(),
            faces: faces.to_vec(),
            is_closed,
        }
    }
    pub fn mesh(&self) -> Mesh<'_, f64> {
        Mesh::new(&self.vertices, &self.faces).unwrap()
    }
}

const CUBE: [[u32; 3]; 12] = [
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
];

fn corners(shift: [f64; 3]) -> Vec<[f64; 3]> {
    let corner = |k: u32| [0, 1, 2].map(|axis| f64::from(k >> axis & 1) + shift[axis]);
    (0..8).map(corner).collect()
}

pub fn tetrahedron() -> Owned {
    let vertices = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
    ];
    let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    Owned::new("tetrahedron", &vertices, &faces, true)
}

pub fn cube() -> Owned {
    Owned::new("cube", &corners([0.0; 3]), &CUBE, true)
}

/// Two cubes with a common wall, whose vertices each has for itself.
fn touching_cubes() -> Owned {
    let vertices = [corners([0.0; 3]), corners([1.0, 0.0, 0.0])].concat();
    let second = CUBE.map(|face| face.map(|i| i + 8));
    Owned::new("touching cubes", &vertices, &[CUBE, second].concat(), true)
}

/// A cube each of whose faces has vertices of its own.
fn soup() -> Owned {
    let all = corners([0.0; 3]);
    let vertices: Vec<[f64; 3]> = CUBE.iter().flatten().map(|&i| all[i as usize]).collect();
    let faces: Vec<[u32; 3]> = (0..12).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    Owned::new("repeated vertices", &vertices, &faces, false)
}

/// A strip that winds around an axis, open at its sides.
fn strip() -> Owned {
    let vertices: Vec<[f64; 3]> = (0..40)
        .map(|k| {
            let (sin, cos) = (0.3 * f64::from(k / 2)).sin_cos();
            [cos, sin, 0.2 * f64::from(k % 2) + 0.01 * f64::from(k)]
        })
        .collect();
    let face = |k: u32| {
        if k.is_multiple_of(2) {
            [k, k + 1, k + 2]
        } else {
            [k + 1, k, k + 2]
        }
    };
    let faces: Vec<[u32; 3]> = (0..38).map(face).collect();
    Owned::new("open strip", &vertices, &faces, false)
}

/// A fan of triangles ten million times longer than wide.
fn slivers() -> Owned {
    let mut vertices = vec![[0.0, 0.0, 0.0]];
    vertices.extend((0..30).map(|k| [1.0, 1e-7 * f64::from(k), 1e-8 * f64::from(k * k)]));
    let faces: Vec<[u32; 3]> = (1..30).map(|k| [0, k, k + 1]).collect();
    Owned::new("slivers", &vertices, &faces, false)
}

/// Faces that are segments and points among others.
fn without_area() -> Owned {
    let vertices = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.5, 0.0, 0.0],
        [3.0, 0.0, 0.0],
        [0.0, 0.0, 2.0],
    ];
    let faces = [
        [0, 1, 2],
        [0, 3, 1],
        [4, 4, 4],
        [1, 4, 4],
        [5, 5, 0],
        [0, 1, 2],
        [3, 1, 4],
    ];
    Owned::new("without area", &vertices, &faces, false)
}

pub fn one_face() -> Owned {
    let vertices = [[0.2, 0.1, 0.4], [1.3, 0.3, 0.1], [0.5, 1.7, 0.9]];
    Owned::new("one face", &vertices, &[[0, 1, 2]], false)
}

/// A sphere with bumps: an icosahedron whose faces are cut in four, so many times.
pub fn bumpy_sphere(cuts: usize) -> Owned {
    let g = 0.5 * (1.0 + 5.0_f64.sqrt());
    let mut vertices: Vec<Vec3<f64>> = Vec::new();
    for (a, b) in [(1.0, g), (-1.0, g), (1.0, -g), (-1.0, -g)] {
        vertices.push(Vec3::new(0.0, a, b));
        vertices.push(Vec3::new(a, b, 0.0));
        vertices.push(Vec3::new(b, 0.0, a));
    }
    let near = |i: usize, j: usize| (vertices[i] - vertices[j]).length() < 2.1;
    let mut faces: Vec<[u32; 3]> = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                if near(i, j) && near(j, k) && near(i, k) {
                    let [a, b, c] = [i, j, k].map(|i| vertices[i]);
                    let outward = (b - a).cross(c - a).dot(a) > 0.0;
                    let [i, j, k] = [i, j, k].map(|i| i as u32);
                    faces.push(if outward { [i, j, k] } else { [i, k, j] });
                }
            }
        }
    }
    for _ in 0..cuts {
        let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
        let mut next = Vec::with_capacity(4 * faces.len());
        for &[i, j, k] in &faces {
            let [p, q, r] = [[i, j], [j, k], [k, i]].map(|[a, b]| {
                *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    vertices.push((vertices[a as usize] + vertices[b as usize]) * 0.5);
                    vertices.len() as u32 - 1
                })
            });
            next.extend([[i, p, r], [p, j, q], [r, q, k], [p, q, r]]);
        }
        faces = next;
    }
    for vertex in &mut vertices {
        let v = vertex.normalize_or_zero();
        let bump = (7.0 * v.x).sin() * (5.0 * v.y).cos() + (9.0 * v.z).sin();
        *vertex = v * (1.0 + 0.1 * bump);
    }
    Owned {
        name: "bumpy sphere",
        vertices,
        faces,
        is_closed: true,
    }
}

pub fn all() -> Vec<Owned> {
    vec![
        tetrahedron(),
        cube(),
        touching_cubes(),
        soup(),
        strip(),
        slivers(),
        without_area(),
        one_face(),
        bumpy_sphere(5),
    ]
}

/// Queries on vertices, edges and faces, above them, in the middle, near and far.
pub fn queries(mesh: &Owned, random: &mut Random, count: usize) -> Vec<Vec3<f64>> {
    let mut all = vec![Vec3::zero(), Vec3::new(0.5, 0.5, 0.5)];
    let own = mesh.mesh();
    for k in 0..count {
        let t = own.triangle(random.below(mesh.faces.len()) as u32);
        let on = match k % 4 {
            0 => t.a,
            1 => t.a.lerp(t.b, 0.5),
            2 => t.a + (t.b - t.a) * 0.25 + (t.c - t.a) * 0.5,
            _ => random.vector(2.0),
        };
        let away = t.normal() * [0.0, 0.125, -0.125, 1.0, -3.0][random.below(5)];
        all.push(on + away);
        let size = [1e-3, 0.3, 30.0][random.below(3)];
        all.push(on + random.vector(size));
    }
    all
}
