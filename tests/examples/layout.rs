//! The example `layout`.
use super::{files, folder, run, status, stderr, stdout};

#[test]
fn shapes_part_and_are_drawn() {
    let at = folder("layout");
    let done = run(
        "layout",
        &at,
        "--iterations 250 --seed 3 --svg out.svg --csv out.csv",
    );
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    assert!(stdout(&done).starts_with("12 shapes fill "));
    assert_eq!(files(&at), ["out.csv", "out.svg"]);
    let picture = std::fs::read_to_string(at.join("out.svg")).unwrap();
    assert!(picture.starts_with("<svg") && picture.ends_with("</svg>\n"));
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
    let table = std::fs::read_to_string(at.join("out.csv")).unwrap();
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some("iteration,loss,penetration"));
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.split(',').map(|x| x.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), 251);
    let (first, last) = (&rows[0], &rows[250]);
    assert!(first[2] > 0.5 && last[2] < 0.05, "{first:?} {last:?}");
    assert!(last[1] < 1e-2 * first[1], "{first:?} {last:?}");
}
