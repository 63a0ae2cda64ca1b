//! The examples as their users meet them: files in, text and exit status out.
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

#[path = "../../examples/arm_clearance/arm.rs"]
mod arm;
mod arm_clearance;
#[path = "../../examples/refine_detections/assign.rs"]
mod assign;
#[expect(dead_code, reason = "tests need a part of the program")]
#[path = "../../examples/peg_in_hole/bodies.rs"]
mod bodies;
#[path = "../../examples/grasp/brute_force.rs"]
mod brute_force;
mod calibrate;
#[expect(dead_code, reason = "tests need a part of the program")]
#[path = "../../examples/grasp/closing.rs"]
mod closing;
mod custom_shape;
mod embedded;
mod first;
#[expect(dead_code, reason = "tests need a part of the program")]
#[path = "../../examples/register/fitting.rs"]
mod fitting;
#[cfg(feature = "gpu")]
mod gpu_batch;
mod grasp;
#[path = "../../examples/grasp/gripper.rs"]
mod gripper;
#[expect(dead_code, reason = "tests need a part of the program")]
#[path = "../../examples/peg_in_hole/insertion.rs"]
mod insertion;
mod iou_csv;
mod layout;
#[path = "../../examples/arm_clearance/nearest.rs"]
mod nearest;
mod peg_in_hole;
mod polygon_fit;
mod refine_detections;
mod register;
#[expect(dead_code, reason = "tests need a part of the program")]
#[path = "../../examples/register/scan.rs"]
mod scan;
mod zoning;

/// The program of an example. `cargo test` of the whole workspace builds it before it runs a test; a
/// test builds nothing.
fn example(name: &str) -> PathBuf {
    // target/PROFILE/deps/this-test
    let this = std::env::current_exe().unwrap();
    let profile = this.parent().and_then(Path::parent).unwrap();
    let program = profile
        .join("examples")
        .join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    assert!(
        is_built(&program),
        "{} is missing or old: run `cargo test` in the root, or `cargo build --examples` with the features of this test",
        program.display()
    );
    program
}

/// `true` if a program exists and is newer than all its sources.
fn is_built(program: &Path) -> bool {
    let changed = |path: &Path| std::fs::metadata(path).and_then(|file| file.modified());
    let Ok(built) = changed(program) else {
        return false;
    };
    // cargo leaves a list beside it: the program, a colon, its sources.
    let list = std::fs::read_to_string(program.with_extension("d")).unwrap();
    let (_, sources) = list.split_once(": ").unwrap();
    let sources = sources.trim().replace("\\ ", "\0");
    let mut sources = sources.split(' ').map(|path| path.replace('\0', " "));
    sources.all(|path| changed(path.as_ref()).is_ok_and(|changed| changed <= built))
}

/// A folder of a test's own, empty at the start.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Runs an example in a folder; arguments are parted by spaces.
fn run(name: &str, folder: &Path, arguments: &str) -> Output {
    command(name, folder, arguments).output().unwrap()
}

fn command(name: &str, folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(example(name));
    command
        .args(arguments.split_whitespace())
        .current_dir(folder);
    // Mesa's Vulkan layer that selects devices asks for a folder of the session, and prints a line where there is none.
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        command.env("XDG_RUNTIME_DIR", folder);
    }
    command
}

fn stdout(output: &Output) -> &str {
    std::str::from_utf8(&output.stdout).unwrap()
}

fn stderr(output: &Output) -> &str {
    std::str::from_utf8(&output.stderr).unwrap()
}

fn status(output: &Output) -> i32 {
    output.status.code().unwrap()
}

