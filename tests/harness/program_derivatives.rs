//! Programs of derivatives: against forward duals, at kinks and traps, in first and second order.
#![expect(
    clippy::needless_range_loop,
    reason = "rows and columns are named by their numbers"
)]
use crate::program::{
    AreaAabb2, AreaObb2, Distance, Draw, Everything, FromCorners, Function, IofObb2, IouAabb2,
    IouObb2, Quadrilateral, functions,
};
use geograd::ad::program::{Program, Sym};
use geograd::{Jet, Scalar, Vec2};
use std::array::from_fn;

functions! {
    // The branch that is not taken has an infinite derivative at zero and none below.
    Trap 1 1 |[x]| {
        let wild = x.ln().over(x) + S::one().over(x).root();
        [S::select(x.at_most(S::zero()), S::lit(3.0) * x, wild)]
    };
    // The same with the smaller and the larger instead of a choice.
    TrapOfLeast 2 1 |[x, y]| {
        [x.least(S::one().over(y)) + y.most(x.ln()) + S::one().over(x).magnitude().most(y).least(x)]
    };
    // Choices inside choices, of which some are by the same mask, and a way round all of them.
    Choices 3 1 |[x, y, z]| {
        let (m, k) = (x.below(y), y.below(z));
        let inner = S::select(k, x.over(y), y.ln() * z);
        let outer = S::select(m, inner + S::select(m, z, x.ln()), S::select(k, z, inner) * x);
        [S::select(k, outer, inner.over(x)) + inner * S::select(m & !k, y.root(), z) + x]
    };
    Norm 2 1 |[x, y]| [x.hypot(y)];
    Angle 2 1 |[x, y]| [y.atan2(x)];
    Quadratic 2 1 |[x, y]| [S::lit(3.0) * x * x + S::lit(5.0) * x * y + S::lit(-2.0) * y * y];
    // Grafts that share a decision: half the derivative of x, the derivative of y at another value.
    Grafts 2 1 |[x, y]| {
        let share = S::select(x.equals(y), S::lit(0.5), S::one());
        [x.damp(share.primal()) * y.with_primal((x * y).primal()) + (x * y).root()]
    };
}

/// The value and derivatives on jets.
fn jets<const N: usize, const M: usize, F: Function<N, M>>(x: [f64; N]) -> [Jet<f64, N>; M] {
    F::eval(from_fn(|i| Jet::variable(x[i], i)))
}

/// Asserts that a number is another one to a tolerance, in units of `scale`, or of one where derivatives cancel. If
/// duals give NaN, any number passes.
#[track_caller]
fn near(found: f64, expected: f64, scale: f64, at: &[f64]) {
    if expected.is_nan() {
        return;
    }
    assert!(!found.is_nan(), "NaN for {expected} at {at:?}");
    let close = (found - expected).abs() <= 1e-12 * scale.max(1.0);
    assert!(
        close || found == expected,
        "{found} for {expected} at {at:?}"
    );
}

fn largest(all: impl Iterator<Item = f64>) -> f64 {
    all.fold(0.0, |a, b| a.max(b.abs()))
}

