//! The numbers of other libraries' losses by the formulas that `geograd::detection` gives, against theirs, written
//! anew from their sources: covariances as matrices, small numbers added where they add them.
use geograd::gaussian::{
    bhattacharyya, kfiou, kullback_leibler, kullback_leibler_mean, probiou, saturating_loss,
    wasserstein, wasserstein_squared,
};
use geograd::iou::{ciou_aabb2, ciou_fixed_weight_aabb2, diou_aabb2, giou_aabb2};
use geograd::overlap::iou_aabb2;
use geograd::suppression::{Decay, Pair, Rules, hard, soft};
use geograd::{Aabb2, Obb2};
use geograd_tests::Dice;
use std::f64::consts::PI;

fn close(ours: f64, theirs: f64, by: f64, what: &str) {
    assert!((ours - theirs).abs() <= by, "{what}: {ours} {theirs}");
}

/// A symmetric matrix: xx, xy, yy.
#[derive(Clone, Copy)]
struct Matrix([f64; 3]);

impl Matrix {
    /// The covariance of a box whose deviations are its sizes times a number.
    fn of(shape: Obb2<f64>, deviation: f64) -> Self {
        let (sin, cos) = shape.heading.sin_cos();
        let [p, q] = [shape.size.x, shape.size.y].map(|x| (x * deviation).powi(2));
        Matrix([
            p * cos * cos + q * sin * sin,
            (p - q) * sin * cos,
            p * sin * sin + q * cos * cos,
        ])
    }
    fn plus(self, other: Self) -> Self {
        Matrix([0, 1, 2].map(|k| self.0[k] + other.0[k]))
    }
    fn times(self, by: f64) -> Self {
        Matrix(self.0.map(|x| x * by))
    }
    fn det(self) -> f64 {
        self.0[0] * self.0[2] - self.0[1] * self.0[1]
    }
    fn inverse(self) -> Self {
        Matrix([self.0[2], -self.0[1], self.0[0]].map(|x| x / self.det()))
    }
    fn trace_of_product(self, other: Self) -> f64 {
        self.0[0] * other.0[0] + 2.0 * self.0[1] * other.0[1] + self.0[2] * other.0[2]
    }
    fn form(self, d: [f64; 2]) -> f64 {
        self.0[0] * d[0] * d[0] + 2.0 * self.0[1] * d[0] * d[1] + self.0[2] * d[1] * d[1]
    }
}

/// The way between two centres.
fn between(a: Obb2<f64>, b: Obb2<f64>) -> [f64; 2] {
    [a.center.x - b.center.x, a.center.y - b.center.y]
}

/// Boxes of pixels' sizes, of which a part overlap.
fn pairs() -> Vec<[Obb2<f64>; 2]> {
    let mut dice = Dice(2031);
    let mut shape = || {
        Obb2::new(
            dice.within(-20.0, 20.0),
            dice.within(-20.0, 20.0),
            dice.within(4.0, 40.0),
            dice.within(4.0, 40.0),
            dice.within(-3.0, 3.0),
        )
    };
    (0..200).map(|_| [shape(), shape()]).collect()
}

