//! The drivers against num-dual's own, on functions of shapes.
use geograd::{Obb2, Pack, Scalar, Vec2, ad, ring};
use num_dual::{Dual64, HyperDual64};

type Pair<S> = (Obb2<S>, Obb2<S>);

fn pair() -> Pair<f64> {
    (
        Obb2::new(0.3, -0.2, 2.0, 1.5, 0.4),
        Obb2::new(0.9, 0.1, 1.7, 2.2, -0.8),
    )
}

fn overlap<S: Scalar>((a, b): Pair<S>) -> S {
    a.iou(b) * (a.center - b.center).length_squared()
}

/// The pair with its scalars replaced by duals made from index and value.
fn seeded<D: Clone>(make: impl Fn(usize, f64) -> D) -> Pair<D> {
    let mut i = 0;
    pair().remake(&mut |&x| {
        i += 1;
        make(i - 1, x)
    })
}

#[test]
fn gradient_hessian_and_products_agree_with_num_dual() {
    let (value, gradient, hessian) = ad::hessian(overlap, pair());
    assert_eq!(value, overlap(pair()));
    let (same, first) = ad::gradient(overlap, pair());
    assert_eq!(same, value);
    let rows: Vec<Vec<f64>> = hessian.scalars().iter().map(Pack::scalars).collect();
    assert_eq!(rows.len(), 10);
    for (i, row) in rows.iter().enumerate() {
        let dual = overlap(seeded(|k, x| Dual64::new(x, f64::from(k == i))));
        assert!((gradient.scalars()[i] - dual.eps).abs() < 1e-13);
        assert!((first.scalars()[i] - dual.eps).abs() < 1e-13);
        for (j, &entry) in row.iter().enumerate() {
            let hyper = overlap(seeded(|k, x| {
                HyperDual64::new(x, f64::from(k == i), f64::from(k == j), 0.0)
            }));
            assert!((entry - hyper.eps1eps2).abs() < 1e-12, "{i} {j}");
            assert_eq!(entry, rows[j][i]);
        }
    }
    let direction = seeded(|i, _| 0.1 * i as f64 - 0.4);
    let (_, again, product) = ad::hvp(overlap, pair(), direction);
    let (_, derivative) = ad::jvp(overlap, pair(), direction);
    let along = direction.scalars();
    let dot = |row: &[f64]| row.iter().zip(&along).map(|(x, y)| x * y).sum::<f64>();
    assert!((derivative - dot(&first.scalars())).abs() < 1e-13);
    for (i, row) in rows.iter().enumerate() {
        assert!((again.scalars()[i] - first.scalars()[i]).abs() < 1e-13);
        assert!((product.scalars()[i] - dot(row)).abs() < 1e-12);
    }
    assert_eq!(ad::value(overlap, pair()), value);
}

/// Run-time sizes, more inputs than one pass carries, several outputs.
#[test]
fn jacobian_of_a_long_ring() {
    let circle: Vec<Vec2<f64>> = (0..20)
        .map(|i| {
            Vec2::new(
                (0.3 * f64::from(i)).cos() * 2.0,
                (0.31 * f64::from(i)).sin(),
            )
        })
        .collect();
    let (value, rows) = ad::jacobian(|v: Vec<_>| ring::centroid(&v), circle.clone());
    assert_eq!(value, ring::centroid(&circle));
    for i in 0..20 {
        for axis in 0..2 {
            let seeded: Vec<Vec2<Dual64>> = circle
                .iter()
                .enumerate()
                .map(|(k, v)| {
                    let e = |on: bool| f64::from(on && k == i);
                    Vec2::new(
                        Dual64::new(v.x, e(axis == 0)),
                        Dual64::new(v.y, e(axis == 1)),
                    )
                })
                .collect();
            let dual = ring::centroid(&seeded);
            assert!((rows.x[i].scalars()[axis] - dual.x.eps).abs() < 1e-13);
            assert!((rows.y[i].scalars()[axis] - dual.y.eps).abs() < 1e-13);
        }
    }
    let (none, empty) = ad::gradient(
        |v: Vec<Vec2<_>>| ring::perimeter(&v),
        Vec::<Vec2<f64>>::new(),
    );
    assert_eq!((none, empty.len()), (0.0, 0));
}

/// A second derivative through the hand-written adjoint: it is generic too.
#[test]
fn the_adjoint_of_duals_gives_hessian_columns() {
    let (_, _, hessian) = ad::hessian(|(a, b): Pair<_>| a.iou(b), pair());
    let rows: Vec<Vec<f64>> = hessian.scalars().iter().map(Pack::scalars).collect();
    assert_eq!(rows.len(), 10);
    for (j, row) in rows.iter().enumerate() {
        let (a, b) = seeded(|k, x| Dual64::new(x, f64::from(k == j)));
        let bars = ad::adjoint::overlap::iou_obb2_vjp(a, b, Dual64::from_re(1.0));
        // The Hessian is symmetric: its column is its row.
        for (i, (bar, entry)) in bars.scalars().iter().zip(row).enumerate() {
            assert!((bar.eps - entry).abs() < 1e-12, "{i} {j}");
        }
    }
}
