//! Arguments whose fields lie apart give the bits of rows, for every row of shapes of fixed size.
use geograd::Real;
use geograd::error::Error;
use geograd::kernels::Groups;
use geograd::kernels::dynamic::{Function, Mode, Rows, operation};
use geograd_tests::list;

/// Rows of so many fields, field by field.
fn apart<T: Copy>(rows: &[T], fields: usize) -> Vec<Vec<T>> {
    let lane = |k: usize| rows.iter().skip(k).step_by(fields).copied().collect();
    (0..fields).map(lane).collect()
}

fn bits<T: Into<f64> + Copy>(lists: &[Vec<T>]) -> Vec<u64> {
    let numbers = lists.iter().flatten();
    numbers.map(|&x| (x.into() + 0.0).to_bits()).collect()
}

/// The results of arguments of which some lie apart.
fn of_fields<T: Real>(
    function: &Function<T>,
    columns: &[Vec<T>],
    count: usize,
    is_apart: impl Fn(usize) -> bool,
) -> Result<Vec<Vec<T>>, Error> {
    let sizes: Vec<usize> = function
        .takes()
        .iter()
        .map(|(_, layout)| layout.fields())
        .collect();
    let lanes: Vec<_> = columns
        .iter()
        .zip(&sizes)
        .map(|(own, &fields)| apart(own, fields))
        .collect();
    let slices: Vec<Vec<&[T]>> = lanes
        .iter()
        .map(|own| own.iter().map(Vec::as_slice).collect())
        .collect();
    let arguments: Vec<Rows<'_, T>> = (0..columns.len())
        .map(|k| match is_apart(k) {
            true => Rows::apart(&slices[k]),
            false => Rows::new(&columns[k], sizes[k]),
        })
        .collect();
    let mut lists: Vec<Vec<T>> = function
        .gives()
        .iter()
        .map(|&fields| vec![T::default(); fields * count])
        .collect();
    let mut results: Vec<Option<&mut [T]>> =
        lists.iter_mut().map(|own| Some(&mut own[..])).collect();
    function.aligned_into_new(&arguments, &mut results)?;
    drop(results);
    Ok(lists)
}

fn rows_of<'a, T: Real>(function: &Function<T>, columns: &'a [Vec<T>]) -> Vec<Rows<'a, T>> {
    let takes = function.takes();
    columns
        .iter()
        .zip(&takes)
        .map(|(own, (_, layout))| Rows::new(own, layout.fields()))
        .collect()
}

#[test]
fn every_row_has_the_bits_of_rows() {
    fn of<T: Real + Into<f64>>() {
        let mut rows = 0;
        for row in list::sample(list::rows(), &[]) {
            for mode in [Mode::Value, Mode::ValueGrad] {
                let Some(function) = row.operation.function::<T>(mode) else {
                    continue;
                };
                let items = list::inputs::<T>(row, 40, |draw| row.random(draw));
                let columns = list::columns(row, &items);
                let expected = function
                    .aligned(&rows_of(&function, &columns))
                    .unwrap_or_else(|error| panic!("{}: {error}", row.name()));
                for all in [true, false] {
                    let found = of_fields(&function, &columns, items.len(), |k| all || k == 0);
                    assert_eq!(
                        bits(&found.unwrap_or_else(|error| panic!("{}: {error}", row.name()))),
                        bits(&expected),
                        "{}",
                        row.name()
                    );
                }
                rows += 1;
            }
        }
        assert!(rows <= 2 || rows > 10, "{rows} rows");
    }
    of::<f32>();
    of::<f64>();
}

/// Boxes of which every number differs.
fn boxes(count: usize) -> Vec<f64> {
    let number = |i: usize| match i % 5 {
        2 | 3 => 1.0 + (i as f64 * 0.37).sin().abs(),
        _ => (i as f64 * 0.73).sin(),
    };
    (0..5 * count).map(number).collect()
}

fn iou(mode: Mode) -> Function<f64> {
    let iou = operation("iou_obb2").expect("is listed");
    iou.function::<f64>(mode).expect("is of fixed size")
}

