//! Cases for programs in other languages: inputs of rows, and the results that the library has for them.
use geograd::ad::sample::Draw;
use geograd::kernels::dynamic::{Layout, Mode, Program, Rows, Sort};
use geograd::{Real, Scalar};
use geograd_tests::list::{self, Tested, are_sampled, columns};

/// Inputs of a row.
const COUNT: usize = 30;

/// The rows whose text has each helper of a language, and some of the longest.
const ALWAYS: &[&str] = &[
    "iou_obb2",
    "giou_obb2",
    "ciou_obb2",
    "iou_obb3",
    "signed_distance_obb2",
    "kullback_leibler_obb2",
];

/// Searches with clipping, with a record, and with a result of several numbers.
const SEARCHES: &[&str] = &[
    "intersection_area_polygons",
    "diameter_of_polygon",
    "circle_around_polygon",
];

/// A program, inputs of it, and their results.
pub struct Case<T: Real> {
    pub name: String,
    pub program: Program<T>,
    pub inputs: Vec<Vec<T>>,
    pub expected: Vec<Vec<T>>,
}

/// Returns items of a batch, of which the results are columns.
fn by_item<T: Real>(results: &[Vec<T>], count: usize) -> Vec<Vec<T>> {
    let item = |i: usize| {
        let own = |column: &Vec<T>| {
            let width = column.len() / count;
            column[i * width..(i + 1) * width].to_vec()
        };
        results.iter().flat_map(own).collect()
    };
    (0..count).map(item).collect()
}

/// Returns the value of a row, and its derivatives: the gradient of one number, of more the adjoint.
pub fn cases<T: Real>(row: &Tested) -> [Case<T>; 2] {
    let (operation, name) = (&row.operation, row.name());
    let program = operation.program::<T>().expect(name);
    let mut hard = row.hard().into_iter().step_by(7).take(COUNT / 2);
    let drawn = |draw: &mut Draw| hard.next().unwrap_or_else(|| row.random(draw));
    let inputs = list::inputs::<T>(row, COUNT, drawn);
    let batch = |mode: Mode, items: &[Vec<T>], widths: &[usize]| {
        let function = operation.function::<T>(mode).expect(name);
        let mut lists = columns(row, items);
        if mode == Mode::Vjp {
            let from = lists.iter().map(|x| x.len() / items.len()).sum::<usize>();
            lists.push(items.iter().flat_map(|x| x[from..].to_vec()).collect());
        }
        let lists = lists.iter().zip(widths);
        let rows: Vec<_> = lists.map(|(list, &width)| Rows::new(list, width)).collect();
        by_item(&function.aligned(&rows).expect(name), items.len())
    };
    let layouts = operation.layouts::<T>();
    let mut widths: Vec<usize> = layouts.iter().map(|x| x.fields()).collect();
    let outputs = list::outputs(row);
    let (derivatives, mode) = match outputs {
        1 => (program.value_grad().expect(name), Mode::ValueGrad),
        _ => (program.vjp().expect(name), Mode::Vjp),
    };
    let value = batch(Mode::Value, &inputs, &widths);
    let mut with_factors = inputs.clone();
    if mode == Mode::Vjp {
        let mut draw = Draw::new(3);
        for item in &mut with_factors {
            item.extend((0..outputs).map(|_| T::lit(draw.within(-2.0, 2.0))));
        }
        widths.push(outputs);
    }
    let expected = batch(mode, &with_factors, &widths);
    [
        Case {
            name: name.to_owned(),
            program,
            inputs,
            expected: value,
        },
        Case {
            name: format!("{name}_derivatives"),
            program: derivatives,
            inputs: with_factors,
            expected,
        },
    ]
}

/// Returns the rows that are straight lines, of which a test takes some.
pub fn straight() -> Vec<&'static Tested> {
    let mut all = list::rows();
    all.retain(|row| row.operation.sort == Sort::Straight);
    let chosen = are_sampled(all.iter().map(|row| row.name()).collect(), ALWAYS);
    // Shapes with whole numbers have no program.
    all.retain(|row| chosen.contains(row.name()) && row.operation.program::<f64>().is_ok());
    all
}

