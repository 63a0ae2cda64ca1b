//! Batches on the GPU against batches on the CPU, for every operation of the list.
//!
//! Without an adapter the tests say so and pass, unless `GEOGRAD_REQUIRE_GPU=1`. A driver in
//! software will do.
use geograd::error::{Argument, Field};
use geograd::kernels::gpu::{Gpu, GpuPair, GpuRing, Options, pair_sources, ring_sources};
use geograd::kernels::{Backend, GpuError, cpu, overlap, reduce, ring};
use geograd::overlap::Denominator;
use geograd::{Aabb2, Error, Fixed, Flaw, Obb2, Vec2};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

const EPSILON: f64 = f32::EPSILON as f64;

/// Roundings on the longest way from an input to a result, each of at most an epsilon: six for the
/// place of a centre, three for a corner, four for the end of an edge, a division (two and a half
/// on a GPU), and sums of eight terms. A GPU may fuse or not where the CPU does the other.
const ROUNDINGS: f64 = 32.0;

/// One context for all tests, one test at a time: drivers in software use all cores anyway.
fn gpu() -> Option<(MutexGuard<'static, ()>, &'static Gpu)> {
    static TURN: Mutex<()> = Mutex::new(());
    static GPU: OnceLock<Option<Gpu>> = OnceLock::new();
    let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let made = GPU.get_or_init(|| match Gpu::new() {
        Ok(gpu) => {
            eprintln!("testing on {}", gpu.adapter());
            Some(gpu)
        }
        Err(error) => {
            let required = std::env::var("GEOGRAD_REQUIRE_GPU").is_ok_and(|x| x == "1");
            assert!(!required, "a GPU is required: {error}");
            eprintln!("SKIPPED, NOTHING WAS TESTED: {error}");
            None
        }
    });
    made.as_ref().map(|gpu| (turn, gpu))
}

/// Numbers in `[0, 1)`, the same ones every time.
struct Draws(u64);

impl Draws {
    fn next(&mut self) -> f32 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1_u64 << 24) as f32
    }
}

trait Draw: Fixed<Scalar = f32> + PartialEq + std::fmt::Debug {
    fn draw(draws: &mut Draws) -> Self;
    /// Shapes among which every pair is worth a look.
    fn hard() -> Vec<Self>;
    /// The longer and the shorter side.
    fn sides(self) -> (f64, f64);
    /// Whether which side of a kink a pair is on is decided without rounding: ties are ties on
    /// every machine.
    fn decides_exactly(self, other: Self) -> bool;
    /// A shape with a flaw, and the flaw.
    fn flawed() -> (Self, Flaw);
}

impl Draw for Obb2<f32> {
    fn draw(draws: &mut Draws) -> Self {
        let mut next = || draws.next();
        Obb2::new(
            4.0 * next(),
            4.0 * next(),
            0.1 + 3.0 * next(),
            0.1 + 3.0 * next(),
            7.0 * next() - 3.5,
        )
    }
    fn hard() -> Vec<Self> {
        let turn = std::f32::consts::FRAC_PI_2;
        vec![
            Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0),
            Obb2::new(0.0, 0.0, 2.0, 2.0, turn),
            Obb2::new(2.0, 0.0, 2.0, 2.0, 0.0),
            Obb2::new(0.0, 0.0, 2.0, 2.0, turn / 2.0),
            Obb2::new(0.25, 0.25, 0.5, 0.5, 0.0),
            Obb2::new(0.0, 0.0, 1e-3, 50.0, 0.7),
            Obb2::new(0.0, 0.0, 1e-3, 50.0, 0.7 + 1e-7),
            Obb2::new(3e-4, 0.0, 1e-3, 50.0, 0.7 + 1e-6),
            Obb2::new(0.0, 0.0, 50.0, 1e-3, 0.7),
            Obb2::new(0.0, 0.0, 0.0, 1.0, 0.3),
            Obb2::new(0.0, 0.0, 0.0, 0.0, 0.0),
            Obb2::new(1e6, -1e6, 4.0, 2.0, 0.3),
            Obb2::new(1e6 + 1.0, -1e6, 4.0, 2.0, 0.4),
            Obb2::new(0.0, 0.0, 2.0, 1.0, 1e6),
            Obb2::new(0.0, 0.0, 2.0, 1.0, -3e30),
        ]
    }
    fn sides(self) -> (f64, f64) {
        let (x, y) = (f64::from(self.size.x), f64::from(self.size.y));
        (x.max(y), x.min(y))
    }
    fn decides_exactly(self, other: Self) -> bool {
        // Hard cases without heading are made of few binary digits.
        self.heading == 0.0 && other.heading == 0.0
    }
    fn flawed() -> (Self, Flaw) {
        let flaw = Flaw::NotFinite(Field::Heading);
        (Obb2::new(0.0, 0.0, 1.0, 1.0, f32::NAN), flaw)
    }
}

