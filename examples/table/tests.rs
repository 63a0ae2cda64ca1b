//! `table` as its users meet it: files in, files and exit status out.
use arrow::array::{
    Array, ArrayRef, AsArray, FixedSizeListArray, Float64Array, Int32Array, ListArray, RecordBatch,
    StructArray,
};
use arrow::buffer::OffsetBuffer;
use arrow::datatypes::{DataType, Field, Fields, Float64Type, UInt64Type};
use geograd::prelude::*;
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::Arc;

mod lists;

use lists::Wrong;

/// A folder of a test's own, empty at the start.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("table")
        .join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn run(at: &Path, arguments: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_table"));
    command
        .args(arguments.split_whitespace())
        .current_dir(at)
        .output()
        .unwrap()
}

/// The standard output of a run that goes well.
fn good(at: &Path, arguments: &str) -> String {
    let done = run(at, arguments);
    assert_eq!(String::from_utf8_lossy(&done.stderr), "", "{arguments}");
    assert_eq!(done.status.code(), Some(0), "{arguments}");
    String::from_utf8(done.stdout).unwrap()
}

/// The message of a run that fails with a status.
fn bad(at: &Path, status: i32, arguments: &str) -> String {
    let done = run(at, arguments);
    assert_eq!(done.status.code(), Some(status), "{arguments}");
    assert_eq!(String::from_utf8_lossy(&done.stdout), "", "{arguments}");
    String::from_utf8(done.stderr).unwrap()
}

/// Fifty boxes of ten frames, which overlap some of the others.
fn boxes(shift: f64) -> Vec<(i32, Obb2<f64>)> {
    let made = (0..50).map(|k| {
        let x = f64::from(k);
        let at = [(x * 0.37).sin() + shift, (x * 0.73).cos()];
        (k / 5, Obb2::new(at[0], at[1], 1.0 + 0.02 * x, 0.7, 0.1 * x))
    });
    made.collect()
}

fn numbers(b: &Obb2<f64>) -> [f64; 5] {
    let mut all = [0.0; 5];
    b.store(&mut all);
    all
}

const FIELDS: [&str; 5] = ["x", "y", "width", "height", "heading"];

fn csv(path: &Path, rows: &[(i32, Obb2<f64>)]) {
    let mut text = format!("frame,{}\n", FIELDS.join(","));
    for (frame, own) in rows {
        let all = numbers(own).map(|x| x.to_string());
        text += &format!("{frame},{}\n", all.join(","));
    }
    std::fs::write(path, text).unwrap();
}

fn write(path: &Path, columns: Vec<(&str, ArrayRef)>) {
    let batch = RecordBatch::try_from_iter(columns).unwrap();
    let mut writer =
        ArrowWriter::try_new(File::create(path).unwrap(), batch.schema(), None).unwrap();
    writer.write(&batch).unwrap();
    writer.close().unwrap();
}

fn lists(rows: &[(i32, Obb2<f64>)]) -> ArrayRef {
    let all: Vec<f64> = rows.iter().flat_map(|row| numbers(&row.1)).collect();
    let element = Arc::new(Field::new("element", DataType::Float64, false));
    Arc::new(FixedSizeListArray::new(
        element,
        5,
        Arc::new(Float64Array::from(all)),
        None,
    ))
}

fn structs(rows: &[(i32, Obb2<f64>)]) -> ArrayRef {
    // In another order than the shape's.
    let order = [4, 2, 0, 1, 3];
    let fields: Fields = order
        .iter()
        .map(|&k| Field::new(FIELDS[k], DataType::Float64, false))
        .collect();
    let lane = |k: usize| {
        Arc::new(
            rows.iter()
                .map(|row| Some(numbers(&row.1)[k]))
                .collect::<Float64Array>(),
        ) as ArrayRef
    };
    Arc::new(StructArray::new(fields, order.map(lane).to_vec(), None))
}

fn frames(rows: &[(i32, Obb2<f64>)]) -> ArrayRef {
    Arc::new(rows.iter().map(|row| row.0).collect::<Int32Array>())
}

