//! Programs as shaders: accepted, whatever they were recorded from.
use crate::validate;
use geograd::ad::program::{Program, Sym, WGSL};
use geograd::{Aabb2, Fixed, Obb2, Scalar, Vec2, ad};

/// The program's function, in a shader that calls it.
fn accepted<In, Out>(name: &str, program: &Program<In, Out>)
where
    In: Fixed<Scalar = f32>,
    Out: Fixed<Scalar = f32>,
{
    let function = program.wgsl(name).expect("a name like any other");
    let (inputs, outputs) = (In::LEN, Out::LEN);
    let shader = format!(
        "{WGSL}{function}
@group(0) @binding(0) var<storage, read> items: array<array<f32, {inputs}>>;
@group(0) @binding(1) var<storage, read_write> results: array<array<f32, {outputs}>>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {{
    results[id.x] = {name}(items[id.x]);
}}
"
    );
    validate(name, &shader);
    let lets = function.lines().count() - 3;
    assert!(
        lets >= program.cost().total(),
        "one line for every operation"
    );
}

type Boxes = (Obb2<Sym<f32>>, Obb2<Sym<f32>>);

#[test]
fn functions_of_programs_are_accepted() {
    let iou = Program::trace(|(a, b): Boxes| a.iou(b)).unwrap();
    accepted("iou", &iou);
    accepted("iou_grad", &iou.value_grad());
    accepted("iou_vjp", &iou.vjp());
    accepted("iou_hvp", &iou.hvp());
    accepted("iou_hessian", &iou.hessian::<10>());
    let by_hand = iou.with_adjoint(|(a, b): Boxes| ad::adjoint::overlap::iou_obb2_grad(a, b).1);
    accepted("iou_by_hand", &by_hand.unwrap().value_grad());
    let bounds = |(a, b): (Aabb2<Sym<f32>>, Aabb2<Sym<f32>>)| a.intersection_area(b);
    accepted("area", &Program::trace(bounds).unwrap().value_grad());
    let corners = |x: [Vec2<Sym<f32>>; 4]| Obb2::from_corners(x);
    accepted("from_corners", &Program::trace(corners).unwrap().vjp());
}

#[test]
fn every_operation_is_accepted() {
    let everything = |[a, b, c]: [Sym<f32>; 3]| {
        let [(sin_high, sin_low), (cos_high, cos_low)] = a.sin_cos_parts();
        let parts = sin_high * sin_low + cos_high * cos_low + b.parts().0 * b.parts().1;
        let kinks = a.least(b).most(c).magnitude() + b.unsigned() + c.clamp(a, b);
        let smooth = a.exp() + b.ln() + a.atan2(c) + a.tan() + c.root() + a.hypot(b).binade();
        let mask = (a.below(b) & b.at_most(c)) | !a.equals(c);
        let rest = Sym::select(mask, parts, -kinks) / smooth;
        // Constants of every kind, and operations on constants that overflow.
        let tiny = Sym::lit(1e-45) + Sym::lit(f64::from(f32::MAX)) * c;
        let overflow = Sym::one() / (Sym::zero() * Sym::one());
        rest + tiny
            + Sym::select(a.below(b), overflow, c)
            + (Sym::lit(f64::from(f32::MAX)) * Sym::lit(2.0)).least(a)
    };
    let program = Program::trace(everything).unwrap();
    accepted("everything", &program);
    accepted("everything_grad", &program.value_grad());
    accepted("everything_hessian", &program.hessian::<3>());
}
