//! Functions declared to be straight lines can be recorded; the program and lanes give the same results.
use super::pairs::{FAMILIES, Random, pair, single};
use geograd::ad::adjoint::overlap3::iou_obb3_vjp;
use geograd::ad::program::{Program, Sym};
use geograd::iou3::{Enclosing, giou, separation_aware};
use geograd::overlap3::{intersection_volume_obb3, iou_aabb3, iou_obb3, iou_yaw};
use geograd::{Aabb3, Obb3, Rotation3, Vec3, YawBox3};
use geograd::{Fixed, Lanes, Pack, gaussian::solid};

type Pair<B> = (B, B);

fn solids(random: &mut Random) -> Vec<Pair<Obb3<f64>>> {
    let all = FAMILIES.iter().cycle().take(4 * FAMILIES.len());
    all.map(|family| pair(family, random)).collect()
}

#[test]
fn overlap_of_turned_boxes_is_a_program() {
    let mut random = Random(101);
    let wide = Program::trace(|(a, b): Pair<Obb3<Sym<f64>>>| iou_obb3(a, b)).unwrap();
    let narrow =
        Program::trace(|(a, b): Pair<Obb3<Sym<f32>>>| intersection_volume_obb3(a, b)).unwrap();
    let adjoint = Program::trace(|(a, b): Pair<Obb3<Sym<f64>>>| {
        let (value, derivatives) = iou_obb3_vjp(a, b, Fixed::filled(geograd::Scalar::one()));
        (value, derivatives)
    });
    let adjoint = adjoint.unwrap();
    if std::env::var("SHOW").is_ok() {
        println!(
            "value {:?}\nwith derivatives {:?}",
            wide.cost(),
            adjoint.cost()
        );
    }
    for (a, b) in solids(&mut random) {
        assert_eq!(wide.eval((a, b)), iou_obb3(a, b));
        assert_eq!(adjoint.eval((a, b)), iou_obb3_vjp(a, b, 1.0));
        let (a, b) = (single(a), single(b));
        assert_eq!(narrow.eval((a, b)), intersection_volume_obb3(a, b));
    }
}

#[test]
fn programs_of_overlaps_have_the_derivatives_by_hand() {
    // Parallel edges: derivatives of the value's own arithmetic have no digits there.
    let mut random = Random(104);
    let program = Program::trace(|(a, b): Pair<Obb3<Sym<f64>>>| iou_obb3(a, b)).unwrap();
    let gradient = program.value_grad();
    let size = Vec3::new(2.0, 1.0, 1.5);
    let none = Rotation3::identity();
    let cut = Obb3::new(Vec3::new(0.0, 0.125, 0.0), Vec3::new(4.0, 0.5, 9.0), none);
    let aligned = (Obb3::new(Vec3::new(0.25, 0.0, 0.0), size, none), cut);
    let mut turned = aligned;
    turned.0.rotation = Rotation3::new(0.5_f64.sqrt(), 0.0, 0.0, 0.5_f64.sqrt());
    for (a, b) in [aligned, turned].into_iter().chain(solids(&mut random)) {
        let (_, by_hand) = iou_obb3_vjp(a, b, 1.0);
        let (found, by_hand) = (gradient.eval((a, b)).1.scalars(), by_hand.scalars());
        let largest = by_hand.iter().fold(1e-9_f64, |most, x| most.max(x.abs()));
        for (x, y) in found.into_iter().zip(by_hand) {
            assert!((x - y).abs() < 1e-9 * largest, "{a:?} {b:?}: {x:e}, {y:e}");
        }
    }
}

#[test]
fn losses_are_programs() {
    let mut random = Random(102);
    let upright = Program::trace(|(a, b): Pair<YawBox3<Sym<f64>>>| {
        [iou_yaw(a, b), giou(a, b, Enclosing::Rectangle)]
    });
    let bounds = Program::trace(|(a, b): Pair<Aabb3<Sym<f64>>>| iou_aabb3(a, b)).unwrap();
    let turned = Program::trace(|(a, b): Pair<Obb3<Sym<f64>>>| {
        [
            separation_aware(a, b),
            solid::kullback_leibler(a, b),
            solid::bhattacharyya(a, b),
            solid::probiou(a, b),
            solid::kfiou(a, b),
            solid::wasserstein(a, b),
        ]
    });
    let (upright, turned) = (upright.unwrap(), turned.unwrap());
    for (a, b) in solids(&mut random) {
        let expected = [
            separation_aware(a, b),
            solid::kullback_leibler(a, b),
            solid::bhattacharyya(a, b),
            solid::probiou(a, b),
            solid::kfiou(a, b),
            solid::wasserstein(a, b),
        ];
        assert_eq!(turned.eval((a, b)), expected);
        let (a, b) = (random.yaw_box(), random.yaw_box());
        let expected = [iou_yaw(a, b), giou(a, b, Enclosing::Rectangle)];
        assert_eq!(upright.eval((a, b)), expected);
        let (a, b) = (a.bounding(), b.bounding());
        assert_eq!(bounds.eval((a, b)), iou_aabb3(a, b));
    }
}

#[test]
fn lanes_agree_with_single_numbers() {
    type Eight = Lanes<f32, 8>;
    let mut random = Random(103);
    let all: Vec<_> = solids(&mut random)
        .into_iter()
        .map(|(a, b)| (single(a), single(b)))
        .collect();
    for group in all.chunks_exact(8) {
        let lanes = |pick: fn(&Pair<Obb3<f32>>) -> Obb3<f32>| -> Obb3<Eight> {
            let mut numbers = [Eight::splat(0.0); 10];
            for (lane, pair) in group.iter().enumerate() {
                for (number, x) in numbers.iter_mut().zip(pick(pair).scalars()) {
                    number.0[lane] = x;
                }
            }
            Fixed::load(&numbers)
        };
        let found = iou_obb3(lanes(|p| p.0), lanes(|p| p.1));
        for (lane, &(a, b)) in group.iter().enumerate() {
            assert_eq!(found.0[lane], iou_obb3(a, b), "{a:?} {b:?}");
        }
    }
}
