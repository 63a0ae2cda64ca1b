//! Verdicts as text: reasons, witnesses and remedies. [`report`](crate::ad::check::report) writes them.
use crate::Unrecordable;
use crate::ad::check::symmetry::Motion;
use crate::ad::check::verdict::{ByWitness, Fault, Reason, Witness};
use std::fmt;

impl fmt::Display for Witness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Witness::Value => "the value",
            Witness::Adjoint => "the tested derivative",
            Witness::Dual => "the duals",
            Witness::NumDual => "num-dual's numbers",
            Witness::Difference => "the differences",
            Witness::Wide => "double precision",
            Witness::Planes => "the best plane between the bodies",
            Witness::Points => "the nearest points",
            Witness::Batch => "the batch",
            Witness::Further(k) => return write!(f, "further witness {k}"),
        })
    }
}

impl fmt::Display for Motion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Motion::TranslationX => "is moved along x",
            Motion::TranslationY => "is moved along y",
            Motion::TranslationZ => "is moved along z",
            Motion::RotationX => "is turned about the x axis",
            Motion::RotationY => "is turned about the y axis",
            Motion::Rotation => "is turned about the origin, in space about the z axis",
            Motion::Scaling => "is scaled",
            Motion::Exchange => "has its two arguments exchanged",
        })
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Reason::WrongLength(who) => write!(f, "of {who} there are too few or too many numbers"),
            Reason::NotFinite(who) => {
                write!(f, "{who}: a NaN or an infinity, although the input is finite")
            }
            Reason::Impure(who) => write!(f, "{who}: other bits when asked again"),
            Reason::ValuesDisagree(who) => write!(f, "by {who} the value is another one"),
            Reason::Disagree(a, b) => write!(f, "{a} and {b} disagree"),
            Reason::OutsideKink => {
                f.write_str("at a kink the derivative is not between those of both sides")
            }
            Reason::Jump => f.write_str("the value jumps, and no jump is declared"),
            Reason::NotLinear => f.write_str(
                "the tested derivative of a sum of outputs is not the sum of their derivatives",
            ),
            Reason::CurvatureDisagrees(who) => {
                write!(f, "the tested second derivative and that by {who} disagree")
            }
            Reason::CurvatureNotSymmetric => {
                f.write_str("second derivatives taken in the other order differ")
            }
            Reason::MotionBroken(motion) => {
                write!(f, "the value breaks an invariance when the input {motion}")
            }
            Reason::MotionUnbalanced(motion) => {
                write!(f, "the derivatives break an invariance when the input {motion}")
            }
            Reason::Unrecordable(why) => write!(f, "the operation cannot be recorded: {why}"),
            Reason::FewInside => f.write_str(
                "hardly a random input was inside the domain, so nothing was checked",
            ),
            Reason::NothingSmooth => {
                f.write_str("hardly an input was smooth, so nothing was checked")
            }
            Reason::Unjudged => f.write_str(
                "no witness could say anything about the derivative with respect to this number, so nothing was \
                 checked",
            ),
        }
    }
}

/// Returns the remedy of a refusal that need not be a mistake of the derivative, in lines.
pub(crate) fn remedy(reason: Reason) -> &'static [&'static str] {
    const SEARCHES: &[&str] = &[
        "remedy: implement `Search` (a search and its replay), and check it with `check_search_with`;",
        "        or check the plain function with `Check::random`",
    ];
    match reason {
        Reason::ValuesDisagree(Witness::Wide) => &[
            "remedy: where digits cancel in single precision and may be lost, say how far values may be off",
            "        (`resolution`, `relative_resolution`); otherwise write the formula so that they stay",
        ],
        Reason::Disagree(Witness::Adjoint, Witness::Wide) => &[
            "remedy: where no other witness disagrees, single precision loses digits that the function does not; write",
            "        the formula so that they stay, or check and use it in double precision alone",
        ],
        Reason::FewInside => &[
            "remedy: say a wider domain, or give inputs inside it: with `Check::drawn`, or of an operation one by one with",
            "        `and`, and `samples(0)`",
        ],
        Reason::Unrecordable(Unrecordable::Constant) => &[
            "remedy: use finite literals, such as the largest number (`S::format().largest()`) instead of infinity",
        ],
        Reason::Unrecordable(Unrecordable::Hint) => {
            &["remedy: choose with `select`; a branch on `any` or `all` may only save work"]
        }
        Reason::Unrecordable(Unrecordable::ForeignSymbol) => {
            &["remedy: compute with the arguments of the call and literals (`S::lit`) only"]
        }
        Reason::Unrecordable(Unrecordable::TooLong) => &[
            "remedy: make it shorter, or a `Fold` if it repeats one step;",
            "        or check the plain function with `Check::random`",
        ],
        Reason::Unrecordable(_) => SEARCHES,
        _ => &[],
    }
}

