//! Suppression, assignment, average precision.
use super::{Report, flag};
use geograd::Aabb2;
use geograd::assignment::optimal;
use geograd::metric::{Frame, Outcome, Point, Recalls, average_precision, curve, outcomes};
use geograd::suppression::{Decay, Pair, Rules, hard, soft};

const DEFINITION: &str = "definition";

fn boxes(all: &[[f64; 4]]) -> Vec<Aabb2<f64>> {
    all.iter()
        .map(|&[a, b, c, d]| Aabb2::new(a, b, c, d))
        .collect()
}

/// All pairs of two lists that overlap.
fn pairs(a: &[Aabb2<f64>], b: &[Aabb2<f64>]) -> Vec<Pair<f64>> {
    let mut all = vec![];
    for (first, x) in a.iter().enumerate() {
        for (second, y) in b.iter().enumerate() {
            let overlap = x.iou(*y);
            if overlap > 0.0 {
                all.push(Pair {
                    first,
                    second,
                    overlap,
                });
            }
        }
    }
    all
}

fn kept(all: &[[f64; 4]], scores: &[f64], overlap: f64) -> Vec<f64> {
    let all = boxes(all);
    let near: Vec<_> = pairs(&all, &all)
        .into_iter()
        .filter(|pair| pair.first < pair.second)
        .collect();
    let kept = hard(scores, &near, Rules::above(overlap)).unwrap();
    kept.into_iter().map(|k| k as f64).collect()
}

fn judged(found: &[[f64; 4]], scores: &[f64], truths: &[[f64; 4]], threshold: f64) -> Vec<Outcome> {
    let near = pairs(&boxes(found), &boxes(truths));
    outcomes(&Frame::new(scores, truths.len(), &near), threshold).unwrap()
}

fn precision(scores: &[f64], outcomes: &[Outcome], truths: usize, recalls: Recalls) -> f64 {
    average_precision(&curve(scores, outcomes, truths).unwrap(), recalls)
}

/// The largest sum of gains of two columns and three rows, by enumeration.
fn largest(gains: &[[f64; 2]; 3]) -> f64 {
    let ways = (0..3)
        .flat_map(|i| (0..3).map(move |j| (i, j)))
        .filter(|(i, j)| i != j);
    ways.map(|(i, j)| gains[i][0] + gains[j][1])
        .fold(0.0, f64::max)
}

const GAINS: [[f64; 2]; 3] = [[0.1, 0.5], [0.5, 0.9], [0.2, 0.3]];
const TARGETS: [[f64; 4]; 3] = [
    [2748., 618., 2830., 659.],
    [2690., 642., 2749., 681.],
    [2690., 639., 2746., 681.],
];
const LABELS: [[f64; 4]; 2] = [[50., 50., 150., 150.], [200., 200., 300., 300.]];

