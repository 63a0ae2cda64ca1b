//! `zoning`.
use crate::{files, folder, run, status, stderr, stdout};

#[test]
fn districts_have_their_capacities_and_shorter_ways() {
    let at = folder("zoning");
    for seed in 1..4 {
        let options =
            format!("--seed {seed} --districts 24 --rounds 12 --svg out.svg --csv out.csv");
        let done = run("zoning", &at, &options);
        assert_eq!((status(&done), stderr(&done)), (0, ""));
        assert!(stdout(&done).starts_with("24 districts of "));
        let text = std::fs::read_to_string(at.join("out.csv")).unwrap();
        let (header, rows) = text.split_once('\n').unwrap();
        assert_eq!(header, "round,steps,error,way");
        let rows: Vec<Vec<f64>> = rows
            .lines()
            .map(|row| row.split(',').map(|x| x.parse().unwrap()).collect())
            .collect();
        assert_eq!(rows.len(), 13);
        for (k, row) in rows.iter().enumerate() {
            // Newton's method converges quadratically: few steps, and areas equal to roundings.
            let &[round, steps, error, way] = &row[..] else {
                panic!("{row:?}");
            };
            assert!(round == k as f64 && steps <= 20.0, "{row:?}");
            assert!(error < 1e-11 && way > 0.0, "{row:?}");
        }
        // A station in the centroid of its district, with the same district, has the least sum of squared ways.
        assert!(rows.windows(2).all(|pair| pair[1][3] < pair[0][3] + 1e-9));
        assert!(rows[12][3] < 0.9 * rows[0][3], "{rows:?}");
        let picture = std::fs::read_to_string(at.join("out.svg")).unwrap();
        assert!(picture.starts_with("<svg") && picture.ends_with("</svg>\n"));
        assert!(!picture.contains("NaN") && !picture.contains("inf"));
        // All of the right panel.
        assert!(picture.matches(">100 %<").count() >= 24);
    }
}

#[test]
fn zoning_has_two_districts_at_least() {
    let at = folder("zoning_refused");
    for arguments in [
        "--districts 1",
        "--districts 2001",
        "--rounds -1",
        "--svg a --csv a",
        "--frobnicate",
    ] {
        let done = run("zoning", &at, arguments);
        assert_eq!((status(&done), stdout(&done)), (2, ""), "{arguments}");
    }
    assert_eq!(files(&at), [""; 0]);
    let done = run("zoning", &at, "--districts 2 --rounds 0 --svg out.svg");
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    let done = run("zoning", &at, "--districts 2 --rounds 0 --svg no/such.svg");
    assert_eq!(status(&done), 1);
    assert!(stderr(&done).contains("no/such.svg"));
}
