//! Derivatives of any generic function of shapes by dual numbers, seeded by the library.
//!
//! Every driver takes the function and the point, and returns shapes. The function is generic over the scalar, or a
//! closure over generic functions: it is called with shapes over [`Jet`].
//!
//! | driver | result |
//! | --- | --- |
//! | [`value`] | the value |
//! | [`jvp`] | value, and derivative along a direction |
//! | [`gradient`] | value of a scalar function, and its gradient as a shape |
//! | [`jacobian`] | value, and one gradient per output number |
//! | [`hessian`] | value, gradient, and one gradient of every derivative |
//! | [`hvp`] | value, gradient, and the Hessian times a direction |
use crate::{Jet, Pack, Scalar};

/// Directions carried at once: a pair of rotated boxes has ten numbers, a point two; with twelve
/// derivatives one pass serves the first and three registers hold them.
const CHUNK: usize = 12;

/// The number type on which drivers call a function for first derivatives.
pub type First<S> = Jet<S, CHUNK>;

/// Directions carried at once in each of both orders.
const CHUNK2: usize = 5;

/// The number type on which drivers call a function for second derivatives.
pub type Second<S> = Jet<Jet<S, CHUNK2>, CHUNK2>;

/// Returns the value of a function of shapes.
pub fn value<X: Pack, Y>(f: impl Fn(X) -> Y, x: X) -> Y {
    f(x)
}

/// Returns a number without derivative as a jet.
#[inline]
fn constant<S: Scalar, const N: usize>(value: S) -> Jet<S, N> {
    Jet {
        value,
        derivative: [S::zero(); N],
    }
}

/// Returns the value of a function of shapes and its derivative along a direction, by one evaluation.
///
/// ```
/// use geograd::{ad, Obb2, Vec2};
/// let square = Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0);
/// let turning = Obb2::new(0.0, 0.0, 0.0, 0.0, 1.0);
/// let corner = |b: Obb2<_>| b.corners()[2];
/// let (at, moving) = ad::jvp(corner, square, turning);
/// assert_eq!((at, moving), (Vec2::new(1.0, 1.0), Vec2::new(-1.0, 1.0)));
/// ```
pub fn jvp<S, X, Y>(
    f: impl FnOnce(X::With<Jet<S, 1>>) -> Y,
    x: X,
    direction: X,
) -> (Y::With<S>, Y::With<S>)
where
    S: Scalar,
    X: Pack<Scalar = S>,
    Y: Pack<Scalar = Jet<S, 1>>,
{
    let along = direction.scalars();
    let mut i = 0;
    let y = f(x.remake(&mut |&value| {
        i += 1;
        Jet {
            value,
            derivative: [along[i - 1]],
        }
    }));
    (
        y.remake(&mut |jet| jet.value),
        y.remake(&mut |jet| jet.derivative[0]),
    )
}

/// Returns the value and the gradient of a function of shapes with one number as result. The gradient is a shape like
/// the input.
///
/// ```
/// use geograd::{ad, Obb2};
/// let a = Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0);
/// let b = Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0);
/// let (iou, (da, db)) = ad::gradient(|(a, b)| Obb2::iou(a, b), (a, b));
/// assert_eq!(iou, 1.0 / 3.0);
/// assert!((da.center.x - 4.0_f64 / 9.0).abs() < 1e-15 && da.center.x == -db.center.x);
/// ```
pub fn gradient<S, X>(f: impl Fn(X::With<First<S>>) -> First<S>, x: X) -> (S, X)
where
    S: Scalar,
    X: Pack<Scalar = S>,
{
    let (value, derivatives) = derivatives(|x| vec![f(x)], &x);
    (value[0], x.refill(&derivatives[0]))
}

/// Returns the value and the Jacobian of a function of shapes: the result's shape with a gradient in place of every
/// number.
///
/// ```
/// use geograd::{ad, ring, Vec2};
/// let triangle = vec![Vec2::new(0.0, 0.0), Vec2::new(3.0, 0.0), Vec2::new(0.0, 3.0)];
/// let (at, derivatives) = ad::jacobian(|v: Vec<_>| ring::centroid(&v), triangle);
/// assert_eq!(at, Vec2::new(1.0, 1.0));
/// assert!((derivatives.x[0].x - 1.0_f64 / 3.0).abs() < 1e-15); // d centroid.x / d vertex 0 .x
/// ```
pub fn jacobian<S, X, Y>(f: impl Fn(X::With<First<S>>) -> Y, x: X) -> (Y::With<S>, Y::With<X>)
where
    S: Scalar,
    X: Pack<Scalar = S>,
    Y: Pack<Scalar = First<S>>,
{
    let mut shape = None;
    let shape_of = std::cell::RefCell::new(&mut shape);
    let (values, derivatives) = derivatives(
        |x| {
            let y = f(x);
            let parts = y.scalars();
            **shape_of.borrow_mut() = Some(y);
            parts
        },
        &x,
    );
    let y = shape.expect("the function was called at least once");
    let mut i = 0;
    let value = y.remake(&mut |_| {
        i += 1;
        values[i - 1]
    });
    let mut i = 0;
    let rows = y.remake(&mut |_| {
        i += 1;
        x.refill(&derivatives[i - 1])
    });
    (value, rows)
}

