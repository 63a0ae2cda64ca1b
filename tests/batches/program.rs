//! Recorded programs in batches: the bits that their operations give one by one on plain numbers, at
//! every level of vector instructions and with all options of their execution.
use crate::bits::Turn;
use geograd::ad::adjoint::overlap::iou_obb2_grad;
use geograd::ad::program::{Program, Sym};
use geograd::kernels::cpu::program::Skipping;
use geograd::kernels::cpu::program::measured::{Execution, Ready, Trial};
use geograd::kernels::cpu::simd::Simd;
use geograd::overlap::iou_obb2;
use geograd::{Fixed, Obb2, Pack, Real, Scalar};
use geograd_tests::Dice;

/// Numbers of each argument of a random function, and of its result.
const FIELDS: [usize; 3] = [3, 2, 1];
const INPUTS: usize = 6;
const OUTPUTS: usize = 4;

/// A straight line of operations that depend on the seed alone.
fn line<S: Scalar>(seed: u64, steps: usize, inputs: &[S]) -> [S; OUTPUTS] {
    let mut dice = Dice(seed);
    let mut numbers = inputs.to_vec();
    numbers.extend([0.0, 1.0, -0.5, 2.0, 1e-3].map(S::lit));
    let mut masks = vec![inputs[0].below(S::zero()), inputs[3].at_most(inputs[4])];
    for _ in 0..steps {
        // Mostly of what came last, for trees to grow.
        let recent = |dice: &mut Dice, count: usize| match dice.below(3) {
            0 => dice.below(count),
            _ => count - 1 - dice.below(count.min(6)),
        };
        let mut number = || numbers[recent(&mut dice, numbers.len())];
        let [x, y, z, w] = [(); 4].map(|()| number());
        let mut mask = || masks[recent(&mut dice, masks.len())];
        let (m, n) = (mask(), mask());
        let made = match dice.below(52) {
            0 => x * y + z * x,
            1..=4 => x + y,
            5 => x * y - z * y,
            6..=9 => x - y,
            10..=16 => x * y,
            17 => x.over(y),
            18 => x.least(y),
            19 => x.least(y.most(z)),
            20 => x.most(y),
            21 => x.most(y.least(z)),
            22 => x.clamp(y, z),
            23 => x.magnitude(),
            24 => x.unsigned(),
            25 => x.root(),
            26 => x.sin(),
            27 => x.cos(),
            28 => {
                let [(a, b), (c, d)] = x.sin_cos_parts();
                numbers.extend([a, b, c]);
                d
            }
            29 => x.atan2(y),
            30 => x.saturated().least(S::lit(20.0)).exp(),
            31 => x.magnitude().ln(),
            32 => x.magnitude().binade(),
            33 => x.parts().0,
            34 => x.canonical(),
            35 => -x,
            36 => x.with_primal(y.primal()).damp(z.primal()),
            37..=40 => S::select(m, x, y),
            41 => {
                numbers.push(y * z - x * w);
                x * z + w * y
            }
            42 => {
                numbers.push(x + y);
                x - y
            }
            43 => match dice.below(3) {
                0 => w.most(z.least(x * y)),
                1 => w.most(z.least(-x)),
                _ => w.most(x * y + z),
            },
            44 => (x - y) * (z + w),
            45 => (x - y) + (z - w),
            46 => S::select(x.below(y), -z, w),
            _ => {
                masks.push(match dice.below(10) {
                    0 => x.below(y),
                    1 => x.at_most(y),
                    2 => x.equals(y),
                    3 => x.below(y) & m,
                    4 => x.at_most(y) & m,
                    5 => m & x.equals(y),
                    6 => x.equals(y) | m,
                    7 => x.below(y) | (m & n),
                    8 => x.at_most(y) | (m & !n),
                    _ => m | !n,
                });
                continue;
            }
        };
        numbers.push(made);
    }
    // Only some items need the chains: the second also where the first is needed, the third by truths that follow from
    // two others.
    let chain = |from: usize| {
        let mut x = numbers[numbers.len() - 1 - from];
        for k in 0..14 {
            let y = numbers[(from + 5 * k) % numbers.len()];
            x = if k % 3 == 0 {
                x.least(y) - y * x
            } else {
                x * y + y
            };
        }
        x
    };
    let [m, n] = [0, 1].map(|k| masks[(dice.below(2) + k) % masks.len()]);
    if seed.is_multiple_of(2) {
        // Only some items need the product.
        let costly = numbers[numbers.len() - 1] * numbers[numbers.len() - 2];
        return outputs(S::select(m, S::one(), costly), &numbers, steps, &mut dice);
    }
    let first = S::select(m, S::one(), chain(0));
    let second = S::select(m | !n, first, chain(1) * first);
    let both = chain(3).below(S::zero()) & chain(4).below(S::one());
    let either = n | both;
    let third = S::select(either, S::select(n, chain(2), second), second);
    outputs(third, &numbers, steps, &mut dice)
}

