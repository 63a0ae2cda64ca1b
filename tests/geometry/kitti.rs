//! KITTI's rules: which truths and detections count, and average precision as the benchmark's development kit
//! computes it.
use super::pairs::Random;
use geograd::error::Error;
use geograd::metric::Recalls;
use geograd::metric::kitti::{
    Angles, Counts, Difficulty, Frame, GroundTruth, Label, judge, judge_oriented,
};
use geograd::suppression::Pair;

pub fn overlapping(first: usize, second: usize, overlap: f64) -> Pair<f64> {
    Pair {
        first,
        second,
        overlap,
    }
}

#[test]
fn kitti_counts_by_difficulty() {
    let car = GroundTruth {
        label: Label::Own,
        height: 40.0,
        occlusion: 0,
        truncation: 0.15,
    };
    // A truth must be higher than the limit.
    assert_eq!(Difficulty::Easy.truth(car), Counts::Ignored);
    assert_eq!(
        Difficulty::Easy.truth(GroundTruth {
            height: 40.5,
            ..car
        }),
        Counts::Fully
    );
    assert_eq!(
        Difficulty::Moderate.truth(GroundTruth {
            occlusion: 2,
            ..car
        }),
        Counts::Ignored
    );
    assert_eq!(
        Difficulty::Hard.truth(GroundTruth {
            occlusion: 2,
            truncation: 0.5,
            ..car
        }),
        Counts::Fully
    );
    assert_eq!(
        Difficulty::Hard.truth(GroundTruth {
            occlusion: 3,
            ..car
        }),
        Counts::Ignored
    );
    assert_eq!(
        Difficulty::Hard.truth(GroundTruth {
            label: Label::Other,
            ..car
        }),
        Counts::Not
    );
    // A detection of another class is not there, unless it is small: then it may be wrong.
    assert_eq!(Difficulty::Easy.detection(39.0, false), Counts::Ignored);
    assert_eq!(Difficulty::Easy.detection(40.0, false), Counts::Not);
    assert_eq!(Difficulty::Easy.detection(40.0, true), Counts::Fully);
}

#[test]
fn kitti_judges_as_its_kit() {
    use Counts::{Fully, Ignored, Not};
    // Two truths, a van; right at 0.9, the van's at 0.8, wrong at 0.7, right at 0.6, wrong at 0.5, one in a
    // region without labels at 0.65, a small one at 0.95, a pedestrian's at 0.99.
    let scores = [0.9, 0.8, 0.7, 0.6, 0.5, 0.65, 0.95, 0.99];
    let frame = Frame {
        truths: &[Fully, Fully, Ignored],
        scores: &scores,
        detections: &[Fully, Fully, Fully, Fully, Fully, Fully, Ignored, Not],
        pairs: &[
            overlapping(0, 0, 0.8),
            overlapping(1, 2, 0.9),
            overlapping(3, 1, 0.75),
            overlapping(2, 1, 0.7), // equality is not enough
            overlapping(7, 1, 0.95),
        ],
        unlabelled: &[0.0, 0.0, 0.0, 0.0, 0.0, 0.9, 0.0, 0.0],
    };
    let judged = judge(&[frame], 0.7).unwrap();
    assert_eq!(judged.truths, 2);
    // Recall passes 1/40 at the first right one and 2/40 at the second.
    let points: Vec<_> = judged
        .curve
        .iter()
        .map(|p| (p.score, p.precision, p.recall))
        .collect();
    assert_eq!(points, [(0.9, 1.0, 0.5), (0.6, 2.0 / 3.0, 1.0)]);
    // The kit reads precision by the number of the score: 0 and 1 of 41.
    assert!((judged.average_precision(Recalls::Forty) - 2.0 / 3.0 / 40.0).abs() < 1e-15);
    assert!((judged.average_precision(Recalls::Eleven) - 1.0 / 11.0).abs() < 1e-15);

    // A truth in each of forty-one frames, all found, and as many wrong ones below all of them.
    let pair = [overlapping(0, 0, 0.9)];
    let scores: Vec<[f64; 2]> = (0..41).map(|n| [1.0 - n as f64 / 100.0, 0.1]).collect();
    let frames: Vec<Frame<'_>> = scores
        .iter()
        .map(|scores| Frame {
            truths: &[Fully],
            scores,
            detections: &[Fully; 2],
            pairs: &pair,
            unlabelled: &[],
        })
        .collect();
    let judged = judge(&frames, 0.7).unwrap();
    assert_eq!(judged.curve.len(), 41);
    assert_eq!(judged.average_precision(Recalls::Forty), 1.0);
    assert_eq!(judged.average_precision(Recalls::Eleven), 1.0);

    // A truth takes the detection of the largest overlap; one that is ignored gives way to one that is not.
    let frame = Frame {
        truths: &[Fully],
        scores: &[0.9, 0.8, 0.7],
        detections: &[Ignored, Fully, Fully],
        pairs: &[
            overlapping(0, 0, 0.99),
            overlapping(1, 0, 0.8),
            overlapping(2, 0, 0.9),
        ],
        unlabelled: &[],
    };
    // Without a least score the best score is taken, which is ignored: no score to read at.
    assert!(judge(&[frame], 0.7).unwrap().curve.is_empty());
    assert_eq!(
        judge(&[], 0.7).unwrap().average_precision(Recalls::Forty),
        0.0
    );
    let short = Frame {
        detections: &[Fully],
        ..frame
    };
    assert!(matches!(
        judge(&[short], 0.7),
        Err(Error::Length {
            found: 1,
            expected: 3,
            ..
        })
    ));
}

