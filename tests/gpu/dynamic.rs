//! The untyped face on the GPU: the bits of the typed one there.
use crate::gpu;
use geograd::kernels::dynamic::{Layout, Mode, Rows, Tracing, operation, symbol};
use geograd::kernels::{Backend, Op, Perimeter, Width};
use geograd::{ConvexPolygon, Error, Fixed, Obb2, Pack, Unrecordable, Vec2};
use geograd_tests::rows::{GiouObb2, IouObb2, SignedDistancePointRing};

const A: [f32; 15] = [
    0.0, 0.0, 2.0, 2.0, 0.0, 5.0, 5.0, 1.0, 3.0, 0.7, 1.0, 0.5, 4.0, 1.0, -0.3,
];
const B: [f32; 10] = [1.0, 0.0, 2.0, 2.0, 0.0, 5.0, 4.0, 2.0, 2.0, 0.1];

fn boxes(numbers: &[f32]) -> Vec<Obb2<f32>> {
    numbers.chunks_exact(5).map(Obb2::load).collect()
}

#[test]
fn the_untyped_face_has_the_bits_of_the_typed_one() {
    let Some((_turn, gpu)) = gpu() else { return };
    let on = Backend::Gpu(gpu);
    let (a, b) = (boxes(&A), boxes(&B));
    let (rows, columns) = (Rows::new(&A, 5), Rows::new(&B, 5));

    // By hand and generated.
    let iou = operation("iou_obb2").expect("is listed");
    let giou = operation("giou_obb2").expect("is listed");
    let both = iou
        .function::<f32>(Mode::ValueGrad)
        .expect("is of fixed size");
    let one = Rows::one(&B[..5]);
    let found = both.on(on).unwrap().aligned(&[rows, one]).unwrap();
    let (value, (by_a, by_b)) = gpu
        .aligned(IouObb2.value_grad(), (&a, geograd::kernels::One(b[0])))
        .unwrap();
    assert_eq!(found, [value, by_a.scalars(), by_b.scalars()]);
    for (name, all, of_typed) in [
        ("by hand", iou, gpu.all_pairs(IouObb2, &a, &b).unwrap()),
        ("generated", giou, gpu.all_pairs(GiouObb2, &a, &b).unwrap()),
    ] {
        let value = all.value::<f32>().expect("is of fixed size");
        assert_eq!(
            value.on(on).unwrap().all_pairs(rows, columns).unwrap(),
            of_typed.values(),
            "{name}"
        );
    }
    let value = giou.value::<f32>().expect("is of fixed size");
    assert_eq!(
        value.on(on).unwrap().row_max(rows, columns).unwrap(),
        gpu.row_max(GiouObb2, &a, &b).unwrap()
    );
    assert_eq!(
        value.on(on).unwrap().column_max(rows, columns).unwrap(),
        gpu.column_max(GiouObb2, &a, &b).unwrap()
    );
    assert_eq!(
        value.on(on).unwrap().above(rows, columns, 0.1).unwrap(),
        gpu.above(GiouObb2, &a, &b, 0.1).unwrap()
    );
    assert_eq!(
        value
            .on(on)
            .unwrap()
            .count_above(rows, columns, 0.1)
            .unwrap(),
        gpu.count_above(GiouObb2, &a, &b, 0.1).unwrap()
    );
    assert_eq!(
        value.on(on).unwrap().sum(rows, columns).unwrap(),
        gpu.sum(GiouObb2, &a, &b).unwrap()
    );
    assert_eq!(
        value.on(on).unwrap().mean(rows, columns).unwrap(),
        gpu.mean(GiouObb2, &a, &b).unwrap()
    );
    let flat = |(x, a, b): (f64, Vec<Obb2<f32>>, Vec<Obb2<f32>>)| (x, a.scalars(), b.scalars());
    assert_eq!(
        value.on(on).unwrap().sum_grad(rows, columns).unwrap(),
        flat(gpu.sum_grad(GiouObb2, &a, &b).unwrap())
    );
    assert_eq!(
        value.on(on).unwrap().mean_grad(rows, columns).unwrap(),
        flat(gpu.mean_grad(GiouObb2, &a, &b).unwrap())
    );
    let upstream = [1.0, 0.0, 2.0, 0.5, 0.0, 1.0];
    let (a_bar, b_bar) = gpu.all_pairs_vjp(GiouObb2, &a, &b, &upstream).unwrap();
    assert_eq!(
        value
            .on(on)
            .unwrap()
            .all_pairs_vjp(rows, columns, &upstream)
            .unwrap(),
        (a_bar.scalars(), b_bar.scalars())
    );
    let wrong = [0.0, 0.0, 1.0, -1.0, 0.0];
    let error = value
        .on(on)
        .unwrap()
        .sum(rows, Rows::new(&wrong, 5))
        .unwrap_err();
    assert_eq!(error.to_string(), "`b` item 0: height is negative");

    // A traced function: the distance of two points, twice.
    let tracing = Tracing::<f32>::start(&[Layout::numbers(2), Layout::of::<Vec2<f32>>()]).unwrap();
    let inputs = tracing.inputs();
    let [p, q] = &inputs[..] else { unreachable!() };
    let side = |k: usize| symbol::sub(p[k], q[k]).unwrap();
    let far = symbol::hypot(side(0), side(1)).unwrap();
    let twice = tracing
        .finish(&[&[symbol::add(far, far).unwrap()]])
        .unwrap()
        .function();
    let (p, q) = ([3.0, 4.0, 0.0, 0.0], [0.0, 0.0]);
    assert_eq!(
        twice
            .on(on)
            .unwrap()
            .aligned(&[Rows::new(&p, 2), Rows::one(&q)])
            .unwrap(),
        [[10.0, 0.0]]
    );
    assert_eq!(
        twice
            .on(on)
            .unwrap()
            .row_max(Rows::new(&q, 2), Rows::new(&p, 2))
            .unwrap()[0]
            .index,
        0
    );

    // A search is replayed, but not for all pairs.
    let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)];
    let square = square.map(|(x, y)| Vec2::new(x, y));
    let square = ConvexPolygon::<f32, 6>::from_vertices(&square);
    let width = operation("width_of_polygon")
        .expect("is listed")
        .value::<f32>()
        .expect("is of fixed size");
    let numbers: Vec<f32> = square
        .scalars()
        .into_iter()
        .chain(square.codes().into_iter().map(|x| x as f32))
        .collect();
    let found = width
        .on(on)
        .unwrap()
        .aligned(&[Rows::one(&numbers)])
        .unwrap();
    assert_eq!(found, [gpu.aligned(Width, &[square]).unwrap()]);
    let polygons = operation("iou_polygons").expect("is listed");
    let layout = polygons.layouts::<f32>()[0];
    let polygon = vec![0.0; layout.fields()];
    let refused = polygons
        .value::<f32>()
        .expect("is of fixed size")
        .on(on)
        .unwrap()
        .sum(Rows::one(&polygon), Rows::one(&polygon));
    assert_eq!(refused, Err(Error::Program(Unrecordable::Search)));

    // Paths.
    let ring = [0.0, 0.0, 2.0, 0.0, 2.0, 2.0, 0.0, 2.0];
    let vertices: Vec<Vec2<f32>> = ring.chunks_exact(2).map(Vec2::load).collect();
    let perimeter = operation("perimeter")
        .expect("is listed")
        .on_paths::<f32>()
        .expect("is a ring");
    assert_eq!(
        perimeter
            .on(on)
            .unwrap()
            .values(&[], &ring, &[0, 4])
            .unwrap(),
        gpu.ragged(Perimeter.over_ring(), &vertices, &[0, 4])
            .unwrap()
    );
    let distance = operation("signed_distance_point_ring")
        .expect("is listed")
        .on_paths::<f32>()
        .expect("is a fold");
    let point = [1.0, 0.5];
    let (by_point, by_vertex) = distance
        .on(on)
        .unwrap()
        .vjp(&[Rows::new(&point, 2)], &ring, &[0, 4], &[1.0])
        .unwrap();
    let expected = gpu
        .fold_vjp(
            SignedDistancePointRing,
            &[Vec2::new(1.0, 0.5)],
            &vertices,
            &[0, 4],
            &[1.0],
        )
        .unwrap();
    assert_eq!(
        (by_point, by_vertex),
        (vec![expected.0.scalars()], expected.1.scalars())
    );

    // One ring for all points.
    let points = [1.0, 0.5, 3.0, 1.0, -1.0, 0.25];
    let many: Vec<Vec2<f32>> = points.chunks_exact(2).map(Vec2::load).collect();
    let (contexts, upstream) = ([Rows::new(&points, 2)], [1.0, -2.0, 0.5]);
    assert_eq!(
        distance
            .on(on)
            .unwrap()
            .values(&contexts, &ring, &[0, 4])
            .unwrap(),
        gpu.fold_one(SignedDistancePointRing, &many, &vertices)
            .unwrap()
    );
    let (by_points, by_vertex) = distance
        .on(on)
        .unwrap()
        .vjp(&contexts, &ring, &[0, 4], &upstream)
        .unwrap();
    let expected = gpu
        .fold_one_vjp(SignedDistancePointRing, &many, &vertices, &upstream)
        .unwrap();
    assert_eq!(
        (by_points, by_vertex),
        (vec![numbers_of(&expected.0)], numbers_of(&expected.1))
    );
}

fn numbers_of(points: &[Vec2<f32>]) -> Vec<f32> {
    points.iter().flat_map(|point| [point.x, point.y]).collect()
}
