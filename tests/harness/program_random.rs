//! Random functions, recorded: bits, derivatives, and zeros of either sign.
#![expect(
    clippy::needless_range_loop,
    reason = "rows and columns are named by their numbers"
)]
use crate::program::{Draw, Function};
use geograd::ad::program::{Program, Sym};
use geograd::error::Field;
use geograd::scalar::dual::Tangent;
use geograd::{Fixed, Jet, Pack, Real, Scalar};
use std::array::from_fn;
use std::cell::Cell;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

const INPUTS: usize = 4;

/// A function of four numbers: operations on the last results, made at random.
#[derive(Debug)]
struct Plan(Vec<(usize, [usize; 4])>);

impl Plan {
    fn new(draw: &mut Draw) -> Self {
        let count = 3 + draw.word() as usize % 14;
        Plan(
            (0..count)
                .map(|i| {
                    let operands = from_fn(|_| draw.word() as usize % (INPUTS + i));
                    (draw.word() as usize, operands)
                })
                .collect(),
        )
    }

    fn eval<S: Scalar>(&self, x: [S; INPUTS]) -> S {
        let all = self.eval_all(x);
        all[all.len() - 1].canonical()
    }

    /// The input and all results on the way.
    fn eval_all<S: Scalar>(&self, x: [S; INPUTS]) -> Vec<S> {
        let mut all = x.to_vec();
        let mut mask = x[0].below(x[1]);
        for &(operation, operands) in &self.0 {
            let [a, b, c, d] = operands.map(|i| all[i]);
            all.push(match operation % 29 {
                0 | 1 => a + b,
                2 | 3 => a - b,
                4 | 5 => a * b,
                6 => a / b,
                7 => a.over(b),
                8 => -a,
                9 => a.least(b),
                10 => a.most(b),
                11 => a.magnitude(),
                12 => a.unsigned(),
                13 => a.root(),
                14 => a.sin() + b.cos(),
                15 => a.least(S::lit(3.0)).exp(),
                16 => a.ln(),
                17 => a.atan2(b),
                18 => a.hypot(b),
                19 => S::select(a.below(b), c, d),
                20 => S::select(a.at_most(S::zero()), b, c.over(a)),
                21 => {
                    mask = (mask & a.equals(b)) | !c.below(d);
                    S::select(mask, a, b)
                }
                22 => S::select(mask, c, d) - S::select(mask, d, a),
                23 => a.clamp(S::lit(-1.0), b.magnitude()),
                24 => a.damp(S::Primal::lit(0.25)) * S::lit([0.0, 1.0, -1.0, 2.0][operation % 4]),
                25 => a.with_primal(b.primal()),
                26 => a + S::lit([0.0, 1.0, -1.0, -0.0][operation % 4]),
                27 => a.signed_as(b),
                _ => a.halved() + b.saturated(),
            });
        }
        all
    }
}

fn input(draw: &mut Draw, kind: usize) -> [f64; INPUTS] {
    match kind % 3 {
        0 => from_fn(|_| [0.0, -0.0, 1.0, -1.0, 2.0, 0.5][draw.word() as usize % 6]),
        _ => draw.input(kind),
    }
}

fn program<T: Real>(plan: &Plan) -> Program<[T; INPUTS], T> {
    Program::trace(|x: [Sym<T>; INPUTS]| plan.eval(x)).expect("a straight line")
}

#[test]
fn random_functions_keep_their_bits_and_derivatives() {
    let (mut draw, mut compared, mut wild) = (Draw(1), 0, 0);
    for _ in 0..4000 {
        let plan = Plan::new(&mut draw);
        let (single, double) = (program::<f32>(&plan), program::<f64>(&plan));
        let (value_grad, jvp) = (double.value_grad(), double.jvp());
        for kind in 0..9 {
            let x = input(&mut draw, kind);
            // An infinity from a division by zero has the sign of that zero, which is not defined.
            let exact = |all: &[f64]| all.iter().all(|x| !x.is_infinite());
            let y = x.map(|x| x as f32);
            let (found, expected) = (single.eval(y), plan.eval(y));
            let same = found == expected || found.is_nan() && expected.is_nan();
            let widened: Vec<f64> = plan.eval_all(y).into_iter().map(f64::from).collect();
            assert!(
                same || !exact(&widened),
                "{found} for {expected} at {x:?} of {plan:?}"
            );
            let (found, expected) = (double.eval(x), plan.eval(x));
            let same = found == expected || found.is_nan() && expected.is_nan();
            assert!(
                same || !exact(&plan.eval_all(x)),
                "{found} for {expected} at {x:?} of {plan:?}"
            );
            if !same {
                continue;
            }
            let jets = plan.eval_all(from_fn(|i| Jet::<_, INPUTS>::variable(x[i], i)));
            let jet = jets[jets.len() - 1];
            let (_, derivatives) = value_grad.eval(x);
            // Duals lose a value that is put in place of NaN.
            let same =
                |(y, z): (&Jet<f64, INPUTS>, f64)| y.value == z || y.value.is_nan() && z.is_nan();
            let known = jets.iter().zip(plan.eval_all(x)).all(same);
            // Results of large numbers that cancel have few digits.
            let numbers = jets
                .iter()
                .flat_map(|y| [y.value].into_iter().chain(y.derivative));
            let scale = numbers
                .filter(|x| x.is_finite())
                .fold(1.0_f64, |a, b| a.max(b.abs()));
            for i in 0..INPUTS {
                let expected = jet.derivative[i];
                if !known || !expected.is_finite() || scale > 1e3 {
                    wild += 1;
                    continue;
                }
                compared += 1;
                let (_, pushed) = jvp.eval((x, from_fn(|k| f64::from(i == k))));
                for found in [derivatives[i], pushed] {
                    let close = (found - expected).abs() <= 1e-10 * scale * scale;
                    assert!(
                        close,
                        "{found} for {expected} by {i} at {x:?} of {plan:?}\n{double}"
                    );
                }
            }
        }
    }
    assert!(
        compared > 2 * wild,
        "{compared} derivatives compared, {wild} wild"
    );
}

