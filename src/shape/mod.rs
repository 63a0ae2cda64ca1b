//! Shapes of the plane: lines, rays, segments, triangles, circles, capsules, and intervals.
use crate::error::{Field, Flaw};
use crate::{Scalar, Vec2};

pub mod capsule;
pub mod circle;
pub mod interval;
pub mod line;
pub mod ray;
pub mod segment;
pub mod triangle;

/// `Ok` for a point whose coordinates are finite numbers.
fn finite_point<S: Scalar<Mask = bool>>(point: Vec2<S>, x: Field, y: Field) -> Result<(), Flaw> {
    finite_number(point.x, x)?;
    finite_number(point.y, y)
}

/// `Ok` for a finite number.
fn finite_number<S: Scalar<Mask = bool>>(number: S, field: Field) -> Result<(), Flaw> {
    if number.finite() {
        Ok(())
    } else {
        Err(Flaw::NotFinite(field))
    }
}

/// `Ok` for a finite number that is not below zero.
fn radius_number<S: Scalar<Mask = bool>>(number: S) -> Result<(), Flaw> {
    finite_number(number, Field::Radius)?;
    if number.below(S::zero()) {
        return Err(Flaw::Negative(Field::Radius));
    }
    Ok(())
}

/// `Ok` for a finite vector that is not zero.
fn direction_vector<S: Scalar<Mask = bool>>(direction: Vec2<S>) -> Result<(), Flaw> {
    finite_point(direction, Field::DirectionX, Field::DirectionY)?;
    if direction.x.equals(S::zero()) && direction.y.equals(S::zero()) {
        return Err(Flaw::Zero(Field::Direction));
    }
    Ok(())
}