/// Rows of the Jacobian from reverse, from forward, and pulled back at once, against duals.
fn derivatives<const N: usize, const M: usize, F: Function<N, M>>(wide: bool) {
    let program = F::program::<f64>();
    let (vjp, jvp) = (program.vjp(), program.jvp());
    let mut draw = Draw(11);
    for kind in (0..3000).filter(|kind| wide || kind % 6 != 4) {
        let x = draw.input::<N>(kind);
        let rows = jets::<N, M, F>(x).map(|y| y.derivative);
        for j in 0..M {
            let scale = largest(rows[j].into_iter());
            let found = vjp.eval((x, from_fn(|i| f64::from(i == j))));
            for i in 0..N {
                near(found[i], rows[j][i], scale, &x);
            }
        }
        for i in 0..N {
            let (_, found) = jvp.eval((x, from_fn(|k| f64::from(i == k))));
            for j in 0..M {
                near(found[j], rows[j][i], largest(rows[j].into_iter()), &x);
            }
        }
        let bar: [f64; M] = from_fn(|_| draw.unit() - 0.5);
        let (found, along) = (vjp.eval((x, bar)), from_fn(|_| draw.unit() - 0.5));
        let (_, pushed) = jvp.eval((x, along));
        let terms = |i: usize| (0..M).map(move |j| bar[j] * rows[j][i]);
        let scale = largest((0..N).flat_map(terms)) * 4.0;
        for i in 0..N {
            near(found[i], terms(i).sum(), scale, &x);
        }
        for j in 0..M {
            let terms: [f64; N] = from_fn(|i| rows[j][i] * along[i]);
            near(
                pushed[j],
                terms.iter().sum(),
                largest(rows[j].into_iter()) * 4.0,
                &x,
            );
        }
    }
}

#[test]
fn derivatives_are_those_of_forward_duals() {
    derivatives::<3, 2, Everything>(true);
    derivatives::<6, 1, Distance>(true);
    derivatives::<8, 2, Quadrilateral>(false);
    derivatives::<8, 5, FromCorners>(false);
    derivatives::<8, 1, IouAabb2>(false);
    derivatives::<8, 1, AreaAabb2>(false);
    // Corners a million times further apart one way than the other, and boxes turned by thousands of
    // turns: derivatives of neither are
    // known to 10⁻¹².
    derivatives::<10, 1, IouObb2>(false);
    derivatives::<10, 1, AreaObb2>(false);
    derivatives::<10, 1, IofObb2>(false);
}

#[test]
fn infinite_derivatives_of_what_was_not_taken_leave_no_trace() {
    let trap = Trap::program::<f64>();
    let derivative = |x: f64| trap.vjp().eval(([x], [1.0]))[0];
    assert_eq!(
        (derivative(0.0), derivative(-0.0), derivative(-1.0)),
        (3.0, 3.0, 3.0)
    );
    assert!((derivative(1.0) - 0.5).abs() < 1e-15);
    derivatives::<1, 1, Trap>(true);
    derivatives::<2, 1, TrapOfLeast>(true);
    derivatives::<3, 1, Choices>(true);
    derivatives::<2, 1, Norm>(true);
    derivatives::<2, 1, Angle>(true);
    derivatives::<2, 1, Grafts>(true);
}

/// The Hessian against jets of jets.
fn curvature<const N: usize, F: Function<N, 1>>(points: &[[f64; N]]) {
    let program = Program::trace(|x: [Sym<f64>; N]| F::eval(x)[0]).expect("a straight line");
    let (hessian, hvp) = (program.hessian::<N>(), program.hvp());
    for &x in points {
        let [y] = F::eval(from_fn(|i| {
            Jet::<_, N>::variable(Jet::<_, N>::variable(x[i], i), i)
        }));
        let scale = largest(y.derivative.iter().flat_map(|row| row.derivative)) * 100.0;
        let found = hessian.eval(x);
        let along: [f64; N] = from_fn(|i| [0.7, -0.4, 0.1][i % 3]);
        let times = hvp.eval((x, along));
        for i in 0..N {
            for k in 0..N {
                near(found[i][k], y.derivative[i].derivative[k], scale, &x);
            }
            let product = (0..N)
                .map(|k| y.derivative[i].derivative[k] * along[k])
                .sum();
            near(times[i], product, scale * 4.0, &x);
        }
    }
}

