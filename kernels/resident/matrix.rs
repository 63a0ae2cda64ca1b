//! Reductions of a matrix on the machine.
use super::{Bests, Founds, Matrix, Side};
use crate::Error;

/// Reductions of a matrix; the macro lists the calls.
macro_rules! reductions {
    ($($(#[$doc:meta])* $name:ident($($arg:ident)?) -> $out:ty
        = |$cpu:ident| $held:expr; |$gpu:ident| $wrap:expr;)*) => {
        impl Matrix { $(
            $(#[$doc])*
            ///
            /// # Errors
            ///
            /// The input's as on the CPU, or what the device says.
            pub fn $name(&self $(, $arg: f32)?) -> Result<$out, Error> {
                on!(own = &self.0;
                    { let $cpu = own; Ok($held) };
                    { let $gpu = own.$name($($arg)?)?; Ok($wrap) })
            }
        )* }
    };
}

reductions! {
    /// The largest number of every row and its column; of several the first.
    row_max() -> Bests
        = |own| Bests(Side::Cpu((own.row_max()?, own.columns())));
        |x| Bests(Side::Gpu(x));
    /// The largest number of every column and its row; of several the first.
    column_max() -> Bests
        = |own| Bests(Side::Cpu((own.column_max()?, own.rows())));
        |x| Bests(Side::Gpu(x));
    /// Every number above the threshold, with its place.
    above(threshold) -> Founds
        = |own| Founds(Side::Cpu(own.above(threshold)?));
        |x| Founds(Side::Gpu(x));
    /// The count of numbers above the threshold.
    count_above(threshold) -> u64
        = |own| own.count_above(threshold)?;
        |x| x;
    /// The sum of all numbers.
    sum() -> f64
        = |own| own.sum();
        |x| x;
    /// The mean of all numbers; 0 without any.
    mean() -> f64
        = |own| own.mean();
        |x| x;
}
