//! Verbs as methods of their first argument, for every pair of shapes that has a row.
use super::{Binary, Unary};

/// Defines traits of one method each.
macro_rules! methods {
    ($($Verb:ident $method:ident;)*) => { $(
        #[doc = concat!("[`", stringify!($Verb), "`](crate::kernels::verbs::", stringify!($Verb), ") as a method.")]
        pub trait $Verb<B>: Sized {
            /// The result.
            type Out;
            #[doc = concat!("[`", stringify!($Verb), "`](crate::kernels::verbs::", stringify!($Verb), ") of this shape and another.")]
            fn $method(self, other: B) -> Self::Out;
        }
        impl<A, B> $Verb<B> for A
        where
            super::$Verb: Binary<A, B>,
        {
            type Out = <super::$Verb as Binary<A, B>>::Out;
            #[inline]
            fn $method(self, other: B) -> Self::Out {
                <super::$Verb as Binary<A, B>>::apply(self, other)
            }
        }
    )* };
}
methods! {
    Iou iou;
    Iof iof;
    IntersectionArea intersection_area;
    IntersectionVolume intersection_volume;
    IntersectionLength intersection_length;
    IouBev iou_bev;
    SeparationAware separation_aware;
    HullArea hull_area;
    Giou giou;
    GiouHull giou_hull;
    GiouAabb giou_aabb;
    GiouRectangle giou_rectangle;
    Diou diou;
    DiouHull diou_hull;
    DiouAabb diou_aabb;
    DiouRectangle diou_rectangle;
    Ciou ciou;
    CiouHull ciou_hull;
    CiouAabb ciou_aabb;
    CiouRectangle ciou_rectangle;
    CiouFixedWeight ciou_fixed_weight;
    Eiou eiou;
    EiouHull eiou_hull;
    EiouAabb eiou_aabb;
    EiouRectangle eiou_rectangle;
    Wasserstein wasserstein;
    SquaredWasserstein squared_wasserstein;
    KullbackLeibler kullback_leibler;
    Jeffreys jeffreys;
    Bhattacharyya bhattacharyya;
    Probiou probiou;
    Kfiou kfiou;
    Crossing crossing;
    Meeting meeting;
    FirstHit first_hit;
    Span span;
    LengthInside length_inside;
    FlipY flip_y;
}

/// Defines traits of one method each, for a single shape.
macro_rules! methods_of_one {
    ($($Verb:ident $method:ident;)*) => { $(
        #[doc = concat!("[`", stringify!($Verb), "`](crate::kernels::verbs::", stringify!($Verb), ") as a method.")]
        pub trait $Verb: Sized {
            /// The result.
            type Out;
            #[doc = concat!("[`", stringify!($Verb), "`](crate::kernels::verbs::", stringify!($Verb), ") of this shape.")]
            fn $method(self) -> Self::Out;
        }
        impl<A> $Verb for A
        where
            super::$Verb: Unary<A>,
        {
            type Out = <super::$Verb as Unary<A>>::Out;
            #[inline]
            fn $method(self) -> Self::Out {
                <super::$Verb as Unary<A>>::apply(self)
            }
        }
    )* };
}
methods_of_one! {
    Diameter diameter;
    Width width;
    MinimumRectangle minimum_rectangle;
    MinimumCircle minimum_circle;
}
