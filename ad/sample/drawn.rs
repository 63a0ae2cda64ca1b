//! Inputs without their types: whatever judges them is compiled once, and not once for every kind of input.
use crate::ad::declared::Kind;
use crate::ad::sample::{Draw, PLACES, Placed, Sample, moved};
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
    /// The same shapes made of other numbers.
    fn refilled(&self, numbers: &[f64]) -> Box<dyn Drawn>;
    /// Inputs with fewer shapes in their lists.
    fn fewer(&self) -> Box<dyn Iterator<Item = Box<dyn Drawn>> + '_>;
    fn is_inside(&self) -> bool;
    fn outlines(&self) -> Vec<Vec<[f64; 2]>>;
    /// It, as code.
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

/// The text of an input as code.
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
        }
    }
    /// The hard cases as they are, turned, scaled and moved away.
    pub(crate) fn hard_cases(self) -> Vec<Box<dyn Drawn>> {
        let plain = (self.hard)();
        let places = PLACES.iter();
        let cases = places.flat_map(|place| plain.iter().map(move |x| (x, put(&**x, *place))));
        cases
            .filter_map(|(x, there)| Some(x.refilled(&there?)))
            .collect()
    }
    /// A random input, moved and scaled now and then.
    pub(crate) fn random(self, draw: &mut Draw) -> Box<dyn Drawn> {
        let x = (self.draw)(draw);
        match placed(&*x, draw) {
            Some(there) => x.refilled(&there),
            None => x,
        }
    }
}

/// The numbers of a hard case in a place; nothing for a shape that cannot turn or does not fit there.
pub(crate) fn put(x: &dyn Drawn, (angle, scale, shift): Placed) -> Option<Vec<f64>> {
    let kinds = x.kinds();
    let turns = |kind: &Kind| kind.is_angle() || *kind == Kind::DirectionX;
    if angle != 0.0 && !kinds.iter().any(turns) {
        return None;
    }
    let there = moved(&x.numbers(), &kinds, angle, scale, shift);
    x.inside(&there).then_some(there)
}

/// The numbers of an input where a place was drawn for it; nothing if it does not fit there.
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
