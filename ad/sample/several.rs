//! Samples of several things at once: numbers, arrays, tuples and [derived](crate::Shape) shapes.
use crate::Pack;
use crate::ad::declared::Kind;
use crate::ad::sample::{Draw, Sample, Sampler};
use std::array::from_fn;
use std::f64::consts::FRAC_PI_2;

/// The number of times that a shape is drawn anew if its own rules refuse it.
const TRIES: usize = 100;
/// The most hard cases of a derived shape: batches and pairs combine them further.
const SHAPES: usize = 20;
/// The most hard cases of a tuple of three or more.
pub(crate) const TUPLES: usize = 500;

/// Returns a random input whose numbers were made to fit its rules.
pub fn drawn<X: Sample>(
    draw: &mut Draw,
    make: impl Fn(&mut Draw) -> X,
    mend: impl Fn(&mut X),
) -> X {
    let mended = |draw: &mut Draw| {
        let mut x = make(draw);
        mend(&mut x);
        x
    };
    let first = mended(draw);
    if first.inside() {
        return first;
    }
    let mut others = (0..TRIES).map(|_| mended(draw));
    others.find(Sample::inside).unwrap_or(first)
}

/// Returns a random input, now and then a thin one.
pub fn one_of<X: Sample>(draw: &mut Draw) -> X {
    if draw.once_in(10) {
        X::thin(draw)
    } else {
        X::ordinary(draw)
    }
}

/// Returns the hard cases, as a function that needs no type.
pub fn hard<X: Sample>() -> Vec<X> {
    X::hard()
}

/// Returns all parts one after another.
pub fn joined<T: Clone, const N: usize>(parts: [Vec<T>; N]) -> Vec<T> {
    parts.concat()
}

/// Returns `count` copies of a kind.
pub fn all(kind: Kind, count: usize) -> Vec<Kind> {
    vec![kind; count]
}

/// Replaces the kinds of points by those of directions.
pub fn as_directions(kinds: Vec<Kind>) -> Vec<Kind> {
    let of = |kind| match kind {
        Kind::X => Kind::DirectionX,
        Kind::Y => Kind::DirectionY,
        Kind::Z => Kind::DirectionZ,
        kind => kind,
    };
    kinds.into_iter().map(of).collect()
}

/// Returns the kinds of points as lengths: sizes, which are not below zero, do not move.
pub fn as_lengths(kinds: Vec<Kind>) -> Vec<Kind> {
    let of = |kind| match kind {
        Kind::X | Kind::Y | Kind::Z => Kind::Length,
        kind => kind,
    };
    kinds.into_iter().map(of).collect()
}

/// Replaces the kinds of points in space by those of rotation vectors.
pub fn as_rotation_vectors(kinds: Vec<Kind>) -> Vec<Kind> {
    let of = |kind| match kind {
        Kind::X => Kind::RotationVectorX,
        Kind::Y => Kind::RotationVectorY,
        Kind::Z => Kind::RotationVectorZ,
        kind => kind,
    };
    kinds.into_iter().map(of).collect()
}

/// Turns numbers of about one into angles.
pub fn as_angle(part: &mut impl Pack<Scalar = f64>) {
    part.each(&mut |x| *x *= FRAC_PI_2);
}

/// Removes the sign of numbers.
pub fn as_non_negative(part: &mut impl Pack<Scalar = f64>) {
    part.each(&mut |x| *x = x.abs());
}

/// Removes the sign of numbers and replaces zero by one.
pub fn as_positive(part: &mut impl Pack<Scalar = f64>) {
    part.each(&mut |x| *x = if *x == 0.0 { 1.0 } else { x.abs() });
}

/// Exchanges numbers of two parts where the first one's is larger.
pub fn in_order<P: Pack<Scalar = f64>>(low: &mut P, high: &mut P) {
    let (lows, highs) = (low.scalars(), high.scalars());
    let ordered = |of: fn(f64, f64) -> f64| -> Vec<f64> {
        lows.iter().zip(&highs).map(|(a, b)| of(*a, *b)).collect()
    };
    *low = low.refill(&ordered(f64::min));
    *high = high.refill(&ordered(f64::max));
}

/// Combines hard cases of parts: all combinations, or some of many.
pub(crate) fn combinations(counts: &[usize], most: usize) -> Vec<Vec<usize>> {
    let total = counts
        .iter()
        .fold(1_usize, |n, &count| n.saturating_mul(count));
    let mut draw = Draw::new(7);
    let nth = |mut n: usize| -> Vec<usize> {
        let digit = |count: &usize| {
            let digit = n % count;
            n /= count;
            digit
        };
        counts.iter().map(digit).collect()
    };
    if total <= most {
        return (0..total).map(nth).collect();
    }
    // The first of each first: the plainest.
    let mut all = vec![vec![0; counts.len()]];
    while all.len() < most {
        let next: Vec<_> = counts.iter().map(|&count| draw.below(count)).collect();
        all.push(next);
    }
    all.sort_unstable();
    all.dedup();
    all
}

