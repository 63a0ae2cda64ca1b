//! Reductions on the CPU: of all pairs block by block, and of a matrix that is there, against plain
//! loops over the matrix.
use geograd::Aabb2;
use geograd::kernels::reduce::{Best, Found, Matrix};
use geograd_tests::calls::{self, Number};
use geograd_tests::rows::IouAabb2;

/// Boxes on a coarse grid, so that equal scores occur often.
fn boxes<T: Number>(n: usize, seed: u64) -> Vec<Aabb2<T>> {
    let mut state = seed;
    let mut roll = |sides: u64| {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        T::lit(((state >> 33) % sides) as f64)
    };
    (0..n)
        .map(|_| {
            let (x, y) = (roll(9), roll(9));
            Aabb2::new(x, y, x + roll(4), y + roll(4))
        })
        .collect()
}

/// Rows and columns around the ends of blocks of 128 by 1024.
const SIZES: [(usize, usize); 6] = [
    (1, 1),
    (3, 1024),
    (2, 2050),
    (129, 7),
    (131, 1030),
    (8321, 3),
];

fn agrees<T: Number + Into<f64>>() {
    for (rows, columns) in SIZES {
        let (a, b) = (boxes::<T>(rows, 1), boxes::<T>(columns, 2));
        let values = calls::all_pairs::<IouAabb2, T>(&a, &b).unwrap();
        let held = Matrix::new(rows, columns, values.clone()).unwrap();
        let at = |i: usize, j: usize| values[i * columns + j];
        // The first of the largest.
        let best_of = |count: usize, value: &dyn Fn(usize) -> T| {
            let best = Best {
                value: value(0),
                index: 0,
            };
            (1..count).fold(best, |best, index| match value(index) {
                value if value > best.value => Best { value, index },
                _ => best,
            })
        };
        let of_rows: Vec<_> = (0..rows).map(|i| best_of(columns, &|j| at(i, j))).collect();
        assert_eq!(calls::row_max::<IouAabb2, T>(&a, &b).unwrap(), of_rows);
        assert_eq!(held.row_max().unwrap(), of_rows);
        let of_columns: Vec<_> = (0..columns).map(|j| best_of(rows, &|i| at(i, j))).collect();
        assert_eq!(
            calls::column_max::<IouAabb2, T>(&a, &b).unwrap(),
            of_columns
        );
        assert_eq!(held.column_max().unwrap(), of_columns);

        let threshold = T::lit(0.25);
        let mut found = Vec::new();
        for row in 0..rows {
            for column in 0..columns {
                let value = at(row, column);
                if value > threshold {
                    found.push(Found { row, column, value });
                }
            }
        }
        assert!(rows * columns < 1000 || !found.is_empty());
        assert_eq!(
            calls::above::<IouAabb2, T>(&a, &b, threshold).unwrap(),
            found
        );
        assert_eq!(held.above(threshold).unwrap(), found);
        let count = found.len() as u64;
        assert_eq!(
            calls::count_above::<IouAabb2, T>(&a, &b, threshold).unwrap(),
            count
        );
        assert_eq!(held.count_above(threshold).unwrap(), count);

        let sum: f64 = values.iter().map(|&x| x.into()).sum();
        let close = |x: f64| (x - sum).abs() <= 1e-12 * sum;
        assert!(close(calls::sum::<IouAabb2, T>(&a, &b).unwrap()) && close(held.sum()));

        let (same, a_bar, b_bar) = calls::sum_grad::<IouAabb2, T>(&a, &b).unwrap();
        assert!(close(same));
        let ones = vec![T::one(); rows * columns];
        let bars = calls::all_pairs_vjp::<IouAabb2, T>(&a, &b, &ones).unwrap();
        assert_eq!((a_bar, b_bar), bars);
    }
}

#[test]
fn reductions_agree_with_loops_over_the_matrix() {
    agrees::<f32>();
    agrees::<f64>();
}

#[cfg(feature = "parallel")]
#[test]
fn same_bits_for_any_number_of_threads() {
    let (a, b) = (boxes::<f32>(150, 3), boxes::<f32>(1100, 4));
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            (
                calls::sum_grad::<IouAabb2, f32>(&a, &b).unwrap(),
                calls::column_max::<IouAabb2, f32>(&a, &b).unwrap(),
                calls::above::<IouAabb2, f32>(&a, &b, 0.3).unwrap(),
            )
        })
    };
    let one = run(1);
    for threads in [2, 5] {
        assert!(run(threads) == one, "{threads} threads differ");
    }
}

#[test]
fn nothing_is_reduced_to_nothing() {
    let (none, some): (Vec<Aabb2<f32>>, _) = (vec![], boxes::<f32>(3, 1));
    assert!(
        calls::row_max::<IouAabb2, f32>(&none, &some)
            .unwrap()
            .is_empty()
    );
    assert!(calls::row_max::<IouAabb2, f32>(&some, &none).is_err());
    assert!(
        calls::above::<IouAabb2, f32>(&some, &none, 0.0)
            .unwrap()
            .is_empty()
    );
    // Zeros of results have no sign.
    for lists in [[&none, &none], [&none, &some], [&some, &none]] {
        let sum = calls::sum::<IouAabb2, f32>(lists[0], lists[1]).unwrap();
        assert_eq!(sum.to_bits(), 0.0_f64.to_bits());
    }
    let (sum, a_bar, _) = calls::sum_grad::<IouAabb2, f32>(&some, &none).unwrap();
    assert_eq!((sum, a_bar[0].min.x), (0.0, 0.0));
}
