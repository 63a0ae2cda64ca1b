//! Pairs within groups on a GPU: those of the matrix of all pairs that are in one group.
use crate::bounds::close;
use crate::shapes::{Draws, Score};
use crate::{gpu, small};
use geograd::error::Argument;
use geograd::kernels::dynamic::{Rows, operation};
use geograd::kernels::gpu::Gpu;
use geograd::kernels::{Backend, Cpu, Groups, Iou, Op, Single};
use geograd::suppression::Rules;
use geograd::{Error, Fixed, GpuFault, Obb2, Pack, Unrecordable};
use geograd_tests::list;
use geograd_tests::rows::{distance, iou, overlap};

/// Offsets of groups of such sizes.
fn offsets(sizes: &[[usize; 2]], k: usize) -> Vec<usize> {
    let mut offsets = vec![0];
    for size in sizes {
        offsets.push(offsets[offsets.len() - 1] + size[k]);
    }
    offsets
}

/// Empty groups at the ends and between, groups of one, and groups around the sizes of a workgroup.
const UNEVEN: [[usize; 2]; 13] = [
    [0, 0],
    [3, 5],
    [0, 4],
    [2, 0],
    [1, 1],
    [17, 33],
    [64, 2],
    [65, 1],
    [1, 90],
    [0, 0],
    [5, 16],
    [4, 0],
    [0, 3],
];

/// The same, a group longer than a workgroup whose shapes walk through more than a strip, and short ones after it.
fn long() -> Vec<[usize; 2]> {
    let mut sizes = UNEVEN.to_vec();
    sizes.extend([
        [300, 40],
        [30, 2100],
        [2, 3],
        [0, 1],
        [7, 1024],
        [7, 1025],
        [1, 0],
    ]);
    sizes
}

/// Compares grouped calls with the matrix of all pairs, given by slices and by arrays that stay.
fn agree<O, A, B>(gpu: &Gpu, a: &[A], b: &[B], sizes: &[[usize; 2]], threshold: f32)
where
    O: Op<In<f32> = (A, B), Out<f32> = f32>,
    A: Single<Scalar = f32>,
    B: Single<Scalar = f32>,
{
    let (run, name) = (O::default(), O::DECLARED.name);
    let all = [0, 1].map(|k| offsets(sizes, k));
    let groups = Groups::new(&all[0], &all[1]);
    let columns = b.len();
    let values = gpu.all_pairs(run, a, b).unwrap().into_planes();

    let found = gpu.above_grouped(run, a, b, groups, threshold).unwrap();
    assert!(
        found.is_sorted_by(|x, y| (x.row, x.column) < (y.row, y.column)),
        "{name}"
    );
    let mut rest = found.iter().peekable();
    let mut above = 0;
    for g in 0..sizes.len() {
        for row in all[0][g]..all[0][g + 1] {
            for column in all[1][g]..all[1][g + 1] {
                let value = values[row * columns + column];
                match rest.next_if(|pair| (pair.row, pair.column) == (row, column)) {
                    Some(pair) => {
                        assert!(pair.value > threshold && close(pair.value, value), "{name}");
                        above += 1;
                    }
                    None => assert!(value <= threshold || close(value, threshold), "{name}"),
                }
            }
        }
    }
    assert_eq!(rest.next(), None, "{name}: of another group");
    assert!(above > 10, "{name}: {above} pairs");

    let by_rows = gpu.row_max_grouped(run, a, b, groups).unwrap();
    let by_columns = gpu.column_max_grouped(run, a, b, groups).unwrap();
    assert_eq!(
        (by_rows.len(), by_columns.len()),
        (a.len(), b.len()),
        "{name}"
    );
    for g in 0..sizes.len() {
        let [rows, others] = [0, 1].map(|k| all[k][g]..all[k][g + 1]);
        let value = |row: usize, column: usize| values[row * columns + column];
        let check = |own: usize,
                     found: Option<geograd::kernels::reduce::Best>,
                     of: &[f32],
                     first: usize| {
            let most = of.iter().copied().fold(f32::NEG_INFINITY, f32::max);
            let Some(best) = found else {
                assert!(of.is_empty(), "{name} {own}");
                return;
            };
            let there = of[best.index - first];
            assert!(
                close(best.value, most) && close(there, most),
                "{name} {own}: {best:?}"
            );
            // Of several the first.
            let earlier = of[..best.index - first]
                .iter()
                .all(|&x| x < best.value || close(x, most));
            assert!(earlier, "{name} {own}");
            if of.iter().all(|&x| x == 0.0) {
                assert_eq!(best.index, first, "{name} {own}");
            }
        };
        for row in rows.clone() {
            let own: Vec<f32> = others.clone().map(|column| value(row, column)).collect();
            check(row, by_rows[row], &own, others.start);
        }
        for column in others {
            let own: Vec<f32> = rows.clone().map(|row| value(row, column)).collect();
            check(column, by_columns[column], &own, rows.start);
        }
    }

    let (on_a, on_b) = (gpu.upload(a).unwrap(), gpu.upload(b).unwrap());
    let held = gpu
        .above_grouped(run, &on_a, &on_b, groups, threshold)
        .unwrap();
    assert_eq!(held, found, "{name}: the same bits");
    let held = gpu.row_max_grouped(run, &on_a, b, groups).unwrap();
    assert_eq!(held, by_rows, "{name}: the same bits");
    let held = gpu.column_max_grouped(run, a, &on_b, groups).unwrap();
    assert_eq!(held, by_columns, "{name}: the same bits");
}

