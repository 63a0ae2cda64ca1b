//! Results of several numbers with their Jacobians, in batches.
use geograd::ad;
use geograd::ad::check::sample::{Draw, Sample};
use geograd::ad::program::{Program, Sym};
use geograd::kernels::{
    Area, ClosestPoints, Cpu, Distance, Iou, MinimumCircle, MinimumRectangle, Move, One, Op, Skip,
    Wasserstein, function,
};
use geograd::{
    Circle, ConvexPolygon, Fixed, Obb2, Pack, Pose2, Scalar, Segment2, Triangle2, Vec2, operation,
};
use geograd_tests::rows::{
    CentroidTriangle, ClosestPointsObb2, ClosestPointsPointSegment, CornersOfObb2, Incircle,
    MoveSegment,
};

const COUNT: usize = 200;

fn draws<P: Sample>(seed: u64) -> Vec<P> {
    let mut draw = Draw::new(seed);
    (0..COUNT).map(|_| P::ordinary(&mut draw)).collect()
}

/// A Jacobian as rows of numbers.
fn rows<X: Pack>(jacobian: &impl Pack<Scalar = X>) -> Vec<Vec<X::Scalar>> {
    jacobian.scalars().iter().map(Pack::scalars).collect()
}

/// The cotangents that are one in a place of the result.
fn unit<Y: Fixed<Scalar: Scalar>>(k: usize) -> Y {
    let mut numbers = vec![Y::Scalar::zero(); Y::LEN];
    numbers[k] = Y::Scalar::one();
    Y::load(&numbers)
}

#[track_caller]
fn near(own: &[Vec<f64>], other: &[Vec<f64>]) {
    for (own, other) in own.iter().zip(other) {
        let size = other.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
        for (a, b) in own.iter().zip(other) {
            assert!((a - b).abs() <= 1e-9 * size, "{own:?} {other:?}");
        }
    }
}

/// Asserts for operations of one shape and of two: values are those of the operation, every row is the adjoint of an
/// axis of the result to the bit, and duals agree.
macro_rules! agree {
    ($($Op:ident($A:ty $(, $B:ty)?);)*) => { $({
        type Out = <$Op as Op>::Out<f64>;
        let a: Vec<$A> = draws(1);
        $(let b: Vec<$B> = draws(2);)?
        macro_rules! columns {
            () => { agree!(@pair &a $(, &b, $B)?) };
        }
        let (found, jacobians) = Cpu::new().aligned($Op.jacobian(), columns!()).unwrap();
        assert_eq!(found, Cpu::new().aligned($Op, columns!()).unwrap());
        assert_eq!(jacobians.len(), COUNT);
        for k in 0..Out::LEN {
            let bars = Cpu::new().aligned($Op.vjp(), (columns!(), One(unit::<Out>(k)))).unwrap();
            for (i, jacobian) in jacobians.iter().enumerate() {
                let bar = agree!(@item bars, i $(, $B)?);
                assert_eq!(rows(jacobian)[k], bar.scalars(), "{:?}, item {i}, number {k}", $Op);
            }
        }
        for (i, jacobian) in jacobians.iter().enumerate() {
            let x = agree!(@pair a[i] $(, b[i], $B)?);
            let (_, expected) = ad::jacobian(|x| $Op::eval(x), x);
            near(&rows(jacobian), &rows(&expected));
        }
    })* };
    (@pair $a:expr) => { $a };
    (@pair $a:expr, $b:expr, $B:ty) => { ($a, $b) };
    (@item $bars:ident, $i:ident) => { $bars[$i] };
    (@item $bars:ident, $i:ident, $B:ty) => { ($bars.0[$i], $bars.1[$i]) };
}

