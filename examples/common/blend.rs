//! Bodies of solids that flow into each other, with holes cut out, and their closed meshes.
use geograd::{
    Capsule3, Cylinder, Obb3, Pack as _, Rotation3, RoundBox3, Scalar, Sphere, Vec3, jvp,
};
use std::collections::HashMap;

/// How often vertices move towards the middle of their neighbours and back to the surface.
const ROUNDS: usize = 4;

/// The radius of the edges of drums and blocks, in metres.
const ROUND: f64 = 0.0025;

/// A part of a body; lengths are in metres.
#[derive(Clone, Copy, Debug)]
pub enum Part {
    Ball(Sphere<f64>),
    Rod(Capsule3<f64>),
    /// A box that is not turned.
    Block(RoundBox3<f64>),
    /// A cylinder, grown by the radius of its edges.
    Drum(Cylinder<f64>),
    /// A torus about an axis along y: centre, radius of the circle, and of the tube around it.
    Ring(Vec3<f64>, f64, f64),
}

impl Part {
    /// The signed distance of a point, negative inside. In few operations, since builds for tests do not optimise it.
    fn height<S: Scalar>(&self, point: Vec3<S>) -> S {
        match self {
            Part::Ball(part) => (point - part.center.lift()).length() - S::lit(part.radius),
            Part::Rod(part) => {
                let (arm, way) = (point - part.start.lift(), part.end - part.start);
                let along = arm.dot((way * (1.0 / way.length_squared())).lift());
                let along = along.most(S::zero()).least(S::one());
                (arm - way.lift() * along).length() - S::lit(part.radius)
            }
            Part::Block(part) => {
                let (arm, size) = (point - part.inner.center.lift(), part.inner.size);
                let [x, y, z] = [(arm.x, size.x), (arm.y, size.y), (arm.z, size.z)]
                    .map(|(x, size)| x.magnitude() - S::lit(0.5 * size));
                let zero = S::zero();
                let out = Vec3::new(x.most(zero), y.most(zero), z.most(zero)).length();
                out + x.most(y).most(z).least(zero) - S::lit(part.radius)
            }
            Part::Drum(part) => {
                let (arm, way) = (point - part.start.lift(), part.end - part.start);
                let (length, unit) = (way.length(), way.normalize_or_zero());
                let along = arm.dot(unit.lift());
                let side = (arm - unit.lift() * along).length() - S::lit(part.radius);
                let end = (along - S::lit(0.5 * length)).magnitude() - S::lit(0.5 * length);
                let (zero, inside) = (S::zero(), side.most(end).least(S::zero()));
                side.most(zero).hypot(end.most(zero)) + inside - S::lit(ROUND)
            }
            Part::Ring(center, radius, tube) => {
                let arm = point - center.lift();
                let out = (arm.x * arm.x + arm.z * arm.z).sqrt() - S::lit(*radius);
                (out * out + arm.y * arm.y).sqrt() - S::lit(*tube)
            }
        }
    }
}

/// A body: parts that flow into each other over a width, less others.
#[derive(Clone, Debug)]
pub struct Blend {
    pub name: &'static str,
    pub parts: Vec<Part>,
    pub cuts: Vec<Part>,
    /// In metres.
    pub width: f64,
    /// Half the edges of a box around the origin that holds the body.
    pub half: Vec3<f64>,
}

/// The lesser number, rounded where both differ by less than a width (Quilez, "Smooth minimum", 2013).
fn rounded_least<S: Scalar>(a: S, b: S, width: f64) -> S {
    let lack = (S::lit(width) - (a - b).magnitude()).most(S::zero());
    a.least(b) - lack * lack * S::lit(0.25 / width)
}

impl Blend {
    /// A function that is negative inside and near the signed distance.
    pub fn height<S: Scalar>(&self, point: Vec3<S>) -> S {
        let mut all = self.parts.iter().map(|part| part.height(point));
        let first = all.next().unwrap_or(S::lit(f64::MAX));
        let joined = all.fold(first, |a, b| rounded_least(a, b, self.width));
        let cuts = self.cuts.iter().map(|cut| cut.height(point));
        cuts.fold(joined, |a, cut| -rounded_least(-a, cut, 0.5 * self.width))
    }
}

/// Vertices and faces of a mesh.
#[derive(Clone, Debug, Default)]
pub struct Faces {
    pub vertices: Vec<Vec3<f64>>,
    pub faces: Vec<[u32; 3]>,
}

/// The six tetrahedra of a cube along its diagonal from corner 0 to corner 7, all turned alike. Bit k of a corner is its
/// place along axis k. Cubes side by side cut their common square alike.
const TETRAHEDRA: [[usize; 4]; 6] = [
    [0, 1, 3, 7],
    [0, 2, 6, 7],
    [0, 4, 5, 7],
    [0, 3, 2, 7],
    [0, 6, 4, 7],
    [0, 5, 1, 7],
];

