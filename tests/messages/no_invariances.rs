//~ `invariances […]` is missing after the formula: `invariances []` declares none
use geograd::operation;

operation! {
    /// Half of a number.
    pub Half = "half": (x: S) -> S { x.halved() }
    jumps Never
    derivative Reverse
}