/// Returns the first result, and some of the last numbers.
fn outputs<S: Scalar>(first: S, numbers: &[S], steps: usize, dice: &mut Dice) -> [S; OUTPUTS] {
    let mut result = [first; OUTPUTS];
    for number in &mut result[1..] {
        *number = numbers[numbers.len() - 1 - dice.below(steps / 4)];
    }
    result
}

/// Equal bits, or both NaN.
#[track_caller]
fn same<T: Real>(expected: &[T], found: &[T], about: impl Fn() -> String) {
    assert_eq!(expected.len(), found.len(), "{}", about());
    for (i, (x, y)) in expected.iter().zip(found).enumerate() {
        let (x, y) = (x.widen(), y.widen());
        let equal = x.to_bits() == y.to_bits() || (x.is_nan() && y.is_nan());
        assert!(equal, "{}: number {i} is {y:e}, not {x:e}", about());
    }
}

const fn execution(frames: bool, skipping: bool, width: Option<usize>, native: bool) -> Execution {
    Execution {
        frames,
        skipping: if skipping {
            Skipping::Any
        } else {
            Skipping::Never
        },
        width,
        native,
    }
}

/// Interpreted and as machine code.
const EXECUTIONS: [Execution; 8] = [
    execution(false, false, None, false),
    execution(true, false, None, false),
    execution(false, true, None, false),
    execution(false, true, Some(4), false),
    execution(true, true, Some(8), false),
    execution(false, false, None, true),
    execution(true, true, None, true),
    execution(false, true, Some(4), true),
];

/// The number of executions that may skip nodes.
const SKIPPING: usize = 5;

/// Compares a program, with all options and at every level, with its results item by item. An argument of one
/// row stands for all.
fn compare<T: Real>(
    trial: &Trial,
    fields: &[usize],
    rows: &[Vec<T>],
    count: usize,
    about: &str,
) -> String {
    let mut expected = Vec::new();
    for i in 0..count {
        let mut input = Vec::new();
        for (rows, &fields) in rows.iter().zip(fields) {
            let i = if rows.len() == fields { 0 } else { i };
            input.extend_from_slice(&rows[i * fields..][..fields]);
        }
        expected.extend(trial.run(&input));
    }
    let mut listings = String::new();
    for execution in EXECUTIONS {
        let ready = trial.ready(fields, execution).unwrap();
        listings += &ready.listing();
        for level in Simd::available() {
            Simd::limit(Some(level)).unwrap();
            let found = computed(&ready, rows, count);
            same(&expected, &found, || {
                format!("{about}, {execution:?}, {level:?}")
            });
        }
    }
    for execution in EXECUTIONS.into_iter().filter(|execution| !execution.frames) {
        in_columns(trial, execution, fields, rows, &expected, about);
    }
    listings
}

