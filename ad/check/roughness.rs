//! The rounding errors of a function without a source, measured from its values. `rounding` calls it for closures.
use crate::ad::check::tolerances::{MEDIAN, SHARE_OF_ORDER, SPACINGS_F32, SPACINGS_F64};
use crate::ad::check::witness::Precision;
use crate::ad::sample::Draw;

/// Returns the roughness of a list-valued function near a point, per number: the standard deviation of its rounding
/// errors, from tables of differences (Hamming; Moré and Wild, "Estimating computational noise", 2011).
///
/// Between equally spaced inputs the differences of a smooth function fall from order to order, while the differences
/// of rounding errors grow in a known ratio. The smaller estimate of two orders therefore counts. Medians discard a
/// kink, which shows in few entries of a table. Three spacings are needed because a rounding in the middle of a
/// computation may be constant over many inputs. A table with an input outside the domain is skipped.
#[must_use]
pub fn roughness(
    precision: Precision,
    x: &[f64],
    scales: &[f64],
    f: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
) -> Vec<f64> {
    let spacings = match precision {
        Precision::F32 => SPACINGS_F32,
        Precision::F64 => SPACINGS_F64,
    };
    let mut rough: Vec<f64> = Vec::new();
    for (round, spacing) in (0..).zip(spacings) {
        let mut draw = Draw::new(round);
        let direction: Vec<f64> = scales
            .iter()
            .map(|scale| {
                let sign = if draw.once_in(2) { -1.0 } else { 1.0 };
                sign * draw.within(0.5, 1.0) * scale * 2.0_f64.powi(spacing)
            })
            .collect();
        let there = |k: i32| -> Vec<f64> {
            let moved = x.iter().zip(&direction);
            moved
                .map(|(x, d)| precision.round(x + f64::from(k) * d))
                .collect()
        };
        let lists: Option<Vec<Vec<f64>>> = (-6..=6).map(|k| f(&there(k))).collect();
        let Some(lists) = lists else { continue };
        let length = lists.iter().map(Vec::len).min().unwrap_or(0);
        rough.resize(rough.len().max(length), 0.0);
        for (i, rough) in rough.iter_mut().enumerate().take(length) {
            let mut table: Vec<f64> = lists.iter().map(|list| list[i]).collect();
            let mut least = f64::INFINITY;
            for order in 1..=4 {
                table = table.windows(2).map(|pair| pair[1] - pair[0]).collect();
                if order >= 3 {
                    let mut sizes: Vec<f64> = table.iter().map(|d| d.abs()).collect();
                    sizes.sort_by(f64::total_cmp);
                    let median = sizes[sizes.len() / 2];
                    least = least.min(MEDIAN * median * SHARE_OF_ORDER[order - 3].sqrt());
                }
            }
            if least.is_finite() {
                *rough = rough.max(least);
            }
        }
    }
    rough
}
