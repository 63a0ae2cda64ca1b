//! Shapes as lists of scalars, in one order of fields for derivatives, batches and kernels.
//!
//! [`Pack`] flattens a shape into scalars, and `With<T>` is the same shape made of `T`: a gradient is a shape, a
//! Hessian a shape of gradients. [`Fixed`] adds a constant length, loads and stores slices, and names every scalar for
//! errors.
use crate::Scalar;
use crate::error::Field;

/// A shape made of scalars, in a fixed order.
///
/// `With<T>` is the same shape made of `T`: of dual numbers to differentiate, of gradients to hold a Hessian. Numbers,
/// shapes, tuples and arrays of them, and vectors of run-time
/// length are packs. `#[derive(Shape)]` makes a struct one.
///
/// ```
/// use geograd::{Obb2, Pack};
/// let car = Obb2::new(1.0, 2.0, 4.5, 1.8, 0.3);
/// assert_eq!(car.scalars(), [1.0, 2.0, 4.5, 1.8, 0.3]);
/// let names = ["x", "y", "width", "height", "heading"];
/// let mut next = names.into_iter();
/// let named = car.remake(&mut |_| next.next().unwrap());
/// assert_eq!(named.heading, "heading");
/// ```
pub trait Pack: Clone {
    /// The number type of the shape.
    type Scalar: Clone;
    /// The same shape made of `T`.
    type With<T: Clone>: Clone;
    /// `true` if it has lists of run-time length. [`fewer`](Pack::fewer) is not asked otherwise.
    const LISTS: bool = false;
    /// The same shape with every scalar replaced, first field first.
    fn remake<T: Clone>(&self, f: &mut impl FnMut(&Self::Scalar) -> T) -> Self::With<T>;
    /// Calls a function with every scalar by reference, first field first.
    fn each(&mut self, f: &mut impl FnMut(&mut Self::Scalar));

    /// The shape as constants of another scalar: of dual numbers, to take part in a function that
    /// is differentiated with respect to something else.
    ///
    /// ```
    /// use geograd::{Obb2, Pack, ad};
    /// let (here, there) = (Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0));
    /// let (_, derivatives) = ad::gradient(|b: Obb2<_>| b.iou(there.lift()), here);
    /// assert!(derivatives.center.x > 0.0);
    /// ```
    fn lift<D: Scalar>(&self) -> Self::With<D>
    where
        Self::Scalar: Into<f64> + Copy,
    {
        self.remake(&mut |&x| D::lit(x.into()))
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
        self.remake(&mut |x| num_traits::AsPrimitive::as_(*x))
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
    /// The number of scalars of the shape.
    fn count(&self) -> usize {
        let mut n = 0;
        self.remake(&mut |_| n += 1);
        n
    }
    /// All scalars, first field first.
    fn scalars(&self) -> Vec<Self::Scalar> {
        let mut all = Vec::new();
        self.remake(&mut |x| all.push(x.clone()));
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

/// A shape with the same number of scalars for every value: numbers, [derived](crate::Shape)
/// shapes, and arrays of them and tuples of up to six.
///
/// ```
/// use geograd::{Fixed, Obb2, Pack, Vec2};
/// let [start, end] = <[Vec2<f64>; 2]>::load(&[0.0, 1.0, 2.0, 3.0]);
/// assert_eq!((start.y, end.x), (1.0, 2.0));
/// let mut numbers = [0.0; 7];
/// (Obb2::new(1.0, 2.0, 4.0, 2.0, 0.5), end).store(&mut numbers);
/// assert_eq!(numbers, [1.0, 2.0, 4.0, 2.0, 0.5, 2.0, 3.0]);
/// assert_eq!(<(Obb2<f64>, Vec2<f64>)>::name(3).as_str(), "0.height");
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a shape of fixed size",
    label = "not a shape of fixed size",
    note = "numbers, arrays, tuples of up to six and structs with `#[derive(geograd::Shape)]` are"
)]
pub trait Fixed: Pack<Scalar: Copy + Send + Sync> + Copy + Send + Sync + 'static {
    /// The same shape made of another scalar.
    type Of<R: Scalar>: Fixed<Scalar = R>;
    /// The number of scalars.
    const LEN: usize;
    /// The number of whole numbers: counts and codes, which have no derivatives and are no part of `LEN`.
    const CODES: usize = 0;
    /// The shape with the first `LEN` scalars of a slice, first field first. Its codes are zero.
    ///
    /// # Panics
    ///
    /// When there are fewer.
    fn load(from: &[Self::Scalar]) -> Self;
    /// Writes the scalars to the first `LEN` places of a slice, first field first.
    ///
    /// # Panics
    ///
    /// When there are fewer.
    fn store(self, to: &mut [Self::Scalar]);
    /// The shape with the same scalar everywhere. Its codes are zero.
    fn filled(scalar: Self::Scalar) -> Self;
    /// The name of scalar `i`, such as `links[0].x`; that of a lone number from `LEN` on.
    fn name(i: usize) -> Field;
    /// The same shape with its codes taken from the first `CODES` places of a slice.
    ///
    /// # Panics
    ///
    /// When there are fewer.
    #[inline]
    #[must_use]
    fn load_codes(self, _from: &[u32]) -> Self {
        self
    }
    /// Writes the codes to the first `CODES` places of a slice, first field first.
    ///
    /// # Panics
    ///
    /// When there are fewer.
    #[inline]
    fn store_codes(self, _to: &mut [u32]) {}

    /// The names of all scalars, first field first.
    #[must_use]
    fn names() -> Vec<Field> {
        (0..Self::LEN).map(Self::name).collect()
    }
    /// All codes, first field first.
    #[must_use]
    fn codes(self) -> Vec<u32> {
        let mut all = vec![0; Self::CODES];
        self.store_codes(&mut all);
        all
    }
}

/// A lone number is a pack of one.
macro_rules! leaf {
    ($([$($generic:tt)*] $type:ty),* $(,)?) => { $(
        impl<$($generic)*> $crate::Pack for $type {
            type Scalar = Self;
            type With<R: Clone> = R;
            #[inline(always)]
            fn remake<R: Clone>(&self, f: &mut impl FnMut(&Self) -> R) -> R {
                f(self)
            }
            #[inline(always)]
            fn each(&mut self, f: &mut impl FnMut(&mut Self)) {
                f(self)
            }
        }
        impl<$($generic)*> $crate::Fixed for $type {
            type Of<R: $crate::Scalar> = R;
            const LEN: usize = 1;
            #[inline(always)]
            fn load(from: &[Self]) -> Self {
                from[0]
            }
            #[inline(always)]
            fn store(self, to: &mut [Self]) {
                to[0] = self;
            }
            #[inline(always)]
            fn filled(scalar: Self) -> Self {
                scalar
            }
            fn name(_: usize) -> $crate::error::Field {
                $crate::error::Field::VALUE
            }
        }
    )* };
}

pub(crate) use leaf;

leaf! {
    [] f32,
    [] f64,
    [T: Scalar, const N: usize] crate::Jet<T, N>,
    [T: crate::scalar::float::Float, const N: usize] crate::Lanes<T, N>,
    [T: Copy + Send + Sync + 'static] num_dual::Real<T>,
    [T: Copy + Send + Sync + 'static] num_dual::Dual<T>,
    [T: Copy + Send + Sync + 'static] num_dual::Dual2<T>,
    [T: Copy + Send + Sync + 'static] num_dual::Dual3<T>,
    [T: Copy + Send + Sync + 'static] num_dual::HyperDual<T>,
    [T: Copy + Send + Sync + 'static] num_dual::HyperHyperDual<T>,
}
