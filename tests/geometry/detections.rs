//! Suppression, assignment and metrics against their definitions, written down naively.
use geograd::ad::adjoint::suppression::soft_vjp;
use geograd::assignment::{greedy, largest, optimal};
use geograd::error::{Argument, Error, Field, Flaw};
use geograd::kernels::Cpu;
use geograd::metric::{Frame, Outcome, Point, Recalls, average_precision, curve, outcomes};
use geograd::suppression::{
    Decay, Pair, Rules, cluster, hard, matrix, order, soft, soft_replay, soft_search,
};
use geograd::{Obb2, Scalar, Vec3, YawBox3};
use geograd_tests::Dice;
use geograd_tests::rows::{IouObb2, IouYaw};

/// Scores, classes and a symmetric matrix of overlaps, with ties now and then.
struct Scene {
    scores: Vec<f64>,
    classes: Vec<u32>,
    dense: Vec<Vec<f64>>,
}

impl Scene {
    fn new(dice: &mut Dice, count: usize) -> Self {
        let level = |dice: &mut Dice, steps: usize| dice.below(steps) as f64 / steps as f64;
        let scores = (0..count).map(|_| level(dice, 12)).collect();
        let classes = (0..count).map(|_| dice.below(2) as u32).collect();
        let mut dense = vec![vec![0.0; count]; count];
        let below = (0..count).flat_map(|i| (0..i).map(move |j| (i, j)));
        for (i, j) in below {
            if dice.below(3) > 0 {
                let overlap = level(dice, 20);
                (dense[i][j], dense[j][i]) = (overlap, overlap);
            }
        }
        Scene {
            scores,
            classes,
            dense,
        }
    }
    /// In any order, either way round.
    fn pairs(&self, dice: &mut Dice) -> Vec<Pair<f64>> {
        let mut pairs = Vec::new();
        for i in 0..self.scores.len() {
            for j in 0..i {
                let (first, second) = if dice.below(2) == 0 { (i, j) } else { (j, i) };
                let overlap = self.dense[i][j];
                if overlap > 0.0 {
                    pairs.insert(
                        dice.below(pairs.len() + 1),
                        Pair {
                            first,
                            second,
                            overlap,
                        },
                    );
                }
            }
        }
        pairs
    }
    fn overlap(&self, i: usize, j: usize) -> f64 {
        let same = self.classes[i] == self.classes[j];
        if same { self.dense[i][j] } else { 0.0 }
    }
    /// Best first, stable.
    fn sorted(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.scores.len()).collect();
        order.sort_by(|&i, &j| self.scores[j].total_cmp(&self.scores[i]));
        order
    }
}

#[test]
fn hard_and_cluster_are_the_definition() {
    let mut dice = Dice(61);
    for n in 0..200 {
        let scene = Scene::new(&mut dice, n % 14);
        let pairs = scene.pairs(&mut dice);
        let rules = Rules {
            classes: Some(&scene.classes),
            score: 0.2,
            ..Rules::above(0.4)
        };
        let mut expected: Vec<usize> = Vec::new();
        for i in scene.sorted() {
            let is_free = expected.iter().all(|&k| scene.overlap(i, k) <= 0.4);
            if scene.scores[i] >= 0.2 && is_free {
                expected.push(i);
            }
        }
        assert_eq!(hard(&scene.scores, &pairs, rules).unwrap(), expected);
        assert_eq!(cluster(&scene.scores, &pairs, rules).unwrap().0, expected);
        expected.truncate(2);
        let rules = Rules { most: 2, ..rules };
        assert_eq!(hard(&scene.scores, &pairs, rules).unwrap(), expected);
        assert_eq!(cluster(&scene.scores, &pairs, rules).unwrap().0, expected);
    }
}