impl Draw for Aabb2<f32> {
    fn draw(draws: &mut Draws) -> Self {
        let (x, y) = (4.0 * draws.next(), 4.0 * draws.next());
        Aabb2::new(x, y, x + 0.1 + draws.next(), y + 0.1 + draws.next())
    }
    fn hard() -> Vec<Self> {
        vec![
            Aabb2::new(0.0, 0.0, 2.0, 2.0),
            Aabb2::new(2.0, 0.0, 4.0, 2.0),
            Aabb2::new(1.0, 0.0, 3.0, 2.0),
            Aabb2::new(0.5, 0.5, 1.0, 1.0),
            Aabb2::new(1.0, 1.0, 1.0, 1.0),
            Aabb2::new(1.0, 0.0, 1.0, 9.0),
            Aabb2::new(-1e6, -1e6, 1e6, 1e6),
            Aabb2::new(0.0, 0.0, 1e-3, 50.0),
        ]
    }
    fn sides(self) -> (f64, f64) {
        let (x, y) = (
            f64::from(self.max.x) - f64::from(self.min.x),
            f64::from(self.max.y) - f64::from(self.min.y),
        );
        (x.max(y), x.min(y))
    }
    fn decides_exactly(self, _: Self) -> bool {
        // Bounds are compared as they come.
        true
    }
    fn flawed() -> (Self, Flaw) {
        let flaw = Flaw::Inverted(Field::MinX);
        (Aabb2::new(1.0, 0.0, 0.0, 1.0), flaw)
    }
}

/// Every hard shape with every other, then random ones.
fn pairs<P: Draw>(random: usize) -> (Vec<P>, Vec<P>) {
    let hard = P::hard();
    let (mut a, mut b) = (Vec::new(), Vec::new());
    for &x in &hard {
        for &y in &hard {
            a.push(x);
            b.push(y);
        }
    }
    let mut draws = Draws(7);
    for _ in 0..random {
        a.push(P::draw(&mut draws));
        b.push(P::draw(&mut draws));
    }
    (a, b)
}

fn fields<P: Fixed<Scalar = f32>>(shape: P) -> Vec<f64> {
    let fields = shape.to_array();
    fields.as_ref().iter().map(|&x| f64::from(x)).collect()
}

/// The shape with these fields.
fn shape_of<P: Fixed>(fields: &[P::Scalar]) -> P
where
    P::Scalar: Copy,
{
    let mut all = P::filled(fields[0]).to_array();
    all.as_mut().copy_from_slice(&fields[..P::LEN]);
    P::from_array(all)
}

/// How far results of a pair may lie apart.
///
/// An area of intersection changes by the displacement of its border times its length. With L the
/// longest side of both boxes, W the larger of their shorter sides, and l the longer side of the
/// smaller box: short sides and edges across are displaced by at most k·ε·L along a border of at
/// most min(W, l); long edges by k·ε·W, and by 2⁻³⁵·L for the relative heading, whose products
/// carry low parts, along at most l. A ratio divides that by its denominator and adds its own
/// roundings.
fn value_bound<O: GpuPair>(a: O::Shape, b: O::Shape, value: f64) -> f64
where
    O::Shape: Draw,
{
    let ((long_a, short_a), (long_b, short_b)) = (a.sides(), b.sides());
    let (long, small) = (long_a.max(long_b), long_a.min(long_b));
    let wide = short_a.max(short_b).min(small);
    let border = ROUNDINGS * (2.0 * EPSILON * long * wide + (-35_f64).exp2() * long * small);
    let over = match O::DENOMINATOR {
        Denominator::None => return border + ROUNDINGS * EPSILON * value,
        Denominator::Union => (long_a * short_a).max(long_b * short_b),
        Denominator::First => long_a * short_a,
    };
    let share = if over > 0.0 { 2.0 * border / over } else { 0.0 };
    (share + ROUNDINGS * EPSILON).min(1.0)
}

/// The slopes of a pair in `f64`, the fields of b after those of a.
fn wide_slopes<O: GpuPair>(a: &[f64], b: &[f64]) -> Vec<f64> {
    let a: cpu::A<O, f64> = shape_of(a);
    let b: cpu::B<O, f64> = shape_of(b);
    let Ok((_, a_bar, b_bar)) = cpu::aligned_grad::<O, f64>(&[a], &[b]) else {
        return Vec::new();
    };
    let (a_bar, b_bar) = (a_bar[0].to_array(), b_bar[0].to_array());
    [a_bar.as_ref(), b_bar.as_ref()].concat()
}

