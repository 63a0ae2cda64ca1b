//! Shapes of one's own: what the derive gives a struct of scalars, shapes, arrays, tuples and codes.
use approx::{AbsDiffEq, RelativeEq, UlpsEq};
use geograd::ad::check::sample::{Draw, Family, Sample, hard_cases};
use geograd::ad::check::symmetry::Kind;
use geograd::error::{Argument, Field};
use geograd::{
    Aabb2, Fixed, Flaw, Jet, Obb2, Pack, Pose2, Rotation2, Rule, Scalar, Shape, Validate, Vec2,
    Vec3, ad,
};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

/// An arm on a base, with a bit of everything.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(validate = inner_is_longer)]
struct Robot<S, const N: usize> {
    base: Pose2<S>,
    #[shape(positive)]
    links: [S; 2],
    grid: [[Vec2<S>; 3]; 4],
    pair: (S, Vec2<S>),
    #[shape(angle)]
    joints: [S; N],
    #[shape(number, non_negative)]
    r#gain: S,
    #[shape(at_most = "high")]
    low: Vec2<S>,
    high: Vec2<S>,
    #[shape(code)]
    mode: u8,
    #[shape(code)]
    order: [u16; N],
}
type Three<S> = Robot<S, 3>;

fn inner_is_longer<S: Scalar<Mask = bool>, const N: usize>(
    robot: &Robot<S, N>,
) -> Result<(), Flaw> {
    if robot.links[0].below(robot.links[1]) {
        return Err(Flaw::Broken(Field::new("links"), "are not in order"));
    }
    Ok(())
}

/// Two of them, and a goal.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
struct Cell<S> {
    robots: [Robot<S, 3>; 2],
    goal: Goal<S>,
}

#[derive(Clone, Copy, Debug, PartialEq, Shape)]
struct Goal<S>(
    Vec2<S>,
    #[shape(positive)] pub(crate) S,
    #[shape(code)] bool,
);

/// An arrow in a frame: rules of several numbers together.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
struct Arrow<S> {
    tail: Vec2<S>,
    #[shape(differs_from = "tail")]
    head: Vec2<S>,
    #[shape(non_negative)]
    width: S,
    #[shape(direction, non_zero)]
    up: Vec3<S>,
}

/// Two weights and three.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(non_zero)]
struct Two<S>(S, S);
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(non_zero)]
struct Weights<S>([S; 3]);

/// Numbers in place of every scalar, codes too.
fn counted<P: Fixed<Scalar = f64>>() -> P {
    let numbers: Vec<f64> = (0..P::LEN).map(|i| 10.0 + i as f64).collect();
    let codes: Vec<u32> = (0..P::CODES as u32).map(|i| 1 + i % 2).collect();
    P::load(&numbers).load_codes(&codes)
}

#[track_caller]
fn there_and_back<P>()
where
    P: Fixed<Scalar = f64, Of<f64> = P> + Pack<With<f64> = P> + PartialEq + std::fmt::Debug,
{
    let x: P = counted();
    let mut numbers = vec![0.0; P::LEN + 1];
    x.store(&mut numbers);
    assert_eq!(numbers[..P::LEN], x.scalars());
    assert_eq!((numbers[0], numbers[P::LEN]), (10.0, 0.0));
    assert_eq!(P::load(&numbers).load_codes(&x.codes()), x);
    assert_eq!((x.count(), x.codes().len()), (P::LEN, P::CODES));
    assert_eq!(x.remake(&mut |&n| n), x);
    assert_eq!(x.refill(&numbers[..P::LEN]), x);
    assert!(P::filled(3.0).scalars().iter().all(|&n| n == 3.0));
    let mut moved = x;
    moved.each(&mut |n| *n += 1.0);
    assert_eq!(moved.codes(), x.codes());
    assert!(
        moved
            .scalars()
            .iter()
            .zip(&numbers)
            .all(|(a, b)| a - b == 1.0)
    );
    // As jets: the same numbers, each with its own derivative.
    let mut i = 0;
    let jets: Vec<Jet<f64, 4>> = numbers[..P::LEN]
        .iter()
        .map(|&n| {
            i += 1;
            Jet::variable(n, i - 1)
        })
        .collect();
    let again = P::Of::<Jet<f64, 4>>::load(&jets).scalars();
    assert_eq!(again, jets);
    // Names are all there and all different.
    let mut names = P::names();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), P::LEN);
    assert_eq!(P::name(P::LEN), Field::VALUE);
}

