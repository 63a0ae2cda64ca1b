//! Functions declared to be straight lines can be recorded; the program and lanes give the same results.
use super::pairs::{FAMILIES, Random, pair, single};
use geograd::ad::program::{Program, Sym};
use geograd::iou3::{Enclosing, giou, separation_aware};
use geograd::overlap3::{intersection_volume_obb3, iou_aabb3, iou_obb3, iou_obb3_vjp, iou_yaw};
use geograd::{Aabb3, Obb3, YawBox3};
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