/// mmrotate's `gaussian_dist_loss.py`, with `tau=1`.
#[test]
fn gaussian_distances_of_mmrotate() {
    let post = |d: f64| 1.0 - 1.0 / (1.0 + d.ln_1p());
    for [p, t] in pairs() {
        let (sp, st, d) = (Matrix::of(p, 0.5), Matrix::of(t, 0.5), between(p, t));
        // gwd_loss
        let root = (sp.det() * st.det()).sqrt();
        let shapes = sp.0[0] + sp.0[2] + st.0[0] + st.0[2]
            - 2.0 * (sp.trace_of_product(st) + 2.0 * root).sqrt();
        let squared = d[0] * d[0] + d[1] * d[1] + shapes;
        let theirs = squared.sqrt() / (2.0 * root.sqrt().sqrt());
        let ours = wasserstein(p, t) / (p.area() * t.area()).powf(0.25);
        close(saturating_loss(ours, 1.0), post(theirs), 1e-12, "gwd");
        // kld_loss, both ways
        let divergence = |from: Matrix, to: Matrix| {
            let inverse = from.inverse();
            0.5 * inverse.form(d)
                + 0.5 * inverse.trace_of_product(to)
                + 0.5 * (from.det().ln() - to.det().ln())
                - 1.0
        };
        let (kld, back) = (divergence(sp, st), divergence(st, sp));
        let roots = [kullback_leibler(t, p), kullback_leibler(p, t)].map(f64::sqrt);
        close(
            saturating_loss(roots[0], 1.0),
            post(kld.sqrt()),
            1e-12,
            "kld",
        );
        let jd = ((kld + back) * 0.5).sqrt();
        let ours = kullback_leibler_mean(p, t).sqrt();
        close(saturating_loss(ours, 1.0), post(jd), 1e-12, "jd");
        let largest = kld.sqrt().max(back.sqrt());
        close(
            roots[0].max(roots[1]).ln_1p(),
            largest.ln_1p(),
            1e-12,
            "symmax",
        );
        // gaussian_dist_loss_v1.py
        let v1 = |d: f64| 1.0 - 1.0 / (1.0 + d.max(1e-6).sqrt());
        close(v1(wasserstein_squared(p, t)), v1(squared), 1e-12, "v1 gwd");
        let inverse = st.inverse();
        let theirs =
            inverse.form(d) + inverse.trace_of_product(sp) + (st.det() / sp.det()).ln() - 2.0;
        close(
            v1(2.0 * kullback_leibler(p, t)),
            v1(theirs),
            1e-12,
            "v1 kld",
        );
        let mean = sp.plus(st).times(0.5);
        let theirs =
            0.5 * (mean.det() / (sp.det() * st.det()).sqrt()).ln() + 0.125 * mean.inverse().form(d);
        close(v1(bhattacharyya(p, t)), v1(theirs), 1e-12, "v1 bcd");
        // kf_iou_loss.py: Σ = Σp − Σp (Σp + Σt)⁻¹ Σp, of which only the determinant counts.
        let [volume_p, volume_t] = [sp, st].map(|s| 4.0 * s.det().sqrt());
        let fused = sp.det() * st.det() / sp.plus(st).det();
        let volume = 4.0 * fused.sqrt();
        let theirs = 1.0 - volume / (volume_p + volume_t - volume + 1e-6);
        close(1.0 - kfiou(p, t), theirs, 1e-7, "kfiou");
    }
}

/// ultralytics' `probiou`, whose covariances are those of an even spread.
#[test]
fn probiou_of_ultralytics() {
    let eps = 1e-7;
    let theirs = |p: Obb2<f64>, t: Obb2<f64>| {
        let [Matrix([a1, c1, b1]), Matrix([a2, c2, b2])] =
            [p, t].map(|x| Matrix::of(x, (1.0_f64 / 12.0).sqrt()));
        let [dx, dy] = between(p, t);
        let all = (a1 + a2) * (b1 + b2) - (c1 + c2).powi(2);
        let t1 = ((a1 + a2) * dy * dy + (b1 + b2) * dx * dx) / (all + eps) * 0.25;
        let t2 = (c1 + c2) * -dx * dy / (all + eps) * 0.5;
        let own = (a1 * b1 - c1 * c1).max(0.0) * (a2 * b2 - c2 * c2).max(0.0);
        let t3 = (all / (4.0 * own.sqrt() + eps) + eps).ln() * 0.5;
        let distance = (t1 + t2 + t3).clamp(eps, 100.0);
        1.0 - (1.0 - (-distance).exp() + eps).sqrt()
    };
    for [p, t] in pairs() {
        let ours = 1.0 - ((1.0 - probiou(p, t)).powi(2) + eps).sqrt();
        close(ours, theirs(p, t), 1e-6, "probiou");
        close(
            theirs(p, p),
            1.0 - (2.0 * eps).sqrt(),
            1e-9,
            "of equal boxes",
        );
        assert_eq!(probiou(p, p), 1.0);
    }
}

/// The parts of the losses of axis-aligned boxes, with the small constants of other libraries.
struct Parts {
    iou: f64,
    union: f64,
    around: [f64; 2],
    apart: f64,
    v: f64,
}

