//~ `.value_grad()` needs one number as result, and `[Vec2<f64>; 4]` is none
//~ `.jacobian()` gives the gradient of every number of a result
use geograd::{Error, Obb2, Program, Sym};

pub fn derivatives(shape: Obb2<f64>) -> Result<(), Error> {
    let corners = Program::trace(|b: Obb2<Sym<f64>>| b.corners())?;
    corners.value_grad().eval(shape);
    Ok(())
}
