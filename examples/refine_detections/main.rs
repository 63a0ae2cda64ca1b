//! Matches detections to ground truth by the overlap of their boxes seen from above, and moves every
//! matched detection along the gradient of that overlap.
//!
//! ```text
//! cargo run --release --example refine_detections
//! cargo run --release --example refine_detections -- --detections Car.txt Cyclist.txt --labels 0001.txt
//! cargo run --release --features gpu --example refine_detections -- --backend gpu
//! ```
//!
//! The boxes are moved towards the very ground truth that they are then scored by, so the numbers
//! after say nothing about a detector. They show that the gradient of the overlap leads a box home,
//! from a sliver of overlap too, as it does in the training of a detector.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `model.rs` | frames, detections, truths |
//! | `scene.rs` | a street of its own making |
//! | `kitti.rs` | files of the KITTI tracking benchmark |
//! | `matching.rs`, `assign.rs` | which detection belongs to which truth; precision and recall |
//! | `refine.rs` | gradient descent on `1 − IoU` |
//! | `svg.rs` | the picture |
mod assign;
#[path = "../common/cli.rs"]
mod cli;
mod kitti;
mod matching;
mod model;
mod refine;
mod scene;
mod svg;

use cli::{Failure, Wish};
use geograd::Error;
use geograd::Obb2;
use geograd::kernels::Backend;
use geograd::kernels::ops::overlap::IouObb2;
use indicatif::{ProgressBar, ProgressStyle};
use matching::{Match, Quality};
use model::{Frame, Frames};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Duration, Instant};

const PROGRAM: &str = "refine_detections";

const HELP: &str = "\
Matches detections to ground truth by rotated overlap, seen from above, and improves the matched
ones by gradient descent on 1 - IoU. Prints a table and draws one frame before and after.

Each detection moves towards its own ground truth, so the numbers after are a demonstration of the
gradient and no claim about the detector.

Usage: refine_detections [options]

Without files it makes a street of its own:
  --seed N                 which street [default: 4]
  --frames N               how many frames, a tenth of a second apart [default: 100]

With files of the KITTI tracking benchmark:
  --detections FILE...     detections, one or more files (one per class, say):
                           frame,class,x1,y1,x2,y2,score,h,w,l,x,y,z,rotation_y,alpha
  --labels FILE            ground truth: frame, track, class name, truncated, occluded, alpha,
                           x1 y1 x2 y2, h w l, x y z, rotation_y, separated by spaces

And:
  --min-score X            leave out detections with a lower score
  --steps N                steps of gradient descent at most [default: 200]
  --svg FILE               where the picture goes [default: refine_detections.svg]
  --frame N                the frame to draw [default: the one that improves most]
  --backend cpu|gpu|auto   the machine to compute on [default: cpu]. A GPU needs a build with
                           `--features gpu`. auto takes a GPU if there is one and says on
                           stderr what it took. The environment variable GEOGRAD_GPU chooses
                           among GPUs: an index, a part of a name, or `cpu` for a driver in
                           software.
  --help                   this text

Matching is one to one within a class and a frame, with the largest sum of overlaps (the Hungarian
method); pairs without overlap are no match. Precision and recall count matches with at least that
overlap among all detections and among all truths of the detected classes. Other truths (vans, say)
and DontCare regions are left out. Before and after are matched afresh.

Exit status: 0 when all went well; 1 for lines that could not be used (each is told on stderr, the
rest goes on), files that cannot be read or written, and a GPU that fails (nothing is drawn then);
2 for a wrong command line.
";

struct Options {
    seed: u64,
    frames: u32,
    detections: Vec<PathBuf>,
    labels: Option<PathBuf>,
    min_score: f32,
    steps: u64,
    svg: PathBuf,
    frame: Option<u32>,
    wish: Wish,
}

