//! The derivative of every operation, written once for both directions.
//!
//! An operation's derivative with respect to an operand is never a number by itself: it multiplies a tangent of the
//! operand ([forward](super::tangent)) or a cotangent of the operation ([reverse](super::reverse)). One function builds
//! both products.
use super::graph::{Graph, Id, Node};

/// Returns the operands through which derivatives pass, by their index. The others are decisions or constants.
pub(super) fn carriers(node: Node) -> &'static [usize] {
    use Node::*;
    match node {
        Const(_) | Input(_) | Bool(_) | Lt(..) | Le(..) | Eq(..) | And(..) | Or(..) | Not(_) => &[],
        // Powers of two and high halves are constants: steps that are flat.
        Binade(_)
        | High(_)
        | SinHigh(_)
        | CosHigh(_)
        | Graft {
            derivative: None, ..
        } => &[],
        Neg(_) | Canonical(_) | Magnitude(_) | Unsigned(_) | Root(_) | Sin(_) | Cos(_)
        | SinLow(_) | CosLow(_) | Exp(_) | Ln(_) => &[0],
        Add(..) | Sub(..) | Mul(..) | Div(..) | Min(..) | Max(..) | Atan2(..) => &[0, 1],
        Graft {
            derivative: Some(_),
            ..
        } => &[1],
        Split(..) | Rest(..) => &[2],
        Select(..) => &[1, 2],
    }
}

/// Returns `true` if a zero times the derivative by this operand is zero for all values.
pub(super) fn keeps_zero(graph: &Graph, node: Node, operand: usize) -> bool {
    use Node::*;
    let finite = |x| graph.constant(x).is_some_and(f64::is_finite);
    match node {
        Neg(_)
        | Canonical(_)
        | Add(..)
        | Sub(..)
        | Min(..)
        | Max(..)
        | Select(..)
        | Split(..)
        | Rest(..)
        | Magnitude(_)
        | Unsigned(_)
        | Root(_)
        | Graft { share: None, .. } => true,
        Mul(a, b) => finite([b, a][operand]),
        Div(_, b) => operand == 0 && finite(b) && graph.constant(b) != Some(0.0),
        Graft {
            share: Some(share), ..
        } => finite(share),
        Sin(_) | Cos(_) | SinLow(_) | CosLow(_) | Exp(_) | Ln(_) | Atan2(..) => false,
        Const(_) | Input(_) | Bool(_) | Lt(..) | Le(..) | Eq(..) | And(..) | Or(..) | Not(_)
        | Binade(_) | High(_) | SinHigh(_) | CosHigh(_) => true,
    }
}

/// Returns the condition under which a node uses an operand: a mask and its required value. Elsewhere its derivative is
/// zero, also where the operand's own is infinite.
pub(super) fn taken(graph: &mut Graph, node: Node, operand: usize) -> Option<(Id, bool)> {
    use Node::*;
    match node {
        Select(mask, ..) => Some((mask, operand == 1)),
        // A tie takes both, and NaN is never below.
        Min(a, b) | Max(b, a) => match operand {
            0 => Some((graph.make(Le(a, b)), true)),
            _ => Some((graph.make(Lt(a, b)), false)),
        },
        Split(a, b, _) => Some((graph.make(Le(a, b)), true)),
        Rest(a, b, _) => Some((graph.make(Lt(a, b)), false)),
        Root(x) => {
            let zero = graph.lit(0.0);
            Some((graph.make(Lt(zero, x)), true))
        }
        Atan2(y, x) => Some((scaled(graph, [y, x]).origin, false)),
        Neg(_)
        | Canonical(_)
        | Add(..)
        | Sub(..)
        | Mul(..)
        | Div(..)
        | Magnitude(_)
        | Unsigned(_)
        | Sin(_)
        | Cos(_)
        | SinLow(_)
        | CosLow(_)
        | Exp(_)
        | Ln(_)
        | Graft { .. }
        | Const(_)
        | Input(_)
        | Bool(_)
        | Lt(..)
        | Le(..)
        | Eq(..)
        | And(..)
        | Or(..)
        | Not(_)
        | Binade(_)
        | High(_)
        | SinHigh(_)
        | CosHigh(_) => None,
    }
}

