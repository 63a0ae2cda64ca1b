//! Shapes as lists of scalars: one order of fields for derivatives, batches and kernels.

/// A shape made of scalars, in a fixed order.
///
/// `With<T>` is the same shape made of something else: of dual numbers to differentiate, of whole
/// gradients to hold a Hessian. Numbers, shapes, tuples and arrays of them, and vectors of run-time
/// length are packs.
///
/// ```
/// use geograd::{Obb2, Pack};
/// let car = Obb2::new(1.0, 2.0, 4.5, 1.8, 0.3);
/// assert_eq!(car.scalars(), [1.0, 2.0, 4.5, 1.8, 0.3]);
/// let names = ["x", "y", "width", "height", "heading"];
/// let mut next = names.into_iter();
/// let named = car.map(&mut |_| next.next().unwrap());
/// assert_eq!(named.heading, "heading");
/// ```
pub trait Pack: Clone {
    /// What the shape is made of.
    type Scalar: Clone;
    /// The same shape made of `T`.
    type With<T: Clone>: Clone;
    /// The same shape with every scalar replaced, first field first.
    fn map<T: Clone>(&self, f: &mut impl FnMut(&Self::Scalar) -> T) -> Self::With<T>;
    /// Hands out every scalar for change, first field first.
    fn each(&mut self, f: &mut impl FnMut(&mut Self::Scalar));

    /// How many scalars the shape has.
    fn count(&self) -> usize {
        let mut n = 0;
        self.map(&mut |_| n += 1);
        n
    }
    /// All scalars, first field first.
    fn scalars(&self) -> Vec<Self::Scalar> {
        let mut all = Vec::new();
        self.map(&mut |x| all.push(x.clone()));
        all
    }
    /// The same shape with its scalars taken from a list, which must have enough of them.
    ///
    /// # Panics
    ///
    /// When the list is shorter than [`count`](Pack::count).
    fn refill(&self, from: &[Self::Scalar]) -> Self {
        let mut shape = self.clone();
        let mut next = from.iter();
        shape.each(&mut |x| *x = next.next().expect("one scalar per field").clone());
        shape
    }
}

/// A shape with the same number of scalars for every value.
///
/// Batches read and write it lane by lane, so both directions are always inlined.
pub trait Fixed: Pack + Copy + Send + Sync {
    /// How many scalars.
    const LEN: usize;
    /// Builds a shape from its scalars, first field first.
    ///
    /// # Panics
    ///
    /// When there are fewer than `LEN`.
    fn take(from: &[Self::Scalar]) -> Self;
    /// Writes the scalars, first field first.
    ///
    /// # Panics
    ///
    /// When there is room for fewer than `LEN`.
    fn put(self, to: &mut [Self::Scalar]);
}

/// A lone number is a pack of one.
macro_rules! leaf {
    ($([$($generic:tt)*] $type:ty),* $(,)?) => { $(
        impl<$($generic)*> Pack for $type {
            type Scalar = Self;
            type With<R: Clone> = R;
            #[inline(always)]
            fn map<R: Clone>(&self, f: &mut impl FnMut(&Self) -> R) -> R {
                f(self)
            }
            #[inline(always)]
            fn each(&mut self, f: &mut impl FnMut(&mut Self)) {
                f(self)
            }
        }
        impl<$($generic)*> Fixed for $type {
            const LEN: usize = 1;
            #[inline(always)]
            fn take(from: &[Self]) -> Self {
                from[0]
            }
            #[inline(always)]
            fn put(self, to: &mut [Self]) {
                to[0] = self;
            }
        }
    )* };
}

leaf! {
    [] f32,
    [] f64,
    [T: crate::Scalar, const N: usize] crate::Jet<T, N>,
    [T: crate::float::Float, const N: usize] crate::Lanes<T, N>,
    [T: Copy + Send + Sync] num_dual::Real<T>,
    [T: Copy + Send + Sync] num_dual::Dual<T>,
    [T: Copy + Send + Sync] num_dual::Dual2<T>,
    [T: Copy + Send + Sync] num_dual::Dual3<T>,
    [T: Copy + Send + Sync] num_dual::HyperDual<T>,
    [T: Copy + Send + Sync] num_dual::HyperHyperDual<T>,
}

