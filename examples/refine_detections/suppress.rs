//! Detections that overlap a better one of their class are left out before anything else.
use crate::loss::Space;
use crate::model::{Frames, in_space};
use geograd::Error;
use geograd::kernels::{Cpu, Iou};
use geograd::suppression::{Rules, hard};

/// Leaves out detections that overlap a better one of their class by more than the threshold. Gives their
/// number.
pub fn suppress(frames: &mut Frames, space: Space, threshold: f32) -> Result<usize, Error> {
    let mut gone = 0;
    for frame in frames.values_mut() {
        let all = &frame.detections;
        let scores: Vec<f32> = all.iter().map(|seen| seen.score).collect();
        let classes: Vec<u32> = all.iter().map(|seen| seen.class as u32).collect();
        let rules = Rules {
            classes: Some(&classes),
            ..Rules::above(threshold)
        };
        let overlaps = in_space!(space, |all| Cpu::new().overlaps(Iou, &all, threshold))?;
        let kept = hard(&scores, &overlaps, rules)?;
        gone += all.len() - kept.len();
        let mut stays = vec![false; all.len()];
        kept.into_iter().for_each(|i| stays[i] = true);
        let mut stays = stays.into_iter();
        frame.detections.retain(|_| stays.next() == Some(true));
    }
    Ok(gone)
}
