//! Losses, boxes in space and quadrilaterals by level of vector instructions, next to the fastest peers.
//!
//! Everything is run by turns and the fastest run counts.
use super::timed::{Line, PART, Ratio, Timed, aligned, derivatives, matrix};
use super::{Dice, N, by_parry, flat, narrow, on_threads, points, programs};
use geograd::kernels::cpu::simd::Simd;
use geograd::kernels::{Cpu, Distance, Giou, IntersectionArea, Iou, IouBev, Table};
use geograd::{Obb2, Obb3, Rotation3, Segment2, Vec2, Vec3, YawBox3};
use std::hint::black_box;

/// How often all takes its turn.
const ROUNDS: usize = 12;

/// The reported ratios: the first line's rate over the second one's.
const RATIOS: [Ratio; 10] = [
    Ratio(
        "GIoU of all pairs over powerboxesrs'",
        "giou",
        "powerboxesrs, giou",
    ),
    Ratio(
        "IoU of all pairs without filter over GIoU",
        "iou, no filter",
        "giou",
    ),
    Ratio(
        "GIoU value over value with derivatives, aligned",
        "giou, aligned",
        "giou, aligned, derivatives",
    ),
    Ratio(
        "2D IoU over upright IoU, aligned",
        "iou, aligned",
        "upright iou, aligned",
    ),
    Ratio(
        "2D IoU over upright IoU, all pairs",
        "iou, no filter",
        "upright iou, no filter",
    ),
    Ratio(
        "upright value over value with derivatives",
        "upright iou, aligned",
        "upright iou, aligned, derivatives",
    ),
    Ratio(
        "any turn: value over value with derivatives",
        "any turn, aligned",
        "any turn, aligned, derivatives",
    ),
    Ratio(
        "quadrilaterals over parry2d-f64",
        "quadrilaterals, aligned",
        "parry2d-f64, quadrilaterals",
    ),
    Ratio(
        "quadrilaterals with derivatives over parry2d-f64's value",
        "quadrilaterals, aligned, derivatives",
        "parry2d-f64, quadrilaterals",
    ),
    Ratio(
        "any turn, scene: filter over none",
        "any turn, scene",
        "any turn, scene, no filter",
    ),
];

/// Upright boxes and boxes a little tilted of boxes in the plane.
fn solids(flat: &[Obb2<f32>], dice: &mut Dice) -> (Vec<YawBox3<f32>>, Vec<Obb3<f32>>) {
    let mut solid = |x: &Obb2<f32>| {
        let (z, dz) = (dice.within(-0.3, 0.3) as f32, dice.within(1.2, 2.2) as f32);
        let upright = YawBox3::new(
            Vec3::new(x.center.x, x.center.y, z),
            Vec3::new(x.size.x, x.size.y, dz),
            x.heading,
        );
        let tilt = [0, 1, 2].map(|_| dice.within(-0.4, 0.4) as f32);
        let turn = Rotation3::new(1.0, tilt[0], tilt[1], tilt[2]);
        let tilted = Obb3::new(upright.center, upright.size, turn * upright.rotation());
        (upright, tilted)
    };
    flat.iter().map(&mut solid).unzip()
}

/// The inputs of all lines.
struct Lists {
    a: Vec<Obb2<f32>>,
    b: Vec<Obb2<f32>>,
    near: Vec<Obb2<f32>>,
    upright: [Vec<YawBox3<f32>>; 3],
    tilted: [Vec<Obb3<f32>>; 2],
    scene: Vec<Obb3<f32>>,
    points: Vec<Vec2<f32>>,
    segments: [Vec<Segment2<f32>>; 2],
    quads: [Vec<[Vec2<f32>; 4]>; 2],
}

