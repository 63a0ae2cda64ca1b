//! Assignment and metrics of many groups: the results of a call per group, and the same bits on any number of threads.
use geograd::error::Error;
use geograd::kernels::{Cpu, Groups};
use geograd::metric::kitti::{self, Counts};
use geograd::metric::nuscenes::{self, Object};
use geograd::metric::{Frame, Outcome, outcomes};
use geograd::suppression::Pair;
use geograd::{assignment, metric};
use geograd_tests::Dice;
use std::f64::consts::TAU;

/// Frames of detections and truths with some pairs each; many scores and overlaps are equal.
struct Drawn {
    offsets: [Vec<usize>; 2],
    scores: Vec<f64>,
    pairs: Vec<Pair<f64>>,
    ignored: [Vec<bool>; 2],
}

impl Drawn {
    /// Small frames, and one that is a piece of work of its own.
    fn new() -> Self {
        let mut dice = Dice(91);
        let mut all = Drawn {
            offsets: [vec![0], vec![0]],
            scores: Vec::new(),
            pairs: Vec::new(),
            ignored: [Vec::new(), Vec::new()],
        };
        for frame in 0..900 {
            let counts = match frame {
                400 => [300, 200],
                _ => [dice.below(30), dice.below(25)],
            };
            let [first, second] = [0, 1].map(|k| *all.offsets[k].last().expect("begins at zero"));
            for row in 0..counts[0] {
                for column in 0..counts[1] {
                    if dice.below(4) == 0 {
                        all.pairs.push(Pair {
                            first: first + row,
                            second: second + column,
                            overlap: dice.below(60) as f64 / 60.0,
                        });
                    }
                }
                all.scores.push(dice.below(40) as f64 / 40.0);
            }
            for k in 0..2 {
                all.ignored[k].extend((0..counts[k]).map(|_| dice.below(7) == 0));
                all.offsets[k].push([first, second][k] + counts[k]);
            }
        }
        all
    }
    fn groups(&self) -> Groups<'_> {
        Groups::new(&self.offsets[0], &self.offsets[1])
    }
    fn frame(&self) -> Frame<'_> {
        Frame {
            ignored_truths: &self.ignored[1],
            ignored_detections: &self.ignored[0],
            ..Frame::new(&self.scores, self.ignored[1].len(), &self.pairs)
        }
    }
    /// The pairs of every frame.
    fn of_frames(&self) -> Vec<Vec<Pair<f64>>> {
        let mut of_frames = vec![Vec::new(); self.offsets[0].len() - 1];
        for &pair in &self.pairs {
            let frame = self.offsets[0].partition_point(|&offset| offset <= pair.first) - 1;
            of_frames[frame].push(pair);
        }
        of_frames
    }
    /// How truths and detections count, and their angles.
    fn kitti(&self) -> [(Vec<Counts>, Vec<f64>); 2] {
        let counts = |&is_ignored: &bool| match is_ignored {
            true => Counts::Ignored,
            false => Counts::Fully,
        };
        let mut dice = Dice(5);
        [1, 0].map(|k| {
            let angles = self.ignored[k].iter().map(|_| 6.0 * dice.roll() - 3.0);
            (
                self.ignored[k].iter().map(counts).collect(),
                angles.collect(),
            )
        })
    }
    fn objects(&self) -> [Vec<Object>; 2] {
        let mut dice = Dice(6);
        let mut object = |_: &bool| {
            let center = [0, 1].map(|_| dice.below(24) as f64 * 0.5);
            let size = [0, 1, 2].map(|_| 1.0 + dice.roll());
            Object {
                velocity: Some([dice.roll(), dice.roll()]),
                ..Object::new(center, size, 6.0 * dice.roll())
            }
        };
        [0, 1].map(|k| self.ignored[k].iter().map(&mut object).collect())
    }
}

/// Results of every grouped call.
#[derive(Debug, PartialEq)]
struct Results {
    greedy: Vec<Pair<f64>>,
    largest: Vec<Pair<f64>>,
    outcomes: Vec<Outcome>,
    kitti: kitti::Judged,
    nuscenes: Vec<nuscenes::Judged>,
}

const THRESHOLDS: [f64; 3] = [0.4, 1.0, 2.5];

fn results(drawn: &Drawn) -> Results {
    let (cpu, groups) = (Cpu::new(), drawn.groups());
    let [truths, detections] = drawn.kitti();
    let frame = kitti::Frame {
        truths: &truths.0,
        scores: &drawn.scores,
        detections: &detections.0,
        pairs: &drawn.pairs,
        unlabelled: &[],
    };
    let angles = kitti::Angles {
        truths: &truths.1,
        detections: &detections.1,
    };
    let [own, others] = drawn.objects();
    let frames = nuscenes::Frames {
        detections: &own,
        scores: &drawn.scores,
        detection_offsets: &drawn.offsets[0],
        truths: &others,
        truth_offsets: &drawn.offsets[1],
        period: TAU,
    };
    let one_by_one =
        THRESHOLDS.map(|threshold| nuscenes::judge(&frames, threshold).expect("is valid"));
    let results = Results {
        greedy: cpu.greedy_grouped(&drawn.pairs, groups).expect("is valid"),
        largest: cpu.largest_grouped(&drawn.pairs, groups).expect("is valid"),
        outcomes: cpu
            .outcomes_grouped(&drawn.frame(), groups, 0.3)
            .expect("is valid"),
        kitti: cpu
            .judge_kitti(&[frame], Some(&[angles]), 0.5)
            .expect("is valid"),
        nuscenes: cpu.judge_nuscenes(&frames, &THRESHOLDS).expect("is valid"),
    };
    assert_eq!(
        results.kitti,
        kitti::judge_oriented(&[frame], &[angles], 0.5).expect("is valid")
    );
    let average = results.kitti.average_precision(metric::Recalls::Forty);
    assert!(results.kitti.curve.len() > 10 && average > 0.2, "{average}");
    assert_eq!(results.nuscenes, one_by_one);
    assert!(results.nuscenes[2].average_precision() > 0.1);
    results
}

