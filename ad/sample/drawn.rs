//! Inputs without their types, so that the code that judges them is compiled once, and not for every type of input.
use crate::ad::declared::Kind;
#[cfg(feature = "check")]
use crate::ad::sample::lattice::lattice;
use crate::ad::sample::{Draw, Family, PLACES, Placement, Sample, moved};
use std::any::Any;

/// The properties of the shapes of an input, at numbers like its own.
pub(crate) trait Near {
    fn kinds(&self) -> Vec<Kind>;
    fn inside(&self, x: &[f64]) -> bool;
    fn scales(&self, x: &[f64]) -> Vec<f64>;
    fn units(&self, x: &[f64]) -> Vec<f64>;
    fn extents(&self, x: &[f64]) -> Vec<f64>;
}

impl<X: Sample> Near for X {
    fn kinds(&self) -> Vec<Kind> {
        Sample::kinds(self)
    }
    fn inside(&self, x: &[f64]) -> bool {
        Sample::inside(&self.refill(x))
    }
    fn scales(&self, x: &[f64]) -> Vec<f64> {
        Sample::scales(&self.refill(x))
    }
    fn units(&self, x: &[f64]) -> Vec<f64> {
        Sample::units(&self.refill(x))
    }
    fn extents(&self, x: &[f64]) -> Vec<f64> {
        Sample::extents(&self.refill(x))
    }
}

/// An input that was drawn.
pub(crate) trait Drawn: Near {
    fn numbers(&self) -> Vec<f64>;
    /// Returns these shapes with other numbers.
    fn refilled(&self, numbers: &[f64]) -> Box<dyn Drawn>;
    /// Returns inputs with fewer shapes in their lists.
    fn fewer(&self) -> Box<dyn Iterator<Item = Box<dyn Drawn>> + '_>;
    fn is_inside(&self) -> bool;
    fn outlines(&self) -> Vec<Vec<[f64; 2]>>;
    /// Returns the input as code.
    fn code(&self) -> String;
    fn as_any(&self) -> &dyn Any;
    fn near(&self) -> &dyn Near;
}

impl<X: Sample> Drawn for X {
    fn numbers(&self) -> Vec<f64> {
        self.scalars()
    }
    fn refilled(&self, numbers: &[f64]) -> Box<dyn Drawn> {
        Box::new(self.refill(numbers))
    }
    fn fewer(&self) -> Box<dyn Iterator<Item = Box<dyn Drawn>> + '_> {
        // Shapes of fixed size have none, and code for them would be compiled for every type.
        if !X::LISTS {
            return Box::new(std::iter::empty());
        }
        let all = crate::Pack::fewer(self);
        Box::new(all.map(|x| Box::new(x) as Box<dyn Drawn>))
    }
    fn is_inside(&self) -> bool {
        Sample::inside(self)
    }
    fn outlines(&self) -> Vec<Vec<[f64; 2]>> {
        Sample::outlines(self)
    }
    fn code(&self) -> String {
        code::<X>(&format!("{self:?}"))
    }
    fn as_any(&self) -> &dyn Any {
        self
    }
    fn near(&self) -> &dyn Near {
        self
    }
}

/// Returns the text of an input as code.
pub(crate) fn code<X>(text: &str) -> String {
    as_code(std::any::type_name::<X>(), text)
}
fn as_code(name: &str, text: &str) -> String {
    if name.contains("Vec<") && !name.contains('[') {
        // Every list is one of run-time length.
        text.replace('[', "vec![")
    } else if name.starts_with("alloc::vec::Vec") {
        format!("vec!{text}")
    } else {
        text.to_owned()
    }
}

/// The inputs of one type.
#[derive(Clone, Copy)]
pub(crate) struct Kinship {
    hard: fn() -> Vec<Box<dyn Drawn>>,
    draw: fn(&mut Draw) -> Box<dyn Drawn>,
    ordinary: fn(&mut Draw) -> Box<dyn Drawn>,
    thin: fn(&mut Draw) -> Box<dyn Drawn>,
    touching: fn(&mut Draw) -> Box<dyn Drawn>,
}

/// Returns an input in its type.
pub(crate) fn typed<X: Sample>(x: &dyn Drawn) -> X {
    match x.as_any().downcast_ref::<X>() {
        Some(x) => x.clone(),
        None => unreachable!("an input has the type that drew it"),
    }
}