fn files(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn iou_csv_aligned() {
    let at = folder("iou_csv_aligned");
    // With all that spreadsheets add: a byte order mark, a header, spaces, CRLF, blank last lines.
    let a = "\u{feff}X, y,w,h,r\r\n0,0,2,2,0\r\n 5, 5 ,1,3,0.7\r\n\r\n\r\n";
    std::fs::write(at.join("a.csv"), a).unwrap();
    std::fs::write(at.join("b.csv"), "1,0,2,2,0\n9,9,1e0,3,0.7").unwrap();
    let done = run("iou_csv", &at, "--a a.csv --b b.csv");
    assert_eq!(stderr(&done), "");
    assert_eq!(status(&done), 0);
    assert_eq!(stdout(&done), "iou\n0.3333333333333333\n0\n");
    let done = run("iou_csv", &at, "--a a.csv --b b.csv --precision f32");
    assert_eq!(stdout(&done), "iou\n0.33333334\n0\n");
}

#[test]
fn iou_csv_gradients() {
    let at = folder("iou_csv_gradients");
    std::fs::write(at.join("a.csv"), "0,0,2,2,0\n").unwrap();
    std::fs::write(at.join("b.csv"), "1,0.1,2,3,0.2\n").unwrap();
    let done = run("iou_csv", &at, "--a a.csv --b b.csv --grad --out out.csv");
    assert_eq!((status(&done), stdout(&done)), (0, ""));
    let text = std::fs::read_to_string(at.join("out.csv")).unwrap();
    let (header, row) = text.split_once('\n').unwrap();
    assert_eq!(header, "iou,dax,day,daw,dah,dar,dbx,dby,dbw,dbh,dbr");
    let numbers = row.trim_end().split(',');
    let found: Vec<f64> = numbers.map(|x| x.parse().unwrap()).collect();
    let (a, b) = (
        geograd::Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0),
        geograd::Obb2::new(1.0, 0.1, 2.0, 3.0, 0.2),
    );
    let (iou, (da, db)) = geograd::ad::gradient(|(a, b)| geograd::Obb2::iou(a, b), (a, b));
    let mut expected = vec![iou];
    for x in [da, db] {
        expected.extend([x.center.x, x.center.y, x.size.x, x.size.y, x.heading]);
    }
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
}

#[test]
fn iou_csv_all_pairs() {
    let at = folder("iou_csv_all_pairs");
    let two = "0,0,2,2,0\n10,0,2,2,0\n";
    std::fs::write(at.join("a.csv"), two).unwrap();
    std::fs::write(at.join("b.csv"), format!("{two}1,0,2,2,0\n")).unwrap();
    std::fs::write(at.join("none.csv"), "x,y,w,h,r\n").unwrap();
    let done = run("iou_csv", &at, "--a a.csv --b b.csv --all-pairs");
    let rows = "iou\n1\n0\n0.3333333333333333\n0\n1\n0\n";
    assert_eq!((status(&done), stdout(&done)), (0, rows));
    // The gradient goes through another path; its first column is the same.
    let done = run("iou_csv", &at, "--a a.csv --b b.csv --all-pairs --grad");
    let first: Vec<_> = stdout(&done)
        .lines()
        .map(|line| line.split(',').next().unwrap())
        .collect();
    assert_eq!(first, rows.lines().collect::<Vec<_>>());
    for empty in ["--a none.csv --b b.csv", "--a a.csv --b none.csv"] {
        let done = run("iou_csv", &at, &format!("{empty} --all-pairs"));
        assert_eq!((status(&done), stdout(&done)), (0, "iou\n"));
    }
}

#[test]
fn iou_csv_refuses_bad_rows_and_leaves_the_target_alone() {
    let at = folder("iou_csv_bad");
    std::fs::write(at.join("good.csv"), "0,0,2,2,0\n").unwrap();
    std::fs::write(at.join("out.csv"), "as it was").unwrap();
    for (rows, why) in [
        ("0,0,2,2,0\n1,2,3\n", "row 2 (line 2): 3 fields"),
        ("x,y,w,h,r\n0,0,2,-2,0\n", "row 1 (line 2): h is negative"),
        ("0,NaN,2,2,0\n", "row 1 (line 1): y is not finite"),
        ("0,1e999,2,2,0\n", "row 1 (line 1): y is not finite"),
        ("0,0,two,2,0\n", "row 1 (line 1): w is not a number: `two`"),
        ("0,0,2,2,0\n\n0,0,2,2,0\n", "row 2 (line 2): is empty"),
        ("w,h,x,y,r\n2,2,0,0,0\n", "the order must be x,y,w,h,r"),
        (
            "0,0,2,2,0\n0,0,2,2,0\n",
            "good.csv has 1 rows and bad.csv has 2",
        ),
    ] {
        std::fs::write(at.join("bad.csv"), rows).unwrap();
        let done = run("iou_csv", &at, "--a good.csv --b bad.csv --out out.csv");
        assert_eq!(status(&done), 1, "{rows}");
        assert!(stderr(&done).contains("bad.csv"), "{}", stderr(&done));
        assert!(stderr(&done).contains(why), "{why}: {}", stderr(&done));
        assert_eq!(stdout(&done), "");
        let kept = std::fs::read_to_string(at.join("out.csv")).unwrap();
        assert_eq!(kept, "as it was");
        assert_eq!(files(&at), ["bad.csv", "good.csv", "out.csv"]);
    }
    let done = run("iou_csv", &at, "--a good.csv --b nowhere.csv");
    assert_eq!(status(&done), 1);
    assert!(stderr(&done).contains("nowhere.csv"));
}

