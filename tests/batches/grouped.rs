//! Groups of two lists: the bits of a call per group, for every row of two shapes and one number.

use geograd::error::{Argument, Error};
use geograd::kernels::dynamic::{Function, Rows};
use geograd::kernels::reduce::{Best, Found};
use geograd::kernels::{Cpu, Groups, Iou};
use geograd::suppression::Rules;
use geograd::{Obb2, Obb3, Pack, Real, Rotation3, Vec3};
use geograd_tests::Dice;
use geograd_tests::list::{self, Tested};

/// Lists of numbers of both arguments, with the offsets of their groups.
struct Lists<T> {
    numbers: [Vec<T>; 2],
    fields: [usize; 2],
    offsets: [Vec<usize>; 2],
}

impl<T: Real> Lists<T> {
    fn rows(&self, k: usize) -> Rows<'_, T> {
        Rows::new(&self.numbers[k], self.fields[k])
    }
    fn groups(&self) -> Groups<'_> {
        Groups::new(&self.offsets[0], &self.offsets[1])
    }
    fn of_group(&self, k: usize, group: usize) -> Rows<'_, T> {
        let at = |g: usize| self.offsets[k][g] * self.fields[k];
        Rows::new(&self.numbers[k][at(group)..at(group + 1)], self.fields[k])
    }
    fn count(&self) -> usize {
        self.offsets[0].len() - 1
    }
}

fn same_bits<T: Real + Into<f64>>(x: T, y: T) -> bool {
    let bits = |x: T| (x.into() + 0.0).to_bits();
    bits(x) == bits(y)
}

/// Compares grouped calls with a call per group.
fn agrees<T: Real + Into<f64>>(
    name: &str,
    of: &Function<T>,
    lists: &Lists<T>,
    thresholds: [f64; 3],
) {
    let (a, b, groups) = (lists.rows(0), lists.rows(1), lists.groups());
    for threshold in thresholds.map(T::lit) {
        let all = of.above_grouped(a, b, groups, threshold).expect(name);
        let mut expected = Vec::new();
        for g in 0..lists.count() {
            let own = of
                .above(lists.of_group(0, g), lists.of_group(1, g), threshold)
                .expect(name);
            expected.extend(own.into_iter().map(|pair| Found {
                row: pair.row + lists.offsets[0][g],
                column: pair.column + lists.offsets[1][g],
                ..pair
            }));
        }
        assert_eq!(all.len(), expected.len(), "{name}");
        for (own, wanted) in all.iter().zip(&expected) {
            assert_eq!((own.row, own.column), (wanted.row, wanted.column), "{name}");
            assert!(same_bits(own.value, wanted.value), "{name}");
        }
    }
    for of_rows in [true, false] {
        let (side, all) = match of_rows {
            true => (0, of.row_max_grouped(a, b, groups).expect(name)),
            false => (1, of.column_max_grouped(a, b, groups).expect(name)),
        };
        for g in 0..lists.count() {
            let own = &all[lists.offsets[side][g]..lists.offsets[side][g + 1]];
            let (a, b) = (lists.of_group(0, g), lists.of_group(1, g));
            if [a, b][1 - side].count() == Some(0) {
                assert!(own.iter().all(Option::is_none), "{name}");
                continue;
            }
            let wanted = match of_rows {
                true => of.row_max(a, b).expect(name),
                false => of.column_max(a, b).expect(name),
            };
            for (own, Best { value, index }) in own.iter().zip(wanted) {
                let own = own.expect(name);
                assert_eq!(own.index, index + lists.offsets[1 - side][g], "{name}");
                assert!(same_bits(own.value, value), "{name}");
            }
        }
    }
}

/// Groups of such sizes, of random inputs of a row: of every size, and near each other.
fn drawn<T: Real>(row: &Tested, sizes: &[[usize; 2]]) -> Lists<T> {
    let mut is_ordinary = false;
    let items = list::inputs::<T>(row, 180, |draw| {
        is_ordinary = !is_ordinary;
        match is_ordinary {
            true => row.ordinary(draw),
            false => row.random(draw),
        }
    });
    let columns = list::columns(row, &items);
    let fields = [0, 1].map(|k| columns[k].len() / items.len());
    let mut lists = Lists {
        numbers: [Vec::new(), Vec::new()],
        fields,
        offsets: [0, 1].map(|k| offsets(sizes, k)),
    };
    for k in 0..2 {
        for i in 0..lists.offsets[k][sizes.len()] {
            let at = i % items.len() * fields[k];
            lists.numbers[k].extend_from_slice(&columns[k][at..at + fields[k]]);
        }
    }
    lists
}

const UNEVEN: [[usize; 2]; 10] = [
    [0, 0],
    [3, 5],
    [0, 4],
    [2, 0],
    [1, 1],
    [17, 33],
    [40, 2],
    [1, 90],
    [0, 0],
    [5, 16],
];