fn read(path: &Path) -> RecordBatch {
    let reader = ParquetRecordBatchReaderBuilder::try_new(File::open(path).unwrap()).unwrap();
    let reader = reader.build().unwrap();
    let schema = arrow::array::RecordBatchReader::schema(&reader);
    let batches: Vec<_> = reader.map(Result::unwrap).collect();
    arrow::compute::concat_batches(&schema, &batches).unwrap()
}

/// Rows of a table of CSV as numbers.
fn parsed(text: &str) -> (&str, Vec<Vec<f64>>) {
    let (header, rows) = text.split_once('\n').unwrap();
    let row = |row: &str| row.split(',').map(|x| x.parse().unwrap()).collect();
    (header, rows.lines().map(row).collect())
}

#[test]
fn rows_with_derivatives() {
    let at = folder("rows");
    let (a, b) = (boxes(0.0), boxes(0.2));
    csv(&at.join("a.csv"), &a);
    csv(&at.join("b.csv"), &b);
    let text = good(&at, "--verb iou --a obb2:a.csv --b obb2:b.csv --grad");
    let (header, rows) = parsed(&text);
    assert!(header.starts_with("iou,iou_by_a.x,") && header.ends_with("iou_by_b.heading"));
    assert_eq!(rows.len(), 50);
    for (row, (a, b)) in rows.iter().zip(a.iter().zip(&b)) {
        let (iou, (by_a, by_b)) = Cpu::new()
            .aligned(Iou.value_grad(), (&[a.1], &[b.1]))
            .unwrap();
        assert_eq!(row[0], iou[0]);
        assert_eq!(row[1..6], numbers(&by_a[0]));
        assert_eq!(row[6..], numbers(&by_b[0]));
    }
    let few = good(&at, "--verb iou --a obb2:a.csv --b obb2:b.csv --above 0.6");
    let (header, told) = parsed(&few);
    assert_eq!(header, "row,iou");
    let wanted: Vec<Vec<f64>> = rows
        .iter()
        .enumerate()
        .filter(|row| row.1[0] > 0.6)
        .map(|(i, row)| vec![i as f64, row[0]])
        .collect();
    assert!(told == wanted && told.len() > 5);
}

#[test]
fn lists_structs_and_columns_are_one() {
    let at = folder("layouts");
    let (a, b) = (boxes(0.0), boxes(0.2));
    csv(&at.join("a.csv"), &a);
    csv(&at.join("b.csv"), &b);
    write(
        &at.join("a.parquet"),
        vec![("frame", frames(&a)), ("box", lists(&a))],
    );
    write(
        &at.join("b.parquet"),
        vec![("frame", frames(&b)), ("truth", structs(&b))],
    );
    let wanted = good(
        &at,
        "--verb iou --a obb2:a.csv --b obb2:b.csv --all-pairs --above 0.3",
    );
    let found = good(
        &at,
        "--verb iou --a obb2:a.parquet --column-a box --b obb2:b.parquet --column-b truth --all-pairs --above 0.3",
    );
    assert_eq!(found, wanted);
    good(
        &at,
        "--verb iou --a obb2:a.csv --b obb2:b.csv --all-pairs --above 0.3 --out c.parquet",
    );
    let table = read(&at.join("c.parquet"));
    let (_, rows) = parsed(&wanted);
    let column = |k: usize| {
        table
            .column(k)
            .as_primitive::<UInt64Type>()
            .values()
            .to_vec()
    };
    assert!(rows.len() > 50);
    for (k, row) in rows.iter().enumerate() {
        assert_eq!([column(0)[k] as f64, column(1)[k] as f64], [row[0], row[1]]);
        assert_eq!(
            table.column(2).as_primitive::<Float64Type>().value(k),
            row[2]
        );
    }
    // Other shapes and results: a column of numbers by its own name, results of several fields.
    good(
        &at,
        "--verb corners --a obb2:a.parquet --column-a box --out d.csv --precision f32",
    );
    let text = std::fs::read_to_string(at.join("d.csv")).unwrap();
    assert_eq!(
        (
            text.lines().count(),
            text.lines().next().unwrap().split(',').count()
        ),
        (51, 8)
    );
}