#[test]
fn iou_csv_keeps_its_inputs() {
    let at = folder("iou_csv_keeps_its_inputs");
    std::fs::write(at.join("a.csv"), "0,0,2,2,0\n").unwrap();
    std::fs::write(at.join("bad.csv"), "0,0,-2,2,0\n").unwrap();
    for out in ["a.csv", "./a.csv"] {
        let done = run(
            "iou_csv",
            &at,
            &format!("--a bad.csv --b a.csv --out {out}"),
        );
        assert_eq!(status(&done), 2);
        assert!(stderr(&done).contains("`--out` is an input as well"));
    }
    let kept = std::fs::read_to_string(at.join("a.csv")).unwrap();
    assert_eq!(kept, "0,0,2,2,0\n");
    // One file as both inputs has its error printed once.
    let done = run("iou_csv", &at, "--a bad.csv --b ./bad.csv");
    assert_eq!(status(&done), 1);
    assert_eq!(stderr(&done).matches("w is negative").count(), 1);
}

#[test]
fn wrong_command_lines() {
    let at = folder("wrong_command_lines");
    for (name, arguments) in [
        ("iou_csv", ""),
        ("iou_csv", "--a a.csv"),
        ("iou_csv", "--a a.csv --b b.csv --frobnicate"),
        ("iou_csv", "--a a.csv --b b.csv --precision f16"),
        ("iou_csv", "--a a.csv --b b.csv --backend abacus"),
        ("iou_csv", "--a a.csv --b b.csv --backend gpu"),
        (
            "iou_csv",
            "--a a.csv --b b.csv --precision f64 --backend gpu",
        ),
        ("iou_csv", "--a a.csv --b b.csv --metric overlap"),
        ("iou_csv", "--a a.csv --b b.csv --metric"),
        ("iou_csv", "--a a.csv --b b.csv --format boxes"),
        (
            "iou_csv",
            "--a a.csv --b b.csv --format polygons --metric ciou",
        ),
        (
            "iou_csv",
            "--a a.csv --b b.csv --format polygons --metric eiou",
        ),
        ("iou_csv", "--a a.csv --b b.csv --enclosing aabb"),
        (
            "iou_csv",
            "--a a.csv --b b.csv --metric diou-box --enclosing aabb",
        ),
        (
            "iou_csv",
            "--a a.csv --b b.csv --metric diou --enclosing rect",
        ),
        (
            "iou_csv",
            "--a a.csv --b b.csv --metric giou --enclosing tent",
        ),
        (
            "iou_csv",
            "--a a.csv --b b.csv --metric giou --enclosing hull --format obb3",
        ),
        (
            "iou_csv",
            "--a a.csv --b b.csv --metric giou --enclosing rect --format polygons",
        ),
        (
            "iou_csv",
            "--a a.csv --b b.csv --precision f32 --backend gpu --metric giou",
        ),
        (
            "iou_csv",
            "--a a.csv --b b.csv --precision f32 --backend gpu --format yaw3",
        ),
        ("refine_detections", "--loss overlap"),
        ("refine_detections", "--space 4d"),
        ("refine_detections", "--nms 1.5"),
        ("refine_detections", "--nms nan"),
        ("refine_detections", "--csv a --svg a"),
        ("refine_detections", "--backend abacus"),
        ("refine_detections", "--frobnicate"),
        ("refine_detections", "--frames many"),
        ("refine_detections", "--min-score nan"),
        ("refine_detections", "--detections a.txt"),
        ("refine_detections", "--labels a.txt"),
        ("custom_shape", "--frobnicate"),
        ("custom_shape", "--count"),
        ("custom_shape", "--count many"),
        ("custom_shape", "--svg"),
        ("custom_shape", "--check --wgsl"),
        ("custom_shape", "--backend abacus"),
        ("layout", "--backend abacus"),
        ("layout", "--backend"),
        ("arm_clearance", "--frobnicate"),
        ("arm_clearance", "--points 2"),
        ("arm_clearance", "--count many"),
        ("arm_clearance", "--svg"),
        ("polygon_fit", "--frobnicate"),
        ("polygon_fit", "--seed many"),
        ("polygon_fit", "--shape square"),
        ("polygon_fit", "--loss none"),
        ("polygon_fit", "--svg same --csv same"),
    ] {
        let done = run(name, &at, arguments);
        assert_eq!(status(&done), 2, "{name} {arguments}");
        assert!(stderr(&done).starts_with(name), "{}", stderr(&done));
    }
    for name in [
        "iou_csv",
        "refine_detections",
        "custom_shape",
        "calibrate",
        "polygon_fit",
        "layout",
        "arm_clearance",
        "grasp",
        "register",
        "zoning",
        "peg_in_hole",
    ] {
        let done = run(name, &at, "--help");
        assert_eq!(status(&done), 0);
        assert!(stdout(&done).contains("Usage"));
    }
    assert_eq!(files(&at), [""; 0]);
}

