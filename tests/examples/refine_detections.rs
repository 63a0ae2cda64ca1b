//! `refine_detections` with all its losses, from above and in space.
use crate::{DETECTIONS, LABELS, folder, row, run, status, stderr, stdout};

const LOSSES: [&str; 9] = [
    "iou",
    "giou",
    "diou",
    "ciou",
    "gwd",
    "kld",
    "kfiou",
    "probiou",
    "separation",
];

/// Average precision before and after, by class, of a run's `--csv`.
fn precision(text: &str) -> Vec<(String, f64, f64)> {
    let (header, rows) = text.split_once('\n').unwrap();
    assert_eq!(header, "class,ap_before,ap_after");
    let number = |x: &str| -> f64 {
        let x = x.parse().unwrap();
        assert!((0.0..=1.0).contains(&x));
        x
    };
    let row = |row: &str| {
        let fields: Vec<&str> = row.split(',').collect();
        assert_eq!(fields.len(), 3, "{row}");
        (fields[0].to_string(), number(fields[1]), number(fields[2]))
    };
    rows.lines().map(row).collect()
}

#[test]
fn every_loss_leads_home() {
    let at = folder("refine_losses");
    for space in ["bev", "3d"] {
        for loss in LOSSES {
            let goal = format!("--loss {loss} --space {space}");
            let rest = "--frames 2 --seed 7 --nms 0.1 --csv ap.csv --svg out.svg";
            let done = run("refine_detections", &at, &format!("{goal} {rest}"));
            assert_eq!((status(&done), stderr(&done)), (0, ""), "{goal}");
            let mean = row(&done, "mean IoU");
            assert!(mean[0] < 0.9 && mean[1] > 0.99, "{goal}: {mean:?}");
            let found = precision(&std::fs::read_to_string(at.join("ap.csv")).unwrap());
            let classes: Vec<&str> = found.iter().map(|(class, _, _)| class.as_str()).collect();
            assert_eq!(classes, ["Car", "Pedestrian", "Cyclist"], "{goal}");
            assert!(found.iter().all(|(_, before, after)| after >= before));
            assert!(stdout(&done).contains("a demonstration"), "{goal}");
            let picture = std::fs::read_to_string(at.join("out.svg")).unwrap();
            assert!(
                !picture.contains("NaN") && !picture.contains("inf"),
                "{goal}"
            );
            assert_eq!(picture.contains("from the right"), space == "3d", "{goal}");
        }
    }
}

/// A car half of its height too high: a third of both is shared in space, all of it seen from above.
#[test]
fn heights_count_in_space_only() {
    let at = folder("refine_heights");
    let seen = "0,2,0,0,1,1,9,2.0,1.8,4.0,3.0,0.6,15.0,0.3,0\n";
    std::fs::write(at.join("seen.txt"), seen).unwrap();
    std::fs::write(
        at.join("true.txt"),
        "0 0 Car 0 0 0 0 0 1 1 2.0 1.8 4.0 3.0 1.6 15.0 0.3\n",
    )
    .unwrap();
    let files = "--detections seen.txt --labels true.txt --csv ap.csv";
    for (space, before) in [("bev", 1.0), ("3d", 0.3333)] {
        let done = run(
            "refine_detections",
            &at,
            &format!("{files} --space {space}"),
        );
        assert_eq!(status(&done), 0, "{}", stderr(&done));
        let mean = row(&done, "mean IoU");
        assert!(mean[0] == before && mean[1] > 0.999, "{space} {mean:?}");
        let found = precision(&std::fs::read_to_string(at.join("ap.csv")).unwrap());
        let expected = if space == "3d" { 0.0 } else { 1.0 };
        assert_eq!(found, [("Car".to_string(), expected, 1.0)]);
    }
}

/// The same car seen twice, and a van taken for a car: neither right nor wrong.
#[test]
fn suppression_and_what_is_alike() {
    let at = folder("refine_suppression");
    let more = "0,2,0,0,1,1,8.0,1.5,1.7,4.2,2.1,1.6,12.1,-1.57,0\n\
        0,2,0,0,1,1,9.9,1.7,2.0,5.0,9.0,1.6,20.0,0.0,0\n";
    std::fs::write(at.join("seen.txt"), format!("{DETECTIONS}{more}")).unwrap();
    std::fs::write(at.join("true.txt"), LABELS).unwrap();
    let files = "--detections seen.txt --labels true.txt --csv ap.csv";
    let without = run("refine_detections", &at, files);
    assert_eq!(row(&without, "boxes"), [5.0, 3.0]);
    let done = run("refine_detections", &at, &format!("{files} --nms 0.1"));
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    assert_eq!(row(&done, "boxes"), [4.0, 3.0]);
    assert_eq!(row(&done, "  suppressed"), [1.0]);
    let found = precision(&std::fs::read_to_string(at.join("ap.csv")).unwrap());
    assert_eq!(found[0], ("Car".to_string(), 1.0, 1.0));
}

/// A pedestrian beside its truth, without overlap: IoU has no derivative there, the others do.
#[test]
fn boxes_apart() {
    let at = folder("refine_apart");
    let seen = "0,1,0,0,1,1,3.5,1.7,0.6,0.8,-5.0,1.6,9.0,0.0,0\n";
    std::fs::write(at.join("seen.txt"), seen).unwrap();
    std::fs::write(
        at.join("true.txt"),
        "0 1 Pedestrian 0 0 0 0 0 1 1 1.7 0.6 0.8 -4.0 1.6 9.0 0.0\n",
    )
    .unwrap();
    for space in ["bev", "3d"] {
        for loss in LOSSES {
            let files = "--detections seen.txt --labels true.txt --csv ap.csv";
            let goal = format!("--loss {loss} --space {space}");
            let done = run("refine_detections", &at, &format!("{files} {goal}"));
            assert_eq!(status(&done), 0, "{}", stderr(&done));
            let found = precision(&std::fs::read_to_string(at.join("ap.csv")).unwrap());
            let after = if loss == "iou" { 0.0 } else { 1.0 };
            assert_eq!(found, [("Pedestrian".to_string(), 0.0, after)], "{goal}");
        }
    }
}