#[test]
fn scalars_go_in_and_come_out_in_order() {
    there_and_back::<Three<f64>>();
    there_and_back::<Robot<f64, 1>>();
    there_and_back::<Cell<f64>>();
    there_and_back::<Goal<f64>>();
    there_and_back::<(f64, Vec2<f64>, [f64; 2], Obb2<f64>, Cell<f64>, (f64,))>();
    there_and_back::<[[Vec2<f64>; 3]; 4]>();
    there_and_back::<(Vec3<f64>, Rotation2<f64>, Aabb2<f64>, Pose2<f64>)>();
    assert_eq!(<[[Vec2<f64>; 3]; 4]>::LEN, 24);
    assert_eq!(<[Vec2<f64>; 0]>::LEN, 0);
    assert_eq!(<[Vec2<f64>; 0]>::load(&[]), []);
    assert_eq!(Three::<f64>::LEN, 4 + 2 + 24 + 3 + 3 + 1 + 2 + 2);
    assert_eq!((Three::<f64>::CODES, Cell::<f64>::CODES), (4, 9));
}

#[test]
fn every_scalar_has_a_name() {
    let names: Vec<String> = Three::<f64>::names().iter().map(Field::to_string).collect();
    let first =
        "base.rotation.cos base.rotation.sin base.translation.x base.translation.y links[0]";
    assert_eq!(names[..5].join(" "), first);
    assert_eq!(names[6 + 2 * (3 * 2 + 1)], "grid[2][1].x");
    let last =
        "pair.0 pair.1.x pair.1.y joints[0] joints[1] joints[2] gain low.x low.y high.x high.y";
    assert_eq!(names[30..].join(" "), last);
    assert_eq!(Cell::<f32>::name(41 + 4).as_str(), "robots[1].links[0]");
    assert_eq!(Cell::<f32>::name(84).as_str(), "goal.1");
    let names = |names: Vec<Field>| {
        names
            .iter()
            .map(Field::to_string)
            .collect::<Vec<_>>()
            .join(" ")
    };
    assert_eq!(names(Obb2::<f64>::names()), "x y width height heading");
    assert_eq!(names(Aabb2::<f64>::names()), "min.x min.y max.x max.y");
    assert_eq!(names(<(f64, [f64; 2])>::names()), "0 1[0] 1[1]");
    assert_eq!(names(f64::names()), "value");
}

#[test]
fn long_names_keep_their_end() {
    let long = "é".repeat(40);
    let name = Field::new("x").within(&long);
    assert!(name.as_str().starts_with('…') && name.as_str().ends_with("é.x"));
    assert!(name.as_str().len() <= 55);
    assert_eq!(Field::new(&"a".repeat(55)).as_str(), "a".repeat(55));
    let deep = (0..30).fold(Field::VALUE, |name, i| name.within_item(i).within("part"));
    assert!(deep.as_str().ends_with("part[1].part[0]"), "{deep}");
    assert_eq!(
        format!("{:?} {:>4}", Field::new("x"), Field::new("y")),
        "Field(\"x\")    y"
    );
}

#[test]
fn arguments_go_by_number_or_name() {
    let all: Vec<_> = (0..6).map(|i| Argument::input(i).to_string()).collect();
    assert_eq!(all.concat(), "abcdef");
    assert_eq!(Argument::named("f").to_string(), "f");
    assert_eq!(Argument::Named("robot").to_string(), "robot");
    assert_eq!(
        (Argument::input(1), Argument::input(6)),
        (Argument::B, Argument::Input(6))
    );
}

/// A valid robot.
fn robot() -> Three<f64> {
    let mut robot: Three<f64> = counted();
    robot.links = [2.0, 1.0];
    robot
}

