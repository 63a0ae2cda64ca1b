//! Plans of operations with compiled kernels: the kernels, and the scalar code for shapes beyond their range.
use super::computation::{Outline, Plan, Preparation, Prepare};
use crate::ad::adjoint::iou::giou_framed_vjp;
use crate::ad::adjoint::overlap::{score_aabb2_vjp, score_framed_vjp};
use crate::ad::adjoint::overlap_quad::area_of_quads_vjp;
use crate::ad::adjoint::overlap3::score_obb3_vjp;
use crate::ad::adjoint::upright::score_upright_vjp;
use crate::error::Validate;
use crate::iou::giou_framed;
use crate::kernels::cpu::arch::LARGE;
use crate::kernels::cpu::boxes3::{OBB3, is_common_obb3};
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::lane::{Lane, ResultTiles, Tiles};
use crate::kernels::cpu::maker::Maker;
use crate::kernels::cpu::overlaps::{
    AABB2, OBB2, SEEN, UPRIGHT, View, is_common_upright, is_solid_obb2,
};
use crate::kernels::cpu::quads::{QUAD2, farthest};
use crate::kernels::cpu::solids;
use crate::kernels::cpu::upright_boxes;
use crate::kernels::row::compiled::Compiled;
use crate::kernels::row::derivation::Mode;
use crate::overlap::{Denominator, score_framed};
use crate::overlap_polygon::check_quad;
use crate::overlap3::{score_obb3, score_yaw};
use crate::scalar::power_of_largest;
use crate::shape::{Obb3, YawBox3};
use crate::{Aabb2, Fixed, Obb2, Real, Vec2, clip};
use std::sync::Arc;

/// Returns the plan of an operation with compiled kernels; `None` if this target has none for it.
pub(super) fn of_compiled<T: Real>(compiled: Compiled, mode: Mode) -> Option<Plan<T>> {
    match compiled {
        Compiled::Obb2(over) => Some(of_obb2(over, mode)),
        Compiled::Aabb2(over) => Some(of_aabb2(over, mode)),
        Compiled::Giou => Some(of_giou(mode)),
        Compiled::Upright(over) => Some(of_upright(over, mode)),
        Compiled::BirdsEye(over) => Some(of_birds_eye(over, mode)),
        // Kernels that are not compiled for this target are interpreted instead.
        Compiled::Quads if LARGE || mode == Mode::Value => Some(of_quads(mode)),
        Compiled::Obb3(over) if LARGE => Some(of_obb3(over, mode)),
        Compiled::Quads | Compiled::Obb3(_) | Compiled::Aabb3 => None,
    }
}

/// Returns the bounds in the plane of shapes whose results a program computes.
pub(super) fn outline<T: Real>(compiled: Compiled) -> Option<Outline<T>> {
    match compiled {
        Compiled::Aabb3 => Some(Arc::new(|[shapes, _], bounds| {
            solids::aabb3_bounds(shapes, bounds)
        })),
        Compiled::Obb3(_) => Some(Arc::new(|[shapes, _], bounds| {
            solids::obb3_bounds(shapes, bounds)
        })),
        _ => None,
    }
}

