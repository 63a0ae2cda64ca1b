//! Programs: what is recorded is what was written, and what cannot be recorded is refused.
use geograd::ad::program::{Program, Sym};
use geograd::{Aabb2, Error, Fixed, Mask, Obb2, Real, Scalar, Unrecordable, Vec2, ad, overlap};

/// A generic function of numbers, on which every kind of scalar is tried.
pub trait Function<const N: usize, const M: usize> {
    /// The function.
    fn eval<S: Scalar>(x: [S; N]) -> [S; M];

    /// Its program.
    fn program<T: Real>() -> Program<[T; N], [T; M]> {
        Program::trace(|x: [Sym<T>; N]| Self::eval(x)).expect("a straight line")
    }
}

/// Functions: name, how many numbers go in and come out, and the body.
macro_rules! functions {
    ($($name:ident $n:literal $m:literal |$x:pat_param| $body:expr;)*) => { $(
        pub struct $name;
        impl Function<$n, $m> for $name {
            fn eval<S: Scalar>($x: [S; $n]) -> [S; $m] {
                $body
            }
        }
    )* };
}
pub(crate) use functions;

fn boxes<S: Scalar>(x: [S; 10]) -> (Obb2<S>, Obb2<S>) {
    Fixed::load(&x)
}

fn bounds<S: Scalar>(x: [S; 8]) -> (Aabb2<S>, Aabb2<S>) {
    Fixed::load(&x)
}

functions! {
    IouObb2 10 1 |x| {
        let (a, b) = boxes(x);
        [overlap::iou_obb2(a, b)]
    };
    AreaObb2 10 1 |x| {
        let (a, b) = boxes(x);
        [overlap::intersection_area_obb2(a, b)]
    };
    IofObb2 10 1 |x| {
        let (a, b) = boxes(x);
        [overlap::iof_obb2(a, b)]
    };
    IouAabb2 8 1 |x| {
        let (a, b) = bounds(x);
        [overlap::iou_aabb2(a, b)]
    };
    AreaAabb2 8 1 |x| {
        let (a, b) = bounds(x);
        [overlap::intersection_area_aabb2(a, b)]
    };
    FromCorners 8 5 |x| {
        let mut numbers = [S::zero(); 5];
        Obb2::from_corners(<[Vec2<S>; 4]>::load(&x)).store(&mut numbers);
        numbers.map(S::canonical)
    };
    // A point and a segment.
    Distance 6 1 |x| {
        let [p, a, b] = <[Vec2<S>; 3]>::load(&x);
        let (d, q) = (b - a, p - a);
        let length = d.dot(d);
        let point = length.at_most(S::lit(S::format().empty()));
        let t = d.dot(q).over(S::select(point, S::one(), length));
        let t = S::select(point, S::zero(), t.clamp(S::zero(), S::one()));
        [(q - d * t).length().canonical()]
    };
    // A quadrilateral's area and the sum of the directions of its corners.
    Quadrilateral 8 2 |x| {
        let corners = <[Vec2<S>; 4]>::load(&x);
        let (mut area, mut turn) = (S::zero(), S::zero());
        for i in 0..4 {
            area += corners[i].perp_dot(corners[(i + 1) % 4]);
            turn += corners[i].angle();
        }
        [area.halved().canonical(), turn.canonical()]
    };
    // Everything that a scalar has.
    Everything 3 2 |[a, b, c]| {
        let kinks = a.least(b).most(c).magnitude() + b.unsigned() * c.clamp(a, S::one());
        let (sin, cos) = a.sin_cos();
        let [(sin_high, sin_low), (cos_high, cos_low)] = b.sin_cos_parts();
        let (high, low) = c.parts();
        let smooth = sin * cos + sin_high * cos_low - sin_low * cos_high + high * low
            + (kinks * kinks + S::one()).ln()
            + (-kinks.magnitude()).exp()
            + a.atan2(b)
            + (a * a + b * b).root().over(c * c + S::one())
            + a.hypot(c) * (c + S::one()).magnitude().binade();
        let rest = smooth + c.powi(3) + b.signed_as(a) + a.tan().saturated();
        [kinks.canonical(), S::select(rest.finite(), rest, S::zero()).canonical()]
    };
}

/// SplitMix64 (Steele, Lea and Flood 2014).
pub struct Draw(pub u64);

impl Draw {
    /// The next word.
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// A number from 0 to 1.
    pub fn unit(&mut self) -> f64 {
        self.word() as f64 / u64::MAX as f64
    }
    /// Positive, tied, signed, signed and tied, wide, and moderate numbers by turns; every fifth time
    /// the second half is the first again.
    pub fn input<const N: usize>(&mut self, kind: usize) -> [f64; N] {
        let mut x = std::array::from_fn(|_| match kind % 6 {
            0 => self.unit() * 4.0,
            1 => (self.unit() * 4.0).floor(),
            2 => self.unit() * 8.0 - 4.0,
            3 => (self.unit() * 9.0).floor() - 4.0,
            4 => ((self.unit() - 0.5) * 40.0).exp(),
            _ => self.unit() * 3.0 + 0.2,
        });
        if kind % 5 == 4 {
            x.copy_within(..N / 2, N / 2);
        }
        x
    }
}