/// How far each slope may lie from the CPU's: both are the exact slopes of inputs moved by at most
/// k·ε of the longest side (rounding is a displacement of borders), and round a few times
/// themselves. Slopes jump at kinks, so inputs are moved every which way and the spread is taken,
/// except where rounding has no say in which side of a kink it is.
/// A ratio's slope with respect to a size is the difference of two terms as large as the ratio over
/// that size, which may cancel.
fn slope_bounds<O: GpuPair>(a: O::Shape, b: O::Shape, value: f64, draws: &mut Draws) -> Vec<f64>
where
    O::Shape: Draw,
{
    let (a_fields, b_fields) = (fields(a), fields(b));
    let exact = wide_slopes::<O>(&a_fields, &b_fields);
    let reach = ROUNDINGS * EPSILON * a.sides().0.max(b.sides().0);
    let mut spread: Vec<f64> = vec![0.0; exact.len()];
    let trials = if a.decides_exactly(b) { 0 } else { 24 };
    for trial in 0..trials {
        let size = reach * 0.25_f64.powi(trial % 3);
        let mut moved = |fields: &[f64]| -> Vec<f64> {
            let step = |(k, &x): (usize, &f64)| {
                let by = size * (2.0 * f64::from(draws.next()) - 1.0);
                // Sizes stay positive; a heading is displaced relative to the sides.
                match (O::Shape::LEN, k) {
                    (5, 2 | 3) => x + by.abs(),
                    (5, 4) => x + by / reach.max(1e-30) * ROUNDINGS * EPSILON,
                    _ => x + by,
                }
            };
            fields.iter().enumerate().map(step).collect()
        };
        let near = wide_slopes::<O>(&moved(&a_fields), &moved(&b_fields));
        for ((spread, exact), near) in spread.iter_mut().zip(&exact).zip(&near) {
            *spread = spread.max((exact - near).abs());
        }
    }
    let largest = exact.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let term = |shape: O::Shape| match shape.sides().1 {
        short if short > 0.0 && O::IS_RATIO => value / short,
        _ => 0.0,
    };
    let terms = largest.max(term(a)).max(term(b));
    let bound = |x: &f64| 2.0 * x + ROUNDINGS * EPSILON * terms;
    spread.iter().map(bound).collect()
}

fn aligned_agree<O: GpuPair>()
where
    O::Shape: Draw,
{
    let Some((_turn, gpu)) = gpu() else { return };
    let (a, b) = pairs::<O::Shape>(300);
    let (on_a, on_b) = (gpu.upload(&a).unwrap(), gpu.upload(&b).unwrap());
    let expected = cpu::aligned_grad::<O, f32>(&a, &b).unwrap();
    let values = gpu.aligned::<O>(&on_a, &on_b).unwrap().download().unwrap();
    let (same, a_bars, b_bars) = gpu.aligned_grad::<O>(&on_a, &on_b).unwrap();
    let (same, a_bars, b_bars) = (
        same.download().unwrap(),
        a_bars.download().unwrap(),
        b_bars.download().unwrap(),
    );
    assert_eq!(values.len(), a.len());
    let mut draws = Draws(3);
    for i in 0..a.len() {
        let found = f64::from(values[i]);
        let bound = value_bound::<O>(a[i], b[i], f64::from(expected.0[i]));
        for found in [found, f64::from(same[i])] {
            assert!(
                (found - f64::from(expected.0[i])).abs() <= bound,
                "{} {i}: {:?} {:?}: {found} for {} ± {bound}",
                O::NAME,
                a[i],
                b[i],
                expected.0[i]
            );
        }
        let found = [fields(a_bars[i]), fields(b_bars[i])].concat();
        let expected = [fields(expected.1[i]), fields(expected.2[i])].concat();
        let bounds = slope_bounds::<O>(a[i], b[i], f64::from(values[i]), &mut draws);
        for k in 0..found.len() {
            assert!(
                (found[k] - expected[k]).abs() <= bounds[k],
                "{} {i}, slope {k}: {:?} {:?}: {} for {} ± {}",
                O::NAME,
                a[i],
                b[i],
                found[k],
                expected[k],
                bounds[k]
            );
        }
    }
    // An upstream of ones changes nothing, one of twos doubles exactly.
    for (factor, upstream) in [(1.0, vec![1.0; a.len()]), (2.0, vec![2.0; a.len()])] {
        let upstream = gpu.upload_values(&upstream).unwrap();
        let (again, _) = gpu.aligned_vjp::<O>(&on_a, &on_b, &upstream).unwrap();
        for (again, once) in again.download().unwrap().iter().zip(&a_bars) {
            for (again, once) in fields(*again).iter().zip(fields(*once)) {
                assert_eq!(*again, once * factor);
            }
        }
    }
}

/// The same numbers up to how a driver compiled another kernel around the same function.
fn close(x: f32, y: f32) -> bool {
    (f64::from(x) - f64::from(y)).abs() <= ROUNDINGS * EPSILON * f64::from(y).abs().max(1e-3)
}