/// A shape of scalars and smaller shapes: the macro lists its fields in order, `scalar` before a
/// lone number.
macro_rules! shape {
    ($name:ident { $($field:ident : $kind:ident),* } $len:expr) => {
        impl<S: Clone> Pack for $name<S> {
            type Scalar = S;
            type With<T: Clone> = $name<T>;
            #[inline(always)]
            fn map<T: Clone>(&self, f: &mut impl FnMut(&S) -> T) -> $name<T> {
                $name { $($field: shape!(@map $kind self.$field, f)),* }
            }
            #[inline(always)]
            fn each(&mut self, f: &mut impl FnMut(&mut S)) {
                $(shape!(@each $kind self.$field, f);)*
            }
        }
        impl<S: Copy + Send + Sync> Fixed for $name<S> {
            const LEN: usize = $len;
            #[inline(always)]
            fn take(from: &[S]) -> Self {
                let mut at = 0;
                $(let $field = shape!(@take $kind from, at);)*
                debug_assert_eq!(at, Self::LEN);
                $name { $($field),* }
            }
            #[inline(always)]
            fn put(self, to: &mut [S]) {
                let mut at = 0;
                $(shape!(@put $kind self.$field, to, at);)*
                debug_assert_eq!(at, Self::LEN);
            }
        }
    };
    (@map scalar $at:expr, $f:ident) => { $f(&$at) };
    (@map $kind:ident $at:expr, $f:ident) => { $at.map($f) };
    (@each scalar $at:expr, $f:ident) => { $f(&mut $at) };
    (@each $kind:ident $at:expr, $f:ident) => { $at.each($f) };
    (@take scalar $from:ident, $at:ident) => {{
        $at += 1;
        $from[$at - 1]
    }};
    (@take $kind:ident $from:ident, $at:ident) => {{
        $at += <$kind<S> as Fixed>::LEN;
        $kind::take(&$from[$at - <$kind<S> as Fixed>::LEN..])
    }};
    (@put scalar $field:expr, $to:ident, $at:ident) => {{
        $to[$at] = $field;
        $at += 1;
    }};
    (@put $kind:ident $field:expr, $to:ident, $at:ident) => {{
        $field.put(&mut $to[$at..]);
        $at += <$kind<S> as Fixed>::LEN;
    }};
}

use crate::clip::Framed;
use crate::{Aabb2, Obb2, Pose2, Rotation2, Vec2, Vec3};
shape!(Vec2 { x: scalar, y: scalar } 2);
shape!(Vec3 { x: scalar, y: scalar, z: scalar } 3);
shape!(Rotation2 { cos: scalar, sin: scalar } 2);
shape!(Pose2 { rotation: Rotation2, translation: Vec2 } 4);
shape!(Aabb2 { min: Vec2, max: Vec2 } 4);
shape!(Obb2 { center: Vec2, size: Vec2, heading: scalar } 5);
shape!(Framed {
    center: Vec2,
    half: Vec2,
    cos: scalar,
    sin: scalar,
    cos_high: scalar,
    cos_low: scalar,
    sin_high: scalar,
    sin_low: scalar
} 10);

impl<A: Pack, B: Pack<Scalar = A::Scalar>> Pack for (A, B) {
    type Scalar = A::Scalar;
    type With<T: Clone> = (A::With<T>, B::With<T>);
    #[inline(always)]
    fn map<T: Clone>(&self, f: &mut impl FnMut(&Self::Scalar) -> T) -> Self::With<T> {
        (self.0.map(f), self.1.map(f))
    }
    #[inline(always)]
    fn each(&mut self, f: &mut impl FnMut(&mut Self::Scalar)) {
        self.0.each(f);
        self.1.each(f);
    }
}
impl<A: Fixed, B: Fixed<Scalar = A::Scalar>> Fixed for (A, B) {
    const LEN: usize = A::LEN + B::LEN;
    #[inline(always)]
    fn take(from: &[Self::Scalar]) -> Self {
        (A::take(from), B::take(&from[A::LEN..]))
    }
    #[inline(always)]
    fn put(self, to: &mut [Self::Scalar]) {
        self.0.put(to);
        self.1.put(&mut to[A::LEN..]);
    }
}

impl<A: Pack, B: Pack<Scalar = A::Scalar>, C: Pack<Scalar = A::Scalar>> Pack for (A, B, C) {
    type Scalar = A::Scalar;
    type With<T: Clone> = (A::With<T>, B::With<T>, C::With<T>);
    fn map<T: Clone>(&self, f: &mut impl FnMut(&Self::Scalar) -> T) -> Self::With<T> {
        (self.0.map(f), self.1.map(f), self.2.map(f))
    }
    fn each(&mut self, f: &mut impl FnMut(&mut Self::Scalar)) {
        self.0.each(f);
        self.1.each(f);
        self.2.each(f);
    }
}

impl<P: Pack, const N: usize> Pack for [P; N] {
    type Scalar = P::Scalar;
    type With<T: Clone> = [P::With<T>; N];
    #[inline(always)]
    fn map<T: Clone>(&self, f: &mut impl FnMut(&Self::Scalar) -> T) -> Self::With<T> {
        std::array::from_fn(|i| self[i].map(f))
    }
    #[inline(always)]
    fn each(&mut self, f: &mut impl FnMut(&mut Self::Scalar)) {
        for shape in self {
            shape.each(f);
        }
    }
}
impl<P: Fixed, const N: usize> Fixed for [P; N] {
    const LEN: usize = P::LEN * N;
    #[inline(always)]
    fn take(from: &[Self::Scalar]) -> Self {
        std::array::from_fn(|i| P::take(&from[i * P::LEN..]))
    }
    #[inline(always)]
    fn put(self, to: &mut [Self::Scalar]) {
        for (i, shape) in self.into_iter().enumerate() {
            shape.put(&mut to[i * P::LEN..]);
        }
    }
}

impl<P: Pack> Pack for Vec<P> {
    type Scalar = P::Scalar;
    type With<T: Clone> = Vec<P::With<T>>;
    fn map<T: Clone>(&self, f: &mut impl FnMut(&Self::Scalar) -> T) -> Self::With<T> {
        self.iter().map(|shape| shape.map(f)).collect()
    }
    fn each(&mut self, f: &mut impl FnMut(&mut Self::Scalar)) {
        for shape in self {
            shape.each(f);
        }
    }
}
