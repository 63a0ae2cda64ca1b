//! The command line.
use crate::metric::{Enclosing, Format, Metric};
use common::cli::{Failure, Wish, is_double, usage};
use common::file;
use std::path::PathBuf;

pub const PROGRAM: &str = "iou_csv";

pub const HELP: &str = "\
Overlap (intersection over union) of rotated boxes, and its derivatives. Also other scores, and
polygons and boxes of space.

Usage: iou_csv --a A.csv --b B.csv [options]

  --a FILE, --b FILE       the boxes: one `x,y,w,h,r` per row; centre, size, and heading in
                           radians, counter-clockwise. A header row is optional.
  --format FORMAT          what a row is instead [default: obb2, as above]
      polygons             `x1,y1,x2,y2,...`: a simple polygon of either orientation, convex or
                           not, of any number of vertices
      yaw3                 `x,y,z,dx,dy,dz,heading`: an upright box; centre, size along its own
                           axes, and heading in radians about the axis z, which points up
      obb3                 `x,y,z,dx,dy,dz,qw,qx,qy,qz`: a box of any orientation, with its
                           rotation as a quaternion of any length but zero
  --metric METRIC          what is computed [default: iou]
      iou                  intersection over union
      iof                  intersection over the first one's area or volume
      giou                 IoU less the share of a shape around both that neither covers
      diou                 IoU less the square of the distance of the centres over the diameter
                           of that shape
      diou-box             diou with `--enclosing aabb`
      ciou                 diou less a weighted difference of the proportions; boxes only
      eiou                 diou less the squares of the differences of the sizes over lengths of
                           that shape; boxes only
  --enclosing SHAPE        the shape around both, for giou, diou, ciou and eiou [default: hull; of
                           obb3 rect]
      aabb                 the axis-aligned box
      rect                 a box that turns with the pair: of least ground (obb2, for giou only;
                           yaw3), or the smaller one of those along the axes of either (obb3);
                           not of polygons
      hull                 the convex hull; of yaw3 that of the grounds times the height of both;
                           not of obb3
  --all-pairs              every row of A with every row of B, in row-major order:
                           all of B for the first row of A, then for the second, and so on.
                           Without it row i of A goes with row i of B.
  --grad                   also the partial derivatives of every result
  --precision f32|f64      the format to compute in [default: f64]
  --backend cpu|gpu|auto   the machine to compute on [default: cpu]. A GPU needs a build with
                           `--features gpu`, --precision f32, the only format of GPUs, and iou or
                           iof of obb2, the only scores they compute.
                           auto takes a GPU where it can and says on stderr what it took.
                           The environment variable GEOGRAD_GPU chooses among GPUs: an index,
                           a part of a name, or `cpu` for a driver in software.
  --out FILE               where the result goes, no input [default: standard output]
  --help                   this text

The result has a header and a column that bears the metric's name, with --grad followed by
  obb2      dax,day,daw,dah,dar and the same with db
  polygons  da1x,da1y,da2x,da2y,... up to the longest polygon of A, then db1x,db1y,... up to the
            longest one of B; empty beyond a row's own
  yaw3      dax,day,daz,dadx,dady,dadz,dar and the same with db
  obb3      dax,day,daz,dadx,dady,dadz,darx,dary,darz and the same with db: the last three are of
            turning about the box's own axes, in radians
Numbers are the shortest that read back as the same.

Exit status: 0 when all went well; 1 for bad rows (all input is checked first, and then nothing
is written), a file that cannot be read or written, or a GPU that fails; 2 for a wrong command
line. On failure --out is as it was; standard output may have the first rows, whole ones.
";

#[derive(Debug)]
pub struct Options {
    pub a: PathBuf,
    pub b: PathBuf,
    pub format: Format,
    pub metric: Metric,
    pub all_pairs: bool,
    pub grad: bool,
    pub double: bool,
    pub wish: Wish,
    pub out: Option<PathBuf>,
}

/// `None` when only help was wanted.
pub fn options() -> Result<Option<Options>, Failure> {
    use lexopt::prelude::*;
    let (mut a, mut b, mut out) = (None::<PathBuf>, None::<PathBuf>, None::<PathBuf>);
    let (mut format, mut metric, mut enclosing) = (Format::Obb2, Metric::Iou, None);
    let (mut all_pairs, mut grad, mut double, mut wish) = (false, false, true, Wish::Cpu);
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("a") => a = Some(parser.value()?.into()),
            Long("b") => b = Some(parser.value()?.into()),
            Long("format") => format = Format::from_name(&parser.value()?.string()?)?,
            Long("metric") => metric = Metric::from_name(&parser.value()?.string()?)?,
            Long("enclosing") => {
                enclosing = Some(Enclosing::from_name(&parser.value()?.string()?)?);
            }
            Long("all-pairs") => all_pairs = true,
            Long("grad") => grad = true,
            Long("precision") => double = is_double(&parser.value()?.string()?)?,
            Long("backend") => wish = Wish::from_name(&parser.value()?.string()?)?,
            Long("out") => out = Some(parser.value()?.into()),
            Long("help") | Short('h') => return Ok(None),
            _ => return Err(argument.unexpected().into()),
        }
    }
    let missing = |name| Failure::Usage(format!("`{name}` is missing"));
    if let Some(out) = &out
        && [&a, &b]
            .into_iter()
            .flatten()
            .any(|input| file::same(input, out))
    {
        return usage("`--out` is an input as well");
    }
    if metric.compares_sizes() && format == Format::Polygons {
        return usage(format!(
            "`--metric {}` compares widths and heights, which polygons do not have",
            metric.name()
        ));
    }
    match (metric.enclosing(), enclosing) {
        (Some(around), chosen) => *around = chosen.unwrap_or(format.enclosing()),
        (None, Some(_)) => {
            return usage("`--enclosing` is for `--metric giou`, `diou`, `ciou` and `eiou`");
        }
        (None, None) => {}
    }
    match (format, metric, enclosing) {
        (Format::Polygons, _, Some(Enclosing::Rect)) => {
            return usage("`--enclosing rect` is for boxes");
        }
        (Format::Obb2, metric, Some(Enclosing::Rect)) if metric.name() != "giou" => {
            return usage("`--enclosing rect` of obb2 is for `--metric giou`");
        }
        (Format::Obb3, _, Some(Enclosing::Hull)) => {
            return usage("`--enclosing hull` is for the plane and for upright boxes");
        }
        _ => {}
    }
    if double && wish == Wish::Gpu {
        return usage(
            "`--backend gpu` computes in f32 only; the default is f64, so say `--precision f32`",
        );
    }
    if wish == Wish::Gpu && !(format == Format::Obb2 && metric.is_on_gpus()) {
        return usage("`--backend gpu` computes iou and iof of obb2 only");
    }
    Ok(Some(Options {
        a: a.ok_or_else(|| missing("--a"))?,
        b: b.ok_or_else(|| missing("--b"))?,
        format,
        metric,
        all_pairs,
        grad,
        double,
        wish,
        out,
    }))
}