#[test]
fn every_row_has_the_bits_of_a_call_per_group() {
    fn of<T: Real + Into<f64>>() {
        let mut rows = 0;
        for row in list::sample(list::rows(), &[]) {
            let Some(function) = row.operation.value::<T>() else {
                continue;
            };
            if function.takes().len() != 2 || function.gives() != [1] {
                continue;
            }
            let lists = drawn(row, &UNEVEN);
            agrees(row.name(), &function, &lists, [-0.5, 0.0, 0.3]);
            rows += 1;
        }
        assert!(rows == 1 || rows > 5, "{rows} rows");
    }
    of::<f32>();
    of::<f64>();
}

fn boxes(count: usize, seed: u64) -> Vec<Obb2<f32>> {
    let mut dice = Dice(seed);
    (0..count).map(|_| dice.obb().cast()).collect()
}

fn numbers(boxes: &[Obb2<f32>]) -> Vec<f32> {
    boxes.iter().flat_map(|b| b.scalars()).collect()
}

/// Sizes around tiles, blocks of pairs, pieces of work and the use of a tree, large groups among small ones.
fn long() -> Vec<[usize; 2]> {
    let mut sizes = vec![
        [3, 5],
        [30, 511],
        [2, 700],
        [0, 600],
        [1, 2000],
        [9, 0],
        [4000, 70],
    ];
    let mut dice = Dice(3);
    sizes.extend((0..400).map(|_| [dice.below(40), dice.below(40)]));
    sizes.push([700, 520]);
    sizes.push([0, 0]);
    sizes
}

fn offsets(sizes: &[[usize; 2]], k: usize) -> Vec<usize> {
    let mut offsets = vec![0];
    for size in sizes {
        offsets.push(offsets[offsets.len() - 1] + size[k]);
    }
    offsets
}

#[test]
fn large_and_small_groups_together() {
    let sizes = long();
    let offsets = [0, 1].map(|k| offsets(&sizes, k));
    let counts = [0, 1].map(|k| offsets[k][sizes.len()]);
    let numbers = [0, 1].map(|k| numbers(&boxes(counts[k], k as u64)));
    let lists = Lists {
        numbers,
        fields: [5, 5],
        offsets,
    };
    for name in ["iou_obb2", "distance_obb2"] {
        let Some(operation) = geograd::kernels::dynamic::operation(name) else {
            continue;
        };
        let function = operation.value::<f32>().expect("is of fixed size");
        agrees(name, &function, &lists, [-1.0, 0.0, 0.5]);
    }
    // One group is no group.
    let whole = Lists {
        offsets: [0, 1].map(|k| vec![0, counts[k]]),
        ..lists
    };
    let iou = geograd::kernels::dynamic::operation("iou_obb2").expect("is listed");
    let iou = iou.value::<f32>().expect("is of fixed size");
    let [a, b] = [whole.rows(0), whole.rows(1)];
    let all = iou.above_grouped(a, b, whole.groups(), 0.9);
    assert_eq!(all, iou.above(a, b, 0.9));
}

#[test]
fn boxes_that_are_rare_among_others() {
    let mut all = boxes(300, 5);
    for i in (0..300).step_by(7) {
        all[i].size.x *= 1e18;
        all[i].center.y *= 1e-20;
    }
    let sizes: Vec<[usize; 2]> = (0..30).map(|_| [10, 10]).collect();
    let lists = Lists {
        numbers: [numbers(&all), numbers(&all[..])],
        fields: [5, 5],
        offsets: [0, 1].map(|k| offsets(&sizes, k)),
    };
    let iou = geograd::kernels::dynamic::operation("iou_obb2").expect("is listed");
    let iou = iou.value::<f32>().expect("is of fixed size");
    agrees("iou_obb2", &iou, &lists, [-1.0, 0.0, 0.5]);
}

#[test]
fn suppression_of_groups_is_that_of_every_group() {
    let sizes = long();
    let offsets = offsets(&sizes, 1);
    let count = offsets[sizes.len()];
    let shapes = boxes(count, 8);
    let mut dice = Dice(9);
    // Few scores, so that many are equal.
    let scores: Vec<f32> = (0..count).map(|_| dice.below(50) as f32 * 0.02).collect();
    let classes: Vec<u32> = (0..count).map(|_| dice.below(2) as u32).collect();
    let cpu = Cpu::new();
    for (most, score, own) in [(usize::MAX, 0.0, false), (7, 0.3, true), (0, 0.0, false)] {
        let rules = |span: std::ops::Range<usize>| Rules {
            classes: own.then_some(&classes[span]),
            most,
            score,
            ..Rules::above(0.2)
        };
        let kept = cpu
            .suppress_grouped(Iou, &shapes, &offsets, &scores, rules(0..count))
            .expect("is valid");
        let mut expected = Vec::new();
        for span in offsets.windows(2) {
            let span = span[0]..span[1];
            let own = cpu
                .suppress(
                    Iou,
                    &shapes[span.clone()],
                    &scores[span.clone()],
                    rules(span.clone()),
                )
                .expect("is valid");
            expected.extend(own.into_iter().map(|place| place + span.start));
        }
        assert_eq!(kept, expected);
        let iou = geograd::kernels::dynamic::operation("iou_obb2").expect("is listed");
        let iou = iou.value::<f32>().expect("is of fixed size");
        let numbers = numbers(&shapes);
        let untyped = iou.suppress(Rows::new(&numbers, 5), &offsets, &scores, rules(0..count));
        assert_eq!(untyped.expect("is valid"), expected);
    }
}