/// The numbers of a row of the table.
fn row(output: &Output, name: &str) -> Vec<f64> {
    let row = stdout(output).lines().find(|line| line.starts_with(name));
    let row = row.unwrap_or_else(|| panic!("no row {name}: {}", stdout(output)));
    let words = row[name.len()..].split_whitespace();
    words.filter_map(|x| x.parse().ok()).collect()
}

#[test]
fn refine_detections_on_its_own_scene() {
    let at = folder("refine_scene");
    let done = run("refine_detections", &at, "--frames 2 --seed 7");
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    assert_eq!(row(&done, "frames"), [2.0]);
    let mean = row(&done, "mean IoU");
    assert!(mean[0] < 0.9 && mean[1] > 0.99, "{mean:?}");
    for name in ["precision at 0.7", "recall at 0.7"] {
        let numbers = row(&done, name);
        assert!(numbers[1] >= numbers[0], "{name} {numbers:?}");
    }
    let picture = std::fs::read_to_string(at.join("refine_detections.svg")).unwrap();
    assert!(picture.starts_with("<svg") && picture.ends_with("</svg>\n"));
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
    // The same seed gives the same picture.
    run(
        "refine_detections",
        &at,
        "--frames 2 --seed 7 --svg again.svg",
    );
    let again = std::fs::read_to_string(at.join("again.svg")).unwrap();
    assert!(picture == again);
}

/// Cars seen well, and a pedestrian seen with a sliver of overlap.
const DETECTIONS: &str = "\
0,2,0,0,1,1,9.5,1.5,1.7,4.2,2.0,1.6,12.0,-1.57,0
0,1,0,0,1,1,3.5,1.7,0.6,0.8,-4.7,1.6,9.0,0.0,0
1,2,0,0,1,1,9.5,1.5,1.7,4.2,2.0,1.6,13.0,-1.57,0
";
/// Beside them what is not scored: a region to be passed over, and a van.
const LABELS: &str = "\
0 -1 DontCare -1 -1 -10 0 0 1 1 -1000 -1000 -1000 -10 -1 -1 -1
0 0 Car 0 0 0 0 0 1 1 1.5 1.8 4.4 2.1 1.6 12.2 -1.5
0 1 Pedestrian 0 0 0 0 0 1 1 1.7 0.6 0.8 -4.0 1.6 9.0 0.0
0 2 Van 0 0 0 0 0 1 1 1.7 2.0 5.0 9.0 1.6 20.0 0.0
1 0 Car 0 0 0 0 0 1 1 1.5 1.8 4.4 2.1 1.6 13.2 -1.5
";

#[test]
fn refine_detections_on_files() {
    let at = folder("refine_files");
    std::fs::write(at.join("seen.txt"), DETECTIONS).unwrap();
    std::fs::write(at.join("true.txt"), LABELS).unwrap();
    let done = run(
        "refine_detections",
        &at,
        "--detections seen.txt --labels true.txt --svg out.svg --frame 0",
    );
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    assert_eq!(row(&done, "frames"), [2.0]);
    assert_eq!(row(&done, "boxes"), [3.0, 3.0]);
    assert_eq!(row(&done, "pairs"), [5.0]);
    assert_eq!(row(&done, "matches"), [3.0, 3.0]);
    assert_eq!(row(&done, "recall at 0.7"), [0.6667, 1.0]);
    assert!(row(&done, "mean IoU")[1] > 0.999);
    assert!(at.join("out.svg").exists());
}

/// A box shifted along its heading by half its length shares a third with the union; with the turn
/// the other way round it would share less.
#[test]
fn refine_detections_turns_the_way_cameras_do() {
    let at = folder("refine_heading");
    let (turn, length) = (0.7_f32, 4.0);
    // A positive turn moves +z towards +x, so it moves +x towards -z.
    let (x, z) = (
        3.0 + 0.5 * length * turn.cos(),
        15.0 - 0.5 * length * turn.sin(),
    );
    let seen = format!("0,2,0,0,1,1,9,1.5,1.0,{length},{x},1.6,{z},{turn},0\n");
    let truth = format!("0 0 Car 0 0 0 0 0 1 1 1.5 1.0 {length} 3 1.6 15 {turn}\n");
    std::fs::write(at.join("seen.txt"), seen).unwrap();
    std::fs::write(at.join("true.txt"), truth).unwrap();
    let done = run(
        "refine_detections",
        &at,
        "--detections seen.txt --labels true.txt",
    );
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    assert_eq!(row(&done, "mean IoU")[0], 0.3333);
    assert!(row(&done, "mean IoU")[1] > 0.999);
}

