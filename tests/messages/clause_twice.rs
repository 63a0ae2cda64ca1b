//~ no rules expected `jumps`
//~ jumps FromZero
use geograd::operation;

operation! {
    /// Half of a number.
    pub Half = "half": (x: S) -> S { x.halved() }
    invariances []
    jumps Never
    jumps FromZero
    derivative Reverse
}