/// A frame with every overlap written down: the kit's own way to hold it.
pub struct Dense {
    pub truths: Vec<Counts>,
    pub scores: Vec<f64>,
    pub detections: Vec<Counts>,
    /// By truth, then by detection.
    pub overlaps: Vec<Vec<f64>>,
    pub unlabelled: Vec<f64>,
}

/// The result of a walk over a frame: the scores of right detections, and how many are wrong and missed.
struct Walk {
    right: Vec<f64>,
    /// Truths and detections of those that are right.
    found: Vec<(usize, usize)>,
    wrong: usize,
    missed: usize,
}

pub const THRESHOLD: f64 = 0.5;

impl Dense {
    fn draw(random: &mut Random) -> Self {
        let mut below = |n: usize| (random.between(0.0, 1.0) * n as f64) as usize % n;
        let (truths, detections) = (below(5), below(7));
        let mut counts = |n: usize| -> Vec<Counts> {
            let kinds = [Counts::Fully, Counts::Fully, Counts::Ignored, Counts::Not];
            (0..n).map(|_| kinds[below(4)]).collect()
        };
        let (kinds_of_truths, kinds_of_detections) = (counts(truths), counts(detections));
        // Few different numbers, so that scores and overlaps tie with each other and with the threshold.
        let mut tenths =
            |n: usize| -> Vec<f64> { (0..n).map(|_| below(11) as f64 / 10.0).collect() };
        Dense {
            truths: kinds_of_truths,
            scores: tenths(detections),
            detections: kinds_of_detections,
            overlaps: (0..truths).map(|_| tenths(detections)).collect(),
            unlabelled: tenths(detections),
        }
    }

    /// The kit's walk: truth by truth through all detections, with running maxima and one flag.
    fn walk(&self, least: Option<f64>) -> Walk {
        let mut taken = vec![false; self.scores.len()];
        let mut out = Walk {
            right: Vec::new(),
            found: Vec::new(),
            wrong: 0,
            missed: 0,
        };
        let in_play = |j: usize| least.is_none_or(|least| self.scores[j] >= least);
        for (i, overlaps) in self.overlaps.iter().enumerate() {
            if self.truths[i] == Counts::Not {
                continue;
            }
            let (mut chosen, mut most, mut highest, mut small) = (None, 0.0, f64::MIN, false);
            for (j, &overlap) in overlaps.iter().enumerate() {
                let counts = self.detections[j];
                if counts == Counts::Not || taken[j] || !in_play(j) || overlap <= THRESHOLD {
                    continue;
                }
                if least.is_none() {
                    if self.scores[j] > highest {
                        (chosen, highest) = (Some(j), self.scores[j]);
                    }
                } else if counts == Counts::Fully && (overlap > most || small) {
                    (chosen, most, small) = (Some(j), overlap, false);
                } else if counts == Counts::Ignored && chosen.is_none() {
                    (chosen, small) = (Some(j), true);
                }
            }
            match chosen {
                Some(j) => {
                    taken[j] = true;
                    if self.truths[i] == Counts::Fully && self.detections[j] == Counts::Fully {
                        out.right.push(self.scores[j]);
                        out.found.push((i, j));
                    }
                }
                None if self.truths[i] == Counts::Fully => out.missed += 1,
                None => {}
            }
        }
        let is_wrong = |j: &usize| {
            !taken[*j]
                && in_play(*j)
                && self.detections[*j] == Counts::Fully
                && self.unlabelled[*j] <= THRESHOLD
        };
        out.wrong = (0..self.scores.len()).filter(is_wrong).count();
        out
    }
}

