//! Overlap of boxes in space, against exact volumes.
use super::oracle_solid::overlap;
use super::pairs::{FAMILIES, Random, pair, random_rotation, single};
use geograd::ad::adjoint::overlap3::iou_obb3_vjp;
use geograd::overlap3::{intersection_volume_obb3, iou_aabb3, iou_obb3, iou_yaw};
use geograd::{Aabb3, Jet, Obb3, Pack, Pose3, Rotation3, Scalar, Vec3, YawBox3, ad};

#[test]
fn the_oracle_agrees_with_counted_points() {
    let mut random = Random(3);
    for _ in 0..3 {
        let (a, b) = pair("random", &mut random);
        let [shared, volume, ..] = overlap(a, b);
        let (mut hits, n) = (0, 40);
        for k in 0..n * n * n {
            let at = |k: usize, size: f64| ((k as f64 + 0.5) / n as f64 - 0.5) * size;
            let local = Vec3::new(
                at(k % n, a.size.x),
                at(k / n % n, a.size.y),
                at(k / n / n, a.size.z),
            );
            hits += usize::from(b.contains(a.world_from_local() * local));
        }
        let counted = hits as f64 / (n * n * n) as f64;
        assert!(
            (counted - shared / volume).abs() < 0.01,
            "{counted} {}",
            shared / volume
        );
    }
}

#[test]
fn volumes_are_exact_in_double_precision() {
    if !geograd_tests::is_due("volumes_are_exact_in_double_precision") {
        return;
    }
    for family in FAMILIES {
        let (mut random, mut worst) = (Random(11), (0.0, None));
        for _ in 0..60 {
            let (a, b) = pair(family, &mut random);
            let (found, [.., exact]) = (iou_obb3(a, b), overlap(a, b));
            assert!(
                (0.0..=1.0).contains(&found),
                "{family}: {found} {a:?} {b:?}"
            );
            let error = (found - exact).abs();
            if error >= worst.0 {
                worst = (error, Some((a, b, found, exact)));
            }
        }
        if std::env::var("SHOW").is_ok() {
            println!("f64 {family:24} {:.1e}", worst.0);
        }
        let bound = if family.starts_with("thin") {
            1e-10
        } else {
            1e-12
        };
        assert!(worst.0 < bound, "{family}: {worst:?}");
    }
}

#[test]
fn volumes_are_right_in_single_precision() {
    if !geograd_tests::is_due("volumes_are_right_in_single_precision") {
        return;
    }
    for family in FAMILIES {
        let (mut random, mut worst) = (Random(12), (0.0, None));
        for _ in 0..60 {
            let (a, b) = pair(family, &mut random);
            let (a, b) = (single(a), single(b));
            let wide = |x: Obb3<f32>| {
                let v = |v: Vec3<f32>| Vec3::new(v.x.into(), v.y.into(), v.z.into());
                let q = x.rotation;
                let q = Rotation3::new(q.w.into(), q.x.into(), q.y.into(), q.z.into());
                Obb3::new(v(x.center), v(x.size), q)
            };
            let found = iou_obb3(a, b);
            assert!(
                (0.0..=1.0).contains(&found),
                "{family}: {found} {a:?} {b:?}"
            );
            let [.., exact] = overlap(wide(a), wide(b));
            let error = (f64::from(found) - exact).abs();
            if error >= worst.0 {
                worst = (error, Some((a, b, found, exact)));
            }
        }
        if std::env::var("SHOW").is_ok() {
            println!("f32 {family:24} {:.1e}", worst.0);
        }
        let bound = if family.starts_with("thin") {
            1e-4
        } else {
            2e-6
        };
        assert!(worst.0 < bound, "{family}: {worst:?}");
    }
}

#[test]
fn identical_boxes_give_exactly_one_and_no_derivative() {
    let mut random = Random(5);
    for n in 0..300 {
        let (a, _) = pair(FAMILIES[n % FAMILIES.len()], &mut random);
        if a.volume() == 0.0 {
            continue;
        }
        let q = a.rotation;
        let other = Obb3 {
            rotation: Rotation3::new(-q.w, -q.x, -q.y, -q.z),
            ..a
        };
        // The same box under other names of its axes.
        let quarter = Rotation3::new(1.0, 0.0, 0.0, 1.0);
        let size = Vec3::new(a.size.y, a.size.x, a.size.z);
        let renamed = Obb3::new(a.center, size, a.rotation * quarter);
        assert_eq!(iou_obb3(a, a), 1.0);
        assert_eq!(iou_obb3(a, other), 1.0);
        assert!((iou_obb3(a, renamed) - 1.0).abs() < 1e-11, "{a:?}");
        let (value, (grad, _)) = iou_obb3_vjp(a, other, 1.0);
        assert_eq!(value, 1.0);
        for x in numbers(grad) {
            assert_eq!(x, 0.0);
        }
    }
}

