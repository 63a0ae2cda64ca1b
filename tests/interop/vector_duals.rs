//! num-dual's vector duals are scalars.
use geograd::ad::adjoint::overlap::iou_obb2_grad;
use geograd::{Obb2, Pack};
use num_dual::DualSVec64;

#[test]
fn a_gradient_by_vector_duals() {
    let at = nalgebra::SVector::from([0.0, 0.0, 2.0, 2.0, 0.1]);
    let other = Obb2::new(0.5, 0.3, 2.0, 1.0, 0.4);
    let shape = |x: &[DualSVec64<5>]| Obb2::new(x[0], x[1], x[2], x[3], x[4]);
    let constant = Pack::remake(&other, &mut |&x| DualSVec64::from_re(x));
    let (value, derivatives) = num_dual::gradient(
        |x: nalgebra::SVector<DualSVec64<5>, 5>| shape(x.as_slice()).iou(constant),
        &at,
    );
    let ours = Obb2::new(0.0, 0.0, 2.0, 2.0, 0.1);
    let (same, (a_bar, _)) = iou_obb2_grad(ours, other);
    assert_eq!(value, same);
    for (x, y) in derivatives.iter().zip(Pack::scalars(&a_bar)) {
        assert!((x - y).abs() < 1e-14);
    }
}
