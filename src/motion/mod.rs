//! Bodies in motion: when they meet, and how near they come.
//!
//! | item | is or gives |
//! | --- | --- |
//! | [`Motion3`] | a motion at constant velocity and turn, also from one pose to another, straight or along a screw |
//! | [`time_of_impact`] | the first time at which two moving bodies touch |
//! | [`clearance`] | the least distance along both motions, and its time |
//!
//! Times are from 0 to 1, the whole motion. Bodies are any two convex shapes of space with a pose: points,
//! [`Segment3`](crate::Segment3), [`Triangle3`](crate::Triangle3), [`Tetrahedron`](crate::Tetrahedron),
//! [`Obb3`](crate::Obb3), [`RoundBox3`](crate::RoundBox3), [`Sphere`](crate::Sphere), [`Capsule3`](crate::Capsule3),
//! [`Hull3`](crate::Hull3), [`Cylinder`](crate::Cylinder), [`Cone`](crate::Cone), [`Ellipsoid`](crate::Ellipsoid) and
//! [`Disc`](crate::Disc).
//!
//! ```
//! use geograd::motion::{Moves as _, Motion3};
//! use geograd::{Capsule3, Obb3, Rotation3, Vec3};
//! let wall = Obb3::new(Vec3::new(5.0, 0.0, 0.0), Vec3::new(0.001, 9.0, 9.0), Rotation3::identity());
//! let rod = Capsule3::new(Vec3::new(0.0_f64, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0), 0.25);
//! let throw = Motion3::straight(Vec3::new(1000.0, 0.0, 0.0)); // a thousand units: it is through in a step of 1/60
//! let impact = rod.time_of_impact(throw, wall, Motion3::still());
//! assert_eq!(impact.kind, 1.0);
//! assert!((impact.time - (4.9995 - 1.25) / 1000.0).abs() < 1e-15);
//! ```
//!
//! # The method
//!
//! The signed distance at a time is the largest gap along a direction. A fixed direction n has the gap
//! `g(t) = min n · b(t) − max n · a(t)`, a lower bound of the distance at every time. For one point of each body it has a
//! second derivative of at most `M = |ω_a|² r_a + |ω_b|² r_b`, with ω the turns and r the farthest points from their
//! centres. So over any times from s to t the gap is at least `min(g(s), g(t)) − M (t − s)²/8`. No body can pass another
//! one between the times that are looked at, however thin or fast. A direction that goes straight from the one at s to
//! the one at t has a bound of the same kind, with the change of the direction times the speed in M.
//!
//! [`time_of_impact`] advances by steps over which this bound of the present direction is positive, and ends where the
//! distance is some roundings of the coordinates. [`clearance`] divides the time, by the least bound first, until no
//! part can have a distance that is less than the least one found by more than 2⁻³⁰ of the size in `f64`, 2⁻¹² in `f32`,
//! and follows the least one to the end. That takes some forty distances, thousands where the distance is constant while
//! a body turns; it ends after 4,096 with the least one found.
//!
//! # Derivatives
//!
//! By the implicit function theorem the time of an impact has the derivative `−(∂f/∂θ)/(∂f/∂t)` with f the signed
//! distance: two Newton steps from the number that was found, so that second derivatives are right, too. A least
//! distance is of one of three kinds. At an end of the time it has the derivative of the distance at that time. Where the
//! rate is zero, two Newton steps by time make derivatives of both orders right. Where bodies overlap, the depth out of
//! one face may fall while that out of another rises: there the time follows the crossing of both, and derivatives are
//! shared by the rates. The time that is told has no derivative.
//!
//! Kinks: an impact that grazes, where bodies touch without approach, is a jump: the time has derivative zero there.
//! Bodies that touch at time 0 have time 0 with derivative zero. A miss has the largest finite number as its time, with
//! derivative zero. The derivatives of the distance at that time have the kinks of [`distance3`](crate::distance3). Of
//! several times with the least distance the first that was found counts. Where parallel faces meet, the point of an impact
//! is one of many: it has the derivative of the body that it is on. A face that stays parallel to another one has
//! the mean of their slopes, which is 0 by a turn where both sides are alike.
mod clearance;
mod impact;
mod minimum;
mod motion3;
mod moves;
mod moving;

pub use clearance::Clearance3;
pub use impact::Impact3;
pub use motion3::Motion3;
pub(crate) use moves::{
    ClearanceHints, ClearanceRecord, ImpactRecord, clearance_decided, clearance_replayed,
    impact_decided, impact_replayed,
};
pub use moves::{Moves, clearance, time_of_impact};
pub(crate) use moving::MovingPair;