#[test]
fn flaws_say_where() {
    assert_eq!(robot().validate(), Ok(()));
    let cell = Cell {
        robots: [robot(); 2],
        goal: Goal(Vec2::new(0.0, 1.0), 0.5, true),
    };
    assert_eq!(cell.validate(), Ok(()));
    for i in 0..Cell::<f64>::LEN {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut numbers = cell.scalars();
            numbers[i] = bad;
            let flaw = Flaw::NotFinite(Cell::<f64>::name(i));
            assert_eq!(cell.refill(&numbers).validate(), Err(flaw));
            assert_eq!(
                Cell::<f32>::load(&cell.refill(&numbers).cast::<f32>().scalars()).validate(),
                Err(flaw)
            );
        }
    }
    let refused = |change: fn(&mut Cell<f64>)| {
        let mut cell = cell;
        change(&mut cell);
        cell.validate().unwrap_err().to_string()
    };
    assert_eq!(
        refused(|c| c.robots[1].links[1] = 0.0),
        "robots[1].links[1] is not positive"
    );
    assert_eq!(
        refused(|c| c.robots[0].gain = -1e-300),
        "robots[0].gain is negative"
    );
    assert_eq!(refused(|c| c.goal.1 = -1.0), "goal.1 is not positive");
    assert_eq!(
        refused(|c| c.robots[0].low.y = 1e3),
        "robots[0].low.y is above high"
    );
    assert_eq!(
        refused(|c| c.robots[1].links[1] = 3.0),
        "robots[1].links are not in order"
    );
    // Zeros of either sign are not negative, and equal bounds are in order.
    let mut edge = robot();
    (edge.gain, edge.low) = (-0.0, edge.high);
    assert_eq!(edge.validate(), Ok(()));
    // The library's shapes, inside of others, too.
    let negative = Obb2::new(0.0, 0.0, 1.0, -1.0, 0.0);
    assert_eq!(
        negative.validate(),
        Err(Flaw::Negative(Field::new("height")))
    );
    let pair = (1.0, [Obb2::new(0.0, f64::NAN, 1.0, -1.0, 0.0); 2]);
    assert_eq!(
        pair.validate().unwrap_err().to_string(),
        "1[0].y is not a finite number"
    );
    let wide = Obb2::new(0.0, 0.0, f64::NAN, 1.0, 0.0).validate();
    assert_eq!(wide, Err(Flaw::NotFinite(Field::new("width"))));
    let inverted = Aabb2::new(0.0, 2.0, 1.0, 1.0).validate();
    assert_eq!(inverted, Err(Flaw::Inverted(Field::new("min.y"), "max")));
    assert_eq!(
        f64::NAN.validate().unwrap_err().to_string(),
        "value is not a finite number"
    );
}

#[test]
fn rules_of_several_numbers_say_what_is_wrong() {
    let up = Vec3::new(0.0, 0.0, 1.0);
    let arrow = Arrow {
        tail: Vec2::new(1.0, 2.0),
        head: Vec2::new(1.0, 3.0),
        width: 0.5,
        up,
    };
    assert_eq!(arrow.validate(), Ok(()));
    let mut wrong = arrow;
    wrong.up = Vec3::new(-0.0, 0.0, 0.0);
    assert_eq!(wrong.validate(), Err(Flaw::Zero(Field::new("up"))));
    wrong.head = wrong.tail;
    assert_eq!(
        wrong.validate().unwrap_err().to_string(),
        "head is the tail"
    );
    // Rules of single numbers are looked at first.
    wrong.width = -1.0;
    assert_eq!(wrong.validate(), Err(Flaw::Negative(Field::new("width"))));
    let refused = |flaw: Result<(), Flaw>| flaw.unwrap_err().to_string();
    assert_eq!(refused(Two(0.0, 0.0).validate()), "0 and 1 are both zero");
    assert_eq!(
        refused(Weights([0.0; 3]).validate()),
        "0[0] and the others are all zero"
    );
    assert_eq!(Weights([0.0, 1e-300, 0.0]).validate(), Ok(()));
}

