//! Verbs select the operation by shapes; own verbs, own shapes and plain functions run in every form.
use geograd::convention::{ImageBox, Le90};
use geograd::iou::Exponent;
use geograd::kernels::verbs::Takes;
use geograd::kernels::{Function, Op, Table};
use geograd::prelude::*;
use geograd::{Error, Fixed, Sym, Unrecordable, operation, verb};
use geograd_tests::rows::{DistanceCircleObb2, DistancePointObb2, IouObb2};

fn cars<const N: usize>() -> [Obb2<f64>; N] {
    std::array::from_fn(|i| {
        let t = i as f64;
        Obb2::new(0.7 * t, 0.4 * t, 4.0 + 0.1 * t, 2.0, 0.3 * t)
    })
}
fn points<const N: usize>() -> [Vec2<f64>; N] {
    std::array::from_fn(|i| Vec2::new(6.0 - 2.0 * i as f64, 1.0 + i as f64))
}

#[test]
fn columns_select_the_formula() -> Result<(), Error> {
    let (cpu, cars, points) = (Cpu::new(), cars::<5>(), points::<5>());
    let found = cpu.aligned(Distance, (&points, &cars))?;
    assert_eq!(found, cpu.aligned(DistancePointObb2, (&points, &cars))?);
    let masts = points.map(|p| Circle::new(p, 0.5));
    let found = cpu.aligned(Distance, (&masts, &cars))?;
    assert_eq!(found, cpu.aligned(DistanceCircleObb2, (&masts, &cars))?);
    let single = cars.map(|x| x.cast::<f32>());
    let found: Vec<f32> = cpu.aligned(Iou, (&single, One(single[2])))?;
    assert_eq!(found[2], 1.0);
    let table: Table<f64> = cpu.all_pairs(Iou, &cars, &cars)?;
    assert_eq!(
        table.values(),
        cpu.all_pairs(IouObb2, &cars, &cars)?.values()
    );
    let best = cpu.row_max(Iou, &cars, &cars[1..])?;
    let expected = cpu.row_max(IouObb2, &cars, &cars[1..])?;
    assert_eq!(format!("{best:?}"), format!("{expected:?}"));
    Ok(())
}

#[test]
fn gradients_and_adjoints_have_the_operations_bits() -> Result<(), Error> {
    let (cpu, cars) = (Cpu::new(), cars::<4>());
    let pairs = (&cars[..3], &cars[1..]);
    let found = cpu.aligned(Iou.value_grad(), pairs)?;
    assert_eq!(found, cpu.aligned(IouObb2.value_grad(), pairs)?);
    let bars = [1.0, -2.0, 0.5];
    let found = cpu.aligned(Iou.vjp(), (pairs, &bars))?;
    assert_eq!(found, cpu.aligned(IouObb2.vjp(), (pairs, &bars))?);
    let (mean, by_a, by_b) = cpu.mean_grad(Giou, &cars, &cars)?;
    assert!(mean > 0.0 && by_a.len() == 4 && by_b.len() == 4);
    Ok(())
}

#[test]
fn three_shapes_conversions_and_searches() -> Result<(), Error> {
    let cpu = Cpu::new();
    let boxes = cars::<3>();
    let power = Exponent { alpha: 2.0 };
    let squared = cpu.aligned(AlphaIou, (&boxes, One(boxes[0]), One(power)))?;
    assert_eq!(squared[1], AlphaIou.of(boxes[1], boxes[0], power));
    let image = [ImageBox::from_mirrored(Obb2::new(
        10.0, 20.0, 4.0, 2.0, 0.1,
    ))];
    assert_eq!(
        cpu.aligned(convert::<Le90<_>>(), &image[..])?,
        [Le90::from(image[0])]
    );
    let ring = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y));
    let square = ConvexPolygon::<f64, 4>::from_vertices(&ring);
    assert_eq!(cpu.aligned(Iou, (&[square], &[square]))?, [1.0]);
    assert_eq!(Giou.of(square, square), 1.0);
    assert_eq!(cpu.aligned(Diameter, &[square][..])?, [5.0_f64.sqrt()]);
    assert_eq!((square.diameter(), square.width()), (5.0_f64.sqrt(), 1.0));
    let (_, derivatives) = cpu.aligned(Diameter.value_grad(), &[square][..])?;
    assert_eq!(derivatives.len(), 1);
    Ok(())
}

