//! The instructions of the interpreter: names, operands, and formulas.
//!
//! Most instructions compute one node. Others compute two or three nodes of which the inner ones have no other use:
//! this saves a store, a load and the dispatch of an instruction. Each node rounds as it does alone. Some instructions
//! have two results of common operands for the same reason.

/// Passes every instruction with one result to a macro: its name, its operands, and its value as a formula of vectors.
///
/// Truths are numbers all of whose bits are ones or zeros.
macro_rules! instructions {
    ($with:ident!($($rest:tt)*)) => { $with! { $($rest)*
        Copy(x) = x;
        Canonical(x) = x.canonical();
        Neg(x) = -x;
        Magnitude(x) = x.magnitude();
        Root(x) = x.root();
        Binade(x) = x.binade();
        High(x) = x.parts().0;
        Exp(x) = x.exp();
        Ln(x) = x.ln();
        Not(x) = V::word(!x.truth());
        // Ignores the slot's contents.
        Always(x) = V::word(!x.below(x));
        Never(x) = V::word(x.below(x));

        Add(x, y) = x + y;
        Sub(x, y) = x - y;
        Mul(x, y) = x * y;
        Div(x, y) = x.over(y);
        Min(x, y) = x.least(y);
        Max(x, y) = x.most(y);
        Atan2(y, x) = y.atan2(x);
        Lt(x, y) = V::word(x.below(y));
        Le(x, y) = V::word(x.at_most(y));
        Eq(x, y) = V::word(x.equals(y));
        And(x, y) = V::word(x.truth() & y.truth());
        Or(x, y) = V::word(x.truth() | y.truth());

        Select(m, x, y) = V::select(m.truth(), x, y);
        Split(x, y, z) = {
            let tie = V::select(x.equals(y), z.halved(), V::zero());
            V::select(x.below(y), z, tie)
        };

        Rest(x, y, z) = {
            let tie = V::select(x.equals(y), z.halved(), z);
            V::select(x.below(y), V::zero(), tie)
        };

        // (x . y) . z, and z - (x . y).
        AddAdd(x, y, z) = (x + y) + z;
        SubAdd(x, y, z) = (x - y) + z;
        MulAdd(x, y, z) = x * y + z;
        AddSub(x, y, z) = (x + y) - z;
        SubSub(x, y, z) = (x - y) - z;
        MulSub(x, y, z) = x * y - z;
        FromAdd(x, y, z) = z - (x + y);
        FromSub(x, y, z) = z - (x - y);
        FromMul(x, y, z) = z - x * y;
        AddMul(x, y, z) = (x + y) * z;
        SubMul(x, y, z) = (x - y) * z;
        MulMul(x, y, z) = (x * y) * z;
        MaxMin(x, y, z) = x.most(y).least(z);
        MinMax(x, y, z) = x.least(y).most(z);
        MinFrom(x, y, z) = z.least(x.most(y));
        MaxFrom(x, y, z) = z.most(x.least(y));
        // Adjoints by hand of areas often have these.
        MaxFromMul(x, y, z, w) = w.most(z.least(x * y));
        MaxFromNeg(x, y, z) = z.most(y.least(-x));
        MaxMulAdd(x, y, z, w) = w.most(x * y + z);
        // (x . y) . (z . w).
        SubByAdd(x, y, z, w) = (x - y) * (z + w);
        SubAndSub(x, y, z, w) = (x - y) + (z - w);
        Dot(x, y, z, w) = x * y + z * w;
        Cross(x, y, z, w) = x * y - z * w;

        SelectNeg(m, x, y) = V::select(m.truth(), -x, y);
        SelectMul(m, x, y, z) = V::select(m.truth(), x * y, z);
        ElseMul(m, x, y, z) = V::select(m.truth(), x, y * z);
        SelectAdd(m, x, y, z) = V::select(m.truth(), x, y) + z;
        MagnitudeMax(x, y) = x.magnitude().most(y);
        MaxMagnitude(x, y) = x.most(y.magnitude());
        AndNot(m, n) = V::word(m.truth() & !n.truth());
        SelectLt(x, y, z, w) = V::select(x.below(y), z, w);
        SelectNegLt(x, y, z, w) = V::select(x.below(y), -z, w);
        SelectLe(x, y, z, w) = V::select(x.at_most(y), z, w);
        SelectEq(x, y, z, w) = V::select(x.equals(y), z, w);
        LtAnd(x, y, m) = V::word(x.below(y) & m.truth());
        LeAnd(x, y, m) = V::word(x.at_most(y) & m.truth());
        EqAnd(x, y, m) = V::word(x.equals(y) & m.truth());
        LtOr(x, y, m) = V::word(x.below(y) | m.truth());
        LeOr(x, y, m) = V::word(x.at_most(y) | m.truth());
        EqOr(x, y, m) = V::word(x.equals(y) | m.truth());
    } };
}
pub(crate) use instructions;

/// The names as an enumeration, and the instructions with one result as a list.
macro_rules! names {
    ($($name:ident($($x:ident),*) = $value:expr;)*) => {
        /// The operation of an instruction.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub(crate) enum Opcode {
            $(
                #[doc = concat!("`", stringify!($value), "`")]
                $name,
            )*
            /// The sine and the cosine of `from[0]`, each as its high part and the rest.
            Parts,
            /// The sine and the cosine of `from[0]`.
            SinCos,
            /// `x z + y w` and `y z - x w` of `from`: a vector in a turned frame, sums of angles.
            Turn,
            /// The sum and the difference of `from[0]` and `from[1]`.
            SumSub,
            /// Skips the next `to[0]` instructions if the truth `from[0]` holds for every item.
            SkipIfAll,
            /// Skips the next `to[0]` instructions if the truth `from[0]` holds for no item.
            SkipIfNone,
        }

        /// The name and the number of operands of every instruction with one result, in the order of [`Opcode`].
        #[cfg_attr(
            not(any(
                feature = "gpu",
                all(target_arch = "x86_64", feature = "native", not(geograd_portable))
            )),
            expect(dead_code, reason = "only machine code and shaders list instructions")
        )]
        pub(crate) const LISTED: &[(&str, usize)] = &[$((
            stringify!($name),
            [$(stringify!($x)),*].len(),
        )),*];
    };
}
instructions! { names!() }

/// An instruction: its operation, and the slots of its results and operands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Instruction {
    /// The operation.
    pub(crate) op: Opcode,
    /// Slots of results; most instructions have one.
    pub(crate) to: [u16; 4],
    /// Slots of operands.
    pub(crate) from: [u16; 4],
}

/// A run of instructions compiled to a function of machine code.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CodeRun {
    /// The first instruction, and the one after the last.
    pub(crate) from: usize,
    pub(crate) to: usize,
    /// The offset of its function in the code.
    #[cfg_attr(
        not(all(target_arch = "x86_64", feature = "native", not(geograd_portable))),
        expect(dead_code, reason = "builds without machine code have no runs")
    )]
    pub(crate) entry: usize,
}

/// The distance in bytes at which results are prefetched: users' functions of 6 to 14 columns with gradients take a
/// fifth to a third less time (`BENCHMARKS.md`, Python).
pub(crate) const AHEAD: usize = 1 << 10;
