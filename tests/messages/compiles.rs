// The correct form of the other files.
use geograd::kernels::{ClosestPoints, Cpu, Op};
use geograd::{Error, Obb2, Program, Scalar, Sym, operation};

pub fn derivatives(a: &[Obb2<f64>], b: &[Obb2<f64>]) -> Result<(), Error> {
    Cpu::new().aligned(ClosestPoints.jacobian(), (a, b))?;
    let corners = Program::trace(|b: Obb2<Sym<f64>>| b.corners())?;
    corners.jacobian().eval(a[0]);
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