/// Returns the names of the two numbers that a verdict shows: the tested derivative's, and the other one's.
fn names(reason: Reason) -> [&'static str; 2] {
    match reason {
        Reason::ValuesDisagree(_) => ["the value", "the other value"],
        Reason::MotionBroken(_) => ["value there", "declared"],
        Reason::MotionUnbalanced(_) => ["derivative of the motion", "declared"],
        Reason::NotLinear => ["of the sum", "sum of each"],
        Reason::CurvatureNotSymmetric => ["in one order", "in the other"],
        Reason::Disagree(_, Witness::Wide) | Reason::CurvatureDisagrees(Witness::Wide) => {
            ["tested", "double precision"]
        }
        Reason::Disagree(_, Witness::Batch) => ["tested", "batch"],
        Reason::Disagree(_, Witness::NumDual) => ["tested", "num-dual"],
        _ => ["tested", "other witness"],
    }
}

/// Returns the difference of the two numbers that a verdict is about.
fn gap(reason: Reason, numbers: &ByWitness) -> Option<f64> {
    let of = |witness: Witness| match witness {
        Witness::Value | Witness::Adjoint => numbers.adjoint,
        Witness::Dual => numbers.dual,
        Witness::Difference => numbers.difference,
        Witness::NumDual
        | Witness::Wide
        | Witness::Planes
        | Witness::Points
        | Witness::Batch
        | Witness::Further(_) => numbers.other,
    };
    let pair = match reason {
        Reason::Disagree(a, b) => of(a).zip(of(b)),
        Reason::CurvatureDisagrees(other) => numbers.adjoint.zip(of(other)),
        Reason::OutsideKink => {
            let derivative = numbers.adjoint.or(numbers.dual)?;
            let [a, b] = numbers.sides?;
            return Some((a.min(b) - derivative).max(derivative - a.max(b)));
        }
        _ => numbers.adjoint.zip(numbers.other),
    };
    pair.map(|(a, b)| (a - b).abs())
}

/// Writes the number of every witness, a line each, in the fewest digits that distinguish it; then their difference and
/// the allowed difference.
pub(crate) fn write_numbers(
    f: &mut impl fmt::Write,
    reason: Reason,
    numbers: &ByWitness,
    tolerance: f64,
) -> fmt::Result {
    let [own, other] = names(reason);
    let named = [
        (own, numbers.adjoint),
        ("duals", numbers.dual),
        ("differences", numbers.difference),
        (other, numbers.other),
    ];
    for (name, number) in named {
        if let Some(number) = number {
            writeln!(f, "    {name:<20} {number:>24?}")?;
        }
    }
    if let Some([behind, ahead]) = numbers.sides {
        writeln!(f, "    {:<20} {behind:>24?} {ahead:>24?}", "both sides")?;
    }
    if let Some([got, wanted]) = numbers.lengths {
        writeln!(f, "    {got} numbers where {wanted} are needed")?;
    }
    match gap(reason, numbers) {
        Some(gap) if tolerance > 0.0 => {
            writeln!(f, "    {:<20} {gap:>24.1e}", "apart by")?;
            writeln!(f, "    {:<20} {tolerance:>24.1e}", "allowed here")
        }
        _ => Ok(()),
    }
}

/// Returns the derivative or the value that a fault is about; `names` has the numbers of the input, if they have any.
pub(crate) fn place(fault: &Fault, names: &[String]) -> String {
    let Fault {
        reason,
        output,
        input,
        numbers,
        ..
    } = fault;
    let named = match names.get(*input) {
        Some(name) => format!("input {input}, which is {name}"),
        None => format!("input {input}"),
    };
    match reason {
        Reason::ValuesDisagree(_) | Reason::MotionBroken(_) => format!("output {output}"),
        Reason::NotFinite(Witness::Value) | Reason::Impure(Witness::Value) => {
            "the value".to_owned()
        }
        Reason::FewInside | Reason::NothingSmooth => "all random inputs".to_owned(),
        Reason::Unrecordable(_) => "no input was judged".to_owned(),
        _ if numbers.along => {
            format!("derivative of output {output} along a random direction, {named} among others")
        }
        _ => format!("derivative of output {output} with respect to {named}"),
    }
}

/// Returns the sentence about the suspect: the witness that the others outvote.
pub(crate) fn outvoted(suspect: Witness) -> String {
    format!("at fault, as far as the others tell: {suspect}")
}
