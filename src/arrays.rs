//! Lists of fixed size, element by element, and the order of short lists.

/// Arrays with a function of every element.
pub(crate) trait Each<T> {
    /// A list of this length with other elements.
    type Of<U: Copy>: Copy + AsRef<[U]>;
    /// Returns the results of a function of every element, first element first. Builds without optimisation compile
    /// some 300 lines of LLVM's for every use of the standard library's `map`, and a tenth of that for this loop.
    fn each_as<U: Copy>(self, f: impl FnMut(T) -> U) -> Self::Of<U>;
}

impl<T: Copy, const N: usize> Each<T> for [T; N] {
    type Of<U: Copy> = [U; N];
    #[inline(always)]
    fn each_as<U: Copy>(self, mut f: impl FnMut(T) -> U) -> [U; N] {
        if const { N == 0 } {
            return self.map(f);
        }
        let mut all = [f(self[0]); N];
        let mut i = 1;
        while i < N {
            all[i] = f(self[i]);
            i += 1;
        }
        all
    }
}

/// Sorts a short list; equal elements stay in their order. The standard library's sort is some thousand instructions for
/// every use, for lists of any length; up to twenty elements it takes these steps, too.
#[inline]
pub(crate) fn sort_few<T>(all: &mut [T], is_less: impl Fn(&T, &T) -> bool) {
    for end in 1..all.len() {
        let mut at = end;
        while at > 0 && is_less(&all[at], &all[at - 1]) {
            all.swap(at, at - 1);
            at -= 1;
        }
    }
}