#[test]
fn groups_are_a_loop_of_calls() {
    let drawn = Drawn::new();
    let own = results(&drawn);
    let of_frames = drawn.of_frames();
    let greedy: Vec<_> = of_frames
        .iter()
        .flat_map(|pairs| assignment::greedy(pairs))
        .collect();
    assert_eq!(own.greedy, greedy);
    let largest = of_frames.iter().map(|pairs| assignment::largest(pairs));
    let largest: Vec<_> = largest.flat_map(|pairs| pairs.expect("is valid")).collect();
    assert_eq!(own.largest, largest);
    assert_eq!(
        own.outcomes,
        outcomes(&drawn.frame(), 0.3).expect("is valid")
    );
    let right = own
        .outcomes
        .iter()
        .filter(|x| matches!(x, Outcome::Right(_)));
    assert!(right.count() > 1000);
    // Pairs in any order.
    let mut mixed = Drawn::new();
    mixed.pairs.reverse();
    assert_eq!(results(&mixed), own);
    // One group is no group.
    let [all, truths] = drawn
        .offsets
        .each_ref()
        .map(|offsets| [0, offsets[offsets.len() - 1]]);
    let whole = Groups::new(&all, &truths);
    let cpu = Cpu::new();
    assert_eq!(
        cpu.greedy_grouped(&drawn.pairs, whole),
        Ok(assignment::greedy(&drawn.pairs))
    );
    let found = cpu.outcomes_grouped(&drawn.frame(), whole, 0.3);
    assert_eq!(found, outcomes(&drawn.frame(), 0.3));
}

#[cfg(feature = "parallel")]
#[test]
fn same_bits_for_any_number_of_threads() {
    let drawn = Drawn::new();
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("has threads").install(|| results(&drawn))
    };
    let one = run(1);
    assert!(one == run(3) && one == run(16));
    assert_eq!(
        one,
        geograd::kernels::dynamic::on_this_thread(|| results(&drawn))
    );
}

#[test]
fn what_is_wrong_is_said_as_without_groups() {
    let pair = |first, second, overlap| Pair {
        first,
        second,
        overlap,
    };
    let (cpu, groups) = (Cpu::new(), Groups::new(&[0, 2, 3], &[0, 1, 2]));
    let said = |pairs: &[Pair<f64>]| {
        let scores = [0.1, 0.2, 0.3];
        let frame = Frame::new(&scores, 2, pairs);
        let error = cpu
            .outcomes_grouped(&frame, groups, 0.5)
            .expect_err("is wrong");
        assert_eq!(cpu.largest_grouped(pairs, groups), Err(error));
        error.to_string()
    };
    let beyond = said(&[pair(0, 0, 0.5), pair(3, 1, 0.5)]);
    assert!(
        beyond.contains("item 1") && beyond.contains("beyond"),
        "{beyond}"
    );
    let crossing = said(&[pair(0, 0, 0.5), pair(1, 0, 0.5), pair(1, 1, 0.5)]);
    assert!(
        crossing.contains("item 2") && crossing.contains("another group"),
        "{crossing}"
    );
    let nan = said(&[pair(0, 0, 0.5), pair(2, 1, f64::NAN)]);
    assert!(nan.contains("item 1") && nan.contains("overlap"), "{nan}");
    let scores = [0.1, f64::INFINITY, 0.3];
    let frame = Frame::new(&scores, 2, &[]);
    let error = cpu.outcomes_grouped(&frame, groups, 0.5);
    assert_eq!(error, outcomes(&frame, 0.5));
    assert!(matches!(error, Err(Error::Invalid { item: 1, .. })));
    let flags = Frame {
        ignored_truths: &[true],
        ..Frame::new(&[0.1, 0.2, 0.3], 2, &[])
    };
    assert_eq!(
        cpu.outcomes_grouped(&flags, groups, 0.5),
        outcomes(&flags, 0.5)
    );
    assert!(
        cpu.greedy_grouped(&[pair(0, 0, 0.5)], Groups::new(&[0, 1], &[0]))
            .is_err()
    );
    assert!(
        cpu.greedy_grouped::<f64>(&[], Groups::new(&[], &[]))
            .is_err()
    );
    assert_eq!(
        cpu.greedy_grouped::<f64>(&[], Groups::new(&[0], &[0])),
        Ok(Vec::new())
    );
}