fn drawn<A: crate::shapes::Draw>(count: usize, seed: u64) -> Vec<A> {
    let mut draws = Draws(seed);
    (0..count).map(|_| A::draw(&mut draws)).collect()
}

/// A score of two boxes, in large buffers and in such that everything is split.
fn boxes_agree<O: Score>() {
    let Some((_turn, gpu)) = gpu() else { return };
    for (gpu, sizes) in [(gpu, long()), (&small(), UNEVEN.to_vec())] {
        let counts = [0, 1].map(|k| offsets(&sizes, k)[sizes.len()]);
        let (a, b) = (
            drawn::<O::Shape>(counts[0], 3),
            drawn::<O::Shape>(counts[1], 4),
        );
        agree::<O, _, _>(gpu, &a, &b, &sizes, 0.2);
    }
}

#[test]
fn by_hand() {
    boxes_agree::<overlap::IouObb2>();
    boxes_agree::<overlap::IouAabb2>();
    boxes_agree::<overlap::IofObb2>();
}

#[test]
fn generated() {
    boxes_agree::<iou::GiouObb2>();
    boxes_agree::<distance::DistanceObb2>();
    // Thin boxes, of which products of numbers over- and underflow.
    let Some((_turn, gpu)) = gpu() else { return };
    let mut a = drawn::<Obb2<f32>>(60, 5);
    for thin in a.iter_mut().step_by(7) {
        thin.size.x *= 1e18;
        thin.center.y *= 1e-20;
    }
    let sizes = [[10, 12]; 6];
    let b = drawn::<Obb2<f32>>(72, 6);
    agree::<overlap::IouObb2, _, _>(gpu, &a, &b, &sizes, 0.05);
}

