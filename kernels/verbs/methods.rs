//! Verbs as methods of their first argument, for every pair of shapes that has a row.

/// Defines traits of one method each, for a number of arguments.
macro_rules! methods {
    ($arguments:tt: $($Verb:ident $method:ident;)*) => {
        $( crate::__verb!([method [pub] $Verb::$method $Verb [super::$Verb]] $arguments); )*
    };
}
methods! {
    (this, other):
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

methods! {
    (this):
    Diameter diameter;
    Width width;
    MinimumRectangle minimum_rectangle;
    MinimumCircle minimum_circle;
}