#[test]
fn soft_is_the_loop_of_its_paper() {
    let mut dice = Dice(62);
    for n in 0..200 {
        let scene = Scene::new(&mut dice, n % 12);
        let pairs = scene.pairs(&mut dice);
        let rules = Rules {
            classes: Some(&scene.classes),
            score: 0.05,
            ..Rules::above(0.3)
        };
        for decay in [Decay::Linear, Decay::Gaussian { sigma: 0.5 }] {
            let mut now = scene.scores.clone();
            let mut left: Vec<usize> = (0..now.len()).filter(|&i| now[i] >= 0.05).collect();
            let mut expected = Vec::new();
            while !left.is_empty() {
                let mut best = 0;
                for k in 0..left.len() {
                    if now[left[k]] > now[left[best]] {
                        best = k;
                    }
                }
                let taken = left.remove(best);
                if now[taken] < 0.05 {
                    break;
                }
                expected.push((taken, now[taken]));
                for &i in &left {
                    let overlap = scene.overlap(taken, i);
                    now[i] *= match decay {
                        Decay::Linear if overlap > 0.3 => 1.0 - overlap,
                        Decay::Linear => 1.0,
                        Decay::Gaussian { sigma } => Scalar::exp(-overlap * overlap / sigma),
                    };
                }
            }
            let found = soft(&scene.scores, &pairs, decay, rules).unwrap();
            let found: Vec<(usize, f64)> = found.iter().map(|k| (k.index, k.score)).collect();
            assert_eq!(found, expected);
        }
    }
}

/// Whatever the scores and the overlaps are: no score rises, and the best comes first.
#[test]
fn softened_scores_fall_and_stay_in_order() {
    let mut dice = Dice(64);
    let pairs = [Pair {
        first: 0,
        second: 1,
        overlap: 0.9,
    }];
    let kept = soft(&[-0.1, -0.2], &pairs, Decay::Linear, Rules::above(0.5)).unwrap();
    assert_eq!(
        kept.iter().map(|k| k.score).collect::<Vec<_>>(),
        [-0.1, -0.2]
    );
    let mut raised = 0;
    for n in 0..400 {
        let mut scene = Scene::new(&mut dice, n % 12);
        let mut pairs = scene.pairs(&mut dice);
        for score in &mut scene.scores {
            *score = dice.within(-1.0, 1.0);
        }
        for pair in &mut pairs {
            pair.overlap *= 1.5;
        }
        let rules = Rules {
            classes: Some(&scene.classes),
            ..Rules::above(0.3)
        };
        for decay in [Decay::Linear, Decay::Gaussian { sigma: 0.5 }] {
            let (soft, record) = soft_search(&scene.scores, &pairs, decay, rules).unwrap();
            let bar = vec![1.0; soft.len()];
            let (by_score, _) = soft_vjp(&scene.scores, &pairs, decay, 0.3, &record, &bar);
            for kept in [&soft, &matrix(&scene.scores, &pairs, decay, rules).unwrap()] {
                assert!(kept.windows(2).all(|two| two[0].score >= two[1].score));
                for k in kept {
                    let before = scene.scores[k.index];
                    assert!(k.score <= before && k.score >= before.min(0.0));
                    if before < 0.0 {
                        assert_eq!((k.score, by_score[k.index]), (before, 1.0));
                        raised += 1;
                    }
                }
            }
        }
    }
    assert!(raised > 100);
}

