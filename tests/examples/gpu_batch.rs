//! The example of batches on a GPU, which a build without GPU support does not have.
use crate::{folder, has_gpu, run, status, stderr, stdout, without_gpu};

#[test]
fn gpu_batch_without_a_gpu() {
    let at = folder("gpu_batch_without");
    let done = without_gpu("gpu_batch", &at, "--op iou(obb2,obb2) 0.001");
    assert_eq!((status(&done), stdout(&done)), (1, ""));
    let told = stderr(&done);
    assert!(
        told.starts_with("gpu_batch: ") && told.contains("GEOGRAD_GPU"),
        "{told}"
    );
    for wrong in [
        "--op nothing",
        "--op iou_obb2",
        "--op",
        "0",
        "-1",
        "--list --frobnicate",
        "1 2",
    ] {
        let done = run("gpu_batch", &at, wrong);
        let is_list = wrong.starts_with("--list");
        assert_eq!(status(&done), if is_list { 0 } else { 2 }, "{wrong}");
    }
}

/// One operation of every kind, in all its forms, on both machines.
#[test]
fn gpu_batch_agrees_with_the_cpu() {
    if !has_gpu() {
        return;
    }
    let at = folder("gpu_batch_agrees");
    let done = run("gpu_batch", &at, "--list");
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
        let done = run("gpu_batch", &at, &format!("--op {name} 0.0005"));
        assert_eq!((status(&done), stderr(&done)), (0, ""), "{name}");
        let told = stdout(&done);
        let lines = told.lines().filter(|line| line.starts_with("  "));
        assert_eq!(lines.count(), forms, "{told}");
    }
}