/// Returns values and derivatives of a list-valued function, by as many passes as it takes.
fn derivatives<S: Scalar, X: Pack<Scalar = S>>(
    f: impl Fn(X::With<First<S>>) -> Vec<First<S>>,
    x: &X,
) -> (Vec<S>, Vec<Vec<S>>) {
    let n = x.count();
    let (mut values, mut rows) = (Vec::new(), Vec::new());
    let mut start = 0;
    // At least one pass, so that a function of nothing has a value.
    while start == 0 || start < n {
        let mut i = start.wrapping_neg();
        let y = f(x.remake(&mut |&value| {
            let jet = Jet::variable(value, i);
            i = i.wrapping_add(1);
            jet
        }));
        if start == 0 {
            values = y.iter().map(|jet| jet.value).collect();
            rows = vec![vec![S::zero(); n]; y.len()];
        }
        for (row, jet) in rows.iter_mut().zip(&y) {
            for (slot, &derivative) in row[start..].iter_mut().zip(&jet.derivative) {
                *slot = derivative;
            }
        }
        start += CHUNK;
    }
    (values, rows)
}

/// Returns the value, gradient and Hessian of a function of shapes with one number as result. In place of every number
/// of the input, the Hessian has the gradient of the derivative with respect to it.
///
/// ```
/// use geograd::{ad, Scalar, Vec2};
/// let (value, gradient, hessian) = ad::hessian(|v: Vec2<_>| v.x * v.x * v.y, Vec2::new(3.0, 2.0));
/// assert_eq!((value, gradient), (18.0, Vec2::new(12.0, 9.0)));
/// assert_eq!((hessian.x, hessian.y), (Vec2::new(4.0, 6.0), Vec2::new(6.0, 0.0)));
/// ```
pub fn hessian<S, X>(f: impl Fn(X::With<Second<S>>) -> Second<S>, x: X) -> (S, X, X::With<X>)
where
    S: Scalar,
    X: Pack<Scalar = S>,
{
    let n = x.count();
    let (mut value, mut gradient) = (S::zero(), vec![S::zero(); n]);
    let mut rows = vec![vec![S::zero(); n]; n];
    let mut row = 0;
    while row == 0 || row < n {
        // The Hessian is symmetric: only blocks on and right of the diagonal are computed.
        let mut column = row;
        while column == row || column < n {
            let (mut i, mut j) = (row.wrapping_neg(), column.wrapping_neg());
            let y = f(x.remake(&mut |&value| {
                let mut jet = constant(Jet::variable(value, j));
                if let Some(derivative) = jet.derivative.get_mut(i) {
                    *derivative = constant(S::one());
                }
                (i, j) = (i.wrapping_add(1), j.wrapping_add(1));
                jet
            }));
            value = y.value.value;
            for i in row..n.min(row + CHUNK2) {
                gradient[i] = y.derivative[i - row].value;
                for (j, &entry) in (column..n).zip(&y.derivative[i - row].derivative) {
                    rows[i][j] = entry;
                    rows[j][i] = entry;
                }
            }
            column += CHUNK2;
        }
        row += CHUNK2;
    }
    let mut i = 0;
    let hessian = x.remake(&mut |_| {
        i += 1;
        x.refill(&rows[i - 1])
    });
    (value, x.refill(&gradient), hessian)
}

/// The number type on which [`hvp`] calls a function.
pub type Along<S> = Jet<Jet<S, 1>, CHUNK>;

/// Returns the value, the gradient and the Hessian times a direction of a function with one number as result; the
/// Hessian is not formed.
///
/// ```
/// use geograd::{ad, Vec2};
/// let (at, along) = (Vec2::new(3.0, 2.0), Vec2::new(1.0, 0.0));
/// let (_, gradient, column) = ad::hvp(|v: Vec2<_>| v.x * v.x * v.y, at, along);
/// assert_eq!((gradient, column), (Vec2::new(12.0, 9.0), Vec2::new(4.0, 6.0)));
/// ```
pub fn hvp<S, X>(f: impl Fn(X::With<Along<S>>) -> Along<S>, x: X, direction: X) -> (S, X, X)
where
    S: Scalar,
    X: Pack<Scalar = S>,
{
    let along = direction.scalars();
    let n = x.count();
    let (mut value, mut gradient, mut product) =
        (S::zero(), vec![S::zero(); n], vec![S::zero(); n]);
    let mut start = 0;
    while start == 0 || start < n {
        let mut k = 0;
        let y = f(x.remake(&mut |&value| {
            let mut jet = constant(Jet {
                value,
                derivative: [along[k]],
            });
            if let Some(derivative) = jet.derivative.get_mut(k.wrapping_sub(start)) {
                *derivative = constant(S::one());
            }
            k += 1;
            jet
        }));
        value = y.value.value;
        for k in start..n.min(start + CHUNK) {
            gradient[k] = y.derivative[k - start].value;
            product[k] = y.derivative[k - start].derivative[0];
        }
        start += CHUNK;
    }
    (value, x.refill(&gradient), x.refill(&product))
}
