//! Points without weight have no part in an alignment, the first one among them.
use geograd::procrustes::{procrustes, procrustes_rigid};
use geograd::{Scalar, Vec3};

/// Points that coincide, after one without weight: no rotation, scale 1, and the places of both means.
fn coincident<S: Scalar<Mask = bool> + Into<f64> + Copy>() {
    let at = |[x, y, z]: [f64; 3]| Vec3::new(S::lit(x), S::lit(y), S::lit(z));
    let tenths = |k: i32| f64::from(k % 7 - 3) / 10.0;
    for k in 0..300 {
        let [first, point] =
            [k, k / 3 + 1].map(|k| at([tenths(k), tenths(k / 7), tenths(k / 49 + 2)]));
        let targets = [[5.0, 6.0, 7.0], [8.0, 9.0, 1.0], [8.0, 9.0, 1.0]].map(at);
        for weights in [[0.0, 0.1, 0.2], [0.0, 1.9648603, 0.0], [0.0, 0.7, 1e-3]] {
            let weights = weights.map(S::lit);
            let points = [first, point, point];
            let free = procrustes(&points, &targets, &weights).unwrap();
            let rigid = procrustes_rigid(&points, &targets, &weights).unwrap();
            let scale: f64 = free.scale.into();
            assert_eq!(scale, 1.0, "{k}");
            for turn in [free.pose.rotation, rigid.rotation] {
                let turn: [f64; 4] = [turn.w, turn.x, turn.y, turn.z].map(Into::into);
                assert_eq!(turn.map(f64::abs), [1.0, 0.0, 0.0, 0.0], "{k}");
            }
        }
    }
}

#[test]
fn coincident_points_after_one_without_weight_have_no_rotation_and_scale_one() {
    coincident::<f64>();
    coincident::<f32>();
}