/// Returns the replays of a search at inputs of it, with their derivatives: each program has one input, and the value
/// that the search has for it.
pub fn replays<T: Real>(row: &Tested) -> Vec<Case<T>> {
    let (operation, name) = (&row.operation, row.name());
    let inputs = list::inputs::<T>(row, 3, |draw| row.random(draw));
    let layouts = operation.layouts::<T>();
    let mode = match list::outputs(row) {
        1 => Mode::ValueGrad,
        _ => Mode::Value,
    };
    let function = operation.function::<T>(mode).expect(name);
    let one = |(i, input): (usize, &Vec<T>)| {
        let lists = columns(row, std::slice::from_ref(input));
        let rows = lists.iter().zip(&layouts);
        let rows: Vec<_> = rows.map(|(x, own)| Rows::new(x, own.fields())).collect();
        let found = function.aligned(&rows).expect(name);
        let slices: Vec<&[T]> = lists.iter().map(Vec::as_slice).collect();
        let replay = operation.replay::<T>(&slices).expect(name);
        let program = match mode {
            Mode::ValueGrad => replay.value_grad().expect(name),
            _ => replay,
        };
        // A program takes and gives scalars alone.
        let scalars = |x: &[T], own: &Layout<T>| x[..own.fields() - own.codes()].to_vec();
        let taken = lists.iter().zip(&layouts).map(|(x, own)| scalars(x, own));
        let hints = operation.hints::<T>(&slices).expect(name);
        let taken: Vec<T> = taken.flatten().chain(hints).collect();
        // Derivatives by hand have roundings of their own: those of the replay are the program's.
        let mut expected = program.eval(&taken).expect(name);
        let of_search = found.iter().flatten().copied();
        let values = match mode {
            Mode::ValueGrad => 1,
            _ => expected.len(),
        };
        for (own, searched) in expected.iter_mut().zip(of_search).take(values) {
            *own = searched;
        }
        Case {
            name: format!("{name}_replay_{i}"),
            program,
            inputs: vec![taken],
            expected: vec![expected],
        }
    };
    inputs.iter().enumerate().map(one).collect()
}

/// Returns the searches, of which a test takes some.
pub fn searches() -> Vec<&'static Tested> {
    let mut all = list::rows();
    all.retain(|row| row.operation.sort == Sort::Search);
    let chosen = are_sampled(all.iter().map(|row| row.name()).collect(), SEARCHES);
    all.retain(|row| chosen.contains(row.name()));
    all
}

/// Numbers at the ends of a format, and many between: angles, exponents, subnormal ones.
pub fn numbers<T: Real>() -> Vec<Vec<T>> {
    let mut draw = Draw::new(5);
    let largest = T::format().largest();
    let ends = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        largest,
        1.0 / largest,
        8e5,
        800_000.1,
        1.5e6,
        1e22,
    ];
    let mut all: Vec<Vec<T>> = Vec::new();
    for x in ends {
        all.extend(ends.map(|y| vec![T::lit(x), T::lit(y)]));
        all.extend(ends.map(|y| vec![T::lit(-x), T::lit(y)]));
    }
    let decades = largest.log10();
    for i in 0..4000 {
        let mut number = || {
            let size = match i % 5 {
                0 => draw.within(-1.0, 1.0),
                1 => draw.within(-12.0, 12.0),
                2 => draw.within(-decades, decades),
                // Angles that the digits of 2/π reduce: some near a multiple of a quarter turn.
                3 => return draw.within(5e5, 1e9).floor() * std::f64::consts::FRAC_PI_2,
                _ => return draw.within(-800.0, 800.0),
            };
            10_f64.powf(size) * draw.within(-1.0, 1.0).signum()
        };
        let pair = [number(), number()];
        all.push(pair.map(T::lit).to_vec());
    }
    all
}

/// All functions that a program may call.
pub fn elementary<S: Scalar>([x, y]: [S; 2]) -> [S; 16] {
    let [(sin_high, sin_low), (cos_high, cos_low)] = x.sin_cos_parts();
    let (high, low) = x.parts();
    let (sin, cos) = x.sin_cos();
    [
        sin_high,
        sin_low,
        cos_high,
        cos_low,
        high,
        low,
        sin,
        cos,
        y.atan2(x),
        x.exp(),
        x.ln(),
        x.root(),
        x.magnitude().binade(),
        x.least(y),
        x.most(y),
        x.over(y),
    ]
}