fn numbers(x: Obb3<f64>) -> [f64; 10] {
    let (c, s, q) = (x.center, x.size, x.rotation);
    [c.x, c.y, c.z, s.x, s.y, s.z, q.w, q.x, q.y, q.z]
}
fn made<S: Scalar>(x: [S; 10]) -> Obb3<S> {
    Obb3::new(
        Vec3::new(x[0], x[1], x[2]),
        Vec3::new(x[3], x[4], x[5]),
        Rotation3::new(x[6], x[7], x[8], x[9]),
    )
}

#[test]
fn derivatives_are_those_of_the_value() {
    let mut random = Random(21);
    let (mut compared, mut worst) = (0, 0.0_f64);
    for family in FAMILIES {
        for _ in 0..12 {
            let (a, b) = pair(family, &mut random);
            let (value, (by_a, by_b)) = iou_obb3_vjp(a, b, 1.0);
            assert_eq!(value, iou_obb3(a, b), "{family} {a:?} {b:?}");
            let all = [numbers(by_a), numbers(by_b)].concat();
            assert!(
                all.iter().all(|x| x.is_finite()),
                "{family} {a:?} {b:?} {all:?}"
            );
            let size = |x: Obb3<f64>| x.size.x.max(x.size.y).max(x.size.z);
            let least = |x: Obb3<f64>| x.size.x.min(x.size.y).min(x.size.z);
            let (large, small) = (size(a).max(size(b)), least(a).min(least(b)));
            let far = numbers(a)
                .into_iter()
                .take(3)
                .fold(0.0_f64, |m, x| m.max(x.abs()));
            if small < 0.02 * large || far > 1e3 * large {
                continue;
            }
            let inputs = [numbers(a), numbers(b)].concat();
            for k in 0..20 {
                let unit = if k % 10 < 6 { large } else { 1.0 };
                let at = |h: f64| {
                    let mut x = inputs.clone();
                    x[k] += h * unit;
                    let from = |n: usize| made::<f64>(std::array::from_fn(|i| x[n + i]));
                    iou_obb3(from(0), from(10))
                };
                let h = 1e-5;
                let (left, right) = ((value - at(-h)) / h, (at(h) - value) / h);
                if (left - right).abs() > 2e-3 {
                    continue; // A kink.
                }
                let (numeric, found) = ((left + right) / 2.0, all[k] * unit);
                compared += 1;
                worst = worst.max((numeric - found).abs());
                assert!(
                    (numeric - found).abs() < 1e-5 + (left - right).abs() / 2.0,
                    "{family} {k}: {numeric} {found} ({left} {right}) {a:?} {b:?}"
                );
            }
        }
    }
    if std::env::var("SHOW").is_ok() {
        println!("derivatives: {compared} compared, worst {worst:.1e}");
    }
    assert!(compared > 1000, "{compared}");
}

#[test]
fn duals_have_the_derivatives_by_hand() {
    let mut random = Random(22);
    for family in FAMILIES {
        for _ in 0..3 {
            let (a, b) = pair(family, &mut random);
            let (value, (by_a, _)) = iou_obb3_vjp(a, b, 1.0);
            let lifted: Obb3<Jet<f64, 10>> = {
                let x = numbers(a);
                made(std::array::from_fn(|i| Jet::variable(x[i], i)))
            };
            let fixed: Obb3<Jet<f64, 10>> = made(numbers(b).map(Scalar::lit));
            let dual = iou_obb3(lifted, fixed);
            assert_eq!(dual.value, value, "{family}");
            let by_a = numbers(by_a);
            let size = by_a.iter().fold(1e-9_f64, |m, x| m.max(x.abs()));
            for i in 0..10 {
                let error = (dual.derivative[i] - by_a[i]).abs();
                assert!(
                    error <= 1e-7 * size,
                    "{family} {i}: {dual:?} {by_a:?} {a:?} {b:?}"
                );
            }
        }
    }
}

