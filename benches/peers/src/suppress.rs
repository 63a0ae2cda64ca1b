//! Suppression of rotated boxes next to the plain loop over powerboxesrs, and of large scenes.
use super::timed::Timed;
use super::{Dice, flat, narrow, on_threads};
use geograd::kernels::{Cpu, Iou, IouBev};
use geograd::suppression::Rules;
use geograd::{Obb2, Vec3, YawBox3};
use std::hint::black_box;

/// Detections that overlap, and those of a large scene.
const CROWD: usize = 10_000;
const SCENE: usize = 100_000;
/// Side of the scene, in metres.
const SIDE: f64 = 1000.0;
/// Overlaps above this one suppress.
const OVERLAP: f64 = 0.5;
/// How often all takes its turn.
const ROUNDS: usize = 5;

/// Cars about so many places of a square, each detected again and again.
fn detections(dice: &mut Dice, count: usize, places: usize, side: f64) -> Vec<Obb2<f64>> {
    let mut car = || {
        Obb2::new(
            dice.within(0.0, side),
            dice.within(0.0, side),
            dice.within(3.5, 5.0),
            dice.within(1.6, 2.1),
            dice.within(-3.1, 3.1),
        )
    };
    let cars: Vec<_> = (0..places).map(|_| car()).collect();
    (0..count)
        .map(|i| dice.near(cars[i * places / count]))
        .collect()
}

/// Prints the table; gives it as lines of `row,boxes,milliseconds`.
pub fn suppress() -> String {
    let mut dice = Dice(17);
    // Ten detections of each of a thousand cars, on a car park where neighbours overlap, too.
    let crowd = detections(&mut dice, CROWD, CROWD / 10, 60.0);
    let spread = detections(&mut dice, CROWD, CROWD / 10, 400.0);
    let scene = detections(&mut dice, SCENE, SCENE / 4, SIDE);
    let scores: Vec<f64> = (0..SCENE).map(|_| dice.within(0.0, 1.0)).collect();
    let few: Vec<f32> = scores.iter().map(|&x| x as f32).collect();
    let upright = |list: &[Obb2<f32>]| -> Vec<YawBox3<f32>> {
        let solid = |x: &Obb2<f32>| {
            let (center, size) = (
                Vec3::new(x.center.x, x.center.y, 0.8),
                Vec3::new(x.size.x, x.size.y, 1.6),
            );
            YawBox3::new(center, size, x.heading)
        };
        list.iter().map(solid).collect()
    };
    let (crowd32, spread32, scene32) = (narrow(&crowd), narrow(&spread), narrow(&scene));
    let (solid_crowd, solid_scene) = (upright(&crowd32), upright(&scene32));
    let (flat_crowd, flat_spread) = (flat(&crowd), flat(&spread));
    let (cpu, rules) = (Cpu::new(), Rules::above(OVERLAP as f32));

    let ours = cpu.suppress(Iou, &crowd, &scores[..CROWD], Rules::above(OVERLAP));
    let theirs = powerboxesrs::nms::rotated_nms_slice(&flat_crowd, &scores[..CROWD], OVERLAP, 0.0);
    let ours = ours.unwrap();
    let same = ours.iter().filter(|i| theirs.contains(i)).count();
    assert!(
        ours.len().abs_diff(theirs.len()) <= 5 && same + 10 > ours.len(),
        "powerboxesrs disagrees: {} kept, {} by them, {same} by both",
        ours.len(),
        theirs.len()
    );
    let mut lines = vec![
        (
            "geograd, f32, crowded",
            Timed::new(CROWD, || {
                black_box(cpu.suppress(Iou, &crowd32, &few[..CROWD], rules)).unwrap();
            }),
        ),
        (
            "geograd, f32, crowded, IoU in space",
            Timed::new(CROWD, || {
                black_box(cpu.suppress(Iou, &solid_crowd, &few[..CROWD], rules)).unwrap();
            }),
        ),
        (
            "powerboxesrs' loop, f64, crowded",
            Timed::new(CROWD, || {
                let scores = &scores[..CROWD];
                black_box(powerboxesrs::nms::rotated_nms_slice(
                    &flat_crowd,
                    scores,
                    OVERLAP,
                    0.0,
                ));
            }),
        ),
        (
            "powerboxesrs with its R-tree, f64, crowded",
            Timed::new(CROWD, || {
                let scores = &scores[..CROWD];
                black_box(powerboxesrs::nms::rtree_rotated_nms_slice(
                    &flat_crowd,
                    scores,
                    OVERLAP,
                    0.0,
                ));
            }),
        ),
        (
            "geograd, f32, spread",
            Timed::new(CROWD, || {
                black_box(cpu.suppress(Iou, &spread32, &few[..CROWD], rules)).unwrap();
            }),
        ),
        (
            "powerboxesrs' loop, f64, spread",
            Timed::new(CROWD, || {
                let scores = &scores[..CROWD];
                black_box(powerboxesrs::nms::rotated_nms_slice(
                    &flat_spread,
                    scores,
                    OVERLAP,
                    0.0,
                ));
            }),
        ),
        (
            "geograd, f32, scene",
            Timed::new(SCENE, || {
                black_box(cpu.suppress(Iou, &scene32, &few, rules)).unwrap();
            }),
        ),
        (
            "geograd, f32, scene, bird's eye",
            Timed::new(SCENE, || {
                black_box(cpu.suppress(IouBev, &solid_scene, &few, rules)).unwrap();
            }),
        ),
        (
            "geograd, f32, scene, IoU in space",
            Timed::new(SCENE, || {
                black_box(cpu.suppress(Iou, &solid_scene, &few, rules)).unwrap();
            }),
        ),
    ];
    on_threads(1, || {
        for _ in 0..ROUNDS {
            lines.iter_mut().for_each(|(_, timed)| timed.turn());
        }
    });
    let mut csv = String::from("row,boxes,milliseconds\n");
    println!(
        "\n{} of {CROWD} kept where crowded; scene of {SCENE} boxes, {SIDE} m wide",
        ours.len()
    );
    println!("\n| suppression above {OVERLAP}, one thread | milliseconds |\n| --- | ---: |");
    for (name, timed) in &lines {
        let milliseconds = timed.microseconds() / 1e3;
        println!("| {name} | {milliseconds:.3} |");
        csv += &format!("\"{name}\",{},{milliseconds:.4}\n", timed.items);
    }
    csv
}