#[test]
fn derivatives_of_soft_scores_are_differences() {
    let mut dice = Dice(63);
    for _ in 0..40 {
        let scene = Scene::new(&mut dice, 8);
        let pairs = scene.pairs(&mut dice);
        let scores: Vec<f64> = scene
            .scores
            .iter()
            .map(|x| x + 0.05 * dice.roll())
            .collect();
        let rules = Rules::above(0.3);
        for decay in [Decay::Linear, Decay::Gaussian { sigma: 0.4 }] {
            let (kept, record) = soft_search(&scores, &pairs, decay, rules).unwrap();
            let replayed = soft_replay(&scores, &pairs, decay, 0.3, &record);
            assert!(
                kept.iter()
                    .zip(&replayed)
                    .all(|(k, score)| k.score == *score)
            );
            let bar: Vec<f64> = kept.iter().map(|_| dice.within(-1.0, 1.0)).collect();
            let (by_score, by_pair) = soft_vjp(&scores, &pairs, decay, 0.3, &record, &bar);
            let loss = |scores: &[f64], pairs: &[Pair<f64>]| -> f64 {
                let now = soft_replay(scores, pairs, decay, 0.3, &record);
                now.iter().zip(&bar).map(|(x, bar)| x * bar).sum()
            };
            let step = 1e-6;
            for i in 0..scores.len() {
                let at = |h: f64| {
                    let mut moved = scores.clone();
                    moved[i] += h;
                    loss(&moved, &pairs)
                };
                let derivative = (at(step) - at(-step)) / (2.0 * step);
                assert!((derivative - by_score[i]).abs() < 1e-8);
            }
            for k in 0..pairs.len() {
                if (pairs[k].overlap - 0.3).abs() < 1e-5 {
                    continue; // A jump.
                }
                let at = |h: f64| {
                    let mut moved = pairs.clone();
                    moved[k].overlap += h;
                    loss(&scores, &moved)
                };
                let derivative = (at(step) - at(-step)) / (2.0 * step);
                assert!(
                    (derivative - by_pair[k]).abs() < 1e-8,
                    "{derivative} {}",
                    by_pair[k]
                );
            }
        }
    }
}

#[test]
fn matrix_is_its_formula() {
    let mut dice = Dice(64);
    for n in 0..100 {
        let scene = Scene::new(&mut dice, n % 12);
        let pairs = scene.pairs(&mut dice);
        let sorted = scene.sorted();
        for decay in [Decay::Linear, Decay::Gaussian { sigma: 0.5 }] {
            let factor = |x: f64| match decay {
                Decay::Linear => 1.0 - x,
                Decay::Gaussian { sigma } => (-x * x / sigma).exp(),
            };
            let hidden = |place: usize| {
                let better = sorted[..place].iter();
                better.fold(0.0_f64, |m, &k| m.max(scene.overlap(sorted[place], k)))
            };
            let mut expected: Vec<(usize, f64)> = (0..sorted.len())
                .map(|place| {
                    let least = (0..place).fold(1.0_f64, |least, before| {
                        let overlap = scene.overlap(sorted[place], sorted[before]);
                        least.min(factor(overlap) / factor(hidden(before)))
                    });
                    (sorted[place], scene.scores[sorted[place]] * least)
                })
                .collect();
            expected.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
            let rules = Rules {
                classes: Some(&scene.classes),
                ..Rules::above(0.0)
            };
            let found = matrix(&scene.scores, &pairs, decay, rules).unwrap();
            let found: Vec<(usize, f64)> = found.iter().map(|k| (k.index, k.score)).collect();
            assert_eq!(found.len(), expected.len());
            for (one, other) in found.iter().zip(&expected) {
                assert_eq!(one.0, other.0);
                assert!((one.1 - other.1).abs() < 1e-15);
            }
        }
    }
}

#[test]
fn boxes_suppress_each_other() {
    let mut dice = Dice(65);
    let boxes: Vec<_> = (0..60).map(|_| dice.obb()).collect();
    let scores: Vec<f64> = boxes.iter().map(|_| dice.roll()).collect();
    let pairs = Cpu::new().overlaps(IouObb2, &boxes, 0.1).unwrap();
    assert!(pairs.len() > 20 && pairs.iter().all(|p| p.first < p.second));
    let kept = hard(&scores, &pairs, Rules::above(0.1)).unwrap();
    for (n, &i) in kept.iter().enumerate() {
        assert!(kept[..n].iter().all(|&k| boxes[i].iou(boxes[k]) <= 0.1));
    }
    for i in 0..boxes.len() {
        let hides = |&k: &usize| scores[k] >= scores[i] && boxes[i].iou(boxes[k]) > 0.1;
        assert!(kept.contains(&i) || kept.iter().any(hides));
    }
}