#[test]
fn many_stretches_are_one() {
    for count in [0, 1, 2047, 2048, 2049, 10_000] {
        for mode in [Mode::Value, Mode::ValueGrad] {
            let function = iou(mode);
            let mut columns = vec![boxes(count), boxes(count)];
            columns[1].iter_mut().for_each(|x| *x += 0.1);
            let expected = function
                .aligned(&rows_of(&function, &columns))
                .expect("is valid");
            let found = of_fields(&function, &columns, count, |_| true).expect("is valid");
            assert_eq!(bits(&found), bits(&expected), "{count}");
            let found = of_fields(&function, &columns, count, |k| k == 1).expect("is valid");
            assert_eq!(bits(&found), bits(&expected), "{count}");
        }
    }
    // One row stands for all, and results that nobody wants are left out.
    let (own, function) = (boxes(5000), iou(Mode::ValueGrad));
    let lanes = apart(&own, 5);
    let lanes: Vec<&[f64]> = lanes.iter().map(Vec::as_slice).collect();
    let one = [0.1, 0.2, 1.5, 1.0, 0.3];
    let arguments = [Rows::apart(&lanes), Rows::one(&one)];
    let mut by_second = vec![0.0; 25_000];
    let mut results = [None, None, Some(&mut by_second[..])];
    function
        .aligned_into_new(&arguments, &mut results)
        .expect("is valid");
    let expected = function
        .aligned(&[Rows::new(&own, 5), Rows::one(&one)])
        .expect("is valid");
    assert_eq!(bits(&[by_second]), bits(&expected[2..]));
}

#[test]
fn what_is_wrong_is_named() {
    let function = iou(Mode::Value);
    let good = boxes(6000);
    let mut bad = good.clone();
    bad[5 * 4321 + 2] = -1.0;
    bad[5 * 5000 + 1] = f64::NAN;
    let expected = function.aligned(&rows_of(&function, &[good.clone(), bad.clone()]));
    let found = of_fields(&function, &[good.clone(), bad], 6000, |_| true);
    assert!(
        matches!(found, Err(Error::Invalid { item: 4321, .. })),
        "{found:?}"
    );
    assert_eq!(found, expected);
    // Another number of fields, of items, of arguments, of results.
    let lanes = apart(&good, 5);
    let lanes: Vec<&[f64]> = lanes.iter().map(Vec::as_slice).collect();
    let rows = Rows::new(&good, 5);
    let said = |a: &[&[f64]], count: usize| {
        let mut ious = vec![0.0; count];
        function.aligned_into_new(&[Rows::apart(a), rows], &mut [Some(&mut ious)])
    };
    assert!(matches!(
        said(&lanes[..4], 6000),
        Err(Error::Fields {
            expected: 5,
            found: 4,
            ..
        })
    ));
    let mut short = lanes.clone();
    short[3] = &short[3][..5999];
    assert!(matches!(
        said(&short, 6000),
        Err(Error::Length { found: 5999, .. })
    ));
    let fewer: Vec<&[f64]> = lanes.iter().map(|own| &own[..10]).collect();
    assert!(matches!(said(&fewer, 6000), Err(Error::Length { .. })));
    assert!(matches!(said(&lanes, 5999), Err(Error::Length { .. })));
    assert!(function.aligned_into_new(&[rows], &mut [None]).is_err());
}

