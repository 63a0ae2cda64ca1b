//! Items of every width come out of a batch as they went in, whatever the number of items.
use geograd::kernels::dynamic::{Layout, Rows, Tracing, symbol};

/// Doubles every number of an item.
fn doubled(width: usize) -> geograd::kernels::dynamic::Program<f32> {
    let tracing = Tracing::<f32>::start(&[Layout::numbers(width)]).unwrap();
    let input = tracing.inputs().remove(0);
    let twice: Vec<_> = input
        .into_iter()
        .map(|x| symbol::add(x, x).unwrap())
        .collect();
    tracing.finish(&[&twice]).unwrap()
}

#[test]
fn every_width_and_count() {
    for width in 1..=25 {
        let program = doubled(width);
        for count in [1, 2, 15, 16, 17, 31, 32, 33, 100, 3000] {
            let input: Vec<f32> = (0..count * width).map(|i| i as f32 + 0.5).collect();
            let expected: Vec<f32> = input.iter().map(|x| 2.0 * x).collect();
            let found = program.aligned(&[Rows::new(&input, width)]).unwrap();
            assert_eq!(found.concat(), expected, "{count} items of {width} numbers");
        }
    }
}

#[test]
fn gradients_of_every_width() {
    for width in 1..=25 {
        let tracing = Tracing::<f64>::start(&[Layout::numbers(width)]).unwrap();
        let input = tracing.inputs().remove(0);
        let mut total = symbol::literal(0.0).unwrap();
        for (k, x) in input.into_iter().enumerate() {
            let weight = symbol::literal(k as f64 + 1.0).unwrap();
            total = symbol::add(total, symbol::mul(weight, x).unwrap()).unwrap();
        }
        let value_grad = tracing.finish(&[&[total]]).unwrap().value_grad().unwrap();
        let input: Vec<f64> = (0..37 * width).map(|i| i as f64).collect();
        let found = value_grad.aligned(&[Rows::new(&input, width)]).unwrap();
        for item in found[1].chunks_exact(width) {
            let expected: Vec<f64> = (1..=width).map(|k| k as f64).collect();
            assert_eq!(item, expected, "{width} numbers");
        }
    }
}