impl Kinship {
    pub(crate) const fn of<X: Sample>() -> Self {
        Kinship {
            // A loop, since every adapter of an iterator is compiled for every type.
            hard: || {
                let mut all: Vec<Box<dyn Drawn>> = Vec::new();
                for x in X::hard() {
                    all.push(Box::new(x));
                }
                all
            },
            draw: |draw| Box::new(X::draw(draw)),
            ordinary: |draw| Box::new(X::ordinary(draw)),
            thin: |draw| Box::new(X::thin(draw)),
            touching: |draw| Box::new(X::touching(draw)),
        }
    }
    /// Returns a random input of a family.
    pub(crate) fn of_family(self, family: Family, draw: &mut Draw) -> Box<dyn Drawn> {
        match family {
            Family::Any => self.random(draw),
            Family::Hard => {
                let mut plain = (self.hard)();
                if plain.is_empty() {
                    return (self.draw)(draw);
                }
                let x = plain.swap_remove(draw.below(plain.len()));
                match put(&*x, PLACES[draw.below(PLACES.len())]) {
                    Some(there) => x.refilled(&there),
                    None => x,
                }
            }
            Family::Ordinary => (self.ordinary)(draw),
            Family::Thin => (self.thin)(draw),
            Family::Tiny => {
                let x = (self.draw)(draw);
                elsewhere(x, draw.magnitude(1e-12, 1e-4), [0.0; 2])
            }
            Family::Huge => {
                let x = (self.draw)(draw);
                elsewhere(x, draw.magnitude(1e4, 1e12), [0.0; 2])
            }
            Family::Far => {
                let shift = [(); 2].map(|()| {
                    let sign = if draw.once_in(2) { -1.0 } else { 1.0 };
                    sign * draw.magnitude(1e2, 1e6)
                });
                elsewhere((self.draw)(draw), 1.0, shift)
            }
            Family::Touching => (self.touching)(draw),
        }
    }
    /// Returns the hard cases as they are, turned, scaled and moved away.
    pub(crate) fn hard_cases(self) -> Vec<Box<dyn Drawn>> {
        let plain = (self.hard)();
        let places = PLACES.iter();
        let cases = places.flat_map(|place| plain.iter().map(move |x| (x, put(&**x, *place))));
        cases
            .filter_map(|(x, there)| Some(x.refilled(&there?)))
            .collect()
    }
    /// Returns an input on a grid of few numbers; a random one where its shapes take none.
    #[cfg(feature = "check")]
    pub(crate) fn lattice(self, draw: &mut Draw) -> Box<dyn Drawn> {
        let x = (self.ordinary)(draw);
        let kinds = x.kinds();
        for _ in 0..8 {
            let numbers = lattice(&kinds, draw);
            if x.inside(&numbers) {
                return x.refilled(&numbers);
            }
        }
        self.random(draw)
    }
    /// Returns a random input, moved and scaled now and then.
    pub(crate) fn random(self, draw: &mut Draw) -> Box<dyn Drawn> {
        let x = (self.draw)(draw);
        match placed(&*x, draw) {
            Some(there) => x.refilled(&there),
            None => x,
        }
    }
}

impl Family {
    /// Returns a random input of the family.
    pub fn draw<X: Sample>(self, draw: &mut Draw) -> X {
        typed(&*const { Kinship::of::<X>() }.of_family(self, draw))
    }
}

/// Returns a random input, moved and scaled now and then.
pub fn random<X: Sample>(draw: &mut Draw) -> X {
    typed(&*const { Kinship::of::<X>() }.random(draw))
}

/// Returns the hard cases as they are, turned, scaled and moved away.
pub fn hard_cases<X: Sample>() -> Vec<X> {
    let plain = X::hard();
    let placed = |x: &X, place| put(x, place).map(|there| x.refill(&there));
    let places = PLACES.iter();
    let all = places.flat_map(|place| plain.iter().filter_map(|x| placed(x, *place)));
    all.collect()
}

/// Returns an input scaled and moved, if it fits there.
fn elsewhere(x: Box<dyn Drawn>, scale: f64, shift: [f64; 2]) -> Box<dyn Drawn> {
    let there = moved(&x.numbers(), &x.kinds(), 0.0, scale, shift);
    match x.inside(&there) {
        true => x.refilled(&there),
        false => x,
    }
}

/// Returns the numbers of a hard case at a placement; nothing for a shape that cannot turn or does not fit there.
pub(crate) fn put(x: &dyn Drawn, (angle, scale, shift): Placement) -> Option<Vec<f64>> {
    let kinds = x.kinds();
    let turns = |kind: &Kind| kind.is_angle() || *kind == Kind::DirectionX;
    if angle != 0.0 && !kinds.iter().any(turns) {
        return None;
    }
    let there = moved(&x.numbers(), &kinds, angle, scale, shift);
    x.inside(&there).then_some(there)
}

/// Returns the numbers of an input at a random placement; nothing if it does not fit there.
pub(crate) fn placed(x: &dyn Drawn, draw: &mut Draw) -> Option<Vec<f64>> {
    let scale = match draw.below(16) {
        0 => 1e-4,
        1 => 1e-12,
        2 => 1e5,
        3 => draw.magnitude(1e-6, 1e6),
        _ => 1.0,
    };
    let shift = match draw.below(12) {
        0 => [1e5, -1e5],
        1 => [draw.within(-1e3, 1e3), draw.within(-1e3, 1e3)],
        _ => [0.0, 0.0],
    };
    let there = moved(
        &x.numbers(),
        &x.kinds(),
        0.0,
        scale,
        shift.map(|s| s * scale),
    );
    x.inside(&there).then_some(there)
}