/// `None` when only help was wanted.
fn options() -> Result<Option<Options>, Failure> {
    use lexopt::prelude::*;
    let mut options = Options {
        seed: 4,
        frames: 100,
        detections: Vec::new(),
        labels: None,
        min_score: f32::NEG_INFINITY,
        steps: 200,
        svg: "refine_detections.svg".into(),
        frame: None,
        wish: Wish::Cpu,
    };
    let mut made = false;
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("seed") => {
                options.seed = parser.value()?.parse()?;
                made = true;
            }
            Long("frames") => {
                options.frames = parser.value()?.parse()?;
                made = true;
            }
            Long("detections") => options
                .detections
                .extend(parser.values()?.map(PathBuf::from)),
            Long("labels") => options.labels = Some(parser.value()?.into()),
            Long("min-score") => options.min_score = parser.value()?.parse()?,
            Long("steps") => options.steps = parser.value()?.parse()?,
            Long("svg") => options.svg = parser.value()?.into(),
            Long("frame") => options.frame = Some(parser.value()?.parse()?),
            Long("backend") => options.wish = Wish::from_name(&parser.value()?.string()?)?,
            Long("help") | Short('h') => return Ok(None),
            _ => return Err(argument.unexpected().into()),
        }
    }
    let usage = |why: &str| Err(Failure::Usage(why.into()));
    if options.min_score.is_nan() {
        return usage("`--min-score` is not a number");
    }
    match (options.detections.is_empty(), &options.labels) {
        (false, None) => usage("`--detections` needs `--labels`"),
        (true, Some(_)) => usage("`--labels` needs `--detections`"),
        (false, Some(_)) if made => usage("`--seed` and `--frames` make a scene; files are one"),
        _ => Ok(Some(options)),
    }
}

/// The frames, and how many lines of the files could not be used.
fn load(options: &Options) -> Result<(Frames, usize), Failure> {
    let Some(labels) = &options.labels else {
        return Ok((scene::drive(options.seed, options.frames), 0));
    };
    let (mut frames, mut report) = (Frames::new(), kitti::Report::default());
    for path in &options.detections {
        kitti::read_detections(path, &mut frames, &mut report).map_err(Failure::Work)?;
    }
    kitti::read_labels(labels, &mut frames, &mut report).map_err(Failure::Work)?;
    Ok((frames, report.bad))
}

/// The matches of every frame.
type Matches = BTreeMap<u32, Vec<Match>>;

fn match_all(
    backend: Backend<'_>,
    frames: &Frames,
    progress: &ProgressBar,
) -> Result<Matches, Error> {
    let mut matches = Matches::new();
    for (&number, frame) in frames {
        matches.insert(number, matching::match_frame(backend, number, frame)?);
        progress.inc(1);
    }
    Ok(matches)
}

/// Shows itself only where stderr is a terminal.
fn progress(what: &'static str, length: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg:10} {bar:40} {pos}/{len}");
    ProgressBar::new(length)
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        .with_message(what)
}

/// A GPU compiles what it runs at its first call; the clock starts after that.
fn warm_up(backend: Backend<'_>) -> Result<(), Error> {
    let shape = [Obb2::new(0.0, 0.0, 1.0, 1.0, 0.0)];
    backend.all_pairs::<IouObb2>(&shape, &shape)?;
    backend.aligned_grad::<IouObb2>(&shape, &shape)?;
    Ok(())
}

/// Exit status 1 for the `true` of lines that could not be used.
fn run(options: &Options) -> Result<bool, Failure> {
    let (mut frames, bad_lines) = load(options)?;
    let (low_scores, other_classes) = model::keep_scored(&mut frames, options.min_score);
    if let Some(wanted) = options.frame.filter(|number| !frames.contains_key(number)) {
        return Err(Failure::Work(format!("there is no frame {wanted}")));
    }

    let machine = options.wish.machine(PROGRAM)?;
    let backend = machine.backend();
    warm_up(backend)?;

    let started = Instant::now();
    let bar = progress("matching", frames.len() as u64);
    let before = match_all(backend, &frames, &bar)?;
    bar.finish_and_clear();
    let matching_time = started.elapsed();

    let pairs: Vec<Match> = before.values().flatten().copied().collect();
    let (mut shapes, mut truths) = (Vec::new(), Vec::new());
    for pair in &pairs {
        let frame = &frames[&pair.frame];
        shapes.push(frame.detections[pair.detection].shape);
        truths.push(frame.truths[pair.truth].shape);
    }
    let bar = progress("refining", options.steps + 1);
    let (shapes, cost) = refine::refine(backend, &shapes, &truths, options.steps, || bar.inc(1))?;
    bar.finish_and_clear();
    let mut refined = frames.clone();
    for (pair, shape) in pairs.iter().zip(shapes) {
        if let Some(frame) = refined.get_mut(&pair.frame) {
            frame.detections[pair.detection].shape = shape;
        }
    }

    let bar = progress("matching", frames.len() as u64);
    let after = match_all(backend, &refined, &bar)?;
    bar.finish_and_clear();
    let time = started.elapsed();

    let (detections, labelled, scored) = matching::count(&frames);
    let quality = |matches: &Matches| {
        let all: Vec<Match> = matches.values().flatten().copied().collect();
        Quality::of(&all, detections, labelled)
    };
    let counts = Counts {
        frames: frames.len(),
        detections,
        truths: labelled,
        left_out: (low_scores, other_classes),
        pairs: scored,
    };
    let times = Times {
        matching: matching_time,
        refining: cost,
        all: time,
    };
    cli::say(&table(&counts, &quality(&before), &quality(&after), &times));

    let empty = (Frame::default(), Vec::new());
    let number = options.frame.or_else(|| most_improved(&before, &after));
    let number = number.or_else(|| frames.keys().next().copied());
    let at = number.unwrap_or(0);
    let picture = svg::picture(&svg::Scene {
        number: at,
        before: frames.get(&at).unwrap_or(&empty.0),
        after: refined.get(&at).unwrap_or(&empty.0),
        matches_before: before.get(&at).unwrap_or(&empty.1),
        matches_after: after.get(&at).unwrap_or(&empty.1),
    });
    let name = options.svg.display();
    std::fs::write(&options.svg, picture)
        .map_err(|error| Failure::Work(format!("{name}: {error}")))?;
    cli::say(&format!(
        "\nFrame {at} before and after is drawn in {name}.\n"
    ));
    if bad_lines > 0 {
        eprintln!("{PROGRAM}: {bad_lines} bad lines were left out");
    }
    Ok(bad_lines > 0)
}