fn all_pairs_agree<O: GpuPair>(gpu: &Gpu, rows: usize, columns: usize)
where
    O::Shape: Draw,
{
    let mut draws = Draws(11);
    let a: Vec<O::Shape> = (0..rows).map(|_| Draw::draw(&mut draws)).collect();
    let b: Vec<O::Shape> = (0..columns).map(|_| Draw::draw(&mut draws)).collect();
    let (on_a, on_b) = (gpu.upload(&a).unwrap(), gpu.upload(&b).unwrap());
    let matrix = gpu.all_pairs::<O>(&on_a, &on_b).unwrap();
    let values = matrix.download().unwrap();
    let expected = cpu::all_pairs::<O, f32>(&a, &b).unwrap();
    assert_eq!(values.len(), expected.len());
    for (at, (&found, &value)) in values.iter().zip(&expected).enumerate() {
        let bound = value_bound::<O>(a[at / columns], b[at % columns], f64::from(value));
        assert!(
            (f64::from(found) - f64::from(value)).abs() <= bound,
            "{} {at}: {found} for {value}",
            O::NAME
        );
    }

    // Sums: whatever the order, an error of one epsilon of the sum of magnitudes per term.
    let grads = gpu.all_pairs_grad::<O>(&on_a, &on_b).unwrap();
    let upstream: Vec<f32> = (0..values.len()).map(|_| draws.next() - 0.5).collect();
    let on_upstream = gpu.upload_matrix(rows, columns, &upstream).unwrap();
    let (a_bars, b_bars) = gpu.all_pairs_vjp::<O>(&on_a, &on_b, &on_upstream).unwrap();
    let (a_again, b_again) = gpu
        .all_pairs_vjp_from::<O>(&on_a, &on_b, &upstream)
        .unwrap();
    let (a_bars, b_bars) = (a_bars.download().unwrap(), b_bars.download().unwrap());
    assert_eq!(a_bars, a_again.download().unwrap(), "the same bits");
    assert_eq!(b_bars, b_again.download().unwrap(), "the same bits");
    let len = O::Shape::LEN;
    let check = |bars: Vec<f64>, terms: &dyn Fn(usize, usize) -> f64, n: usize| {
        for (k, found) in bars.into_iter().enumerate() {
            let (mut sum, mut size) = (0.0, 0.0);
            for i in 0..n {
                sum += terms(k, i);
                size += terms(k, i).abs();
            }
            let bound = (n as f64 + ROUNDINGS) * EPSILON * size;
            assert!(
                (found - sum).abs() <= bound,
                "{}: {found} for {sum}",
                O::NAME
            );
        }
    };
    for i in 0..rows {
        let term = |k: usize, j: usize| {
            f64::from(upstream[i * columns + j])
                * f64::from(grads.planes[(k * rows + i) * columns + j])
        };
        check(fields(a_bars[i]), &term, columns);
    }
    for j in 0..columns {
        let term = |k: usize, i: usize| {
            f64::from(upstream[i * columns + j])
                * f64::from(grads.planes[((len + k) * rows + i) * columns + j])
        };
        check(fields(b_bars[j]), &term, rows);
    }

    // Reductions against the matrix itself.
    let best = gpu.row_max::<O>(&on_a, &on_b).unwrap().download().unwrap();
    for (row, best) in values.chunks(columns).zip(&best) {
        let most = row.iter().fold(0.0_f32, |x, &y| x.max(y));
        assert!(close(best.value, most) && close(row[best.index], most));
    }
    let best = gpu
        .column_max::<O>(&on_a, &on_b)
        .unwrap()
        .download()
        .unwrap();
    assert_eq!(best.len(), columns);
    for (j, best) in best.iter().enumerate() {
        let most = (0..rows).fold(0.0_f32, |x, i| x.max(values[i * columns + j]));
        assert!(close(best.value, most) && close(values[best.index * columns + j], most));
    }
    let threshold = 0.2;
    let found = gpu.above::<O>(&on_a, &on_b, threshold).unwrap();
    assert_eq!(
        gpu.count_above::<O>(&on_a, &on_b, threshold).unwrap(),
        found.len() as u64
    );
    assert!(found.is_sorted_by_key(|found| (found.row, found.column)));
    assert!(
        found
            .iter()
            .all(|f| f.value > threshold && close(f.value, values[f.row * columns + f.column]))
    );
    let clearly = |by: f32| values.iter().filter(|&&v| v > by).count();
    assert!((clearly(0.20001)..=clearly(0.19999)).contains(&found.len()));
    let exact: f64 = values.iter().map(|&v| f64::from(v)).sum();
    let sum = gpu.sum::<O>(&on_a, &on_b).unwrap();
    assert!((sum - exact).abs() <= (1024.0 + ROUNDINGS) * EPSILON * exact);
}

/// Bits, so that not even the sign of a zero may differ.
fn bits(values: &[f32]) -> Vec<u32> {
    values.iter().map(|x| x.to_bits()).collect()
}

