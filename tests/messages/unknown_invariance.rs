//~ no variant or associated item named `Turns` found for enum `Motion`
use geograd::operation;

operation! {
    /// Half of a number.
    pub Half = "half": (x: S) -> S { x.halved() }
    invariances [Turns Stays]
    jumps Never
    derivative Reverse
}