#[test]
fn refine_detections_tells_bad_lines_and_goes_on() {
    let at = folder("refine_bad_lines");
    let bad = "0,2,0,0,1,1,9.5,1.5,1.7,4.2,2.0,1.6,12.0\n\
        0,2,0,0,1,1,9.5,1.5,1.7,-4.2,2.0,1.6,12.0,-1.57,0\n\
        0,9,0,0,1,1,9.5,1.5,1.7,4.2,2.0,1.6,12.0,-1.57,0\n\
        zero,2,0,0,1,1,9.5,1.5,1.7,4.2,2.0,1.6,12.0,-1.57,0\n\
        0,2,0,0,1,1,9.5,1.5,1.7,4.2,inf,1.6,12.0,-1.57,0\n\
        0,2,0,0,1,1,9.5,1.5,1.7,4.2,2.0,1.6,12.0,-1.57,none\n\n";
    std::fs::write(at.join("seen.txt"), format!("{bad}{DETECTIONS}")).unwrap();
    let bad = "0 3 Car 0 0 0 0 0 1 1 1.5 wide 4.4 2.1 1.6 12.2 -1.5\n\
        0 3 Car 0 0 0 left 0 1 1 1.5 1.7 4.4 2.1 1.6 12.2 -1.5\n";
    std::fs::write(at.join("true.txt"), format!("{LABELS}{bad}")).unwrap();
    let done = run(
        "refine_detections",
        &at,
        "--detections seen.txt --labels true.txt",
    );
    assert_eq!(status(&done), 1);
    for told in [
        "seen.txt:1: 13 fields where 15 are needed",
        "seen.txt:2: l is negative: `-4.2`",
        "seen.txt:3: class is 1 (pedestrian), 2 (car) or 3 (cyclist): `9`",
        "seen.txt:4: frame is not a whole number: `zero`",
        "seen.txt:5: x is not finite: `inf`",
        "true.txt:6: w is not a number: `wide`",
        "true.txt:7: x1 is not a number: `left`",
        "seen.txt:6: alpha is not a number: `none`",
        "8 bad lines were left out",
    ] {
        assert!(stderr(&done).contains(told), "{told}: {}", stderr(&done));
    }
    // The rest went on.
    assert_eq!(row(&done, "matches"), [3.0, 3.0]);
    assert!(at.join("refine_detections.svg").exists());
    std::fs::write(at.join("true.txt"), LABELS).unwrap();
    std::fs::write(at.join("seen.txt"), format!("{DETECTIONS}?\n")).unwrap();
    let done = run(
        "refine_detections",
        &at,
        "--detections seen.txt --labels true.txt",
    );
    assert!(stderr(&done).contains("1 bad line was left out"));
}

#[test]
fn refine_detections_without_anything() {
    let at = folder("refine_nothing");
    std::fs::write(at.join("none.txt"), "").unwrap();
    let done = run("refine_detections", &at, "--frames 0");
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    assert_eq!(row(&done, "boxes"), [0.0, 0.0]);
    // Files without anything are told, and without detections or labels there is nothing to do.
    std::fs::write(at.join("seen.txt"), DETECTIONS).unwrap();
    std::fs::write(at.join("true.txt"), LABELS).unwrap();
    for (detections, labels, told, code) in [
        ("none.txt", "true.txt", "none.txt: no detections in it", 1),
        (
            "seen.txt",
            "none.txt",
            "none.txt: no labelled boxes in it",
            1,
        ),
        (
            "none.txt seen.txt",
            "true.txt",
            "none.txt: no detections in it",
            0,
        ),
    ] {
        let files = format!("--detections {detections} --labels {labels}");
        let done = run("refine_detections", &at, &files);
        assert_eq!(status(&done), code, "{files}: {}", stderr(&done));
        assert!(stderr(&done).contains(told), "{files}: {}", stderr(&done));
        let nothing = stderr(&done).contains("there is nothing to match");
        assert_eq!(nothing, code == 1, "{files}: {}", stderr(&done));
    }
}

