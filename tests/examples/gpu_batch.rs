//! The example of batches on a GPU, which a build without GPU support does not have, and the report of rows on one.
use crate::{folder, has_gpu, run, status, stderr, stdout, without_gpu};

#[test]
fn gpu_batch_without_a_gpu() {
    let at = folder("gpu_batch_without");
    let done = without_gpu("gpu_batch", &at, "0.001");
    assert_eq!(status(&done), 1);
    let told = stderr(&done);
    assert!(told.starts_with("gpu_batch: no GPU found"), "{told}");
    for wrong in ["--op iou", "0", "-1", "1 2"] {
        assert_eq!(status(&run("gpu_batch", &at, wrong)), 2, "{wrong}");
    }
}

#[test]
fn gpu_batch_runs() {
    if !has_gpu() {
        return;
    }
    let done = run("gpu_batch", &folder("gpu_batch_runs"), "0.0005");
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    let told = stdout(&done);
    assert!(
        told.contains("aligned, with derivatives, transfers and all: 5000 pairs"),
        "{told}"
    );
    assert!(
        told.ends_with("64 rows checked against the CPU\n"),
        "{told}"
    );
}

#[test]
fn gpu_report_without_a_gpu() {
    let at = folder("gpu_report_without");
    let done = without_gpu("gpu_report", &at, "--op iou(obb2,obb2)");
    assert_eq!((status(&done), stdout(&done)), (2, ""));
    let told = stderr(&done);
    assert!(told.starts_with("gpu_report: "), "{told}");
    for wrong in ["--op nothing", "--op", "--items 1", "--frobnicate"] {
        assert_eq!(status(&run("gpu_report", &at, wrong)), 2, "{wrong}");
    }
}

/// A row of every kind, in all its forms, on both machines.
#[test]
fn forms_on_a_gpu_agree_with_the_cpu() {
    if !has_gpu() {
        return;
    }
    let at = folder("gpu_report_agrees");
    let done = run("gpu_report", &at, "--list");
    let names: Vec<&str> = stdout(&done).lines().collect();
    for (name, forms) in [
        ("iou(obb2,obb2)", 4),
        ("centroid(ring)", 2),
        ("distance(vec2,segment2)", 4),
        ("closest_points(segment2,segment2)", 2),
        ("circumcircle(vec2,vec2,vec2)", 2),
        ("signed_distance(ring)", 2),
        ("diameter(convexpolygon6)", 2),
    ] {
        assert!(names.contains(&name), "{name}");
        let done = run(
            "gpu_report",
            &at,
            &format!("--op {name} --forms --items 500"),
        );
        assert_eq!(status(&done), 0, "{name}: {}", stderr(&done));
        let told = stdout(&done);
        let lines = told.lines().filter(|line| line.starts_with("  "));
        assert_eq!(lines.count(), forms, "{told}");
    }
}
