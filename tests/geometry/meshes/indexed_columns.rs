//! Columns by indices: the bits of columns with the items themselves, and cotangents of shared items.
use super::mesh_shapes::bumpy_sphere;
use crate::space::draw::Random;
use geograd::error::{Argument, Error};
use geograd::kernels::{Area, Backend, Cpu, Distance, Indexed, Iou, Volume, function};
use geograd::{
    Obb2, Pack, Scalar, Segment2, Segment3, Sphere, Tetrahedron, Triangle2, Triangle3, Vec2, Vec3,
};
use geograd_tests::with_threads;

#[test]
fn columns_by_indices_have_the_bits_of_their_items() {
    let mut random = Random(0x1d3e_d000_0000_0001);
    let (cpu, owned) = (Cpu::new(), bumpy_sphere(3));
    let column = Indexed::new(&owned.vertices, &owned.faces).unwrap();
    let faces: Vec<Triangle3<f64>> = (0..owned.faces.len() as u32)
        .map(|face| owned.mesh().triangle(face))
        .collect();
    assert!(
        faces
            .iter()
            .enumerate()
            .all(|(k, own)| *own == column.shape(k))
    );
    let areas = cpu.aligned(Area, column).unwrap();
    assert_eq!(areas, cpu.aligned(Area, &faces).unwrap());
    // Beside an ordinary column, in other forms and on a backend.
    let points: Vec<_> = faces.iter().map(|_| random.vector(2.0)).collect();
    let expected = cpu.aligned(Distance, (&points, &faces)).unwrap();
    assert_eq!(cpu.aligned(Distance, (&points, column)).unwrap(), expected);
    let backend = Backend::Cpu;
    let narrow = |v: &Vec3<f64>| -> Vec3<f32> { v.cast() };
    let vertices: Vec<_> = owned.vertices.iter().map(narrow).collect();
    let single = Indexed::new(&vertices, &owned.faces).unwrap();
    let areas = backend.aligned(Area, single).unwrap();
    assert_eq!(areas, cpu.aligned(Area, single).unwrap());
    let few = &points[..3];
    let (own, same) = (
        cpu.row_min(Distance, few, column).unwrap(),
        cpu.row_min(Distance, few, &faces).unwrap(),
    );
    for (own, same) in own.iter().zip(&same) {
        assert_eq!((own.value, own.index), (same.value, same.index));
    }
    let (_, (_, own)) = cpu
        .aligned(Distance.value_grad(), (&points, column))
        .unwrap();
    let (_, (_, same)) = cpu
        .aligned(Distance.value_grad(), (&points, &faces))
        .unwrap();
    assert_eq!(own, same);
}

#[test]
fn every_shape_over_points_has_its_corners() {
    let flat = [(0.0, 0.0), (1.0, 0.0), (0.0, 2.0)].map(|(x, y)| Vec2::new(x, y));
    let [a, b, c] = flat;
    assert_eq!(
        Indexed::new(&flat, &[[2, 0]]).unwrap().shape(0),
        Segment2 { from: c, to: a }
    );
    assert_eq!(
        Indexed::new(&flat, &[[0, 2, 1]]).unwrap().shape(0),
        Triangle2 { a, b: c, c: b }
    );
    let space = [0.0, 1.0, 2.0, 3.0].map(|x: f64| Vec3::new(x, x * x, x * x * x));
    let [p, q, r, s] = space;
    let edge = Indexed::new(&space, &[[3, 1]]).unwrap().shape(0);
    assert_eq!(edge, Segment3::new(s, q));
    let tetrahedra = Indexed::new(&space, &[[0, 1, 2, 3]]).unwrap();
    assert_eq!(tetrahedra.shape(0), Tetrahedron::new(p, q, r, s));
    let volumes = Cpu::new().aligned(Volume, tetrahedra).unwrap();
    assert_eq!(volumes, [tetrahedra.shape(0).volume()]);
    let bars = tetrahedra
        .gathered(&[Tetrahedron::new(s, r, q, p)])
        .unwrap();
    assert_eq!(bars, [s, r, q, p]);
}