#[test]
fn methods_are_the_verbs() {
    let [a, b] = cars::<2>();
    assert_eq!(a.giou_aabb(b), GiouAabb.of(a, b));
    assert_eq!(
        a.eiou(b),
        Cpu::new().aligned(Eiou, (&[a], &[b])).unwrap()[0]
    );
    assert_eq!(a.kullback_leibler(b), KullbackLeibler.of(a, b));
    let ray = Ray2::new(Vec2::new(-9.0, 0.0), Vec2::new(1.0, 0.0));
    let hit = ray.first_hit(a);
    assert_eq!(hit, FirstHit.of(ray, a));
    // On dual numbers, too.
    let (value, derivatives) = gradient(|x: Obb2<_>| x.giou(b.lift()), a);
    assert_eq!(value, a.giou(b));
    assert!(derivatives.center.x != 0.0);
}

/// Generic over the verb.
fn largest<V, A, T>(verb: V, a: &[A], b: &[A]) -> Result<f64, Error>
where
    V: Function<(A, A), Out = f64> + Copy,
    A: geograd::kernels::Single<Scalar = f64> + Copy,
    (A, A): Fixed,
    V: Takes<(A, A), Out = T>,
{
    let table = Cpu::new().all_pairs(verb, a, b)?;
    Ok(table.values().iter().copied().fold(0.0, f64::max))
}

#[test]
fn a_function_is_generic_over_the_verb() -> Result<(), Error> {
    let cars = cars::<3>();
    assert_eq!(largest(Iou, &cars, &cars)?, 1.0);
    assert!(largest(Distance, &cars, &cars)? >= 0.0);
    Ok(())
}

verb! {
    /// The free width between two vehicles.
    Gap: (a, b)
}
/// A tree: its foot and its radius.
#[derive(Clone, Copy, Debug, PartialEq, geograd::Shape)]
struct Tree<S> {
    foot: Vec2<S>,
    radius: S,
}
operation! {
    /// Between two rotated boxes.
    Gap: (a: Obb2<S>, b: Obb2<S>) -> S { a.distance(b) }
    invariances [Exchange Stays] jumps Never derivative Reverse

    /// Between a box and a tree.
    Gap: (car: Obb2<S>, tree: Tree<S>) -> S { (car.distance(tree.foot) - tree.radius).most(S::zero()) }
    invariances [] jumps Never derivative Reverse

    /// A library's verb with a shape of one's own.
    SignedDistance: (car: Obb2<S>, tree: Tree<S>) -> S { car.signed_distance(tree.foot) - tree.radius }
    invariances [] jumps Never derivative Reverse
}

#[test]
fn own_verbs_and_shapes_run_in_every_form() -> Result<(), Error> {
    let (cpu, cars) = (Cpu::new(), cars::<4>());
    let trees = points::<4>().map(|foot| Tree { foot, radius: 0.5 });
    let table = cpu.all_pairs(Gap, &cars, &trees)?;
    for (i, car) in cars.iter().enumerate() {
        for (j, tree) in trees.iter().enumerate() {
            let expected = (car.distance(tree.foot) - 0.5).max(0.0);
            assert_eq!(table.at(i, j), expected, "{i} {j}");
            assert_eq!(Gap.of(*car, *tree), expected);
        }
    }
    assert_eq!(cpu.aligned(Gap, (&cars, &cars))?, [0.0; 4]);
    let (_, (_, by_tree)) = cpu.aligned(SignedDistance.value_grad(), (&cars, &trees))?;
    assert!(by_tree.iter().all(|derivative| derivative.radius == -1.0));
    // A gradient by duals, and the row's.
    let (_, derivative) = gradient(|t: Tree<_>| SignedDistance.of(cars[0].lift(), t), trees[0]);
    assert!((derivative.foot.x - by_tree[0].foot.x).abs() < 1e-12);
    Ok(())
}

#[test]
fn a_row_of_a_verb_is_checked() {
    // It panics on a refusal.
    geograd::check::Check::of(Gap.row::<(Obb2<f64>, Tree<f64>)>()).assert();
}

/// Five arguments.
fn weighted<S: Scalar>(a: Vec2<S>, b: Vec2<S>, c: Vec2<S>, weight: S, car: Obb2<S>) -> S {
    (a + b + c - car.center).length() * weight
}
fn nearest<S: Scalar>(point: Vec2<S>, car: Obb2<S>) -> Vec2<S> {
    (point + car.center) * S::lit(0.5)
}

#[test]
fn plain_functions_run_without_a_row() -> Result<(), Error> {
    let (cpu, cars, points) = (Cpu::new(), cars::<4>(), points::<4>());
    let columns = (&points, One(points[0]), One(points[1]), One(2.0_f64), &cars);
    let found = cpu.aligned(function(weighted), columns)?;
    for i in 0..4 {
        let expected = weighted(points[i], points[0], points[1], 2.0, cars[i]);
        assert_eq!(found[i], expected);
    }
    let (value, derivatives) = cpu.aligned(function(weighted).value_grad(), columns)?;
    assert_eq!(value, found);
    assert!((derivatives.3[0] - found[0] / 2.0).abs() < 1e-12);
    // Results of several numbers, all pairs, either format.
    let table = cpu.all_pairs(function(nearest), &points, &cars)?;
    assert_eq!(table.at(1, 2), nearest(points[1], cars[2]));
    let single = points.map(|p| p.cast::<f32>());
    let found = cpu.aligned(function(nearest), (&single, One(cars[0].cast())))?;
    assert_eq!(found[0], nearest(single[0], cars[0].cast()));
    let bars = cpu.aligned(function(nearest).vjp(), ((&points, &cars), &points))?;
    assert_eq!(bars.0[2], points[2] * 0.5);
    Ok(())
}

