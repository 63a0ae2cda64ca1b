//! Hits of rays in space, inertia.
use super::{Report, flag};
use geograd::intersection3::{first_hit, first_hit_triangle};
use geograd::{Aabb3, Capsule3, Cylinder, Ray3, Triangle3, Vec3};
use std::f64::consts::PI;

fn at([x, y, z]: [f64; 3]) -> Vec3<f64> {
    Vec3::new(x, y, z)
}

fn cube_faces() -> Vec<Triangle3<f64>> {
    let corner = |k: usize| at([(k >> 2 & 1) as f64, (k >> 1 & 1) as f64, (k & 1) as f64]);
    [
        [0, 6, 4],
        [0, 2, 6],
        [0, 3, 2],
        [0, 1, 3],
        [2, 7, 6],
        [2, 3, 7],
        [4, 6, 7],
        [4, 7, 5],
        [0, 4, 5],
        [0, 5, 1],
        [1, 5, 7],
        [1, 7, 3],
    ]
    .map(|[a, b, c]| Triangle3::new(corner(a), corner(b), corner(c)))
    .to_vec()
}

pub fn reports() -> Vec<Report> {
    vec![
        Report {
            library: "google-deepmind/mujoco",
            number: 1493,
            about: "distances that depend on the length of the direction",
            asked: "the way to a capsule along directions of length 1 and 2",
            source: "closed form 2 − 0.1",
            found: || {
                let post = Capsule3::new(at([0., 2., 0.]), at([0., 2., 1.]), 0.1);
                [1.0, 2.0]
                    .map(|l| {
                        first_hit(Ray3::new(at([0., 0., 0.2]), at([0., l, 0.])), post).parameter * l
                    })
                    .to_vec()
            },
            right: || vec![1.9; 2],
            within: 1e-15,
        },
        Report {
            library: "bepu/bepuphysics2",
            number: 253,
            about: "a miss along the axis",
            asked: "kind and parameter of rays from the centre of a cylinder of radius 3 and height 4, along and across its axis",
            source: "closed form: from inside, 2 and 3",
            found: || {
                let can = Cylinder::new(at([0., -2., 0.]), at([0., 2., 0.]), 3.0);
                [[0., 1., 0.], [0., 0., 1.]]
                    .into_iter()
                    .flat_map(|d| {
                        let hit = first_hit(Ray3::new(Vec3::zero(), at(d)), can);
                        [hit.kind, hit.parameter]
                    })
                    .collect()
            },
            right: || vec![2.0, 2.0, 2.0, 3.0],
            within: 1e-15,
        },
        Report {
            library: "mikedh/trimesh",
            number: 1766,
            about: "a miss between two triangles",
            asked: "kinds of the hits of a ray through the common edge of two triangles",
            source: "definition: the edge belongs to both",
            found: || {
                let [a, b, c, d] =
                    [[-1., -1., 0.], [-1., 1., 0.], [1., 1., 0.], [1., -1., 0.]].map(at);
                let ray = Ray3::new(at([0., 0., 1.]), at([0., 0., -1.]));
                vec![
                    first_hit_triangle(ray, Triangle3::new(a, b, c)).kind,
                    first_hit_triangle(ray, Triangle3::new(c, d, a)).kind,
                ]
            },
            right: || vec![1.0; 2],
            within: 0.0,
        },
        Report {
            library: "libigl/libigl-python-bindings",
            number: 78,
            about: "a second hit at 9.5",
            asked: "the parameters of a ray's hits of a cube's triangles, in order, and of the first hit of the cube",
            source: "closed form 9, 10; 9",
            found: || {
                let ray = Ray3::new(at([0.5, 0.1, 10.]), at([0., 0., -1.]));
                let mut hits: Vec<f64> = cube_faces()
                    .into_iter()
                    .map(|t| first_hit_triangle(ray, t))
                    .filter(|hit| hit.kind > 0.0)
                    .map(|hit| hit.parameter)
                    .collect();
                hits.sort_by(f64::total_cmp);
                hits.push(first_hit(ray, Aabb3::new(Vec3::zero(), at([1.; 3]))).parameter);
                hits
            },
            right: || vec![9.0, 10.0, 9.0],
            within: 1e-15,
        },
        Report {
            library: "svenstaro/bvh",
            number: 140,
            about: "a NaN parameter",
            asked: "kind of the hit of a box of size zero by a ray that passes beside it, and whether the parameter is finite, `f32`",
            source: "definition: a miss",
            found: || {
                let p = Vec3::new(5.693_442e-39_f32, -5000.0, 5000.0);
                let hit = first_hit(
                    Ray3::new(
                        Vec3::new(-5000.0, -5000.0, 5000.0),
                        Vec3::new(0.707_106_77, 0.707_106_77, 0.0),
                    ),
                    Aabb3::new(p, p),
                );
                vec![hit.kind.into(), flag(hit.parameter.is_finite())]
            },
            right: || vec![0.0, 1.0],
            within: 0.0,
        },
        Report {
            library: "newton-physics/newton",
            number: 486,
            about: "moments about y and z exchanged",
            asked: "the moments of inertia of an upright capsule, radius 1/2, height 1, density 1",
            source: "closed form of a cylinder and two half balls",
            found: || {
                let m = Capsule3::new(at([0., 0., -0.5]), at([0., 0., 0.5]), 0.5).inertia();
                vec![m.xx, m.yy, m.zz]
            },
            right: || {
                let (r, h) = (0.5, 1.0);
                let (can, ball) = (PI * r * r * h, 4.0 / 3.0 * PI * r * r * r);
                let across = can * (h * h / 12.0 + r * r / 4.0)
                    + ball * (0.4 * r * r + h * h / 4.0 + 3.0 / 8.0 * h * r);
                vec![across, across, can * r * r / 2.0 + ball * 0.4 * r * r]
            },
            within: 1e-14,
        },
    ]
}
