//! Tuples, arrays and lists of shapes.
use crate::arrays::Each;
use crate::error::{Field, Flaw, Validate};
use crate::{Fixed, Pack, Rule, Scalar};

/// Tuples; the macro lists their parts.
macro_rules! tuples {
    ($(($first:ident.$zero:tt $(, $part:ident.$place:tt)*))*) => { $(
        impl<$first: Pack $(, $part: Pack<Scalar = $first::Scalar>)*> Pack for ($first, $($part,)*) {
            type Scalar = $first::Scalar;
            type With<T: Clone> = ($first::With<T>, $($part::With<T>,)*);
            const LISTS: bool = $first::LISTS $(|| $part::LISTS)*;
            #[inline(always)]
            fn remake<T: Clone>(&self, f: &mut impl FnMut(&Self::Scalar) -> T) -> Self::With<T> {
                (self.$zero.remake(f), $(self.$place.remake(f),)*)
            }
            #[inline(always)]
            fn each(&mut self, f: &mut impl FnMut(&mut Self::Scalar)) {
                self.$zero.each(f);
                $(self.$place.each(f);)*
            }
            fn fewer(&self) -> Box<dyn Iterator<Item = Self> + '_> {
                let first = self.$zero.fewer().map(|x| {
                    let mut all = self.clone();
                    all.$zero = x;
                    all
                });
                Box::new(OneAfterAnother(vec![Box::new(first) as Box<dyn Iterator<Item = Self> + '_> $(, {
                    let next = self.$place.fewer().map(|x| {
                        let mut all = self.clone();
                        all.$place = x;
                        all
                    });
                    Box::new(next)
                })*]))
            }
        }
        impl<$first: Fixed $(, $part: Fixed<Scalar = $first::Scalar>)*> Fixed for ($first, $($part,)*) {
            type Of<R: Scalar> = ($first::Of<R>, $($part::Of<R>,)*);
            const LEN: usize = $first::LEN $(+ $part::LEN)*;
            const CODES: usize = $first::CODES $(+ $part::CODES)*;
            #[inline(always)]
            fn load(from: &[Self::Scalar]) -> Self {
                let mut from = &from[..Self::LEN];
                (load::<$first>(&mut from), $(load::<$part>(&mut from),)*)
            }
            #[inline(always)]
            fn store(self, to: &mut [Self::Scalar]) {
                let mut to = &mut to[..Self::LEN];
                store(self.$zero, &mut to);
                $(store(self.$place, &mut to);)*
            }
            #[inline(always)]
            fn filled(scalar: Self::Scalar) -> Self {
                ($first::filled(scalar), $($part::filled(scalar),)*)
            }
            fn name(i: usize) -> Field {
                name(i, &[
                    (stringify!($zero), $first::LEN, $first::name),
                    $((stringify!($place), $part::LEN, $part::name),)*
                ])
            }
            #[inline]
            fn load_codes(self, mut from: &[u32]) -> Self {
                (load_codes(self.$zero, &mut from), $(load_codes(self.$place, &mut from),)*)
            }
            #[inline]
            fn store_codes(self, mut to: &mut [u32]) {
                store_codes(self.$zero, &mut to);
                $(store_codes(self.$place, &mut to);)*
            }
        }
        impl<$first: Fixed + Validate $(, $part: Fixed + Validate)*> Validate for ($first, $($part,)*) {
            const FINITE_SUFFICES: bool =
                $first::FINITE_SUFFICES $(&& $part::FINITE_SUFFICES)*;
            const RULES: &'static [Rule] = {
                let lengths = [$first::LEN $(, $part::LEN)*];
                &[
                    Rule::Parts { first: before(&lengths, $zero), count: 1, width: $first::LEN, rules: $first::RULES },
                    $(Rule::Parts {
                        first: before(&lengths, $place),
                        count: 1,
                        width: $part::LEN,
                        rules: $part::RULES,
                    },)*
                ]
            };
            fn validate(&self) -> Result<(), Flaw> {
                valid(&self.$zero, stringify!($zero))?;
                $(valid(&self.$place, stringify!($place))?;)*
                Ok(())
            }
        }
    )* };
}
tuples! {
    (A.0)
    (A.0, B.1)
    (A.0, B.1, C.2)
    (A.0, B.1, C.2, D.3)
    (A.0, B.1, C.2, D.3, E.4)
    (A.0, B.1, C.2, D.3, E.4, F.5)
}