#[test]
fn closures_never_share_a_record() -> Result<(), Error> {
    let (cpu, points) = (Cpu::new(), points::<3>());
    let first = function(|p: Vec2<_>| p.x);
    let second = function(|p: Vec2<_>| p.y);
    assert_eq!(cpu.aligned(first, &points[..])?, points.map(|p| p.x));
    assert_eq!(cpu.aligned(second, &points[..])?, points.map(|p| p.y));
    assert_eq!(cpu.aligned(first, &points[..])?, points.map(|p| p.x));
    Ok(())
}

#[test]
fn a_function_that_cannot_be_recorded_says_why() {
    let infinite = function(|x: Sym<f64>| x + Sym::lit(f64::INFINITY));
    let found = Cpu::new().aligned(infinite, &[1.0][..]);
    assert!(matches!(found, Err(Error::Program(Unrecordable::Constant))));
}

#[test]
fn exchanged_arguments_and_two_kinds_of_boxes_have_the_same_values() {
    let [car, other] = cars::<2>();
    let mast = Circle::new(Vec2::new(4.0, 3.0), 0.5);
    let curb = Segment2::new(Vec2::new(-3.0, 2.5), Vec2::new(6.0, 4.0));
    assert_eq!(Distance.of(car, mast), Distance.of(mast, car));
    assert_eq!(SignedDistance.of(car, mast), SignedDistance.of(mast, car));
    assert_eq!(Distance.of(car, curb), Distance.of(curb, car));
    assert_eq!(Distance.of(mast, curb), Distance.of(curb, mast));
    assert_eq!(
        Distance.of(other, mast.center),
        Distance.of(mast.center, other)
    );
    let (there, back) = (ClosestPoints.of(mast, car), ClosestPoints.of(car, mast));
    assert_eq!((there.on_a, there.on_b), (back.on_b, back.on_a));
    assert_eq!(Distance.of(Vec2::new(0.0, 0.0), Vec2::new(3.0, 4.0)), 5.0);
    assert_eq!(Distance.of(2.0, 5.5), 3.5);
    let apart: f64 = Distance.of(Vec3::new(0.0, 1.0, 0.0), Vec3::new(2.0, 3.0, 1.0));
    assert!((apart - 3.0).abs() < 1e-15);
    let room = Aabb3::new(Vec3::new(-1.0_f64, -1.0, 0.0), Vec3::new(1.0, 1.0, 2.0));
    let upright = YawBox3::new(Vec3::new(1.0, 0.0, 1.0), Vec3::new(2.0, 2.0, 2.0), 0.4);
    let tilted = Obb3 {
        rotation: Rotation3::new(0.9, 0.1, 0.2, 0.3),
        ..Obb3::from(upright)
    };
    assert_eq!(
        room.intersection_volume(upright),
        IntersectionVolume.of(upright, room)
    );
    assert!((tilted.iou(room) - Iou.of(room, tilted)).abs() < 1e-14);
    assert_eq!(Iof.of(tilted, upright), tilted.iof(upright));
    let table = Cpu::new().all_pairs(Iou, &[upright], &[room]).unwrap();
    assert_eq!(table.values(), [upright.iou(room)]);
}

#[test]
fn further_rows_are_checked() {
    use geograd::check::Check;
    Check::of(Distance.row::<(Vec2<f64>, Vec2<f64>)>())
        .samples(40)
        .assert();
    Check::of(Distance.row::<(Vec3<f64>, Vec3<f64>)>())
        .samples(40)
        .assert();
    Check::of(Distance.row::<(Obb2<f64>, Circle<f64>)>())
        .samples(10)
        .hard(31)
        .assert();
    Check::of(SignedDistance.row::<(Circle<f64>, Segment2<f64>)>())
        .samples(10)
        .hard(31)
        .assert();
    Check::of(ClosestPoints.row::<(Obb2<f64>, Circle<f64>)>())
        .samples(10)
        .hard(31)
        .assert();
    Check::of(Iof.row::<(Aabb3<f64>, YawBox3<f64>)>())
        .samples(10)
        .hard(31)
        .assert();
    Check::of(IntersectionVolume.row::<(YawBox3<f64>, Aabb3<f64>)>())
        .samples(10)
        .hard(31)
        .assert();
}
