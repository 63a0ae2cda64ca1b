//! Rows that state where they are defined and how far their values may be off.
use geograd::check::*;
use geograd::kernels::fuzz::{self, Property as Fuzzing};
use geograd::kernels::op::Declares;
use geograd::{Shape, Vec2, Vec3, operation};

/// A pinhole camera at the origin that looks along z.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
pub struct Camera<S> {
    #[shape(positive)]
    focal: S,
    center: Vec2<S>,
}

impl<S: Scalar> Camera<S> {
    fn image(self, point: Vec3<S>) -> Vec2<S> {
        let scale = self.focal.over(point.z);
        Vec2::new(point.x * scale, point.y * scale) + self.center
    }
}

operation! {
    /// The image of a point.
    pub Project = "project": (point: Vec3<S>, camera: Camera<S>) -> Vec2<S> { camera.image(point) }
    invariances []
    jumps Never
    domain { point.z > 0.1 }
    derivative Reverse

    /// The image of a point, of which nothing is said.
    pub ProjectAnywhere = "project_anywhere": (point: Vec3<S>, camera: Camera<S>) -> Vec2<S> { camera.image(point) }
    invariances []
    jumps Never
    derivative Reverse

    /// A root of one number that no random one has.
    pub Nowhere = "nowhere": (x: S) -> S { x.root() }
    invariances []
    jumps Never
    domain { x == 0.123 }
    derivative Reverse

    /// By how much a hyperbola rises above its vertex.
    pub Rise = "rise": (x: S, y: S) -> S { (S::one() + x * x + y * y).root() - S::one() }
    invariances [Exchange Stays]
    jumps Never
    resolution 1e-7
    derivative Reverse

    /// The square of a number, of which a larger one leaves few digits.
    pub Left = "left": (x: S, y: S) -> S { (x * x + y * y) - y * y }
    invariances []
    jumps Never
    roundings { x * x + y * y }
    derivative ByHand |(x, y), out_bar| {
        ((x * x + y * y) - y * y, (((x + y) + (x - y)) * out_bar, S::zero()))
    }

    /// The same, of which nothing is said.
    pub LeftUnsaid = "left_unsaid": (x: S, y: S) -> S { (x * x + y * y) - y * y }
    invariances []
    jumps Never
    derivative ByHand |(x, y), out_bar| {
        ((x * x + y * y) - y * y, (((x + y) + (x - y)) * out_bar, S::zero()))
    }

    /// The same, with a value that is off by more than rounding.
    pub LeftOff = "left_off": (x: S, y: S) -> S {
        let wrong = if S::format().is_compensated() { S::lit(1.0 + 1e-5) } else { S::one() };
        (x * x * wrong + y * y) - y * y
    }
    invariances []
    jumps Never
    roundings { x * x + y * y }
    derivative Reverse

    /// The same, with a derivative that is off by more than rounding.
    pub LeftSteep = "left_steep": (x: S, y: S) -> S { (x * x + y * y) - y * y }
    invariances []
    jumps Never
    roundings { x * x + y * y }
    derivative ByHand |(x, y), out_bar| {
        let wrong = S::lit(1.0 + 1e-5);
        ((x * x + y * y) - y * y, (((x + y) + (x - y)) * wrong * out_bar, S::zero()))
    }

    /// The logarithm of a ratio, which is smaller than one.
    pub Loss = "loss": (part: S, whole: S) -> S { part.over(whole).ln() }
    invariances [Scaling Stays]
    jumps Never
    domain { part > 0.01 && whole > part }
    relative_resolution 1e-4
    derivative ByHand |(part, whole), out_bar| {
        (part.over(whole).ln(), (out_bar.over(part), -out_bar.over(whole)))
    }
}

#[test]
fn a_camera_is_checkable_inside_its_domain() {
    for report in Check::of(Project).run() {
        assert!(report.passed(), "{report}");
        // Every second random point is behind the camera and is drawn anew; hard cases are not.
        assert!(report.outside > 100 && report.samples > 150, "{report}");
        let said = format!(
            "{} inputs outside the domain are not judged",
            report.outside
        );
        assert!(report.to_string().contains(&said), "{report}");
        assert!(
            report
                .json()
                .contains(&format!("\"outside\":{},", report.outside))
        );
    }
}