#[test]
fn groups_are_a_loop() {
    let at = folder("groups");
    let (mut a, mut b) = (boxes(0.0), boxes(0.2));
    // Groups that only one file has.
    a.retain(|row| row.0 != 3);
    b.retain(|row| row.0 != 0 && row.0 != 9);
    csv(&at.join("a.csv"), &a);
    write(
        &at.join("b.parquet"),
        vec![("frame", frames(&b)), ("box", lists(&b))],
    );
    let files = "--verb iou --a obb2:a.csv --b obb2:b.parquet --column-b box --group frame";
    let mut wanted = Vec::new();
    for (i, own) in a.iter().enumerate() {
        for (j, other) in b.iter().enumerate().filter(|other| other.1.0 == own.0) {
            wanted.push(vec![i as f64, j as f64, own.1.iou(other.1)]);
        }
    }
    let text = good(&at, files);
    assert_eq!(parsed(&text).1, wanted);
    wanted.retain(|row| row[2] > 0.3);
    let text = good(&at, &format!("{files} --above 0.3"));
    assert!(parsed(&text).1 == wanted && wanted.len() > 20);
    let text = good(&at, &format!("{files} --above 0.3 --grad"));
    let (_, rows) = parsed(&text);
    for (row, wanted) in rows.iter().zip(&wanted) {
        let [i, j] = [0, 1].map(|k| wanted[k] as usize);
        let (iou, (by_a, _)) = Cpu::new()
            .aligned(Iou.value_grad(), (&[a[i].1], &[b[j].1]))
            .unwrap();
        assert_eq!((row[2], &row[3..8]), (iou[0], &numbers(&by_a[0])[..]));
    }
    assert_eq!(rows.len(), wanted.len());
}

#[test]
fn many_blocks_are_one() {
    // More rows than a block has, and a group that is larger than one.
    let at = folder("blocks");
    let count = 600_000;
    let group = |k: i32| if k < 500_000 { 7 } else { 8 + k / 1000 };
    let column = |f: &dyn Fn(i32) -> f64| {
        Arc::new((0..count).map(|k| Some(f(k))).collect::<Float64Array>()) as ArrayRef
    };
    let keys: ArrayRef = Arc::new((0..count).map(group).collect::<Int32Array>());
    let x = column(&|k| f64::from(k) * 4.0);
    let right = column(&|k| f64::from(k) * 4.0 + 2.0);
    let [low, high] = [0.0, 2.0].map(|y| column(&|_| y));
    let columns = [
        ("frame", keys),
        ("min.x", x),
        ("min.y", low),
        ("max.x", right),
        ("max.y", high),
    ];
    write(&at.join("a.parquet"), columns.into());
    let files = "--a aabb2:a.parquet --b aabb2:a.parquet";
    good(&at, &format!("--verb distance {files} --out rows.parquet"));
    assert_eq!(read(&at.join("rows.parquet")).num_rows(), count as usize);
    good(
        &at,
        &format!("--verb intersection_area {files} --group frame --above 1 --out groups.parquet"),
    );
    let table = read(&at.join("groups.parquet"));
    let [rows, columns] = [0, 1].map(|k| {
        table
            .column(k)
            .as_primitive::<UInt64Type>()
            .values()
            .to_vec()
    });
    assert!(rows == columns && rows == (0..count as u64).collect::<Vec<_>>());
    good(
        &at,
        &format!("--verb intersection_area {files} --all-pairs --above 1 --out all.parquet"),
    );
    assert_eq!(read(&at.join("all.parquet")), table);
}

/// Squares in a row, each alone, as columns; what changes a number of them.
fn squares(
    count: usize,
    change: impl Fn(usize, usize) -> Option<Option<f64>>,
) -> Vec<(&'static str, ArrayRef)> {
    let names = ["min.x", "min.y", "max.x", "max.y"];
    let columns = names.into_iter().enumerate().map(|(k, name)| {
        let number = |row: usize| {
            let x = 4.0 * row as f64;
            let own = [x, 0.0, x + 2.0, 2.0][k];
            change(row, k).unwrap_or(Some(own))
        };
        let numbers = (0..count).map(number).collect::<Float64Array>();
        (name, Arc::new(numbers) as ArrayRef)
    });
    columns.collect()
}

