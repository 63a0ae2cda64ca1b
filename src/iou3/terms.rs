//! Parts of scores of boxes in space.

/// Terms of scores that come from an overlap: numbers without a unit, by the shape around two boxes.
#[derive(Clone, Copy, Debug)]
pub struct Terms<S> {
    /// The share of the volume of the enclosing shape that neither box covers, in `[0, 1]`: GIoU's.
    pub outside: S,
    /// The square of the centres' distance over the enclosing shape's diameter, in `[0, 1]`: DIoU's.
    pub way: S,
    /// The sum of the squares of the differences of the sizes over lengths of the enclosing shape: EIoU's.
    pub gaps: S,
}
