//! A box inside another one: exactly its own area or volume, which only its own sizes change, however large the
//! other one is, in either format and either order.
use geograd::ad::adjoint::overlap::intersection_area_obb2_vjp;
use geograd::ad::adjoint::overlap_quad::intersection_area_quads_vjp;
use geograd::ad::adjoint::overlap3::intersection_volume_obb3_vjp;
use geograd::ad::adjoint::upright::intersection_volume_yaw_vjp;
use geograd::{Fixed, Obb2, Obb3, Rotation3, Scalar, Vec3, YawBox3};
use proptest::prelude::*;

/// A box about as large as one near the middle of a giant of 10 to 10⁷ times its size.
#[derive(Clone, Copy, Debug)]
struct Nested {
    small: [f64; 3],
    giant: [f64; 3],
    center: [f64; 3],
    /// The headings of both.
    headings: [f64; 2],
    quaternions: [[f64; 4]; 2],
}

fn nested() -> impl Strategy<Value = Nested> {
    let small = prop::array::uniform3(0.2..1.0_f64);
    // Its sides are so different that lines of the giant's edges meet those of the small one far away.
    let giant = prop::array::uniform3(0.0..1.0_f64);
    let center = prop::array::uniform3(-0.15..0.15_f64);
    let headings = prop::array::uniform2(-4.0..4.0_f64);
    let quaternions = prop::array::uniform2(prop::array::uniform4(0.1..1.0_f64));
    let all = (small, giant, 1.0..7.0_f64, center, headings, quaternions);
    all.prop_map(|(small, giant, power, center, headings, quaternions)| {
        let giant = giant.map(|more| 10.0_f64.powf(power + more));
        let least = giant.into_iter().fold(f64::INFINITY, f64::min);
        Nested {
            small,
            giant,
            center: center.map(|x| x * least),
            headings,
            quaternions,
        }
    })
}

/// The small one and the giant: centre and size.
type Boxes<S> = [([S; 3], [S; 3]); 2];

impl Nested {
    fn boxes<S: Scalar>(&self) -> Boxes<S> {
        let lit = |x: [f64; 3]| x.map(S::lit);
        [
            (lit(self.center), lit(self.small)),
            ([S::zero(); 3], lit(self.giant)),
        ]
    }
    fn flat<S: Scalar>(&self) -> [Obb2<S>; 2] {
        let mut heading = self.headings.map(S::lit).into_iter();
        self.boxes()
            .map(|(at, size)| Obb2::new(at[0], at[1], size[0], size[1], heading.next().unwrap()))
    }
    fn upright<S: Scalar>(&self) -> [YawBox3<S>; 2] {
        let mut heading = self.headings.map(S::lit).into_iter();
        self.boxes().map(|([x, y, z], [dx, dy, dz])| {
            let (center, size) = (Vec3::new(x, y, z), Vec3::new(dx, dy, dz));
            YawBox3::new(center, size, heading.next().unwrap())
        })
    }
    fn turned<S: Scalar>(&self) -> [Obb3<S>; 2] {
        let mut turn = self.quaternions.map(|q| q.map(S::lit)).into_iter();
        self.boxes().map(|([x, y, z], [dx, dy, dz])| {
            let [qw, qx, qy, qz] = turn.next().unwrap();
            let (center, size) = (Vec3::new(x, y, z), Vec3::new(dx, dy, dz));
            Obb3::new(center, size, Rotation3::new(qw, qx, qy, qz))
        })
    }
}

fn close(got: f64, exact: f64, epsilon: f64) -> bool {
    (got - exact).abs() <= 16.0 * epsilon * exact.abs()
}

fn numbers<X: Fixed<Scalar: Into<f64>>>(x: X) -> Vec<f64> {
    x.scalars().into_iter().map(Into::into).collect()
}

