//! Rows property as data what the documentation of the crate says.
use crate::rows::finite;
use geograd::ad::jacobian;
use geograd::intersection::crossing_of_lines;
use geograd::kernels::op::Declares as _;
use geograd::kernels::op::{Finite, Limits};
use geograd::{Line2, Pack, Vec2};
use geograd_tests::rows::CrossingOfLines;

/// The second property of the crate's documentation: the rows that it names, and the limits of all others.
fn second_property() -> (String, String) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../src/lib.rs");
    let text = std::fs::read_to_string(path).unwrap();
    let start = text.find("2. **Finite in, finite out.**").unwrap();
    let end = text.find("3. **Ratios stay").unwrap();
    let (list, others) = text[start..end].split_once("All other operations").unwrap();
    (list.to_owned(), others.to_owned())
}

#[test]
fn the_documentation_names_what_is_always_finite() {
    let rows = finite();
    let (list, _) = second_property();
    let mut named: Vec<&str> = list.split('`').skip(1).step_by(2).collect();
    let mut always: Vec<&str> = rows
        .iter()
        .filter(|(_, finite)| *finite == Finite::Always)
        .map(|(name, _)| *name)
        .collect();
    named.sort_unstable();
    always.sort_unstable();
    assert_eq!(named, always);
}

#[test]
fn the_documentation_says_within_which_limits_others_are_finite() {
    let (_, others) = second_property();
    let power = |exponent: i32| {
        let digits: String = exponent.abs().to_string();
        let raised = |digit: char| {
            let all = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
            all[digit.to_digit(10).unwrap() as usize]
        };
        let digits: String = digits.chars().map(raised).collect();
        let sign = if exponent < 0 { "⁻" } else { "" };
        format!("2{sign}{digits}")
    };
    let Limits { single, double } = Limits::ORDINARY;
    let exponents = single.into_iter().chain(double);
    for exponent in exponents.chain(Limits::LEAST_ANGLE) {
        let power = power(exponent);
        assert!(others.contains(&power), "{power} in {others}");
    }
    for (name, finite) in finite() {
        let is_said =
            matches!(finite, Finite::Always) || finite == Finite::Within(Limits::ORDINARY);
        assert!(
            is_said || others.contains(&format!("`{name}`")),
            "{name}: {finite:?}"
        );
    }
}

/// The sine between two lines that are not parallel is as small as their numbers allow.
#[test]
fn derivatives_of_a_crossing_are_finite_within_its_limits() {
    let Finite::Within(Limits { single, .. }) = CrossingOfLines::DECLARED.finite else {
        panic!("a crossing has limits");
    };
    let [small, large] = single.map(|exponent| 2.0_f32.powi(exponent));
    let line = |x: f32, [dx, dy]: [f32; 2]| Line2 {
        point: Vec2::new(x, 0.0),
        direction: Vec2::new(dx, dy),
    };
    let beside = small * (1.0 + f32::EPSILON);
    for other in [[0.0, small], [beside, large]] {
        let pair = (line(0.0, [small, large]), line(large, other));
        let crossing = |(a, b): (Line2<_>, Line2<_>)| {
            let found = crossing_of_lines(a, b);
            (found.point, found.along_a, found.along_b, found.found)
        };
        let ((.., found), (point, along_a, along_b, _)) = jacobian(crossing, pair);
        assert_eq!(found, 1.0);
        let derivatives =
            [point.x, point.y, along_a, along_b].map(|(a, b)| (a.scalars(), b.scalars()));
        for derivative in derivatives.iter().flat_map(|(a, b)| a.iter().chain(b)) {
            assert!(derivative.is_finite(), "{other:?}: {derivatives:?}");
        }
    }
}
