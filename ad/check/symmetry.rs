//! Invariances of a function under motions, and what they imply for its derivatives.
//!
//! Where moving the input in a certain way changes the output in a known way, the derivative along
//! that motion is known too. Translation invariance: the derivatives of all positions sum to zero.
//! Rotation invariance: their torques balance. Homogeneity of degree p: Euler's `x · ∂y = p y`.

/// A motion of the whole input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Motion {
    /// Along x.
    TranslationX,
    /// Along y.
    TranslationY,
    /// About the origin.
    Rotation,
    /// Away from the origin.
    Scaling,
    /// Exchange of the two arguments.
    Exchange,
}

/// What a number of the input is, for the purpose of moving it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// The x of a point; its y follows.
    X,
    /// The y of a point; its x precedes.
    Y,
    /// A length, which only scaling changes.
    Length,
    /// An angle, which only rotation changes.
    Angle,
    /// The x of a direction, which only rotation changes; its y follows.
    DirectionX,
    /// The y of a direction; its x precedes.
    DirectionY,
    /// A number which no motion changes.
    Number,
}

impl Kind {
    /// Whether it is measured in units of length.
    #[must_use]
    pub fn is_length(self) -> bool {
        matches!(self, Kind::X | Kind::Y | Kind::Length)
    }
}

/// How the output answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Answer {
    /// It stays.
    Stays,
    /// Every number grows with this power of the scale.
    Power(i32),
    /// It moves along, as what it is made of does: points, lengths, angles.
    Follows,
}

/// A declared property of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Invariance {
    /// How the input moves.
    pub motion: Motion,
    /// What the output does.
    pub answer: Answer,
}

impl Invariance {
    /// That such a motion has such an answer.
    #[must_use]
    pub const fn new(motion: Motion, answer: Answer) -> Self {
        Invariance { motion, answer }
    }
}

/// The velocity of numbers of the given kinds under a motion of unit speed.
#[must_use]
pub fn velocity(motion: Motion, kinds: &[Kind], x: &[f64]) -> Vec<f64> {
    (0..x.len())
        .map(|i| match (motion, kinds[i]) {
            (Motion::TranslationX, Kind::X)
            | (Motion::TranslationY, Kind::Y)
            | (Motion::Rotation, Kind::Angle) => 1.0,
            (Motion::Rotation, Kind::X | Kind::DirectionX) => -x[i + 1],
            (Motion::Rotation, Kind::Y | Kind::DirectionY) => x[i - 1],
            (Motion::Scaling, Kind::X | Kind::Y | Kind::Length) => x[i],
            _ => 0.0,
        })
        .collect()
}

/// The velocity of the output that the answer declares, when its numbers are of these kinds.
#[must_use]
pub fn answer(invariance: Invariance, kinds: &[Kind], y: &[f64]) -> Vec<f64> {
    match invariance.answer {
        Answer::Stays => vec![0.0; y.len()],
        Answer::Power(p) => y.iter().map(|y| f64::from(p) * y).collect(),
        Answer::Follows => velocity(invariance.motion, kinds, y),
    }
}

/// The input with its two halves exchanged.
#[must_use]
pub fn exchanged(x: &[f64]) -> Vec<f64> {
    let (a, b) = x.split_at(x.len() / 2);
    [b, a].concat()
}

/// Moves numbers of the given kinds by a finite amount.
#[must_use]
pub fn moved_by(motion: Motion, amount: f64, kinds: &[Kind], x: &[f64]) -> Vec<f64> {
    use crate::ad::check::sample::moved;
    match motion {
        Motion::TranslationX => moved(x, kinds, 0.0, 1.0, [amount, 0.0]),
        Motion::TranslationY => moved(x, kinds, 0.0, 1.0, [0.0, amount]),
        Motion::Rotation => moved(x, kinds, amount, 1.0, [0.0, 0.0]),
        Motion::Scaling => moved(x, kinds, 0.0, amount, [0.0, 0.0]),
        Motion::Exchange => exchanged(x),
    }
}
