//! The example `polygon_fit`.
use super::{files, folder, run, status, stderr, stdout};

#[test]
fn fits_get_better_and_are_drawn() {
    let at = folder("polygon_fit");
    let done = run(
        "polygon_fit",
        &at,
        "--loss overlap --iterations 12 --seed 3 --svg fit.svg --csv fit.csv",
    );
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    assert!(
        stdout(&done).contains("convex   overlap") && stdout(&done).contains("hole     overlap")
    );
    assert_eq!(files(&at), ["fit.csv", "fit.svg"]);
    let picture = std::fs::read_to_string(at.join("fit.svg")).unwrap();
    assert!(picture.starts_with("<svg") && picture.ends_with("</svg>\n"));
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
    let table = std::fs::read_to_string(at.join("fit.csv")).unwrap();
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some("iteration,loss,iou"));
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.split(',').map(|x| x.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), 2 * 13);
    for fit in rows.chunks(13) {
        assert!(fit[0][2] < 0.6 && fit[12][2] > 0.8, "{fit:?}");
        for (k, row) in fit.iter().enumerate() {
            assert_eq!(row[0], k as f64);
            assert!((row[1] + row[2] - 1.0).abs() < 1e-12);
            assert!(k == 0 || row[1] <= fit[k - 1][1]);
        }
    }
}

#[test]
fn a_file_that_cannot_be_written_is_named() {
    let at = folder("polygon_fit_nowhere");
    let done = run(
        "polygon_fit",
        &at,
        "--shape convex --loss distance --iterations 1 --svg no/such/folder.svg",
    );
    assert_eq!(status(&done), 1);
    assert!(stderr(&done).contains("no/such/folder.svg"));
}