impl Lists {
    fn new(dice: &mut Dice) -> (Self, [Vec<Obb2<f64>>; 3]) {
        let (a, b): (Vec<_>, Vec<_>) = (0..N).map(|_| (dice.random(), dice.random())).unzip();
        let near: Vec<_> = a.iter().map(|&x| dice.near(x)).collect();
        let wide: Vec<_> = (0..N)
            .map(|_| {
                let x = dice.random();
                Obb2 {
                    center: x.center * 100.0,
                    ..x
                }
            })
            .collect();
        let [a32, b32, near32, wide] = [&a, &b, &near, &wide].map(|list| narrow(list));
        let mut lists = [&a32, &near32, &b32].map(|list| solids(list, dice));
        // Boxes that are near stay near in height and tilt.
        for i in 0..N {
            let (upright, tilted) = (lists[0].0[i], lists[0].1[i]);
            let (near, turned) = (&mut lists[1].0[i], &mut lists[1].1[i]);
            near.center.z = upright.center.z + 0.1;
            near.size.z = upright.size.z * 1.1;
            let lean = Rotation3::new(1.0, 0.05, -0.03, dice.within(-0.1, 0.1) as f32);
            *turned = Obb3::new(near.center, near.size, lean * tilted.rotation);
        }
        let [
            (upright, tilted),
            (upright_near, tilted_near),
            (upright_b, _),
        ] = lists;
        let mut point = || Vec2::new(dice.within(-5.0, 5.0) as f32, dice.within(-5.0, 5.0) as f32);
        let points = (0..N).map(|_| point()).collect();
        let mut list = || (0..N).map(|_| Segment2::new(point(), point())).collect();
        let segments = [list(), list()];
        let (_, scene) = solids(&wide, &mut Dice(5));
        let quads = [&a32, &near32].map(|list| list.iter().map(|x| x.corners()).collect());
        let lists = Lists {
            quads,
            a: a32,
            b: b32,
            near: near32,
            upright: [upright, upright_near, upright_b],
            tilted: [tilted, tilted_near],
            scene,
            points,
            segments,
        };
        (lists, [a, b, near])
    }
}

/// All lines of one level.
fn lines(lists: &Lists) -> Vec<Line<'_>> {
    let Lists {
        a,
        b,
        near,
        upright: [upright, upright_near, upright_b],
        tilted: [tilted, tilted_near],
        scene,
        points,
        segments,
        quads: [quads, quads_near],
    } = lists;
    let (cpu, all) = (Cpu::new(), Cpu::new().culled(false));
    let mut grads = Table::new(PART, PART).expect("it fits");
    let mut lines = vec![
        matrix("iou, no filter", all, Iou, &a[..PART], &b[..PART]),
        matrix("giou", cpu, Giou, &a[..PART], &b[..PART]),
        Line {
            name: "giou, derivatives",
            timed: Timed::new(PART * PART, move || {
                cpu.all_pairs_into(Giou.value_grad(), &a[..PART], &b[..PART], &mut grads)
                    .unwrap();
            }),
        },
        aligned("iou, aligned", Iou, a, near),
        derivatives("iou, aligned, derivatives", Iou, a, near),
        aligned("giou, aligned", Giou, a, near),
        derivatives("giou, aligned, derivatives", Giou, a, near),
        matrix(
            "upright iou",
            cpu,
            Iou,
            &upright[..PART],
            &upright_b[..PART],
        ),
        matrix(
            "upright iou, no filter",
            all,
            Iou,
            &upright[..PART],
            &upright_b[..PART],
        ),
        aligned("upright iou, aligned", Iou, upright, upright_near),
        derivatives(
            "upright iou, aligned, derivatives",
            Iou,
            upright,
            upright_near,
        ),
        aligned("bird's eye iou, aligned", IouBev, upright, upright_near),
        derivatives(
            "bird's eye iou, aligned, derivatives",
            IouBev,
            upright,
            upright_near,
        ),
        aligned("any turn, aligned", Iou, tilted, tilted_near),
        derivatives("any turn, aligned, derivatives", Iou, tilted, tilted_near),
        matrix("any turn, scene", cpu, Iou, scene, scene),
        matrix("any turn, scene, no filter", all, Iou, scene, scene),
        aligned(
            "quadrilaterals, aligned",
            IntersectionArea,
            quads,
            quads_near,
        ),
        derivatives(
            "quadrilaterals, aligned, derivatives",
            IntersectionArea,
            quads,
            quads_near,
        ),
        derivatives(
            "point to segment, derivatives",
            Distance,
            points,
            &segments[0],
        ),
        derivatives(
            "segment to segment, derivatives",
            Distance,
            &segments[0],
            &segments[1],
        ),
    ];
    lines.extend(programs::lines([a, b, near], points, &segments[0]));
    lines
}