pub fn reports() -> Vec<Report> {
    vec![
        Report {
            library: "Lightning-AI/torchmetrics",
            number: 1908,
            about: "0",
            asked: "average precision of one detection with IoU 1/4, at the threshold 0.2",
            source: DEFINITION,
            found: || {
                let all = judged(&[[0.5, 0.5, 1., 1.]], &[1.0], &[[0., 0., 1., 1.]], 0.2);
                vec![precision(&[1.0], &all, 1, Recalls::All)]
            },
            right: || vec![1.0],
            within: 0.0,
        },
        Report {
            library: "cocodataset/cocoapi",
            number: 672,
            about: "another value for perfect detections",
            asked: "average precision of two detections that are the labels",
            source: DEFINITION,
            found: || {
                let all = judged(&LABELS, &[1.0, 1.0], &LABELS, 0.5);
                vec![precision(&[1.0, 1.0], &all, 2, Recalls::All)]
            },
            right: || vec![1.0],
            within: 0.0,
        },
        Report {
            library: "matterport/Mask_RCNN",
            number: 252,
            about: "more than 1, with more finds than truths",
            asked: "finds among six detections of four truths, and average precision; of one truth and two detections of nothing after it",
            source: "definition: a truth is found once",
            found: || {
                let truths: Vec<[f64; 4]> = (0..4)
                    .map(|k| [f64::from(k) * 10.0, 0.0, f64::from(k) * 10.0 + 4.0, 4.0])
                    .collect();
                let found: Vec<[f64; 4]> = [0, 1, 2, 2, 3, 3].map(|k| truths[k]).to_vec();
                let scores = [0.9, 0.8, 0.7, 0.6, 0.5, 0.4];
                let all = judged(&found, &scores, &truths, 0.5);
                let right = all
                    .iter()
                    .filter(|o| matches!(o, Outcome::Right(_)))
                    .count();
                let one = precision(
                    &[0.9, 0.8, 0.7],
                    &[Outcome::Right(0), Outcome::Wrong, Outcome::Wrong],
                    1,
                    Recalls::All,
                );
                vec![right as f64, precision(&scores, &all, 4, Recalls::All), one]
            },
            right: || vec![4.0, 3.0 / 4.0 + 4.0 / 5.0 / 4.0, 1.0],
            within: 1e-15,
        },
        Report {
            library: "nutonomy/nuscenes-devkit",
            number: 992,
            about: "a doubt that two detections of one truth both count",
            asked: "whether the better and the worse of two detections of one truth are right",
            source: DEFINITION,
            found: || {
                judged(
                    &[[0., 0., 4., 4.], [0., 0., 4., 3.]],
                    &[0.9, 0.8],
                    &[[0., 0., 4., 4.]],
                    0.5,
                )
                .into_iter()
                .map(|o| flag(matches!(o, Outcome::Right(_))))
                .collect()
            },
            right: || vec![1.0, 0.0],
            within: 0.0,
        },
        Report {
            library: "asharakeh/kitti_native_evaluation",
            number: 1,
            about: "a question: a single find gives 1/11",
            asked: "average precision of one find in a thousand truths, at 11 and at 40 recalls",
            source: "definition: 1/11; 0, as recall 0 is not among the 40",
            found: || {
                let only = [Point {
                    score: 0.9,
                    precision: 1.0,
                    recall: 1e-3,
                }];
                vec![
                    average_precision(&only, Recalls::Eleven),
                    average_precision(&only, Recalls::Forty),
                ]
            },
            right: || vec![1.0 / 11.0, 0.0],
            within: 1e-16,
        },
        Report {
            library: "pytorch/vision",
            number: 8949,
            about: "a doubt about [0, 2] at the threshold 0",
            asked: "places that suppression keeps at the threshold 0, then at 0.1",
            source: "definition, with IoU 0.003 and 0.885",
            found: || {
                [
                    kept(&TARGETS, &[1.0, 1.0, 0.5], 0.0),
                    kept(&TARGETS, &[1.0, 1.0, 0.5], 0.1),
                ]
                .concat()
            },
            right: || vec![0.0, 2.0, 0.0, 1.0],
            within: 0.0,
        },
        Report {
            library: "pytorch/vision",
            number: 1872,
            about: "a call for one pixel more in widths",
            asked: "places that suppression keeps of two boxes apart in coordinates from 0 to 1",
            source: DEFINITION,
            found: || {
                kept(
                    &[[0.1, 0.1, 0.3, 0.3], [0.6, 0.6, 0.8, 0.8]],
                    &[0.9, 0.8],
                    0.5,
                )
            },
            right: || vec![0.0, 1.0],
            within: 0.0,
        },
        Report {
            library: "hhj1897/face_detection",
            number: 2,
            about: "faces apart suppress each other, by widths of one pixel more",
            asked: "places that suppression keeps of three faces apart in coordinates from 0 to 1",
            source: DEFINITION,
            found: || {
                kept(
                    &[
                        [0.0, 0.0, 0.2, 0.2],
                        [0.4, 0.0, 0.6, 0.2],
                        [0.8, 0.0, 1.0, 0.2],
                    ],
                    &[0.9, 0.8, 0.7],
                    0.4,
                )
            },
            right: || vec![0.0, 1.0, 2.0],
            within: 0.0,
        },
        Report {
            library: "open-mmlab/mmcv",
            number: 1726,
            about: "a detection below the least score",
            asked: "how many of three detections soft suppression keeps, all below the least score 0.3",
            source: DEFINITION,
            found: || {
                let rules = Rules {
                    score: 0.3,
                    ..Rules::above(0.3)
                };
                vec![
                    soft(
                        &[0.298848, 0.2, 0.1],
                        &[Pair {
                            first: 0,
                            second: 1,
                            overlap: 0.6,
                        }],
                        Decay::Linear,
                        rules,
                    )
                    .unwrap()
                    .len() as f64,
                ]
            },
            right: || vec![0.0],
            within: 0.0,
        },
        Report {
            library: "ultralytics/ultralytics",
            number: 5351,
            about: "greedy matching",
            asked: "the sum of overlaps of the best assignment of three detections to two truths",
            source: "enumeration of all six",
            found: || {
                let flat: Vec<f64> = GAINS.concat();
                vec![
                    optimal(&flat, 3, 2)
                        .unwrap()
                        .into_iter()
                        .map(|(i, j)| GAINS[i][j])
                        .sum(),
                ]
            },
            right: || vec![largest(&GAINS)],
            within: 1e-15,
        },
    ]
}
