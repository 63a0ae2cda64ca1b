//! The scores that boxes are moved by, of many pairs at once.
//!
//! Overlaps and their derivatives are the library's operations. All else is recorded as a program of both boxes
//! and their overlap, which makes batches of it as fast; what a score adds to the overlap is recorded by
//! itself (`known.rs`).
use crate::loss::{Goal, Loss, Space};
use common::known::{Known, known};
use geograd::gaussian::{self, solid};
use geograd::iou::{ciou_obb2, diou_obb2, hull_area_obb2};
use geograd::iou3::{Enclosing, ciou, diou, giou, separation_aware};
use geograd::kernels::{Backend, Iou};
use geograd::{Error, Obb2, Obb3, Program, Rotation2, Scalar, Sym, Vec2, Vec3, YawBox3};

/// Sizes of truths count as no smaller than a millimetre.
const THIN: f64 = 1e-3;

/// `1 − ln(1 + c)` with the squared distance of the centres in units of half the truth's size.
fn nearness<S: Scalar>(by: [S; 3], size: [S; 3]) -> S {
    let mut sum = S::one();
    for (by, size) in by.into_iter().zip(size) {
        let share = (by + by).over(size.most(S::lit(THIN)));
        sum += share.squared();
    }
    S::one() - sum.ln()
}

/// `1 / (1 + ln(1 + d))` of a distance d, one minus the loss of its papers.
fn saturated<S: Scalar>(d: S) -> S {
    S::one() - gaussian::saturating_loss(d, S::one())
}

/// GIoU with the convex hull, from the IoU.
fn giou_of_ground<S: Scalar>(a: Obb2<S>, b: Obb2<S>, iou: S) -> S {
    let area = |x: Obb2<S>| x.size.x * x.size.y;
    let union = (area(a) + area(b)).over(S::one() + iou);
    let hull = hull_area_obb2(a, b);
    let point = hull.at_most(S::zero());
    let share = union.over(S::select(point, S::one(), hull));
    S::select(point, iou, iou - (S::one() - share).most(S::zero()))
}

/// The overlap of shapes, less how far the centres are apart, which it does not see. It is in units of its
/// largest value.
fn kfiou<S: Scalar>(shapes: S, most: f64, a: YawBox3<S>, b: YawBox3<S>) -> S {
    let way = a.center - b.center;
    let by = Rotation2::from_angle(b.heading).inverse() * Vec2::new(way.x, way.y);
    let near = nearness([by.x, by.y, way.z], [b.size.x, b.size.y, b.size.z]);
    shapes * S::lit(1.0 / most) + near - S::one()
}

/// A box without height on the plane of the camera: whether two are apart their grounds alone say.
fn flat<S: Scalar>(shape: YawBox3<S>) -> YawBox3<S> {
    let zero = S::zero();
    let (center, size) = (shape.center, shape.size);
    YawBox3::new(
        Vec3::new(center.x, center.y, zero),
        Vec3::new(size.x, size.y, zero),
        shape.heading,
    )
}

/// Two boxes and their overlap.
type Pair = (YawBox3<f32>, YawBox3<f32>, f32);
type Number = Sym<f32>;
type Solid = YawBox3<Number>;
type Recorded = (Solid, Solid, Number);
type Score = Result<Program<Pair, f32>, Error>;

/// The score of two boxes, seen from above.
fn of_grounds(score: fn(Obb2<Number>, Obb2<Number>) -> Number) -> Score {
    Program::trace(|(a, b, _): Recorded| score(a.birds_eye(), b.birds_eye()))
}

/// The score of two boxes in space.
fn of_boxes(score: fn(Solid, Solid) -> Number) -> Score {
    Program::trace(|(a, b, _): Recorded| score(a, b))
}

/// The score of two boxes with their overlap.
fn of_known(score: fn(Known<Solid, Number>, Known<Solid, Number>) -> Number) -> Score {
    Program::trace(|(a, b, iou): Recorded| {
        let [a, b] = known(a, b, iou);
        score(a, b)
    })
}

impl Goal {
    /// The score as a program; that of IoU is IoU.
    fn program(self) -> Score {
        match self.space {
            Space::BirdsEye => on_ground(self.loss),
            Space::Full => in_space(self.loss),
        }
    }
}