/// Precision at the kit's scores, forty-one at most, from dense frames.
pub fn precisions(frames: &[Dense]) -> Vec<f64> {
    let is_full = |c: &&Counts| **c == Counts::Fully;
    let truths: usize = frames
        .iter()
        .map(|f| f.truths.iter().filter(is_full).count())
        .sum();
    let mut scores: Vec<f64> = frames.iter().flat_map(|f| f.walk(None).right).collect();
    scores.sort_by(|a, b| b.total_cmp(a));
    let (mut recall, mut out) = (0.0, Vec::new());
    for (i, &score) in scores.iter().enumerate() {
        let share = |n: usize| n as f64 / truths as f64;
        // A score is passed over where the next one's recall is nearer to the one that is due.
        if i + 1 < scores.len() && share(i + 2) - recall < recall - share(i + 1) {
            continue;
        }
        let walks = frames.iter().map(|f| f.walk(Some(score)));
        let (right, wrong) = walks.fold((0, 0), |(right, wrong), walk| {
            (right + walk.right.len(), wrong + walk.wrong)
        });
        out.push(right as f64 / (right + wrong).max(1) as f64);
        recall += 1.0 / 40.0;
    }
    out
}

#[test]
fn kitti_agrees_with_a_plain_walk_over_dense_frames() {
    let mut random = Random(71);
    let mut read = 0;
    for round in 0..240 {
        let frames: Vec<Dense> = (0..1 + round % 60)
            .map(|_| Dense::draw(&mut random))
            .collect();
        let pairs: Vec<Vec<Pair<f64>>> = frames
            .iter()
            .map(|frame| {
                let all = frame
                    .overlaps
                    .iter()
                    .enumerate()
                    .flat_map(|(second, list)| {
                        list.iter()
                            .enumerate()
                            .map(move |(first, &overlap)| overlapping(first, second, overlap))
                    });
                all.filter(|pair| pair.overlap > 0.0).collect()
            })
            .collect();
        let lent: Vec<Frame<'_>> = frames
            .iter()
            .zip(&pairs)
            .map(|(frame, pairs)| Frame {
                truths: &frame.truths,
                scores: &frame.scores,
                detections: &frame.detections,
                pairs,
                unlabelled: &frame.unlabelled,
            })
            .collect();
        let judged = judge(&lent, THRESHOLD).unwrap();
        let expected = precisions(&frames);
        let found: Vec<f64> = judged.curve.iter().map(|point| point.precision).collect();
        assert_eq!(found, expected, "round {round}");
        read += expected.len();
        // Averages of the best precision from there on, with zeros up to forty-one.
        let best = |n: usize| expected.iter().skip(n).copied().fold(0.0, f64::max);
        let forty = (1..41).map(best).sum::<f64>() / 40.0;
        let eleven = (0..11).map(|n| best(4 * n)).sum::<f64>() / 11.0;
        assert!((judged.average_precision(Recalls::Forty) - forty).abs() < 1e-14);
        assert!((judged.average_precision(Recalls::Eleven) - eleven).abs() < 1e-14);
    }
    assert!(read > 2000, "only {read} scores were read");
}

/// Similarity of orientation at the kit's scores: the sum over right detections by the number of those right or wrong.
fn similarities(frames: &[Dense], angles: &[[Vec<f64>; 2]], curve: &[f64]) -> Vec<f64> {
    let at = |&score: &f64| {
        let (mut sum, mut all) = (0.0, 0);
        for (frame, [truths, detections]) in frames.iter().zip(angles) {
            let walk = frame.walk(Some(score));
            all += walk.found.len() + walk.wrong;
            for (i, j) in walk.found {
                sum += (truths[i] - detections[j]).cos() / 2.0 + 0.5;
            }
        }
        sum / f64::from(all.max(1) as u32)
    };
    curve.iter().map(at).collect()
}