/// Rows by name, of two shapes that differ, of shapes of space, and without a range.
#[test]
fn by_name() {
    let Some((_turn, gpu)) = gpu() else { return };
    let on = Backend::Gpu(gpu);
    let sizes = UNEVEN;
    let all = [0, 1].map(|k| offsets(&sizes, k));
    let groups = Groups::new(&all[0], &all[1]);
    for name in [
        "iou_obb2",
        "distance_point_obb2",
        "iou_yaw",
        "wasserstein_obb2",
    ] {
        let rows = list::rows();
        let row = rows.iter().find(|row| row.name() == name).expect(name);
        let items = list::inputs::<f32>(row, 180, |draw| row.ordinary(draw));
        let columns = list::columns(row, &items);
        let run = operation(name)
            .and_then(|row| row.value::<f32>())
            .expect(name);
        let fields: Vec<usize> = run
            .takes()
            .iter()
            .map(|(_, layout)| layout.fields())
            .collect();
        let lent = |k: usize| {
            let count = all[k][sizes.len()];
            Rows::new(&columns[k][..count * fields[k]], fields[k])
        };
        let (a, b) = (lent(0), lent(1));
        for of_rows in [true, false] {
            let (found, expected) = match of_rows {
                true => (
                    run.on(on).unwrap().row_max_grouped(a, b, groups),
                    run.row_max_grouped(a, b, groups),
                ),
                false => (
                    run.on(on).unwrap().column_max_grouped(a, b, groups),
                    run.column_max_grouped(a, b, groups),
                ),
            };
            let (found, expected) = (found.unwrap(), expected.unwrap());
            assert_eq!(found.len(), expected.len(), "{name}");
            let mut far = 0;
            for (found, expected) in found.iter().zip(&expected) {
                assert_eq!(found.is_some(), expected.is_some(), "{name}");
                let Some((found, expected)) = found.zip(*expected) else {
                    continue;
                };
                let off = (found.value - expected.value).abs();
                far += usize::from(off > 1e-3 * (1.0 + expected.value.abs()));
            }
            assert!(200 * far <= found.len(), "{name}: {far}");
        }
        // Fields that lie apart are the same rows.
        let numbers = a.numbers();
        let lane = |k: usize| numbers.iter().skip(k).step_by(fields[0]).copied().collect();
        let lanes: Vec<Vec<f32>> = (0..fields[0]).map(lane).collect();
        let lanes: Vec<&[f32]> = lanes.iter().map(Vec::as_slice).collect();
        assert_eq!(
            run.on(on)
                .unwrap()
                .row_max_grouped(Rows::apart(&lanes), b, groups),
            run.on(on).unwrap().row_max_grouped(a, b, groups),
            "{name}"
        );
        assert_eq!(
            run.on(on)
                .unwrap()
                .aligned(&[Rows::apart(&lanes), Rows::one(&b.numbers()[..fields[1]])]),
            run.on(on)
                .unwrap()
                .aligned(&[a, Rows::one(&b.numbers()[..fields[1]])]),
            "{name}"
        );
        // A threshold between two results: the very pairs of the processor.
        let mut scores: Vec<f32> = run
            .above_grouped(a, b, groups, -1e9)
            .unwrap()
            .iter()
            .map(|x| x.value)
            .collect();
        scores.sort_by(f32::total_cmp);
        let gap = |k: usize| scores[k + 1] - scores[k];
        let widest =
            (scores.len() / 4..3 * scores.len() / 4).max_by(|&i, &j| gap(i).total_cmp(&gap(j)));
        let k = widest.expect(name);
        let threshold = scores[k] + 0.5 * gap(k);
        let found = run
            .on(on)
            .unwrap()
            .above_grouped(a, b, groups, threshold)
            .unwrap();
        let expected = run.above_grouped(a, b, groups, threshold).unwrap();
        let places = |all: &[geograd::kernels::reduce::Found]| -> Vec<_> {
            all.iter().map(|pair| (pair.row, pair.column)).collect()
        };
        assert_eq!(places(&found), places(&expected), "{name}");
        assert!(found.len() > 10, "{name}");
    }
}

#[test]
fn faults_are_those_of_the_processor() {
    let Some((_turn, gpu)) = gpu() else { return };
    let (a, b) = (drawn::<Obb2<f32>>(4, 1), drawn::<Obb2<f32>>(3, 2));
    let cpu = Backend::Cpu;
    for (x, y) in [
        (&[][..], &[0, 3][..]),
        (&[1, 4], &[0, 3]),
        (&[0, 3], &[0, 3]),
        (&[0, 5], &[0, 3]),
        (&[0, 3, 2, 4], &[0, 1, 2, 3]),
        (&[0, 4], &[0, 2]),
        (&[0, 4], &[0, 2, 3]),
    ] {
        let groups = Groups::new(x, y);
        let error = gpu.above_grouped(Iou, &a, &b, groups, 0.5).unwrap_err();
        assert_eq!(cpu.above_grouped(Iou, &a, &b, groups, 0.5), Err(error));
        assert_eq!(gpu.row_max_grouped(Iou, &a, &b, groups), Err(error));
        assert_eq!(gpu.column_max_grouped(Iou, &a, &b, groups), Err(error));
    }
    let groups = Groups::new(&[0, 1, 4], &[0, 2, 3]);
    let error = gpu
        .above_grouped(Iou, &a, &b, groups, f32::NAN)
        .unwrap_err();
    assert_eq!(
        cpu.above_grouped(Iou, &a, &b, groups, f32::NAN)
            .unwrap_err(),
        error
    );
    let mut bad = a.clone();
    bad[2].size.x = -1.0;
    let error = gpu.row_max_grouped(Iou, &bad, &b, groups).unwrap_err();
    assert_eq!(cpu.row_max_grouped(Iou, &bad, &b, groups), Err(error));
    assert!(matches!(
        error,
        Error::Invalid {
            argument: Argument::A,
            item: 2,
            ..
        }
    ));
    let foreign = small().upload(&b).unwrap();
    assert_eq!(
        gpu.row_max_grouped(Iou, &a, &foreign, groups),
        Err(Error::Gpu(GpuFault::ForeignBuffer))
    );
    // Nothing of nothing; searches have no kernel.
    let none: [Obb2<f32>; 0] = [];
    let nothing = Groups::new(&[0], &[0]);
    assert_eq!(
        gpu.above_grouped(Iou, &none, &none, nothing, 0.5),
        Ok(Vec::new())
    );
    assert_eq!(
        gpu.row_max_grouped(Iou, &none, &none, nothing),
        Ok(Vec::new())
    );
    let alone = Groups::new(&[0, 4, 4], &[0, 0, 0]);
    assert_eq!(
        gpu.row_max_grouped(Iou, &a, &none, alone),
        Ok(vec![None; 4])
    );
    assert_eq!(
        gpu.above_grouped(Iou, &a, &none, alone, -1.0),
        Ok(Vec::new())
    );
    let polygons = operation("iou_polygons")
        .and_then(|row| row.value::<f32>())
        .expect("is listed");
    let polygon = vec![0.0; polygons.takes()[0].1.fields()];
    let one = Rows::new(&polygon, polygon.len());
    let refused = polygons.on(Backend::Gpu(gpu)).unwrap().row_max_grouped(
        one,
        one,
        Groups::new(&[0, 1], &[0, 1]),
    );
    assert_eq!(refused, Err(Error::Program(Unrecordable::Search)));
}

