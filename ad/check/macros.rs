//! Macros that write a check in one line: [`assert_gradient!`](crate::assert_gradient),
//! [`generic_check!`](crate::generic_check).

/// Checks a gradient at points, or panics with the numbers. For use in tests; see the
/// [module](crate::ad::check) for examples.
///
/// * `assert_gradient!(value, gradient, at point, …)` takes closures;
/// * `assert_gradient!(generic function, gradient, at point, …)` takes a function generic over the
///   scalar, which is then also run on duals, ours and num-dual's, traced, and at points of `f32` in double precision;
/// * `assert_gradient!(program &program, at point, …)` takes a recorded [`Program`](crate::Program), which
///   has its derivatives.
///
/// Behind the points, after semicolons, any method of [`Check`](crate::ad::check::Check) with one argument:
///
/// ```
/// use geograd::assert_gradient;
/// assert_gradient!(|x: f64| x.sqrt(), |x: f64| 0.5 / x.sqrt(), at 2.0, 1e-3; inside |x| *x > 0.0; scales |x| 0.5 * x);
/// ```
#[macro_export]
macro_rules! assert_gradient {
    (generic $value:path, $gradient:expr, at $($point:expr),+ $(; $option:ident $argument:expr)* $(,)?) => {
        $crate::generic_check!($value, at $($point),+)
            .gradient($gradient)
            $(.$option($argument))*
            .assert()
    };
    (program $program:expr, at $($point:expr),+ $(; $option:ident $argument:expr)* $(,)?) => {
        $crate::ad::check::Check::among([$($point),+])
            .program($program)
            $(.$option($argument))*
            .assert()
    };
    ($value:expr, $gradient:expr, at $($point:expr),+ $(; $option:ident $argument:expr)* $(,)?) => {
        $crate::ad::check::Check::among([$($point),+])
            .value($value)
            .gradient($gradient)
            $(.$option($argument))*
            .assert()
    };
}

/// A [`Check`](crate::ad::check::Check) of a function generic over the scalar, named once: it is run on plain
/// numbers, on duals (ours and num-dual's), on duals of duals, traced, and at points of `f32` in double precision.
///
/// ```
/// use geograd::{Scalar, generic_check};
/// fn norm<S: Scalar>([x, y]: [S; 2]) -> S {
///     x.hypot(y)
/// }
/// generic_check!(norm, at [3.0, 4.0], [0.0, 0.0])
///     .gradient(|[x, y]| if x == 0.0 && y == 0.0 { [0.0; 2] } else { [x / x.hypot(y), y / x.hypot(y)] })
///     .assert();
/// ```
#[macro_export]
macro_rules! generic_check {
    ($value:path, at $($point:expr),+ $(,)?) => {
        $crate::ad::check::Check::among([$($point),+])
            .value($value)
            .dual($value)
            .num_dual($value)
            .traced($value)
            .wide($value)
            .second_order($value)
    };
}