#[test]
fn repeated_runs_give_the_same_bits() {
    let Some((_turn, gpu)) = gpu() else { return };
    let mut draws = Draws(1);
    let boxes: Vec<Obb2<f32>> = (0..700).map(|_| Draw::draw(&mut draws)).collect();
    let on = gpu.upload(&boxes).unwrap();
    let run = || {
        let matrix = gpu.all_pairs::<overlap::IouObb2>(&on, &on).unwrap();
        let bars = gpu.all_pairs_vjp::<overlap::IouObb2>(&on, &on, &matrix);
        let (a_bars, b_bars) = bars.unwrap();
        let mut all = bits(&matrix.download().unwrap());
        for bar in [a_bars, b_bars].iter().flat_map(|x| x.download().unwrap()) {
            all.extend(bits(&bar.to_array()));
        }
        all
    };
    let first = run();
    for _ in 0..3 {
        assert_eq!(run(), first);
    }
}

#[test]
fn the_first_of_several_is_the_best() {
    let Some((_turn, gpu)) = gpu() else { return };
    // The same few boxes again and again, in more than one strip, tile and buffer.
    let few = Aabb2::<f32>::hard();
    let many: Vec<_> = few.iter().copied().cycle().take(2500).collect();
    for gpu in [gpu, &small()] {
        let (on_few, on_many) = (gpu.upload(&few).unwrap(), gpu.upload(&many).unwrap());
        let found = gpu.row_max::<overlap::IouAabb2>(&on_few, &on_many).unwrap();
        let expected = reduce::row_max::<overlap::IouAabb2, f32>(&few, &many).unwrap();
        let indices = |all: Vec<reduce::Best>| all.iter().map(|x| x.index).collect::<Vec<_>>();
        assert_eq!(indices(found.download().unwrap()), indices(expected));
        let found = gpu
            .column_max::<overlap::IouAabb2>(&on_many, &on_few)
            .unwrap();
        let expected = reduce::column_max::<overlap::IouAabb2, f32>(&many, &few).unwrap();
        assert_eq!(indices(found.download().unwrap()), indices(expected));
    }
}

#[test]
fn more_than_a_strip() {
    let Some((_turn, gpu)) = gpu() else { return };
    all_pairs_agree::<overlap::IouAabb2>(gpu, 3, 2500);
    all_pairs_agree::<overlap::IouObb2>(gpu, 2500, 3);
}

#[test]
fn without_subgroups() {
    let Some((_turn, _)) = gpu() else { return };
    let mut options = Options::default();
    options.subgroups = false;
    let gpu = Gpu::with(&options).unwrap();
    assert!(!gpu.has_subgroups());
    all_pairs_agree::<overlap::IouObb2>(&gpu, 40, 300);
    all_pairs_agree::<overlap::IofAabb2>(&gpu, 300, 40);
}

#[test]
fn identical_and_thin_boxes() {
    let Some((_turn, gpu)) = gpu() else { return };
    let mut draws = Draws(9);
    let mut boxes: Vec<Obb2<f32>> = (0..200).map(|_| Draw::draw(&mut draws)).collect();
    boxes.extend((0..200).map(|_| Obb2::new(0.0, 0.0, 1e-3, 50.0, 7.0 * draws.next())));
    let on = gpu.upload(&boxes).unwrap();
    let (values, a_bars, _) = gpu.aligned_grad::<overlap::IouObb2>(&on, &on).unwrap();
    assert!(values.download().unwrap().iter().all(|&value| value == 1.0));
    for bar in a_bars.download().unwrap() {
        assert!(fields(bar).iter().all(|&slope| slope == 0.0), "{bar:?}");
    }
    // Thin boxes ever so slightly turned: the exact ratio, from f64, to the last few digits.
    for by in [1e-7_f32, 1e-6, 1e-5] {
        let turned: Vec<Obb2<f32>> = boxes
            .iter()
            .map(|shape| Obb2 {
                heading: shape.heading + by,
                ..*shape
            })
            .collect();
        let found = gpu.upload(&turned).unwrap();
        let found = gpu.aligned::<overlap::IouObb2>(&on, &found).unwrap();
        for (i, found) in found.download().unwrap().into_iter().enumerate() {
            let wide = |x: &Obb2<f32>| shape_of::<Obb2<f64>>(&fields(*x));
            let exact = wide(&boxes[i]).iou(wide(&turned[i]));
            // The relative heading is right to 2⁻³⁵, which over 25 is 7e-10 of a width of 1e-3.
            assert!(
                (f64::from(found) - exact).abs() < 5e-6,
                "{i}: {found} for {exact}"
            );
        }
    }
}

