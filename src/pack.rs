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

    /// The shape as constants of another scalar: of dual numbers, to take part in a function that
    /// is differentiated with respect to something else.
    ///
    /// ```
    /// use geograd::{Obb2, Pack, ad};
    /// let (here, there) = (Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0));
    /// let (_, slopes) = ad::gradient(|b: Obb2<_>| b.iou(there.lift()), here);
    /// assert!(slopes.center.x > 0.0);
    /// ```
    fn lift<D: crate::Scalar>(&self) -> Self::With<D>
    where
        Self::Scalar: Into<f64> + Copy,
    {
        self.map(&mut |&x| D::lit(x.into()))
    }
    /// The shape in another format, rounded.
    ///
    /// ```
    /// use geograd::{Obb2, Pack};
    /// let single: Obb2<f32> = Obb2::new(0.1_f64, 0.2, 1.0, 1.0, 0.3).cast();
    /// assert_eq!(single.center.x, 0.1);
    /// ```
    fn cast<T: Copy + 'static>(&self) -> Self::With<T>
    where
        Self::Scalar: num_traits::AsPrimitive<T>,
    {
        self.map(&mut |x| num_traits::AsPrimitive::as_(*x))
    }
    /// The same with some elements of a list of run-time length dropped: halves first, single ones
    /// last. Nothing for shapes of fixed size. For shrinking.
    ///
    /// ```
    /// use geograd::Pack;
    /// let all: Vec<_> = vec![1.0, 2.0, 3.0].fewer().collect();
    /// assert_eq!(all, [vec![3.0], vec![1.0, 2.0], vec![2.0, 3.0], vec![1.0, 3.0], vec![1.0, 2.0]]);
    /// ```
    fn fewer(&self) -> Box<dyn Iterator<Item = Self> + '_> {
        Box::new(std::iter::empty())
    }
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
pub trait Fixed: Pack + Copy + Send + Sync + 'static {
    /// How many scalars.
    const LEN: usize;
    /// An array of `LEN` scalars.
    type Array: Copy + AsRef<[Self::Scalar]> + AsMut<[Self::Scalar]>;
    /// The scalars, first field first.
    fn to_array(self) -> Self::Array;
    /// The shape with these scalars, first field first.
    fn from_array(scalars: Self::Array) -> Self;
    /// The shape with the same scalar everywhere.
    fn filled(scalar: Self::Scalar) -> Self;
    /// The shape with the first `LEN` scalars of a slice.
    ///
    /// # Panics
    ///
    /// When there are fewer.
    #[inline]
    fn from_slice(scalars: &[Self::Scalar]) -> Self {
        let mut array = Self::filled(scalars[0].clone()).to_array();
        array.as_mut().clone_from_slice(&scalars[..Self::LEN]);
        Self::from_array(array)
    }
}

