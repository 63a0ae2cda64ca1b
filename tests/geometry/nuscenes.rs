//! nuScenes' rules against figures of its development kit, for frames that both draw from the same numbers.
use super::pairs::Random;
use geograd::error::{Argument, Error};
use geograd::metric::nuscenes::{Frames, Object, TruePositive, detection_score, judge};
use std::f64::consts::{PI, TAU};

/// Frames as lists one after another.
#[derive(Default)]
struct Drawn {
    detections: Vec<Object>,
    scores: Vec<f64>,
    detection_offsets: Vec<usize>,
    truths: Vec<Object>,
    truth_offsets: Vec<usize>,
}

impl Drawn {
    fn frames(&self, period: f64) -> Frames<'_> {
        Frames {
            detections: &self.detections,
            scores: &self.scores,
            detection_offsets: &self.detection_offsets,
            truths: &self.truths,
            truth_offsets: &self.truth_offsets,
            period,
        }
    }
}

/// Twelve frames of cars: most are found, a little off, some without velocity or attribute; and what is no car.
fn drawn() -> Drawn {
    let mut random = Random(29);
    let mut within = |low, high| random.between(low, high);
    let mut all = Drawn::default();
    all.detection_offsets.push(0);
    all.truth_offsets.push(0);
    for _ in 0..12 {
        for _ in 0..(within(0.0, 1.0) * 6.0) as usize {
            let center = [within(-30.0, 30.0), within(-30.0, 30.0)];
            let size = [within(1.0, 3.0), within(2.0, 6.0), within(1.0, 3.0)];
            let yaw = within(-3.0, 3.0);
            let velocity = [within(-5.0, 5.0), within(-5.0, 5.0)];
            let has_velocity = within(0.0, 1.0) < 0.8;
            let attribute = (within(0.0, 1.0) * 3.0) as u32;
            all.truths.push(Object {
                velocity: has_velocity.then_some(velocity),
                attribute: (attribute < 2).then_some(attribute),
                ..Object::new(center, size, yaw)
            });
            if within(0.0, 1.0) < 0.85 {
                let center = center.map(|x| x + within(-1.5, 1.5));
                let size = size.map(|x| x * within(0.8, 1.2));
                let yaw = yaw + within(-4.0, 4.0);
                let velocity = velocity.map(|x| x + within(-1.0, 1.0));
                all.detections.push(Object {
                    velocity: Some(velocity),
                    attribute: Some((within(0.0, 1.0) * 2.0) as u32),
                    ..Object::new(center, size, yaw)
                });
                all.scores.push(within(0.3, 1.0));
            }
        }
        for _ in 0..(within(0.0, 1.0) * 3.0) as usize {
            let center = [within(-30.0, 30.0), within(-30.0, 30.0)];
            all.scores.push(within(0.0, 0.8));
            all.detections.push(Object {
                velocity: Some([0.0; 2]),
                attribute: Some(0),
                ..Object::new(center, [2.0, 4.0, 1.5], 0.0)
            });
        }
        all.detection_offsets.push(all.detections.len());
        all.truth_offsets.push(all.truths.len());
    }
    all
}

/// Average precision and the five errors by threshold: nuscenes-devkit 1.2.0, `accumulate`, `calc_ap` and `calc_tp`.
const KIT: [(f64, f64, [f64; 5]); 4] = [
    (0.5, 0.0, [1.0; 5]),
    (
        1.0,
        0.1062670604316454,
        [
            0.7003298410184222,
            0.22339304507094151,
            2.0737102080570278,
            0.6807068117530027,
            0.5722452385798841,
        ],
    ),
    (
        2.0,
        0.809820014779466,
        [
            1.1227000563877354,
            0.22947248643439502,
            2.0290505412172135,
            0.8431023867387099,
            0.5235884924859157,
        ],
    ),
    (
        4.0,
        0.809820014779466,
        [
            1.1227000563877354,
            0.22947248643439502,
            2.0290505412172135,
            0.8431023867387099,
            0.5235884924859157,
        ],
    ),
];

#[test]
fn figures_of_the_kit() {
    let all = drawn();
    assert_eq!((all.truths.len(), all.detections.len()), (35, 43));
    let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-12, "{x} is not {y}");
    for (threshold, precision, errors) in KIT {
        let judged = judge(&all.frames(TAU), threshold).unwrap();
        close(judged.average_precision(), precision);
        for (which, wanted) in TruePositive::ALL.into_iter().zip(errors) {
            close(judged.error(which), wanted);
        }
    }
    // A barrier looks the same after half a turn.
    let judged = judge(&all.frames(PI), 2.0).unwrap();
    close(judged.error(TruePositive::Orientation), 0.7515797729402012);
}

#[test]
fn nothing_found_and_nothing_there() {
    let mut all = drawn();
    all.detections.clear();
    all.scores.clear();
    all.detection_offsets.fill(0);
    let judged = judge(&all.frames(TAU), 2.0).unwrap();
    assert_eq!(judged.average_precision(), 0.0);
    assert!(
        TruePositive::ALL
            .iter()
            .all(|&which| judged.error(which) == 1.0)
    );
    assert_eq!(detection_score(judged.average_precision(), [1.0; 5]), 0.0);
    let mut all = drawn();
    all.truths.clear();
    all.truth_offsets.fill(0);
    assert_eq!(
        judge(&all.frames(TAU), 2.0).unwrap().average_precision(),
        0.0
    );
    assert_eq!(judge(&Drawn::default().frames(TAU), 2.0), {
        let argument = Argument::Named("detection_offsets");
        Err(Error::GroupsOf { argument, item: 0 })
    });
}

#[test]
fn wrong_input_is_named() {
    let message = |change: &dyn Fn(&mut Drawn)| {
        let mut all = drawn();
        change(&mut all);
        judge(&all.frames(TAU), 2.0).unwrap_err().to_string()
    };
    assert_eq!(
        message(&|all| all.truths[3].center[1] = f64::NAN),
        "`truths` item 3: center is not a finite number"
    );
    assert_eq!(
        message(&|all| all.detections[2].size[0] = 0.0),
        "`detections` item 2: size is not positive"
    );
    assert_eq!(
        message(&|all| all.scores[5] = f64::INFINITY),
        "`scores` item 5: value is not a finite number"
    );
    assert!(message(&|all| all.truth_offsets[4] = 99).contains("offset 4"));
    assert!(message(&|all| all.scores.truncate(7)).contains("scores"));
}
