//! How hashes of results are kept and compared; `tests/hashes` has the command.
use geograd_tests::lines::{Lines, differences, parse, parse_names, rename, text};

const KEPT: &str = "\
# a comment

iof_obb2 f64 scalar 0000000000000007
iou_obb2 f32 aligned 00000000000000ff
iou_obb2 f32 scalar 0123456789abcdef
";

fn kept() -> Lines {
    parse(KEPT).unwrap()
}

#[test]
fn what_is_written_is_read() {
    let lines = kept();
    assert_eq!(lines.len(), 3);
    assert_eq!(parse(&text(&lines)).unwrap(), lines);
    assert_eq!(differences(&lines, &lines), [""; 0]);
}

#[test]
fn every_difference_has_a_line() {
    let found = "\
        iou_obb2 f32 scalar 0123456789abcdee\n\
        iou_obb2 f32 aligned 00000000000000ff\n\
        iou_obb2 f32 row_max 1\n\
        giou_obb2 f32 scalar 2\n\
        giou_obb2 f64 scalar 3\n";
    assert_eq!(
        differences(&kept(), &parse(found).unwrap()),
        [
            "missing row iof_obb2",
            "extra row giou_obb2",
            "differs iou_obb2 f32 scalar: 0123456789abcdee, expected 0123456789abcdef",
            "extra iou_obb2 f32 row_max",
        ]
    );
    let fewer = "iof_obb2 f64 scalar 7\niou_obb2 f32 scalar 0123456789abcdef";
    assert_eq!(
        differences(&kept(), &parse(fewer).unwrap()),
        ["missing iou_obb2 f32 aligned"]
    );
}

#[test]
fn rows_are_renamed() {
    let names = parse_names("# old, new\niou_obb2 iou(obb2,obb2)\nunknown other\n").unwrap();
    let renamed = rename(kept(), &names).unwrap();
    let expected = KEPT.replace("iou_obb2", "iou(obb2,obb2)");
    assert_eq!(renamed, parse(&expected).unwrap());
    let names = parse_names("iof_obb2 iou_obb2").unwrap();
    let clash = "iof_obb2 f32 scalar 1\niou_obb2 f32 scalar 1";
    let refused = rename(parse(clash).unwrap(), &names);
    assert_eq!(refused.unwrap_err(), "two rows become iou_obb2");
}

#[test]
fn what_cannot_be_read_is_named() {
    let refused = |text| parse(text).unwrap_err();
    assert!(refused("\niou_obb2 f32 scalar").starts_with("line 2: row, format, form and hash"));
    assert_eq!(
        refused("a f32 scalar x"),
        "line 1: x is no hexadecimal number"
    );
    assert_eq!(
        refused("a f32 scalar 1\na f32 scalar 1"),
        "line 2: a f32 scalar is there twice"
    );
    assert!(parse_names("a b c").unwrap_err().starts_with("line 1"));
    assert_eq!(
        parse_names("a b\na c").unwrap_err(),
        "line 2: a is there twice"
    );
}