/// Columns as one of structs, in another order than the shape's; one row may be null.
fn as_structs(columns: &[(&str, ArrayRef)], null: Option<usize>) -> ArrayRef {
    let order = [2, 0, 3, 1];
    let fields: Fields = order
        .iter()
        .map(|&k| Field::new(columns[k].0, DataType::Float64, true))
        .collect();
    let valid = null.map(|null| {
        let rows = 0..columns[0].1.len();
        arrow::buffer::NullBuffer::from_iter(rows.map(|row| row != null))
    });
    let own = order.map(|k| Arc::clone(&columns[k].1)).to_vec();
    Arc::new(StructArray::new(fields, own, valid))
}

#[test]
fn rows_of_later_blocks_are_named() {
    let at = folder("later");
    let same = |_: usize, _: usize| None;
    let good = squares(300_000, same);
    write(&at.join("good.parquet"), good.clone());
    let said = |name: &str, more: &str| {
        let one =
            format!("--verb distance --a aabb2:{name} --b aabb2:good.parquet {more} --out out.csv");
        bad(&at, 1, &one)
    };
    let at_row = |row: usize, field: usize, number: Option<f64>| {
        move |own: usize, k: usize| ((own, k) == (row, field)).then_some(number)
    };
    let flawed = squares(300_000, at_row(290_001, 3, Some(f64::NAN)));
    write(&at.join("flawed.parquet"), flawed);
    let why = said("flawed.parquet", "");
    assert!(
        why.contains("flawed.parquet: row 290001: max.y is not a finite number"),
        "{why}"
    );
    write(
        &at.join("null.parquet"),
        squares(300_000, at_row(290_002, 0, None)),
    );
    let why = said("null.parquet", "");
    assert!(
        why.contains("null.parquet: row 290002: min.x is null"),
        "{why}"
    );
    // Structs: one that is null, and a field of one.
    write(
        &at.join("structs.parquet"),
        vec![("box", as_structs(&good, Some(33_000)))],
    );
    let why = said("structs.parquet", "--column-a box");
    assert!(
        why.contains("structs.parquet: row 33000: box is null"),
        "{why}"
    );
    let inner = squares(40_000, at_row(33_001, 2, None));
    write(
        &at.join("inner.parquet"),
        vec![("box", as_structs(&inner, None))],
    );
    let why = said("inner.parquet", "--column-a box");
    assert!(
        why.contains("inner.parquet: row 33001: box.max.x is null"),
        "{why}"
    );
    // Groups: out of order, and null.
    let keyed = |key: &dyn Fn(i32) -> Option<i32>| {
        let keys: ArrayRef = Arc::new((0..300_000).map(key).collect::<Int32Array>());
        let mut columns = good.clone();
        columns.push(("frame", keys));
        columns
    };
    write(&at.join("good.parquet"), keyed(&|k| Some(k / 100)));
    let late = keyed(&|k| Some(if k == 280_050 { 7 } else { k / 100 }));
    write(&at.join("mixed.parquet"), late);
    let why = said("mixed.parquet", "--group frame --above 1");
    assert!(
        why.contains("mixed.parquet: row 280050: group 7 comes after 2800"),
        "{why}"
    );
    write(
        &at.join("keyless.parquet"),
        keyed(&|k| (k != 270_000).then_some(k / 100)),
    );
    let why = said("keyless.parquet", "--group frame --above 1");
    assert!(
        why.contains("keyless.parquet: row 270000: frame is null"),
        "{why}"
    );
    // Text.
    let mut text = String::from("min.x,min.y,max.x,max.y\n");
    (0..40_000).for_each(|row| {
        text += if row == 39_999 {
            "0,0,1,y\n"
        } else {
            "0,0,1,1\n"
        }
    });
    std::fs::write(at.join("text.csv"), text).unwrap();
    let why = said("text.csv", "");
    assert!(
        why.contains("text.csv: row 39999 (line 40001): max.y is not a number: `y`"),
        "{why}"
    );
}