/// Where sizes differ by many powers of ten: finite wherever the source is finite (that it always
/// is, is for its own tests), and the same values.
fn extremes_agree<O: GpuPair<Shape = Obb2<f32>>>(gpu: &Gpu) {
    let sizes = [0.0, 1e-38, 1e-20, 1.0, 1e18, 1e38_f32];
    let mut boxes = Vec::new();
    for x in sizes {
        for y in sizes {
            boxes.push(Obb2::new(0.0, 0.0, x, y, 0.3));
            boxes.push(Obb2::new(x, -y, y, x, 1.0));
        }
    }
    let on = gpu.upload(&boxes).unwrap();
    let found = gpu.all_pairs_grad::<O>(&on, &on).unwrap();
    let expected = cpu::all_pairs_grad::<O, f32>(&boxes, &boxes).unwrap();
    for (at, (found, expected)) in found.planes.iter().zip(&expected.planes).enumerate() {
        let (i, j) = (at / boxes.len() % boxes.len(), at % boxes.len());
        assert!(
            found.is_finite() || !expected.is_finite(),
            "{} {:?} {:?}: {found}, on the CPU {expected}",
            O::NAME,
            boxes[i],
            boxes[j]
        );
    }
    for (found, expected) in found.values.iter().zip(expected.values) {
        assert!(
            (found - expected).abs() <= 1e-5 * expected.max(1.0),
            "{}: {found} for {expected}",
            O::NAME
        );
    }
}

#[test]
fn extreme_sizes() {
    let Some((_turn, gpu)) = gpu() else { return };
    extremes_agree::<overlap::IntersectionAreaObb2>(gpu);
    extremes_agree::<overlap::IouObb2>(gpu);
    extremes_agree::<overlap::IofObb2>(gpu);
}

fn bad_input_is_refused<O: GpuPair>()
where
    O::Shape: Draw,
{
    let Some((_turn, gpu)) = gpu() else { return };
    let (bad, flaw) = O::Shape::flawed();
    let good = O::Shape::hard()[0];
    let invalid = |argument| {
        GpuError::Input(Error::Invalid {
            argument,
            row: 1,
            flaw,
        })
    };
    assert_eq!(
        gpu.upload(&[good, bad]).unwrap_err(),
        invalid(Argument::Shape)
    );
    let backend = Backend::Gpu(gpu);
    let refused = backend.aligned::<O>(&[good, good], &[good, bad]);
    assert_eq!(refused.unwrap_err(), invalid(Argument::B));
    let refused = backend.all_pairs::<O>(&[good, bad], &[good]);
    assert_eq!(refused.unwrap_err(), invalid(Argument::A));
    let on = gpu.upload(&[good, good]).unwrap();
    let one = gpu.upload(&[good]).unwrap();
    let length = |argument, expected, found| {
        GpuError::Input(Error::Length {
            argument,
            expected,
            found,
        })
    };
    let refused = gpu.aligned::<O>(&on, &one).unwrap_err();
    assert_eq!(refused, length(Argument::B, 2, 1));
    let upstream = gpu.upload_values(&[1.0]).unwrap();
    let refused = gpu.aligned_vjp::<O>(&on, &on, &upstream).unwrap_err();
    assert_eq!(refused, length(Argument::Upstream, 2, 1));
    assert!(gpu.upload_values(&[f32::INFINITY]).is_err());
    assert!(gpu.upload_matrix(2, 2, &[1.0; 3]).is_err());
    assert!(gpu.above::<O>(&on, &on, f32::NAN).is_err());
    // What was refused harmed nothing.
    assert!(gpu.aligned::<O>(&on, &on).unwrap().download().is_ok());
}

fn empty_batches_are_valid<O: GpuPair>()
where
    O::Shape: Draw,
{
    let Some((_turn, gpu)) = gpu() else { return };
    let backend = Backend::Gpu(gpu);
    let (none, one) = (&[][..], &[O::Shape::hard()[0]][..]);
    assert_eq!(backend.aligned::<O>(none, none).unwrap(), []);
    assert_eq!(backend.aligned_grad::<O>(none, none).unwrap().0, []);
    assert_eq!(backend.all_pairs::<O>(none, one).unwrap(), []);
    assert_eq!(backend.all_pairs::<O>(one, none).unwrap(), []);
    assert_eq!(backend.all_pairs_grad::<O>(one, none).unwrap().planes, []);
    let (a_bars, b_bars) = backend.all_pairs_vjp::<O>(one, none, &[]).unwrap();
    assert_eq!((a_bars.len(), b_bars.len()), (1, 0));
    assert!(fields(a_bars[0]).iter().all(|&slope| slope == 0.0));
    assert_eq!(backend.row_max::<O>(none, one).unwrap(), []);
    assert_eq!(
        backend.row_max::<O>(one, none).unwrap_err(),
        Backend::Cpu.row_max::<O>(one, none).unwrap_err()
    );
    assert_eq!(backend.above::<O>(one, none, 0.5).unwrap(), []);
    assert_eq!(backend.sum::<O>(one, none).unwrap(), 0.0);
    assert_eq!(backend.mean::<O>(none, none).unwrap(), 0.0);
}