/// The same from a column for every number to one for every result, none of which begins at a vector's border.
fn in_columns<T: Real>(
    trial: &Trial,
    execution: Execution,
    fields: &[usize],
    rows: &[Vec<T>],
    expected: &[T],
    about: &str,
) {
    let mut columns: Vec<Vec<T>> = Vec::new();
    for (rows, &fields) in rows.iter().zip(fields) {
        for k in 0..fields {
            let numbers = rows.iter().skip(k).step_by(fields).copied();
            columns.push(std::iter::once(T::default()).chain(numbers).collect());
        }
    }
    let columns: Vec<&[T]> = columns.iter().map(|column| &column[1..]).collect();
    let ready = trial.ready(&vec![1; columns.len()], execution).unwrap();
    let results = trial.run(&vec![T::default(); columns.len()]).len();
    let count = expected.len() / results;
    for level in Simd::available() {
        Simd::limit(Some(level)).unwrap();
        for (k, found) in ready.columns(count, &columns).iter().enumerate() {
            let own: Vec<T> = expected.iter().skip(k).step_by(results).copied().collect();
            same(&own, found, || {
                format!("{about}, column {k}, {execution:?}, {level:?}")
            });
        }
    }
}

fn computed<T: Real>(ready: &Ready, rows: &[Vec<T>], count: usize) -> Vec<T> {
    let items: Vec<_> = rows
        .iter()
        .enumerate()
        .map(|(k, rows)| ready.items(k, rows))
        .collect();
    // Twice, since its slots are kept.
    let _ = ready.compute(count, &items);
    ready.compute(count, &items)
}

/// Numbers of all kinds; of the first field the sign changes every 64 items.
fn rows<T: Real>(dice: &mut Dice, count: usize, fields: usize) -> Vec<T> {
    (0..count * fields)
        .map(|i| {
            let x = dice.within(-4.0, 4.0);
            let x = match dice.below(6) {
                0 => x.trunc(),
                1 => x * 1e3,
                2 => x * 1e-6,
                _ => x,
            };
            T::lit(match i % fields {
                0 if (i / fields / 64).is_multiple_of(2) => x.abs(),
                0 => -x.abs(),
                _ => x,
            })
        })
        .collect()
}

fn random_lines<T: Real>() {
    let _turn = Turn::take();
    let (mut listings, mut several) = (String::new(), 0);
    for seed in 0..100 {
        // Now and then more values at a time than there are registers.
        let steps = match seed % 10 {
            9 => 400,
            _ => 20 + 8 * (seed as usize % 12),
        };
        let program = Program::trace(|inputs: [Sym<T>; INPUTS]| line(seed, steps, &inputs));
        let trial = Trial::of(&program.unwrap());
        let mut dice = Dice(seed + 1000);
        // The last argument is one for all every third time; a few batches have two blocks.
        let count = if seed % 10 == 0 {
            1537
        } else {
            1 + dice.below(300)
        };
        let counts = [count, count, if seed % 3 == 0 { 1 } else { count }];
        let rows = [0, 1, 2].map(|k| rows::<T>(&mut dice, counts[k], FIELDS[k]));
        let about = format!("seed {seed}");
        let own = compare(&trial, &FIELDS, &rows, count, &about);
        several += usize::from(own.matches("\nSkipIf").count() >= 2 * SKIPPING);
        listings += &own;
    }
    assert!(several > 15, "{several} programs have several conditions");
    // Each instruction has been there.
    for name in [
        "Neg",
        "Magnitude",
        "Root",
        "Binade",
        "High",
        "Exp",
        "Ln",
        "Not",
        "Add",
        "Sub",
        "Mul",
        "Div",
        "Min",
        "Max",
        "Atan2",
        "Lt",
        "Le",
        "Eq",
        "And",
        "Or",
        "Select",
        "AddAdd",
        "SubAdd",
        "MulAdd",
        "AddSub",
        "SubSub",
        "MulSub",
        "FromAdd",
        "FromSub",
        "FromMul",
        "AddMul",
        "SubMul",
        "MulMul",
        "MaxMin",
        "MinMax",
        "MinFrom",
        "MaxFrom",
        "Dot",
        "Cross",
        "SelectNeg",
        "SelectLt",
        "SelectLe",
        "SelectEq",
        "LtAnd",
        "LeAnd",
        "EqAnd",
        "LtOr",
        "LeOr",
        "EqOr",
        "Parts",
        "SinCos",
        "SkipIfAll",
        "SkipIfNone",
        "Turn",
        "SumSub",
        "MaxFromMul",
        "MaxFromNeg",
        "MaxMulAdd",
        "SubByAdd",
        "SubAndSub",
        "SelectNegLt",
        "SelectMul",
        "ElseMul",
        "SelectAdd",
        "MagnitudeMax",
        "MaxMagnitude",
        "AndNot",
    ] {
        assert!(
            listings.contains(&format!("\n{name} [")),
            "no {name} in any line"
        );
    }
}

