//! Batches: every form gives the numbers of the single call; bad input is refused with its place, and
//! buffers are left alone.
use geograd::error::{Argument, Field};
use geograd::kernels::Op;
use geograd::kernels::check::{Folded, WithAdjoint};
use geograd::kernels::fold::fold;
use geograd::{Aabb2, Error, Flaw, Obb2, Pack, Vec2};
use geograd_tests::calls::{self, Number};
use geograd_tests::rows::ring::{Centroid, Perimeter, SignedArea};
use geograd_tests::rows::{IofAabb2, IouAabb2, IouObb2};

fn boxes(n: usize, seed: u64) -> Vec<Obb2<f64>> {
    let mut state = seed;
    let mut roll = move || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        ((state ^ (state >> 31)).wrapping_mul(0x9e3779b97f4a7c15) >> 11) as f64
            / (1_u64 << 53) as f64
    };
    (0..n)
        .map(|i| {
            // Every few boxes a tie with the others.
            let heading = if i % 5 == 0 { 0.0 } else { roll() * 10.0 - 5.0 };
            Obb2::new(
                roll() * 4.0 - 2.0,
                roll() * 4.0 - 2.0,
                roll() * 3.0,
                roll() * 3.0,
                heading,
            )
        })
        .collect()
}

fn narrow(list: &[Obb2<f64>]) -> Vec<Obb2<f32>> {
    list.iter().map(|x| x.remake(&mut |&x| x as f32)).collect()
}

/// Derivatives by one call, times an upstream derivative.
fn derivatives<T: Number>(pair: (Obb2<T>, Obb2<T>), up: T) -> (Obb2<T>, Obb2<T>) {
    IouObb2::adjoint(pair, up).unwrap().1
}

/// Every form of a batch against single calls, for lengths around the tile.
fn all_forms_agree<T: Number>(make: impl Fn(usize, u64) -> Vec<Obb2<T>>) {
    for n in [0, 1, 2, 7, 8, 9, 15, 16, 17, 33, 100, 300] {
        let (a, b) = (make(n, 1), make(n, 2));
        let values = calls::aligned::<IouObb2, T>(&a, &b).unwrap();
        let (same, a_bar, b_bar) = calls::aligned_grad::<IouObb2, T>(&a, &b).unwrap();
        assert_eq!(values, same);
        let upstream: Vec<T> = (0..n).map(|i| T::lit(0.25 * i as f64 - 1.0)).collect();
        let (a_up, b_up) = calls::aligned_vjp::<IouObb2, T>(&a, &b, &upstream).unwrap();
        for i in 0..n {
            assert_eq!(values[i], IouObb2::eval::<T>((a[i], b[i])));
            let one = derivatives((a[i], b[i]), T::one());
            assert_eq!((a_bar[i], b_bar[i]), one);
            let up = derivatives((a[i], b[i]), upstream[i]);
            assert_eq!((a_up[i], b_up[i]), up);
        }
        let rows = make(n / 3 + 1, 3);
        let matrix = calls::all_pairs::<IouObb2, T>(&rows, &b).unwrap();
        let grads = calls::all_pairs_grad::<IouObb2, T>(&rows, &b).unwrap();
        assert_eq!(matrix, grads.values());
        let upstream: Vec<T> = (0..matrix.len())
            .map(|i| T::lit((i % 7) as f64 * 0.5 - 1.0))
            .collect();
        let (rows_bar, b_bar) = calls::all_pairs_vjp::<IouObb2, T>(&rows, &b, &upstream).unwrap();
        let mut sums = (vec![vec![0.0; 5]; rows.len()], vec![vec![0.0; 5]; n]);
        for i in 0..rows.len() {
            for j in 0..n {
                assert_eq!(matrix[i * n + j], IouObb2::eval::<T>((rows[i], b[j])));
                assert_eq!(grads.at(i, j).1, derivatives((rows[i], b[j]), T::one()));
                let (p, q) = derivatives((rows[i], b[j]), upstream[i * n + j]);
                for k in 0..5 {
                    sums.0[i][k] += p.scalars()[k].widen();
                    sums.1[j][k] += q.scalars()[k].widen();
                }
            }
        }
        for (bars, sums) in [(&rows_bar, &sums.0), (&b_bar, &sums.1)] {
            for (bar, sum) in bars.iter().zip(sums) {
                for (x, y) in bar.scalars().iter().zip(sum) {
                    let close = T::format().epsilon() * 300.0 * (1.0 + y.abs());
                    assert!((x.widen() - y).abs() < close * 10.0, "{x:?} {y}");
                }
            }
        }
    }
}

#[test]
fn all_forms_agree_with_single_calls() {
    all_forms_agree::<f64>(boxes);
    all_forms_agree::<f32>(|n, seed| narrow(&boxes(n, seed)));
}

