//! Overlaps and scores of boxes in the plane.
use super::{Report, flag};
use crate::oracle_boxes;
use crate::polygon::exact;
use geograd::convention::{Degrees, Detectron2Box, ImageBox};
use geograd::iou::{ciou_aabb2, diou_aabb2};
use geograd::overlap_polygon::intersection_area_quads;
use geograd::{Aabb2, Jet, Obb2, Vec2};
use std::f64::consts::FRAC_PI_4;

pub const ORACLE: &str = "oracle of 256 bits on the same numbers";
pub const SELF: &str = "definition: a box with itself";

/// The same numbers in double precision.
fn wide(b: Obb2<f32>) -> Obb2<f64> {
    let [x, y, w, h, turn] = [b.center.x, b.center.y, b.size.x, b.size.y, b.heading].map(f64::from);
    Obb2::new(x, y, w, h, turn)
}

fn oracle([a, b]: [Obb2<f32>; 2]) -> Vec<f64> {
    vec![oracle_boxes::iou(wide(a), wide(b))]
}

fn score([a, b]: [Obb2<f32>; 2]) -> Vec<f64> {
    vec![a.iou(b).into()]
}

/// Boxes of detectron2, with degrees.
fn detectron(boxes: [[f32; 5]; 2]) -> [Obb2<f32>; 2] {
    boxes.map(|[x, y, w, h, degrees]| {
        let made = Detectron2Box {
            center: Vec2::new(x, y),
            size: Vec2::new(w, h),
            heading: Degrees { value: degrees },
        };
        ImageBox::from(made).mirrored()
    })
}

fn rrpn() -> [Obb2<f32>; 2] {
    [
        Obb2::new(46.83, 44.03, 3.9, 1.63, 0.0),
        Obb2::new(46.83, 44.03, 1.63, 3.9, 1.45),
    ]
}

fn nearly() -> [Obb2<f32>; 2] {
    detectron([
        [2563.744_6, 1436.790_2, 2174.703_4, 214.095, 115.118_35],
        [2563.744_6, 1436.790_3, 2174.702_9, 214.094_96, 115.118_355],
    ])
}

fn labelled() -> [Obb2<f32>; 2] {
    detectron([
        [296.662_02, 458.738_83, 23.515_73, 47.677_002, 0.087_951_66],
        [296.662_01, 458.738_82, 23.515_73, 47.677_02, 0.087_951],
    ])
}

fn handed() -> [Obb2<f32>; 2] {
    detectron([
        [160.0, 153.0, 230.0, 23.0, -37.0],
        [190.0, 127.0, 80.0, 21.0, -46.0],
    ])
}

fn flush() -> [Obb2<f64>; 2] {
    [
        Obb2::new(
            824.642_118_367_281_7,
            280.287_370_070_698_33,
            565.0,
            140.0,
            (-177.805_068_969_726_56_f64).to_radians(),
        ),
        Obb2::new(
            567.331_043_882_800_3,
            270.425_273_557_195_45,
            275.0,
            50.0,
            92.194_931_030_273_44_f64.to_radians(),
        ),
    ]
}

/// The quadrilaterals of supervision's own example, stretched along x.
fn diamonds(by: f64) -> [[Vec2<f64>; 4]; 2] {
    [
        [[1.0, 0.0], [4.0, 3.0], [3.0, 4.0], [0.0, 1.0]],
        [[2.0, 0.0], [4.0, 2.0], [3.0, 3.0], [1.0, 1.0]],
    ]
    .map(|quad| quad.map(|[x, y]| Vec2::new(x * by, y)))
}

