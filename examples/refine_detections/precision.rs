//! Average precision by class, as the benchmarks of the field report it.
use crate::loss::Space;
use crate::model::{Class, Frames, Seen, in_space};
use geograd::Error;
use geograd::kernels::{Cpu, Iou};
use geograd::metric::{self, Recalls, average_precision, curve, outcomes};
use geograd::suppression::Pair;

/// The classes that are scored, and the overlap at which KITTI counts one as found.
pub const CLASSES: [(Class, f64); 3] = [
    (Class::Car, 0.7),
    (Class::Pedestrian, 0.5),
    (Class::Cyclist, 0.5),
];

/// Average precision of a class, in `[0, 1]`.
#[derive(Clone, Copy, Debug)]
pub struct Precision {
    pub class: Class,
    /// The overlap that counts as found.
    pub threshold: f64,
    /// At 11 recalls, at 40, and over all; `None` where there is nothing to find.
    pub at: [Option<f64>; 3],
}

/// Average precision of every class that has detections or truths.
///
/// Detections of all frames are taken by descending score, each for the truth of its class and frame that
/// it overlaps most and that is not taken. A similar class (a van for a car) is neither right nor wrong.
pub fn by_class(frames: &Frames, space: Space) -> Result<Vec<Precision>, Error> {
    let mut all = Vec::new();
    for (class, threshold) in CLASSES {
        let (mut scores, mut found, mut truths) = (Vec::new(), Vec::new(), 0);
        for frame in frames.values() {
            let of_class = |seen: &[Seen]| -> Vec<Seen> {
                let own = seen.iter().filter(|seen| seen.class == class);
                own.copied().collect()
            };
            let detections = of_class(&frame.detections);
            let mut goals = of_class(&frame.truths);
            truths += goals.len();
            let mut ignored = vec![false; goals.len()];
            goals.extend(of_class(&frame.alike));
            ignored.resize(goals.len(), true);
            let own: Vec<f64> = detections.iter().map(|d| f64::from(d.score)).collect();
            let pairs = near(&detections, &goals, space)?;
            let frame = metric::Frame {
                ignored_truths: &ignored,
                ..metric::Frame::new(&own, goals.len(), &pairs)
            };
            found.extend(outcomes(&frame, threshold)?);
            scores.extend(own);
        }
        if scores.is_empty() && truths == 0 {
            continue;
        }
        let curve = curve(&scores, &found, truths)?;
        let at = [Recalls::Eleven, Recalls::Forty, Recalls::All];
        all.push(Precision {
            class,
            threshold,
            at: at.map(|recalls| (truths > 0).then(|| average_precision(&curve, recalls))),
        });
    }
    Ok(all)
}

/// Every detection with every truth that it overlaps.
fn near(detections: &[Seen], truths: &[Seen], space: Space) -> Result<Vec<Pair<f64>>, Error> {
    let found = in_space!(space, |detections, truths| Cpu::new().above(
        Iou,
        &detections,
        &truths,
        0.0
    ))?;
    let pairs = found.into_iter().map(|found| Pair {
        first: found.row,
        second: found.column,
        overlap: f64::from(found.value),
    });
    Ok(pairs.collect())
}