/// The corners of a tetrahedron as those inside and those outside, turned as before.
fn sorted(corners: [usize; 4], is_inside: [bool; 4]) -> ([usize; 4], usize) {
    let order = |wanted: bool| (0..4).filter(move |&k| is_inside[k] == wanted);
    let mut all = [0; 4];
    let count = order(true).count();
    for (slot, k) in all.iter_mut().zip(order(true).chain(order(false))) {
        *slot = k;
    }
    let swaps = (0..4).flat_map(|i| (i + 1..4).map(move |j| (i, j)));
    if swaps.filter(|&(i, j)| all[i] > all[j]).count() % 2 == 1 {
        // Two of the same side.
        match count {
            1 | 2 => all.swap(2, 3),
            _ => all.swap(0, 1),
        }
    }
    (all.map(|k| corners[k]), count)
}

impl Faces {
    /// The closed mesh of a body by cells of an edge: marching tetrahedra (Doi and Koide 1991), whose vertices are then
    /// spread evenly and moved back to the surface by Newton's method.
    pub fn of(body: &Blend, cell: f64) -> Self {
        let counts = [body.half.x, body.half.y, body.half.z]
            .map(|half| (2.0 * half / cell).ceil() as usize + 2);
        let at = |[i, j, k]: [usize; 3]| (k * counts[1] + j) * counts[0] + i;
        let place = |[i, j, k]: [usize; 3]| {
            let along = |k: usize, i: usize| (i as f64 - 0.5 * (counts[k] - 1) as f64) * cell;
            Vec3::new(along(0, i), along(1, j), along(2, k))
        };
        let cells = |less: usize| {
            let [x, y, z] = counts.map(|count| count - less);
            (0..z).flat_map(move |k| (0..y).flat_map(move |j| (0..x).map(move |i| [i, j, k])))
        };
        let heights: Vec<f64> = cells(0).map(|cell| body.height(place(cell))).collect();
        let mut mesh = Faces::default();
        let mut known: HashMap<(usize, usize), u32> = HashMap::new();
        for cell in cells(1) {
            let corners: [_; 8] =
                std::array::from_fn(|c| [0, 1, 2].map(|axis| cell[axis] + (c >> axis & 1)));
            for tetrahedron in TETRAHEDRA {
                let is_inside = tetrahedron.map(|c| heights[at(corners[c])] < 0.0);
                let ([a, b, c, d], count) = sorted(tetrahedron, is_inside);
                let mut cut = |from: usize, to: usize| {
                    let ends = [corners[from], corners[to]];
                    let key = ends.map(at);
                    let [low, high] = key.map(|corner| heights[corner]);
                    *known
                        .entry((key[0].min(key[1]), key[0].max(key[1])))
                        .or_insert_with(|| {
                            let part = (low / (low - high)).clamp(0.05, 0.95);
                            mesh.vertices
                                .push(place(ends[0]).lerp(place(ends[1]), part));
                            mesh.vertices.len() as u32 - 1
                        })
                };
                match count {
                    1 => {
                        let face = [cut(a, b), cut(a, c), cut(a, d)];
                        mesh.faces.push(face);
                    }
                    2 => {
                        let ring = [cut(a, c), cut(a, d), cut(b, d), cut(b, c)];
                        mesh.faces.push([ring[0], ring[1], ring[2]]);
                        mesh.faces.push([ring[0], ring[2], ring[3]]);
                    }
                    3 => {
                        // The last corner is the one outside, seen from which the others turn the other way.
                        let face = [cut(a, d), cut(b, d), cut(c, d)];
                        mesh.faces.push(face);
                    }
                    _ => {}
                }
            }
        }
        for _ in 0..ROUNDS {
            mesh.spread(body);
        }
        mesh
    }

    /// Moves every vertex to the mean of its neighbours, and from there along the mean normal to the surface.
    fn spread(&mut self, body: &Blend) {
        let mut sums = vec![(Vec3::zero(), Vec3::zero(), 0.0); self.vertices.len()];
        for &face in &self.faces {
            let corners = face.map(|vertex| self.vertices[vertex as usize]);
            let [a, b, c] = corners;
            let normal = (b - a).cross(c - a);
            for k in 0..3 {
                let (sum, normals, count) = &mut sums[face[k] as usize];
                *sum += corners[(k + 1) % 3];
                *normals += normal;
                *count += 1.0;
            }
        }
        for (vertex, (sum, normals, count)) in self.vertices.iter_mut().zip(sums) {
            let (mut point, normal) = (sum * (1.0 / count), normals.normalize_or_zero());
            for _ in 0..3 {
                let (height, slope) = jvp(|point: Vec3<_>| body.height(point), point, normal);
                // The slope may vanish at a seam of parts and cuts.
                if slope > 0.3 {
                    point -= normal * (height / slope);
                }
            }
            *vertex = point;
        }
    }
}