/// The environment variable asks for a GPU that no machine has: the same on every machine.
fn without_gpu(name: &str, folder: &Path, arguments: &str) -> Output {
    command(name, folder, arguments)
        .env("GEOGRAD_GPU", "no such GPU")
        .output()
        .unwrap()
}

const NEITHER: [(&str, &str); 3] = [
    (
        "iou_csv",
        "--a a.csv --b a.csv --out out --precision f32 --backend",
    ),
    ("refine_detections", "--frames 2 --svg out --backend"),
    ("layout", "--iterations 3 --svg out --backend"),
];

#[test]
fn backend_gpu_without_a_gpu() {
    let at = folder("backend_gpu_without_a_gpu");
    std::fs::write(at.join("a.csv"), "0,0,2,2,0\n").unwrap();
    std::fs::write(at.join("out"), "as it was").unwrap();
    let (expected, why) = match cfg!(feature = "gpu") {
        // The message ends here on a machine without a driver.
        true => (1, "no GPU found"),
        false => (2, "`cargo run --features gpu`"),
    };
    for (name, arguments) in NEITHER {
        let done = without_gpu(name, &at, &format!("{arguments} gpu"));
        assert_eq!((status(&done), stdout(&done)), (expected, ""), "{name}");
        let told = stderr(&done);
        assert!(told.contains(name) && told.contains(why), "{told}");
        let kept = std::fs::read_to_string(at.join("out")).unwrap();
        assert_eq!(kept, "as it was");
        assert_eq!(files(&at), ["a.csv", "out"]);
    }
}

#[test]
fn backend_auto_without_a_gpu_is_the_cpu_and_says_so() {
    let at = folder("backend_auto_without_a_gpu");
    std::fs::write(at.join("a.csv"), "0,0,2,2,0\n").unwrap();
    for (name, arguments) in NEITHER {
        let on_cpu = run(name, &at, &format!("{arguments} cpu"));
        assert_eq!((status(&on_cpu), stderr(&on_cpu)), (0, ""));
        let expected = std::fs::read_to_string(at.join("out")).unwrap();
        let done = without_gpu(name, &at, &format!("{arguments} auto"));
        let told = stderr(&done);
        assert_eq!(status(&done), 0, "{told}");
        assert!(told.contains("computing on the CPU: "), "{told}");
        assert!(std::fs::read_to_string(at.join("out")).unwrap() == expected);
    }
    // Whatever there is, f64 is for the CPU.
    let done = run("iou_csv", &at, "--a a.csv --b a.csv --backend auto");
    assert_eq!((status(&done), stdout(&done)), (0, "iou\n1\n"));
    let told = stderr(&done);
    assert!(
        told.contains("computing on the CPU: GPUs have no f64"),
        "{told}"
    );
}

/// The stderr of `--backend auto` in an environment that offers only this driver.
#[cfg(target_os = "linux")]
fn told_by_auto(folder: &Path, driver: &str, wanted: Option<&str>) -> String {
    let mut run = command(
        "iou_csv",
        folder,
        "--a a.csv --b a.csv --precision f32 --backend auto",
    );
    run.env("WGPU_BACKEND", "vulkan")
        .env("VK_DRIVER_FILES", driver)
        .env("VK_ICD_FILENAMES", driver)
        .env_remove("GEOGRAD_GPU");
    if let Some(wanted) = wanted {
        run.env("GEOGRAD_GPU", wanted);
    }
    let done = run.output().unwrap();
    assert_eq!((status(&done), stdout(&done)), (0, "iou\n1\n"));
    stderr(&done).to_owned()
}

#[cfg(target_os = "linux")]
#[test]
fn backend_auto_says_which_of_the_reasons_it_was() {
    let at = folder("backend_auto_reasons");
    std::fs::write(at.join("a.csv"), "0,0,2,2,0\n").unwrap();
    let nothing = "/no/such/driver.json";
    let told = told_by_auto(&at, nothing, None);
    if cfg!(not(feature = "gpu")) {
        assert!(told.contains("`cargo run --features gpu`"), "{told}");
        return;
    }
    assert!(told.contains("no GPU found: install its driver"), "{told}");
    // Software alone is no GPU unless it is asked for.
    let Some(software) = software_driver() else {
        eprintln!("SKIPPED: no driver in software");
        return;
    };
    let told = told_by_auto(&at, &software, None);
    assert!(
        told.contains("the CPU: no GPU found but a driver in software"),
        "{told}"
    );
    let told = told_by_auto(&at, &software, Some("cpu"));
    assert!(told.contains("computing on ["), "{told}");
    let told = told_by_auto(&at, &software, Some("no such GPU"));
    assert!(
        told.contains("no GPU found that is GEOGRAD_GPU=no such GPU"),
        "{told}"
    );
}

