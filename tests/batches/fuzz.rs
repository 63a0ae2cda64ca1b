//! Unexpected inputs, and tests that the fuzzers find planted faults.
use geograd::kernels::fuzz::{self, Fuzzed, Property};
use geograd::kernels::op::{Declared, Declares, Derivative, Finite, Jumps, Limits, Op};
use geograd::kernels::{Cpu, Single};
use geograd::{Aabb2, Fixed, Obb2, Pack, Real, Scalar};
use geograd_tests::fuzzers::{Fuzzer, fuzzers, walk};
use geograd_tests::list;
use geograd_tests::rows::{GiouObb2, IntersectionAreaQuads, IouAabb2, IouAabb3, IouObb2, IouObb3};

/// Inputs of every row in either format; the report takes many more.
const COUNT: u64 = 512;

#[test]
fn every_operation_keeps_its_properties() {
    let mut broken = Vec::new();
    // The report fuzzes every row.
    let rows = list::sample(list::rows(), &[]);
    for fuzzer in fuzzers(rows.clone()) {
        let fuzzed = (fuzzer.run)(COUNT, 2);
        let Fuzzer { name, wide, .. } = fuzzer;
        let is_named = |row: &&&list::Tested| row.name() == name;
        let is_costly = rows
            .iter()
            .find(is_named)
            .is_some_and(|row| row.operation.costly);
        assert!(is_costly || fuzzed.inputs >= COUNT, "{name}, f64: {wide}");
        if fuzzed.broken.is_some() {
            broken.push(fuzzed.to_string());
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// Asserts the properties of pairs of shapes, for upstream derivatives of any size. All derivatives are finite, a
/// batch has the bits of the scalar code, and exchanging the shapes changes the value by little at most.
fn bears<O, P, T>(inputs: &[&[f64]])
where
    O: Op<In<T> = (P, P), Out<T> = T>,
    P: Single<Scalar = T>,
    T: Real + Single<Scalar = T>,
{
    let largest = T::lit(T::format().largest());
    let upstream = [0.0, 1.0, -1.0, 0.25, -0.25, 0.75, -0.75].map(|power: f64| match power {
        0.0 => T::lit(0.0),
        _ => T::lit(T::format().largest().powf(power.abs())).signed_as(T::lit(power)),
    });
    let upstream = [
        &upstream[..],
        &[
            T::one(),
            -largest,
            T::lit(T::format().largest().powf(-0.25)),
        ],
    ]
    .concat();
    for &input in inputs {
        let numbers: Vec<T> = input.iter().map(|&x| T::lit(x)).collect();
        let (a, b) = <(P, P)>::load(&numbers);
        let (all_a, all_b) = (vec![a; upstream.len()], vec![b; upstream.len()]);
        let columns = ((&all_a, &all_b), &upstream);
        let (by_a, by_b) = Cpu::new().aligned(O::default().vjp(), columns).unwrap();
        let values = Cpu::new().aligned(O::default(), (&all_a, &all_b)).unwrap();
        for (i, &out_bar) in upstream.iter().enumerate() {
            let (value, derivatives) = O::adjoint::<T>((a, b), out_bar).unwrap();
            let found = [vec![values[i]], by_a[i].scalars(), by_b[i].scalars()].concat();
            let expected = [vec![value], derivatives.scalars()].concat();
            let bits =
                |all: &[T]| -> Vec<u64> { all.iter().map(|x| x.widen().to_bits()).collect() };
            let at = format!("{} {input:?} upstream {out_bar:?}", O::DECLARED.name);
            assert!(found.iter().all(|x| x.finite()), "{at}: {found:?}");
            assert_eq!(bits(&found), bits(&expected), "{at}");
        }
        let (one, other) = (O::eval::<T>((a, b)), O::eval::<T>((b, a)));
        let apart = (one - other).unsigned().widen();
        assert!(
            apart <= 1e-4 * one.widen().abs(),
            "{} {input:?}: {one:?} {other:?}",
            O::DECLARED.name
        );
    }
}

/// Findings of the fuzzers: results that were not finite, or a value that was lost beside a distance or a size.
#[test]
fn what_was_found_once_stays_mended() {
    bears::<IouAabb3, _, f32>(&[
        &[
            -5.3117275880523994e32,
            7.805729765060477e-32,
            -339.8153381347656,
            2.8279773617072184e-23,
            1272039168.0,
            -1.1901487596333027e-5,
            -1.1680165061327911e-14,
            6.537822562611398e-19,
            -1.0020114952449283e27,
            3.459728434729997e-13,
            2483625505325056.0,
            8.726122356791107e-39,
        ],
        &[
            -2.0, 0.25, 2.0, 2.0, 1000.0, 3.0, 3.0, -1.0, 0.1, 3.0, 1.0, 1000.0,
        ],
    ]);
    bears::<IouAabb3, _, f64>(&[&[
        1.7050285759525815e176,
        2.146874615838811e154,
        -3.7132836603582085e45,
        9.780314587654096e292,
        8.806635730699171e231,
        -8.268622564693818e-308,
        9.524622019483721e-144,
        -3.840862118237203e234,
        -1.728840036628228e-272,
        6.007399745615237e-59,
        2.8432633809196295e-194,
        1.1382963625565885e301,
    ]]);
    bears::<IouObb3, _, f32>(&[
        &[
            1.749783152572848e-12,
            3.8502402097481606e26,
            -6.723122393556699e-20,
            8.614187141375851e-10,
            92.01396942138672,
            6.707680924574749e33,
            -4.049468504867029e-20,
            3.356402465501117e-22,
            1.4279730390015155e-20,
            6.906721677253573e-32,
            1.962410174960654e24,
            3.419786455048421e28,
            -104120032.0,
            3.064403472308186e-6,
            2171509.0,
            5.051311754861998e-30,
            2.897117261775818e20,
            6.7599797287654084e-12,
            1184186.875,
            1.0,
        ],
        &[
            0.0010000000474974513,
            0.5,
            0.0,
            0.5,
            1000.0,
            1.0,
            -2.0,
            0.10000000149011612,
            -0.5,
            -0.10000000149011612,
            2.0,
            0.0010000000474974513,
            -0.0,
            0.10000000149011612,
            1000.0,
            3.0,
            3.0,
            -1.0,
            -1.0,
            -0.10000000149011612,
        ],
        &[
            -4878376960.0,
            -1.9822790058255414e-30,
            4.2669624599626383e18,
            5721.2431640625,
            1.2499489039145222e30,
            0.0002931237977463752,
            2.653387580749316e-27,
            3.3762464193441326e-22,
            -2.3830692922845724e-26,
            6.405671875458778e-34,
            -1.857108129334356e33,
            2.7941904745196435e23,
            0.004735283087939024,
            9.65995153330919e-27,
            3.8041091641423745e-29,
            6.044701238262497e17,
            1.0235133206059179e-16,
            6.974265938696649e20,
            0.00017987939645536244,
            -1.390534586352891e-37,
        ],
    ]);
    bears::<IouObb3, _, f64>(&[
        &[
            6.513409745181349e-97,
            2.567785626158306e210,
            -2.2393416073925992e-156,
            1.9887353411889703e-75,
            26418998555957.234,
            2.203680854013573e268,
            -3.554223495948308e-158,
            8.491324038473306e-175,
            1.2707650510816972e-161,
            2.6336496131007862e-252,
            1.132706523047224e192,
            1.0733781705813093e226,
            -7.261176844408354e61,
            4.057285076490894e-47,
            3.752113075801592e48,
            2.219497857611947e-237,
            3.836008783242533e161,
            2.8616227284508406e-92,
            2.362676317766547e46,
            -4.053388621798091e306,
        ],
        &[
            21.62681892038197,
            -0.014795574130995172,
            -6.171775295172341e-5,
            0.6167764876333766,
            51386.19726325238,
            0.11306685459345663,
            -4855.83424787644,
            0.0013027463609021528,
            -0.14831952788347577,
            -0.4836558234075825,
            80.42180640788848,
            31940.24945037029,
            243.99713577373592,
            1252.9693504794438,
            5.873345950242516,
            0.06264583106534333,
            0.00013944339505707706,
            0.001306102769513024,
            -0.004596778356079602,
            -1.6633254651365508,
        ],
    ]);
    bears::<GiouObb2, _, f32>(&[
        &[
            -6.595918765753448e-18,
            -2.302835677589094e-34,
            5.469069302818057e33,
            9.250903993488956e-24,
            6.71528843749817e34,
            -4.401980169266295e-11,
            -7.110066158048379e18,
            5.161460429811875e30,
            8.69404800596385e-7,
            1.0669495891601952e23,
        ],
        &[
            0.0010000000474974513,
            0.0,
            0.0,
            0.5,
            1000.0,
            -0.00023910703021101654,
            0.0016749283531680703,
            6.435664545278996e-5,
            1.4718323945999146,
            18620.083984375,
        ],
        &[
            11000.046875,
            5.18359375,
            0.005333221051841974,
            0.0004602951230481267,
            5.774216333520599e-5,
            0.030493304133415222,
            -0.03085140325129032,
            0.00022155513579491526,
            1.9012844859389588e-5,
            -4690.07470703125,
        ],
        &[
            -2391.204345703125,
            -0.000515497347805649,
            0.00011199453001609072,
            0.002313787816092372,
            -120.32676696777344,
            63899.12890625,
            33.786746978759766,
            2.7035422325134277,
            0.0009743024129420519,
            -0.00014884811228744686,
        ],
    ]);
    bears::<GiouObb2, _, f64>(&[&[
        3.2158187929024874e-5,
        -2.8499249474759874e-5,
        19294.326363830663,
        0.06555801206211084,
        0.00028327652354769,
        0.000319954260629636,
        -1.3448490763057463,
        84.1878084961342,
        8412.815985306312,
        -674.5641282017436,
    ]]);
    bears::<IntersectionAreaQuads, _, f32>(&[&[
        -0.0004366409848444164,
        -7392.21923828125,
        0.024036366492509842,
        2258.95166015625,
        -59.38207244873047,
        2258.270263671875,
        -59.40654373168945,
        -7392.90087890625,
        0.004957991652190685,
        0.006903369911015034,
        0.8323133587837219,
        0.00698424456641078,
        0.8322359919548035,
        0.36476972699165344,
        0.004880629014223814,
        0.3646888732910156,
    ]]);
    bears::<IntersectionAreaQuads, _, f64>(&[
        &[
            0.4078200989102514,
            -2.4566182769908703e-5,
            -865.6409834173405,
            -16.62311749551116,
            -865.6409755575578,
            -18.066986480840015,
            0.40782795869299776,
            -1.4438935515116231,
            -0.01293139196036203,
            0.009972985789252941,
            -9.684249461846829,
            -27.051752808247134,
            14396.655848007345,
            -42.304312524553445,
            14406.327166077232,
            -15.24258673051706,
        ],
        &[
            554.9810126547665,
            4906.765216894044,
            -2115.4405091865374,
            4906.765293170079,
            -2115.4471585899696,
            -362.1760796644221,
            554.9743632513342,
            -362.17615594045674,
            7.928297504041431e-6,
            0.1568563934254923,
            -0.007611275372218528,
            0.17774357961879095,
            -0.020489721619003136,
            0.17775824498758344,
            -0.012870517949280565,
            0.15687105879428478,
        ],
        &[
            0.40530005747689885,
            -0.4986583858753335,
            23.606084908656108,
            -0.49856836089419093,
            15.33052631812795,
            0.19721041386571275,
            -7.870258533051259,
            0.19712038888457017,
            6.627482915360803,
            -0.00119487426983012,
            6.627429067130849,
            -0.0012013176457983355,
            6.627476551627947,
            -0.001280139162400823,
            6.627530399857901,
            -0.0012736957864326074,
        ],
    ]);
}

/// The overlap of rotated boxes with a mistake.
#[derive(Clone, Copy, Debug, Default)]
struct Faulty<const FAULT: usize>;

/// A derivative is no number where a box is long.
const NO_NUMBER: usize = 0;
/// Boxes that share more than half have a score above one.
const OUT_OF_RANGE: usize = 1;
/// Identical boxes are nearly so.
const NOT_ITSELF: usize = 2;
/// The first box counts more.
const ONE_SIDED: usize = 3;
/// There are no derivatives to record.
const REFUSED: usize = 4;
/// Boxes apart share a little.
const NOT_APART: usize = 5;
/// The value beside derivatives is another one.
const OTHERWISE_BY_HAND: usize = 6;

impl<const FAULT: usize> Declares for Faulty<FAULT> {
    const DECLARED: Declared = IouObb2::DECLARED.derivative(Derivative::ByHand);
}

impl<const FAULT: usize> Op for Faulty<FAULT> {
    type In<S: Scalar> = (Obb2<S>, Obb2<S>);
    type Out<S: Scalar> = S;
    fn eval<S: Scalar>((a, b): Self::In<S>) -> S {
        faulty::<S, FAULT>(a, b, IouObb2::eval((a, b)))
    }
    fn adjoint<S: Scalar>((a, b): Self::In<S>, out_bar: S) -> Option<(S, Self::In<S>)> {
        if FAULT == REFUSED {
            return None;
        }
        let (value, (mut a_bar, b_bar)) = IouObb2::adjoint((a, b), out_bar)?;
        if FAULT == NO_NUMBER {
            let long = a.size.x.above(S::lit(2e4)) & value.above(S::zero());
            let nothing = a.size.x * S::zero();
            a_bar.heading = S::select(long, nothing.over(nothing), a_bar.heading);
        }
        if FAULT == OTHERWISE_BY_HAND {
            return Some((value * S::lit(1.0 - 1e-6), (a_bar, b_bar)));
        }
        Some((faulty::<S, FAULT>(a, b, value), (a_bar, b_bar)))
    }
}

/// The value with a mistake.
fn faulty<S: Scalar, const FAULT: usize>(a: Obb2<S>, b: Obb2<S>, value: S) -> S {
    let when = |mask, x: S| S::select(mask, x, value);
    match FAULT {
        OUT_OF_RANGE => {
            let many = value.above(S::lit(0.5)) & value.below(S::one());
            when(many, value + S::lit(0.75))
        }
        NOT_ITSELF => when(value.equals(S::one()), value - S::lit(1e-3)),
        ONE_SIDED => when(a.size.x.above(b.size.x), value.over(S::lit(1.001))),
        NOT_APART => when(value.equals(S::zero()), S::lit(1e-3)),
        _ => value,
    }
}

/// The findings of the fuzzer about an operation.
fn found<const FAULT: usize>() -> Fuzzed {
    let fuzzed = fuzz::operation::<Faulty<FAULT>, f32>(1_000_000, 3);
    let broken = fuzzed.broken.as_ref();
    assert!(
        broken.is_none_or(|broken| broken.input.len() == 10),
        "both boxes are named"
    );
    fuzzed
}

fn property<const FAULT: usize>() -> Option<Property> {
    found::<FAULT>().broken.map(|broken| broken.property)
}

#[test]
fn what_is_wrong_is_found_and_named() {
    assert_eq!(property::<NO_NUMBER>(), Some(Property::Finite));
    assert_eq!(property::<OUT_OF_RANGE>(), Some(Property::Range));
    assert_eq!(property::<NOT_ITSELF>(), Some(Property::Identical));
    assert_eq!(property::<ONE_SIDED>(), Some(Property::Symmetric));
    assert_eq!(property::<NOT_APART>(), Some(Property::Apart));
    assert_eq!(property::<OTHERWISE_BY_HAND>(), Some(Property::SameBits));
    assert_eq!(property::<REFUSED>(), Some(Property::Accepted));
}

#[test]
fn a_walk_that_finds_something_fails() {
    let of = |run: fn(u64, u64) -> Fuzzed| Fuzzer {
        name: "iou_obb2",
        wide: false,
        run: Box::new(run),
    };
    let fuzzers = [
        of(fuzz::operation::<IouObb2, f32>),
        of(fuzz::operation::<Faulty<OUT_OF_RANGE>, f32>),
    ];
    let mut lines = Vec::new();
    let walked = walk(&fuzzers, 100_000, 1, |fuzzed| {
        lines.push(fuzzed.to_string())
    });
    assert_eq!((walked.broken, walked.status()), (1, 1));
    // Walks side by side end in any order.
    lines.sort_by_key(|line| line.contains("Faulty"));
    assert!(lines[0].ends_with(": ok"), "{}", lines[0]);
    assert!(
        lines[1].contains("the value is out of range\n    Faulty"),
        "{}",
        lines[1]
    );
    assert_eq!(walk(&fuzzers[..1], 2000, 1, |_| {}).status(), 0);
}

#[test]
fn what_is_found_is_simple_and_code() {
    let fuzzed = found::<NO_NUMBER>();
    let broken = fuzzed.broken.clone().unwrap();
    // A width above 20,000, and whatever lies on it; all else is as simple as can be.
    assert!(broken.input[2] > 2e4, "{broken:?}");
    let plain = broken.input.iter().filter(|x| [0.0, 1.0].contains(x));
    assert!(plain.count() >= 8, "{broken:?}");
    let start = "Obb2 { center: Vec2 { x: 0.0, y: 0.0 }, size: Vec2 { x: ";
    assert!(broken.code.contains(start), "{fuzzed}");
    let line = fuzzed.to_string();
    assert!(line.contains("a number is not finite"), "{line}");
}

/// The derivatives of a product and a quotient as they come, without a guard.
#[derive(Clone, Copy, Debug, Default)]
struct Unguarded<const LIMITED: bool>;

impl<const LIMITED: bool> Declares for Unguarded<LIMITED> {
    const DECLARED: Declared = Declared::new("unguarded", &[], Jumps::Anywhere)
        .derivative(Derivative::Reverse)
        .finite(match LIMITED {
            true => Finite::Within(Limits::new([-20, 20], [-200, 200])),
            false => Finite::Always,
        });
}

impl<const LIMITED: bool> Op for Unguarded<LIMITED> {
    type In<S: Scalar> = (Aabb2<S>, S);
    type Out<S: Scalar> = S;
    fn eval<S: Scalar>((shape, x): Self::In<S>) -> S {
        (shape.max.x - shape.min.x) * x
    }
}

#[test]
fn limits_are_kept_to() {
    let always = fuzz::operation::<Unguarded<false>, f32>(100_000, 1);
    assert_eq!(always.broken.unwrap().property, Property::Finite);
    let limited = fuzz::operation::<Unguarded<true>, f32>(100_000, 1);
    assert_eq!(limited.broken, None, "{limited}");
}

/// The rounding error of a difference is a number for a coordinate at the largest number, too.
#[test]
fn differences_of_the_largest_numbers_are_finite() {
    bears::<GiouObb2, _, f32>(&[&[
        0.0,
        f64::from(f32::MAX),
        1.0,
        1.0,
        0.0,
        0.0,
        1.5077232415859413e38,
        1.0,
        1.0,
        0.0,
    ]]);
    // A thin box beside a huge one that is turned: apart, and nothing is left of it in the derivatives.
    let huge = Obb2::new(-7.319668e22_f32, 0.0, 1.8446735e19, 9.2233715e18, 0.5);
    let thin = Obb2::new(0.0_f32, 0.0, 1.0, 0.0, 0.0);
    let (value, bars) = IouObb2::adjoint((huge, thin), 1.0).unwrap();
    assert!(
        value == 0.0 && bars.scalars().iter().all(|&x| x == 0.0),
        "{value} {bars:?}"
    );
}

/// Derivatives of boxes apart, one of them flat, near the limits of the format.
#[test]
fn derivatives_of_flat_boxes_apart_are_zero() {
    fn zero<T: Real + Single<Scalar = T>>(numbers: [[f64; 4]; 2]) {
        let [a, b] = numbers.map(|x| Aabb2::load(&x.map(T::lit)));
        let (value, bars) = IouAabb2::adjoint::<T>((a, b), T::one()).unwrap();
        let derivatives = [vec![value], bars.scalars()].concat();
        assert!(
            derivatives.iter().all(|x| *x == T::zero()),
            "{a:?} {b:?}: {derivatives:?}"
        );
        let (values, (by_a, by_b)) = Cpu::new()
            .aligned(IouAabb2.value_grad(), (&[a], &[b]))
            .unwrap();
        let derivatives = [values, by_a[0].scalars(), by_b[0].scalars()].concat();
        assert!(
            derivatives.iter().all(|x| *x == T::zero()),
            "{a:?} {b:?}: {derivatives:?}"
        );
    }
    let most = f64::from(f32::MAX);
    zero::<f32>([[1.0, 0.0, 2.0, 1.0], [-most, 0.0, -most, 1.0]]);
    zero::<f64>([[1.0, 0.0, 2.0, 1.0], [-f64::MAX, 0.0, -f64::MAX, 1.0]]);
    zero::<f32>([[0.0, 0.0, 1.0, 1.0], [0.0, -1e29, 1e-10, -1e29]]);
}