pub fn reports() -> Vec<Report> {
    vec![
        Report {
            library: "mjq11302010044/RRPN",
            number: 44,
            about: "IoU 1.35",
            asked: "IoU of boxes 3.9 by 1.63, one nearly a quarter turn of the other, `f32`",
            source: ORACLE,
            found: || score(rrpn()),
            right: || oracle(rrpn()),
            within: 4e-6,
        },
        Report {
            library: "mrlooi/rotated_maskrcnn",
            number: 46,
            about: "IoU 0.333",
            asked: "IoU of a box 791 by 39 with itself, `f32`",
            source: SELF,
            found: || {
                let b = Obb2::new(
                    672.4067_f32,
                    290.7776,
                    791.0275,
                    38.9333,
                    34.1454_f32.to_radians(),
                );
                score([b, b])
            },
            right: || vec![1.0],
            within: 0.0,
        },
        Report {
            library: "open-mmlab/mmcv",
            number: 2621,
            about: "IoU 0.333",
            asked: "IoU of a box 181 by 136 with itself, `f32`",
            source: SELF,
            found: || {
                let b = Obb2::new(0.0_f32, 0.0, 180.642_23, 136.363_37, 0.955_964_86);
                score([b, b])
            },
            right: || vec![1.0],
            within: 0.0,
        },
        Report {
            library: "lilanxiao/Rotated_IoU",
            number: 38,
            about: "IoU 0",
            asked: "IoU of a square turned by π/4 with itself, `f32`",
            source: SELF,
            found: || {
                let b = Obb2::new(0.0_f32, 0.0, 2.0, 2.0, FRAC_PI_4 as f32);
                score([b, b])
            },
            right: || vec![1.0],
            within: 0.0,
        },
        Report {
            library: "facebookresearch/detectron2",
            number: 2167,
            about: "IoU 0.5848",
            asked: "IoU of two boxes 2175 by 214 that differ by 10⁻⁴ pixels, `f32`",
            source: ORACLE,
            found: || score(nearly()),
            right: || oracle(nearly()),
            within: 4e-6,
        },
        Report {
            library: "facebookresearch/detectron2",
            number: 2154,
            about: "IoU 0.6002",
            asked: "IoU of a label and its copy with rounded numbers, `f32`",
            source: ORACLE,
            found: || score(labelled()),
            right: || oracle(labelled()),
            within: 4e-6,
        },
        Report {
            library: "facebookresearch/detectron2",
            number: 1207,
            about: "IoU 0.2655: angles were taken clockwise",
            asked: "IoU of two boxes at −37 and −46 degrees, counter-clockwise to the viewer",
            source: ORACLE,
            found: || score(handed()),
            right: || oracle(handed()),
            within: 0.0,
        },
        Report {
            library: "facebookresearch/maskrcnn-benchmark",
            number: 1020,
            about: "0.7042, by widths of one pixel more",
            asked: "IoU of squares of side 10, shifted by (1, 1)",
            source: "closed form 81/119",
            found: || vec![Aabb2::new(0.0, 0.0, 10.0, 10.0).iou(Aabb2::new(1.0, 1.0, 11.0, 11.0))],
            right: || vec![81.0 / 119.0],
            within: 1e-15,
        },
        Report {
            library: "mystic123/tensorflow-yolo-v3",
            number: 84,
            about: "a positive IoU, of two negative sides",
            asked: "IoU of squares apart along both axes",
            source: "definition",
            found: || vec![Aabb2::new(0.0, 0.0, 1.0, 1.0).iou(Aabb2::new(3.0, 3.0, 4.0, 4.0))],
            right: || vec![0.0],
            within: 0.0,
        },
        Report {
            library: "opencv/opencv",
            number: 23546,
            about: "area 3500: an edge of each on one line",
            asked: "area shared by rectangles 565 by 140 and 275 by 50",
            source: ORACLE,
            found: || {
                let [a, b] = flush();
                vec![a.intersection_area(b)]
            },
            right: || {
                let [a, b] = flush();
                let iou = oracle_boxes::iou(a, b);
                vec![iou * (a.area() + b.area()) / (1.0 + iou)]
            },
            within: 1e-8,
        },
        Report {
            library: "roboflow/supervision",
            number: 2278,
            about: "IoU 0 where the canvas is not square",
            asked: "areas shared by two diamonds, and by the same stretched four times along x",
            source: "clipping in numbers of 320 binary places",
            found: || {
                [1.0, 4.0]
                    .map(|by| {
                        let [a, b] = diamonds(by);
                        intersection_area_quads(a, b)
                    })
                    .to_vec()
            },
            right: || {
                [1.0, 4.0]
                    .map(|by| {
                        let [a, b] = diamonds(by);
                        exact::area_inside(&a, &b)
                    })
                    .to_vec()
            },
            within: 1e-14,
        },
        Report {
            library: "pytorch/vision",
            number: 6338,
            about: "0.25 and 0: the centres did not count",
            asked: "DIoU of a square of 100 with one of 50 in its corner, and with one of 100 beyond it",
            source: "the paper's formula in fractions: 1/4 − 1/16, −4/9",
            found: || {
                let at = |a, b| Aabb2::new(a, a, b, b);
                let whole = at(0.0, 100.0);
                vec![
                    diou_aabb2(whole, at(0.0, 50.0)),
                    diou_aabb2(whole, at(200.0, 300.0)),
                ]
            },
            right: || vec![0.1875, -4.0 / 9.0],
            within: 1e-15,
        },
        Report {
            library: "Zzh-tju/DIoU-pytorch-detectron",
            number: 19,
            about: "NaN derivatives of a box without height",
            asked: "whether all derivatives of CIoU are finite there",
            source: "definition",
            found: || {
                let x: [Jet<f64, 4>; 4] =
                    std::array::from_fn(|k| Jet::variable([200.0, 599.0, 300.0, 599.0][k], k));
                let truth = Aabb2::new(190.0, 500.0, 310.0, 600.0).map_to_jet();
                let score = ciou_aabb2(Aabb2::new(x[0], x[1], x[2], x[3]), truth);
                vec![flag(
                    score.value.is_finite() && score.derivative.iter().all(|d| d.is_finite()),
                )]
            },
            right: || vec![1.0],
            within: 0.0,
        },
    ]
}

/// Constants for derivatives.
trait Constant {
    fn map_to_jet(self) -> Aabb2<Jet<f64, 4>>;
}

impl Constant for Aabb2<f64> {
    fn map_to_jet(self) -> Aabb2<Jet<f64, 4>> {
        let at = |x: f64| Jet::variable(x, 9);
        Aabb2::new(
            at(self.min.x),
            at(self.min.y),
            at(self.max.x),
            at(self.max.y),
        )
    }
}
