//~ `derivative …` is missing, the last clause: `derivative Reverse`, `derivative Forward` or
use geograd::operation;

operation! {
    /// Half of a number.
    pub Half = "half": (x: S) -> S { x.halved() }
    invariances []
    jumps Never
}
