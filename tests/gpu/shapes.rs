//! Shapes to test with.
use geograd::error::Field;
use geograd::kernels::{Op, Single};
use geograd::overlap::Denominator;
use geograd::{Aabb2, Fixed, Flaw, Obb2};

/// A score of two boxes in the plane: of all pairs it has kernels by hand.
pub trait Score: Op<In<f32> = (Self::Shape, Self::Shape), Out<f32> = f32> {
    type Shape: Draw + Single<Scalar = f32>;
    /// The denominator of the area of intersection.
    const OVER: Denominator;
}
impl<O, A> Score for O
where
    O: Op<In<f32> = (A, A), Out<f32> = f32>,
    A: Draw + Single<Scalar = f32>,
{
    type Shape = A;
    const OVER: Denominator = match O::DECLARED.name.as_bytes() {
        [b'i', b'n', ..] => Denominator::None,
        [b'i', b'o', b'u', ..] => Denominator::Union,
        _ => Denominator::First,
    };
}

/// Numbers in `[0, 1)`, the same ones every time.
pub struct Draws(pub u64);

impl Draws {
    pub fn next(&mut self) -> f32 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1_u64 << 24) as f32
    }
}

pub trait Draw: Fixed<Scalar = f32> + PartialEq + std::fmt::Debug {
    fn draw(draws: &mut Draws) -> Self;
    /// Shapes of which every pair is a hard case.
    fn hard() -> Vec<Self>;
    /// The longer and the shorter side.
    fn sides(self) -> (f64, f64);
    /// `true` if the side of a kink that a pair is on is decided without rounding: ties are ties on
    /// every machine.
    fn decides_exactly(self, other: Self) -> bool;
    /// A shape with a flaw, and the flaw.
    fn flawed() -> (Self, Flaw);
}

impl Draw for Obb2<f32> {
    fn draw(draws: &mut Draws) -> Self {
        let mut next = || draws.next();
        Obb2::new(
            4.0 * next(),
            4.0 * next(),
            0.1 + 3.0 * next(),
            0.1 + 3.0 * next(),
            7.0 * next() - 3.5,
        )
    }
    fn hard() -> Vec<Self> {
        let turn = std::f32::consts::FRAC_PI_2;
        vec![
            Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0),
            Obb2::new(0.0, 0.0, 2.0, 2.0, turn),
            Obb2::new(2.0, 0.0, 2.0, 2.0, 0.0),
            Obb2::new(0.0, 0.0, 2.0, 2.0, turn / 2.0),
            Obb2::new(0.25, 0.25, 0.5, 0.5, 0.0),
            Obb2::new(0.0, 0.0, 1e-3, 50.0, 0.7),
            Obb2::new(0.0, 0.0, 1e-3, 50.0, 0.7 + 1e-7),
            Obb2::new(3e-4, 0.0, 1e-3, 50.0, 0.7 + 1e-6),
            Obb2::new(0.0, 0.0, 50.0, 1e-3, 0.7),
            Obb2::new(0.0, 0.0, 0.0, 1.0, 0.3),
            Obb2::new(0.0, 0.0, 0.0, 0.0, 0.0),
            Obb2::new(1e6, -1e6, 4.0, 2.0, 0.3),
            Obb2::new(1e6 + 1.0, -1e6, 4.0, 2.0, 0.4),
            Obb2::new(0.0, 0.0, 2.0, 1.0, 1e6),
            Obb2::new(0.0, 0.0, 2.0, 1.0, -3e30),
        ]
    }
    fn sides(self) -> (f64, f64) {
        let (x, y) = (f64::from(self.size.x), f64::from(self.size.y));
        (x.max(y), x.min(y))
    }
    fn decides_exactly(self, other: Self) -> bool {
        // Hard cases without heading are made of few binary digits.
        self.heading == 0.0 && other.heading == 0.0
    }
    fn flawed() -> (Self, Flaw) {
        let flaw = Flaw::NotFinite(Field::new("heading"));
        (Obb2::new(0.0, 0.0, 1.0, 1.0, f32::NAN), flaw)
    }
}

impl Draw for Aabb2<f32> {
    fn draw(draws: &mut Draws) -> Self {
        let (x, y) = (4.0 * draws.next(), 4.0 * draws.next());
        Aabb2::new(x, y, x + 0.1 + draws.next(), y + 0.1 + draws.next())
    }
    fn hard() -> Vec<Self> {
        vec![
            Aabb2::new(0.0, 0.0, 2.0, 2.0),
            Aabb2::new(2.0, 0.0, 4.0, 2.0),
            Aabb2::new(1.0, 0.0, 3.0, 2.0),
            Aabb2::new(0.5, 0.5, 1.0, 1.0),
            Aabb2::new(1.0, 1.0, 1.0, 1.0),
            Aabb2::new(1.0, 0.0, 1.0, 9.0),
            Aabb2::new(-1e6, -1e6, 1e6, 1e6),
            Aabb2::new(0.0, 0.0, 1e-3, 50.0),
        ]
    }
    fn sides(self) -> (f64, f64) {
        let (x, y) = (
            f64::from(self.max.x) - f64::from(self.min.x),
            f64::from(self.max.y) - f64::from(self.min.y),
        );
        (x.max(y), x.min(y))
    }
    fn decides_exactly(self, _: Self) -> bool {
        // Bounds are compared as they come.
        true
    }
    fn flawed() -> (Self, Flaw) {
        let flaw = Flaw::Inverted(Field::new("min.x"), "max");
        (Aabb2::new(1.0, 0.0, 0.0, 1.0), flaw)
    }
}

pub fn fields<P: Fixed<Scalar = f32>>(shape: P) -> Vec<f64> {
    shape.scalars().into_iter().map(f64::from).collect()
}

/// The shape with these fields.
pub fn shape_of<P: Fixed>(fields: &[P::Scalar]) -> P {
    P::load(fields)
}

/// Bits, so that not even the sign of a zero may differ.
pub fn bits(values: &[f32]) -> Vec<u32> {
    values.iter().map(|x| x.to_bits()).collect()
}
