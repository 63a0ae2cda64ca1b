//! Every level of vector instructions that the machine has, next to powerboxesrs' best call, in one run.
//!
//! Everything is run by turns and the fastest run counts: on a shared machine all else is noise.
use super::timed::Timed;
use super::{Dice, N, flat, narrow, on_threads};
use geograd::kernels::cpu::simd::Simd;
use geograd::kernels::{Cpu, Iou, Single, Table};
use geograd::{Obb2, Real};
use std::fmt::Write;
use std::hint::black_box;

/// Boxes of the sparse scene.
const STREET: usize = 3000;
/// Rows and columns of the random lists that powerboxesrs is given: as fast as all of them, and short
/// enough to run without interruption now and then.
const PART: usize = 200;
/// How often all takes its turn.
const ROUNDS: usize = 15;

/// The forms, each in million pairs a second: all pairs of two random lists as values, values with ten
/// derivatives each and adjoint; pairs that overlap, aligned, as values and with derivatives; row maxima of the
/// random lists; values of the street.
const FORMS: [&str; 7] = [
    "value",
    "derivatives",
    "vjp",
    "aligned",
    "aligned-derivatives",
    "row-max",
    "sparse",
];

/// A street of boxes, cars and houses along both sides.
fn street(dice: &mut Dice) -> Vec<Obb2<f64>> {
    let mut place = |i: usize| {
        let (x, side) = (1.5 * i as f64, [4.0, -4.0][i % 2]);
        let (length, width) = (dice.within(3.0, 6.0), dice.within(1.5, 2.5));
        let turn = dice.within(-0.1, 0.1);
        Obb2::new(x, side + dice.within(-1.0, 1.0), length, width, turn)
    };
    (0..STREET).map(&mut place).collect()
}

/// The lists of one format.
struct Lists<T> {
    a: Vec<Obb2<T>>,
    b: Vec<Obb2<T>>,
    near: Vec<Obb2<T>>,
    street: Vec<Obb2<T>>,
}

/// All forms in one format, in the order of [`FORMS`].
fn forms<T: Real + Single<Scalar = T>>(lists: &Lists<T>) -> Vec<Timed<'_>>
where
    Obb2<T>: Single<Scalar = T>,
{
    let cpu = Cpu::new();
    let Lists { a, b, near, street } = lists;
    let zeros = |n: usize| vec![T::default(); n];
    let mut aligned = zeros(N);
    let (mut v, mut x, mut y) = (zeros(N), a.clone(), b.clone());
    let aligned_with = a;
    // All pairs of the very lists that the peer is given: its call is fastest for lists that short, and ours
    // writes derivatives of more pairs than a cache holds at the speed of memory.
    let (a, b) = (&a[..PART], &b[..PART]);
    let mut values = zeros(PART * PART);
    let mut grads = Table::new(PART, PART).expect("it fits");
    let (up, mut p, mut q) = (vec![T::one(); PART * PART], a.to_vec(), b.to_vec());
    let mut matrix = zeros(STREET * STREET);
    let pairs = PART * PART;
    vec![
        Timed::new(pairs, move || {
            cpu.all_pairs_planes(Iou, a, b, &mut values).unwrap();
        }),
        Timed::new(pairs, move || {
            cpu.all_pairs_into(Iou.value_grad(), a, b, &mut grads)
                .unwrap()
        }),
        Timed::new(pairs, move || {
            cpu.all_pairs_vjp_into(Iou, a, b, &up, &mut p, &mut q)
                .unwrap();
        }),
        Timed::new(N, move || {
            cpu.aligned_into(Iou, (aligned_with, near), &mut aligned[..])
                .unwrap();
        }),
        Timed::new(N, move || {
            let into = (&mut v[..], (&mut x[..], &mut y[..]));
            cpu.aligned_into(Iou.value_grad(), (aligned_with, near), into)
                .unwrap();
        }),
        Timed::new(pairs, move || {
            black_box(cpu.row_max(Iou, a, b).unwrap());
        }),
        Timed::new(STREET * STREET, move || {
            cpu.all_pairs_planes(Iou, street, street, &mut matrix)
                .unwrap();
        }),
    ]
}

