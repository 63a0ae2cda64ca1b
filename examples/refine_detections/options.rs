//! The command line.
use crate::loss::{Goal, Loss, Space};
use common::cli::{Failure, Wish, usage};
use std::path::PathBuf;

pub const HELP: &str = "\
Matches detections to ground truth by rotated overlap, seen from above or in space, and improves
the matched ones by gradient descent on 1 - IoU or another loss. Prints a table and draws one frame
before and after.

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

What boxes are moved by, and what is told:
  --loss LOSS              iou, giou, diou, ciou, gwd (Wasserstein), kld (Kullback-Leibler), kfiou,
                           probiou or separation [default: iou]. All but iou move detections that
                           are near their truth without overlap, too.
  --space bev|3d           overlap from above, or with heights, which are moved then
                           [default: bev]; 3d is drawn from the side, too
  --nms X                  first leave out detections that overlap a better one of their class by
                           more than that, in [0, 1]
  --csv FILE               average precision by class: class,ap_before,ap_after (at 40 recalls;
                           classes without ground truth are left out)
Any of these adds average precision to the table. Detections count as found from an overlap of 0.7
(cars) or 0.5; vans and people who sit are neither right nor wrong to detect.

And:
  --min-score X            leave out detections with a lower score
  --steps N                steps of gradient descent at most [default: 200]
  --svg FILE               where the picture goes [default: refine_detections.svg]
  --frame N                the frame to draw [default: the one that improves most]
  --backend cpu|gpu|auto   the machine to compute on [default: cpu]. A GPU needs a build with
                           `--features gpu`. auto takes a GPU if there is one and says on
                           stderr what it took. The environment variable GEOGRAD_GPU chooses
                           among GPUs: an index, a part of a name, or `cpu` for a driver in
                           software. The CPU leaves out what --nms says and tells the precision.
  --help                   this text

Matching is one to one within a class and a frame, with the largest sum of overlaps (the Hungarian
method); pairs without overlap are no match. Precision and recall count matches with at least that
overlap among all detections and among all truths of the detected classes. Other truths (vans, say)
and DontCare regions are left out. Before and after are matched afresh.

Exit status: 0 when all went well; 1 for lines that could not be used (each is told on stderr, the
rest goes on), files without any detection or any label, files that cannot be read or written, and a GPU that fails (nothing is drawn then);
2 for a wrong command line.
";

pub struct Options {
    pub seed: u64,
    pub frames: u32,
    pub detections: Vec<PathBuf>,
    pub labels: Option<PathBuf>,
    pub min_score: f32,
    pub steps: u64,
    pub svg: PathBuf,
    pub frame: Option<u32>,
    pub wish: Wish,
    pub goal: Goal,
    pub nms: Option<f32>,
    pub csv: Option<PathBuf>,
    /// `true` if average precision is printed.
    pub judged: bool,
}

/// `None` when only help was wanted.
pub fn options() -> Result<Option<Options>, Failure> {
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
        goal: Goal::default(),
        nms: None,
        csv: None,
        judged: false,
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
            Long("loss") => {
                options.goal.loss = Loss::from_name(&parser.value()?.string()?)?;
                options.judged = true;
            }
            Long("space") => {
                options.goal.space = Space::from_name(&parser.value()?.string()?)?;
                options.judged = true;
            }
            Long("nms") => {
                options.nms = Some(parser.value()?.parse()?);
                options.judged = true;
            }
            Long("csv") => {
                options.csv = Some(parser.value()?.into());
                options.judged = true;
            }
            Long("help") | Short('h') => return Ok(None),
            _ => return Err(argument.unexpected().into()),
        }
    }
    if options.min_score.is_nan() {
        return usage("`--min-score` is not a number");
    }
    if options.nms.is_some_and(|x| !(0.0..=1.0).contains(&x)) {
        return usage("`--nms` is an overlap, from 0 to 1");
    }
    if let Some(csv) = &options.csv {
        let inputs = options.detections.iter().chain(&options.labels);
        if *csv == options.svg || inputs.into_iter().any(|input| input == csv) {
            return usage("`--csv` is another file of this run as well");
        }
    }
    match (options.detections.is_empty(), &options.labels) {
        (false, None) => usage("`--detections` needs `--labels`"),
        (true, Some(_)) => usage("`--labels` needs `--detections`"),
        (false, Some(_)) if made => usage("`--seed` and `--frames` make a scene; files are one"),
        _ => Ok(Some(options)),
    }
}