/// Suppression within groups keeps the shapes that the processor keeps, by types and by name, of classes and at most so many.
#[test]
fn suppression_keeps_what_the_processor_keeps() {
    let Some((_turn, gpu)) = gpu() else { return };
    let sizes = [0, 40, 1, 0, 150, 7].map(|own| [own, own]);
    let offsets = offsets(&sizes, 0);
    let count = offsets[offsets.len() - 1];
    let shapes = drawn::<Obb2<f32>>(count, 5);
    let scores: Vec<f32> = (0..count)
        .map(|i| ((i * 37) % 101) as f32 / 101.0)
        .collect();
    let classes: Vec<u32> = (0..count).map(|i| (i % 3) as u32).collect();
    let cpu = Cpu::new();
    let plain = Rules::above(0.1);
    let by_class = Rules {
        classes: Some(&classes),
        most: 4,
        score: 0.2,
        ..plain
    };
    for rules in [plain, by_class] {
        let expected = cpu
            .suppress_grouped(Iou, &shapes, &offsets, &scores, rules)
            .unwrap();
        assert!(expected.len() > 5 && expected.len() < count);
        let found = gpu.suppress_grouped(Iou, &shapes, &offsets, &scores, rules);
        assert_eq!(found.as_ref(), Ok(&expected));
        let run = operation("iou_obb2")
            .and_then(|row| row.value::<f32>())
            .expect("is listed");
        let numbers = shapes.scalars();
        let rows = Rows::new(&numbers, Obb2::<f32>::LEN);
        let run = run.on(Backend::Gpu(gpu)).unwrap();
        assert_eq!(run.suppress(rows, &offsets, &scores, rules), Ok(expected));
    }
    let offsets = [0, count + 1];
    let fault = gpu.suppress_grouped(Iou, &shapes, &offsets, &scores, plain);
    assert_eq!(
        fault,
        cpu.suppress_grouped(Iou, &shapes, &offsets, &scores, plain)
    );
    // A GPU has no double precision.
    let double = operation("iou_obb2").and_then(|row| row.value::<f64>());
    let refused = double.expect("is listed").on(Backend::Gpu(gpu)).map(drop);
    assert_eq!(refused, Err(Error::Gpu(GpuFault::OnlySingle)));
}

/// The name of an argument in messages is the row's.
#[test]
fn messages_name_arguments() {
    let Some((_turn, gpu)) = gpu() else { return };
    let run = operation("distance_point_obb2")
        .and_then(|row| row.value::<f32>())
        .expect("is listed");
    let (points, boxes) = ([0.0; 4], drawn::<Obb2<f32>>(1, 1).scalars());
    let (a, b) = (Rows::new(&points, 2), Rows::new(&boxes, Obb2::<f32>::LEN));
    let groups = Groups::new(&[0, 1], &[0, 1]);
    let error = run
        .on(Backend::Gpu(gpu))
        .unwrap()
        .row_max_grouped(a, b, groups)
        .unwrap_err();
    assert_eq!(run.row_max_grouped(a, b, groups), Err(error));
    assert_eq!(
        error.to_string(),
        "groups of `point`: offset 1: offsets go from 0 to the number of items and never decrease"
    );
}
