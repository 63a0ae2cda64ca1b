//! KITTI's average precision from the lines of its files: difficulties, neighbouring classes, regions without labels.
use super::kitti::{Dense, THRESHOLD, overlapping, precisions};
use super::pairs::Random;
use geograd::metric::Recalls;
use geograd::metric::kitti::{Counts, Difficulty, Frame, GroundTruth, Label, judge};

/// A box in the image: left, top, right, bottom.
type Image = [f64; 4];

/// A line of the kit's files: its class, its box, and for truths what is hidden and truncated, else a score.
struct Line {
    class: &'static str,
    image: Image,
    occlusion: u8,
    truncation: f64,
    score: f64,
}

fn area(x: Image) -> f64 {
    (x[2] - x[0]).max(0.0) * (x[3] - x[1]).max(0.0)
}

fn shared(x: Image, y: Image) -> f64 {
    area([
        x[0].max(y[0]),
        x[1].max(y[1]),
        x[2].min(y[2]),
        x[3].min(y[3]),
    ])
}

fn image_iou(x: Image, y: Image) -> f64 {
    shared(x, y) / (area(x) + area(y) - shared(x, y))
}

/// A scene of cars and what is not one; boxes stand about few places, so that they overlap.
fn scene(random: &mut Random, count: usize, classes: &[&'static str]) -> Vec<Line> {
    let mut below = |n: usize| (random.between(0.0, 1.0) * n as f64) as usize % n;
    let mut line = || {
        let (x, y) = (100.0 * below(4) as f64, below(6) as f64);
        // About the least heights, on both sides and on them.
        let height = [22, 25, 26, 38, 40, 43, 60][below(7)] as f64;
        Line {
            class: classes[below(classes.len())],
            image: [
                x + below(5) as f64,
                y,
                x + 60.0 + below(9) as f64,
                y + height,
            ],
            occlusion: below(4) as u8,
            truncation: [0.0, 0.15, 0.16, 0.3, 0.5, 0.6][below(6)],
            score: below(11) as f64 / 10.0,
        }
    };
    (0..count).map(|_| line()).collect()
}

/// The kit's `cleanData` for cars: every number is its own.
fn cleaned(level: usize, truths: &[Line], detections: &[Line], regions: &[Line]) -> Dense {
    let (height, occlusion, truncation) = (
        [40.0, 25.0, 25.0][level],
        [0, 1, 2][level],
        [0.15, 0.3, 0.5][level],
    );
    let high = |x: &Line| x.image[3] - x.image[1];
    let truth = |x: &Line| {
        let hard = x.occlusion > occlusion || x.truncation > truncation || high(x) <= height;
        match (x.class, hard) {
            ("Car", false) => Counts::Fully,
            ("Car", true) | ("Van", _) => Counts::Ignored,
            _ => Counts::Not,
        }
    };
    let detection = |x: &Line| match (high(x) < height, x.class) {
        (true, _) => Counts::Ignored,
        (false, "Car") => Counts::Fully,
        _ => Counts::Not,
    };
    let in_regions = |x: &Line| {
        let share = |region: &Line| shared(x.image, region.image) / area(x.image);
        regions.iter().map(share).fold(0.0, f64::max)
    };
    let overlaps = |t: &Line| {
        detections
            .iter()
            .map(|d| image_iou(d.image, t.image))
            .collect()
    };
    Dense {
        truths: truths.iter().map(truth).collect(),
        scores: detections.iter().map(|x| x.score).collect(),
        detections: detections.iter().map(detection).collect(),
        overlaps: truths.iter().map(overlaps).collect(),
        unlabelled: detections.iter().map(in_regions).collect(),
    }
}

/// From labels to average precision: difficulties, neighbouring classes, regions without labels.
#[test]
fn kitti_from_labels_is_the_definition() {
    let mut random = Random(72);
    let mut read = [0; 3];
    for round in 0..120 {
        let scenes: Vec<[Vec<Line>; 3]> = (0..1 + round % 40)
            .map(|_| {
                let count = |random: &mut Random, n: f64| random.between(0.0, n) as usize;
                let truths = count(&mut random, 6.0);
                let truths = scene(&mut random, truths, &["Car", "Car", "Car", "Van", "Tram"]);
                let found = count(&mut random, 8.0);
                let found = scene(&mut random, found, &["Car", "Car", "Pedestrian"]);
                let regions = count(&mut random, 2.0);
                [truths, found, scene(&mut random, regions, &["DontCare"])]
            })
            .collect();
        let levels = [Difficulty::Easy, Difficulty::Moderate, Difficulty::Hard];
        for (level, difficulty) in levels.into_iter().enumerate() {
            let dense: Vec<Dense> = scenes
                .iter()
                .map(|[t, d, r]| cleaned(level, t, d, r))
                .collect();
            let own: Vec<_> = scenes
                .iter()
                .zip(&dense)
                .map(|([truths, found, _], dense)| {
                    let truth = |x: &Line| {
                        let label = match x.class {
                            "Car" => Label::Own,
                            "Van" => Label::Neighbouring,
                            _ => Label::Other,
                        };
                        difficulty.truth(GroundTruth {
                            label,
                            height: x.image[3] - x.image[1],
                            occlusion: x.occlusion,
                            truncation: x.truncation,
                        })
                    };
                    let height = |x: &Line| x.image[3] - x.image[1];
                    let detection = |x: &Line| difficulty.detection(height(x), x.class == "Car");
                    let places =
                        (0..truths.len()).flat_map(|t| (0..found.len()).map(move |d| (d, t)));
                    let pair = |(d, t): (usize, usize)| overlapping(d, t, dense.overlaps[t][d]);
                    (
                        truths.iter().map(truth).collect::<Vec<_>>(),
                        found.iter().map(detection).collect::<Vec<_>>(),
                        places
                            .map(pair)
                            .filter(|pair| pair.overlap > 0.0)
                            .collect::<Vec<_>>(),
                    )
                })
                .collect();
            let frames: Vec<Frame<'_>> = own
                .iter()
                .zip(&dense)
                .map(|((truths, detections, pairs), dense)| Frame {
                    truths,
                    scores: &dense.scores,
                    detections,
                    pairs,
                    unlabelled: &dense.unlabelled,
                })
                .collect();
            let judged = judge(&frames, THRESHOLD).unwrap();
            let found: Vec<f64> = judged.curve.iter().map(|point| point.precision).collect();
            let expected = precisions(&dense);
            assert_eq!(found, expected, "round {round} {difficulty:?}");
            read[level] += expected.len();
            let best = |n: usize| expected.iter().skip(n).copied().fold(0.0, f64::max);
            let forty = (1..41).map(best).sum::<f64>() / 40.0;
            assert!((judged.average_precision(Recalls::Forty) - forty).abs() < 1e-15);
        }
    }
    assert!(
        read.iter().all(|&read| read > 10),
        "{read:?} scores were read"
    );
}
