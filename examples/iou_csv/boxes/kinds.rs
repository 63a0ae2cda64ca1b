//! Boxes of the plane and of space: every score but one is a row of the library.
use super::{Boxes, Rest};
use crate::metric::{Enclosing, Metric};
use common::compute::Number;
use geograd::iou3::smallest_rectangle;
use geograd::kernels::dynamic::{Operation, straight};
use geograd::kernels::{self, RowOf};
use geograd::{Error, Obb2, Obb3, Program, Scalar, Sym, YawBox3};

/// The row of a metric for two boxes of a kind, given the rows of GIoU, DIoU, CIoU and EIoU with a box that turns with
/// the pair.
macro_rules! row {
    ($metric:expr, $shape:ident, $giou:ident $diou:ident $ciou:ident $eiou:ident) => {
        match $metric {
            Metric::Iou => row!(Iou, $shape),
            Metric::Iof => row!(Iof, $shape),
            Metric::Giou(Enclosing::Hull) => row!(Giou, $shape),
            Metric::Giou(Enclosing::Rect) => row!($giou, $shape),
            Metric::Giou(Enclosing::Aabb) => row!(GiouAabb, $shape),
            Metric::Diou(Enclosing::Hull) => row!(Diou, $shape),
            Metric::Diou(Enclosing::Rect) => row!($diou, $shape),
            Metric::Diou(Enclosing::Aabb) | Metric::DiouBox => row!(DiouAabb, $shape),
            Metric::Ciou(Enclosing::Hull) => row!(Ciou, $shape),
            Metric::Ciou(Enclosing::Rect) => row!($ciou, $shape),
            Metric::Ciou(Enclosing::Aabb) => row!(CiouAabb, $shape),
            Metric::Eiou(Enclosing::Hull) => row!(Eiou, $shape),
            Metric::Eiou(Enclosing::Rect) => row!($eiou, $shape),
            Metric::Eiou(Enclosing::Aabb) => row!(EiouAabb, $shape),
        }
    };
    ($verb:ident, $shape:ident) => {
        const { straight::<RowOf<kernels::$verb, ($shape<f64>, $shape<f64>)>>() }
    };
}

impl<T: Number> Boxes for Obb2<T> {
    const COLUMNS: &'static [&'static str] = &["x", "y", "w", "h", "r"];
    const DERIVATIVE: &'static [&'static str] = Self::COLUMNS;

    fn row(metric: Metric) -> Operation {
        // GIoU in a rectangle takes IoU; the command line has no rectangle for the others.
        row!(metric, Obb2, Iou Diou Ciou Eiou)
    }

    fn rest(metric: Metric) -> Option<Result<Rest<Self, T>, Error>> {
        type Known<T> = (Obb2<Sym<T>>, Obb2<Sym<T>>, Sym<T>);
        let giou = |(a, b, iou): Known<T>| giou_in_rectangle(a, b, iou);
        (metric == Metric::Giou(Enclosing::Rect)).then(|| Program::trace(giou))
    }
}

/// GIoU with the rectangle of least area around both, from their IoU.
fn giou_in_rectangle<S: Scalar>(a: Obb2<S>, b: Obb2<S>, iou: S) -> S {
    let around = smallest_rectangle(a, b);
    let around = around.x * around.y;
    let point = around.at_most(S::zero());
    let both = a.size.x * a.size.y + b.size.x * b.size.y;
    let union = both.over(S::one() + iou);
    let covered = union.over(S::select(point, S::one(), around));
    // Rounding can leave what is around both a little smaller than both.
    S::select(point, iou, iou - (S::one() - covered).most(S::zero()))
}

impl<T: Number> Boxes for YawBox3<T> {
    const COLUMNS: &'static [&'static str] = &["x", "y", "z", "dx", "dy", "dz", "heading"];
    const DERIVATIVE: &'static [&'static str] = &["x", "y", "z", "dx", "dy", "dz", "r"];

    fn row(metric: Metric) -> Operation {
        row!(metric, YawBox3, GiouRectangle DiouRectangle CiouRectangle EiouRectangle)
    }
}

impl<T: Number> Boxes for Obb3<T> {
    const COLUMNS: &'static [&'static str] =
        &["x", "y", "z", "dx", "dy", "dz", "qw", "qx", "qy", "qz"];
    const DERIVATIVE: &'static [&'static str] =
        &["x", "y", "z", "dx", "dy", "dz", "rx", "ry", "rz"];

    fn check(self) -> Result<(), String> {
        let q = self.rotation;
        match [q.w, q.x, q.y, q.z].iter().all(|&x| x == T::zero()) {
            true => Err("qw, qx, qy and qz are all zero, which is no rotation".into()),
            false => Ok(()),
        }
    }

    fn derivatives(self, by: Self) -> Vec<T> {
        let (center, size) = (by.center, by.size);
        // Derivatives are smaller the longer the quaternion is; turning is not.
        let turn = self.rotation.tangent_gradient(by.rotation);
        let all = [center, size, turn].map(|own| [own.x, own.y, own.z]);
        all.concat()
    }

    fn row(metric: Metric) -> Operation {
        // The command line has no hull for these.
        row!(metric, Obb3, Giou Diou Ciou Eiou)
    }
}
