//! Errors name arguments as rows do.
use geograd::distance::distance;
use geograd::error::{Argument, Field};
use geograd::kernels::{Cpu, Distance, MinimumRectangle, One};
use geograd::{ConvexPolygon, Error, Flaw, Obb2, Segment2, Vec2, operation};

operation! {
    /// How far a robot is from a wall, less what it must keep.
    pub Spare = "spare": (robot: Vec2<S>, wall: Segment2<S>, margin: S) -> S {
        distance(robot, wall) - margin
    }
    invariances []
    jumps Never
    derivative Reverse
}

const NAN: Vec2<f64> = Vec2 {
    x: f64::NAN,
    y: 0.0,
};

fn wall() -> Segment2<f64> {
    Segment2::new(Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0))
}

#[test]
fn a_shape_that_is_not_valid() {
    let (cpu, here) = (Cpu::new(), Vec2::new(0.5, 1.0));
    let columns = (&[here, NAN], One(wall()), One(0.1));
    let error = cpu.aligned(Spare, columns).unwrap_err();
    let flaw = Flaw::NotFinite(Field::new("x"));
    let (argument, row) = (Argument::Named("robot"), 1);
    assert_eq!(
        error,
        Error::Invalid {
            argument,
            item: row,
            flaw
        }
    );
    assert_eq!(
        error.to_string(),
        "`robot` item 1: x is not a finite number"
    );
    // With derivatives, too.
    assert_eq!(cpu.aligned(Spare.value_grad(), columns).unwrap_err(), error);
    assert_eq!(cpu.aligned(Spare.jacobian(), columns).unwrap_err(), error);
    assert_eq!(
        cpu.aligned(Spare.vjp(), (columns, One(1.0))).unwrap_err(),
        error
    );
    let error = cpu
        .aligned(Spare, (&[here], One(wall()), &[f64::INFINITY]))
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "`margin` item 0: value is not a finite number"
    );
}

#[test]
fn a_column_of_another_length() {
    let here = [Vec2::new(0.5, 1.0); 3];
    let error = Cpu::new()
        .aligned(Spare, (&here, &[wall(); 2], One(0.1)))
        .unwrap_err();
    let (argument, expected, found) = (Argument::Named("wall"), 3, 2);
    assert_eq!(
        error,
        Error::Length {
            argument,
            expected,
            found
        }
    );
    assert_eq!(error.to_string(), "`wall` has 2 items where 3 are needed");
    // The cotangents are the call's, not the row's.
    let columns = ((&here, One(wall()), One(0.1)), &[1.0; 2]);
    let error = Cpu::new().aligned(Spare.vjp(), columns).unwrap_err();
    assert_eq!(
        error.to_string(),
        "`upstream` has 2 items where 3 are needed"
    );
}

#[test]
fn all_pairs_and_searches() {
    let error = Cpu::new()
        .all_pairs(Distance, &[NAN], &[wall()])
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "`point` item 0: x is not a finite number"
    );
    let polygon = ConvexPolygon::<f64, 4>::from(Obb2::new(0.0, 0.0, 2.0, 1.0, 0.3));
    let mut flawed = polygon;
    flawed.vertices[0].x = f64::NAN;
    let error = Cpu::new()
        .aligned(MinimumRectangle, &[polygon, flawed])
        .unwrap_err();
    assert!(
        error.to_string().starts_with("`polygon` item 1: "),
        "{error}"
    );
}
