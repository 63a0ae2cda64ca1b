//! Milliseconds of the calls that `python/benches/bench.py overhead` makes, without Python, in `f32`. For one thread:
//!
//! ```sh
//! cargo build --profile wheel -p geograd-python -p geograd-rows --example aligned
//! RAYON_NUM_THREADS=1 target/wheel/examples/aligned
//! ```
use geograd::kernels::dynamic::{Function, Rows};
const COUNT: usize = 1_000_000;
const RUNS: u32 = 50;

/// Seconds of processor time of this process, in hundredths; of Linux only.
fn processor() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = stat
        .rsplit(')')
        .next()
        .unwrap_or_default()
        .split_whitespace();
    fields
        .skip(11)
        .take(2)
        .filter_map(|ticks| ticks.parse::<f64>().ok())
        .sum::<f64>()
        / 100.0
}

/// The processor time of a run in seconds, the mean of many.
fn mean(mut run: impl FnMut()) -> f64 {
    run();
    let start = processor();
    (0..RUNS).for_each(|_| run());
    (processor() - start) / f64::from(RUNS)
}

fn main() {
    let iou = geograd_rows::operations()
        .iter()
        .find(|row| row.name == "iou_obb2");
    let Some(iou) = iou else { return };
    let mut state = 1_u64;
    let mut uniform = |low: f32, high: f32| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        low + (high - low) * ((state >> 40) as f32 / (1_u64 << 24) as f32)
    };
    let (mut a, mut b) = (Vec::new(), Vec::new());
    for _ in 0..COUNT {
        let own = [
            uniform(-2.0, 2.0),
            uniform(-2.0, 2.0),
            uniform(0.5, 3.0),
            uniform(0.5, 3.0),
            uniform(-3.0, 3.0),
        ];
        a.extend(own);
        b.extend(own.map(|x| (x + uniform(-0.4, 0.4)).abs().max(0.1)));
    }
    let rows = [Rows::new(&a, 5), Rows::new(&b, 5)];
    let show = |name: &str, function: &Function<f32>, out: &mut [Vec<f32>]| {
        let seconds = mean(|| {
            let mut targets: Vec<_> = out.iter_mut().map(|list| Some(&mut list[..])).collect();
            assert!(function.aligned_into(&rows, &mut targets).is_ok());
        });
        println!("{name:20} {:8.2} ms", seconds * 1e3);
    };
    if let (Some(value), Some(value_grad)) = (iou.value::<f32>(), iou.value_grad::<f32>()) {
        show("value, out=", &value, &mut [vec![0.0; COUNT]]);
        show(
            "value_grad, out=",
            &value_grad,
            &mut [vec![0.0; COUNT], vec![0.0; 5 * COUNT], vec![0.0; 5 * COUNT]],
        );
        let one = [Rows::new(&a[..5], 5), Rows::new(&b[..5], 5)];
        let mut out = [0.0];
        let calls = 20_000;
        let seconds = mean(|| {
            for _ in 0..calls {
                assert!(value.aligned_into(&one, &mut [Some(&mut out[..])]).is_ok());
            }
        });
        println!(
            "one pair             {:8.2} us",
            seconds / f64::from(calls) * 1e6
        );
    }
}