fn on_ground(loss: Loss) -> Score {
    match loss {
        Loss::Iou => of_known(|a, _| a.iou),
        Loss::Giou => {
            of_known(|a, b| giou_of_ground(a.shape.birds_eye(), b.shape.birds_eye(), a.iou))
        }
        Loss::Diou => of_grounds(diou_obb2),
        Loss::Ciou => of_grounds(ciou_obb2),
        Loss::Gwd => of_grounds(|a, b| saturated(gaussian::wasserstein(a, b))),
        Loss::Kld => of_grounds(|a, b| saturated(gaussian::kullback_leibler(a, b))),
        Loss::Kfiou => of_boxes(|a, b| {
            let shapes = gaussian::kfiou(a.birds_eye(), b.birds_eye());
            kfiou(shapes, 1.0 / 3.0, flat(a), flat(b))
        }),
        Loss::Probiou => of_grounds(gaussian::probiou),
        Loss::Separation => of_known(|a, b| {
            let [a, b] = known(flat(a.shape), flat(b.shape), a.iou);
            separation_aware(a, b)
        }),
    }
}

/// Around a pair is the convex hull of both grounds times the height of both.
fn in_space(loss: Loss) -> Score {
    match loss {
        Loss::Iou => of_known(|a, _| a.iou),
        Loss::Giou => of_known(|a, b| giou(a, b, Enclosing::Hull)),
        Loss::Diou => of_known(|a, b| diou(a, b, Enclosing::Hull)),
        Loss::Ciou => of_known(|a, b| ciou(a, b, Enclosing::Hull)),
        Loss::Gwd => of_boxes(|a, b| {
            // Upright boxes: heights have a term of their own, with deviations of half the size.
            let ground = gaussian::wasserstein_squared(a.birds_eye(), b.birds_eye());
            let up = (a.center.z - b.center.z).squared();
            let heights = (a.size.z - b.size.z).halved().squared();
            saturated((ground + up + heights).root())
        }),
        Loss::Kld => {
            of_boxes(|a, b| saturated(solid::kullback_leibler(Obb3::from(a), Obb3::from(b))))
        }
        Loss::Kfiou => of_boxes(|a, b| {
            let shapes = solid::kfiou(Obb3::from(a), Obb3::from(b));
            kfiou(shapes, 1.0 / (2.0 * 8.0_f64.sqrt() - 1.0), a, b)
        }),
        Loss::Probiou => of_boxes(|a, b| solid::probiou(Obb3::from(a), Obb3::from(b))),
        Loss::Separation => of_known(separation_aware),
    }
}

/// The scores of many pairs, as batches.
#[derive(Debug)]
pub struct Scorer {
    goal: Goal,
    /// The score with its derivatives; `None` where it is the overlap.
    program: Option<Program<Pair, (f32, Pair)>>,
}

impl Scorer {
    pub fn goal(&self) -> Goal {
        self.goal
    }

    pub fn new(goal: Goal) -> Result<Self, Error> {
        let program = match goal.loss {
            Loss::Iou => None,
            _ => Some(goal.program()?.value_grad()),
        };
        Ok(Scorer { goal, program })
    }

    /// The scores of boxes with their truths, and their derivatives with respect to the boxes, in one batch.
    pub fn scores(
        &self,
        backend: Backend<'_>,
        boxes: &[YawBox3<f32>],
        truths: &[YawBox3<f32>],
    ) -> Result<Scores, Error> {
        let (ious, by_iou) = match self.goal.loss.needs_iou(self.goal.space) {
            true => self.overlaps(backend, boxes, truths)?,
            false => (vec![0.0; boxes.len()], Vec::new()),
        };
        let Some(program) = &self.program else {
            return Ok((ious, by_iou));
        };
        let columns = (boxes, truths, &ious);
        let (scores, (mut derivatives, _, along)) = backend.aligned(program, columns)?;
        for ((by, along), iou) in derivatives.iter_mut().zip(along).zip(by_iou) {
            by.center += iou.center * along;
            by.size += iou.size * along;
            by.heading += iou.heading * along;
        }
        Ok((scores, derivatives))
    }

    /// Overlaps, and their derivatives with respect to the boxes.
    fn overlaps(
        &self,
        backend: Backend<'_>,
        boxes: &[YawBox3<f32>],
        truths: &[YawBox3<f32>],
    ) -> Result<Scores, Error> {
        let iou = Iou.value_grad();
        if self.goal.space == Space::Full {
            let (ious, (derivatives, _)) = backend.aligned(iou, (boxes, truths))?;
            return Ok((ious, derivatives));
        }
        let grounds = [boxes, truths].map(|all| {
            all.iter()
                .map(|shape| shape.birds_eye())
                .collect::<Vec<_>>()
        });
        let (ious, (derivatives, _)) = backend.aligned(iou, (&grounds[0], &grounds[1]))?;
        let raised = derivatives.into_iter().map(|by| {
            let [center, size] = [by.center, by.size].map(|own| Vec3::new(own.x, own.y, 0.0));
            YawBox3::new(center, size, by.heading)
        });
        Ok((ious, raised.collect()))
    }
}

/// Scores, and their derivatives with respect to the boxes that move.
type Scores = (Vec<f32>, Vec<YawBox3<f32>>);
