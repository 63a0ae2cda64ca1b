//~ an operation begins with its name, arguments, result and formula
use geograd::operation;

operation! {
    /// Half of a number.
    pub Half = "half": (x: S) { x.halved() }
    invariances []
    jumps Never
    derivative Reverse
}