#[test]
fn a_row_is_the_adjoint_of_an_axis_of_the_result() {
    // Recorded backwards and forwards.
    agree! {
        CentroidTriangle(Triangle2<f64>);
        Incircle(Triangle2<f64>);
        MoveSegment(Pose2<f64>, Segment2<f64>);
        CornersOfObb2(Obb2<f64>);
        ClosestPointsPointSegment(Vec2<f64>, Segment2<f64>);
        ClosestPointsObb2(Obb2<f64>, Obb2<f64>);
    }
}

operation! {
    /// A vector in polar coordinates, with derivatives by hand.
    pub Polar = "polar": (v: Vec2<S>) -> Vec2<S> { Vec2::new(v.length(), v.y.atan2(v.x)) }
    invariances []
    jumps Anywhere
    derivative ByHand |v, out_bar| {
        let length = v.length();
        let (along, around) = (out_bar.x.over(length), out_bar.y.over(length * length));
        let bar = Vec2::new(v.x * along - v.y * around, v.y * along + v.x * around);
        (Vec2::new(length, v.y.atan2(v.x)), bar)
    }
}

#[test]
fn derivatives_by_hand_of_several_numbers() {
    agree! { Polar(Vec2<f64>); }
    let (_, derivatives) = Cpu::new()
        .aligned(Polar.jacobian(), &[Vec2::new(3.0_f32, 4.0)])
        .unwrap();
    assert_eq!(
        (derivatives[0].x, derivatives[0].y),
        (Vec2::new(0.6, 0.8), Vec2::new(-0.16, 0.12))
    );
}

#[test]
fn one_number_has_its_gradient() {
    let (a, b) = (draws::<Obb2<f64>>(1), draws::<Obb2<f64>>(2));
    let (values, (by_a, _)) = Cpu::new().aligned(Iou.value_grad(), (&a, &b)).unwrap();
    let (again, derivatives) = Cpu::new().aligned(Iou.jacobian(), (&a, &b)).unwrap();
    for i in 0..COUNT {
        assert!((values[i] - again[i]).abs() < 1e-12);
        near(&[derivatives[i].0.scalars()], &[by_a[i].scalars()]);
    }
}

#[test]
fn searches_keep_what_was_found() {
    let polygons: Vec<ConvexPolygon<f64, 6>> = draws(3);
    let cpu = Cpu::new();
    let (found, derivatives) = cpu.aligned(MinimumCircle.jacobian(), &polygons).unwrap();
    assert_eq!(found, cpu.aligned(MinimumCircle, &polygons).unwrap());
    for k in 0..3 {
        let axis = One(unit::<Circle<f64>>(k));
        let bars = cpu.aligned(MinimumCircle.vjp(), (&polygons, axis)).unwrap();
        for (derivatives, bar) in derivatives.iter().zip(&bars) {
            let own = derivatives.scalars()[k];
            assert_eq!(own, *bar);
            assert_eq!(own.count, bar.count);
        }
    }
    let (_, derivatives) = cpu.aligned(MinimumRectangle.jacobian(), &polygons).unwrap();
    // Moving all vertices moves the centre by as much.
    for (derivatives, polygon) in derivatives.iter().zip(&polygons) {
        let along = |gradient: &ConvexPolygon<f64, 6>| -> f64 {
            gradient.vertices[..polygon.count].iter().map(|v| v.x).sum()
        };
        assert!((along(&derivatives.center.x) - 1.0).abs() < 1e-9);
        assert!(along(&derivatives.size.x).abs() < 1e-9);
    }
}

