//! The example `layout`.
use super::{files, folder, run, status, stderr, stdout};

/// The loss and the penetration of every step, from the table.
#[cfg(feature = "gpu")]
fn steps(at: &std::path::Path, backend: &str, iterations: usize) -> Vec<Vec<f64>> {
    let arguments = format!("--iterations {iterations} --csv out.csv --backend {backend}");
    let done = run("layout", at, &arguments);
    assert_eq!(status(&done), 0, "{}", stderr(&done));
    let is_told = stderr(&done).contains("layout: computing on ");
    assert_eq!(is_told, backend == "gpu", "{}", stderr(&done));
    let table = std::fs::read_to_string(at.join("out.csv")).unwrap();
    let rows = table.lines().skip(1);
    rows.map(|line| line.split(',').map(|x| x.parse().unwrap()).collect())
        .collect()
}

#[cfg(feature = "gpu")]
#[test]
fn steps_on_the_gpu_are_those_on_the_cpu() {
    if !super::has_gpu() {
        return;
    }
    let at = folder("layout_gpu");
    // Few steps: small differences grow from step to step, as places decide which corners are nearest.
    let (cpu, gpu) = (steps(&at, "cpu", 12), steps(&at, "gpu", 12));
    assert_eq!((cpu.len(), gpu.len()), (13, 13));
    for (x, y) in cpu.iter().zip(&gpu) {
        for (x, y) in x.iter().zip(y) {
            assert!((x - y).abs() <= 1e-4 * (1.0 + x.abs()), "{cpu:?} {gpu:?}");
        }
    }
    assert!(cpu[12][1] < 0.9 * cpu[0][1], "{cpu:?}");
}

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
