//! Straight lines of further shapes on the GPU in every form: shader text, and what it computes.
//!
//! A binary of its own, which is compiled beside `gpu`.

macro_rules! walk {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }
     straight { $($straight:ident: $straight_op:ty,)* }
     folds { $($fold:ident: $fold_op:ty,)* } decided { $($decided:ident: $decided_op:ty,)* }
     further {
         straight { $($more:ident: $more_op:ty,)* }
         folds { $($more_fold:ident: $more_fold_op:ty,)* }
         decided { $($more_search:ident: $more_decided_op:ty,)* }
     }) => {
        mod valid {
            $(#[test]
            fn $more() {
                geograd_tests::adapter::shaders_are_valid::<$more_op>();
            })*
        }
        // Which implementation serves an operation is found by the references.
        #[allow(clippy::needless_borrow)]
        mod agree {
            use geograd_tests::forms::{Agree, Forms};
            $(#[test]
            fn $more() {
                (&&&Forms::<$more_op>::NEW).agree();
            })*
        }
    };
}
geograd::for_each_op!(walk);