/// Returns `t` times the derivative of the node at `me` by one of its [carriers].
pub(super) fn along(graph: &mut Graph, me: Id, operand: usize, t: Id) -> Id {
    use Node::*;
    let node = graph.at(me);
    let g = graph;
    match node {
        Canonical(_) | Add(..) | Graft { share: None, .. } => t,
        Sub(..) if operand == 0 => t,
        Neg(_) | Sub(..) => g.make(Neg(t)),
        Mul(a, b) => g.make(Mul(t, [b, a][operand])),
        // Divided first: the square of a small divisor would underflow.
        Div(_, b) => {
            let t = g.make(Div(t, b));
            if operand == 0 {
                return t;
            }
            let t = g.make(Mul(t, me));
            g.make(Neg(t))
        }
        Min(a, b) if operand == 0 => g.make(Split(a, b, t)),
        Min(a, b) => g.make(Rest(a, b, t)),
        Max(a, b) if operand == 0 => g.make(Split(b, a, t)),
        Max(a, b) => g.make(Rest(b, a, t)),
        // As the larger of x and −x, also where x is NaN.
        Magnitude(x) => {
            let zero = g.lit(0.0);
            let (positive, tie) = (g.make(Lt(zero, x)), g.make(Eq(x, zero)));
            let minus = g.make(Neg(t));
            let other = g.make(Select(tie, zero, minus));
            g.make(Select(positive, t, other))
        }
        Unsigned(x) => {
            let zero = g.lit(0.0);
            let (negative, minus) = (g.make(Lt(x, zero)), g.make(Neg(t)));
            g.make(Select(negative, minus, t))
        }
        // Guarded on both sides, so that derivatives of the derivative are finite, too.
        Root(x) => {
            let (zero, one, half) = (g.lit(0.0), g.lit(1.0), g.lit(0.5));
            let positive = g.make(Lt(zero, x));
            let root = g.make(Select(positive, me, one));
            let t = g.make(Mul(t, half));
            let t = g.make(Div(t, root));
            g.make(Select(positive, t, zero))
        }
        Sin(x) => {
            let cos = g.make(Cos(x));
            g.make(Mul(t, cos))
        }
        Cos(x) => {
            let sin = g.make(Sin(x));
            let t = g.make(Mul(t, sin));
            g.make(Neg(t))
        }
        SinLow(x) => {
            let (high, low) = (g.make(CosHigh(x)), g.make(CosLow(x)));
            let cos = g.make(Add(high, low));
            g.make(Mul(t, cos))
        }
        CosLow(x) => {
            let (high, low) = (g.make(SinHigh(x)), g.make(SinLow(x)));
            let sin = g.make(Add(high, low));
            let t = g.make(Mul(t, sin));
            g.make(Neg(t))
        }
        Exp(_) => g.make(Mul(t, me)),
        Ln(x) => g.make(Div(t, x)),
        Atan2(y, x) => along_angle(g, [y, x], operand, t),
        Graft {
            share: Some(share), ..
        } => g.make(Mul(t, share)),
        Split(a, b, _) => g.make(Split(a, b, t)),
        Rest(a, b, _) => g.make(Rest(a, b, t)),
        Select(mask, ..) => {
            let zero = g.lit(0.0);
            match operand {
                1 => g.make(Select(mask, t, zero)),
                _ => g.make(Select(mask, zero, t)),
            }
        }
        Const(_) | Input(_) | Bool(_) | Lt(..) | Le(..) | Eq(..) | And(..) | Or(..) | Not(_)
        | Binade(_) | High(_) | SinHigh(_) | CosHigh(_) => g.lit(0.0),
    }
}

/// A vector brought to a length of about one by a power of two: squares of very small and of very
/// large numbers are not numbers of the format.
struct ScaledVector {
    /// The truth that it is the zero vector, which stays as it is.
    origin: Id,
    /// The power of two.
    scale: Id,
    /// The ordinate and the abscissa.
    parts: [Id; 2],
}

fn scaled(g: &mut Graph, parts: [Id; 2]) -> ScaledVector {
    use Node::*;
    let (zero, one) = (g.lit(0.0), g.lit(1.0));
    let [height, width] = parts.map(|x| g.make(Magnitude(x)));
    let large = g.make(Max(width, height));
    let large = g.make(Graft {
        value: large,
        derivative: None,
        share: None,
    });
    let origin = g.make(Le(large, zero));
    let large = g.make(Select(origin, one, large));
    let scale = g.make(Binade(large));
    ScaledVector {
        origin,
        scale,
        parts: parts.map(|x| g.make(Mul(x, scale))),
    }
}

/// Returns `t` times the derivative of the angle of `(x, y)`: `x / r²` by `y`, `−y / r²` by `x`; zero at the origin.
fn along_angle(g: &mut Graph, parts: [Id; 2], operand: usize, t: Id) -> Id {
    use Node::*;
    let vector = scaled(g, parts);
    let [y, x] = vector.parts;
    let (zero, one) = (g.lit(0.0), g.lit(1.0));
    let (xx, yy) = (g.make(Mul(x, x)), g.make(Mul(y, y)));
    let squared = g.make(Add(xx, yy));
    let squared = g.make(Select(vector.origin, one, squared));
    let t = g.make(Div(t, squared));
    let t = match operand {
        0 => g.make(Mul(t, x)),
        _ => {
            let t = g.make(Mul(t, y));
            g.make(Neg(t))
        }
    };
    let t = g.make(Mul(t, vector.scale));
    g.make(Select(vector.origin, zero, t))
}

/// Returns which nodes depend on one of the first `inputs` numbers of the input by operations that pass derivatives.
pub(super) fn active(graph: &Graph, inputs: usize) -> Vec<bool> {
    let mut active: Vec<bool> = Vec::with_capacity(graph.len());
    for &node in graph.nodes() {
        let operands = node.operands();
        active.push(match node {
            Node::Input(place) => (place as usize) < inputs,
            _ => carriers(node)
                .iter()
                .any(|&place| active[operands[place] as usize]),
        });
    }
    active
}
