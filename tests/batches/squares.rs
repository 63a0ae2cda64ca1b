//! Sums of least squares: those of every item's Jacobian, and gradients of the cost.
use geograd::distance::Convex;
use geograd::error::{Argument, Error};
use geograd::kernels::{Cpu, One, Robust, function};
use geograd::{Fixed, Obb2, Pack, Pose2, Scalar, Vec2};
use geograd_tests::Dice;

/// The residuals of a point that a pose should bring into a place.
fn residual<S: Scalar>(pose: [S; 3], from: Vec2<S>, to: Vec2<S>) -> Vec2<S> {
    Pose2::new(Vec2::new(pose[0], pose[1]), pose[2]) * from - to
}
/// How far a point is beyond the border of a box.
fn beyond<S: Scalar>(point: Vec2<S>, car: Obb2<S>) -> S {
    car.signed_distance(point)
}

fn points(dice: &mut Dice, count: usize) -> Vec<Vec2<f64>> {
    (0..count)
        .map(|_| Vec2::new(dice.within(-3.0, 3.0), dice.within(-3.0, 3.0)))
        .collect()
}

#[test]
fn sums_are_those_of_the_jacobians() {
    let mut dice = Dice(4);
    // More items than one stretch.
    let (from, to) = (points(&mut dice, 5000), points(&mut dice, 5000));
    let pose = [0.3_f64, -0.2, 0.7];
    let cpu = Cpu::new();
    let columns = (One(pose), &from, &to);
    let sums = cpu
        .squares(function(residual), columns, &[0], Robust::Squares)
        .unwrap();
    let (residuals, jacobians) = cpu.aligned(function(residual).jacobian(), columns).unwrap();
    let (mut jtj, mut jtr, mut cost) = ([0.0; 9], [0.0; 3], 0.0);
    for (r, by) in residuals.iter().zip(&jacobians) {
        cost += 0.5 * r.length_squared();
        for (r, by) in [(r.x, by.x.0), (r.y, by.y.0)] {
            let by = by.scalars();
            for i in 0..3 {
                jtr[i] += by[i] * r;
                for j in 0..3 {
                    jtj[3 * i + j] += by[i] * by[j];
                }
            }
        }
    }
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * (1.0 + b.abs());
    assert!(near(sums.cost, cost));
    assert!(sums.jtr.iter().zip(jtr).all(|(&a, b)| near(a, b)));
    assert!(sums.jtj.iter().zip(jtj).all(|(&a, b)| near(a, b)));
    let narrow: Vec<Vec2<f32>> = from.iter().map(|x| x.cast()).collect();
    let aims: Vec<Vec2<f32>> = to.iter().map(|x| x.cast()).collect();
    let single = cpu.squares(
        function(residual),
        (One(pose.map(|x| x as f32)), &narrow, &aims),
        &[0],
        Robust::Squares,
    );
    assert!((single.unwrap().cost / cost - 1.0).abs() < 1e-5);
}

/// A step of Gauss and Newton on the exact problem finds its solution; robust losses keep it in spite of outliers.
#[test]
fn steps_lead_to_the_pose() {
    let mut dice = Dice(6);
    let from = points(&mut dice, 60);
    let truth = [0.4_f64, -0.3, 0.5];
    let mut to: Vec<_> = from
        .iter()
        .map(|&point| residual(truth, point, Vec2::zero()))
        .collect();
    for outlier in &mut to[..6] {
        *outlier += Vec2::new(30.0, -20.0);
    }
    let cpu = Cpu::new();
    let fit = |loss: Robust| {
        let mut pose = [0.0_f64; 3];
        for _ in 0..60 {
            let sums = cpu
                .squares(function(residual), (One(pose), &from, &to), &[0], loss)
                .unwrap();
            let step = solved(&sums.jtj, &sums.jtr);
            pose = pose.plus(step.scaled_by(-1.0));
        }
        let error = pose.plus(truth.scaled_by(-1.0)).scalars();
        error.iter().map(|x| x.abs()).fold(0.0, f64::max)
    };
    assert!(fit(Robust::Squares) > 0.5);
    assert!(fit(Robust::Huber(0.01)) < 0.02);
    assert!(fit(Robust::Cauchy(0.1)) < 1e-3);
}