#[test]
fn what_is_wrong_is_said() {
    let nan = order(&[0.5, f64::NAN], 0.0).unwrap_err();
    let named = Argument::Named;
    let flaw = Flaw::NotFinite(Field::VALUE);
    assert_eq!(
        nan,
        Error::Invalid {
            argument: named("scores"),
            item: 1,
            flaw
        }
    );
    assert!(hard(&[0.5], &[], Rules::above(1.5)).is_err());
    assert!(hard(&[0.5], &[], Rules::above(f64::NAN)).is_err());
    let pair = Pair {
        first: 0,
        second: 3,
        overlap: 0.5,
    };
    let beyond = hard(&[0.5], &[pair], Rules::above(0.5)).unwrap_err();
    assert_eq!(
        beyond.to_string(),
        "`pairs` item 0: second is beyond the scores"
    );
    let classes = Rules {
        classes: Some(&[1, 2]),
        ..Rules::above(0.5)
    };
    assert!(matches!(
        hard(&[0.5], &[], classes),
        Err(Error::Length { found: 2, .. })
    ));
    let sigma = Decay::Gaussian { sigma: 0.0 };
    assert!(soft(&[0.5], &[], sigma, Rules::above(0.5)).is_err());
    assert!(optimal(&[0.5], 1, 2).is_err());
    assert!(optimal(&[f64::INFINITY], 1, 1).is_err());
    assert!(outcomes(&Frame::new(&[0.5], 1, &[pair]), 0.5).is_err());
    assert!(curve(&[0.5], &[], 1).is_err());
}

/// The largest sum by trying everything.
fn best_sum(gains: &[f64], columns: usize, row: usize, used: &mut Vec<bool>) -> f64 {
    let rows = gains.len() / columns;
    if row == rows {
        return 0.0;
    }
    let free = used.iter().filter(|x| !**x).count();
    let mut best = f64::NEG_INFINITY;
    if rows - row > free {
        best = best_sum(gains, columns, row + 1, used);
    }
    for column in 0..columns {
        if !used[column] {
            used[column] = true;
            let rest = best_sum(gains, columns, row + 1, used);
            best = best.max(gains[row * columns + column] + rest);
            used[column] = false;
        }
    }
    best
}

#[test]
fn assignments_are_the_best() {
    let mut dice = Dice(66);
    for n in 0..420 {
        let (rows, columns) = (1 + n % 6, 1 + n / 6 % 7);
        let gains: Vec<f64> = (0..rows * columns)
            .map(|_| dice.below(40) as f64 / 8.0 - 2.0)
            .collect();
        let pairs = optimal(&gains, rows, columns).unwrap();
        assert_eq!(pairs.len(), rows.min(columns));
        assert!(pairs.windows(2).all(|w| w[0].0 < w[1].0));
        let mut seen = vec![false; columns];
        for &(_, column) in &pairs {
            assert!(!std::mem::replace(&mut seen[column], true));
        }
        let sum: f64 = pairs.iter().map(|&(i, j)| gains[i * columns + j]).sum();
        let best = best_sum(&gains, columns, 0, &mut vec![false; columns]);
        assert!((sum - best).abs() < 1e-12, "{sum} {best}");
        // Greedy: the largest of the remaining pairs is taken.
        let mut left: Vec<Pair<f64>> = (0..rows * columns)
            .map(|k| Pair {
                first: k / columns,
                second: k % columns,
                overlap: gains[k],
            })
            .collect();
        let all = left.clone();
        let mut expected = Vec::new();
        while let Some(&first) = left.first() {
            let largest = left
                .iter()
                .fold(first, |m, p| if p.overlap > m.overlap { *p } else { m });
            expected.push(largest);
            left.retain(|p| p.first != largest.first && p.second != largest.second);
        }
        assert_eq!(greedy(&all), expected);
    }
    assert!(optimal(&[], 0, 3).unwrap().is_empty() && optimal(&[], 3, 0).unwrap().is_empty());
}