/// Returns the hard cases of a derived shape: those of its fields, combined.
pub fn combined<X: Sample>(
    counts: &[usize],
    make: impl Fn(&[usize]) -> X,
    mend: impl Fn(&mut X),
) -> Vec<X> {
    let made = |at: Vec<usize>| {
        let mut x = make(&at);
        mend(&mut x);
        x
    };
    let all = combinations(counts, SHAPES).into_iter().map(made);
    all.filter(Sample::inside).collect()
}

/// Replaces some numbers of one part of an input, now and then, by those of another part, exactly or nearly.
pub fn mingled<X: Sample>(x: X, lengths: &[usize], draw: &mut Draw) -> X {
    let (mut numbers, kinds) = (x.scalars(), x.kinds());
    if !mingle(&mut numbers, &kinds, lengths, draw) {
        return x;
    }
    let mingled = x.refill(&numbers);
    if mingled.inside() { mingled } else { x }
}

/// Replaces some numbers of one part by those of another part; returns `false` if all stay as they are.
pub(crate) fn mingle(
    numbers: &mut [f64],
    kinds: &[Kind],
    lengths: &[usize],
    draw: &mut Draw,
) -> bool {
    if lengths.len() < 2 || !draw.once_in(3) {
        return false;
    }
    let start = |part: usize| lengths[..part].iter().sum::<usize>();
    let to = 1 + draw.below(lengths.len() - 1);
    let from = draw.below(to);
    let (a, b) = (start(from), start(to));
    let n = lengths[to];
    if lengths[from] != n || kinds[a..a + n] != kinds[b..b + n] {
        return false;
    }
    let off = if draw.once_in(2) {
        0.0
    } else {
        draw.magnitude(1e-13, 1e-2)
    };
    for i in 0..n {
        if draw.once_in(2) {
            numbers[b + i] = numbers[a + i] + off * draw.within(-1.0, 1.0);
        }
    }
    true
}

/// Returns an input whose second part touches its first, if both are of one kind.
fn beside<X: Sample>(x: X, lengths: &[usize], near: Option<Vec<f64>>) -> X {
    let (Some(near), [n, m, ..]) = (near, lengths) else {
        return x;
    };
    let (kinds, mut numbers) = (x.kinds(), x.scalars());
    if n != m || kinds[..*n] != kinds[*n..n + m] {
        return x;
    }
    numbers[*n..n + m].copy_from_slice(&near);
    let there = x.refill(&numbers);
    if there.inside() { there } else { x }
}

/// Returns the lengths over which a function of several parts may be expected to change, from those of each part. The
/// smallest part bounds all of them. A turn moves the far end of the largest one.
pub fn together(own: Vec<f64>, kinds: &[Kind]) -> Vec<f64> {
    let lengths = || own.iter().zip(kinds).filter(|(_, kind)| kind.is_length());
    let place = lengths().fold(f64::INFINITY, |m, (s, k)| match k {
        k if k.is_place() => m.min(*s),
        _ => m,
    });
    // Without coordinates of a point all are lengths along one line.
    let place = match kinds.iter().any(|kind| kind.is_place()) {
        true => place,
        false => lengths().fold(place, |m, (s, _)| m.min(*s)),
    };
    let largest = lengths().fold(0.0_f64, |m, (s, _)| m.max(*s));
    let scale = |(own, kind): (&f64, &Kind)| match kind {
        kind if largest > 0.0 && kind.is_measured_at_one() => {
            (10.0 * place / largest).clamp(1e-9, 1.0)
        }
        kind if kind.is_length() && place.is_finite() => own.min(10.0 * place),
        _ => *own,
    };
    own.iter().zip(kinds).map(scale).collect()
}

/// Returns units of several parts: the size of the smallest for lengths, one for everything else.
pub fn units(extents: &[f64], kinds: &[Kind]) -> Vec<f64> {
    let lengths = extents
        .iter()
        .zip(kinds)
        .filter(|(_, kind)| kind.is_length());
    let least = lengths.fold(f64::INFINITY, |m, (extent, _)| m.min(*extent));
    let unit = |kind: &Kind| if kind.is_length() { least } else { 1.0 };
    kinds.iter().map(unit).collect()
}