/// The path of the manifest of Mesa's software driver.
#[cfg(target_os = "linux")]
fn software_driver() -> Option<String> {
    let folder = std::fs::read_dir("/usr/share/vulkan/icd.d").ok()?;
    let mut files = folder.filter_map(|file| file.ok()?.path().to_str().map(str::to_owned));
    files.find(|file| file.contains("lvp_icd"))
}

/// `true` if there is a GPU to test on, a driver in software included. Without one the tests print that
/// and pass, unless `GEOGRAD_REQUIRE_GPU=1`.
#[cfg(feature = "gpu")]
fn has_gpu() -> bool {
    match geograd::kernels::gpu::Gpu::new() {
        Ok(_) => true,
        Err(error) => {
            let required = std::env::var("GEOGRAD_REQUIRE_GPU").is_ok_and(|x| x == "1");
            assert!(!required, "a GPU is required: {error}");
            eprintln!("SKIPPED, NOTHING WAS TESTED: {error}");
            false
        }
    }
}

/// A table of that many boxes on a square, of which many overlap.
#[cfg(feature = "gpu")]
fn boxes(count: usize, seed: u64) -> String {
    let mut state = seed;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1_u64 << 24) as f32
    };
    let rows = (0..count).map(|_| {
        let (x, y) = (8.0 * next(), 8.0 * next());
        let (w, h) = (1.0 + 3.0 * next(), 1.0 + 3.0 * next());
        format!("{x},{y},{w},{h},{}\n", 7.0 * next() - 3.5)
    });
    rows.collect()
}

#[cfg(feature = "gpu")]
#[test]
fn iou_csv_on_the_gpu_is_iou_csv_on_the_cpu() {
    if !has_gpu() {
        return;
    }
    let at = folder("iou_csv_gpu");
    std::fs::write(at.join("a.csv"), boxes(600, 1)).unwrap();
    std::fs::write(at.join("b.csv"), boxes(600, 2)).unwrap();
    std::fs::write(at.join("none.csv"), "x,y,w,h,r\n").unwrap();
    let numbers = |name: &str| -> Vec<f32> {
        let text = std::fs::read_to_string(at.join(name)).unwrap();
        let rows = text.lines().skip(1).flat_map(|row| row.split(','));
        rows.map(|x| x.parse().unwrap()).collect()
    };
    for (arguments, count, fields) in [
        ("--a a.csv --b b.csv", 600, 1),
        ("--a a.csv --b b.csv --grad", 600, 11),
        // More than one block.
        ("--a a.csv --b b.csv --all-pairs", 360_000, 1),
        ("--a a.csv --b b.csv --all-pairs --grad", 360_000, 11),
        ("--a none.csv --b b.csv --all-pairs --grad", 0, 11),
        ("--a a.csv --b none.csv --all-pairs --grad", 0, 11),
        ("--a none.csv --b none.csv", 0, 1),
    ] {
        for backend in ["cpu", "gpu"] {
            let rest = format!("--precision f32 --backend {backend} --out {backend}");
            let done = run("iou_csv", &at, &format!("{arguments} {rest}"));
            assert_eq!((status(&done), stdout(&done)), (0, ""), "{}", stderr(&done));
            let told = stderr(&done).contains("iou_csv: computing on ");
            assert_eq!(told, backend == "gpu", "{}", stderr(&done));
        }
        let (on_cpu, on_gpu) = (numbers("cpu"), numbers("gpu"));
        assert_eq!(
            (on_cpu.len(), on_gpu.len()),
            (count * fields, count * fields)
        );
        let overlapping = on_cpu.iter().step_by(fields).filter(|&&iou| iou > 0.0);
        assert!(overlapping.count() >= count / 10, "{arguments}");
        for (i, (x, y)) in on_cpu.iter().zip(&on_gpu).enumerate() {
            // An overlap is at most one, a derivative may be more.
            let near = 1e-5 * x.abs().max(1.0);
            let place = (i / fields, i % fields);
            assert!((x - y).abs() <= near, "{arguments}: {x} {y} at {place:?}");
        }
    }
}