#[test]
fn long_rows_agree_with_single_calls() {
    // Derivatives leave in runs of 512 or 1024 columns: lengths around the end of one and of two.
    fn agree<T: Number>(make: impl Fn(usize, u64) -> Vec<Obb2<T>>) {
        let rows = make(3, 1);
        for n in [511, 512, 513, 1023, 1024, 1025, 1041, 2050] {
            let b = make(n, 2);
            let grads = calls::all_pairs_grad::<IouObb2, T>(&rows, &b).unwrap();
            for (i, &row) in rows.iter().enumerate() {
                for (j, &column) in b.iter().enumerate() {
                    assert_eq!(grads.values()[i * n + j], IouObb2::eval::<T>((row, column)));
                    assert_eq!(grads.at(i, j).1, derivatives((row, column), T::one()));
                }
            }
        }
    }
    agree::<f64>(boxes);
    agree::<f32>(|n, seed| narrow(&boxes(n, seed)));
}

#[test]
fn extreme_batches_have_the_same_bits() {
    // One enormous box sends the batch down the path for extreme sizes.
    let (a, b) = (narrow(&boxes(40, 1)), narrow(&boxes(40, 2)));
    let mut with_giant = b.clone();
    with_giant.push(Obb2::new(0.0, 0.0, 1e30, 1e-30, 0.3));
    let plain = calls::all_pairs_grad::<IouObb2, f32>(&a, &b).unwrap();
    let extreme = calls::all_pairs_grad::<IouObb2, f32>(&a, &with_giant).unwrap();
    for i in 0..a.len() {
        for j in 0..b.len() {
            assert_eq!(
                plain.values()[i * 40 + j].to_bits(),
                extreme.values()[i * 41 + j].to_bits()
            );
            assert_eq!(plain.at(i, j), extreme.at(i, j));
        }
    }
}

#[test]
fn empty_batches_are_valid() {
    let none: [Obb2<f32>; 0] = [];
    let some = narrow(&boxes(3, 1));
    assert!(
        calls::aligned::<IouObb2, f32>(&none, &none)
            .unwrap()
            .is_empty()
    );
    assert!(
        calls::all_pairs::<IouObb2, f32>(&none, &some)
            .unwrap()
            .is_empty()
    );
    assert!(
        calls::all_pairs::<IouObb2, f32>(&some, &none)
            .unwrap()
            .is_empty()
    );
    let (a, b) = calls::all_pairs_vjp::<IouObb2, f32>(&some, &none, &[]).unwrap();
    assert_eq!((a.len(), b.len()), (3, 0));
    assert!(a.iter().all(|x| x.scalars().iter().all(|&x| x == 0.0)));
    assert!(
        calls::ragged::<SignedArea, f32>(&[], &[0])
            .unwrap()
            .is_empty()
    );
    assert_eq!(
        calls::ragged::<SignedArea, f32>(&[], &[0, 0]).unwrap(),
        [0.0]
    );
}

