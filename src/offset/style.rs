//! The look of offsets at corners and ends.
use crate::error::{Argument, Error, Field, Flaw};
use crate::polygon::Fill;

/// The piece between two moved edges at a corner that opens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Join {
    /// An arc about the vertex, as chords.
    Round,
    /// Both edges up to their crossing. A crossing farther than this many distances from the vertex is cut off there,
    /// straight across, as GEOS does; the limit is at least one.
    Mitre(f64),
    /// A straight line between both edges' ends.
    Bevel,
}

/// The piece at the ends of a path's offset.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum End {
    /// Half a circle, as chords.
    Round,
    /// A straight line through the end.
    Flat,
    /// A straight line, one distance beyond the end.
    Square,
}

/// The number of chords of an arc. They have one length, but for the last one of an arc, and lie inside of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Chords {
    /// So many per quarter of a turn, at least one.
    PerQuarter(u32),
    /// The fewest per quarter of a turn whose middles are within this length of the arc. The number is constant for
    /// derivatives and depends on the distance: results jump, by less than the tolerance, where it changes.
    Within(f64),
}

/// The most chords per quarter of a turn.
const MOST: u32 = 1 << 13;

/// The look of an offset, and the rule of its input.
///
/// ```
/// use geograd::offset::{Chords, End, Join, OffsetStyle};
/// let style = OffsetStyle { join: Join::Mitre(2.0), ..OffsetStyle::default() };
/// assert_eq!((style.end, style.chords, style.is_trusted), (End::Round, Chords::PerQuarter(16), false));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OffsetStyle {
    /// The corners: round.
    pub join: Join,
    /// The ends of paths: round.
    pub end: End,
    /// The chords of arcs: 16 per quarter of a turn.
    pub chords: Chords,
    /// The winding numbers that are inside of the polygon: odd ones, so that holes may run either way.
    pub fill: Fill,
    /// `true` if rings are taken as they are, without a union first: outer rings run counter-clockwise, holes
    /// clockwise, and none crosses another or itself. Other input has a result of no meaning.
    pub is_trusted: bool,
}

impl Default for OffsetStyle {
    fn default() -> Self {
        OffsetStyle {
            join: Join::Round,
            end: End::Round,
            chords: Chords::PerQuarter(16),
            fill: Fill::EvenOdd,
            is_trusted: false,
        }
    }
}

impl OffsetStyle {
    /// Returns the number of chords per quarter of a turn of a circle of this radius, from 1 to 8,192.
    ///
    /// ```
    /// use geograd::offset::{Chords, OffsetStyle};
    /// let style = OffsetStyle { chords: Chords::Within(0.01), ..OffsetStyle::default() };
    /// assert_eq!([0.01, 1.0, 100.0].map(|radius| style.quarter(radius)), [1, 6, 56]);
    /// ```
    #[must_use]
    pub fn quarter(&self, radius: f64) -> u32 {
        match self.chords {
            Chords::PerQuarter(count) => count.clamp(1, MOST),
            Chords::Within(tolerance) => {
                // The middle of a chord is radius · (1 − cos half) inside.
                let rest = 1.0 - tolerance / radius;
                if rest <= 0.0 {
                    return 1;
                }
                let sine = ((tolerance / radius) * (1.0 + rest)).sqrt();
                let half = crate::Scalar::atan2(sine, rest);
                let count = (std::f64::consts::FRAC_PI_4 / half - 1e-9).ceil();
                // A conversion saturates.
                (count as u32).clamp(1, MOST)
            }
        }
    }
    /// Returns `Ok` when all numbers are in range.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] with the style: a limit below one, no chords, a tolerance that is not positive.
    pub fn validate(&self) -> Result<(), Error> {
        let flaw = match (self.join, self.chords) {
            (Join::Mitre(limit), _) if !limit.is_finite() => Flaw::NotFinite(Field::new("limit")),
            (Join::Mitre(limit), _) if limit < 1.0 => {
                Flaw::Broken(Field::new("limit"), "is below one")
            }
            (_, Chords::PerQuarter(0)) => Flaw::NotPositive(Field::new("chords")),
            (_, Chords::Within(length)) if !length.is_finite() => {
                Flaw::NotFinite(Field::new("chords"))
            }
            (_, Chords::Within(length)) if length <= 0.0 => Flaw::NotPositive(Field::new("chords")),
            _ => return Ok(()),
        };
        Err(Error::Invalid {
            argument: Argument::Named("style"),
            item: 0,
            flaw,
        })
    }
}