#[test]
fn second_derivatives_are_those_of_the_derivatives() {
    let mut random = Random(23);
    for _ in 0..4 {
        let (a, b) = pair("random", &mut random);
        let iou = |a: Obb3<_>| iou_obb3(a, b.lift());
        let (value, gradient, hessian) = ad::hessian(iou, a);
        assert_eq!(value, iou_obb3(a, b));
        let by_hand = iou_obb3_vjp(a, b, 1.0).1.0;
        for (dual, hand) in numbers(gradient).into_iter().zip(numbers(by_hand)) {
            assert!((dual - hand).abs() < 1e-12, "{dual} {hand}");
        }
        let rows: Vec<_> = hessian.scalars().into_iter().map(numbers).collect();
        for k in 0..10 {
            let at = |h: f64| {
                let mut x = numbers(a);
                x[k] += h;
                numbers(iou_obb3_vjp(made(x), b, 1.0).1.0)
            };
            let (low, high) = (at(-1e-6), at(1e-6));
            for i in 0..10 {
                let numeric = (high[i] - low[i]) / 2e-6;
                let found = rows[k][i];
                let error = (numeric - found).abs();
                assert!(
                    error < 1e-4 * (1.0 + numeric.abs()),
                    "{i} {k}: {numeric} {found}"
                );
            }
        }
    }
}

#[test]
fn kinds_of_boxes_agree() {
    let mut random = Random(31);
    for _ in 0..400 {
        let (mut one, mut other) = (random.yaw_box(), random.yaw_box());
        let both = iou_obb3(Obb3::from(one), Obb3::from(other));
        assert!(
            (iou_yaw(one, other) - both).abs() < 1e-13,
            "{one:?} {other:?}"
        );
        (one.heading, other.heading) = (0.0, 0.0);
        let bounds = |x: YawBox3<f64>| x.bounding();
        let aligned = iou_aabb3(bounds(one), bounds(other));
        assert!((iou_yaw(one, other) - aligned).abs() < 1e-13);
        let back = |x: Aabb3<f64>| Obb3::from(x);
        assert!((iou_obb3(back(bounds(one)), back(bounds(other))) - aligned).abs() < 1e-13);
    }
    let one = random.yaw_box();
    assert_eq!(iou_yaw(one, one), 1.0);
    assert_eq!(iou_aabb3(one.bounding(), one.bounding()), 1.0);
}

#[test]
fn a_plane_that_cuts_a_box_adds_up() {
    let mut random = Random(41);
    for _ in 0..300 {
        let (a, b) = pair("random", &mut random);
        let whole = intersection_volume_obb3(a, b);
        let share = random.between(0.1, 0.9);
        let piece = |from: f64, to: f64| {
            let center =
                a.world_from_local() * Vec3::new((from + to - 1.0) / 2.0 * a.size.x, 0.0, 0.0);
            Obb3 {
                center,
                size: Vec3::new((to - from) * a.size.x, a.size.y, a.size.z),
                ..a
            }
        };
        let parts = intersection_volume_obb3(piece(0.0, share), b)
            + intersection_volume_obb3(piece(share, 1.0), b);
        assert!((whole - parts).abs() < 1e-13 * a.volume().max(b.volume()));
    }
}

#[test]
fn motion_size_and_order_do_not_matter() {
    let mut random = Random(51);
    for family in FAMILIES {
        if family.starts_with("thin") || family == "far away" || family == "identical" {
            continue;
        }
        for _ in 0..30 {
            let (a, b) = pair(family, &mut random);
            let value = iou_obb3(a, b);
            assert!(
                (value - iou_obb3(b, a)).abs() < 1e-12,
                "{family}: {a:?} {b:?}"
            );
            let shift = random.vector(a.size.x + b.size.x);
            let motion = Pose3::new(shift, random_rotation(&mut random));
            let moved = iou_obb3(motion * a, motion * b);
            assert!(
                (value - moved).abs() < 1e-11,
                "{family}: {value} {moved} {a:?} {b:?}"
            );
            for factor in [1e-20, 0.37, 1e20] {
                let grown = |x: Obb3<f64>| Obb3 {
                    center: x.center * factor,
                    size: x.size * factor,
                    ..x
                };
                assert!(
                    (value - iou_obb3(grown(a), grown(b))).abs() < 1e-11,
                    "{family}"
                );
            }
        }
    }
}