#[test]
fn random_lines_have_the_same_bits_in_single_precision() {
    random_lines::<f32>();
}

#[test]
fn random_lines_have_the_same_bits_in_double_precision() {
    random_lines::<f64>();
}

fn boxes<T: Real>(dice: &mut Dice, count: usize) -> Vec<T> {
    let mut rows = Vec::new();
    for i in 0..count {
        let b = dice.obb();
        // Blocks of pairs that are apart, of near ones, and of equal ones.
        let (x, y) = match i / 100 % 3 {
            0 => (0.2 * b.center.x, 0.2 * b.center.y),
            1 => (20.0 * b.center.x, 20.0 * b.center.y),
            _ => (0.0, 0.0),
        };
        let heading = if i % 7 == 0 { 0.0 } else { b.heading };
        let scale = [1.0, 1.0, 1e-15, 1e15, 1.0][i % 5];
        rows.extend(
            [
                x * scale,
                y * scale,
                b.size.x * scale,
                b.size.y * scale,
                heading,
            ]
            .map(T::lit),
        );
    }
    rows
}

fn obb2<S: Scalar>(numbers: &[S]) -> Obb2<S> {
    Obb2::load(numbers)
}

/// The overlap of boxes, with and without its adjoint by hand, has the bits of the function itself.
fn overlap<T: Real>() {
    let _turn = Turn::take();
    let value = Program::trace(|x: [Sym<T>; 10]| iou_obb2(obb2(&x[..5]), obb2(&x[5..])));
    let derivatives = Program::trace(|x: [Sym<T>; 10]| {
        let (value, bars) = iou_obb2_grad(obb2(&x[..5]), obb2(&x[5..]));
        let numbers = [vec![value], bars.0.scalars(), bars.1.scalars()].concat();
        <[Sym<T>; 11]>::load(&numbers)
    });
    let (value, derivatives) = (Trial::of(&value.unwrap()), Trial::of(&derivatives.unwrap()));
    let mut dice = Dice(7);
    let count = 700;
    let mut rows = [boxes::<T>(&mut dice, count), boxes(&mut dice, count)];
    // Equal pairs.
    for i in (0..count).step_by(11) {
        let equal = rows[0][i * 5..i * 5 + 5].to_vec();
        rows[1][i * 5..i * 5 + 5].copy_from_slice(&equal);
    }
    let pairs = || rows[0].chunks(5).zip(rows[1].chunks(5));
    let expected: Vec<T> = pairs().map(|(a, b)| iou_obb2(obb2(a), obb2(b))).collect();
    let expected_derivatives: Vec<T> = pairs()
        .flat_map(|(a, b)| {
            let (value, bars) = iou_obb2_grad(obb2(a), obb2(b));
            [vec![value], bars.0.scalars(), bars.1.scalars()].concat()
        })
        .map(Scalar::canonical)
        .collect();
    for (trial, expected) in [(value, expected), (derivatives, expected_derivatives)] {
        for execution in EXECUTIONS {
            let ready = trial.ready(&[5, 5], execution).unwrap();
            assert_eq!(
                ready.listing().contains("Skip"),
                execution.skipping != Skipping::Never
            );
            for level in Simd::available() {
                Simd::limit(Some(level)).unwrap();
                let found = computed(&ready, &rows, count);
                same(&expected, &found, || format!("{execution:?}, {level:?}"));
            }
        }
    }
}

#[test]
fn the_recorded_overlap_is_the_overlap() {
    overlap::<f32>();
    overlap::<f64>();
}
