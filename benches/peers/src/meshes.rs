//! Queries of meshes next to parry3d: building, closest points, rays, gradients.
use super::timed::Timed;
use super::{Dice, on_threads, solids_beside};
use geograd::kernels::Cpu;
use geograd::kernels::cpu::mesh_batches::MeshDistance;
use geograd::mesh::{Mesh, MeshTree};
use geograd::{Ray3, Vec3};
use parry3d_f64::math::Vector;
use parry3d_f64::query::{PointQuery, Ray, RayCast};
use parry3d_f64::shape::TriMesh;
use std::f64::consts::TAU;
use std::hint::black_box;

/// The number of queries of a call.
const QUERIES: usize = 10_000;
/// How often all takes its turn.
const ROUNDS: usize = 8;
/// Beyond this many directions a ray ends.
const FAR: f64 = 1e9;

pub type Faces = (Vec<Vec3<f64>>, Vec<[u32; 3]>);

/// A tube of so many by so many quadrilaterals along a closed curve, each two faces, with a rough surface.
pub fn tube(curve: impl Fn(f64) -> Vec3<f64>, radius: f64, [long, round]: [usize; 2]) -> Faces {
    let mut dice = Dice(5);
    let mut vertices = Vec::new();
    for i in 0..long {
        let t = TAU * i as f64 / long as f64;
        let along = curve(t + 1e-4) - curve(t - 1e-4);
        let along = along * (1.0 / along.length());
        let side = along.cross(Vec3::new(0.3, 0.5, 0.81));
        let side = side * (1.0 / side.length());
        let up = along.cross(side);
        for j in 0..round {
            let (sin, cos) = (TAU * j as f64 / round as f64).sin_cos();
            let rough = radius * dice.within(0.99, 1.01);
            vertices.push(curve(t) + side * (cos * rough) + up * (sin * rough));
        }
    }
    let at = |i: usize, j: usize| ((i % long) * round + j % round) as u32;
    let quads = (0..long).flat_map(|i| (0..round).map(move |j| (i, j)));
    let faces = quads.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    (vertices, faces.collect())
}

pub fn ring(t: f64) -> Vec3<f64> {
    Vec3::new(0.35 * t.cos(), 0.35 * t.sin(), 0.0)
}
pub fn knot(t: f64) -> Vec3<f64> {
    let r = (3.0 * t).cos() + 2.0;
    let place = Vec3::new(r * (2.0 * t).cos(), r * (2.0 * t).sin(), -(3.0 * t).sin());
    place * (1.0 / 6.8)
}

fn vector(v: Vec3<f64>) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

