// The correct form of the other files.
use geograd::kernels::{ClosestPoints, Cpu, Op, function};
use geograd::{Error, Obb2, Program, Scalar, Sym, Vec2, operation};

pub fn derivatives(a: &[Obb2<f64>], b: &[Obb2<f64>]) -> Result<(), Error> {
    Cpu::new().aligned(ClosestPoints.jacobian(), (a, b))?;
    let corners = Program::trace(|b: Obb2<Sym<f64>>| b.corners())?;
    corners.jacobian().eval(a[0]);
    Ok(())
}

/// The names of plain numbers.
fn corner<S: Scalar>(b: Obb2<S>) -> Vec2<S> {
    let v = b.corners()[0];
    Vec2::new(v.x.abs().sqrt(), v.x.min(v.y).max(S::zero()))
}

pub fn of_a_function(b: &[Obb2<f64>]) -> Result<(), Error> {
    let (corners, by_box) = Cpu::new().aligned(function(corner).jacobian(), b)?;
    let _: (Vec2<f64>, Obb2<f64>) = (corners[0], by_box[0].x);
    Ok(())
}

pub fn twice<S: Scalar>(x: S) -> S {
    S::lit(2.0) * x
}

operation! {
    /// A ramp that chooses.
    pub Ramp = "ramp": (x: S) -> S { S::select(x.below(S::zero()), S::zero(), x) }
    invariances []
    jumps Never
    derivative Reverse
}