thread_local! {
    static COIN: Cell<u64> = const { Cell::new(0) };
}

/// A number whose zeros have any sign.
#[derive(Clone, Copy, Debug)]
struct Flip(f64);

impl Flip {
    fn any(x: f64) -> Self {
        if x != 0.0 {
            return Flip(x);
        }
        COIN.with(|coin| {
            let mut draw = Draw(coin.get());
            let flip = draw.word() & 1 == 1;
            coin.set(draw.0);
            Flip(if flip { -x } else { x })
        })
    }
}

impl Pack for Flip {
    type Scalar = Self;
    type With<R: Clone> = R;
    fn remake<R: Clone>(&self, f: &mut impl FnMut(&Self) -> R) -> R {
        f(self)
    }
    fn each(&mut self, f: &mut impl FnMut(&mut Self)) {
        f(self);
    }
}
impl Fixed for Flip {
    type Of<R: Scalar> = R;
    const LEN: usize = 1;
    fn load(from: &[Self]) -> Self {
        from[0]
    }
    fn store(self, to: &mut [Self]) {
        to[0] = self;
    }
    fn filled(scalar: Self) -> Self {
        scalar
    }
    fn name(_: usize) -> Field {
        Field::VALUE
    }
}
macro_rules! arithmetic {
    ($($trait:ident $method:ident $assign:ident $assigned:ident,)*) => { $(
        impl $trait for Flip {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Flip::any(self.0.$method(other.0))
            }
        }
        impl $assign for Flip {
            fn $assigned(&mut self, other: Self) {
                *self = self.$method(other);
            }
        }
    )* };
}
arithmetic! {
    Add add AddAssign add_assign,
    Sub sub SubAssign sub_assign,
    Mul mul MulAssign mul_assign,
}
impl Div for Flip {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Flip::any(self.0 / other.0)
    }
}
impl Neg for Flip {
    type Output = Self;
    fn neg(self) -> Self {
        Flip::any(-self.0)
    }
}
impl Tangent for Flip {
    type Inner = f64;
    fn value(self) -> f64 {
        self.0
    }
    fn constant(value: f64) -> Self {
        Flip::any(value)
    }
    fn chain(self, [value, ..]: [f64; 4]) -> Self {
        Flip::any(value)
    }
    fn pick(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}

/// Values and derivatives do not change with the signs of zeros inside.
fn flipped<const N: usize, const M: usize, F: Function<N, M>>() {
    let program = F::program::<f64>();
    let vjp = program.vjp();
    let mut draw = Draw(23);
    for kind in (0..1500).filter(|kind| kind % 6 != 4) {
        let x = draw.input::<N>(kind);
        let bar: [f64; M] = from_fn(|i| i as f64);
        let values = program.eval_on(x.map(Flip::any)).map(|y| y.0 + 0.0);
        assert_eq!(
            values.map(f64::to_bits),
            program.eval(x).map(f64::to_bits),
            "{x:?}"
        );
        let derivatives = vjp
            .eval_on((x.map(Flip::any), bar.map(Flip::any)))
            .map(|y| y.0 + 0.0);
        assert_eq!(
            derivatives.map(f64::to_bits),
            vjp.eval((x, bar)).map(f64::to_bits),
            "{x:?}"
        );
    }
}

#[test]
fn signs_of_zeros_inside_change_no_output() {
    use crate::program::{
        AreaObb2, Distance, Everything, FromCorners, IofObb2, IouAabb2, IouObb2, Quadrilateral,
    };
    flipped::<10, 1, IouObb2>();
    flipped::<10, 1, AreaObb2>();
    flipped::<10, 1, IofObb2>();
    flipped::<8, 1, IouAabb2>();
    flipped::<8, 5, FromCorners>();
    flipped::<6, 1, Distance>();
    flipped::<8, 2, Quadrilateral>();
    flipped::<3, 2, Everything>();
}
