//! `calibrate`.
use crate::{files, folder, run, status, stderr, stdout};

#[test]
fn calibrate_finds_the_motion() {
    let at = folder("calibrate");
    for seed in 1..4 {
        let options = format!("--seed {seed} --svg out.svg --csv out.csv");
        let done = run("calibrate", &at, &options);
        assert_eq!((status(&done), stderr(&done)), (0, ""));
        let text = std::fs::read_to_string(at.join("out.csv")).unwrap();
        let (header, rows) = text.split_once('\n').unwrap();
        assert_eq!(header, "iteration,loss,iou,angle_error");
        let rows: Vec<Vec<f64>> = rows
            .lines()
            .map(|row| row.split(',').map(|x| x.parse().unwrap()).collect())
            .collect();
        assert!(rows.iter().enumerate().all(|(i, row)| row[0] == i as f64));
        let (first, last) = (&rows[0], &rows[rows.len() - 1]);
        assert!(last[1] < 0.6 * first[1] && last[2] > 0.55, "{last:?}");
        assert!(first[3] > 0.04 && last[3] < 0.005, "{first:?} {last:?}");
        let picture = std::fs::read_to_string(at.join("out.svg")).unwrap();
        assert!(picture.starts_with("<svg") && picture.ends_with("</svg>\n"));
        assert!(!picture.contains("NaN") && !picture.contains("inf"));
    }
    // The same seed is the same scene.
    let again = || stdout(&run("calibrate", &at, "--seed 5 --steps 3")).to_string();
    assert_eq!(again(), again());
}

#[test]
fn calibrate_refuses_what_makes_no_sense() {
    let at = folder("calibrate_refused");
    for arguments in [
        "--seed x",
        "--steps -1",
        "--svg",
        "--svg a --csv a",
        "--frobnicate",
    ] {
        let done = run("calibrate", &at, arguments);
        assert_eq!((status(&done), stdout(&done)), (2, ""), "{arguments}");
    }
    assert_eq!(files(&at), [""; 0]);
    let done = run("calibrate", &at, "--steps 1 --csv no/such/folder.csv");
    assert_eq!(status(&done), 1);
    assert!(stderr(&done).contains("no/such/folder.csv"));
}