impl Sample for f64 {
    fn ordinary(draw: &mut Draw) -> Self {
        match draw.below(6) {
            0 => 0.5 * draw.below(5) as f64 - 1.0,
            _ => draw.within(-2.0, 2.0),
        }
    }
    fn hard() -> Vec<Self> {
        vec![0.0, 1.0, -1.0, 0.5, 2.0, 0.3]
    }
    fn kinds(&self) -> Vec<Kind> {
        vec![Kind::Length]
    }
    fn scales(&self) -> Vec<f64> {
        vec![if *self == 0.0 { 1.0 } else { self.abs() }]
    }
    fn inside(&self) -> bool {
        self.is_finite()
    }
}

impl<X: Sample, const N: usize> Sample for [X; N] {
    fn ordinary(draw: &mut Draw) -> Self {
        from_fn(|_| X::ordinary(draw))
    }
    fn thin(draw: &mut Draw) -> Self {
        from_fn(|_| X::thin(draw))
    }
    fn touching(draw: &mut Draw) -> Self {
        let all: Self = from_fn(|_| X::draw(draw));
        let near = all.first().map(|x| x.beside(draw).scalars());
        let lengths = all.each_ref().map(Pack::count);
        beside(all, &lengths, near)
    }
    fn draw(draw: &mut Draw) -> Self {
        let all: Self = from_fn(|_| X::draw(draw));
        let lengths = all.each_ref().map(Pack::count);
        mingled(all, &lengths, draw)
    }
    fn hard() -> Vec<Self> {
        let cases = X::hard();
        let all = combinations(&[cases.len(); N], SHAPES);
        all.iter()
            .map(|at| from_fn(|i| cases[at[i]].clone()))
            .collect()
    }
    fn kinds(&self) -> Vec<Kind> {
        self.iter().flat_map(Sample::kinds).collect()
    }
    fn scales(&self) -> Vec<f64> {
        together(
            self.iter().flat_map(Sample::scales).collect(),
            &self.kinds(),
        )
    }
    fn extents(&self) -> Vec<f64> {
        self.iter().flat_map(Sample::extents).collect()
    }
    fn units(&self) -> Vec<f64> {
        units(&self.extents(), &self.kinds())
    }
    fn inside(&self) -> bool {
        self.iter().all(Sample::inside)
    }
    fn outlines(&self) -> Vec<Vec<[f64; 2]>> {
        self.iter().flat_map(Sample::outlines).collect()
    }
}

/// Tuples; the macro lists their parts. Pairs, which harness and tests use most, have an
/// implementation of their own.
macro_rules! tuples {
    ($(($($part:ident.$place:tt),*))*) => { $(
        impl<$($part: Sample),*> Sample for ($($part,)*) {
            fn ordinary(draw: &mut Draw) -> Self {
                ($($part::ordinary(draw),)*)
            }
            fn thin(draw: &mut Draw) -> Self {
                // At least one of them is thin.
                let which = draw.below([$($place),*].len());
                ($(if which == $place || draw.once_in(2) {
                    $part::thin(draw)
                } else {
                    $part::ordinary(draw)
                },)*)
            }
            fn touching(draw: &mut Draw) -> Self {
                let all = ($($part::draw(draw),)*);
                let near = Some(all.0.beside(draw).scalars());
                let lengths = [$(all.$place.count()),*];
                beside(all, &lengths, near)
            }
            fn draw(draw: &mut Draw) -> Self {
                if draw.once_in(16) {
                    return Self::touching(draw);
                }
                let all = ($($part::draw(draw),)*);
                let lengths = [$(all.$place.count()),*];
                mingled(all, &lengths, draw)
            }
            fn hard() -> Vec<Self> {
                let parts = ($($part::hard(),)*);
                let all = combinations(&[$(parts.$place.len()),*], TUPLES);
                all.iter().map(|at| ($(parts.$place[at[$place]].clone(),)*)).collect()
            }
            fn kinds(&self) -> Vec<Kind> {
                joined([$(self.$place.kinds()),*])
            }
            fn scales(&self) -> Vec<f64> {
                together(joined([$(self.$place.scales()),*]), &self.kinds())
            }
            fn extents(&self) -> Vec<f64> {
                joined([$(self.$place.extents()),*])
            }
            fn units(&self) -> Vec<f64> {
                units(&self.extents(), &self.kinds())
            }
            fn inside(&self) -> bool {
                $(self.$place.inside())&&*
            }
            fn outlines(&self) -> Vec<Vec<[f64; 2]>> {
                joined([$(self.$place.outlines()),*])
            }
            fn samplers() -> Vec<Sampler> {
                joined([$($part::samplers()),*])
            }
        }
    )* };
}
tuples! {
    (A.0)
    (A.0, B.1, C.2)
    (A.0, B.1, C.2, D.3)
    (A.0, B.1, C.2, D.3, E.4)
    (A.0, B.1, C.2, D.3, E.4, F.5)
}
