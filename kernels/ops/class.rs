//! Classes of invariance, and the invariances that they give rows.
use crate::kernels::ops::noun::{Moves, Noun, same};
use crate::kernels::row::op::{Effect, Invariance, Motion};

/// The effect of motions of the arguments on a result: a few words that expand to a list of invariances.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Class {
    shifts: Option<Effect>,
    turns: Option<Effect>,
    scaling: Option<Effect>,
    exchange: Option<Effect>,
}

impl Class {
    /// No invariance.
    pub const NONE: Class = Class {
        shifts: None,
        turns: None,
        scaling: None,
        exchange: None,
    };
    /// Returns the class with results that stay under shifts along all axes; nothing is declared for rotations and
    /// scaling.
    pub const fn shifts(self) -> Self {
        Class {
            shifts: Some(Effect::Stays),
            ..self
        }
    }
    /// Returns the class with results that stay under shifts and rotations; nothing is declared for scaling.
    pub const fn isometric(self) -> Self {
        Class {
            turns: Some(Effect::Stays),
            ..self.shifts()
        }
    }
    /// Returns the class with results that stay under shifts, rotations and scaling. The shapes decide which of these
    /// apply: shapes in the plane rotate about the origin, upright boxes about z, boxes of any orientation about all
    /// axes.
    pub const fn similar(self) -> Self {
        Class {
            scaling: Some(Effect::Stays),
            ..self.isometric()
        }
    }
    /// Returns the class with results that stay under shifts and rotations, and grow with a power of the scale.
    pub const fn rigid(self, power: i32) -> Self {
        Class {
            scaling: Some(Effect::Power(power)),
            ..self.isometric()
        }
    }
    /// Returns the class with results that move along, as their points, lengths and angles do.
    pub const fn follows(self) -> Self {
        Class {
            shifts: Some(Effect::Follows),
            turns: Some(Effect::Follows),
            scaling: Some(Effect::Follows),
            ..self
        }
    }
    /// Returns the class without rotations: the result depends on the coordinate axes.
    pub const fn along_axes(self) -> Self {
        Class {
            turns: None,
            ..self
        }
    }
    /// Returns the class without shifts: the result depends on the origin.
    pub const fn about_origin(self) -> Self {
        Class {
            shifts: None,
            ..self
        }
    }
    /// Returns the class with results that stay when two arguments of one kind are exchanged.
    pub const fn symmetric(self) -> Self {
        Class {
            exchange: Some(Effect::Stays),
            ..self
        }
    }
    /// Returns the invariances of this class for the motions that all arguments have.
    pub const fn invariances(self, arguments: &[Noun]) -> Invariances {
        let (mut moves, mut i) = (Moves::WITH_ALL, 0);
        while i < arguments.len() {
            moves = moves.and(arguments[i].moves);
            i += 1;
        }
        let Moves { shifts, turns } = moves;
        let alike = arguments.len() == 2 && same(arguments[0].one, arguments[1].one);
        Invariances::NONE
            .with(Motion::TranslationX, self.shifts, shifts[0])
            .with(Motion::TranslationY, self.shifts, shifts[1])
            .with(Motion::TranslationZ, self.shifts, shifts[2])
            .with(Motion::RotationX, self.turns, turns[0])
            .with(Motion::RotationY, self.turns, turns[1])
            .with(Motion::Rotation, self.turns, turns[2])
            .with(Motion::Scaling, self.scaling, true)
            .with(Motion::Exchange, self.exchange, alike)
    }
}

/// The number of motions.
const MOTIONS: usize = 8;

/// A list of invariances, at most one per motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Invariances {
    all: [Invariance; MOTIONS],
    count: usize,
}

impl Invariances {
    const NONE: Invariances = Invariances {
        all: [Invariance::new(Motion::Exchange, Effect::Stays); MOTIONS],
        count: 0,
    };
    const fn with(mut self, motion: Motion, answer: Option<Effect>, moves: bool) -> Self {
        if let (Some(answer), true) = (answer, moves) {
            self.all[self.count] = Invariance::new(motion, answer);
            self.count += 1;
        }
        self
    }
    /// Returns the invariances as a slice.
    pub const fn as_slice(&self) -> &[Invariance] {
        self.all.split_at(self.count).0
    }
}

/// Builds the invariances of a class, given its words and the types of the arguments.
macro_rules! invariances {
    ([$($word:ident $(($power:literal))?),*] $($type:ty),+) => {{
        const INVARIANCES: &crate::kernels::ops::class::Invariances =
            &crate::kernels::ops::class::Class::NONE $(.$word($($power)?))*
                .invariances(&[$(<$type as crate::kernels::ops::noun::Named>::NOUN),+]);
        INVARIANCES.as_slice()
    }};
}
pub(crate) use invariances;
