//~ no rules expected `range`
//~ range RATIO
use geograd::operation;

operation! {
    /// Half of a number.
    pub Half = "half": (x: S) -> S { x.halved() }
    invariances []
    jumps Never
    range RATIO
    derivative Reverse
}
