//~ `jumps …` is missing before `derivative`: `jumps Never`, `jumps FromZero` or `jumps Anywhere`
use geograd::operation;

operation! {
    /// Half of a number.
    pub Half = "half": (x: S) -> S { x.halved() }
    invariances []
    derivative Reverse
}