#[test]
fn rings_may_be_missing_or_bad() {
    let Some((_turn, gpu)) = gpu() else { return };
    let backend = Backend::Gpu(gpu);
    assert_eq!(backend.ragged::<ring::SignedArea>(&[], &[0]).unwrap(), []);
    assert_eq!(
        backend.ragged::<ring::SignedArea>(&[], &[0, 0]).unwrap(),
        [0.0]
    );
    for (vertices, offsets) in [
        (vec![Vec2::new(f32::NAN, 0.0)], vec![0, 1]),
        (vec![Vec2::new(0.0, 0.0)], vec![0, 2]),
        (vec![], vec![]),
    ] {
        assert_eq!(
            backend
                .ragged::<ring::Centroid>(&vertices, &offsets)
                .unwrap_err(),
            Backend::Cpu
                .ragged::<ring::Centroid>(&vertices, &offsets)
                .unwrap_err()
        );
    }
}

#[test]
fn a_lost_device_is_an_error() {
    let Some((_turn, other)) = gpu() else { return };
    let gpu = Gpu::new().unwrap();
    let boxes = Obb2::<f32>::hard();
    let on = gpu.upload(&boxes).unwrap();
    let values = gpu.aligned::<overlap::IouObb2>(&on, &on).unwrap();
    let pending = values.start_download().unwrap();
    // A handle of one context is nothing to another.
    let foreign = other.aligned::<overlap::IouObb2>(&on, &on);
    assert_eq!(foreign.unwrap_err(), GpuError::ForeignBuffer);
    gpu.destroy();
    assert_eq!(pending.wait().unwrap_err(), GpuError::DeviceLost);
    assert_eq!(values.download().unwrap_err(), GpuError::DeviceLost);
    assert_eq!(gpu.upload(&boxes).unwrap_err(), GpuError::DeviceLost);
    assert_eq!(gpu.wait().unwrap_err(), GpuError::DeviceLost);
    let lost = gpu.all_pairs::<overlap::IouObb2>(&on, &on);
    assert_eq!(lost.unwrap_err(), GpuError::DeviceLost);
}

#[test]
fn too_much_is_an_error() {
    let Some((_turn, gpu)) = gpu() else { return };
    // More than any address space: refused before anything is asked of the device.
    let refused = gpu.upload_matrix(usize::MAX, 2, &[]);
    assert_eq!(refused.unwrap_err(), GpuError::Input(Error::TooLarge));
}

#[test]
fn downloads_can_be_awaited() {
    let Some((_turn, gpu)) = gpu() else { return };
    let on = gpu.upload(&Obb2::<f32>::hard()).unwrap();
    let matrix = gpu.all_pairs::<overlap::IouObb2>(&on, &on).unwrap();
    let awaited = pollster::block_on(matrix.start_download().unwrap()).unwrap();
    assert_eq!(bits(&awaited), bits(&matrix.download().unwrap()));
}

#[test]
fn contexts_are_shared_between_threads() {
    let Some((_turn, gpu)) = gpu() else { return };
    let on = gpu.upload(&Obb2::<f32>::hard()).unwrap();
    let once = || {
        gpu.all_pairs::<overlap::IouObb2>(&on, &on)
            .unwrap()
            .download()
            .unwrap()
    };
    let first = bits(&once());
    std::thread::scope(|scope| {
        for _ in 0..4 {
            // Again and again: threads are told of each other's downloads.
            scope.spawn(|| (0..25).for_each(|_| assert_eq!(bits(&once()), first)));
        }
    });
}

#[test]
fn adapters_are_chosen_by_name() {
    use geograd::kernels::gpu::Choice;
    assert_eq!(Choice::parse(" CPU "), Choice::Cpu);
    assert_eq!(Choice::parse("1"), Choice::Index(1));
    assert_eq!(Choice::parse("H200"), Choice::Name("H200".to_owned()));
    let Some((_turn, gpu)) = gpu() else { return };
    let mut options = Options::default();
    options.adapter = Choice::Index(gpu.adapter().index);
    assert_eq!(Gpu::with(&options).unwrap().adapter(), gpu.adapter());
    options.adapter = Choice::Name("no such GPU".to_owned());
    assert_eq!(Gpu::with(&options).unwrap_err(), GpuError::NoSuchAdapter);
}

#[test]
fn rows_in_errors_count_from_the_start() {
    // More rows than a reduction on the CPU takes at a time.
    let mut boxes = vec![Aabb2::new(0.0, 0.0, 1.0, 1.0); 600];
    boxes[599].max.x = -1.0;
    let refused = reduce::row_max::<overlap::IouAabb2, f32>(&boxes, &boxes[..500]);
    let expected = Error::Invalid {
        argument: Argument::A,
        row: 599,
        flaw: Flaw::Inverted(Field::MinX),
    };
    assert_eq!(refused.unwrap_err(), expected);
}

/// A context whose buffers are so small that everything is split.
fn small() -> Gpu {
    let mut options = Options::default();
    options.most_bytes = Some(64 * 64);
    Gpu::with(&options).unwrap()
}

