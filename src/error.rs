//! What can be wrong with an input, as data.
use std::fmt;

/// Which argument of a call is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Argument {
    /// The only shape of a constructor or a validation.
    Shape,
    /// The first list of shapes.
    A,
    /// The second list of shapes.
    B,
    /// The vertices of a ragged batch.
    Vertices,
    /// The offsets of a ragged batch.
    Offsets,
    /// The gradient that comes from above, one number per result.
    Upstream,
    /// The threshold of a reduction.
    Threshold,
    /// The caller's buffer for results.
    Values,
    /// The caller's buffer for gradients of the first list.
    GradA,
    /// The caller's buffer for gradients of the second list.
    GradB,
    /// The caller's buffer for gradients of the vertices.
    GradVertices,
}

impl fmt::Display for Argument {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Argument::Shape => "shape",
            Argument::A => "a",
            Argument::B => "b",
            Argument::Vertices => "vertices",
            Argument::Offsets => "offsets",
            Argument::Upstream => "upstream",
            Argument::Threshold => "threshold",
            Argument::Values => "values",
            Argument::GradA => "grad_a",
            Argument::GradB => "grad_b",
            Argument::GradVertices => "grad_vertices",
        })
    }
}

/// Which field of a shape is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Field {
    /// A lone number.
    Value,
    /// The x coordinate (of the centre, if the shape has one).
    X,
    /// The y coordinate (of the centre, if the shape has one).
    Y,
    /// The size along the shape's own x axis.
    Width,
    /// The size along the shape's own y axis.
    Height,
    /// The heading.
    Heading,
    /// The lower x bound.
    MinX,
    /// The lower y bound.
    MinY,
    /// The upper x bound.
    MaxX,
    /// The upper y bound.
    MaxY,
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Field::Value => "value",
            Field::X => "x",
            Field::Y => "y",
            Field::Width => "width",
            Field::Height => "height",
            Field::Heading => "heading",
            Field::MinX => "min.x",
            Field::MinY => "min.y",
            Field::MaxX => "max.x",
            Field::MaxY => "max.y",
        })
    }
}

/// Why a shape is not valid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Flaw {
    /// A field is NaN or infinite.
    NotFinite(Field),
    /// A size is below zero.
    Negative(Field),
    /// A lower bound is above its upper bound.
    Inverted(Field),
    /// A vertex of a polygon breaks a rule.
    Vertex {
        /// The vertex, from zero.
        index: usize,
        /// The rule.
        fault: VertexFault,
    },
}

/// What is wrong with a vertex of a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum VertexFault {
    /// A coordinate is NaN or infinite.
    NotFinite,
    /// The polygon needs this vertex and does not have it: fewer than three (distinct) vertices.
    Missing,
    /// The vertex does not fit into the polygon's capacity.
    Surplus,
    /// The next vertex is at the same place.
    Repeated,
    /// The vertex is on the line through its neighbours.
    Straight,
    /// The border turns clockwise here.
    Clockwise,
    /// The border is about to run around the polygon a second time.
    SecondRound,
}

impl fmt::Display for VertexFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            VertexFault::NotFinite => "has a coordinate that is not a finite number",
            VertexFault::Missing => "is missing",
            VertexFault::Surplus => "is beyond the polygon's capacity",
            VertexFault::Repeated => "is repeated by the next one",
            VertexFault::Straight => "is on the line through its neighbours",
            VertexFault::Clockwise => "turns clockwise",
            VertexFault::SecondRound => "starts a second round",
        })
    }
}

impl fmt::Display for Flaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Flaw::NotFinite(field) => write!(f, "{field} is not a finite number"),
            Flaw::Negative(field) => write!(f, "{field} is negative"),
            Flaw::Inverted(field) => write!(f, "{field} is above its upper bound"),
            Flaw::Vertex { index, fault } => write!(f, "vertex {index} {fault}"),
        }
    }
}

impl std::error::Error for Flaw {}

/// Why a call was refused. Nothing was computed and no buffer was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Error {
    /// An argument has the wrong number of items.
    Length {
        /// The argument.
        argument: Argument,
        /// How many items the other arguments call for.
        expected: usize,
        /// How many it has.
        found: usize,
    },
    /// A row of an argument is not a valid shape.
    Invalid {
        /// The argument.
        argument: Argument,
        /// The row, from zero.
        row: usize,
        /// What is wrong with it.
        flaw: Flaw,
    },
    /// The offsets of a ragged batch decrease at this row, do not start at zero (row 0) or do not
    /// end at the number of vertices (last row).
    Offsets {
        /// The index into the offsets.
        row: usize,
    },
    /// The number of results does not fit in memory.
    TooLarge,
    /// The environment variable `GEOGRAD_SIMD`, or a call, asks for a level of vector instructions that
    /// is unknown or that this processor lacks.
    Simd,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Length {
                argument,
                expected,
                found,
            } => {
                write!(
                    f,
                    "`{argument}` has {found} items where {expected} are needed"
                )
            }
            // A threshold is one number.
            Error::Invalid {
                argument: Argument::Threshold,
                flaw,
                ..
            } => write!(f, "`threshold`: {flaw}"),
            Error::Invalid {
                argument,
                row,
                flaw,
            } => {
                write!(f, "`{argument}` row {row}: {flaw}")
            }
            Error::Offsets { row } => {
                write!(
                    f,
                    "`offsets` row {row}: offsets go from 0 to the number of vertices and never decrease"
                )
            }
            Error::TooLarge => f.write_str("more results than memory can hold"),
            Error::Simd => f.write_str(
                "vector instructions were asked for that are unknown or that this processor lacks \
                 (GEOGRAD_SIMD is one of baseline, avx2, v4)",
            ),
        }
    }
}

impl std::error::Error for Error {}

/// Shapes that can say what is wrong with them.
pub trait Validate {
    /// `Ok` when every field is finite and the shape's own rules hold.
    ///
    /// # Errors
    ///
    /// The first flaw found, in the order of the fields.
    fn validate(&self) -> Result<(), Flaw>;
}

/// `Ok` for a finite number.
#[inline(always)]
pub(crate) fn finite<S: crate::Scalar<Mask = bool>>(x: S, field: Field) -> Result<(), Flaw> {
    if x.finite() {
        Ok(())
    } else {
        Err(Flaw::NotFinite(field))
    }
}