#[test]
fn extremes_are_finite() {
    let extremes = [0.0, 1e-30, 1e-12, 1.0, 1e12, 1e30];
    let mut random = Random(61);
    for &size in &extremes {
        for &other in &extremes {
            for &place in &extremes {
                for thin in [0.0, 1e-3, 1.0] {
                    let (q, r) = (random_rotation(&mut random), random_rotation(&mut random));
                    let a = single(Obb3::new(
                        Vec3::zero(),
                        Vec3::new(size, size, size * thin),
                        q,
                    ));
                    let at = Vec3::new(place, 0.0, place);
                    let b = single(Obb3::new(at, Vec3::new(other, other * thin, other), r));
                    let volume = intersection_volume_obb3(a, b);
                    let (value, (by_a, by_b)) = iou_obb3_vjp(a, b, 1.0);
                    assert!(
                        volume.is_finite() && (0.0..=1.0).contains(&value),
                        "{a:?} {b:?}"
                    );
                    for x in [by_a, by_b] {
                        let ok = x.center.is_finite() && x.size.is_finite();
                        assert!(ok && x.rotation.vector().is_finite(), "{a:?} {b:?} {x:?}");
                    }
                    let x = [
                        a.center.x, a.center.y, a.center.z, a.size.x, a.size.y, a.size.z,
                    ];
                    let q = [a.rotation.w, a.rotation.x, a.rotation.y, a.rotation.z];
                    let all = [x.as_slice(), &q].concat();
                    let lifted: Obb3<Jet<f32, 10>> =
                        made(std::array::from_fn(|i| Jet::variable(all[i], i)));
                    let v = |v: Vec3<f32>| {
                        Vec3::new(
                            Scalar::from_primal(v.x),
                            Scalar::from_primal(v.y),
                            Scalar::from_primal(v.z),
                        )
                    };
                    let r = b.rotation;
                    let r = Rotation3::new(
                        Scalar::from_primal(r.w),
                        Scalar::from_primal(r.x),
                        Scalar::from_primal(r.y),
                        Scalar::from_primal(r.z),
                    );
                    let dual = iou_obb3(lifted, Obb3::new(v(b.center), v(b.size), r));
                    assert!(
                        dual.derivative.iter().all(|x| x.is_finite()),
                        "{a:?} {b:?} {dual:?}"
                    );
                }
            }
        }
    }
}

/// The volume of what lies within a box and within the bounds, along its axes, of another one.
fn common_bounds(a: Obb3<f64>, b: Obb3<f64>) -> f64 {
    let seen = a.world_from_local().inverse() * b;
    let (bounds, half) = (seen.bounding(), a.size * 0.5);
    let shared = |low: f64, high: f64, half: f64| (high.min(half) - low.max(-half)).max(0.0);
    shared(bounds.min.x, bounds.max.x, half.x)
        * shared(bounds.min.y, bounds.max.y, half.y)
        * shared(bounds.min.z, bounds.max.z, half.z)
}

/// Rods in plates of their length: as the second box they lose what the plate shares with their bounds in roundings, as
/// the first one nothing but roundings of their own border.
#[test]
fn rods_have_the_digits_that_the_documentation_says() {
    let mut random = Random(17);
    let (mut worst, mut share) = ([0.0_f64; 2], [0.0_f64; 2]);
    for n in 0..400 {
        let (length, thin) = (13000.0, 2f64.powi(-4 - (random.next() % 10) as i32));
        let turn = match n % 4 {
            0 => Rotation3::new(1.0, 0.0, 1.0, 1.0),
            _ => random_rotation(&mut random),
        };
        let center = random.vector(if n % 3 == 0 { 0.0 } else { 30.0 });
        let rod = Obb3::new(center, Vec3::new(length, thin, thin), turn);
        let size = Vec3::new(length, length, 72.0);
        let plate = Obb3::new(Vec3::new(0.0, 0.0, 0.0), size, Rotation3::identity());
        let [exact, volume, ..] = overlap(rod, plate);
        // The border of the rod, moved by a rounding of its length.
        let border = 4.0 * length * thin * length;
        for (k, (a, b)) in [(rod, plate), (plate, rod)].into_iter().enumerate() {
            let error = (intersection_volume_obb3(a, b) - exact).abs();
            let roundings = error / (f64::EPSILON * (common_bounds(a, b) + border));
            worst[k] = worst[k].max(roundings);
            share[k] = share[k].max(error / volume);
        }
    }
    assert!(worst[0] < 2.0 && worst[1] < 2.0, "{worst:?}");
    // In shares of the rod's volume: the order of the boxes matters.
    assert!(share[0] < 1e-8 && share[1] > 1e-5, "{share:?}");
}