fn rings() -> (Vec<Vec2<f32>>, Vec<usize>) {
    let mut draws = Draws(5);
    let v = Vec2::new;
    let mut vertices = vec![
        // A triangle, a figure of eight, a line, a point twice, a square far away.
        v(0.0, 0.0),
        v(4.0, 0.0),
        v(0.0, 3.0),
        v(0.0, 0.0),
        v(1.0, 1.0),
        v(1.0, 0.0),
        v(0.0, 1.0),
        v(0.0, 0.0),
        v(1.0, 1.0),
        v(2.0, 2.0),
        v(5.0, 5.0),
        v(5.0, 5.0),
        v(1e6, 1e6),
        v(1e6 + 2.0, 1e6),
        v(1e6 + 2.0, 1e6 + 2.0),
        v(1e6, 1e6 + 2.0),
    ];
    let mut offsets = vec![0, 3, 7, 10, 12, 12, 16];
    for n in 0..60 {
        for i in 0..n {
            let (sin, cos) = (i as f32 / n as f32 * std::f32::consts::TAU).sin_cos();
            let r = 1.0 + draws.next();
            vertices.push(v(7.0 + r * cos, -3.0 + r * sin));
        }
        offsets.push(vertices.len());
    }
    (vertices, offsets)
}

fn rings_agree<O: GpuRing>(gpu: &Gpu) {
    let (vertices, offsets) = rings();
    let on = gpu.upload_rings(&vertices, &offsets).unwrap();
    let found = gpu.ragged::<O>(&on).unwrap().download().unwrap();
    let expected = cpu::ragged::<O, f32>(&vertices, &offsets).unwrap();
    assert_eq!(found.len(), expected.len());
    let upstream = vec![shape_of(&[1.5, -0.5]); expected.len()];
    let bars = gpu
        .ragged_vjp::<O>(&on, &upstream)
        .unwrap()
        .download()
        .unwrap();
    let expected_bars = cpu::ragged_vjp::<O, f32>(&vertices, &offsets, &upstream).unwrap();
    assert_eq!(bars.len(), expected_bars.len());
    for (ring, (found, expected)) in found.iter().zip(&expected).enumerate() {
        // Sums over edges of terms no larger than the square of the ring's extent, which is below
        // five; centroids divide them by areas of at least one, and add the first vertex.
        let edges = (offsets[ring + 1] - offsets[ring]) as f64;
        for (found, expected) in fields(*found).iter().zip(fields(*expected)) {
            let bound = (edges + ROUNDINGS) * EPSILON * (25.0 + expected.abs());
            assert!(
                (found - expected).abs() <= bound,
                "{} {ring}: {found} for {expected}",
                O::NAME
            );
        }
        for i in offsets[ring]..offsets[ring + 1] {
            for (found, expected) in fields(bars[i]).iter().zip(fields(expected_bars[i])) {
                let bound = (edges + ROUNDINGS) * EPSILON * (25.0 + expected.abs());
                assert!(
                    (found - expected).abs() <= bound,
                    "{} {ring}: {found} for {expected}",
                    O::NAME
                );
            }
        }
    }
}

/// A shader parses and passes validation without any GPU.
fn validate(name: &str, text: &str) {
    use naga::valid::{Capabilities, ValidationFlags, Validator};
    let module = match naga::front::wgsl::parse_str(text) {
        Ok(module) => module,
        Err(error) => panic!("{name}: {}", error.emit_to_string(text)),
    };
    // WebGPU's own capabilities, and subgroups where a device has them.
    let capabilities = Capabilities::SUBGROUP;
    if let Err(error) = Validator::new(ValidationFlags::all(), capabilities).validate(&module) {
        panic!("{name}: {}", error.emit_to_string(text));
    }
}

macro_rules! walk {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }) => {
        $(mod $pair {
            #[test]
            fn shaders_are_valid() {
                for (name, text) in super::pair_sources::<$pair_op>() {
                    super::validate(&name, &text);
                }
            }
            #[test]
            fn aligned() {
                super::aligned_agree::<$pair_op>();
            }
            #[test]
            fn all_pairs() {
                let Some((_turn, gpu)) = super::gpu() else { return };
                super::all_pairs_agree::<$pair_op>(gpu, 67, 300);
                super::all_pairs_agree::<$pair_op>(gpu, 1, 1);
            }
            #[test]
            fn bad_input() {
                super::bad_input_is_refused::<$pair_op>();
                super::empty_batches_are_valid::<$pair_op>();
            }
            #[test]
            fn all_pairs_split() {
                let Some((_turn, _)) = super::gpu() else { return };
                super::all_pairs_agree::<$pair_op>(&super::small(), 70, 150);
            }
        })*
        $(mod $ring {
            #[test]
            fn shaders_are_valid() {
                for (name, text) in super::ring_sources::<$ring_op>() {
                    super::validate(&name, &text);
                }
            }
            #[test]
            fn ragged() {
                let Some((_turn, gpu)) = super::gpu() else { return };
                super::rings_agree::<$ring_op>(gpu);
                super::rings_agree::<$ring_op>(&super::small());
            }
        })*
    };
}
geograd::for_each_op!(walk);
