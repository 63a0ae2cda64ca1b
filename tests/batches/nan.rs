//! A NaN that arises in a function of one's own is NaN in the result of every row that it calls, item by item; other
//! items have the bits of the row.
use crate::rows::Number;
use geograd::kernels::dynamic::{Layout, Program, Rows, Sort, Tracing, symbol};
use geograd_tests::list;
use geograd_tests::list::Tested;

/// A row called with every number times a quotient `q / q`, where the `q` are the columns after the row's own: of `q = 0`
/// the product is NaN, of `q = 1` it is the number.
fn spoiled<T: Number>(row: &Tested) -> Option<Program<T>> {
    let program = row.operation.program::<T>().ok()?;
    let takes = program.takes();
    let mut layouts: Vec<Layout<T>> = takes.iter().map(|take| take.1).collect();
    let numbers: usize = layouts.iter().map(Layout::fields).sum();
    layouts.push(Layout::numbers(numbers));
    let tracing = Tracing::start(&layouts).ok()?;
    let mut inputs = tracing.inputs();
    let flags = inputs.pop()?;
    let mut flags = flags.into_iter();
    for number in inputs.iter_mut().flatten() {
        let flag = flags.next()?;
        let one = symbol::over(flag, flag).ok()?;
        *number = symbol::mul(*number, one).ok()?;
    }
    let arguments: Vec<_> = inputs.iter().map(|list| &list[..]).collect();
    let results = row.operation.on_symbols(&arguments).ok()?;
    tracing.finish(&[&results]).ok()
}

/// Items with a NaN in each number in turn and one without, `repeat` times over: interpreted where they are few, machine
/// code where they are many.
fn judged<T: Number>(row: &Tested, repeat: usize) -> Vec<String> {
    let Ok(plain) = row.operation.program::<T>() else {
        return vec![format!("{} is no program", row.name())];
    };
    if plain.takes().iter().any(|take| take.1.codes() > 0) {
        return Vec::new();
    }
    let Some(program) = spoiled::<T>(row) else {
        return vec![format!("{} is not recorded", row.name())];
    };
    let numbers = list::inputs::<T>(row, 1, |draw| row.random(draw)).remove(0);
    let n = numbers.len();
    let takes = program.takes();
    let (mut columns, mut start) = (Vec::new(), 0);
    for (_, layout) in &takes[..takes.len() - 1] {
        let end = start + layout.fields();
        columns.push(numbers[start..end].repeat((n + 1) * repeat));
        start = end;
    }
    let flags = (0..=n).flat_map(|k| (0..n).map(move |i| T::lit(f64::from(i != k))));
    columns.push(flags.collect::<Vec<T>>().repeat(repeat));
    let rows = columns.iter().zip(&takes);
    let rows: Vec<_> = rows
        .map(|(column, take)| Rows::new(column, take.1.fields()))
        .collect();
    let found = match program.aligned(&rows) {
        Ok(found) => found.concat(),
        Err(error) => return vec![format!("{}: {error}", row.name())],
    };
    let wide = found.len() / ((n + 1) * repeat);
    let expected = row
        .operation
        .program::<T>()
        .and_then(|value| value.eval(&numbers));
    let expected = expected.unwrap_or_default();
    let mut flaws = Vec::new();
    for (item, result) in found.chunks(wide.max(1)).enumerate() {
        let k = item % (n + 1);
        let same = |(x, y): (&T, &T)| x.equals(*y);
        let right = match k == n {
            true => result.iter().zip(&expected).all(same),
            false => result.iter().all(|x| !x.equals(*x)),
        };
        if !right {
            flaws.push(format!(
                "{}, number {k} of item {item}: {result:?}",
                row.name()
            ));
        }
    }
    flaws.truncate(3);
    flaws
}

#[test]
fn a_nan_of_a_function_is_nan_of_the_row_that_it_calls() {
    let mut flaws = Vec::new();
    for row in list::sample(list::rows(), &[]) {
        if row.operation.sort == Sort::Straight {
            flaws.extend(judged::<f64>(row, 1));
            flaws.extend(judged::<f32>(row, 1));
        }
    }
    assert!(
        flaws.is_empty(),
        "{} flaws:\n{}",
        flaws.len(),
        flaws.join("\n")
    );
}

#[test]
fn machine_code_has_the_same_nan() {
    let rows = list::rows().into_iter();
    let straight = rows.filter(|row| row.operation.sort == Sort::Straight);
    let flaws: Vec<_> = straight
        .step_by(20)
        .flat_map(|row| judged::<f32>(row, 500))
        .collect();
    assert!(
        flaws.is_empty(),
        "{} flaws:\n{}",
        flaws.len(),
        flaws.join("\n")
    );
}