/// All pairs and their reductions, groups, losses, results in the caller's memory.
#[test]
fn calls_of_two_lists_have_the_bits_of_rows() {
    fn of<T: Real + Into<f64>>() {
        let mut rows = 0;
        // Columns are read by one code for all: a few rows that cost little will do.
        let rows_of_all = list::rows().into_iter();
        let cheap = rows_of_all.filter(|row| !row.operation.costly);
        for row in cheap.step_by(27) {
            let Some(function) = row.operation.value::<T>() else {
                continue;
            };
            let takes = function.takes();
            if takes.len() != 2 || function.gives() != [1] {
                continue;
            }
            let items = list::inputs::<T>(row, 40, |draw| row.random(draw));
            let columns = list::columns(row, &items);
            let fields: Vec<usize> = takes.iter().map(|(_, layout)| layout.fields()).collect();
            let whole = [0, 1].map(|k| Rows::new(&columns[k], fields[k]));
            let lanes = [0, 1].map(|k| apart(&columns[k], fields[k]));
            let slices = [0, 1].map(|k| lanes[k].iter().map(Vec::as_slice).collect::<Vec<&[T]>>());
            let lent = [0, 1].map(|k| Rows::apart(&slices[k]));
            let name = row.name();
            assert_eq!(
                bits(&[lent[0].numbers().into_owned()]),
                bits(&columns[..1]),
                "{name}"
            );
            let zero = T::default();
            let groups = [0, 7, 7, 30, 40];
            let groups = Groups::new(&groups, &groups);
            let run = |[a, b]: [Rows<'_, T>; 2]| {
                let matrix = function.all_pairs(a, b).expect(name);
                let mut into = vec![zero; matrix.len()];
                function.all_pairs_into(a, b, &mut into).expect(name);
                let mut aligned = vec![zero; 40];
                let results = &mut [Some(&mut aligned[..])];
                function.aligned_into(&[a, b], results).expect(name);
                let found = function.above(a, b, zero).expect(name);
                let grouped = function.above_grouped(a, b, groups, zero).expect(name);
                let best = function.row_max(a, b).expect(name);
                let most = function.column_max_grouped(a, b, groups).expect(name);
                let (_, by_a, by_b) = function.sum_grad(a, b).expect(name);
                let bars = bits(&[by_a, by_b]);
                (
                    bits(&[matrix, into, aligned]),
                    bars,
                    found,
                    grouped,
                    best,
                    most,
                )
            };
            let wanted = run(whole);
            for own in [lent, [lent[0], whole[1]], [whole[0], lent[1]]] {
                assert!(run(own) == wanted, "{name}");
            }
            rows += 1;
        }
        assert!(rows <= 1 || rows > 6, "{rows} rows");
    }
    of::<f32>();
    of::<f64>();
}

/// Shapes that kernels do not serve are computed by themselves, and flaws are named.
#[test]
fn rare_and_flawed_shapes_of_two_lists() {
    let function = iou(Mode::Value);
    let mut own = boxes(3000);
    for i in (0..3000).step_by(97) {
        own[5 * i + 2] = 1e180;
        own[5 * i + 1] = 1e-200;
    }
    let lanes = apart(&own, 5);
    let slices: Vec<&[f64]> = lanes.iter().map(Vec::as_slice).collect();
    let (whole, lent) = (Rows::new(&own, 5), Rows::apart(&slices));
    let few = Rows::new(&own[5 * 90..5 * 110], 5);
    assert_eq!(
        bits(&[function.all_pairs(lent, few).expect("is valid")]),
        bits(&[function.all_pairs(whole, few).expect("is valid")])
    );
    // A rare one of a later stretch is the rare one that it is alone.
    let matrix = function.all_pairs(lent, few).expect("is valid");
    let alone = |row: usize| Rows::new(&own[5 * row..5 * row + 5], 5);
    for row in (0..3000).step_by(97) {
        let wanted = function.all_pairs(alone(row), few).expect("is valid");
        assert_eq!(
            bits(&[matrix[20 * row..20 * row + 20].to_vec()]),
            bits(&[wanted]),
            "{row}"
        );
    }
    let offsets: Vec<usize> = (0..=3000).step_by(10).collect();
    let groups = Groups::new(&offsets, &offsets);
    let found = function.above_grouped(lent, lent, groups, 0.1);
    assert_eq!(found, function.above_grouped(whole, whole, groups, 0.1));
    own[5 * 2500 + 3] = -1.0;
    let lanes = apart(&own, 5);
    let slices: Vec<&[f64]> = lanes.iter().map(Vec::as_slice).collect();
    let (whole, lent) = (Rows::new(&own, 5), Rows::apart(&slices));
    let mut ious = [7.0; 3000];
    for [a, b] in [[lent, lent], [whole, lent]] {
        let error = function.above(a, b, 0.5).expect_err("is flawed");
        let wanted = function.above(whole, whole, 0.5).expect_err("is flawed");
        assert!(
            matches!(error, Error::Invalid { item: 2500, .. }),
            "{error}"
        );
        assert_eq!(error.to_string().replace("`b`", "`a`"), wanted.to_string());
        // Nothing is written.
        let refused = function.aligned_into(&[a, b], &mut [Some(&mut ious)]);
        assert!(refused.is_err() && ious.iter().all(|&x| x == 7.0));
    }
}
