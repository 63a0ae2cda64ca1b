//! A refused input is shrunk to a minimal one, and prints as code.
use geograd::ad::check::verdict::Reason;
use geograd::ad::check::{Check, Failure};
use geograd::{Obb2, Pack, Vec2};

fn failure(check: &Check<'_, impl Pack<Scalar = f64> + std::fmt::Debug>) -> Failure {
    let report = check.run();
    assert!(!report.passed(), "{report}");
    report.failures[0].clone()
}

/// The sum of squares, whose derivatives are wrong where a number is larger than three.
fn wrong_above_three(x: Vec<f64>) -> Vec<f64> {
    let derivative = |x: &f64| if *x > 3.0 { 2.5 * x } else { 2.0 * x };
    x.iter().map(derivative).collect()
}
fn squares(x: Vec<f64>) -> f64 {
    x.iter().map(|x| x * x).sum()
}

#[test]
fn lists_lose_what_does_not_matter() {
    for n in [2, 7, 300, 2000] {
        let mut list: Vec<f64> = (0..n).map(|i| f64::from(i % 17) / 8.0 + 0.1).collect();
        list[n as usize / 2] = 4.75;
        let failure = failure(&Check::at(list).value(squares).gradient(wrong_above_three));
        assert_eq!(failure.input, [5.0], "{n}");
        assert_eq!(failure.code, "vec![5.0]");
    }
}

#[test]
fn what_is_outside_is_passed_over() {
    let failure = failure(
        &Check::at(vec![0.5, 1.25, 4.75, 2.0, 0.25])
            .value(squares)
            .inside(|x| x.len() >= 3)
            .gradient(wrong_above_three),
    );
    assert_eq!(failure.input.len(), 3);
}

#[test]
fn a_function_that_panics_at_short_lists() {
    let value = |x: Vec<f64>| x[0] * x[1];
    let failure = failure(
        &Check::at(vec![0.5, 1.25, 4.0])
            .value(value)
            .gradient(|x| vec![x[1], -x[0], 0.0]),
    );
    // With two numbers the list of derivatives is too long, which is another reason.
    assert_eq!(
        failure.fault.reason,
        Reason::Disagree(
            geograd::ad::check::verdict::Witness::Adjoint,
            geograd::ad::check::verdict::Witness::Difference,
        )
    );
    assert_eq!(failure.input.len(), 3);
}

#[test]
fn lists_beside_and_inside_shapes() {
    // A box, a list of points and a list of lists: only what is wrong stays.
    type Input = (Obb2<f64>, Vec<Vec2<f64>>, [Vec<f64>; 2]);
    let value = |(shape, points, lists): Input| {
        shape.area() + points.iter().map(|p| p.x * p.y).sum::<f64>() + squares(lists.concat())
    };
    let failure = failure(
        &Check::at((
            Obb2::new(0.3, 0.7, 2.25, 1.5, 0.4),
            vec![Vec2::new(0.7, 0.3); 9],
            [vec![0.5, 0.25], vec![1.0, 4.75, 2.0]],
        ))
        .value(value)
        .gradient(|(shape, points, lists)| {
            (
                Obb2::new(0.0, 0.0, shape.size.y, shape.size.x, 0.0),
                points.iter().map(|p| Vec2::new(p.y, p.x)).collect(),
                lists.map(wrong_above_three),
            )
        }),
    );
    assert_eq!(failure.input.len(), 6, "{}", failure.code);
    assert_eq!(failure.input[5], 5.0);
}