/// A shared item that several items have, and one item has twice, gets the sum of all parts.
#[test]
fn cotangents_of_shared_items_are_sums() {
    let balls = [0.0, 4.0, 9.0, 20.0].map(|x| Sphere::new(Vec3::new(x, 0.0, 0.0), 1.0));
    let cpu = Cpu::new();
    let (left, right) = ([0_u32, 1, 0, 1], [1_u32, 2, 2, 1]);
    let (a, b) = (
        Indexed::new(&balls, &left).unwrap(),
        Indexed::new(&balls, &right).unwrap(),
    );
    assert_eq!(cpu.aligned(Distance, (a, b)).unwrap(), [2.0, 3.0, 7.0, 0.0]);
    let up = [1.0, 10.0, 100.0, 1000.0];
    let (by_a, by_b) = cpu.aligned(Distance.vjp(), ((a, b), &up)).unwrap();
    let (by_a, by_b) = (a.gathered(&by_a).unwrap(), b.gathered(&by_b).unwrap());
    let way = |all: &[Sphere<f64>]| -> Vec<f64> { all.iter().map(|own| own.center.x).collect() };
    assert_eq!(way(&by_a), [-101.0, -10.0, 0.0, 0.0]);
    assert_eq!(way(&by_b), [0.0, 1.0, 110.0, 0.0]);
    assert_eq!(by_a[0].radius, -101.0);
    // One face with the same corner twice.
    let points = [Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0)];
    let column = Indexed::new(&points, &[[0, 0, 1]]).unwrap();
    let bar = Triangle3::new(points[1], points[1] * 2.0, points[1] * 4.0);
    let sums = column.gathered(&[bar]).unwrap();
    assert_eq!(sums, [points[1] * 3.0, points[1] * 4.0]);
}

#[test]
fn cotangents_of_vertices_are_those_of_differences() {
    fn sliver<S: Scalar>(face: Triangle3<S>, at: Vec3<S>) -> S {
        face.area() * (face.center() - at).length_squared()
    }
    let (mut random, cpu) = (Random(0x1d3e_d000_0000_0002), Cpu::new());
    let owned = bumpy_sphere(1);
    let at: Vec<_> = owned.faces.iter().map(|_| random.vector(1.0)).collect();
    let sum = |vertices: &[Vec3<f64>]| -> f64 {
        let column = Indexed::new(vertices, &owned.faces).unwrap();
        let all = cpu.aligned(function(sliver), (column, &at)).unwrap();
        all.iter().sum()
    };
    let column = Indexed::new(&owned.vertices, &owned.faces).unwrap();
    let ones = vec![1.0; owned.faces.len()];
    let (by_face, _) = cpu
        .aligned(function(sliver).vjp(), ((column, &at), &ones))
        .unwrap();
    let bars = column.gathered(&by_face).unwrap();
    let way: Vec<_> = owned.vertices.iter().map(|_| random.vector(1.0)).collect();
    let slope: f64 = bars.iter().zip(&way).map(|(bar, way)| bar.dot(*way)).sum();
    let moved = |step: f64| {
        let all = owned.vertices.iter().zip(&way);
        sum(&all.map(|(&v, &w)| v + w * step).collect::<Vec<_>>())
    };
    let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
    assert!(
        (slope - difference).abs() < 1e-7 * slope.abs(),
        "{slope} {difference}"
    );
}

#[test]
fn threads_change_no_bit_of_gathered_cotangents() {
    let (mut random, owned) = (Random(0x1d3e_d000_0000_0003), bumpy_sphere(4));
    let up: Vec<f64> = owned
        .faces
        .iter()
        .map(|_| random.within(-1.0, 1.0))
        .collect();
    let run = |threads: usize| {
        with_threads(threads, || {
            let column = Indexed::new(&owned.vertices, &owned.faces).unwrap();
            let by_face = Cpu::new().aligned(Area.vjp(), (column, &up)).unwrap();
            let bars = column.gathered(&by_face).unwrap();
            bars.iter()
                .map(|v| v.x.to_bits() ^ v.y.to_bits())
                .collect::<Vec<_>>()
        })
    };
    assert!(run(1) == run(2));
}

#[test]
fn faults_of_indices_name_the_item() {
    let boxes = [Obb2::new(0.0, 0.0, 1.0, 1.0, 0.0); 3];
    let Err(fault) = Indexed::new(&boxes, &[0_u32, 3]) else {
        panic!("3 is beyond");
    };
    let text = fault.to_string();
    assert!(
        text.contains("indices") && text.contains("index 3 in place 0"),
        "{text}"
    );
    assert!(matches!(
        fault,
        Error::Invalid {
            argument: Argument::Named("indices"),
            item: 1,
            ..
        }
    ));
    let points = [Vec3::new(0.0, 0.0, 0.0); 4];
    let text = Indexed::new(&points, &[[0, 1, 2], [1, 2, 7]])
        .unwrap_err()
        .to_string();
    assert!(text.contains("index 7 in place 2"), "{text}");
    // Shapes are checked where they are read.
    let bad = [
        Obb2::new(0.0, 0.0, 1.0, 1.0, 0.0),
        Obb2::new(0.0, 0.0, -1.0, 1.0, 0.0),
    ];
    let column = Indexed::new(&bad, &[0_u32, 0, 1]).unwrap();
    let fault = Cpu::new().aligned(Iou, (column, column)).unwrap_err();
    assert!(matches!(fault, Error::Invalid { item: 2, .. }), "{fault}");
    let fault = column.gathered(&bad).unwrap_err();
    assert!(
        matches!(
            fault,
            Error::Length {
                expected: 3,
                found: 2,
                ..
            }
        ),
        "{fault}"
    );
}