#[test]
fn a_camera_is_refused_without_a_domain() {
    assert!(ProjectAnywhere::DECLARED.domain.is_none());
    for report in Check::of(ProjectAnywhere).run() {
        assert!(!report.passed(), "{report}");
        assert_eq!(report.outside, 0);
    }
    // A caller's domain stands in the place of the row's.
    for report in Check::of(Project).inside(|_| true).run() {
        assert!(!report.passed() && report.outside == 0, "{report}");
    }
    Check::of(ProjectAnywhere)
        .inside(|(point, _)| point.z > 0.1)
        .assert();
}

#[test]
fn a_wrong_derivative_inside_is_refused() {
    operation! {
        /// The logarithm of a number, with a derivative of something else.
        pub Wrong = "wrong": (x: S) -> S { x.ln() }
        invariances []
        jumps Never
        domain { x > 0.01 }
        derivative ByHand |x, out_bar| { (x.ln(), out_bar.over(x + x)) }
    }
    for report in Check::of(Wrong).run() {
        assert!(
            report.refused_for(Reason::Disagree(Witness::Adjoint, Witness::Dual)),
            "{report}"
        );
        let outside = report
            .failures
            .iter()
            .any(|failure| failure.input.iter().any(|x| *x <= 0.01));
        assert!(!outside, "shrunk out of the domain: {report}");
    }
}

#[test]
fn a_domain_that_leaves_too_few_inputs_is_refused() {
    for report in Check::of(Nowhere).run() {
        assert!(report.refused_for(Reason::FewInside), "{report}");
        assert_eq!(report.samples, 0);
        assert!(report.to_string().contains("samples(0)"), "{report}");
    }
    // With an input of one's own there is something to judge.
    Check::of(Nowhere)
        .samples(0)
        .inside(|x| *x > 0.1 && *x < 0.2)
        .and(0.123)
        .assert();
    // A function's own draws are held to the same.
    let narrow = Check::random(200, 1)
        .value(|x: f64| x.sqrt())
        .gradient(|x| 0.5 / x.sqrt());
    let report = narrow.inside(|x| (0.1..0.1001).contains(x)).run();
    assert!(report.refused_for(Reason::FewInside), "{report}");
}

#[test]
fn a_resolution_is_the_rows() {
    Check::of(Rise).assert();
    Check::of(Loss).assert();
    assert_eq!(
        (Rise::DECLARED.resolution, Loss::DECLARED.resolution),
        ([1e-7, 0.0], [0.0, 1e-4])
    );
    // A caller may ask for more.
    let [single, double] = Check::of(Rise).resolution(0.0).run();
    assert!(
        single.refused_for(Reason::ValuesDisagree(Witness::Wide)),
        "{single}"
    );
    assert!(double.passed(), "{double}");
}

#[test]
fn terms_that_cancel_are_the_rows() {
    Check::of(Left).assert();
    assert!(LeftUnsaid::DECLARED.roundings.is_none());
    let [single, double] = Check::of(LeftUnsaid).run();
    assert!(
        single.refused_for(Reason::ValuesDisagree(Witness::Wide)),
        "{single}"
    );
    assert!(double.passed(), "{double}");
    let [single, _] = Check::of(LeftOff).run();
    assert!(
        single.refused_for(Reason::ValuesDisagree(Witness::Wide)),
        "{single}"
    );
    for report in Check::of(LeftSteep).run() {
        assert!(
            report.refused_for(Reason::Disagree(Witness::Adjoint, Witness::Dual)),
            "{report}"
        );
    }
}

#[test]
fn fuzzers_stay_inside() {
    let fuzzed = fuzz::operation::<Project, f32>(20_000, 1);
    assert_eq!(fuzzed.broken, None, "{fuzzed}");
    assert!(
        fuzzed.outside > 1000 && fuzzed.to_string().contains("outside the domain"),
        "{fuzzed}"
    );
    let fuzzed = fuzz::operation::<Loss, f64>(20_000, 1);
    assert_eq!(fuzzed.broken, None, "{fuzzed}");
    // The pole is found without the domain.
    let broken = fuzz::operation::<ProjectAnywhere, f64>(20_000, 1)
        .broken
        .expect("z = 0");
    assert_eq!(broken.property, Fuzzing::Finite);
    let broken = fuzz::operation::<Nowhere, f64>(20_000, 1)
        .broken
        .expect("nothing to draw");
    assert_eq!(broken.property, Fuzzing::Domain);
}