#[test]
fn lists_and_structs_of_many_batches() {
    let at = folder("batches");
    let count = 70_000;
    let columns = squares(count, |_, _| None);
    write(
        &at.join("structs.parquet"),
        vec![("box", as_structs(&columns, None))],
    );
    let lane = |k: usize| columns[k].1.as_primitive::<Float64Type>();
    let all: Vec<f64> = (0..4 * count).map(|i| lane(i % 4).value(i / 4)).collect();
    let element = Arc::new(Field::new("element", DataType::Float64, false));
    let values = Arc::new(Float64Array::from(all));
    let fixed = FixedSizeListArray::new(Arc::clone(&element), 4, values.clone(), None);
    let offsets = arrow::buffer::OffsetBuffer::from_lengths(std::iter::repeat_n(4, count));
    let free = arrow::array::ListArray::new(element, offsets, values, None);
    write(&at.join("fixed.parquet"), vec![("box", Arc::new(fixed))]);
    write(&at.join("free.parquet"), vec![("box", Arc::new(free))]);
    // The same box in every row of both: any other row or field would be another number.
    for (a, b) in [("structs", "fixed"), ("fixed", "free"), ("free", "structs")] {
        let files =
            format!("--a aabb2:{a}.parquet --column-a box --b aabb2:{b}.parquet --column-b box");
        let text = good(&at, &format!("--verb iou {files}"));
        assert_eq!(text.lines().count(), count + 1, "{a} {b}");
        assert!(text.lines().skip(1).all(|line| line == "1"), "{a} {b}");
    }
    // Only what is above: a score at the threshold is not.
    let files = "--a aabb2:fixed.parquet --column-a box --b aabb2:fixed.parquet --column-b box";
    for which in ["", "--all-pairs"] {
        let text = good(&at, &format!("--verb iou {files} {which} --above 1"));
        assert_eq!(text.lines().count(), 1, "{which}");
    }
    let told = good(&at, &format!("--verb iou {files} --above 0.5"));
    let last = told.lines().last().unwrap();
    assert_eq!((told.lines().count(), last), (count + 1, "69999,1"));
}

/// More pairs than a block has: bands of rows, and a row of more columns than a block.
#[test]
fn all_pairs_of_many_blocks() {
    let at = folder("pairs");
    for [rows, columns] in [[600, 1000], [2, 300_000]] {
        write(&at.join("a.parquet"), squares(rows, |_, _| None));
        write(&at.join("b.parquet"), squares(columns, |_, _| None));
        let files = "--a aabb2:a.parquet --b aabb2:b.parquet --all-pairs --out c.parquet";
        good(&at, &format!("--verb distance {files}"));
        let table = read(&at.join("c.parquet"));
        assert_eq!(table.num_rows(), rows * columns);
        let ids = [0, 1].map(|k| {
            table
                .column(k)
                .as_primitive::<UInt64Type>()
                .values()
                .clone()
        });
        let far = table.column(2).as_primitive::<Float64Type>().values();
        for (k, &far) in far.iter().enumerate() {
            let [i, j] = [k / columns, k % columns];
            assert_eq!([ids[0][k] as usize, ids[1][k] as usize], [i, j]);
            assert_eq!(far, (4.0 * i.abs_diff(j) as f64 - 2.0).max(0.0), "{i} {j}");
        }
    }
}

