//! The paper's experiment: the IoU loss forward, and forward and backward, against the number of boxes, in
//! the plane and in space, drawn. With `--backend gpu` the GPU's curves beside the CPU's: boxes, results and
//! derivatives stay there, as in training, and a call is over when the GPU is done.
use super::timed::Timed;
use super::{Dice, flat, narrow, on_threads};
use common::cli::Machine;
use geograd::kernels::Backend;
use geograd::kernels::gpu::Gpu;
use geograd::kernels::op::ValueGrad;
use geograd::kernels::{Cpu, Function, Iou, Item, Single};
use geograd::{Obb2, Obb3, Rotation3, Vec3, YawBox3};
use std::fmt::Write;
use std::hint::black_box;

/// Numbers of boxes.
const COUNTS: [usize; 9] = [10, 32, 100, 316, 1000, 3162, 10_000, 31_623, 100_000];
/// How often all takes its turn.
const ROUNDS: usize = 12;

/// One curve.
struct Curve<'a> {
    name: String,
    colour: &'static str,
    dashed: bool,
    times: Vec<Timed<'a>>,
}

/// Guesses and truths, a small motion apart.
struct Lists<B> {
    guesses: Vec<B>,
    truths: Vec<B>,
}

/// Two curves of one operation: the values, and values with gradients.
fn curves<'a, O, B>(
    names: [&'static str; 2],
    colour: &'static str,
    op: O,
    lists: &'a Lists<B>,
) -> [Curve<'a>; 2]
where
    O: Function<(B, B), Out = f32> + Copy + Send + 'a,
    B: Single<Scalar = f32>,
    (B, B): Item<Scalar = f32>,
{
    let cpu = Cpu::new();
    let forward = COUNTS.map(|n| {
        let (a, b) = (&lists.guesses[..n], &lists.truths[..n]);
        let mut values = vec![0.0; n];
        Timed::new(n, move || {
            cpu.aligned_into(op, (a, b), &mut values[..]).unwrap();
            black_box(values.iter().sum::<f32>());
        })
    });
    let backward = COUNTS.map(|n| {
        let (a, b) = (&lists.guesses[..n], &lists.truths[..n]);
        let (mut values, mut p, mut q) = (vec![0.0; n], a.to_vec(), b.to_vec());
        Timed::new(n, move || {
            let into = (&mut values[..], (&mut p[..], &mut q[..]));
            cpu.aligned_into(ValueGrad::of(op), (a, b), into).unwrap();
            black_box(values.iter().sum::<f32>());
        })
    });
    let curve = |name: &str, dashed, times: [Timed<'a>; COUNTS.len()]| Curve {
        name: name.into(),
        colour,
        dashed,
        times: times.into(),
    };
    [
        curve(names[0], true, forward),
        curve(names[1], false, backward),
    ]
}

/// Waits until a GPU is done.
fn done(gpu: &Gpu) {
    gpu.wait().unwrap();
}

/// The same two curves on a GPU.
fn curves_on<'a, O, B>(
    here: Backend<'a>,
    gpu: &'a Gpu,
    names: [&'static str; 2],
    colour: &'static str,
    op: O,
    lists: &Lists<B>,
) -> [Curve<'a>; 2]
where
    O: Function<(B, B), Out = f32> + Copy + Send + 'a,
    B: Single<Scalar = f32> + 'a,
    (B, B): Item<Scalar = f32>,
{
    let held = |n: usize| {
        let (a, b) = (&lists.guesses[..n], &lists.truths[..n]);
        (here.upload(a).unwrap(), here.upload(b).unwrap())
    };
    let forward = COUNTS.map(|n| {
        let (a, b) = held(n);
        let mut values = here.aligned(op, (&a, &b)).unwrap();
        Timed::new(n, move || {
            here.aligned_into(op, (&a, &b), &mut values).unwrap();
            done(gpu);
        })
    });
    let backward = COUNTS.map(|n| {
        let (a, b) = held(n);
        let mut derivatives = here.aligned(ValueGrad::of(op), (&a, &b)).unwrap();
        Timed::new(n, move || {
            let columns = (&a, &b);
            here.aligned_into(ValueGrad::of(op), columns, &mut derivatives)
                .unwrap();
            done(gpu);
        })
    });
    let curve = |name: &str, dashed, times: [Timed<'a>; COUNTS.len()]| Curve {
        name: format!("GPU, {name}"),
        colour,
        dashed,
        times: times.into(),
    };
    [
        curve(names[0], true, forward),
        curve(names[1], false, backward),
    ]
}

/// The boxes in space over boxes in the plane.
fn solid(x: &Obb2<f32>, dice: &mut Dice) -> (YawBox3<f32>, Obb3<f32>) {
    let (z, dz) = (dice.within(-0.2, 0.2) as f32, dice.within(1.2, 2.2) as f32);
    let center = Vec3::new(x.center.x, x.center.y, z);
    let upright = YawBox3::new(center, Vec3::new(x.size.x, x.size.y, dz), x.heading);
    let [p, q] = [0, 1].map(|_| dice.within(-0.1, 0.1) as f32);
    let lean = Rotation3::new(1.0, p, q, 0.0);
    (
        upright,
        Obb3::new(center, upright.size, lean * upright.rotation()),
    )
}

/// Runs it; gives the picture and the table as lines of `curve,boxes,microseconds`.
pub fn paper(machine: &Machine) -> (String, String) {
    let most = COUNTS[COUNTS.len() - 1];
    let mut dice = Dice(23);
    let truths: Vec<_> = (0..most).map(|_| dice.random()).collect();
    let guesses: Vec<_> = truths.iter().map(|&x| dice.near(x)).collect();
    let (flat_guesses, flat_truths) = (flat(&guesses), flat(&truths));
    let plane = Lists {
        guesses: narrow(&guesses),
        truths: narrow(&truths),
    };
    let solids = [&plane.guesses, &plane.truths]
        .map(|list| -> (Vec<_>, Vec<_>) { list.iter().map(|x| solid(x, &mut dice)).unzip() });
    let [(upright_guesses, guesses), (upright_truths, truths)] = solids;
    let upright = Lists {
        guesses: upright_guesses,
        truths: upright_truths,
    };
    let turned = Lists { guesses, truths };

    let flat_names = ["2D forward", "2D forward and backward"];
    let upright_names = ["3D upright forward", "3D upright forward and backward"];
    let turned_names = ["3D any turn forward", "3D any turn forward and backward"];
    let mut all: Vec<Curve<'_>> = Vec::new();
    all.extend(curves(flat_names, "#1b6ca8", Iou, &plane));
    all.extend(curves(upright_names, "#c0572b", Iou, &upright));
    all.extend(curves(turned_names, "#3f7d3a", Iou, &turned));
    if let Machine::Gpu(gpu) = machine {
        let here = machine.backend().resident();
        all.extend(curves_on(here, gpu, flat_names, "#66b7f0", Iou, &plane));
        all.extend(curves_on(
            here,
            gpu,
            upright_names,
            "#f2a07c",
            Iou,
            &upright,
        ));
        all.extend(curves_on(here, gpu, turned_names, "#8fd08a", Iou, &turned));
    }
    let peer = COUNTS.map(|n| {
        // Pair by pair, as a loss needs it: its matrices of 1 x 1.
        let (a, b) = (&flat_guesses[..5 * n], &flat_truths[..5 * n]);
        Timed::new(n, move || {
            for (a, b) in a.chunks_exact(5).zip(b.chunks_exact(5)) {
                black_box(powerboxesrs::iou::rotated_iou_distance_slice(a, b, 1, 1));
            }
        })
    });
    all.push(Curve {
        name: "powerboxesrs, 2D forward, f64".into(),
        colour: "#777777",
        dashed: true,
        times: peer.into(),
    });
    on_threads(1, || {
        for _ in 0..ROUNDS {
            all.iter_mut()
                .flat_map(|curve| &mut curve.times)
                .for_each(Timed::turn);
        }
    });

    let mut csv = String::from("curve,boxes,microseconds\n");
    let mut points: Vec<(usize, Vec<f64>)> = Vec::new();
    let on = match machine {
        Machine::Cpu => "one thread".to_owned(),
        Machine::Gpu(gpu) => format!("one thread; GPU: {gpu}"),
    };
    println!(
        "\n| microseconds, {on} | {} |",
        COUNTS.map(|n| n.to_string()).join(" | ")
    );
    println!("| --- |{}", " ---: |".repeat(COUNTS.len()));
    for (k, curve) in all.iter().enumerate() {
        let times: Vec<f64> = curve.times.iter().map(Timed::microseconds).collect();
        let cells: Vec<String> = times.iter().map(|x| format!("{x:.1}")).collect();
        println!("| {} | {} |", curve.name, cells.join(" | "));
        for (n, time) in COUNTS.iter().zip(&times) {
            let _ = writeln!(csv, "\"{}\",{n},{time:.3}", curve.name);
        }
        points.push((k, times));
    }
    let place = match machine {
        Machine::Cpu => "on one thread".to_owned(),
        Machine::Gpu(gpu) => format!("on one thread, and on {gpu}"),
    };
    (drawn(&all, &points, &place), csv)
}

/// The picture: both axes logarithmic.
fn drawn(curves: &[Curve<'_>], points: &[(usize, Vec<f64>)], place: &str) -> String {
    const WIDTH: f64 = 860.0;
    const HEIGHT: f64 = 480.0;
    const LEFT: f64 = 70.0;
    const TOP: f64 = 46.0;
    let (wide, high) = (WIDTH - LEFT - 340.0, HEIGHT - TOP - 56.0);
    let all = || points.iter().flat_map(|(_, times)| times);
    let low = all().copied().fold(f64::INFINITY, f64::min).log10().floor();
    let top = all().copied().fold(0.0, f64::max).log10().ceil();
    let (first, last) = (COUNTS[0] as f64, COUNTS[COUNTS.len() - 1] as f64);
    let x = |n: f64| LEFT + wide * (n / first).log10() / (last / first).log10();
    let y = |t: f64| TOP + high * (top - t.log10()) / (top - low);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"white\"/>\n\
         <text x=\"{LEFT}\" y=\"22\" font-size=\"15\">IoU loss of box pairs, f32</text>\n\
         <text x=\"{LEFT}\" y=\"39\" font-size=\"11\">{place}</text>\n"
    );
    for power in first.log10() as i32..=last.log10() as i32 {
        let at = x(10_f64.powi(power));
        let _ = writeln!(
            svg,
            "<line x1=\"{at:.1}\" y1=\"{TOP}\" x2=\"{at:.1}\" y2=\"{:.1}\" stroke=\"#dddddd\"/>\
             <text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            TOP + high,
            TOP + high + 18.0,
            10_u64.pow(power as u32)
        );
    }
    for power in low as i32..=top as i32 {
        let at = y(10_f64.powi(power));
        let word = match power {
            ..0 => format!("{} ns", 10_u64.pow((power + 3).max(0) as u32)),
            0..3 => format!("{} µs", 10_u64.pow(power as u32)),
            _ => format!("{} ms", 10_u64.pow(power as u32 - 3)),
        };
        let _ = writeln!(
            svg,
            "<line x1=\"{LEFT}\" y1=\"{at:.1}\" x2=\"{:.1}\" y2=\"{at:.1}\" stroke=\"#dddddd\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{word}</text>",
            LEFT + wide,
            LEFT - 6.0,
            at + 4.0
        );
    }
    let _ = writeln!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">pairs of boxes</text>",
        LEFT + wide / 2.0,
        HEIGHT - 14.0
    );
    for (k, times) in points {
        let curve = &curves[*k];
        let path: Vec<String> = COUNTS
            .iter()
            .zip(times)
            .map(|(&n, &t)| format!("{:.1},{:.1}", x(n as f64), y(t)))
            .collect();
        let dash = if curve.dashed {
            " stroke-dasharray=\"6 4\""
        } else {
            ""
        };
        let style = format!("stroke=\"{}\" stroke-width=\"2\"{dash}", curve.colour);
        let (at, row) = (LEFT + wide + 16.0, TOP + 14.0 + 20.0 * *k as f64);
        let _ = writeln!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" {style}/>\n\
             <line x1=\"{at:.1}\" y1=\"{row:.1}\" x2=\"{:.1}\" y2=\"{row:.1}\" {style}/>\
             <text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
            path.join(" "),
            at + 26.0,
            at + 32.0,
            row + 4.0,
            curve.name
        );
    }
    svg += "</svg>\n";
    svg
}