/// Bits of numbers; one pattern for every NaN.
fn bits<T: Into<f64> + Copy, const M: usize>(x: [T; M]) -> [u64; M] {
    x.map(|x| {
        let x: f64 = x.into();
        if x.is_nan() { 0 } else { x.to_bits() }
    })
}

/// A function and its program agree to the bit in both formats.
fn agrees<const N: usize, const M: usize, F: Function<N, M>>() {
    let (single, double) = (F::program::<f32>(), F::program::<f64>());
    let mut draw = Draw(7);
    for kind in 0..3000 {
        let x = draw.input::<N>(kind);
        assert_eq!(bits(double.eval(x)), bits(F::eval(x)), "{x:?}");
        let x = x.map(|x| x as f32);
        assert_eq!(bits(single.eval(x)), bits(F::eval(x)), "{x:?}");
    }
    let special = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        f64::MAX,
        1e30,
        1e-30,
        5e-324,
        f64::INFINITY,
        f64::NAN,
    ];
    for _ in 0..3000 {
        let x: [f64; N] = std::array::from_fn(|_| special[draw.word() as usize % special.len()]);
        // A program keeps what a function may lose: a NaN of its input is NaN of every number of its result.
        let none = x.iter().any(|x| x.is_nan());
        let expected = if none { [0; M] } else { bits(F::eval(x)) };
        assert_eq!(bits(double.eval(x)), expected, "{x:?}");
        let x = x.map(|x| x as f32);
        let expected = if none { [0; M] } else { bits(F::eval(x)) };
        assert_eq!(bits(single.eval(x)), expected, "{x:?}");
    }
}

#[test]
fn a_program_has_the_bits_of_its_function() {
    agrees::<10, 1, IouObb2>();
    agrees::<10, 1, AreaObb2>();
    agrees::<10, 1, IofObb2>();
    agrees::<8, 1, IouAabb2>();
    agrees::<8, 1, AreaAabb2>();
    agrees::<8, 5, FromCorners>();
    agrees::<6, 1, Distance>();
    agrees::<8, 2, Quadrilateral>();
    agrees::<3, 2, Everything>();
}

/// A pair of boxes of symbols.
type Pair<T> = (Obb2<Sym<T>>, Obb2<Sym<T>>);

#[test]
fn an_adjoint_by_hand_is_recorded_to_the_bit() {
    fn check<T: Real>() {
        let value = Program::trace(|(a, b): Pair<T>| a.iou(b)).unwrap();
        let by_hand = value
            .with_adjoint(|(a, b): Pair<T>| ad::adjoint::overlap::iou_obb2_grad(a, b).1)
            .unwrap();
        let (value_grad, vjp) = (by_hand.value_grad(), by_hand.vjp());
        let mut draw = Draw(3);
        for kind in 0..2000 {
            let x = draw.input::<10>(kind).map(T::lit);
            let (a, b) = boxes(x);
            let (value, derivatives) = ad::adjoint::overlap::iou_obb2_grad(a, b);
            let found = value_grad.eval((a, b));
            let flat = |x: (T, (Obb2<T>, Obb2<T>))| {
                let mut all = [T::zero(); 11];
                x.store(&mut all);
                all.map(|x| x.canonical().widen())
            };
            let numbers = bits(flat((value, derivatives)));
            assert_eq!(bits(flat(found)), numbers, "{a:?} {b:?}");
            // The cotangent of the result is a number of its own.
            let pulled = vjp.eval(((a, b), T::one()));
            assert_eq!(bits(flat((value, pulled))), numbers);
        }
    }
    check::<f32>();
    check::<f64>();
}