/// Prints the table; gives it as lines of `level,row,mitems`.
pub fn shapes() -> String {
    let mut dice = Dice(7);
    let (lists, [a, b, near]) = Lists::new(&mut dice);
    let (flat_a, flat_b) = (flat(&a), flat(&b));
    let levels = Simd::available();
    let mut ours: Vec<Vec<Line<'_>>> = levels.iter().map(|_| lines(&lists)).collect();
    let pointed = |list: &[Obb2<f64>]| list.iter().map(points).collect::<Vec<_>>();
    let (points_a, points_near, mut scratch) = (pointed(&a), pointed(&near), Vec::new());
    let mut peers = vec![
        Line {
            name: "powerboxesrs, giou",
            timed: Timed::new(PART * PART, || {
                let [a, b] = [&flat_a, &flat_b].map(|x| &x[..5 * PART]);
                drop(black_box(powerboxesrs::giou::rotated_giou_distance_slice(
                    a, b, PART, PART,
                )));
            }),
        },
        Line {
            name: "powerboxesrs, iou",
            timed: Timed::new(PART * PART, || {
                let [a, b] = [&flat_a, &flat_b].map(|x| &x[..5 * PART]);
                drop(black_box(powerboxesrs::iou::rotated_iou_distance_slice(
                    a, b, PART, PART,
                )));
            }),
        },
        Line {
            name: "parry2d-f64, quadrilaterals",
            timed: Timed::new(N, || {
                for (a, b) in points_a.iter().zip(&points_near) {
                    black_box(by_parry(a, b, 1.0, &mut scratch));
                }
            }),
        },
    ];
    on_threads(1, || {
        for _ in 0..ROUNDS {
            peers.iter_mut().for_each(|line| line.timed.turn());
            for (level, lines) in levels.iter().zip(&mut ours) {
                Simd::limit(Some(*level)).expect("the machine has it");
                lines.iter_mut().for_each(|line| line.timed.turn());
            }
            Simd::limit(None).expect("there is one");
        }
    });

    let mut csv = String::from("level,row,mitems\n");
    println!(
        "\n| f32, one thread, million items a second | {} |",
        names(&levels)
    );
    println!("| --- |{}", " ---: |".repeat(levels.len()));
    for k in 0..ours[0].len() {
        let rates: Vec<f64> = ours.iter().map(|lines| lines[k].timed.rate()).collect();
        let cells: Vec<String> = rates.iter().map(|x| format!("{x:.1}")).collect();
        println!("| {} | {} |", ours[0][k].name, cells.join(" | "));
        for (level, rate) in levels.iter().zip(rates) {
            csv += &format!("{},\"{}\",{rate:.3}\n", level.name(), ours[0][k].name);
        }
    }
    for line in &peers {
        let rate = line.timed.rate();
        println!("| {}, f64 | {rate:.1} |", line.name);
        csv += &format!("none,\"{}\",{rate:.3}\n", line.name);
    }
    println!("\n| ratio of rates | {} |", names(&levels));
    println!("| --- |{}", " ---: |".repeat(levels.len()));
    for Ratio(what, over, under) in RATIOS.iter().chain(&programs::RATIOS) {
        let cells: Vec<String> = ours
            .iter()
            .map(|lines| {
                let of = |name: &str| {
                    let all = lines.iter().chain(&peers);
                    all.into_iter()
                        .find(|line| line.name == name)
                        .map_or(f64::NAN, |line| line.timed.rate())
                };
                format!("{:.2}", of(over) / of(under))
            })
            .collect();
        println!("| {what} | {} |", cells.join(" | "));
    }
    csv
}

fn names(levels: &[Simd]) -> String {
    let names: Vec<&str> = levels.iter().map(|level| level.name()).collect();
    names.join(" | ")
}
