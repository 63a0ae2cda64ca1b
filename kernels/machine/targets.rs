//! Memory for the results of batches.
use crate::kernels::machine::{Held, Stored};
use crate::kernels::row::item::{Item, Results, Target, WithJacobian, jacobians, target};

/// The memory for the results of a batch: a slice or vector for every shape of a result, in a tuple like the result's,
/// with [`Skip`] for unwanted ones; or an array on the machine.
pub trait Targets<R: Results> {
    /// Passes the targets to `add`, one per shape of a result.
    #[doc(hidden)]
    fn list<'a>(&'a mut self, add: &mut dyn FnMut(Option<Target<'a, R::Scalar>>));
    /// Returns the array on the machine, if results are written there.
    #[doc(hidden)]
    fn held(&mut self) -> Option<&mut Stored<R::Scalar>> {
        None
    }
}

impl<R: Results> Targets<R> for &mut Held<R> {
    fn list<'a>(&'a mut self, _add: &mut dyn FnMut(Option<Target<'a, R::Scalar>>)) {}
    fn held(&mut self) -> Option<&mut Stored<R::Scalar>> {
        Some(self.stored_mut())
    }
}

/// The target of a result that is not wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Skip;

impl<R: Results> Targets<R> for Skip {
    fn list<'a>(&'a mut self, add: &mut dyn FnMut(Option<Target<'a, R::Scalar>>)) {
        for _ in R::widths() {
            add(None);
        }
    }
}
/// The targets of a result and of its Jacobian.
impl<Y: Item, X: Item<Scalar = Y::Scalar>, T: Targets<Y>> Targets<WithJacobian<Y, X>>
    for (T, &mut [Y::With<X>])
where
    Y::With<X>: Send,
{
    fn list<'a>(&'a mut self, add: &mut dyn FnMut(Option<Target<'a, Y::Scalar>>)) {
        self.0.list(add);
        add(Some(jacobians::<Y, X>(self.1)));
    }
}
impl<Y: Item, X: Item<Scalar = Y::Scalar>, T: Targets<Y>> Targets<WithJacobian<Y, X>>
    for (T, &mut Vec<Y::With<X>>)
where
    Y::With<X>: Send,
{
    fn list<'a>(&'a mut self, add: &mut dyn FnMut(Option<Target<'a, Y::Scalar>>)) {
        self.0.list(add);
        add(Some(jacobians::<Y, X>(self.1)));
    }
}
impl<R: Item<Many = Vec<R>>> Targets<R> for &mut [R] {
    fn list<'a>(&'a mut self, add: &mut dyn FnMut(Option<Target<'a, R::Scalar>>)) {
        add(Some(target(self)));
    }
}
impl<R: Item<Many = Vec<R>>> Targets<R> for &mut Vec<R> {
    fn list<'a>(&'a mut self, add: &mut dyn FnMut(Option<Target<'a, R::Scalar>>)) {
        add(Some(target(self)));
    }
}
impl<R: Item<Many = Vec<R>>, const N: usize> Targets<R> for &mut [R; N] {
    fn list<'a>(&'a mut self, add: &mut dyn FnMut(Option<Target<'a, R::Scalar>>)) {
        add(Some(target(&mut self[..])));
    }
}

/// Targets of several results.
macro_rules! targets {
    ($($first:ident $of_first:ident $($name:ident $of:ident)*;)*) => { $(
        impl<$first: Item, $($name: Item<Scalar = $first::Scalar>,)* $of_first, $($of),*>
            Targets<($first, $($name,)*)> for ($of_first, $($of,)*)
        where
            $of_first: Targets<$first>,
            $($of: Targets<$name>,)*
        {
            #[allow(non_snake_case)]
            fn list<'a>(&'a mut self, add: &mut dyn FnMut(Option<Target<'a, $first::Scalar>>)) {
                let ($of_first, $($of,)*) = self;
                $of_first.list(add);
                $($of.list(add);)*
            }
        }
    )* };
}
targets!(A X B Y; A X B Y C Z; A X B Y C Z D W; A X B Y C Z D W E V; A X B Y C Z D W E V F U;);