/// Times one mesh, with points near its surface or anywhere around it.
fn table(name: &str, (vertices, faces): &Faces, near: Option<f64>) {
    let mut dice = Dice(9);
    let mut way = |size: f64| {
        let [x, y, z] = [0, 1, 2].map(|_| dice.within(-size, size));
        Vec3::new(x, y, z)
    };
    let points: Vec<_> = (0..QUERIES)
        .map(|k| match near {
            Some(size) => vertices[k * 7919 % vertices.len()] + way(size),
            None => way(0.6),
        })
        .collect();
    let rays: Vec<_> = points.iter().map(|&v| Ray3::new(v, way(1.0))).collect();
    let mesh = Mesh::new(vertices, faces).expect("is valid");
    let tree = MeshTree::new(&mesh);
    let surface = tree.on(&mesh).expect("is its tree");
    let corners: Vec<_> = vertices.iter().map(|&v| vector(v)).collect();
    let other = TriMesh::new(corners.clone(), faces.clone()).expect("is valid");
    let cpu = Cpu::new();

    let records = cpu.nearest_faces(&surface, &points).expect("finite");
    let distances = cpu.mesh_distances(MeshDistance::Plain, &surface, &points, &records);
    let distances = distances.expect("of these points");
    let hits = cpu.hit_faces(&surface, &rays).expect("finite");
    let hits = cpu
        .first_hits(&surface, &rays, &hits)
        .expect("of these rays");
    let theirs =
        |v: Vec3<f64>| (other.project_local_point(vector(v), false).point - vector(v)).length();
    let cast = |ray: &Ray3<f64>| {
        let ray = Ray::new(vector(ray.point), vector(ray.direction));
        other.cast_local_ray(&ray, FAR, false)
    };
    let apart = points.iter().zip(&distances);
    let apart = apart
        .map(|(&v, own)| (theirs(v) - own).abs())
        .fold(0.0, f64::max);
    assert!(apart < 1e-12, "parry3d's distances differ by {apart}");
    let misses = rays
        .iter()
        .zip(&hits)
        .filter(|(ray, hit)| cast(ray).is_some() != hit.is_some());
    let misses = misses.count();

    let ones = vec![1.0; QUERIES];
    let (surface, points, rays) = (&surface, &points, &rays);
    let mut timed = [
        Timed::new(1, || drop(black_box(MeshTree::new(&mesh)))),
        Timed::new(1, || {
            drop(black_box(TriMesh::new(corners.clone(), faces.clone())));
        }),
        Timed::new(QUERIES, || {
            let found = cpu.nearest_faces(surface, points).expect("finite");
            let all = cpu.mesh_distances(MeshDistance::Plain, surface, points, &found);
            drop(black_box(all));
        }),
        Timed::new(QUERIES, || {
            let found = cpu.nearest_faces(surface, points).expect("finite");
            let all = cpu.mesh_distances(MeshDistance::Plain, surface, points, &found);
            drop(black_box(all));
            let bars = cpu.mesh_distances_vjp(MeshDistance::Plain, surface, points, &found, &ones);
            drop(black_box(bars));
        }),
        Timed::new(QUERIES, || {
            black_box(points.iter().map(|&v| theirs(v)).sum::<f64>());
        }),
        Timed::new(QUERIES, || {
            let found = cpu.hit_faces(surface, rays).expect("finite");
            drop(black_box(cpu.first_hits(surface, rays, &found)));
        }),
        Timed::new(QUERIES, || {
            black_box(rays.iter().filter_map(cast).sum::<f64>());
        }),
    ];
    for _ in 0..ROUNDS {
        timed.iter_mut().for_each(Timed::turn);
    }
    let [build, parrys, distance, gradient, point, ray, hit] = timed.map(|own| own.microseconds());
    let each = |all: f64| all * 1e3 / QUERIES as f64;
    let where_from = near.map_or("around", |_| "near");
    println!(
        "| {name}, {where_from} | {:.1} / {:.1} | {:.0} | {:.2} | {:.0} | {:.1} | {:.0} / {:.0} | {:.1} | {misses} |",
        build / 1e3,
        parrys / 1e3,
        each(distance),
        gradient / distance,
        each(point),
        point / distance,
        each(ray),
        each(hit),
        hit / ray,
    );
}

pub fn run() {
    println!(
        "One thread, `f64`; the fastest of many calls by turns, in ns a query, sorting included; building in ms.\n"
    );
    println!(
        "| mesh, points | build, ours / parry3d | distance | with gradient, times | parry3d | ratio | ray, ours / parry3d | ratio | rays that only one hits |"
    );
    println!("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
    on_threads(1, || {
        for (name, faces) in [
            ("ring, 20,000 faces", tube(ring, 0.14, [200, 50])),
            ("knot, 200,000 faces", tube(knot, 0.055, [2000, 50])),
        ] {
            table(name, &faces, None);
            table(name, &faces, Some(0.01));
        }
        solids_beside::head();
        solids_beside::table("ring, 2,000 faces", &tube(ring, 0.14, [50, 20]));
        solids_beside::table("ring, 20,000 faces", &tube(ring, 0.14, [200, 50]));
        solids_beside::table("knot, 200,000 faces", &tube(knot, 0.055, [2000, 50]));
    });
}
