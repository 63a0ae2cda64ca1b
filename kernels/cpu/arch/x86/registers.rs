//! The implementation of a scalar by a vector, from the names of its instructions.

/// The operators of a vector from the intrinsics named for them.
macro_rules! vector {
    ($(#[$doc:meta])* $name:ident($raw:ident, $mask:ident($raw_mask:ident)) of $n:literal $t:ident, bits $bits:ident, low half $low:literal;
     $add:ident $sub:ident $mul:ident $div:ident $sqrt:ident $min:ident $max:ident
     $and:ident $andnot:ident $xor:ident $set:ident $from_int:ident $int_of:ident $int_set:ident $int_and:ident $int_sub:ident;
     below |$p:ident, $q:ident| $lt:expr, $le:expr, $eq:expr;
     choose |$m:ident, $yes:ident, $no:ident| $choose:expr;
     masks |$a:ident, $b:ident| $mask_and:expr, $mask_or:expr, $mask_not:expr, $mask_bits:expr;
     words |$word:ident| $mask_word:expr, $mask_truth:expr;
     sines |$angle:ident| $sin_cos:expr, $sin_cos_parts:expr;
     angle $atan2:ident;
     exponentials $exp:ident $ln:ident;
     items $from_items:ident $to_items:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        #[repr(transparent)]
        pub(super) struct $name(pub $raw);

        /// One truth value per number.
        #[derive(Clone, Copy, Debug)]
        #[repr(transparent)]
        pub(super) struct $mask($raw_mask);

        impl BitAnd for $mask {
            type Output = Self;
            #[inline(always)]
            fn bitand(self, other: Self) -> Self {
                let ($a, $b) = (self.0, other.0);
                $mask(arch!($mask_and))
            }
        }
        impl BitOr for $mask {
            type Output = Self;
            #[inline(always)]
            fn bitor(self, other: Self) -> Self {
                let ($a, $b) = (self.0, other.0);
                $mask(arch!($mask_or))
            }
        }
        impl Not for $mask {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                let $a = self.0;
                $mask(arch!($mask_not))
            }
        }
        impl $mask {
            #[inline(always)]
            fn bits(self) -> u32 {
                let $a = self.0;
                arch!($mask_bits) as u32
            }
        }
        impl Mask for $mask {
            #[inline(always)]
            fn any(self) -> bool {
                self.bits() != 0
            }
            #[inline(always)]
            fn all(self) -> bool {
                self.bits() == (1 << $n) - 1
            }
        }

        impl $name {
            #[inline(always)]
            fn array(self) -> [$t; $n] {
                // A vector has the size of its numbers, and all bit patterns are numbers.
                arch!(std::mem::transmute::<$raw, [$t; $n]>(self.0))
            }
            #[inline(always)]
            fn from_array(numbers: [$t; $n]) -> Self {
                $name(arch!(std::mem::transmute::<[$t; $n], $raw>(numbers)))
            }
        }

        impl Vector<$t> for $name {
            const WIDTH: usize = $n;
            #[allow(clippy::modulo_one)] // one vector may fill a lane
            #[inline(always)]
            fn read(lane: &Lane<$t>, at: usize) -> Self {
                Self::from_array(lane.0.as_chunks().0[at / $n % (TILE / $n)])
            }
            #[allow(clippy::modulo_one)]
            #[inline(always)]
            fn write(self, lane: &mut Lane<$t>, at: usize) {
                lane.0.as_chunks_mut().0[at / $n % (TILE / $n)] = self.array();
            }
            #[inline(always)]
            fn splat(x: $t) -> Self {
                $name(arch!($set(x)))
            }
            #[inline(always)]
            fn bits(mask: $mask) -> u32 {
                mask.bits()
            }
            #[inline(always)]
            fn word(mask: $mask) -> Self {
                let $word = mask.0;
                $name(arch!($mask_word))
            }
            #[inline(always)]
            fn truth(self) -> $mask {
                let $word = self.0;
                $mask(arch!($mask_truth))
            }
            #[inline(always)]
            fn from_items(item: impl Fn(usize) -> [$t; 4]) -> [Self; 4] {
                $from_items(item)
            }
            #[inline(always)]
            fn to_items(fields: [Self; 4], put: impl FnMut(usize, [$t; 4])) {
                $to_items(fields, put)
            }
        }

        impl Add for $name {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                $name(arch!($add(self.0, other.0)))
            }
        }
        impl Sub for $name {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                $name(arch!($sub(self.0, other.0)))
            }
        }
        impl Mul for $name {
            type Output = Self;
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                $name(arch!($mul(self.0, other.0)))
            }
        }
        impl Div for $name {
            type Output = Self;
            #[inline(always)]
            fn div(self, other: Self) -> Self {
                $name(arch!($div(self.0, other.0)))
            }
        }
        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                $name(arch!($xor(self.0, $set(-0.0))))
            }
        }
        impl AddAssign for $name {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
        impl SubAssign for $name {
            #[inline(always)]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }
        impl MulAssign for $name {
            #[inline(always)]
            fn mul_assign(&mut self, other: Self) {
                *self = *self * other;
            }
        }

        crate::pack::leaf! {
            [] $name,
        }

        impl Scalar for $name {
            type Mask = $mask;
            type Primal = Self;
            #[inline(always)]
            fn format() -> crate::scalar::Format {
                <$t as Scalar>::format()
            }
            #[inline(always)]
            fn lit(x: f64) -> Self {
                Self::splat(x as $t)
            }
            #[inline(always)]
            fn from_primal(x: Self) -> Self {
                x
            }
            #[inline(always)]
            fn primal(self) -> Self {
                self
            }
            #[inline(always)]
            fn below(self, other: Self) -> $mask {
                let ($p, $q) = (self.0, other.0);
                $mask(arch!($lt))
            }
            #[inline(always)]
            fn at_most(self, other: Self) -> $mask {
                let ($p, $q) = (self.0, other.0);
                $mask(arch!($le))
            }
            #[inline(always)]
            fn equals(self, other: Self) -> $mask {
                let ($p, $q) = (self.0, other.0);
                $mask(arch!($eq))
            }
            #[inline(always)]
            fn select(mask: $mask, yes: Self, no: Self) -> Self {
                let ($m, $yes, $no) = (mask.0, yes.0, no.0);
                $name(arch!($choose))
            }
            #[inline(always)]
            fn over(self, divisor: Self) -> Self {
                self / divisor
            }
            #[inline(always)]
            fn root(self) -> Self {
                let zero = Self::splat(0.0);
                Self::select(self.at_most(zero), zero, $name(arch!($sqrt(self.0))))
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                let $angle = self;
                $sin_cos
            }
            #[inline(always)]
            fn sin_cos_parts(self) -> [(Self, Self); 2] {
                let $angle = self;
                $sin_cos_parts
            }
            #[inline(always)]
            fn parts(self) -> (Self, Self) {
                let high = $t::from_bits(!((1 << $low) - 1));
                let high = $name(arch!($and(self.0, $set(high))));
                (high, self - high)
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                self.$atan2(x)
            }
            #[inline(always)]
            fn exp(self) -> Self {
                self.$exp()
            }
            #[inline(always)]
            fn ln(self) -> Self {
                self.$ln()
            }
            #[inline(always)]
            fn binade(self) -> Self {
                // As in the function of one number, exponent field e becomes 2·bias + 1 − e.
                let normal = Self::splat($t::MIN_POSITIVE).most(self);
                let field = (<$t>::INFINITY).to_bits();
                let twice_bias = (2 * ($t::MAX_EXP as $bits - 1) + 1) << ($t::MANTISSA_DIGITS - 1);
                $name(arch!($from_int($int_sub(
                    $int_set(twice_bias as _),
                    $int_and($int_of(normal.0), $int_set(field as _)),
                ))))
            }
            #[inline(always)]
            fn least(self, other: Self) -> Self {
                $name(arch!($min(self.0, other.0)))
            }
            #[inline(always)]
            fn most(self, other: Self) -> Self {
                $name(arch!($max(self.0, other.0)))
            }
            #[inline(always)]
            fn magnitude(self) -> Self {
                $name(arch!($andnot($set(-0.0), self.0)))
            }
            #[inline(always)]
            fn unsigned(self) -> Self {
                self.magnitude()
            }
            #[inline(always)]
            fn damp(self, _share: Self) -> Self {
                self
            }
            #[inline(always)]
            fn with_primal(self, value: Self) -> Self {
                value
            }
        }
    };
}
