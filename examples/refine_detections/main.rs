//! Matches detections to ground truth by the overlap of their boxes, seen from above or in space, and moves
//! every matched detection along the gradient of that overlap, or of another score.
//!
//! ```text
//! cargo run --release -p geograd-examples --example refine_detections
//! cargo run --release -p geograd-examples --example refine_detections -- --detections Car.txt Cyclist.txt --labels 0001.txt
//! cargo run --release -p geograd-examples --example refine_detections -- --loss giou --space 3d --nms 0.1 --csv ap.csv
//! cargo run --release -p geograd-examples --features gpu --example refine_detections -- --backend gpu
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
//! | `suppress.rs`, `precision.rs` | suppression before; average precision before and after |
//! | `loss.rs`, `scorer.rs` | the scores that boxes are moved by |
//! | `refine.rs` | gradient descent on one minus a score |
//! | `options.rs`, `table.rs`, `svg/` | the command line, the table, the picture |
mod assign;
mod kitti;
mod loss;
mod matching;
mod model;
mod options;
mod precision;
mod refine;
mod scene;
mod scorer;
mod suppress;
mod svg;
mod table;

use common::cli::{Failure, say};
use common::file::write;
use common::progress::styled;
use geograd::kernels::Backend;
use geograd::{Error, Vec3, YawBox3};
use indicatif::ProgressBar;
use loss::{Goal, Space};
use matching::{Match, Quality};
use model::{Class, Frame, Frames, Seen};
use options::{HELP, Options, options};
use scorer::Scorer;
use std::collections::BTreeMap;
use std::process::ExitCode;
use std::time::Instant;
use table::{Counts, Times};

const PROGRAM: &str = "refine_detections";

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
    let nothing = [
        (report.detections, "detections"),
        (report.truths, "labelled boxes"),
    ];
    if let Some((_, what)) = nothing.iter().find(|(count, _)| *count == 0) {
        return Err(Failure::Work(format!(
            "there is nothing to match: no {what}"
        )));
    }
    Ok((frames, report.bad))
}

/// The matches of every frame.
type Matches = BTreeMap<u32, Vec<Match>>;

fn match_all(backend: Backend<'_>, space: Space, frames: &Frames) -> Result<Matches, Error> {
    let progress = progress("matching", frames.len() as u64);
    let mut matches = Matches::new();
    for (&number, frame) in frames {
        let own = matching::match_frame(backend, space, number, frame)?;
        matches.insert(number, own);
        progress.inc(1);
    }
    progress.finish_and_clear();
    Ok(matches)
}

fn progress(what: &'static str, length: u64) -> ProgressBar {
    styled("{msg:10} {bar:40} {pos}/{len}", length).with_message(what)
}

/// A GPU compiles what it runs at its first call; the clock starts after that.
fn warm_up(backend: Backend<'_>, scorer: &Scorer) -> Result<(), Error> {
    let shape = YawBox3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 1.0), 0.0);
    let seen = Seen {
        class: Class::Car,
        score: 1.0,
        shape,
    };
    let frame = Frame {
        detections: vec![seen],
        truths: vec![seen],
        alike: Vec::new(),
    };
    matching::match_frame(backend, scorer.goal().space, 0, &frame)?;
    scorer.scores(backend, &[shape], &[shape])?;
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
    let scorer = Scorer::new(options.goal)?;
    warm_up(backend, &scorer)?;
    let Goal { loss, space } = options.goal;
    let suppress = |threshold| suppress::suppress(&mut frames, space, threshold);
    let suppressed = options.nms.map(suppress).transpose()?;

    let started = Instant::now();
    let before = match_all(backend, space, &frames)?;
    let matching_time = started.elapsed();

    let mut pairs: Vec<Match> = before.values().flatten().copied().collect();
    let overlapping = pairs.len();
    if loss.reaches() {
        for (&number, matches) in &before {
            pairs.extend(matching::apart(number, &frames[&number], matches));
        }
    }
    let (mut shapes, mut truths) = (Vec::new(), Vec::new());
    for pair in &pairs {
        let frame = &frames[&pair.frame];
        shapes.push(frame.detections[pair.detection].shape);
        truths.push(frame.truths[pair.truth].shape);
    }
    let bar = progress("refining", options.steps + 1);
    let (shapes, cost) = refine::refine(backend, &scorer, &shapes, &truths, options.steps, || {
        bar.inc(1)
    })?;
    bar.finish_and_clear();
    let mut refined = frames.clone();
    for (pair, shape) in pairs.iter().zip(shapes) {
        if let Some(frame) = refined.get_mut(&pair.frame) {
            frame.detections[pair.detection].shape = shape;
        }
    }

    let after = match_all(backend, space, &refined)?;
    let time = started.elapsed();

    let (detections, labelled, scored) = matching::count(&frames);
    let [first, last] = [&before, &after].map(|matches| {
        let all: Vec<Match> = matches.values().flatten().copied().collect();
        Quality::of(&all, detections, labelled)
    });
    let counts = Counts {
        frames: frames.len(),
        detections,
        truths: labelled,
        left_out: (low_scores, other_classes),
        suppressed,
        apart: pairs.len() - overlapping,
        pairs: scored,
    };
    let times = Times {
        matching: matching_time,
        refining: cost,
        all: time,
    };
    say(&table::table(&counts, &first, &last, &times));
    if options.judged {
        let first = precision::by_class(&frames, space)?;
        let last = precision::by_class(&refined, space)?;
        say(&table::precision(options.goal, &first, &last));
        if let Some(csv) = &options.csv {
            write(csv, &table::csv(&first, &last))?;
        }
    }

    let empty = (Frame::default(), Vec::new());
    let number = options.frame.or_else(|| most_improved(&before, &after));
    let at = number.unwrap_or(0);
    let picture = svg::picture(&svg::Scene {
        number: at,
        states: [(&frames, &before), (&refined, &after)].map(|(frames, matches)| svg::State {
            frame: frames.get(&at).unwrap_or(&empty.0),
            matches: matches.get(&at).unwrap_or(&empty.1),
        }),
        goal: options.goal,
    });
    write(&options.svg, &picture)?;
    let name = options.svg.display();
    say(&format!(
        "\nFrame {at} before and after is drawn in {name}.\n"
    ));
    if bad_lines > 0 {
        let were = if bad_lines == 1 { "was" } else { "were" };
        let lines = kitti::bad_lines(bad_lines);
        eprintln!("{PROGRAM}: {lines} {were} left out");
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

fn main() -> ExitCode {
    let done = options().and_then(|options| match options {
        None => {
            say(HELP);
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
