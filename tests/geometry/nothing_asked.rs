//! Errors that name what was asked: a threshold that is no number, the largest of nothing.
use geograd::error::Argument;
use geograd::kernels::{Cpu, Iou, One};
use geograd::suppression::Rules;
use geograd::{Aabb2, Error, suppression};

const BOX: Aabb2<f64> = Aabb2::new(0.0, 0.0, 1.0, 1.0);

#[test]
fn a_threshold_is_named_in_the_error_about_it() {
    let cpu = Cpu::new();
    for threshold in [f64::NAN, f64::INFINITY] {
        let errors = [
            cpu.above(Iou, &[BOX], &[BOX], threshold).unwrap_err(),
            cpu.count_above(Iou, &[BOX], &[BOX], threshold).unwrap_err(),
        ];
        for error in errors {
            let Error::Invalid { argument, .. } = error else {
                panic!("{error:?}")
            };
            assert_eq!(argument, Argument::Threshold);
            assert!(error.to_string().starts_with("`threshold`: "), "{error}");
        }
    }
    let error = suppression::hard(&[0.5], &[], Rules::above(5.0)).unwrap_err();
    assert_eq!(error.to_string(), "`threshold`: value is not in [0, 1]");
}

#[test]
fn the_largest_of_nothing_is_an_error_that_names_the_empty_column() {
    let (cpu, none) = (Cpu::new(), [] as [Aabb2<f64>; 0]);
    let empty = |argument| Err(Error::NoLargest { argument });
    assert_eq!(
        cpu.row_max(Iou, &[BOX], &none).map(|x| x.len()),
        empty(Argument::B)
    );
    assert_eq!(
        cpu.row_max(Iou, One(BOX), &none).map(|x| x.len()),
        empty(Argument::B)
    );
    assert_eq!(
        cpu.column_max(Iou, &none, &[BOX]).map(|x| x.len()),
        empty(Argument::A)
    );
    // Without rows nothing is asked.
    assert_eq!(cpu.row_max(Iou, &none, &none).map(|x| x.len()), Ok(0));
    assert_eq!(cpu.column_max(Iou, &none, &none).map(|x| x.len()), Ok(0));
}