/// Solves three equations by elimination; the matrix is positive definite.
fn solved(a: &[f64], b: &[f64]) -> [f64; 3] {
    let mut rows = [0, 1, 2].map(|i| [a[3 * i], a[3 * i + 1], a[3 * i + 2], b[i]]);
    for k in 0..3 {
        for i in 0..3 {
            if i != k {
                let share = rows[i][k] / rows[k][k];
                let pivot = rows[k];
                for (x, p) in rows[i].iter_mut().zip(pivot) {
                    *x -= share * p;
                }
            }
        }
    }
    [0, 1, 2].map(|i| rows[i][3] / rows[i][i])
}

/// `jtr` is the gradient of the cost, for every loss and below and above its threshold.
#[test]
fn the_vector_is_the_gradient_of_the_cost() {
    let mut dice = Dice(9);
    let all = points(&mut dice, 200);
    let car = Obb2::new(0.1, 0.2, 2.0, 1.0, 0.3);
    let cpu = Cpu::new();
    for loss in [Robust::Squares, Robust::Huber(0.5), Robust::Cauchy(0.5)] {
        let at = |car: Obb2<f64>| {
            cpu.squares(function(beyond), (&all, One(car)), &[1], loss)
                .unwrap()
        };
        let sums = at(car);
        for (k, &slope) in sums.jtr.iter().enumerate() {
            let moved = |by: f64| {
                let mut numbers = car.scalars();
                numbers[k] += by;
                at(Obb2::load(&numbers)).cost
            };
            let difference = (moved(1e-6) - moved(-1e-6)) / 2e-6;
            assert!(
                (difference - slope).abs() < 1e-6 * (1.0 + slope.abs()),
                "{loss:?} {k}"
            );
        }
        // Two chosen arguments, in the order of the list.
        let both = cpu
            .squares(function(beyond), (One(all[0]), One(car)), &[1, 0], loss)
            .unwrap();
        let alone = cpu
            .squares(function(beyond), (One(all[0]), One(car)), &[0], loss)
            .unwrap();
        assert_eq!((both.jtr.len(), &both.jtr[5..]), (7, &alone.jtr[..]));
        assert_eq!(both.jtj[5 * 7 + 6], alone.jtj[1]);
    }
}

#[test]
fn bad_arguments_are_named() {
    let cpu = Cpu::new();
    let (some, car) = ([Vec2::new(1.0, 2.0); 2], Obb2::new(0.0, 0.0, 1.0, 1.0, 0.0));
    let run = |by: &[usize], loss| cpu.squares(function(beyond), (&some, One(car)), by, loss);
    let refused = run(&[0], Robust::Squares).unwrap_err();
    let expected = Error::Length {
        argument: Argument::A,
        expected: 1,
        found: 2,
    };
    assert_eq!(refused, expected);
    assert!(matches!(
        run(&[2], Robust::Squares),
        Err(Error::Arguments { .. })
    ));
    for loss in [
        Robust::Huber(0.0),
        Robust::Huber(f64::NAN),
        Robust::Cauchy(f64::INFINITY),
    ] {
        assert!(
            matches!(run(&[1], loss), Err(Error::Invalid { .. })),
            "{loss:?}"
        );
    }
    let none = run(&[], Robust::Squares).unwrap();
    assert_eq!((none.jtj.len(), none.jtr.len()), (0, 0));
    let empty: &[Vec2<f64>] = &[];
    let sums = cpu
        .squares(function(beyond), (empty, One(car)), &[1], Robust::Squares)
        .unwrap();
    assert_eq!((sums.cost, sums.jtr), (0.0, vec![0.0; 5]));
}