/// Times of the filter on the street, in seconds: the matrix, filling it with zeros, row maxima and
/// pairs above a tenth with the filter, and both without.
fn filter(street: &[Obb2<f32>]) -> Vec<Timed<'_>> {
    let n = STREET * STREET;
    let (mut matrix, mut zeros) = (vec![0.0; n], vec![1.0; n]);
    let (cpu, slow) = (Cpu::new(), Cpu::new().culled(false));
    let maxima = |cpu: Cpu| {
        Timed::new(n, move || {
            black_box(cpu.row_max(Iou, street, street).unwrap());
        })
    };
    let above = |cpu: Cpu| {
        Timed::new(n, move || {
            black_box(cpu.above(Iou, street, street, 0.1).unwrap());
        })
    };
    vec![
        Timed::new(n, move || {
            cpu.all_pairs_planes(Iou, street, street, &mut matrix)
                .unwrap();
        }),
        Timed::new(n, move || black_box(&mut zeros).fill(0.0)),
        maxima(cpu),
        above(cpu),
        maxima(slow),
        above(slow),
    ]
}

/// Prints the table; gives it as lines of `level,form,format,mpairs,ratio`.
pub fn levels() -> String {
    let mut dice = Dice(7);
    let (a, b): (Vec<_>, Vec<_>) = (0..N).map(|_| (dice.random(), dice.random())).unzip();
    let near: Vec<_> = a.iter().map(|&x| dice.near(x)).collect();
    let street = street(&mut dice);
    let single = Lists {
        a: narrow(&a),
        b: narrow(&b),
        near: narrow(&near),
        street: narrow(&street),
    };
    let (flat_a, flat_b, flat_near, flat_street) = (flat(&a), flat(&b), flat(&near), flat(&street));
    let double = Lists { a, b, near, street };
    let levels = Simd::available();
    let mut ours: Vec<[Vec<Timed<'_>>; 2]> = levels
        .iter()
        .map(|_| [forms(&single), forms(&double)])
        .collect();
    let theirs = powerboxesrs::iou::rotated_iou_distance_slice;
    let mut peers = [
        Timed::new(PART * PART, || {
            drop(black_box(theirs(
                &flat_a[..5 * PART],
                &flat_b[..5 * PART],
                PART,
                PART,
            )));
        }),
        Timed::new(N / 5 * 25, || {
            for (a, b) in flat_a.chunks(25).zip(flat_near.chunks(25)) {
                black_box(theirs(a, b, 5, 5));
            }
        }),
        Timed::new(STREET * STREET, || {
            drop(black_box(theirs(
                &flat_street,
                &flat_street,
                STREET,
                STREET,
            )));
        }),
    ];
    let mut filters: Vec<_> = levels.iter().map(|_| filter(&single.street)).collect();
    on_threads(1, || {
        for _ in 0..ROUNDS {
            peers.iter_mut().for_each(Timed::turn);
            for (level, (ours, filter)) in levels.iter().zip(ours.iter_mut().zip(&mut filters)) {
                Simd::limit(Some(*level)).expect("the machine has it");
                ours.iter_mut().flatten().for_each(Timed::turn);
                filter.iter_mut().for_each(Timed::turn);
            }
            Simd::limit(None).expect("there is one");
        }
    });

    println!(
        "powerboxesrs, f64, one thread, million pairs a second: all pairs of {PART} x {PART} {:.1}, 5 x 5 of near boxes {:.1}, street {:.1}\n",
        peers[0].rate(),
        peers[1].rate(),
        peers[2].rate()
    );
    println!("| level | format | {} |", FORMS.join(" | "));
    println!("| --- | --- |{}", " ---: |".repeat(FORMS.len()));
    let mut csv = String::from("level,form,format,mpairs,ratio\n");
    for (level, ours) in levels.iter().zip(&ours) {
        for (format, ours) in ["f32", "f64"].iter().zip(ours) {
            let mut row = format!("| {} | {format} |", level.name());
            for (form, timed) in FORMS.iter().zip(ours) {
                let peer = match *form {
                    "aligned" | "aligned-derivatives" => &peers[1],
                    "sparse" => &peers[2],
                    _ => &peers[0],
                };
                let (rate, ratio) = (timed.rate(), timed.rate() / peer.rate());
                let _ = write!(row, " {rate:.0} ({ratio:.1}x) |");
                let _ = writeln!(csv, "{},{form},{format},{rate:.2},{ratio:.3}", level.name());
            }
            println!("{row}");
        }
    }
    println!(
        "\n| street of {STREET}, f32 | matrix over filling with zeros | row maxima by the filter | pairs above a tenth by the filter |"
    );
    println!("| --- | ---: | ---: | ---: |");
    for (level, x) in levels.iter().zip(&filters) {
        println!(
            "| {} | {:.2} | {:.1}x | {:.1}x |",
            level.name(),
            x[1].best / x[0].best,
            x[4].best / x[2].best,
            x[5].best / x[3].best
        );
    }
    csv
}