/// A kernel of two shapes, of the cotangents of its results if there are any, and of a buffer for results.
struct PairMaker<F>(F);
impl<T, F> Maker<T> for PairMaker<F>
where
    F: Fn(Tiles<'_, T>, Tiles<'_, T>, Option<Tiles<'_, T>>, ResultTiles<'_, T>) + Send + Sync,
{
    fn make(&self, inputs: &[Tiles<'_, T>], out: ResultTiles<'_, T>) {
        (self.0)(inputs[0], inputs[1], inputs.get(2).copied(), out);
    }
}

/// Returns the kernel of a mode: `values`, or `derivatives`.
fn maker<T: Real>(
    mode: Mode,
    values: impl Fn(Tiles<'_, T>, Tiles<'_, T>, ResultTiles<'_, T>) + Send + Sync + 'static,
    derivatives: impl Fn(Tiles<'_, T>, Tiles<'_, T>, Option<Tiles<'_, T>>, ResultTiles<'_, T>)
    + Send
    + Sync
    + 'static,
) -> Box<dyn Maker<T>> {
    let values = move |a: Tiles<'_, T>,
                       b: Tiles<'_, T>,
                       _: Option<Tiles<'_, T>>,
                       out: ResultTiles<'_, T>| values(a, b, out);
    match mode {
        Mode::Value => Box::new(PairMaker(values)),
        Mode::ValueGrad | Mode::Jacobian | Mode::Vjp => Box::new(PairMaker(derivatives)),
    }
}

/// Returns the largest cotangent that kernels take, 10¹² in single precision. Derivatives of ordinary shapes, and their
/// terms, are below 10²⁶, so products stay finite. The cotangent may use 5/16 of the exponent range of the largest
/// number.
fn steepest<T: Real>() -> f64 {
    power_of_largest::<T>(0.3125)
}

/// Returns the plan of a score of two shapes of one kind. `value` and `derivatives` are the scalar code for shapes
/// beyond the kernels' range.
fn score_of_two<T: Real, P: Fixed<Scalar = T>>(
    mode: Mode,
    shape: impl Fn() -> Preparation<T>,
    maker: Box<dyn Maker<T>>,
    value: impl Fn(P, P) -> T + Send + Sync + 'static,
    vjp: impl Fn(P, P, T) -> (T, (P, P)) + Send + Sync + 'static,
) -> Plan<T> {
    Plan {
        steepest: steepest::<T>(),
        rare: Some(Box::new(move |shapes, out_bar, out| {
            let [a, b] = [0, 1].map(|k| P::load(shapes[k]));
            if let [score] = out {
                *score = value(a, b);
                return;
            }
            let (score, bars) = vjp(a, b, out_bar.first().copied().unwrap_or(T::one()));
            out[0] = score;
            bars.store(&mut out[1..]);
        })),
        ..Plan::new(mode, vec![shape(), shape()], vec![1], maker)
    }
}

/// Returns the plan of a score of rotated boxes.
fn of_obb2<T: Real>(over: Denominator, mode: Mode) -> Plan<T> {
    let kernels = kernels_in::<T>();
    let shape = || Preparation {
        name: None,
        fields: OBB2,
        frame: Some(obb2_frames(View::Flat)),
        bounds: Some(obb2_bounds()),
        all_ordinary: Some(kernels.all_ordinary_obb2),
        check: |numbers| Obb2::load(numbers).validate(),
        is_rare: |numbers| !clip::is_ordinary(Obb2::load(numbers)),
    };
    let maker = maker(
        mode,
        move |a, b, out| (kernels.obb2_scores)(over, a, b, out),
        move |a, b, seeds, out| (kernels.obb2_derivatives)(over, a, b, seeds, out),
    );
    let value = move |a, b| score_framed::<T, true>(over, clip::frame(a), clip::frame(b));
    let vjp = move |a, b, out_bar| {
        let (a, b) = (clip::frame(a), clip::frame(b));
        score_framed_vjp::<T, true>(over, a, b, out_bar)
    };
    score_of_two::<T, Obb2<T>>(mode, shape, maker, value, vjp)
}

/// Returns the number of scalars of a prepared rotated box, and the preparation.
fn obb2_frames<T: Real>(view: View) -> (usize, Prepare<T>) {
    let frames = kernels_in::<T>().obb2_frames;
    let prepare = move |shapes: Tiles<'_, T>, out: &mut [Lane<T>]| frames(shapes, view, out);
    (view.fields::<T>(), Arc::new(prepare))
}

/// Returns the bounds of prepared rotated boxes.
fn obb2_bounds<T: Real>() -> Outline<T> {
    let bounds = kernels_in::<T>().obb2_bounds;
    Arc::new(move |[_, frames], out| bounds(frames, out))
}

/// Returns `true` if every rotated box is within the `COMMON_*` limits of `clip` and has an area. It has no branches,
/// so the compiler vectorises it.
fn all_solid<T: Real>(numbers: &[T]) -> bool {
    let solid = |all: bool, x: &[T]| all & x[2].above(T::default()) & x[3].above(T::default());
    (kernels_in::<T>().all_common_obb2)(numbers) && numbers.chunks_exact(OBB2).fold(true, solid)
}

/// Returns the plan of the generalised IoU of rotated boxes. Boxes that are apart have nonzero results, so there are no
/// bounds.
fn of_giou<T: Real>(mode: Mode) -> Plan<T> {
    let kernels = kernels_in::<T>();
    let shape = || Preparation {
        name: None,
        fields: OBB2,
        frame: Some(obb2_frames(View::Flat)),
        bounds: None,
        all_ordinary: Some(all_solid::<T>),
        check: |numbers| Obb2::load(numbers).validate(),
        is_rare: |numbers| !is_solid_obb2(numbers),
    };
    let maker = maker(
        mode,
        move |a, b, out| (kernels.giou_scores)(a, b, out),
        move |a, b, seeds, out| (kernels.giou_derivatives)(a, b, seeds, out),
    );
    let value = |a, b| giou_framed::<T, true>(clip::frame(a), clip::frame(b));
    let vjp = |a, b, out_bar| giou_framed_vjp::<T, true>(clip::frame(a), clip::frame(b), out_bar);
    score_of_two::<T, Obb2<T>>(mode, shape, maker, value, vjp)
}

/// Returns the plan of the intersection area of convex quadrilaterals.
fn of_quads<T: Real>(mode: Mode) -> Plan<T> {
    let kernels = kernels_in::<T>();
    let shape = || Preparation {
        name: None,
        fields: QUAD2,
        frame: None,
        bounds: None,
        all_ordinary: Some(kernels.all_convex_quads),
        check: |numbers| check_quad(<[Vec2<T>; 4]>::load(numbers)),
        is_rare: |numbers| {
            let most = T::lit(farthest::<T>());
            numbers.iter().any(|x| x.unsigned() > most)
        },
    };
    let maker = maker(
        mode,
        move |a, b, out| (kernels.quad_scores)(a, b, out),
        move |a, b, seeds, out| (kernels.quad_derivatives)(a, b, seeds, out),
    );
    let value = |a, b| area_of_quads_vjp::<T, true>(a, b, T::one()).0;
    score_of_two(mode, shape, maker, value, area_of_quads_vjp::<T, true>)
}

/// Returns the plan of a score of upright boxes.
fn of_upright<T: Real>(over: Denominator, mode: Mode) -> Plan<T> {
    let kernels = kernels_in::<T>();
    let shape = || Preparation {
        name: None,
        fields: UPRIGHT,
        frame: Some(obb2_frames(View::Upright)),
        bounds: Some(obb2_bounds()),
        all_ordinary: Some(kernels.all_common_upright),
        check: |numbers| YawBox3::load(numbers).validate(),
        is_rare: |numbers| !is_common_upright(numbers),
    };
    // First the area seen from above, then the heights.
    let maker = maker(
        mode,
        move |a, b, mut out| {
            (kernels.obb2_scores)(Denominator::None, a, b, out.again());
            (kernels.upright_scores)(over, a, b, out);
        },
        move |a, b, seeds, mut out| {
            (kernels.obb2_derivatives)(Denominator::None, a, b, None, out.again());
            (kernels.upright_derivatives)(over, a, b, seeds, out);
        },
    );
    let value = move |a: YawBox3<T>, b| score_yaw(over, a, b);
    score_of_two(mode, shape, maker, value, move |a, b, out_bar| {
        score_upright_vjp(over, a, b, out_bar)
    })
}

/// Returns the plan of a score of upright boxes seen from above.
fn of_birds_eye<T: Real>(over: Denominator, mode: Mode) -> Plan<T> {
    let kernels = kernels_in::<T>();
    let shape = || Preparation {
        name: None,
        fields: UPRIGHT,
        frame: Some(obb2_frames(View::FromAbove)),
        bounds: Some(obb2_bounds()),
        all_ordinary: Some(kernels.all_common_upright),
        check: |numbers| YawBox3::load(numbers).validate(),
        is_rare: |numbers| !clip::is_ordinary(YawBox3::load(numbers).birds_eye()),
    };
    let maker = maker(
        mode,
        move |a, b, out| (kernels.obb2_scores)(over, a, b, out),
        move |a, b, seeds, mut out| {
            (kernels.obb2_derivatives)(over, a, b, seeds, out.again());
            upright_boxes::extend_derivatives(&mut out);
        },
    );
    let flat = of_obb2::<T>(over, mode).rare;
    Plan {
        steepest: steepest::<T>(),
        rare: Some(Box::new(move |shapes, out_bar, out| {
            let Some(flat) = &flat else { return };
            let mut seen = [[T::default(); OBB2]; 2];
            for (seen, shape) in seen.iter_mut().zip(shapes) {
                YawBox3::load(shape).birds_eye().store(seen);
            }
            let seen = seen.each_ref().map(|numbers| &numbers[..]);
            if let [value] = out {
                flat(&seen, out_bar, std::slice::from_mut(value));
                return;
            }
            let mut numbers = [T::default(); 2 * OBB2 + 1];
            flat(&seen, out_bar, &mut numbers);
            out.fill(T::default());
            out[0] = numbers[0];
            for (k, place) in SEEN.into_iter().enumerate() {
                out[1 + place] = numbers[1 + k];
                out[1 + UPRIGHT + place] = numbers[1 + OBB2 + k];
            }
        })),
        ..Plan::new(mode, vec![shape(), shape()], vec![1], maker)
    }
}

/// Returns the plan of a score of boxes of any orientation in space.
fn of_obb3<T: Real>(over: Denominator, mode: Mode) -> Plan<T> {
    let kernels = kernels_in::<T>();
    let shape = || Preparation {
        name: None,
        fields: OBB3,
        frame: None,
        bounds: outline(Compiled::Obb3(over)),
        all_ordinary: Some(kernels.all_common_obb3),
        check: |numbers| Obb3::load(numbers).validate(),
        is_rare: |numbers| !is_common_obb3(numbers),
    };
    let maker = maker(
        mode,
        move |a, b, out| (kernels.obb3_scores)(over, a, b, out),
        move |a, b, seeds, out| (kernels.obb3_derivatives)(over, a, b, seeds, out),
    );
    let value = move |a: Obb3<T>, b| score_obb3(over, a, b);
    score_of_two(mode, shape, maker, value, move |a, b, out_bar| {
        score_obb3_vjp(over, a, b, out_bar)
    })
}

/// Returns the plan of a score of axis-aligned boxes.
fn of_aabb2<T: Real>(over: Denominator, mode: Mode) -> Plan<T> {
    let kernels = kernels_in::<T>();
    let shape = || Preparation {
        name: None,
        fields: AABB2,
        frame: None,
        // The bounds are the shape itself.
        bounds: Some(Arc::new(|[shapes, _], bounds| {
            bounds.copy_from_slice(&shapes.lanes[..bounds.len()]);
        })),
        all_ordinary: Some(kernels.all_aabb2),
        check: |numbers| Aabb2::load(numbers).validate(),
        is_rare: |_| false,
    };
    let maker = maker(
        mode,
        move |a, b, out| (kernels.aabb2_scores)(over, a, b, out),
        move |a, b, seeds, out| (kernels.aabb2_derivatives)(over, a, b, seeds, out),
    );
    let vjp = move |a, b, out_bar| score_aabb2_vjp(over, a, b, out_bar);
    let value = move |a: Aabb2<T>, b| vjp(a, b, T::one()).0;
    Plan {
        // These kernels take boxes of any size, so derivatives may be as large as the largest number: cotangents above
        // one take the scalar code.
        steepest: 1.0,
        ..score_of_two(mode, shape, maker, value, vjp)
    }
}