#[test]
fn programs_of_several_numbers() {
    let corners = Program::trace(|b: Obb2<Sym<f64>>| b.corners()).unwrap();
    let boxes: Vec<Obb2<f64>> = draws(4);
    let run = corners.jacobian();
    let (found, derivatives) = Cpu::new().aligned(&run, &boxes).unwrap();
    for i in 0..COUNT {
        let (value, expected) = run.eval(boxes[i]);
        assert_eq!((found[i], derivatives[i]), (value, expected));
        assert_eq!(value, boxes[i].corners());
        let (_, duals) = ad::jacobian(|b: Obb2<_>| b.corners(), boxes[i]);
        near(&rows(&expected), &rows(&duals));
    }
    // An adjoint by hand is the Jacobian of one number.
    let norm = Program::trace(|v: Vec2<Sym<f64>>| v.length()).unwrap();
    let twice = norm.with_adjoint(|v: Vec2<Sym<f64>>| v + v).unwrap();
    assert_eq!(
        twice.jacobian().eval(Vec2::new(3.0, 4.0)),
        (5.0, Vec2::new(6.0, 8.0))
    );
}

#[test]
fn into_what_is_there() {
    let (a, b) = (draws::<Obb2<f64>>(1), draws::<Obb2<f64>>(2));
    let cpu = Cpu::new();
    let (found, derivatives) = cpu.aligned(ClosestPointsObb2.jacobian(), (&a, &b)).unwrap();
    let mut again = vec![derivatives[0]; COUNT];
    let columns = (&a, &b);
    cpu.aligned_into(ClosestPointsObb2.jacobian(), columns, (Skip, &mut again))
        .unwrap();
    assert_eq!(again, derivatives);
    let mut points = vec![found[0]; COUNT];
    let targets = (&mut points, &mut again[..]);
    cpu.aligned_into(ClosestPointsObb2.jacobian(), columns, targets)
        .unwrap();
    assert_eq!(points, found);
    cpu.aligned_into(ClosestPointsObb2.jacobian(), columns, Skip)
        .unwrap();
    let few = (Skip, &mut again[1..]);
    let refused = cpu
        .aligned_into(ClosestPointsObb2.jacobian(), columns, few)
        .unwrap_err();
    assert_eq!(
        refused.to_string(),
        "`result 1` has 199 items where 200 are needed"
    );
    let none: &[Obb2<f64>] = &[];
    let (found, derivatives) = cpu
        .aligned(ClosestPointsObb2.jacobian(), (none, none))
        .unwrap();
    assert!(found.is_empty() && derivatives.is_empty());
}

/// Hessians of a verb in batches, and products with them, beside those of its program.
macro_rules! hessians {
    ($Verb:ident, $A:ty, $B:ty, $count:literal) => {{
        let (a, b): (Vec<$A>, Vec<$B>) = (draws(5), draws(6));
        let directions: (Vec<$A>, Vec<$B>) = (draws(7), draws(8));
        let program = $Verb.row::<($A, $B)>().program::<f64>().unwrap();
        let (hessian, hvp) = (program.hessian::<$count>(), program.hvp());
        let (cpu, run) = (Cpu::new(), $Verb.value_grad());
        let ((values, (by_a, by_b)), second) = cpu.aligned(run.jacobian(), (&a, &b)).unwrap();
        let bars = (One(0.0), (&directions.0, &directions.1));
        let (to_a, to_b) = cpu.aligned(run.vjp(), ((&a, &b), bars)).unwrap();
        for i in 0..COUNT {
            let x = (a[i], b[i]);
            assert_eq!(values[i], program.eval(x));
            let (gradient, own) = &second[i];
            assert_eq!(gradient.scalars(), (by_a[i], by_b[i]).scalars());
            near(&rows(own), &hessian.eval(x).map(|row| row.scalars()));
            let product = hvp.eval((x, (directions.0[i], directions.1[i])));
            near(&[(to_a[i], to_b[i]).scalars()], &[product.scalars()]);
        }
        // The same by their own names.
        let columns = ((&a, &b), (&directions.0, &directions.1));
        let (by_a, by_b) = cpu.aligned($Verb.hvp(), columns).unwrap();
        let ((_, _), named) = cpu.aligned($Verb.hessian(), (&a, &b)).unwrap();
        for i in 0..COUNT {
            near(
                &[(by_a[i], by_b[i]).scalars()],
                &[(to_a[i], to_b[i]).scalars()],
            );
            assert_eq!(rows(&named[i].1), rows(&second[i].1));
        }
    }};
}