fn parts(p: Aabb2<f64>, t: Aabb2<f64>, eps: f64, to_height: f64) -> Parts {
    let side = |low: f64, high: f64| (high - low).max(0.0);
    let shared = side(p.min.x.max(t.min.x), p.max.x.min(t.max.x))
        * side(p.min.y.max(t.min.y), p.max.y.min(t.max.y));
    let [size_p, size_t] = [p, t].map(|x| [x.max.x - x.min.x, x.max.y - x.min.y + to_height]);
    let union = size_p[0] * size_p[1] + size_t[0] * size_t[1] - shared;
    let angle = |size: [f64; 2]| (size[0] / size[1]).atan();
    let [dx, dy] = [
        (p.min.x + p.max.x - t.min.x - t.max.x) / 2.0,
        (p.min.y + p.max.y - t.min.y - t.max.y) / 2.0,
    ];
    Parts {
        iou: shared / (union + eps),
        union,
        around: [
            p.max.x.max(t.max.x) - p.min.x.min(t.min.x),
            p.max.y.max(t.max.y) - p.min.y.min(t.min.y),
        ],
        apart: dx * dx + dy * dy,
        v: 4.0 / (PI * PI) * (angle(size_t) - angle(size_p)).powi(2),
    }
}

#[test]
fn losses_of_boxes_along_the_axes() {
    for [p, t] in pairs() {
        let [p, t] = [p, t].map(|x| {
            let half = x.size * 0.5;
            let (min, max) = (x.center - half, x.center + half);
            Aabb2 { min, max }
        });
        // ε over an area of at least 16 pixels, or over the square of a length.
        let by = 2e-7;
        // torchvision, fvcore and detectron2: generalized_box_iou_loss, distance_box_iou_loss, complete_box_iou_loss.
        let eps = 1e-7;
        let found = parts(p, t, eps, 0.0);
        let box_area = found.around[0] * found.around[1];
        let giou = found.iou - (box_area - found.union) / (box_area + eps);
        close(1.0 - giou_aabb2(p, t), 1.0 - giou, by, "giou loss");
        let diagonal = found.around[0].powi(2) + found.around[1].powi(2) + eps;
        let diou = found.iou - found.apart / diagonal;
        close(1.0 - diou_aabb2(p, t), 1.0 - diou, by, "diou loss");
        let alpha = found.v / (1.0 - found.iou + found.v + eps);
        let ciou = diou - alpha * found.v;
        close(
            1.0 - ciou_fixed_weight_aabb2(p, t),
            1.0 - ciou,
            by,
            "ciou loss",
        );
        // ultralytics' bbox_iou: ε in heights and unions, too.
        let found = parts(p, t, eps, eps);
        let union = found.union + eps;
        close(iou_aabb2(p, t), found.iou, by, "bbox_iou");
        let box_area = found.around[0] * found.around[1] + eps;
        let giou = found.iou - (box_area - union) / box_area;
        close(giou_aabb2(p, t), giou, by, "bbox_iou GIoU");
        let alpha = found.v / (found.v - found.iou + (1.0 + eps));
        let ciou = found.iou - (found.apart / diagonal + found.v * alpha);
        close(ciou_aabb2(p, t), ciou, by, "bbox_iou CIoU");
        // mmdetection's ciou_loss: α counts where the IoU is above one half.
        let eps = 1e-6;
        let found = parts(p, t, eps, 0.0);
        let with_eps = parts(p, t, eps, eps);
        let weight = f64::from(found.iou > 0.5);
        let alpha = weight * with_eps.v / (1.0 - found.iou + with_eps.v);
        let diagonal = found.around[0].powi(2) + found.around[1].powi(2) + eps;
        let ciou = found.iou - (found.apart / diagonal + alpha * with_eps.v);
        let ours = match iou_aabb2(p, t) > 0.5 {
            true => ciou_fixed_weight_aabb2(p, t),
            false => diou_aabb2(p, t),
        };
        close(
            1.0 - ours,
            1.0 - ciou.clamp(-1.0, 1.0),
            10.0 * by,
            "mmdetection's ciou",
        );
    }
}

/// mmcv's linear soft suppression begins at its threshold, ours above it.
#[test]
fn soft_suppression_of_mmcv_begins_at_the_threshold() {
    let pairs = [Pair {
        first: 0,
        second: 1,
        overlap: 0.5_f64,
    }];
    let score = |threshold: f64| {
        let kept = soft(&[0.9, 0.8], &pairs, Decay::Linear, Rules::above(threshold)).unwrap();
        kept[1].score
    };
    assert_eq!(score(0.5), 0.8);
    assert_eq!(score(0.5_f64.next_down()), 0.8 * (1.0 - 0.5));
    assert_eq!(
        hard(&[0.9, 0.8], &pairs, Rules::above(0.5)).unwrap(),
        [0, 1]
    );
}