#[test]
fn bad_rows_name_file_row_and_field() {
    let at = folder("bad_rows");
    let header = FIELDS.join(",");
    std::fs::write(
        at.join("good.csv"),
        format!("{header}\n0,0,1,1,0\n1,0,1,1,0\n"),
    )
    .unwrap();
    let cases = [
        (
            "0,0,1,1,0\n1,x,1,1,0\n",
            "row 1 (line 3): y is not a number: `x`",
        ),
        (
            "0,0,1,1,0\n1,0,-1,1,0\n",
            "row 1 (line 3): width is negative",
        ),
        (
            "0,0,1,NaN,0\n1,0,1,1,0\n",
            "row 0 (line 2): height is not a finite number",
        ),
        ("0,0,1,,0\n1,0,1,1,0\n", "row 0 (line 2): height is empty"),
        (
            "0,0,1,1\n",
            "row 0 (line 2): 4 fields where the header has 5",
        ),
        ("0,0,1,1,0\n\n1,0,1,1,0\n", "row 1 (line 3): is empty"),
        ("0,0,1,1,0\n", "bad.csv has 1 rows and good.csv has more"),
    ];
    for (rows, why) in cases {
        std::fs::write(at.join("bad.csv"), format!("{header}\n{rows}")).unwrap();
        std::fs::write(at.join("out.csv"), "as it was").unwrap();
        let said = bad(
            &at,
            1,
            "--verb iou --a obb2:good.csv --b obb2:bad.csv --out out.csv",
        );
        assert!(said.contains("bad.csv") && said.contains(why), "{said}");
        assert_eq!(
            std::fs::read_to_string(at.join("out.csv")).unwrap(),
            "as it was"
        );
    }
    assert_eq!(
        std::fs::read_dir(&at).unwrap().count(),
        3,
        "no part is left"
    );
}

#[test]
fn bad_tables_are_named() {
    let at = folder("bad_tables");
    let rows = boxes(0.0);
    write(
        &at.join("good.parquet"),
        vec![("frame", frames(&rows)), ("box", lists(&rows))],
    );
    let said = |a: &str, more: &str| {
        bad(
            &at,
            1,
            &format!("--verb iou --a obb2:{a} --b obb2:good.parquet --column-b box {more}"),
        )
    };
    // Columns, widths, types.
    assert!(said("good.parquet", "").contains("good.parquet: no column x, y, width"));
    assert!(said("good.parquet", "--column-a frame").contains("no column frame.x"));
    assert!(said("none.parquet", "").contains("none.parquet: "));
    let four: ArrayRef = Arc::new(FixedSizeListArray::new(
        Arc::new(Field::new("element", DataType::Float64, false)),
        4,
        Arc::new(Float64Array::from(vec![1.0; 8])),
        None,
    ));
    write(&at.join("four.parquet"), vec![("box", four)]);
    assert!(
        said("four.parquet", "--column-a box")
            .contains("four.parquet: row 0: box has 4 numbers, not 5")
    );
    // Nulls: of a list, of a number in it, of a struct.
    let lists = lists(&rows);
    let valid = arrow::buffer::NullBuffer::from_iter((0..50).map(|k| k != 17));
    let (element, size, values, _) = lists.as_fixed_size_list().clone().into_parts();
    let null: ArrayRef = Arc::new(FixedSizeListArray::new(
        element,
        size,
        Arc::clone(&values),
        Some(valid),
    ));
    write(&at.join("null.parquet"), vec![("box", null)]);
    assert!(said("null.parquet", "--column-a box").contains("null.parquet: row 17: box is null"));
    let inner: Float64Array = values
        .as_primitive::<Float64Type>()
        .iter()
        .enumerate()
        .map(|(k, x)| x.filter(|_| k != 58))
        .collect();
    let element = Arc::new(Field::new("element", DataType::Float64, true));
    let null: ArrayRef = Arc::new(FixedSizeListArray::new(element, 5, Arc::new(inner), None));
    write(&at.join("inner.parquet"), vec![("box", null)]);
    assert!(
        said("inner.parquet", "--column-a box").contains("inner.parquet: row 11: box[3] is null")
    );
    // Groups out of order, and of numbers with a point.
    let mut mixed = rows.clone();
    mixed.swap(20, 40);
    write(
        &at.join("mixed.parquet"),
        vec![("frame", frames(&mixed)), ("box", crate::lists(&mixed))],
    );
    let why = said("mixed.parquet", "--column-a box --group frame");
    assert!(
        why.contains("mixed.parquet: row 21: group 4 comes after 8: sort the file"),
        "{why}"
    );
    assert!(said("good.parquet", "--column-a box --group image").contains("no column image"));
    // A file that ends early, and one that is none.
    let bytes = std::fs::read(at.join("good.parquet")).unwrap();
    std::fs::write(at.join("half.parquet"), &bytes[..bytes.len() / 2]).unwrap();
    assert!(said("half.parquet", "--column-a box").contains("half.parquet: "));
    let mut broken = bytes;
    broken[10..400].fill(0xa5);
    std::fs::write(at.join("broken.parquet"), broken).unwrap();
    assert!(said("broken.parquet", "--column-a box").contains("broken.parquet: "));
}