#[test]
fn second_derivatives_are_those_of_jets_of_jets() {
    let mut draw = Draw(5);
    let mut points = |count: usize| -> Vec<[f64; 10]> {
        (0..count)
            .map(|kind| draw.input(kind))
            .filter(|x| x.iter().all(|x| x.abs() < 9.0))
            .collect()
    };
    fn first<const N: usize>(points: &[[f64; 10]]) -> Vec<[f64; N]> {
        points.iter().map(|x| from_fn(|i| x[i])).collect()
    }
    let some = points(300);
    curvature::<2, Quadratic>(&first(&some));
    curvature::<6, Distance>(&first(&some));
    curvature::<8, AreaAabb2>(&first(&some));
    curvature::<8, IouAabb2>(&first(&some));
    curvature::<3, Choices>(&first(&some));
    curvature::<2, Angle>(&first(&some));
    curvature::<2, Norm>(&first(&some));
    curvature::<10, IouObb2>(&some[..100]);
    curvature::<2, Norm>(&[
        [0.0, 0.0],
        [0.0, 1.0],
        [3.0, 4.0],
        [1e-30, 1e-30],
        [1e30, 1e20],
    ]);
    curvature::<2, Angle>(&[
        [0.0, 0.0],
        [0.0, 1.0],
        [-1.0, 0.0],
        [1e-30, 1e-30],
        [1e30, 1e20],
    ]);
    curvature::<1, Trap>(&[[0.0], [-0.0], [-1.0], [1.0], [2.0]]);
    curvature::<2, TrapOfLeast>(&[[1.0, 0.0], [0.0, 0.0], [0.0, 2.0], [0.5, 2.0], [2.0, 0.5]]);
}

#[test]
fn hessians_of_known_functions() {
    let program = Program::trace(|v: Vec2<Sym<f64>>| Quadratic::eval([v.x, v.y])[0]).unwrap();
    let [by_x, by_y] = program.hessian::<2>().eval(Vec2::new(0.3, -7.0));
    assert_eq!((by_x, by_y), (Vec2::new(6.0, 5.0), Vec2::new(5.0, -4.0)));
}

#[test]
fn an_adjoint_by_hand_comes_along_into_a_larger_program() {
    // Wrong on purpose, so that one sees whose derivatives they are.
    let square = Program::trace(|x: Sym<f64>| x * x).unwrap();
    let odd = square
        .with_adjoint(|x: Sym<f64>| x * Sym::lit(7.0))
        .unwrap();
    assert_eq!(odd.value_grad().eval(3.0), (9.0, 21.0));
    let larger = Program::trace(|x: Vec2<Sym<f64>>| odd.eval_within(x.x + x.y) * x.y).unwrap();
    let (value, derivatives) = larger.value_grad().eval(Vec2::new(1.0, 2.0));
    assert_eq!((value, derivatives), (18.0, Vec2::new(42.0, 42.0 + 9.0)));
    assert_eq!(
        larger
            .jvp()
            .eval((Vec2::new(1.0, 2.0), Vec2::new(1.0, 0.0)))
            .1,
        42.0
    );
    // ∂²/∂x² = y · 7, from the derivatives of what was written by hand.
    assert_eq!(larger.hessian::<2>().eval(Vec2::new(1.0, 2.0))[0].x, 14.0);
}

/// A formula whose first derivative needs less than its second one: what vanishes is left out of the gradient.
#[test]
fn what_vanishes_counts_from_the_second_derivative_on() {
    fn height<S: Scalar>(v: Vec2<S>) -> S {
        let aside = (v.x - S::lit(2.0)).with_primal(S::Primal::zero());
        v.y + aside * aside * v.y.exp()
    }
    let program = Program::trace(height::<Sym<f64>>).unwrap();
    let at = Vec2::new(2.0, 0.0);
    let gradient = program.value_grad();
    assert_eq!(gradient.eval(at), (0.0, Vec2::new(0.0, 1.0)));
    let cost = gradient.cost();
    assert_eq!((cost.multiplications, cost.elementary), (0, 0));
    let [by_x, by_y]: [Vec2<f64>; 2] = program.hessian().eval(at);
    assert_eq!((by_x, by_y), (Vec2::new(2.0, 0.0), Vec2::new(0.0, 0.0)));
    assert_eq!(geograd::hvp(height, at, Vec2::new(1.0, 0.0)).2, by_x);
}