#[test]
fn orientation_similarity_agrees_with_a_plain_walk() {
    let mut random = Random(72);
    let mut below = 0;
    for round in 0..60 {
        let frames: Vec<Dense> = (0..1 + round).map(|_| Dense::draw(&mut random)).collect();
        let angles: Vec<[Vec<f64>; 2]> = frames
            .iter()
            .map(|frame| {
                [frame.truths.len(), frame.scores.len()]
                    .map(|n| (0..n).map(|_| random.between(-4.0, 4.0)).collect())
            })
            .collect();
        let pairs: Vec<Vec<Pair<f64>>> = frames
            .iter()
            .map(|frame| {
                let rows = frame.overlaps.iter().enumerate();
                rows.flat_map(|(second, list)| {
                    let list = list.iter().enumerate();
                    list.map(move |(first, &overlap)| overlapping(first, second, overlap))
                })
                .collect()
            })
            .collect();
        let lent: Vec<Frame<'_>> = frames
            .iter()
            .zip(&pairs)
            .map(|(frame, pairs)| Frame {
                truths: &frame.truths,
                scores: &frame.scores,
                detections: &frame.detections,
                pairs,
                unlabelled: &frame.unlabelled,
            })
            .collect();
        let own: Vec<Angles<'_>> = angles
            .iter()
            .map(|[truths, detections]| Angles { truths, detections })
            .collect();
        let judged = judge_oriented(&lent, &own, THRESHOLD).unwrap();
        let plain = judge(&lent, THRESHOLD).unwrap();
        assert_eq!(judged.curve, plain.curve);
        assert!(plain.similarity.is_empty());
        assert_eq!(plain.average_orientation_similarity(Recalls::Forty), 0.0);
        let scores: Vec<f64> = judged.curve.iter().map(|point| point.score).collect();
        let expected = similarities(&frames, &angles, &scores);
        for (own, wanted) in judged.similarity.iter().zip(&expected) {
            assert!((own - wanted).abs() < 1e-14, "round {round}");
        }
        assert_eq!(judged.similarity.len(), expected.len());
        let best = |n: usize| expected.iter().skip(n).copied().fold(0.0, f64::max);
        let forty = (1..41).map(best).sum::<f64>() / 40.0;
        let similarity = judged.average_orientation_similarity(Recalls::Forty);
        assert!((similarity - forty).abs() < 1e-14);
        assert!(similarity <= judged.average_precision(Recalls::Forty));
        below += usize::from(similarity < judged.average_precision(Recalls::Forty));

        // All frames as one, by places in the lists of all.
        let (mut truths, mut detections, mut scores, mut unlabelled) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (mut all, mut turns) = (Vec::new(), [Vec::new(), Vec::new()]);
        for ((frame, pairs), angles) in frames.iter().zip(&pairs).zip(&angles) {
            let shifted = |pair: &Pair<f64>| Pair {
                first: pair.first + scores.len(),
                second: pair.second + truths.len(),
                ..*pair
            };
            all.extend(pairs.iter().map(shifted));
            truths.extend_from_slice(&frame.truths);
            detections.extend_from_slice(&frame.detections);
            scores.extend_from_slice(&frame.scores);
            unlabelled.extend_from_slice(&frame.unlabelled);
            for (turns, own) in turns.iter_mut().zip(angles) {
                turns.extend_from_slice(own);
            }
        }
        let whole = Frame {
            truths: &truths,
            scores: &scores,
            detections: &detections,
            pairs: &all,
            unlabelled: &unlabelled,
        };
        let turns = Angles {
            truths: &turns[0],
            detections: &turns[1],
        };
        let whole = judge_oriented(&[whole], &[turns], THRESHOLD).unwrap();
        assert_eq!(whole.curve, judged.curve);
        for (own, wanted) in whole.similarity.iter().zip(&expected) {
            assert!((own - wanted).abs() < 1e-14, "round {round}");
        }
    }
    assert!(below > 30, "angles lower {below} similarities only");
}