#[test]
fn assignments_of_some_pairs_of_many_frames() {
    let mut dice = Dice(67);
    let (mut all, mut expected) = (Vec::new(), Vec::new());
    for n in 0..150 {
        let (rows, columns) = (1 + n % 6, 1 + n / 6 % 7);
        let mut pairs = Vec::new();
        for k in 0..rows * columns {
            if dice.below(3) == 0 {
                pairs.push(Pair {
                    first: 6 * n + k / columns,
                    second: 7 * n + k % columns,
                    overlap: dice.roll() - 0.1,
                });
            }
        }
        let own = largest(&pairs).unwrap();
        let mut gains = vec![0.0_f64; rows * columns];
        for pair in &pairs {
            gains[(pair.first - 6 * n) * columns + pair.second - 7 * n] = pair.overlap.max(0.0);
        }
        let best = best_sum(&gains, columns, 0, &mut vec![false; columns]);
        let sum: f64 = own.iter().map(|pair| pair.overlap).sum();
        assert!((sum - best).abs() < 1e-12, "{sum} {best}");
        assert!(
            own.iter()
                .all(|pair| pair.overlap > 0.0 && pairs.contains(pair))
        );
        for of in [
            |pair: &Pair<f64>| pair.first,
            |pair: &Pair<f64>| pair.second,
        ] {
            let mut places: Vec<usize> = own.iter().map(of).collect();
            places.sort_unstable();
            assert!(places.windows(2).all(|w| w[0] < w[1]));
        }
        all.extend(pairs);
        expected.extend(own);
    }
    // One call for all frames, whatever the order of pairs.
    assert_eq!(largest(&all).unwrap(), expected);
    all.reverse();
    assert_eq!(largest(&all).unwrap(), expected);
    // Greedy gives the pairs of every frame as well, in the order of their overlaps.
    let mut taken = greedy(&all);
    taken.sort_unstable_by_key(|pair| pair.first);
    let by_frame = all.chunk_by(|a, b| a.first / 6 == b.first / 6).rev();
    let mut of_frames: Vec<Pair<f64>> = by_frame.flat_map(greedy).collect();
    of_frames.sort_unstable_by_key(|pair| pair.first);
    assert_eq!(taken, of_frames);
    let wrong = Pair {
        first: 0,
        second: 0,
        overlap: f64::NAN,
    };
    assert!(largest(&[wrong]).is_err() && largest(&[]).unwrap().is_empty());
}

#[test]
fn average_precision_of_a_known_curve() {
    // Right, wrong, right, wrong, right of four truths: precisions 1, 1/2, 2/3, 1/2, 3/5.
    let scores = [0.9, 0.8, 0.7, 0.6, 0.5];
    let right = |k| Outcome::Right(k);
    let found = [right(0), Outcome::Wrong, right(1), Outcome::Wrong, right(2)];
    let points = curve(&scores, &found, 4).unwrap();
    let last = Point {
        score: 0.5,
        precision: 0.6,
        recall: 0.75,
    };
    assert_eq!(points[4], last);
    let all = average_precision(&points, Recalls::All);
    assert!((all - (1.0 + 2.0 / 3.0 + 0.6) / 4.0).abs() < 1e-15);
    // Eleven recalls: 0, .1, .2 reach 1; .3, .4, .5 two thirds; .6, .7 three fifths.
    let eleven = average_precision(&points, Recalls::Eleven);
    assert!((eleven - (3.0 + 3.0 * 2.0 / 3.0 + 2.0 * 0.6) / 11.0).abs() < 1e-15);
    // Forty recalls: ten to 1/4, ten to 1/2, ten to 3/4.
    let forty = average_precision(&points, Recalls::Forty);
    assert!((forty - (10.0 + 10.0 * 2.0 / 3.0 + 10.0 * 0.6) / 40.0).abs() < 1e-14);
    assert_eq!(average_precision(&[], Recalls::All), 0.0);
    // Equal scores come in at once.
    let tied = curve(&[0.5, 0.5], &[Outcome::Wrong, right(0)], 1).unwrap();
    assert_eq!((tied.len(), tied[0].precision), (1, 0.5));
}

