//! Times of the interpreter of programs, next to compiled kernels and to copying.
use super::N;
use super::timed::{Line, PART, Ratio, Timed, aligned};
use geograd::kernels::{Cpu, Distance, Iou, Op};
use geograd::{Obb2, Segment2, Vec2};
use std::hint::black_box;

/// Times of the interpreter over those of compiled kernels, and shares of copying's rate.
pub const RATIOS: [Ratio; 5] = [
    Ratio(
        "compiled IoU over its program, aligned",
        "iou, aligned",
        "iou as a program, aligned",
    ),
    Ratio(
        "the same with derivatives",
        "iou, aligned, derivatives",
        "iou as a program, aligned, derivatives",
    ),
    Ratio(
        "IoU of all pairs as a program over powerboxesrs'",
        "iou as a program",
        "powerboxesrs, iou",
    ),
    Ratio(
        "point to segment, of copying both",
        "point to segment",
        "copying points and segments",
    ),
    Ratio(
        "the same with derivatives, of copying both",
        "point to segment, derivatives",
        "copying points and segments",
    ),
];

/// Rotated IoU as a program, with its adjoint by hand recorded; distances, which are programs; and copying.
pub fn lines<'a>(
    [a, b, near]: [&'a [Obb2<f32>]; 3],
    points: &'a [Vec2<f32>],
    segments: &'a [Segment2<f32>],
) -> Vec<Line<'a>> {
    let cpu = Cpu::new();
    let iou = || {
        Iou.row::<(Obb2<f32>, Obb2<f32>)>()
            .program::<f32>()
            .expect("it is recorded")
    };
    let (value, derivatives, pairs) = (iou(), iou().value_grad(), iou());
    let (mut values, mut more) = (vec![0.0; N], vec![0.0; N]);
    let (mut p, mut q) = (a.to_vec(), near.to_vec());
    let mut matrix = vec![0.0; PART * PART];
    let (mut to, mut along) = (points.to_vec(), segments.to_vec());
    vec![
        Line {
            name: "iou as a program",
            timed: Timed::new(PART * PART, move || {
                cpu.all_pairs_planes(&pairs, &a[..PART], &b[..PART], &mut matrix)
                    .unwrap();
            }),
        },
        Line {
            name: "iou as a program, aligned",
            timed: Timed::new(N, move || {
                cpu.aligned_into(&value, (a, near), &mut values[..])
                    .unwrap();
            }),
        },
        Line {
            name: "iou as a program, aligned, derivatives",
            timed: Timed::new(N, move || {
                let into = (&mut more[..], (&mut p[..], &mut q[..]));
                cpu.aligned_into(&derivatives, (a, near), into).unwrap();
            }),
        },
        aligned("point to segment", Distance, points, segments),
        Line {
            name: "copying points and segments",
            timed: Timed::new(N, move || {
                black_box(&mut to[..]).copy_from_slice(points);
                black_box(&mut along[..]).copy_from_slice(segments);
            }),
        },
    ]
}