#[test]
fn rules_are_data_in_the_order_of_checks() {
    let of_robot = [
        Rule::NonZero { first: 0, count: 2 },
        Rule::Positive { first: 4, count: 2 },
        Rule::NotNegative {
            first: 36,
            count: 1,
        },
        Rule::Ordered {
            low: 37,
            high: 39,
            count: 2,
        },
    ];
    assert_eq!(Rule::flat(Three::<f64>::RULES), of_robot);
    let of_cell = Rule::flat(Cell::<f64>::RULES);
    assert_eq!((&of_cell[..4], of_cell.len()), (&of_robot[..], 9));
    let second = Rule::NonZero {
        first: 41,
        count: 2,
    };
    let of_goal = Rule::Positive {
        first: 84,
        count: 1,
    };
    assert_eq!((of_cell[4], of_cell[8]), (second, of_goal));
    let of_arrow = [
        Rule::NotNegative { first: 4, count: 1 },
        Rule::Distinct {
            first: 2,
            other: 0,
            count: 2,
        },
        Rule::NonZero { first: 5, count: 3 },
    ];
    assert_eq!(Rule::flat(Arrow::<f32>::RULES), of_arrow);
    let of_three = [Rule::NonZero { first: 0, count: 3 }];
    assert_eq!(Weights::<f64>::RULES, of_three);
    assert!(Rule::flat(<(Vec2<f64>, [f64; 3])>::RULES).is_empty());
    let of_pair = Rule::flat(<(f64, [Two<f64>; 2])>::RULES);
    let at = |first| Rule::NonZero { first, count: 2 };
    assert_eq!(of_pair, [at(1), at(3)]);
}

#[test]
fn comparison_looks_at_every_scalar_and_code() {
    let a = Cell {
        robots: [robot(); 2],
        goal: Goal(Vec2::new(0.25, 1.0), 0.5, true),
    };
    assert!(a.abs_diff_eq(&a, 0.0) && a.relative_eq(&a, 0.0, 0.0) && a.ulps_eq(&a, 0.0, 0));
    for i in 0..Cell::<f64>::LEN {
        let mut numbers = a.scalars();
        numbers[i] += 1e-3;
        let b = a.refill(&numbers);
        assert!(a.abs_diff_eq(&b, 1.1e-3) && !a.abs_diff_eq(&b, 0.9e-3));
        assert!(a.relative_eq(&b, 0.0, 1e-2) && !a.relative_eq(&b, 0.0, 1e-6));
        assert!(!a.ulps_eq(&b, 1e-9, 4));
        numbers[i] = a.scalars()[i].next_up();
        assert!(a.ulps_eq(&a.refill(&numbers), 0.0, 1));
    }
    let mut other = a;
    other.robots[1].order[2] += 1;
    assert!(!a.abs_diff_eq(&other, 1.0));
}

#[test]
fn derivatives_are_shapes() {
    // A function of the place of the robot's hand and of its joints.
    fn reach<S: Scalar, const N: usize>(robot: Robot<S, N>) -> S {
        let hand = robot.base * Vec2::new(robot.links[0], robot.links[1]);
        let bend = robot
            .joints
            .into_iter()
            .fold(S::zero(), |sum, x| sum + x * x);
        hand.dot(robot.grid[3][2]) + robot.pair.0 * bend
    }
    let at = robot();
    let (value, derivatives) = ad::gradient(reach, at);
    let (_, same, curvature) = ad::hessian(reach, at);
    assert_eq!((value, derivatives), (reach(at), same));
    assert_eq!(
        derivatives.pair.0,
        at.joints.iter().map(|x| x * x).sum::<f64>()
    );
    assert_eq!(derivatives.joints[1], 2.0 * at.joints[1] * at.pair.0);
    assert_eq!(derivatives.order, at.order);
    assert_eq!(curvature.joints[1].joints[1], 2.0 * at.pair.0);
    assert_eq!(curvature.pair.0.joints[2], 2.0 * at.joints[2]);
    assert_eq!(derivatives.grid[3][2], at.base * Vec2::new(2.0, 1.0));
}