#[test]
fn ignored_boxes_count_neither_way() {
    let pair = |first, second, overlap| Pair {
        first,
        second,
        overlap,
    };
    // Detection 0 overlaps an ignored truth most and a real one enough; 1 only the ignored one; 2 is too
    // small to count; 3 finds nothing; 4 repeats what 0 found.
    let pairs = [
        pair(0, 0, 0.9),
        pair(0, 1, 0.6),
        pair(1, 0, 0.8),
        pair(2, 2, 0.9),
        pair(4, 1, 0.95),
        pair(3, 2, 0.4),
    ];
    let frame = Frame {
        ignored_truths: &[true, false, false],
        ignored_detections: &[false, false, true, false, false],
        ..Frame::new(&[0.9, 0.8, 0.7, 0.6, 0.5], 3, &pairs)
    };
    use Outcome::{Ignored, Right, Wrong};
    let found = outcomes(&frame, 0.5).unwrap();
    assert_eq!(found, [Right(1), Ignored, Ignored, Wrong, Wrong]);
    let points = curve(frame.scores, &found, 2).unwrap();
    assert_eq!(points.len(), 3);
    assert_eq!((points[2].recall, points[2].precision), (0.5, 1.0 / 3.0));
}

/// Boxes of a crowd, scores with ties, and classes.
fn crowd(dice: &mut Dice, count: usize, side: f64) -> (Vec<Obb2<f32>>, Vec<f32>, Vec<u32>) {
    let mut car = || {
        Obb2::new(
            dice.within(0.0, side) as f32,
            dice.within(0.0, side) as f32,
            dice.within(2.0, 5.0) as f32,
            dice.within(1.0, 2.0) as f32,
            dice.within(-3.0, 3.0) as f32,
        )
    };
    let boxes = (0..count).map(|_| car()).collect();
    let scores = (0..count).map(|_| dice.below(40) as f32 / 40.0).collect();
    (
        boxes,
        scores,
        (0..count).map(|_| dice.below(3) as u32).collect(),
    )
}

