//! The rows: every operation of the library, one file per family.
pub(crate) mod class;
pub(crate) mod noun;
mod tables;
pub mod walk;

/// Declares the modules of the families, and the list of all their rows.
macro_rules! families {
    ($($family:ident)*) => {
        $(pub(crate) mod $family;)*

        /// Passes every row of the library to `walk`, with its types.
        #[inline]
        pub fn each<W: walk::Walk>(walk: &mut W) {
            $($family::each(walk);)*
        }

        /// Returns the names of all rows, in the order of [`each`].
        pub fn written() -> impl Iterator<Item = &'static walk::Written> {
            let families = [$($family::NAMES),*].into_iter().flatten();
            families.flat_map(|rows| rows.iter())
        }
    };
}
families! {
    overlap iou interval distance intersection shape moved gaussian convention
    overlap3 iou3 distance3 intersection3 camera
    polygon extent ring path path3 solid hull_measure hull3 overlap_solid curved3 contact motion curve
}