#[test]
fn fields_in_quotes_and_groups_by_text() {
    let at = folder("quotes");
    let header = FIELDS.join(",");
    let plain = format!("{header},name\n0,0,1,1,0,a b\n1,0,1,1,0,c\n");
    std::fs::write(at.join("a.csv"), &plain).unwrap();
    // A byte order mark, quotes, commas, quotes and line breaks in quotes, spaces, CRLF, empty lines at the end.
    let quoted = format!(
        "\u{feff}{header}, \"name\",more\r\n\"0\", 0,1 ,1,0,\"a b\",\"x, \"\"y\"\"\n z\"\r\n1,0,1,1,0,c,\r\n\r\n \r\n"
    );
    std::fs::write(at.join("b.csv"), quoted).unwrap();
    let files = "--verb iou --a obb2:a.csv --b obb2:b.csv";
    assert_eq!(good(&at, files), "iou\n1\n1\n");
    let grouped = good(&at, &format!("{files} --group name"));
    assert_eq!(grouped, "a_row,b_row,iou\n0,0,1\n1,1,1\n");
    std::fs::write(
        at.join("b.csv"),
        format!("{header}\n\"0,0,1,1,0\n1,0,1,1,0\n"),
    )
    .unwrap();
    assert!(bad(&at, 1, files).contains("b.csv: row 0 (line 2): 1 fields where the header has 5"));
}

#[cfg(feature = "gpu")]
#[test]
fn a_gpu_computes_what_the_cpu_does() {
    let at = folder("gpu");
    csv(&at.join("a.csv"), &boxes(0.0));
    csv(&at.join("b.csv"), &boxes(0.2));
    let files = "--verb iou --a obb2:a.csv --b obb2:b.csv --precision f32";
    let first = run(&at, &format!("{files} --backend gpu"));
    if first.status.code() != Some(0) {
        let said = String::from_utf8_lossy(&first.stderr).into_owned();
        assert!(std::env::var("GEOGRAD_REQUIRE_GPU").is_err(), "{said}");
        eprintln!("SKIPPED: {said}");
        return;
    }
    for more in [
        "",
        "--grad",
        "--all-pairs",
        "--all-pairs --above 0.3",
        "--above 0.5 --grad",
        "--group frame",
        "--group frame --above 0.3",
        "--group frame --above 0.3 --grad",
    ] {
        let wanted = good(&at, &format!("{files} {more}"));
        let done = run(&at, &format!("{files} {more} --backend gpu"));
        assert_eq!(done.status.code(), Some(0), "{more}");
        let said = String::from_utf8_lossy(&done.stderr);
        assert!(said.starts_with("table: computing on "), "{said}");
        let text = String::from_utf8(done.stdout).unwrap();
        let (own, cpu) = (parsed(&text), parsed(&wanted));
        assert_eq!((own.0, own.1.len()), (cpu.0, cpu.1.len()), "{more}");
        assert!(cpu.1.len() > 20, "{more}");
        for (own, cpu) in own.1.iter().flatten().zip(cpu.1.iter().flatten()) {
            assert!((own - cpu).abs() < 2e-5, "{more}: {own} {cpu}");
        }
    }
    // Another verb and shape, without and with a format that GPUs lack.
    let far = "--verb distance --a obb2:a.csv --b obb2:b.csv --backend gpu";
    assert_eq!(
        run(&at, &format!("{far} --precision f32")).status.code(),
        Some(0)
    );
    assert!(bad(&at, 2, far).contains("GPUs have no f64"));
}

#[test]
fn a_full_disk_is_said() {
    if !Path::new("/dev/full").exists() {
        eprintln!("SKIPPED: there is no /dev/full");
        return;
    }
    let at = folder("full");
    csv(&at.join("a.csv"), &boxes(0.0));
    let said = bad(&at, 1, "--verb corners --a obb2:a.csv --out /dev/full");
    assert!(
        said.contains("/dev/full: ") && said.contains("No space left"),
        "{said}"
    );
}