/// Returns the sum of the numbers before a place.
const fn before(lengths: &[usize], place: usize) -> usize {
    let (mut sum, mut i) = (0, 0);
    while i < place {
        sum += lengths[i];
        i += 1;
    }
    sum
}

impl<P: Pack, const N: usize> Pack for [P; N] {
    type Scalar = P::Scalar;
    type With<T: Clone> = [P::With<T>; N];
    const LISTS: bool = P::LISTS;
    #[inline(always)]
    fn remake<T: Clone>(&self, f: &mut impl FnMut(&Self::Scalar) -> T) -> Self::With<T> {
        std::array::from_fn(|i| self[i].remake(f))
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
impl<P: Fixed, const N: usize> Fixed for [P; N] {
    type Of<R: Scalar> = [P::Of<R>; N];
    const LEN: usize = N * P::LEN;
    const CODES: usize = N * P::CODES;
    #[inline(always)]
    fn load(from: &[Self::Scalar]) -> Self {
        let mut from = &from[..Self::LEN];
        std::array::from_fn(|_| load(&mut from))
    }
    #[inline(always)]
    fn store(self, to: &mut [Self::Scalar]) {
        // By reference: an iterator over the array itself copies it.
        for (shape, own) in self
            .iter()
            .zip(to[..Self::LEN].chunks_exact_mut(P::LEN.max(1)))
        {
            shape.store(own);
        }
    }
    #[inline(always)]
    fn filled(scalar: Self::Scalar) -> Self {
        [P::filled(scalar); N]
    }
    fn name(i: usize) -> Field {
        if i < Self::LEN {
            P::name(i % P::LEN).within_item(i / P::LEN)
        } else {
            Field::VALUE
        }
    }
    #[inline]
    fn load_codes(self, mut from: &[u32]) -> Self {
        self.each_as(|shape| load_codes(shape, &mut from))
    }
    #[inline]
    fn store_codes(self, mut to: &mut [u32]) {
        for shape in self {
            store_codes(shape, &mut to);
        }
    }
}
impl<P: Fixed + Validate, const N: usize> Validate for [P; N] {
    const FINITE_SUFFICES: bool = P::FINITE_SUFFICES;
    const RULES: &'static [Rule] = &[Rule::Parts {
        first: 0,
        count: N,
        width: P::LEN,
        rules: P::RULES,
    }];
    fn validate(&self) -> Result<(), Flaw> {
        for (i, shape) in self.iter().enumerate() {
            shape.validate().map_err(|flaw| flaw.within_item(i))?;
        }
        Ok(())
    }
}
/// Iterators one after another, the first one first: a chain that costs little to compile for every tuple.
struct OneAfterAnother<'a, X>(Vec<Box<dyn Iterator<Item = X> + 'a>>);

impl<X> Iterator for OneAfterAnother<'_, X> {
    type Item = X;
    fn next(&mut self) -> Option<X> {
        while let Some(first) = self.0.first_mut() {
            match first.next() {
                None => drop(self.0.remove(0)),
                found => return found,
            }
        }
        None
    }
}

