//! The table of a run.
use crate::loss::{Goal, Space};
use crate::matching::{self, Quality};
use crate::precision::Precision;
use crate::refine;
use std::fmt::Write as _;
use std::time::Duration;

/// The counts of a run.
pub struct Counts {
    pub frames: usize,
    pub detections: usize,
    pub truths: usize,
    /// Detections with low scores, and truths of other classes.
    pub left_out: (usize, usize),
    /// Detections that overlap a better one; `None` if suppression was not asked for.
    pub suppressed: Option<usize>,
    /// Detections that are moved without overlap.
    pub apart: usize,
    pub pairs: usize,
}

/// How long it took.
pub struct Times {
    pub matching: Duration,
    pub refining: refine::Cost,
    pub all: Duration,
}

/// The table of a run.
pub fn table(counts: &Counts, before: &Quality, after: &Quality, times: &Times) -> String {
    let Counts {
        detections, truths, ..
    } = counts;
    let mut lines = vec![
        format!("frames             {:>9}", counts.frames),
        format!("boxes              {detections:>9} detections, {truths} ground truth"),
    ];
    if counts.left_out != (0, 0) {
        let (low, other) = counts.left_out;
        lines.push(format!(
            "  left out         {low:>9} by score, {other} of other classes"
        ));
    }
    if let Some(suppressed) = counts.suppressed {
        lines.push(format!("  suppressed       {suppressed:>9}"));
    }
    lines.push(format!("pairs              {:>9}", counts.pairs));
    if counts.apart > 0 {
        let apart = counts.apart;
        lines.push(format!(
            "  moved, apart     {apart:>9} near a truth without overlap"
        ));
    }
    lines.push("\n                      before     after".into());
    lines.push(format!(
        "matches            {:>9} {:>9}",
        before.matches, after.matches
    ));
    let mut row = |name: &str, before: Option<f64>, after: Option<f64>| {
        let show = |x: Option<f64>| x.map_or("-".to_string(), |x| format!("{x:.4}"));
        lines.push(format!("{name:18} {:>9} {:>9}", show(before), show(after)));
    };
    for (i, threshold) in matching::THRESHOLDS.iter().enumerate() {
        let name = |what: &str| format!("{what} at {threshold}");
        row(&name("precision"), before.precision[i], after.precision[i]);
        row(&name("recall"), before.recall[i], after.recall[i]);
    }
    row("mean IoU", before.mean_iou, after.mean_iou);
    lines.push("\npairs per second".into());
    let mut rate = |name: &str, count: usize, time: Duration, what: &str| {
        // Nothing done is no rate.
        if count > 0 {
            let millions = count as f64 / time.as_secs_f64().max(1e-9) / 1e6;
            lines.push(format!("  {name:16} {millions:>9.2} million, {what}"));
        }
    };
    let cost = times.refining;
    let computed = format!("{} computed", cost.gradients);
    rate(
        "matching",
        counts.pairs,
        times.matching,
        "assignment included",
    );
    rate("with gradients", cost.gradients, cost.time, &computed);
    let time = times.all.as_secs_f64() * 1e3;
    lines.push(format!("time               {time:>9.1} ms\n"));
    lines.join("\n")
}

/// Average precision of both, class by class.
pub fn precision(goal: Goal, before: &[Precision], after: &[Precision]) -> String {
    let overlap = match goal.space {
        Space::BirdsEye => "seen from above",
        Space::Full => "in space",
    };
    let mut text = format!(
        "\naverage precision {overlap}, before and after boxes moved by {} to the truths that
score them (a demonstration of the gradient)
            at 11      40     all     at 11      40     all recalls\n",
        goal.loss.title(),
    );
    let show = |x: Option<f64>| x.map_or("-".into(), |x| format!("{x:.4}"));
    for (before, after) in before.iter().zip(after) {
        let [b11, b40, b_all] = before.at.map(show);
        let [a11, a40, a_all] = after.at.map(show);
        let _ = writeln!(
            text,
            "{:10}  {b11:>6}  {b40:>6}  {b_all:>6}    {a11:>6}  {a40:>6}  {a_all:>6}  at overlap {}",
            before.class.name(),
            before.threshold,
        );
    }
    text
}

/// Average precision of both at 40 recalls, as comma-separated values: classes that there are.
pub fn csv(before: &[Precision], after: &[Precision]) -> String {
    let mut text = String::from("class,ap_before,ap_after\n");
    for (before, after) in before.iter().zip(after) {
        if let (Some(first), Some(last)) = (before.at[1], after.at[1]) {
            let _ = writeln!(text, "{},{first},{last}", before.class.name());
        }
    }
    text
}