#[test]
fn suppression_of_boxes_is_that_of_their_pairs() {
    let mut dice = Dice(31);
    for (count, side) in [
        (0, 1.0),
        (1, 1.0),
        (15, 4.0),
        (300, 10.0),
        (700, 8.0),
        (1500, 300.0),
    ] {
        let (boxes, scores, classes) = crowd(&mut dice, count, side);
        // The better one of a pair is the first argument: the list sorted by scores gives the same.
        let best = order(&scores, 0.1).unwrap();
        let sorted: Vec<_> = best.iter().map(|&i| boxes[i]).collect();
        let sorted_scores: Vec<_> = best.iter().map(|&i| scores[i]).collect();
        let sorted_classes: Vec<_> = best.iter().map(|&i| classes[i]).collect();
        let upright = |x: &Obb2<f32>| {
            let (center, size) = (x.center, x.size);
            YawBox3::new(
                Vec3::new(center.x, center.y, 0.1 * center.x),
                Vec3::new(size.x, size.y, 1.5),
                x.heading,
            )
        };
        let solid: Vec<_> = boxes.iter().map(upright).collect();
        let sorted_solid: Vec<_> = sorted.iter().map(upright).collect();
        for overlap in [0.0, 0.1, 0.5] {
            let pairs = Cpu::new().overlaps(IouObb2, &sorted, overlap).unwrap();
            let solid_pairs = Cpu::new().overlaps(IouYaw, &sorted_solid, overlap).unwrap();
            for (with_classes, most) in [(false, usize::MAX), (true, usize::MAX), (true, 7)] {
                let rules = |classes| Rules {
                    classes,
                    most,
                    score: 0.1,
                    ..Rules::above(overlap)
                };
                let sorted_rules = rules(with_classes.then_some(&sorted_classes[..]));
                let rules = rules(with_classes.then_some(&classes[..]));
                let places = |kept: Vec<usize>| kept.iter().map(|&i| best[i]).collect::<Vec<_>>();
                let expected = places(hard(&sorted_scores, &pairs, sorted_rules).unwrap());
                let expected_solid =
                    places(hard(&sorted_scores, &solid_pairs, sorted_rules).unwrap());
                for cpu in [Cpu::new(), Cpu::new().culled(false)] {
                    let kept = cpu.suppress(IouObb2, &boxes, &scores, rules).unwrap();
                    assert_eq!(kept, expected, "{count} boxes above {overlap}");
                    let kept = cpu.suppress(IouYaw, &solid, &scores, rules).unwrap();
                    assert_eq!(kept, expected_solid, "{count} solids above {overlap}");
                }
            }
        }
    }
}

/// Boxes too large for compiled kernels, in lists that fill no tile.
#[test]
fn suppression_of_huge_boxes() {
    for count in [1, 15, 17, 30, 600] {
        let mut boxes: Vec<Obb2<f32>> = (0..count)
            .map(|k| Obb2::new(3.0 * k as f32, 0.0, 2.0, 1.0, 0.1))
            .collect();
        boxes[count / 2] = Obb2::new(0.0, 0.0, 1e30, 1e30, 0.2);
        let scores = vec![0.5; count];
        for overlap in [0.0, 0.5] {
            let pairs = Cpu::new().overlaps(IouObb2, &boxes, overlap).unwrap();
            assert!(pairs.iter().all(|pair| pair.second < count));
            let expected = hard(&scores, &pairs, Rules::above(overlap)).unwrap();
            let kept = Cpu::new().suppress(IouObb2, &boxes, &scores, Rules::above(overlap));
            assert_eq!(kept.unwrap(), expected, "{count} boxes above {overlap}");
        }
    }
}

#[test]
fn suppression_of_boxes_says_what_is_wrong() {
    let boxes = [Obb2::new(0.0_f32, 0.0, 1.0, 1.0, 0.0); 3];
    let cpu = Cpu::new();
    let found = cpu.suppress(IouObb2, &boxes, &[0.5, 0.5], Rules::above(0.5));
    assert!(matches!(found, Err(Error::Length { .. })));
    let found = cpu.suppress(IouObb2, &boxes, &[0.5, f32::NAN, 0.5], Rules::above(0.5));
    assert!(matches!(found, Err(Error::Invalid { item: 1, .. })));
    for overlap in [-0.1, 1.5, f32::NAN] {
        let found = cpu.suppress(IouObb2, &boxes, &[0.5; 3], Rules::above(overlap));
        assert!(matches!(found, Err(Error::Invalid { .. })), "{overlap}");
    }
    let mut wrong = boxes;
    wrong[2].size.x = -1.0;
    let found = cpu.suppress(IouObb2, &wrong, &[0.9, 0.1, 0.5], Rules::above(0.5));
    assert!(matches!(found, Err(Error::Invalid { item: 2, .. })));
    let rules = Rules {
        classes: Some(&[1, 2]),
        ..Rules::above(0.5)
    };
    let found = cpu.suppress(IouObb2, &boxes, &[0.5; 3], rules);
    assert!(matches!(found, Err(Error::Length { .. })));
}