#[track_caller]
fn samples_are_what_they_should_be<X: Sample + Fixed + PartialEq>() {
    let mut draw = Draw::new(5);
    let families = [
        Family::Any,
        Family::Hard,
        Family::Ordinary,
        Family::Thin,
        Family::Tiny,
        Family::Huge,
        Family::Far,
        Family::Touching,
    ];
    for family in families {
        for _ in 0..200 {
            let x: X = family.draw(&mut draw);
            assert!(x.inside(), "{family:?}: {x:?}");
            let lists = [
                x.kinds().len(),
                x.scales().len(),
                x.units().len(),
                x.extents().len(),
            ];
            assert_eq!(lists, [X::LEN; 4]);
            let lengths = [x.scales(), x.units(), x.extents()].concat();
            assert!(lengths.iter().all(|&s| s > 0.0 && s.is_finite()), "{x:?}");
            for (i, kind) in x.kinds().into_iter().enumerate() {
                let next = x.kinds().get(i + 1).copied();
                assert!(kind != Kind::X || next == Some(Kind::Y));
                assert!(kind != Kind::DirectionX || next == Some(Kind::DirectionY));
            }
        }
    }
    let hard = hard_cases::<X>();
    assert!(hard.len() >= 20 && hard.iter().all(Sample::inside));
    assert!(X::hard().len() <= 500);
}

#[test]
fn samples_obey_the_rules() {
    if !geograd_tests::is_due("samples_obey_the_rules") {
        return;
    }
    samples_are_what_they_should_be::<Three<f64>>();
    samples_are_what_they_should_be::<Cell<f64>>();
    samples_are_what_they_should_be::<Goal<f64>>();
    samples_are_what_they_should_be::<Arrow<f64>>();
    samples_are_what_they_should_be::<Pose2<f64>>();
    samples_are_what_they_should_be::<Vec3<f64>>();
    samples_are_what_they_should_be::<f64>();
    samples_are_what_they_should_be::<[Vec2<f64>; 4]>();
    samples_are_what_they_should_be::<(Vec2<f64>, Vec2<f64>, Vec2<f64>)>();
    samples_are_what_they_should_be::<(Obb2<f64>, Goal<f64>, f64, Pose2<f64>, Aabb2<f64>, f64)>();
    // Numbers of one field are now and then those of another.
    let mut draw = Draw::new(3);
    let ties = (0..2000).filter(|_| {
        let robot = Three::<f64>::draw(&mut draw);
        robot.low.x == robot.high.x
    });
    assert!(ties.count() > 0);
    // Rotations are of unit length.
    let pose: Pose2<f64> = Family::Huge.draw(&mut draw);
    assert!((pose.rotation.cos.hypot(pose.rotation.sin) - 1.0).abs() < 1e-12);
}

#[test]
fn a_function_of_a_shape_of_ones_own_is_checked() {
    fn clearance<S: Scalar>((goal, point): (Goal<S>, Vec2<S>)) -> S {
        goal.0.distance(point).over(goal.1)
    }
    ad::check::Check::random(200, 1)
        .value(clearance)
        .dual(clearance)
        .traced(clearance)
        .gradient(|x| ad::gradient(clearance, x).1)
        .assert();
}

proptest! {
    #[test]
    fn proptest_draws_shapes_of_ones_own(robot in any::<Three<f64>>(), goal in ad::check::strategy::far::<Goal<f64>>()) {
        prop_assert_eq!(robot.validate(), Ok(()));
        prop_assert!(robot.low.x <= robot.high.x && goal.1 > 0.0);
        prop_assert_eq!((robot.mode, goal.2), (0, false));
    }
}

#[test]
fn failing_shapes_of_ones_own_are_made_simple() {
    let config = proptest::test_runner::Config {
        failure_persistence: None,
        ..Default::default()
    };
    let outcome = TestRunner::new(config).run(&any::<(Goal<f64>, Obb2<f64>)>(), |(goal, _)| {
        prop_assert!(goal.1 <= 1.0);
        Ok(())
    });
    let Err(proptest::test_runner::TestError::Fail(_, (goal, shape))) = outcome else {
        panic!("{outcome:?}")
    };
    assert_eq!((goal.0, shape.center), (Vec2::zero(), Vec2::zero()));
    assert!(goal.1 > 1.0 && (64.0 * goal.1).fract() == 0.0);
}