#[test]
fn bad_input_is_refused_with_its_place() {
    let good = boxes(5, 1);
    let flawed = |row: usize, change: fn(&mut Obb2<f64>)| {
        let mut list = good.clone();
        change(&mut list[row]);
        list
    };
    let cases: [(Vec<Obb2<f64>>, usize, Flaw); 4] = [
        (
            flawed(3, |x| x.heading = f64::NAN),
            3,
            Flaw::NotFinite(Field::new("heading")),
        ),
        (
            flawed(0, |x| x.center.y = f64::INFINITY),
            0,
            Flaw::NotFinite(Field::new("y")),
        ),
        (
            flawed(4, |x| x.size.x = -1.0),
            4,
            Flaw::Negative(Field::new("width")),
        ),
        (
            flawed(2, |x| x.size.y = f64::NEG_INFINITY),
            2,
            Flaw::NotFinite(Field::new("height")),
        ),
    ];
    let mut values = vec![7.0; 25];
    let (mut a_bar, mut b_bar) = (good.clone(), good.clone());
    for (bad, row, flaw) in &cases {
        let in_a = Error::Invalid {
            argument: Argument::A,
            item: *row,
            flaw: *flaw,
        };
        let in_b = Error::Invalid {
            argument: Argument::B,
            item: *row,
            flaw: *flaw,
        };
        type Run = fn(
            &[Obb2<f64>],
            &[Obb2<f64>],
            &mut [f64],
            &mut [Obb2<f64>],
            &mut [Obb2<f64>],
        ) -> Result<(), Error>;
        let runs: [Run; 5] = [
            |a, b, v, _, _| calls::aligned_into::<IouObb2, f64>(a, b, &mut v[..5]),
            |a, b, v, p, q| calls::aligned_grad_into::<IouObb2, f64>(a, b, &mut v[..5], p, q),
            |a, b, _, p, q| calls::aligned_vjp_into::<IouObb2, f64>(a, b, &[1.0; 5], p, q),
            |a, b, v, _, _| calls::all_pairs_into::<IouObb2, f64>(a, b, v),
            |a, b, _, p, q| calls::all_pairs_vjp_into::<IouObb2, f64>(a, b, &[1.0; 25], p, q),
        ];
        for run in runs {
            assert_eq!(
                run(bad, &good, &mut values, &mut a_bar, &mut b_bar),
                Err(in_a)
            );
            assert_eq!(
                run(&good, bad, &mut values, &mut a_bar, &mut b_bar),
                Err(in_b)
            );
        }
        assert_eq!(
            calls::all_pairs_grad::<IouObb2, f64>(bad, &good).unwrap_err(),
            in_a
        );
    }
    assert!(values.iter().all(|&x| x == 7.0) && a_bar == good && b_bar == good);

    let length = |argument, expected, found| Error::Length {
        argument,
        expected,
        found,
    };
    assert_eq!(
        calls::aligned::<IouObb2, f64>(&good, &good[..4]),
        Err(length(Argument::B, 5, 4))
    );
    assert_eq!(
        calls::all_pairs_into::<IouObb2, f64>(&good, &good, &mut values[..24]),
        Err(length(Argument::Values, 25, 24))
    );
    assert_eq!(
        calls::all_pairs_vjp::<IouObb2, f64>(&good, &good, &values[..24]),
        Err(length(Argument::Upstream, 25, 24))
    );
    let nan = Error::Invalid {
        argument: Argument::Upstream,
        item: 1,
        flaw: Flaw::NotFinite(Field::VALUE),
    };
    assert_eq!(
        calls::aligned_vjp::<IouObb2, f64>(&good, &good, &[1.0, f64::NAN, 1.0, 1.0, 1.0]),
        Err(nan)
    );
    let inverted = [Aabb2::new(0.0, 1.0, 1.0, 0.0)];
    assert_eq!(
        calls::aligned::<IouAabb2, f64>(&inverted, &inverted),
        Err(Error::Invalid {
            argument: Argument::A,
            item: 0,
            flaw: Flaw::Inverted(Field::new("min.y"), "max")
        })
    );
    assert_eq!(
        Error::Invalid {
            argument: Argument::A,
            item: 3,
            flaw: Flaw::Negative(Field::new("width"))
        }
        .to_string(),
        "`a` item 3: width is negative"
    );
    let refused = calls::above::<IouObb2, f64>(&good, &good, f64::NAN).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "`threshold`: value is not a finite number"
    );
}

#[test]
fn ragged_batches_agree_with_single_calls() {
    let mut vertices = Vec::new();
    let mut offsets = vec![0];
    for (i, shape) in boxes(700, 9).into_iter().enumerate() {
        // Rings of 0 to 9 vertices, some repeated.
        let corners = shape.corners();
        for k in 0..i % 10 {
            let start = corners[k % 4];
            vertices.push(start + (corners[(k + 1) % 4] - start) * (0.1 * (k / 4) as f64));
        }
        offsets.push(vertices.len());
    }
    let rings = || offsets.windows(2).map(|w| vertices[w[0]..w[1]].to_vec());
    let area = calls::ragged::<SignedArea, f64>(&vertices, &offsets).unwrap();
    let perimeter = calls::ragged::<Perimeter, f64>(&vertices, &offsets).unwrap();
    let centroid = calls::ragged::<Centroid, f64>(&vertices, &offsets).unwrap();
    let ups: Vec<Vec2<f64>> = (0..area.len()).map(|i| Vec2::new(i as f64, 1.0)).collect();
    let bars = calls::ragged_vjp::<Centroid, f64>(&vertices, &offsets, &ups).unwrap();
    for (i, ring) in rings().enumerate() {
        assert_eq!(area[i], fold::<SignedArea, f64>([], &ring));
        assert_eq!(perimeter[i], fold::<Perimeter, f64>([], &ring));
        assert_eq!(centroid[i], fold::<Centroid, f64>([], &ring));
        assert_eq!(
            bars[offsets[i]..offsets[i + 1]],
            <Folded<Centroid> as WithAdjoint>::vjp(&([], ring), ups[i]).1
        );
    }
    for (bad, row) in [
        (vec![1, 3], 0),
        (vec![0, 3, 2], 2),
        (vec![0, 2], 1),
        (vec![], 0),
        (vec![0, usize::MAX], 1),
    ] {
        assert_eq!(
            calls::ragged::<SignedArea, f64>(&vertices[..3], &bad),
            Err(Error::Offsets { item: row })
        );
    }
    let nan = [Vec2::new(0.0, f64::NAN)];
    assert_eq!(
        calls::ragged::<Perimeter, f64>(&nan, &[0, 1]),
        Err(Error::Invalid {
            argument: Argument::Vertices,
            item: 0,
            flaw: Flaw::NotFinite(Field::new("y"))
        })
    );
}

#[test]
fn a_share_of_a_box_in_itself() {
    let a = [Aabb2::new(0.0_f32, 0.0, 2.0, 2.0)];
    assert_eq!(calls::aligned::<IofAabb2, f32>(&a, &a).unwrap(), [1.0]);
}
