//! Inputs that a function is judged at, without their types, so that [`examine`](fn@crate::ad::check::examine) and the
//! search for a simple input are compiled once.
use crate::ad::check::subject::Subject;
use crate::ad::sample::drawn::{Drawn, code};
use crate::{Pack, Real};
use std::fmt::Debug;

/// An iterator over inputs: all shorter inputs of a long list at once would fill the memory.
pub(crate) type Fewer<'a, 'b> = Box<dyn Iterator<Item = Box<dyn Candidate<'a> + 'a>> + 'b>;

/// An input of a function under test.
pub(crate) trait Candidate<'a> {
    fn numbers(&self) -> Vec<f64>;
    /// Returns these shapes with other numbers.
    fn refilled(&self, numbers: &[f64]) -> Box<dyn Candidate<'a> + 'a>;
    /// Returns inputs with fewer shapes in their lists.
    fn fewer(&self) -> Fewer<'a, '_>;
    /// Returns the input as code.
    fn code(&self) -> String;
    /// Calls `judge` with the function near the input.
    fn met(&self, judge: &mut dyn FnMut(&dyn Subject));
}

/// An input of a type, and the closure that makes the function near it.
pub(crate) struct Typed<'a, X, F> {
    pub(crate) x: X,
    pub(crate) meet: &'a F,
}

impl<'a, S, X, F> Candidate<'a> for Typed<'a, X, F>
where
    S: Real,
    X: Pack<Scalar = S> + Debug + 'a,
    F: Fn(&X, &mut dyn FnMut(&dyn Subject)),
{
    fn numbers(&self) -> Vec<f64> {
        self.x.scalars().iter().map(|x| x.widen()).collect()
    }
    fn refilled(&self, numbers: &[f64]) -> Box<dyn Candidate<'a> + 'a> {
        let list: Vec<S> = numbers.iter().map(|&x| S::nearest(x)).collect();
        let (x, meet) = (self.x.refill(&list), self.meet);
        Box::new(Typed { x, meet })
    }
    fn fewer(&self) -> Fewer<'a, '_> {
        let meet = self.meet;
        let of = move |x| Box::new(Typed { x, meet }) as Box<dyn Candidate<'a> + 'a>;
        Box::new(self.x.fewer().map(of))
    }
    fn code(&self) -> String {
        code::<X>(&format!("{:?}", self.x))
    }
    fn met(&self, judge: &mut dyn FnMut(&dyn Subject)) {
        (self.meet)(&self.x, judge);
    }
}

/// A closure that makes a subject near an input and passes it on.
pub(crate) type Meet<'a> = dyn Fn(&dyn Drawn, &mut dyn FnMut(&dyn Subject)) + 'a;

/// An input that was drawn, and the closure that makes the function near it.
pub(crate) struct Untyped<'a> {
    pub(crate) x: Box<dyn Drawn>,
    pub(crate) meet: &'a Meet<'a>,
}

impl<'a> Candidate<'a> for Untyped<'a> {
    fn numbers(&self) -> Vec<f64> {
        self.x.numbers()
    }
    fn refilled(&self, numbers: &[f64]) -> Box<dyn Candidate<'a> + 'a> {
        let (x, meet) = (self.x.refilled(numbers), self.meet);
        Box::new(Untyped { x, meet })
    }
    fn fewer(&self) -> Fewer<'a, '_> {
        let meet = self.meet;
        let of = move |x| Box::new(Untyped { x, meet }) as Box<dyn Candidate<'a> + 'a>;
        Box::new(self.x.fewer().map(of))
    }
    fn code(&self) -> String {
        self.x.code()
    }
    fn met(&self, judge: &mut dyn FnMut(&dyn Subject)) {
        (self.meet)(&*self.x, judge);
    }
}