/// Derivatives along directions in batches, beside duals and, to the bit, beside those of the program; a row by hand
/// beside its gradient.
macro_rules! along {
    ($($Verb:ident($A:ty $(, $B:ty)?);)*) => { $({
        let (a, to_a): (Vec<$A>, Vec<$A>) = (draws(5), draws(7));
        $(let (b, to_b): (Vec<$B>, Vec<$B>) = (draws(6), draws(8));)?
        let columns = (along!(@pair &a $(, &b, $B)?), along!(@pair &to_a $(, &to_b, $B)?));
        let (values, slopes) = Cpu::new().aligned($Verb.jvp(), columns).unwrap();
        let row = $Verb.row::<along!(@type $A $(, $B)?)>();
        let program = row.program::<f64>().unwrap().jvp();
        for (i, (value, slope)) in values.iter().zip(&slopes).enumerate() {
            let x = along!(@pair a[i] $(, b[i], $B)?);
            let direction = along!(@pair to_a[i] $(, to_b[i], $B)?);
            assert_eq!((*value, *slope), program.eval((x, direction)), "{:?}, item {i}", $Verb);
            let (_, expected) = ad::jvp(|x| evaluated(row, x), x, direction);
            near(&[slope.scalars()], &[expected.scalars()]);
        }
    })* };
    (@pair $a:expr) => { $a };
    (@pair $a:expr, $b:expr, $B:ty) => { ($a, $b) };
    (@type $A:ty) => { $A };
    (@type $A:ty, $B:ty) => { ($A, $B) };
}

fn evaluated<O: Op, S: Scalar>(_row: O, x: O::In<S>) -> O::Out<S> {
    O::eval(x)
}

#[test]
fn derivatives_along_directions() {
    along! {
        Distance(Vec2<f64>, Obb2<f64>);
        Iou(Obb2<f64>, Obb2<f64>);
        ClosestPoints(Vec2<f64>, Segment2<f64>);
        Move(Pose2<f64>, Segment2<f64>);
        Area(Triangle2<f64>);
    }
    // A direction of boxes need not be a box, and directions are as many as items.
    let boxes = [Obb2::new(0.0, 0.0, 2.0, 1.0, 0.3)];
    let thinner = [Obb2::new(0.0, 0.0, -1.0, 0.0, 0.0)];
    let columns = ((&boxes, &boxes), (&thinner, &thinner));
    let (_, slopes) = Cpu::new().aligned(Iou.jvp(), columns).unwrap();
    assert_eq!(slopes, [0.0]);
    let few = ((&boxes, &boxes), (&thinner, &thinner[..0]));
    let error = Cpu::new().aligned(Iou.jvp(), few).unwrap_err();
    assert!(matches!(error, geograd::Error::Length { .. }), "{error:?}");
}

/// Derivatives of derivatives are recordings of their own: Hessians, products with them, adjoints of adjoints.
#[test]
fn derivatives_of_derivatives() {
    hessians!(Distance, Vec2<f64>, Obb2<f64>, 7);
    hessians!(Wasserstein, Obb2<f64>, Obb2<f64>, 10);

    // The adjoint of a product gives (y bar, x bar); its own adjoint has all second derivatives.
    fn multiplied<S: Scalar>(x: S, y: S) -> S {
        x * y
    }
    let product = function(multiplied);
    let columns = (((&[2.0], &[3.0]), &[5.0]), (&[7.0], &[11.0]));
    let found: ((Vec<f64>, Vec<f64>), Vec<f64>) =
        Cpu::new().aligned(product.vjp().vjp(), columns).unwrap();
    let ((by_x, by_y), by_bar) = found;
    assert_eq!((by_x[0], by_y[0], by_bar[0]), (55.0, 35.0, 43.0));
}