#[test]
fn boxes_as_long_as_numbers_go() {
    let side = |size: f64, x: f64| {
        Obb3::new(
            Vec3::new(x, 0.0, 0.0),
            Vec3::new(size, 1.0, 1.0),
            Rotation3::identity(),
        )
    };
    let mut shapes: Vec<Obb3<f64>> = (0..600).map(|k| side(1.0, 3.0 * f64::from(k))).collect();
    shapes[7] = side(1.7e308, 0.0);
    let scores: Vec<f64> = (0..600).map(|k| f64::from(600 - k)).collect();
    let cpu = Cpu::new();
    let kept = cpu
        .suppress(Iou, &shapes, &scores, Rules::above(0.5))
        .unwrap();
    assert_eq!(kept, (0..600).collect::<Vec<_>>());
    let (sum, ..) = cpu.sum_grad(Iou, &shapes, &shapes).unwrap();
    // The long box is outside the range that scores promise.
    assert!((598.99..600.01).contains(&sum), "{sum}");
}

#[cfg(feature = "parallel")]
#[test]
fn same_bits_for_any_number_of_threads() {
    let sizes = long();
    let offsets = [0, 1].map(|k| offsets(&sizes, k));
    let lists = [0, 1].map(|k| boxes(offsets[k][sizes.len()], k as u64));
    let scores: Vec<f32> = lists[1].iter().map(|b| b.center.x).collect();
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let (cpu, [a, b]) = (Cpu::new(), &lists);
            let groups = Groups::new(&offsets[0], &offsets[1]);
            (
                cpu.above_grouped(Iou, a, b, groups, 0.3).unwrap(),
                cpu.row_max_grouped(Iou, a, b, groups).unwrap(),
                cpu.column_max_grouped(Iou, a, b, groups).unwrap(),
                cpu.suppress_grouped(Iou, b, &offsets[1], &scores, Rules::above(0.3))
                    .unwrap(),
            )
        })
    };
    let one = run(1);
    assert!(one == run(3) && one == run(16));
}

#[test]
fn offsets_that_fit_no_list_are_refused() {
    let (a, b) = (boxes(4, 1), boxes(3, 2));
    let cpu = Cpu::new();
    let run = |x: &[usize], y: &[usize]| {
        let groups = Groups::new(x, y);
        let error = cpu.above_grouped(Iou, &a, &b, groups, 0.5).unwrap_err();
        assert_eq!(cpu.row_max_grouped(Iou, &a, &b, groups), Err(error));
        assert_eq!(cpu.column_max_grouped(Iou, &a, &b, groups), Err(error));
        error
    };
    let of = |argument, item| Error::GroupsOf { argument, item };
    assert_eq!(run(&[], &[0, 3]), of(Argument::A, 0));
    assert_eq!(run(&[1, 4], &[0, 3]), of(Argument::A, 0));
    assert_eq!(run(&[0, 3], &[0, 3]), of(Argument::A, 1));
    assert_eq!(run(&[0, 5], &[0, 3]), of(Argument::A, 1));
    assert_eq!(run(&[0, 3, 2, 4], &[0, 1, 2, 3]), of(Argument::A, 2));
    assert_eq!(run(&[0, 4], &[0, 2]), of(Argument::B, 1));
    let length = Error::Length {
        argument: Argument::Groups,
        expected: 1,
        found: 2,
    };
    assert_eq!(run(&[0, 4], &[0, 2, 3]), length);
    assert_eq!(
        of(Argument::B, 2).to_string(),
        "groups of `b`: offset 2: offsets go from 0 to the number of items and never decrease"
    );
    let suppressed = cpu.suppress_grouped(Iou, &a, &[0, 3], &[0.5; 4], Rules::above(0.5));
    assert_eq!(suppressed, Err(of(Argument::A, 1)));
    // No groups of no shapes.
    let none: [Obb2<f32>; 0] = [];
    let nothing = cpu.above_grouped(Iou, &none, &none, Groups::new(&[0], &[0]), 0.5);
    assert_eq!(nothing, Ok(Vec::new()));
}
