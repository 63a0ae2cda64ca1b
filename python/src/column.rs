//! Arguments and results, and the kinds of their shapes.

/// The index of a shape in the table.
pub type Kind = u16;
/// A lone number, which has no axis of its own.
pub const NUMBER: Kind = 0;
/// Paths, which have vertices and offsets, in the plane and in space.
pub const RING: Kind = 1;
pub const POLYLINE: Kind = 2;
pub const POLYLINE3: Kind = 3;
pub const CLOUD3: Kind = 4;
/// Numbers without a shape.
pub const NUMBERS: Kind = Kind::MAX;

/// An argument or a result.
#[derive(Clone, Debug)]
pub struct Column {
    pub name: String,
    pub kind: Kind,
    /// The axes of the numbers of a row: none for a lone number, two for a matrix.
    pub axes: Vec<usize>,
}

impl Column {
    /// Returns the number of scalars of a row.
    pub fn fields(&self) -> usize {
        self.axes.iter().product()
    }
}
