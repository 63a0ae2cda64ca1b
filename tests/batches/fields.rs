//! Arguments whose fields lie apart give the bits of rows, for every row of shapes of fixed size.
use geograd::error::Error;
use geograd::kernels::dynamic::{Fields, Format, Function, Mode, Rows, operation};
use geograd_tests::list::{self, Both};

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
fn of_fields<T: Format>(
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
    let arguments: Vec<Fields<'_, T>> = (0..columns.len())
        .map(|k| match is_apart(k) {
            true => Fields::Apart(&slices[k]),
            false => Fields::Rows(Rows::new(&columns[k], sizes[k])),
        })
        .collect();
    let mut lists: Vec<Vec<T>> = function
        .gives()
        .iter()
        .map(|&fields| vec![T::default(); fields * count])
        .collect();
    let mut results: Vec<Option<&mut [T]>> =
        lists.iter_mut().map(|own| Some(&mut own[..])).collect();
    function.aligned_fields_into(&arguments, &mut results)?;
    drop(results);
    Ok(lists)
}

fn rows_of<'a, T: Format>(function: &Function<T>, columns: &'a [Vec<T>]) -> Vec<Rows<'a, T>> {
    let takes = function.takes();
    columns
        .iter()
        .zip(&takes)
        .map(|(own, (_, layout))| Rows::new(own, layout.fields()))
        .collect()
}

#[test]
fn every_row_has_the_bits_of_rows() {
    fn of<T: Both + Into<f64>>() {
        let mut rows = 0;
        for row in list::todays(list::rows(), &[]) {
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
        assert!(rows <= 2 || rows > 60, "{rows} rows");
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
    let arguments = [Fields::Apart(&lanes), Fields::Rows(Rows::one(&one))];
    let mut by_second = vec![0.0; 25_000];
    let mut results = [None, None, Some(&mut by_second[..])];
    function
        .aligned_fields_into(&arguments, &mut results)
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
    let rows = Fields::Rows(Rows::new(&good, 5));
    let said = |a: &[&[f64]], count: usize| {
        let mut ious = vec![0.0; count];
        function.aligned_fields_into(&[Fields::Apart(a), rows], &mut [Some(&mut ious)])
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
    assert!(function.aligned_fields_into(&[rows], &mut [None]).is_err());
}