/// Asserts that of a pair only the sizes of the small one change what is shared, which is their product. Its
/// numbers are its centre, its size and how it is turned.
fn only_its_own<X>(measure: f64, small: X, small_bar: X, giant_bar: X, axes: usize)
where
    X: Fixed<Scalar: Scalar + Into<f64>>,
{
    let epsilon = X::Scalar::format().epsilon();
    let (shape, bar) = (numbers(small), numbers(small_bar));
    let sizes = axes..2 * axes;
    let product: f64 = shape[sizes.clone()].iter().product();
    assert!(close(measure, product, epsilon), "{measure}, not {product}");
    for (i, &derivative) in bar.iter().enumerate() {
        let exact = if sizes.contains(&i) {
            product / shape[i]
        } else {
            0.0
        };
        // A turn is the difference of moments, which are rounded.
        let rounded = if i < 2 * axes {
            0.0
        } else {
            4.0 * epsilon * product
        };
        let right = close(derivative, exact, epsilon) || derivative.abs() <= rounded;
        assert!(right, "derivative {i}: {derivative}, not {exact}");
    }
    let giant_bar = numbers(giant_bar);
    let (straight, turn) = giant_bar.split_at(2 * axes);
    assert!(straight.iter().all(|&derivative| derivative == 0.0));
    let rounded = 4.0 * epsilon * product;
    assert!(
        turn.iter().all(|derivative| derivative.abs() <= rounded),
        "{turn:?}"
    );
}

/// Both orders, in a format.
macro_rules! either_way {
    ($shapes:expr, $vjp:path, $axes:expr, $S:ty) => {{
        let [small, giant] = $shapes;
        let one: $S = 1.0;
        let (value, (by_small, by_giant)) = $vjp(small, giant, one);
        only_its_own(value.into(), small, by_small, by_giant, $axes);
        let (value, (by_giant, by_small)) = $vjp(giant, small, one);
        only_its_own(value.into(), small, by_small, by_giant, $axes);
    }};
}

/// The adjoint in the plane has no value: with it.
fn intersection_area_obb2_grad<S: Scalar<Mask = bool>>(
    a: Obb2<S>,
    b: Obb2<S>,
    out_bar: S,
) -> (S, (Obb2<S>, Obb2<S>)) {
    let value = geograd::overlap::intersection_area_obb2(a, b);
    (value, intersection_area_obb2_vjp(a, b, out_bar))
}

proptest! {
    #[test]
    fn in_the_plane(pair in nested()) {
        either_way!(pair.flat::<f64>(), intersection_area_obb2_grad, 2, f64);
        either_way!(pair.flat::<f32>(), intersection_area_obb2_grad, 2, f32);
    }

    #[test]
    fn upright(pair in nested()) {
        either_way!(pair.upright::<f64>(), intersection_volume_yaw_vjp, 3, f64);
        either_way!(pair.upright::<f32>(), intersection_volume_yaw_vjp, 3, f32);
    }

    #[test]
    fn turned_in_any_way(pair in nested()) {
        either_way!(pair.turned::<f64>(), intersection_volume_obb3_vjp, 3, f64);
        either_way!(pair.turned::<f32>(), intersection_volume_obb3_vjp, 3, f32);
    }

    #[test]
    fn quadrilaterals(pair in nested()) {
        let [small, giant] = pair.flat::<f32>().map(|x| x.corners());
        let wide = small.map(|v| [f64::from(v.x), f64::from(v.y)]);
        // The corners are those of the rounded box only to a rounding of where it is.
        let (first, mut twice) = (wide[0], 0.0);
        for (p, q) in [(1, 2), (2, 3)] {
            let (p, q) = (wide[p], wide[q]);
            twice += (p[0] - first[0]) * (q[1] - first[1]) - (p[1] - first[1]) * (q[0] - first[0]);
        }
        for (a, b, small_at) in [(small, giant, 0), (giant, small, 1)] {
            let (area, bars) = intersection_area_quads_vjp(a, b, 1.0_f32);
            prop_assert!(close(area.into(), twice / 2.0, f32::EPSILON.into()), "{area}, not {}", twice / 2.0);
            let other = if small_at == 0 { bars.1 } else { bars.0 };
            prop_assert!(numbers(other).iter().all(|&derivative| derivative == 0.0));
        }
    }
}
