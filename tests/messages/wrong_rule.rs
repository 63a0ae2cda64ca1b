//~ a field of a shape knows `non_negative`, `positive`, `non_zero`, `at_most = "field"`, `differs_from = "field"`
//~ `count` is a count or code: rules are of scalars
//~ there is no field `tail`
//~ `head` is compared with `head`: name another field of scalars
//~ a shape knows `non_zero`, `bounding`, `validate = function`
use geograd::prelude::*;

#[derive(Clone, Copy, Debug, PartialEq, geograd::Shape)]
pub struct Mast<S> {
    #[shape(nonzero)]
    pub up: Vec3<S>,
}

#[derive(Clone, Copy, Debug, PartialEq, geograd::Shape)]
pub struct Ticks<S> {
    pub step: S,
    #[shape(code, non_zero)]
    pub count: u16,
}

#[derive(Clone, Copy, Debug, PartialEq, geograd::Shape)]
pub struct Arrow<S> {
    #[shape(differs_from = "tail")]
    pub head: Vec2<S>,
}

#[derive(Clone, Copy, Debug, PartialEq, geograd::Shape)]
pub struct Ring<S> {
    #[shape(differs_from = "head")]
    pub head: Vec2<S>,
}

#[derive(Clone, Copy, Debug, PartialEq, geograd::Shape)]
#[shape(positive)]
pub struct Sizes<S> {
    pub both: Vec2<S>,
}
