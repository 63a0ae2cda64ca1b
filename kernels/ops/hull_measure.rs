//! Measures of convex hulls of space as operations, with a search.
use crate::distance3::half_space::Bounded;
use crate::hull3::HullFacesRecord;
use crate::kernels::verbs::{Centroid, Surface, Volume};
use crate::scalar::Guard;
use crate::{Hull3, Vec3};

/// Writes operations that measure a hull of up to `N` vertices, and joins them to their verbs.
///
/// A line says the verb, the name of the row, the result and the measure of [`HullFaces`](crate::hull3::HullFaces), then
/// the class of invariance and the jumps. In the list a hull has up to eight vertices.
macro_rules! hull_measures {
    ($(
        $(#[doc = $title:literal])+
        $Verb:ident = $name:literal -> $out:ty, by $measure:ident
        $class:tt $(range $range:ident)? jumps $jumps:ident;
    )*) => {
        $( const _: () = {
            // As visible as the verb.
            #[derive(Clone, Copy, Debug, Default)]
            pub struct Item<const N: usize>;

            impl<const N: usize> crate::kernels::row::op::Declares for Item<N> {
                const DECLARED: crate::kernels::row::op::Declared = crate::kernels::row::op::Declared::new(
                    $name,
                    crate::kernels::ops::class::invariances!($class Hull3<f64, 8>),
                    crate::kernels::row::op::Jumps::$jumps,
                )
                .arguments(&["shape"])
                .doc(crate::kernels::ops::tables::text!(concat!($($title),+), "", Hull3<f64, 8>))
                $(.range(crate::kernels::row::op::Range::$range))?;
            }

            impl<const N: usize> crate::kernels::call::search::Search for Item<N> {
                type In<S: crate::Scalar> = Hull3<S, N>;
                type Out<S: crate::Scalar> = $out;
                type Record = HullFacesRecord<N>;
                fn decide<S: crate::Scalar<Mask = bool>>(shape: Hull3<S, N>) -> HullFacesRecord<N> {
                    HullFacesRecord::search(shape.as_slice())
                }
                fn replay<S: crate::Scalar>(shape: Hull3<S, N>, record: HullFacesRecord<N>) -> $out {
                    record.faces().$measure(shape.as_slice())
                }
                fn reads(record: &HullFacesRecord<N>, place: usize) -> bool {
                    record.has(place / 3)
                }
            }

            impl<S: crate::Scalar<Mask = bool>, const N: usize> crate::kernels::verbs::Unary<Hull3<S, N>>
                for $Verb
            {
                type Out = $out;
                type By = crate::kernels::call::search::Searched<Item<N>>;
                const BY: Self::By = crate::kernels::call::search::search(Item);
                #[inline]
                fn apply(shape: Hull3<S, N>) -> $out {
                    use crate::kernels::call::search::Search;
                    let record = Item::<N>::decide(shape);
                    shape.with_numbers(Guard::new()).result(Item::<N>::replay(shape, record))
                }
            }
        }; )*
        crate::kernels::ops::tables::listed! {
            names [$([crate::kernels::ops::tables::line!(
                names [] search $Verb, $name, [Hull3_8] Hull3<f64, 8>
            )]),*]
            each |walk| { $(crate::kernels::ops::tables::line!(
                each [walk] search $Verb, $name, [Hull3_8] Hull3<f64, 8>
            );)* }
        }
    };
}

hull_measures! {
    /// The [volume](crate::hull3::HullFaces::volume) of {} of up to `N` vertices; 0 of a flat one.
    Volume = "volume_hull" -> S, by volume [rigid(3)] range NOT_NEGATIVE jumps Never;
    /// The [area of the surface](crate::hull3::HullFaces::surface) of {} of up to `N` vertices; of both sides of a flat
    /// one.
    Surface = "surface_hull" -> S, by surface [rigid(2)] range NOT_NEGATIVE jumps Never;
    /// The [centre of the volume](crate::hull3::HullFaces::centroid) of {} of up to `N` vertices. It jumps where the hull
    /// becomes flat, which has the centre of its area.
    Centroid = "centroid_hull" -> Vec3<S>, by centroid [follows] jumps Anywhere;
}