/// The frame whose overlaps grow most in sum.
fn most_improved(before: &Matches, after: &Matches) -> Option<u32> {
    let sum = |matches: &[Match]| matches.iter().map(|m| m.iou).sum::<f32>();
    let gain = |number: &u32| sum(&after[number]) - sum(&before[number]);
    before
        .keys()
        .copied()
        .max_by(|a, b| gain(a).total_cmp(&gain(b)))
}

struct Counts {
    frames: usize,
    detections: usize,
    truths: usize,
    /// Detections with low scores, and truths of other classes.
    left_out: (usize, usize),
    pairs: usize,
}

struct Times {
    matching: Duration,
    refining: refine::Cost,
    all: Duration,
}

fn table(counts: &Counts, before: &Quality, after: &Quality, times: &Times) -> String {
    let Counts {
        detections, truths, ..
    } = counts;
    let mut lines = vec![
        format!("frames             {:>9}", counts.frames),
        format!("boxes              {detections:>9} detections, {truths} ground truth"),
    ];
    if counts.left_out != (0, 0) {
        let (low, other) = counts.left_out;
        lines.push(format!(
            "  left out         {low:>9} by score, {other} of other classes"
        ));
    }
    lines.push(format!("pairs              {:>9}", counts.pairs));
    lines.push("\n                      before     after".into());
    lines.push(format!(
        "matches            {:>9} {:>9}",
        before.matches, after.matches
    ));
    let mut row = |name: &str, before: Option<f64>, after: Option<f64>| {
        let show = |x: Option<f64>| x.map_or("-".to_string(), |x| format!("{x:.4}"));
        lines.push(format!("{name:18} {:>9} {:>9}", show(before), show(after)));
    };
    for (i, threshold) in matching::THRESHOLDS.iter().enumerate() {
        let name = |what: &str| format!("{what} at {threshold}");
        row(&name("precision"), before.precision[i], after.precision[i]);
        row(&name("recall"), before.recall[i], after.recall[i]);
    }
    row("mean IoU", before.mean_iou, after.mean_iou);
    lines.push("\npairs per second".into());
    let mut rate = |name: &str, count: usize, time: Duration, what: &str| {
        // Nothing done is no rate.
        if count > 0 {
            let millions = count as f64 / time.as_secs_f64().max(1e-9) / 1e6;
            lines.push(format!("  {name:16} {millions:>9.2} million, {what}"));
        }
    };
    let cost = times.refining;
    let computed = format!("{} computed", cost.gradients);
    rate(
        "matching",
        counts.pairs,
        times.matching,
        "assignment included",
    );
    rate("with gradients", cost.gradients, cost.time, &computed);
    let time = times.all.as_secs_f64() * 1e3;
    lines.push(format!("time               {time:>9.1} ms\n"));
    lines.join("\n")
}

fn main() -> ExitCode {
    let done = options().and_then(|options| match options {
        None => {
            cli::say(HELP);
            Ok(false)
        }
        Some(options) => run(&options),
    });
    match done {
        Ok(false) => ExitCode::SUCCESS,
        Ok(true) => ExitCode::FAILURE,
        Err(failure) => failure.report(PROGRAM),
    }
}
