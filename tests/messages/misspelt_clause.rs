//~ no rules expected `jump`
//~ `jumps …` is missing before `derivative`
use geograd::operation;

operation! {
    /// Half of a number.
    pub Half = "half": (x: S) -> S { x.halved() }
    invariances []
    jump Never
    derivative Reverse
}