#[cfg(feature = "gpu")]
#[test]
fn refine_detections_on_the_gpu() {
    if !has_gpu() {
        return;
    }
    let at = folder("refine_gpu");
    // Kinds of scores: an operation; a program of an overlap that is known; programs alone.
    for goal in [
        "--loss iou --space bev",
        "--loss giou --space bev",
        "--loss iou --space 3d",
        "--loss ciou --space 3d",
        "--loss kfiou --space 3d",
    ] {
        let scene = format!("--frames 2 --seed 7 {goal}");
        let on_cpu = run("refine_detections", &at, &scene);
        let on_gpu = run("refine_detections", &at, &format!("{scene} --backend gpu"));
        assert_eq!((status(&on_cpu), status(&on_gpu)), (0, 0), "{goal}");
        let told = stderr(&on_gpu);
        assert!(told.contains("refine_detections: computing on "), "{told}");
        for name in ["frames", "boxes", "pairs", "matches", "recall at 0.7"] {
            assert_eq!(row(&on_cpu, name), row(&on_gpu, name), "{goal}: {name}");
        }
        let (cpu, gpu) = (row(&on_cpu, "mean IoU"), row(&on_gpu, "mean IoU"));
        // Both as they are printed. Refined on the GPU, every step differs in its last bits.
        assert!((cpu[0] - gpu[0]).abs() < 1.5e-4, "{goal}: {cpu:?} {gpu:?}");
        assert!((cpu[1] - gpu[1]).abs() < 5e-3, "{goal}: {cpu:?} {gpu:?}");
    }
}

#[cfg(feature = "gpu")]
#[test]
fn custom_shape_on_the_gpu() {
    if !has_gpu() {
        return;
    }
    let at = folder("custom_shape_gpu");
    let told = ["cpu", "gpu"].map(|backend| {
        let done = run(
            "custom_shape",
            &at,
            &format!("--count 40000 --backend {backend}"),
        );
        assert_eq!(status(&done), 0, "{}", stderr(&done));
        let is_told = stderr(&done).contains("custom_shape: computing on ");
        assert_eq!(is_told, backend == "gpu");
        // The share that collides and the steepest derivative, as they are printed.
        stdout(&done).lines().nth(1).unwrap().to_owned()
    });
    assert_eq!(told[0], told[1]);
}

/// Against trying everything.
#[test]
fn assignment_has_the_largest_sum() {
    fn best(gains: &[f32], columns: usize, taken: u32) -> f32 {
        if gains.is_empty() {
            return 0.0;
        }
        let rest = &gains[columns..];
        let skip = best(rest, columns, taken);
        let free = (0..columns).filter(|c| (taken >> c) & 1 == 0);
        free.map(|c| gains[c] + best(rest, columns, taken | (1 << c)))
            .fold(skip, f32::max)
    }
    let mut state = 1_u32;
    for (rows, columns) in [(1, 1), (1, 4), (4, 1), (3, 3), (5, 3), (3, 5), (5, 5)] {
        for _ in 0..50 {
            // Sixteenths, half of them zero, so that sums are exact and ties are common.
            let gains: Vec<f32> = (0..rows * columns)
                .map(|_| {
                    state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    (state >> 27).saturating_sub(16) as f32 / 16.0
                })
                .collect();
            let pairs = assign::assign(&gains, rows, columns);
            let sum: f32 = pairs.iter().map(|&(r, c)| gains[r * columns + c]).sum();
            assert_eq!(sum, best(&gains, columns, 0), "{gains:?}");
            assert_eq!(pairs.len(), rows.min(columns));
            for (i, x) in pairs.iter().enumerate() {
                assert!(pairs[..i].iter().all(|y| x.0 != y.0 && x.1 != y.1));
            }
        }
    }
    assert_eq!(assign::assign(&[], 0, 3), []);
    assert_eq!(assign::assign(&[], 3, 0), []);
}

#[test]
fn the_environment_chooses_vector_instructions() {
    let at = folder("the_environment_chooses_vector_instructions");
    std::fs::write(at.join("a.csv"), "0,0,2,2,0\n1,1,3,2,0.3\n").unwrap();
    std::fs::write(at.join("b.csv"), "1,0.1,2,3,0.2\n5,5,1,1,2\n").unwrap();
    let run = |word: &str| {
        let arguments = "--a a.csv --b b.csv --all-pairs --grad --precision f32";
        let mut command = command("iou_csv", &at, arguments);
        command.env("GEOGRAD_SIMD", word).output().unwrap()
    };
    let known = run("baseline");
    assert_eq!(status(&known), 0);
    for level in geograd::kernels::cpu::simd::Simd::available() {
        let done = run(level.name());
        assert_eq!((status(&done), stdout(&done)), (0, stdout(&known)));
    }
    let refused = run("sse9");
    assert_eq!((status(&refused), stdout(&refused)), (1, ""));
    assert!(stderr(&refused).contains("GEOGRAD_SIMD is one of baseline, avx2, v4"));
}