/// Why a function of one number is refused.
fn refusal<Y: Fixed<Scalar = Sym<f32>>>(function: impl Fn(Sym<f32>) -> Y) -> Option<Unrecordable> {
    match Program::<f32, Y::Of<f32>>::trace(function) {
        Ok(_) => None,
        Err(Error::Program(why)) => Some(why),
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn symbols_of_another_recording_are_refused() {
    let foreign = Some(Unrecordable::ForeignSymbol);
    // Made outside any recording: nothing happens to it there.
    let before = Sym::<f32>::lit(2.0);
    let sum = (before + before).least(before);
    assert!(!sum.below(before).any() || sum.below(before).any());
    assert_eq!(refusal(|x| x + before), foreign);
    assert_eq!(refusal(|_| before), foreign);
    // Symbols of the outer recording in the inner one, and the other way round.
    let within = refusal(|x| {
        assert_eq!(refusal(|y| x * y), foreign);
        assert_eq!(refusal(|_| x), foreign);
        x
    });
    assert_eq!(within, None);
    let kept = std::cell::Cell::new(before);
    assert_eq!(
        refusal(|x| {
            kept.set(x);
            x
        }),
        None
    );
    assert_eq!(refusal(|x| x.most(kept.get())), foreign);
    let masks = refusal(|x| Sym::select(kept.get().below(kept.get()), x, x + Sym::one()));
    assert_eq!(masks, foreign);
    // Symbols of another format have no way into a result, nor into an outer recording of their own format.
    assert_eq!(
        refusal(|x| {
            let _ = Sym::<f64>::one();
            x
        }),
        None
    );
    let outer = Program::<f64, f64>::trace(|x: Sym<f64>| {
        let inside = std::cell::Cell::new(x);
        let inner = refusal(|y| {
            inside.set(Sym::one());
            y
        });
        assert_eq!(inner, None);
        x + inside.get()
    });
    assert_eq!(outer.err(), foreign.map(Error::Program));
    // Symbols of another thread.
    let elsewhere = refusal(|x| {
        let other = std::thread::scope(|s| s.spawn(|| x + x).join());
        x + other.expect("it does not panic")
    });
    assert_eq!(elsewhere, foreign);
    // A panic inside leaves nothing behind.
    let _ = std::panic::catch_unwind(|| refusal(|x| if true { panic!("inside") } else { x }));
    assert_eq!(refusal(|x| x + Sym::one()), None);
}

#[test]
fn a_function_that_needs_its_hints_is_refused() {
    let zero = Sym::<f32>::zero;
    let hint = Some(Unrecordable::Hint);
    assert_eq!(
        refusal(|x| if x.below(zero()).any() { -x } else { x }),
        hint
    );
    assert_eq!(
        refusal(|x| if x.below(zero()).all() { -x } else { x }),
        hint
    );
    assert_eq!(
        refusal(|x| if (!x.below(zero())).any() { x } else { -x }),
        hint
    );
    // Leaving early is what they are for.
    let early = refusal(|x| {
        let negative = x.below(zero());
        if negative.all() {
            return zero();
        }
        let mut large = x;
        if x.above(Sym::one()).any() {
            large = x.least(Sym::one());
        }
        Sym::select(negative, zero(), large)
    });
    assert_eq!(early, None);
    // So is what is known.
    assert_eq!(
        refusal(|x| if zero().below(Sym::one()).all() {
            x
        } else {
            -x
        }),
        None
    );
    // Loops that wait for a hint end.
    let endless = |x: Sym<f32>| {
        let mut y = x;
        while !y.above(Sym::one()).all() {
            y += Sym::one();
        }
        y
    };
    assert_eq!(refusal(endless), Some(Unrecordable::TooLong));
}

#[test]
fn infinite_and_nan_literals_are_refused() {
    let constant = Some(Unrecordable::Constant);
    assert_eq!(refusal(|x| x + Sym::lit(f64::NAN)), constant);
    assert_eq!(refusal(|x| x.least(Sym::lit(f64::INFINITY))), constant);
    assert_eq!(refusal(|_| Sym::lit(f64::NEG_INFINITY)), constant);
    assert_eq!(refusal(|x| x + Sym::lit(1e39)), constant);
    assert!(Program::trace(|x: Sym<f64>| x + Sym::lit(1e39)).is_ok());
    // One that nothing depends on does no harm.
    let unused = refusal(|x| {
        let _ = x + Sym::lit(f64::NAN);
        x
    });
    assert_eq!(unused, None);
    // A quotient of constants is no literal.
    assert_eq!(
        refusal(|x| Sym::select(x.below(Sym::zero()), x, Sym::one() / Sym::zero())),
        None
    );
}

#[test]
fn programs_can_be_read() {
    let program = Program::trace(|(p, b): (Vec2<Sym<f32>>, Obb2<Sym<f32>>)| {
        (p - b.center).length().most(b.size.x.halved())
    });
    let program = program.unwrap();
    let text = program.to_string();
    assert!(text.starts_with("v"), "{text}");
    for line in ["0.x − 1.x", "1.width · 0.5", "most(", "result value: v"] {
        assert!(text.contains(line), "{line} in {text}");
    }
    let cost = program.cost();
    assert_eq!((cost.roots, cost.divisions), (1, 1));
    assert_eq!(text.lines().count(), cost.total() + 1);
}

#[test]
fn names_of_shader_functions_are_checked() {
    let program = Program::trace(|x: Sym<f32>| x).unwrap();
    for name in [
        "",
        "1x",
        "a-b",
        "union",
        "fn",
        "_",
        "__x",
        "min",
        "program_root",
        "é",
    ] {
        let refused = Err(Error::Program(Unrecordable::Name));
        assert_eq!(program.wgsl(name), refused, "{name}");
    }
    assert!(program.wgsl("clearance_2").is_ok());
}