/// A lone number is a pack of one.
macro_rules! leaf {
    ($([$($generic:tt)*] $type:ty),* $(,)?) => { $(
        impl<$($generic)*> $crate::Pack for $type {
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
        impl<$($generic)*> $crate::Fixed for $type {
            const LEN: usize = 1;
            type Array = [Self; 1];
            #[inline(always)]
            fn to_array(self) -> [Self; 1] {
                [self]
            }
            #[inline(always)]
            fn from_array([scalar]: [Self; 1]) -> Self {
                scalar
            }
            #[inline(always)]
            fn filled(scalar: Self) -> Self {
                scalar
            }
        }
    )* };
}

pub(crate) use leaf;

leaf! {
    [] f32,
    [] f64,
    [T: crate::Scalar, const N: usize] crate::Jet<T, N>,
    [T: crate::scalar::float::Float, const N: usize] crate::Lanes<T, N>,
    [T: Copy + Send + Sync + 'static] num_dual::Real<T>,
    [T: Copy + Send + Sync + 'static] num_dual::Dual<T>,
    [T: Copy + Send + Sync + 'static] num_dual::Dual2<T>,
    [T: Copy + Send + Sync + 'static] num_dual::Dual3<T>,
    [T: Copy + Send + Sync + 'static] num_dual::HyperDual<T>,
    [T: Copy + Send + Sync + 'static] num_dual::HyperHyperDual<T>,
}

/// A shape of scalars and smaller shapes. The macro lists the fields, `scalar` before a lone
/// number, then all scalars in the same order, and how the shape is made from them.
macro_rules! shape {
    ($name:ident { $($field:ident : $kind:ident),* }
     $len:literal [$($at:ident $(. $inner:ident)?),*] |$from:pat_param| $made:expr) => {
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
        impl<S: Copy + Send + Sync + 'static> Fixed for $name<S> {
            const LEN: usize = $len;
            type Array = [S; $len];
            #[inline(always)]
            fn to_array(self) -> [S; $len] {
                [$(self.$at $(. $inner)?),*]
            }
            #[inline(always)]
            fn from_array($from: [S; $len]) -> Self {
                $made
            }
            #[inline(always)]
            fn filled(scalar: S) -> Self {
                Self::from_array([scalar; $len])
            }
        }
    };
    (@map scalar $at:expr, $f:ident) => { $f(&$at) };
    (@map $kind:ident $at:expr, $f:ident) => { $at.map($f) };
    (@each scalar $at:expr, $f:ident) => { $f(&mut $at) };
    (@each $kind:ident $at:expr, $f:ident) => { $at.each($f) };
}

use crate::clip::Framed;
use crate::{Aabb2, Obb2, Pose2, Rotation2, Vec2, Vec3};
shape!(Vec2 { x: scalar, y: scalar } 2 [x, y] |[x, y]| Vec2 { x, y });
shape!(Vec3 { x: scalar, y: scalar, z: scalar } 3 [x, y, z] |[x, y, z]| Vec3 { x, y, z });
shape!(Rotation2 { cos: scalar, sin: scalar } 2 [cos, sin] |[cos, sin]| Rotation2 { cos, sin });
shape!(
    Pose2 { rotation: Rotation2, translation: Vec2 }
    4 [rotation.cos, rotation.sin, translation.x, translation.y]
    |[cos, sin, x, y]| Pose2 { rotation: Rotation2 { cos, sin }, translation: Vec2 { x, y } }
);
shape!(
    Aabb2 { min: Vec2, max: Vec2 }
    4 [min.x, min.y, max.x, max.y]
    |[min_x, min_y, max_x, max_y]| Aabb2::new(min_x, min_y, max_x, max_y)
);
shape!(
    Obb2 { center: Vec2, size: Vec2, heading: scalar }
    5 [center.x, center.y, size.x, size.y, heading]
    |[x, y, width, height, heading]| Obb2::new(x, y, width, height, heading)
);
shape!(
    Framed {
        center: Vec2,
        half: Vec2,
        cos: scalar,
        sin: scalar,
        cos_high: scalar,
        cos_low: scalar,
        sin_high: scalar,
        sin_low: scalar
    }
    10 [center.x, center.y, half.x, half.y, cos, sin, cos_high, cos_low, sin_high, sin_low]
    |[x, y, half_x, half_y, cos, sin, cos_high, cos_low, sin_high, sin_low]| Framed {
        center: Vec2 { x, y },
        half: Vec2 { x: half_x, y: half_y },
        cos,
        sin,
        cos_high,
        cos_low,
        sin_high,
        sin_low,
    }
);

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
    fn fewer(&self) -> Box<dyn Iterator<Item = Self> + '_> {
        let first = self.0.fewer().map(|a| (a, self.1.clone()));
        let second = self.1.fewer().map(|b| (self.0.clone(), b));
        Box::new(first.chain(second))
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
    fn fewer(&self) -> Box<dyn Iterator<Item = Self> + '_> {
        let (a, b, c) = self;
        let first = a.fewer().map(|a| (a, b.clone(), c.clone()));
        let second = b.fewer().map(|b| (a.clone(), b, c.clone()));
        let third = c.fewer().map(|c| (a.clone(), b.clone(), c));
        Box::new(first.chain(second).chain(third))
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
    fn fewer(&self) -> Box<dyn Iterator<Item = Self> + '_> {
        Box::new(fewer_inside(self, self))
    }
}
/// A list with one element replaced by one with fewer numbers.
fn fewer_inside<P: Pack, L: Clone + AsMut<[P]>>(
    list: &L,
    elements: &[P],
) -> impl Iterator<Item = L> {
    elements.iter().enumerate().flat_map(move |(i, element)| {
        element.fewer().map(move |smaller| {
            let mut list = list.clone();
            list.as_mut()[i] = smaller;
            list
        })
    })
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
    fn fewer(&self) -> Box<dyn Iterator<Item = Self> + '_> {
        let n = self.len();
        let half = |k: usize| k.div_ceil(2);
        let lengths = std::iter::successors((n > 0).then_some(half(n)), move |&k| {
            (k > 1).then_some(half(k))
        });
        let dropped = lengths.flat_map(move |k| {
            (0..n).step_by(k).map(move |start| {
                let rest = self[(start + k).min(n)..].iter();
                self[..start].iter().chain(rest).cloned().collect()
            })
        });
        Box::new(dropped.chain(fewer_inside(self, self)))
    }
}