/// Returns a list with one element replaced by one with fewer numbers.
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
    const LISTS: bool = true;
    fn remake<T: Clone>(&self, f: &mut impl FnMut(&Self::Scalar) -> T) -> Self::With<T> {
        self.iter().map(|shape| shape.remake(f)).collect()
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

/// A count or a code: whole numbers of a shape in addition to its scalars. It is a decision, without derivatives, and
/// equal for every kind of scalar.
///
/// ```
/// use geograd::{Fixed, Pack, Shape};
/// #[derive(Clone, Copy, Debug, PartialEq, Shape)]
/// struct Ticks<S> {
///     step: S,
///     #[shape(code)]
///     count: u16,
/// }
/// let ticks = Ticks { step: 0.5, count: 12 };
/// assert_eq!((ticks.scalars(), ticks.codes()), (vec![0.5], vec![12]));
/// assert_eq!(ticks.cast::<f32>().count, 12);
/// assert_eq!(Ticks::load(&[0.5]).load_codes(&[12]), ticks);
/// ```
pub trait Code: Copy + PartialEq + Send + Sync + 'static {
    /// The count of whole numbers.
    const CODES: usize;
    /// Reads a value from the first `CODES` numbers of a slice; zeros must be valid.
    ///
    /// # Panics
    ///
    /// When there are fewer.
    fn load(from: &[u32]) -> Self;
    /// Writes the numbers to the first `CODES` places of a slice.
    ///
    /// # Panics
    ///
    /// When there are fewer.
    fn store(self, to: &mut [u32]);
}
/// Whole numbers of at most 32 bits.
macro_rules! codes {
    ($($whole:ident)*) => { $(
        impl Code for $whole {
            const CODES: usize = 1;
            #[inline]
            fn load(from: &[u32]) -> Self {
                from[0] as $whole
            }
            #[inline]
            fn store(self, to: &mut [u32]) {
                to[0] = self as u32;
            }
        }
    )* };
}
codes!(u8 u16 u32 i8 i16 i32);
/// A count or an index: up to four thousand million.
impl Code for usize {
    const CODES: usize = 1;
    #[inline]
    fn load(from: &[u32]) -> Self {
        from[0] as usize
    }
    #[inline]
    fn store(self, to: &mut [u32]) {
        to[0] = u32::try_from(self).unwrap_or(u32::MAX);
    }
}
impl Code for bool {
    const CODES: usize = 1;
    #[inline]
    fn load(from: &[u32]) -> Self {
        from[0] != 0
    }
    #[inline]
    fn store(self, to: &mut [u32]) {
        to[0] = u32::from(self);
    }
}
impl<C: Code, const N: usize> Code for [C; N] {
    const CODES: usize = N * C::CODES;
    #[inline]
    fn load(mut from: &[u32]) -> Self {
        std::array::from_fn(|_| load_code(&mut from))
    }
    #[inline]
    fn store(self, mut to: &mut [u32]) {
        for code in self {
            store_code(code, &mut to);
        }
    }
}

// Steps that the parts of a shape take one after another; derived code calls these, too.

/// Takes a shape off the front of a slice of scalars.
#[inline(always)]
pub fn load<P: Fixed>(from: &mut &[P::Scalar]) -> P {
    let (own, rest) = from.split_at(P::LEN);
    *from = rest;
    P::load(own)
}
/// Puts a shape's scalars at the front of a slice, and leaves the rest of it.
#[inline(always)]
pub fn store<P: Fixed>(shape: P, to: &mut &mut [P::Scalar]) {
    let (own, rest) = std::mem::take(to).split_at_mut(P::LEN);
    *to = rest;
    shape.store(own);
}
/// Takes a shape's codes off the front of a slice.
#[inline]
pub fn load_codes<P: Fixed>(shape: P, from: &mut &[u32]) -> P {
    let (own, rest) = from.split_at(P::CODES);
    *from = rest;
    shape.load_codes(own)
}
/// Puts a shape's codes at the front of a slice, and leaves the rest of it.
#[inline]
pub fn store_codes<P: Fixed>(shape: P, to: &mut &mut [u32]) {
    let (own, rest) = std::mem::take(to).split_at_mut(P::CODES);
    *to = rest;
    shape.store_codes(own);
}
/// Takes a field's codes off the front of a slice.
#[inline]
pub fn load_code<C: Code>(from: &mut &[u32]) -> C {
    let (own, rest) = from.split_at(C::CODES);
    *from = rest;
    C::load(own)
}
/// Puts a field's codes at the front of a slice, and leaves the rest of it.
#[inline]
pub fn store_code<C: Code>(code: C, to: &mut &mut [u32]) {
    let (own, rest) = std::mem::take(to).split_at_mut(C::CODES);
    *to = rest;
    code.store(own);
}
/// Returns a code of a shape of which only the scalars are known.
#[inline]
pub fn no_code<C: Code>() -> C {
    const MOST: usize = 64;
    const { assert!(C::CODES <= MOST, "a field has at most 64 codes") };
    C::load(&[0; MOST])
}
/// Returns the name of scalar `i` among parts with a name, a length and names of their own.
pub fn name(mut i: usize, parts: &[(&str, usize, fn(usize) -> Field)]) -> Field {
    for (part, len, name) in parts {
        if i < *len {
            return name(i).within(part);
        }
        i -= len;
    }
    Field::VALUE
}
/// Returns a part's first flaw, with the part's name.
#[inline]
pub fn valid(part: &impl Validate, name: &str) -> Result<(), Flaw> {
    part.validate().map_err(|flaw| flaw.within(name))
}
