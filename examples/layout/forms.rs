//! The shapes, and how far they are apart.
use common::random::Draw;
use geograd::distance::signed_distance;
use geograd::{Aabb2, Capsule2, Circle, Obb2, Pose2, Scalar, Triangle2, Vec2};

/// Half the width and half the height of the container, whose centre is the origin.
pub const CONTAINER: [f64; 2] = [2.6, 1.8];
/// How far apart shapes and walls are to be.
pub const CLEARANCE: f64 = 0.06;
/// The kind of a shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Disc,
    Stick,
    Crate,
    Wedge,
}

/// The sizes of a shape, in its own frame: a disc's radius; half the length of a stick without its caps, and
/// its radius; a crate's width and height; the corners of a wedge, counter-clockwise. Zeros fill the rest.
pub type Size<S> = [S; 6];

/// A shape in its own frame.
#[derive(Clone, Copy, Debug)]
pub struct Form {
    pub kind: Kind,
    pub size: Size<f64>,
}

/// The place of a shape: x, y, heading.
pub type Place<S> = [S; 3];

/// A shape in the container.
#[derive(Clone, Copy, Debug)]
pub enum Placed<S> {
    Disc(Circle<S>),
    Stick(Capsule2<S>),
    Crate(Obb2<S>),
    Wedge(Triangle2<S>),
}

impl Kind {
    pub const ALL: [Kind; 4] = [Kind::Disc, Kind::Stick, Kind::Crate, Kind::Wedge];

    /// A shape of this kind at a place.
    pub fn at<S: Scalar>(self, size: Size<S>, [x, y, heading]: Place<S>) -> Placed<S> {
        let pose = Pose2::new(Vec2::new(x, y), heading);
        let [a, b, c, d, e, f] = size;
        match self {
            Kind::Disc => Placed::Disc(Circle::new(pose.translation, a)),
            Kind::Stick => {
                let end = |x| pose * Vec2::new(x, S::zero());
                Placed::Stick(Capsule2::new(end(-a), end(a), b))
            }
            Kind::Crate => Placed::Crate(Obb2::new(x, y, a, b, heading)),
            Kind::Wedge => {
                let corner = |x, y| pose * Vec2::new(x, y);
                Placed::Wedge(Triangle2::new(corner(a, b), corner(c, d), corner(e, f)))
            }
        }
    }
}

impl Form {
    pub fn random(kind: Kind, draw: &mut Draw) -> Self {
        let mut between = |low: f64, high: f64| low + (high - low) * f64::from(draw.uniform());
        let mut size = [0.0; 6];
        match kind {
            Kind::Disc => size[0] = between(0.35, 0.6),
            Kind::Stick => (size[0], size[1]) = (between(0.4, 0.8), between(0.15, 0.3)),
            Kind::Crate => (size[0], size[1]) = (between(0.8, 1.6), between(0.6, 1.0)),
            Kind::Wedge => {
                let reach = between(0.6, 0.95);
                for (corner, turn) in size.chunks_exact_mut(2).zip([0.4, 2.5, 4.6]) {
                    let angle: f64 = turn + between(-0.35, 0.35);
                    corner.copy_from_slice(&[reach * angle.cos(), reach * angle.sin()]);
                }
            }
        }
        Form { kind, size }
    }

    /// Its area.
    pub fn area(self) -> f64 {
        match self.at([0.0; 3]) {
            Placed::Disc(disc) => disc.area(),
            Placed::Stick(stick) => stick.area(),
            Placed::Crate(rectangle) => rectangle.area(),
            Placed::Wedge(wedge) => wedge.area(),
        }
    }

    /// The shape at a place.
    pub fn at(self, place: Place<f64>) -> Placed<f64> {
        self.kind.at(self.size, place)
    }
}

impl<S: Scalar> Placed<S> {
    fn bounding(self) -> Aabb2<S> {
        match self {
            Placed::Disc(disc) => disc.bounding(),
            Placed::Stick(stick) => stick.bounding(),
            Placed::Crate(rectangle) => rectangle.bounding(),
            Placed::Wedge(wedge) => wedge.bounding(),
        }
    }

    /// The distance from another shape, or minus the depth of their overlap.
    pub fn gap(self, other: Self) -> S {
        use Placed::{Crate, Disc, Stick, Wedge};
        match (self, other) {
            (Disc(a), Disc(b)) => signed_distance(a, b),
            (Disc(a), Stick(b)) | (Stick(b), Disc(a)) => signed_distance(a, b),
            (Disc(a), Crate(b)) | (Crate(b), Disc(a)) => signed_distance(a, b),
            (Disc(a), Wedge(b)) | (Wedge(b), Disc(a)) => signed_distance(a, b),
            (Stick(a), Stick(b)) => signed_distance(a, b),
            (Stick(a), Crate(b)) | (Crate(b), Stick(a)) => signed_distance(a, b),
            (Stick(a), Wedge(b)) | (Wedge(b), Stick(a)) => signed_distance(a, b),
            (Crate(a), Crate(b)) => signed_distance(a, b),
            (Crate(a), Wedge(b)) | (Wedge(b), Crate(a)) => signed_distance(a, b),
            (Wedge(a), Wedge(b)) => signed_distance(a, b),
        }
    }

    /// The distances from the four walls, negative beyond them.
    pub fn room(self) -> [S; 4] {
        let bounds = self.bounding();
        let [width, height] = CONTAINER.map(S::lit);
        [
            bounds.min.x + width,
            bounds.min.y + height,
            width - bounds.max.x,
            height - bounds.max.y,
        ]
    }
}

/// The cost of a gap: zero if it is wide enough, else the square of the missing width.
pub fn cost<S: Scalar>(gap: S) -> S {
    let lack = (S::lit(CLEARANCE) - gap).most(S::zero());
    lack * lack
}

/// How well shapes lie.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// The sum of the costs of all gaps.
    pub loss: f64,
    /// How deep the worst pair is in each other, or a shape in a wall.
    pub penetration: f64,
}
