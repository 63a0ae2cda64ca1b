//! Declared properties of functions as data: the motions of numbers, the answers of results, and where values may jump.
//!
//! The [`Kind`] of each number of a shape determines its motion. Numbers that only move together, such as the
//! coordinates of a point or the four numbers of a quaternion, have kinds of their own and follow one another.

/// A motion of the whole input, in the world's axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Motion {
    /// Along x.
    TranslationX,
    /// Along y.
    TranslationY,
    /// Along z; shapes of the plane do not move.
    TranslationZ,
    /// About the x axis, from y to z; shapes of the plane do not turn.
    RotationX,
    /// About the y axis, from z to x; shapes of the plane do not turn.
    RotationY,
    /// About the origin of the plane, or about the z axis, from x to y.
    Rotation,
    /// Away from the origin.
    Scaling,
    /// Exchange of the two arguments.
    Exchange,
}

/// The meaning of a number of the input for motions.
///
/// Kinds of a group follow one another in the order of this list: `X`, `Y` and in space `Z`. Only a whole group turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// The x of a point.
    X,
    /// The y of a point.
    Y,
    /// The z of a point.
    Z,
    /// A length, which only scaling changes.
    Length,
    /// An angle about z, or of the plane, which only a turn about z changes.
    Angle,
    /// An angle about x, which only a turn about x changes.
    AngleX,
    /// An angle about y, which only a turn about y changes.
    AngleY,
    /// The x of a direction, which only turns change.
    DirectionX,
    /// The y of a direction.
    DirectionY,
    /// The z of a direction.
    DirectionZ,
    /// The inner product of a direction, whose numbers precede, with any point of a line or plane. Shifts along the
    /// direction and scaling change it.
    Offset,
    /// The real part of the quaternion of a rotation, which only turns change.
    QuaternionW,
    /// Its part along x.
    QuaternionX,
    /// Its part along y.
    QuaternionY,
    /// Its part along z.
    QuaternionZ,
    /// The x of a rotation vector, the axis times the angle in radians, which only turns change.
    RotationVectorX,
    /// Its y.
    RotationVectorY,
    /// Its z.
    RotationVectorZ,
    /// A number which no motion changes.
    Number,
}

impl Kind {
    /// Returns `true` for everything that is measured in units of length.
    #[must_use]
    pub fn is_length(self) -> bool {
        matches!(
            self,
            Kind::X | Kind::Y | Kind::Z | Kind::Length | Kind::Offset
        )
    }
    /// Returns `true` for a coordinate of a point.
    #[must_use]
    pub fn is_place(self) -> bool {
        matches!(self, Kind::X | Kind::Y | Kind::Z)
    }
    /// Returns `true` for angles, directions and rotation vectors, whose own unit is one.
    pub(crate) fn is_measured_at_one(self) -> bool {
        let is_direction = matches!(self, Kind::DirectionX | Kind::DirectionY | Kind::DirectionZ);
        let is_vector = matches!(
            self,
            Kind::RotationVectorX | Kind::RotationVectorY | Kind::RotationVectorZ
        );
        self.is_angle() || is_direction || is_vector
    }
    /// Returns `true` for an angle in radians.
    #[must_use]
    pub fn is_angle(self) -> bool {
        matches!(self, Kind::Angle | Kind::AngleX | Kind::AngleY)
    }
}

/// The effect of a motion of the input on the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Effect {
    /// It stays.
    Stays,
    /// Every number grows with this power of the scale.
    Power(i32),
    /// It moves as its points, lengths and angles do.
    Follows,
}

/// A declared property of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Invariance {
    /// The motion of the input.
    pub motion: Motion,
    /// The effect of a motion of the input on the result.
    pub answer: Effect,
}

impl Invariance {
    /// Returns the property that this motion has this answer.
    #[must_use]
    pub const fn new(motion: Motion, answer: Effect) -> Self {
        Invariance { motion, answer }
    }
}

/// Places at which a function may jump.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Jumps {
    /// Nowhere.
    #[default]
    Never,
    /// At inputs with a value of exactly zero.
    FromZero,
    /// Anywhere.
    Anywhere,
}