fn v(x: f64, y: f64, z: f64) -> Vec3<f64> {
    Vec3::new(x, y, z)
}
fn ball(center: Vec3<f64>, radius: f64) -> Part {
    Part::Ball(Sphere::new(center, radius))
}
fn rod(start: Vec3<f64>, end: Vec3<f64>, radius: f64) -> Part {
    Part::Rod(Capsule3::new(start, end, radius))
}
fn drum(start: Vec3<f64>, end: Vec3<f64>, radius: f64) -> Part {
    let less = (end - start).normalize_or_zero() * ROUND;
    Part::Drum(Cylinder::new(start + less, end - less, radius - ROUND))
}
fn block(center: Vec3<f64>, size: Vec3<f64>) -> Part {
    let less = 2.0 * ROUND;
    let inner = size - Vec3::new(less, less, less);
    let inner = Obb3::new(center, inner, Rotation3::identity());
    Part::Block(RoundBox3::new(inner, ROUND))
}

/// A kettle with spout, handle and a lug at one side: no motion brings it onto itself.
pub fn kettle() -> Blend {
    Blend {
        name: "kettle",
        parts: vec![
            ball(v(0.0, 0.0, 0.0), 0.036),
            drum(v(0.0, 0.0, -0.039), v(0.0, 0.0, -0.025), 0.027),
            rod(v(0.024, 0.0, -0.006), v(0.05, 0.0, 0.01), 0.01),
            rod(v(0.05, 0.0, 0.01), v(0.07, 0.0, 0.036), 0.0075),
            ball(v(0.0, 0.0, 0.042), 0.01),
            ball(v(0.011, 0.036, 0.012), 0.008),
            Part::Ring(v(-0.042, 0.0, 0.002), 0.024, 0.0065),
        ],
        cuts: vec![],
        width: 0.008,
        half: v(0.085, 0.052, 0.06),
    }
}

/// An angle with a rib and three holes.
pub fn bracket() -> Blend {
    Blend {
        name: "bracket",
        parts: vec![
            block(v(0.0, 0.0, -0.03), v(0.1, 0.06, 0.014)),
            block(v(-0.043, 0.0, 0.004), v(0.014, 0.06, 0.08)),
            rod(v(-0.038, 0.012, 0.028), v(0.022, 0.012, -0.027), 0.006),
        ],
        cuts: vec![
            drum(v(0.03, -0.014, -0.05), v(0.03, -0.014, -0.01), 0.008),
            drum(v(0.0, -0.012, -0.05), v(0.0, -0.012, -0.01), 0.005),
            drum(v(-0.07, -0.01, 0.022), v(-0.02, -0.01, 0.022), 0.01),
        ],
        width: 0.006,
        half: v(0.056, 0.036, 0.05),
    }
}

/// A cup with a handle.
pub fn mug() -> Blend {
    Blend {
        name: "mug",
        parts: vec![
            drum(v(0.0, 0.0, -0.044), v(0.0, 0.0, 0.044), 0.036),
            Part::Ring(v(0.04, 0.0, 0.0), 0.024, 0.006),
        ],
        cuts: vec![drum(v(0.0, 0.0, -0.036), v(0.0, 0.0, 0.08), 0.029)],
        width: 0.004,
        half: v(0.075, 0.042, 0.05),
    }
}

/// A bone.
pub fn bone() -> Blend {
    Blend {
        name: "bone",
        parts: vec![
            rod(v(-0.045, 0.0, 0.0), v(0.045, 0.0, 0.004), 0.011),
            ball(v(-0.05, 0.013, 0.0), 0.016),
            ball(v(-0.052, -0.012, 0.002), 0.015),
            ball(v(0.05, 0.012, 0.003), 0.015),
            ball(v(0.049, -0.014, 0.001), 0.017),
        ],
        cuts: vec![],
        width: 0.012,
        half: v(0.076, 0.04, 0.026),
    }
}

/// A hammer.
pub fn hammer() -> Blend {
    Blend {
        name: "hammer",
        parts: vec![
            rod(v(-0.075, 0.0, 0.0), v(0.045, 0.0, 0.0), 0.0095),
            block(v(0.05, 0.0, 0.0), v(0.024, 0.08, 0.024)),
        ],
        cuts: vec![],
        width: 0.006,
        half: v(0.09, 0.048, 0.022),
    }
}

/// All bodies.
pub fn all() -> [Blend; 5] {
    [kettle(), bracket(), mug(), bone(), hammer()]
}