#[test]
fn command_lines_that_make_no_sense() {
    let at = folder("usage");
    csv(&at.join("a.csv"), &boxes(0.0));
    let cases = [
        ("", "`--verb` is missing"),
        ("--verb ious --a obb2:a.csv", "no verb is called ious"),
        (
            "--verb iou --a obb2:a.csv",
            "iou of obb2 is not there; it takes\n",
        ),
        ("--verb iou --a obb2:a.csv --b circle:a.csv", "obb2 obb2"),
        ("--verb iou --b obb2:a.csv", "`--a` is missing"),
        ("--verb iou --a a.csv", "it is SHAPE:FILE"),
        (
            "--verb corners --a obb2:a.csv --grad",
            "results of one number",
        ),
        (
            "--verb corners --a obb2:a.csv --all-pairs",
            "pairs need two arguments",
        ),
        (
            "--verb corners --a obb2:a.csv --out a.csv",
            "`--out` is an input",
        ),
        (
            "--verb iou --a obb2:a.csv --b obb2:a.csv --above nan",
            "finite",
        ),
        (
            "--verb corners --a obb2:a.csv --precision f16",
            "f32 or f64",
        ),
        (
            "--verb corners --a obb2:a.csv --backend gpu",
            "`--backend gpu`",
        ),
    ];
    for (arguments, why) in cases {
        let said = bad(&at, 2, arguments);
        assert!(said.contains(why), "{arguments}: {said}");
    }
    assert!(good(&at, "--help").contains("Usage: table"));
    let list = good(&at, "--verb list");
    assert!(
        list.contains("\niou obb2 obb2\n")
            && list.contains("\nobb2: x, y, width, height, heading\n")
    );
}

/// A part of a column begins in the middle of the values that it shares.
#[test]
fn parts_of_columns_of_lists() {
    let numbers: Vec<f64> = (0..12).map(f64::from).collect();
    let values: ArrayRef = Arc::new(Float64Array::from(numbers));
    let field = Arc::new(Field::new("item", DataType::Float64, false));
    let fixed: ArrayRef = Arc::new(FixedSizeListArray::new(
        field.clone(),
        3,
        values.clone(),
        None,
    ));
    let offsets = OffsetBuffer::from_lengths([3; 4]);
    let free: ArrayRef = Arc::new(ListArray::new(field.clone(), offsets, values, None));
    for column in [fixed, free] {
        for first in 0..3 {
            let part = column.slice(first, 2);
            let found = lists::values(&part, 3).unwrap();
            let found = found.as_primitive::<Float64Type>().values().to_vec();
            let expected: Vec<f64> = (3 * first..3 * first + 6).map(|x| x as f64).collect();
            assert_eq!(found, expected);
        }
        let found = lists::values(&column.slice(1, 2), 4);
        assert_eq!(found.unwrap_err(), Wrong::Width { row: 0, found: 3 });
    }
    // The second of lists of 3, 2 and 3 numbers is wrong; without it the last one has a null.
    let holes = Float64Array::from(
        vec![Some(0.0); 7]
            .into_iter()
            .chain([None])
            .collect::<Vec<_>>(),
    );
    let field = Arc::new(Field::new("item", DataType::Float64, true));
    let offsets = OffsetBuffer::from_lengths([3, 2, 3]);
    let column: ArrayRef = Arc::new(ListArray::new(field, offsets, Arc::new(holes), None));
    let found = lists::values(&column, 3);
    assert_eq!(found.unwrap_err(), Wrong::Width { row: 1, found: 2 });
    let found = lists::values(&column.slice(2, 1), 3);
    assert_eq!(found.unwrap_err(), Wrong::Null { row: 0, field: 2 });
    assert_eq!(lists::values(&column.slice(0, 1), 3).unwrap().len(), 3);
    assert_eq!(lists::values(&column.slice(0, 0), 3).unwrap().len(), 0);
}
