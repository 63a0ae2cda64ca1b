//! Rows of the library by names of their own, for tests that mean one of them.
use geograd::convention::KittiBox;
use geograd::iou::Exponent;
use geograd::kernels::fold::{Cloud3, Polyline, Polyline3, Ring};
use geograd::kernels::verbs::{self, OverPath, Takes};
use geograd::{
    Aabb2, Aabb3, Capsule2, Circle, Interval, Line2, Obb2, Obb3, Pose2, Ray2, Segment2, Triangle2,
    Vec2, Vec3, YawBox3,
};

/// A type and a value of that name.
macro_rules! rows {
    ($($Name:ident = $verb:ty: $input:ty;)*) => { $(
        pub type $Name = <$verb as Takes<$input>>::By;
        #[allow(non_upper_case_globals)]
        pub const $Name: $Name = <$verb as Takes<$input>>::BY;
    )* };
}
rows! {
    CornersOfObb2 = verbs::Corners: Obb2<f64>;
    KittiOfYaw = verbs::Convert<KittiBox<f64>>: YawBox3<f64>;
    DistancePointSegment = verbs::Distance: (Vec2<f64>, Segment2<f64>);
    DistanceSegments = verbs::Distance: (Segment2<f64>, Segment2<f64>);
    SignedDistanceAabb2 = verbs::SignedDistance: (Aabb2<f64>, Aabb2<f64>);
    DistanceAabb2 = verbs::Distance: (Aabb2<f64>, Aabb2<f64>);
    SquaredDistanceAabb2 = verbs::SquaredDistance: (Aabb2<f64>, Aabb2<f64>);
    FarthestDistanceAabb2 = verbs::FarthestDistance: (Aabb2<f64>, Aabb2<f64>);
    ClosestPointsAabb2 = verbs::ClosestPoints: (Aabb2<f64>, Aabb2<f64>);
    DistanceObb2 = verbs::Distance: (Obb2<f64>, Obb2<f64>);
    SignedDistanceObb2 = verbs::SignedDistance: (Obb2<f64>, Obb2<f64>);
    SquaredDistanceObb2 = verbs::SquaredDistance: (Obb2<f64>, Obb2<f64>);
    FarthestDistanceObb2 = verbs::FarthestDistance: (Obb2<f64>, Obb2<f64>);
    PenetrationObb2 = verbs::Penetration: (Obb2<f64>, Obb2<f64>);
    ClosestPointsObb2 = verbs::ClosestPoints: (Obb2<f64>, Obb2<f64>);
    SignedDistancePointObb2 = verbs::SignedDistance: (Vec2<f64>, Obb2<f64>);
    ClosestPointsOfSegments = verbs::ClosestPoints: (Segment2<f64>, Segment2<f64>);
    DistancePointCircle = verbs::Distance: (Vec2<f64>, Circle<f64>);
    DistancePointTriangle = verbs::Distance: (Vec2<f64>, Triangle2<f64>);
    DistancePointCapsule = verbs::Distance: (Vec2<f64>, Capsule2<f64>);
    DistancePointAabb2 = verbs::Distance: (Vec2<f64>, Aabb2<f64>);
    DistancePointObb2 = verbs::Distance: (Vec2<f64>, Obb2<f64>);
    DistanceSegmentCircle = verbs::Distance: (Segment2<f64>, Circle<f64>);
    DistanceSegmentObb2 = verbs::Distance: (Segment2<f64>, Obb2<f64>);
    DistanceCircles = verbs::Distance: (Circle<f64>, Circle<f64>);
    DistanceCircleObb2 = verbs::Distance: (Circle<f64>, Obb2<f64>);
    DistanceCapsules = verbs::Distance: (Capsule2<f64>, Capsule2<f64>);
    DistanceTriangles = verbs::Distance: (Triangle2<f64>, Triangle2<f64>);
    SignedDistancePointCircle = verbs::SignedDistance: (Vec2<f64>, Circle<f64>);
    SignedDistancePointTriangle = verbs::SignedDistance: (Vec2<f64>, Triangle2<f64>);
    SignedDistancePointCapsule = verbs::SignedDistance: (Vec2<f64>, Capsule2<f64>);
    SignedDistancePointAabb2 = verbs::SignedDistance: (Vec2<f64>, Aabb2<f64>);
    SignedDistanceSegmentCircle = verbs::SignedDistance: (Segment2<f64>, Circle<f64>);
    SignedDistanceSegmentObb2 = verbs::SignedDistance: (Segment2<f64>, Obb2<f64>);
    SignedDistanceCircles = verbs::SignedDistance: (Circle<f64>, Circle<f64>);
    SignedDistanceCircleObb2 = verbs::SignedDistance: (Circle<f64>, Obb2<f64>);
    SignedDistanceCapsules = verbs::SignedDistance: (Capsule2<f64>, Capsule2<f64>);
    SignedDistanceTriangles = verbs::SignedDistance: (Triangle2<f64>, Triangle2<f64>);
    DepthPointAabb2 = verbs::Depth: (Vec2<f64>, Aabb2<f64>);
    DepthPointObb2 = verbs::Depth: (Vec2<f64>, Obb2<f64>);
    SquaredDistancePointSegment = verbs::SquaredDistance: (Vec2<f64>, Segment2<f64>);
    SquaredDistancePointTriangle = verbs::SquaredDistance: (Vec2<f64>, Triangle2<f64>);
    SquaredDistanceSegments = verbs::SquaredDistance: (Segment2<f64>, Segment2<f64>);
    SquaredDistanceTriangles = verbs::SquaredDistance: (Triangle2<f64>, Triangle2<f64>);
    FarthestDistancePointObb2 = verbs::FarthestDistance: (Vec2<f64>, Obb2<f64>);
    FarthestDistanceCircleObb2 = verbs::FarthestDistance: (Circle<f64>, Obb2<f64>);
    FarthestDistanceTriangles = verbs::FarthestDistance: (Triangle2<f64>, Triangle2<f64>);
    PenetrationCircles = verbs::Penetration: (Circle<f64>, Circle<f64>);
    PenetrationCapsules = verbs::Penetration: (Capsule2<f64>, Capsule2<f64>);
    PenetrationTriangles = verbs::Penetration: (Triangle2<f64>, Triangle2<f64>);
    PenetrationAabb2 = verbs::Penetration: (Aabb2<f64>, Aabb2<f64>);
    PenetrationCircleObb2 = verbs::Penetration: (Circle<f64>, Obb2<f64>);
    ClosestPointsCircleObb2 = verbs::ClosestPoints: (Circle<f64>, Obb2<f64>);
    ClosestPointsPointSegment = verbs::ClosestPoints: (Vec2<f64>, Segment2<f64>);
    ClosestPointsPointTriangle = verbs::ClosestPoints: (Vec2<f64>, Triangle2<f64>);
    ClosestPointsPointObb2 = verbs::ClosestPoints: (Vec2<f64>, Obb2<f64>);
    ClosestPointsCapsules = verbs::ClosestPoints: (Capsule2<f64>, Capsule2<f64>);
    ClosestPointsTriangles = verbs::ClosestPoints: (Triangle2<f64>, Triangle2<f64>);
    SignedDistancePointAabb3 = verbs::SignedDistance: (Vec3<f64>, Aabb3<f64>);
    SignedDistancePointYaw = verbs::SignedDistance: (Vec3<f64>, YawBox3<f64>);
    SignedDistancePointObb3 = verbs::SignedDistance: (Vec3<f64>, Obb3<f64>);
    DistancePointAabb3 = verbs::Distance: (Vec3<f64>, Aabb3<f64>);
    DistancePointYaw = verbs::Distance: (Vec3<f64>, YawBox3<f64>);
    DistancePointObb3 = verbs::Distance: (Vec3<f64>, Obb3<f64>);
    WassersteinObb2 = verbs::Wasserstein: (Obb2<f64>, Obb2<f64>);
    WassersteinSquaredObb2 = verbs::SquaredWasserstein: (Obb2<f64>, Obb2<f64>);
    KullbackLeiblerObb2 = verbs::KullbackLeibler: (Obb2<f64>, Obb2<f64>);
    JeffreysObb2 = verbs::Jeffreys: (Obb2<f64>, Obb2<f64>);
    BhattacharyyaObb2 = verbs::Bhattacharyya: (Obb2<f64>, Obb2<f64>);
    ProbiouObb2 = verbs::Probiou: (Obb2<f64>, Obb2<f64>);
    KfiouObb2 = verbs::Kfiou: (Obb2<f64>, Obb2<f64>);
    WassersteinObb3 = verbs::Wasserstein: (Obb3<f64>, Obb3<f64>);
    WassersteinSquaredObb3 = verbs::SquaredWasserstein: (Obb3<f64>, Obb3<f64>);
    KullbackLeiblerObb3 = verbs::KullbackLeibler: (Obb3<f64>, Obb3<f64>);
    JeffreysObb3 = verbs::Jeffreys: (Obb3<f64>, Obb3<f64>);
    BhattacharyyaObb3 = verbs::Bhattacharyya: (Obb3<f64>, Obb3<f64>);
    ProbiouObb3 = verbs::Probiou: (Obb3<f64>, Obb3<f64>);
    KfiouObb3 = verbs::Kfiou: (Obb3<f64>, Obb3<f64>);
    CrossingOfLines = verbs::Crossing: (Line2<f64>, Line2<f64>);
    MeetingOfSegments = verbs::Meeting: (Segment2<f64>, Segment2<f64>);
    FirstHitRayCircle = verbs::FirstHit: (Ray2<f64>, Circle<f64>);
    FirstHitRayTriangle = verbs::FirstHit: (Ray2<f64>, Triangle2<f64>);
    FirstHitRayCapsule = verbs::FirstHit: (Ray2<f64>, Capsule2<f64>);
    FirstHitRayAabb2 = verbs::FirstHit: (Ray2<f64>, Aabb2<f64>);
    FirstHitRayObb2 = verbs::FirstHit: (Ray2<f64>, Obb2<f64>);
    SpanLineCircle = verbs::Span: (Line2<f64>, Circle<f64>);
    SpanLineTriangle = verbs::Span: (Line2<f64>, Triangle2<f64>);
    SpanLineCapsule = verbs::Span: (Line2<f64>, Capsule2<f64>);
    SpanLineAabb2 = verbs::Span: (Line2<f64>, Aabb2<f64>);
    SpanLineObb2 = verbs::Span: (Line2<f64>, Obb2<f64>);
    LengthInsideSegmentCircle = verbs::LengthInside: (Segment2<f64>, Circle<f64>);
    LengthInsideSegmentTriangle = verbs::LengthInside: (Segment2<f64>, Triangle2<f64>);
    LengthInsideSegmentCapsule = verbs::LengthInside: (Segment2<f64>, Capsule2<f64>);
    LengthInsideSegmentAabb2 = verbs::LengthInside: (Segment2<f64>, Aabb2<f64>);
    LengthInsideSegmentObb2 = verbs::LengthInside: (Segment2<f64>, Obb2<f64>);
    IouIntervals = verbs::Iou: (Interval<f64>, Interval<f64>);
    IntersectionLengthIntervals = verbs::IntersectionLength: (Interval<f64>, Interval<f64>);
    DistanceIntervals = verbs::Distance: (Interval<f64>, Interval<f64>);
    SignedDistanceIntervals = verbs::SignedDistance: (Interval<f64>, Interval<f64>);
    DistanceNumberInterval = verbs::Distance: (f64, Interval<f64>);
    AlphaIouObb2 = verbs::AlphaIou: (Obb2<f64>, Obb2<f64>, Exponent<f64>);
    AlphaIouAabb2 = verbs::AlphaIou: (Aabb2<f64>, Aabb2<f64>, Exponent<f64>);
    GiouAabb2 = verbs::Giou: (Aabb2<f64>, Aabb2<f64>);
    DiouAabb2 = verbs::Diou: (Aabb2<f64>, Aabb2<f64>);
    DiouObb2 = verbs::Diou: (Obb2<f64>, Obb2<f64>);
    CiouAabb2 = verbs::Ciou: (Aabb2<f64>, Aabb2<f64>);
    CiouObb2 = verbs::Ciou: (Obb2<f64>, Obb2<f64>);
    EiouAabb2 = verbs::Eiou: (Aabb2<f64>, Aabb2<f64>);
    EiouObb2 = verbs::Eiou: (Obb2<f64>, Obb2<f64>);
    HullAreaObb2 = verbs::HullArea: (Obb2<f64>, Obb2<f64>);
    HullAreaAabb2 = verbs::HullArea: (Aabb2<f64>, Aabb2<f64>);
    GiouYaw = verbs::Giou: (YawBox3<f64>, YawBox3<f64>);
    DiouYaw = verbs::Diou: (YawBox3<f64>, YawBox3<f64>);
    CiouYaw = verbs::Ciou: (YawBox3<f64>, YawBox3<f64>);
    EiouYaw = verbs::Eiou: (YawBox3<f64>, YawBox3<f64>);
    GiouObb3 = verbs::Giou: (Obb3<f64>, Obb3<f64>);
    DiouObb3 = verbs::Diou: (Obb3<f64>, Obb3<f64>);
    CiouObb3 = verbs::Ciou: (Obb3<f64>, Obb3<f64>);
    EiouObb3 = verbs::Eiou: (Obb3<f64>, Obb3<f64>);
    GiouAabbObb3 = verbs::GiouAabb: (Obb3<f64>, Obb3<f64>);
    DiouAabbObb3 = verbs::DiouAabb: (Obb3<f64>, Obb3<f64>);
    CiouAabbObb3 = verbs::CiouAabb: (Obb3<f64>, Obb3<f64>);
    EiouAabbObb3 = verbs::EiouAabb: (Obb3<f64>, Obb3<f64>);
    SeparationAwareAabb3 = verbs::SeparationAware: (Aabb3<f64>, Aabb3<f64>);
    SeparationAwareYaw = verbs::SeparationAware: (YawBox3<f64>, YawBox3<f64>);
    SeparationAwareObb3 = verbs::SeparationAware: (Obb3<f64>, Obb3<f64>);
    SeparationAwareObb2 = verbs::SeparationAware: (Obb2<f64>, Obb2<f64>);
    IntersectionVolumeAabb3 = verbs::IntersectionVolume: (Aabb3<f64>, Aabb3<f64>);
    IouAabb3 = verbs::Iou: (Aabb3<f64>, Aabb3<f64>);
    IofAabb3 = verbs::Iof: (Aabb3<f64>, Aabb3<f64>);
    IntersectionVolumeYaw = verbs::IntersectionVolume: (YawBox3<f64>, YawBox3<f64>);
    IouYaw = verbs::Iou: (YawBox3<f64>, YawBox3<f64>);
    IofYaw = verbs::Iof: (YawBox3<f64>, YawBox3<f64>);
    IouBirdsEye = verbs::IouBev: (YawBox3<f64>, YawBox3<f64>);
    IntersectionVolumeObb3 = verbs::IntersectionVolume: (Obb3<f64>, Obb3<f64>);
    IouObb3 = verbs::Iou: (Obb3<f64>, Obb3<f64>);
    IofObb3 = verbs::Iof: (Obb3<f64>, Obb3<f64>);
    IouAabb3Yaw = verbs::Iou: (Aabb3<f64>, YawBox3<f64>);
    IouAabb3Obb3 = verbs::Iou: (Aabb3<f64>, Obb3<f64>);
    IouYawObb3 = verbs::Iou: (YawBox3<f64>, Obb3<f64>);
    SignedAreaTriangle = verbs::SignedArea: Triangle2<f64>;
    AreaTriangle = verbs::Area: Triangle2<f64>;
    PerimeterTriangle = verbs::Perimeter: Triangle2<f64>;
    CentroidTriangle = verbs::Centroid: Triangle2<f64>;
    SignedAreaQuad = verbs::SignedArea: [Vec2<f64>; 4];
    PerimeterQuad = verbs::Perimeter: [Vec2<f64>; 4];
    CentroidQuad = verbs::Centroid: [Vec2<f64>; 4];
    IntersectionAreaQuads = verbs::IntersectionArea: ([Vec2<f64>; 4], [Vec2<f64>; 4]);
    Circumcircle = verbs::Circumcircle: (Vec2<f64>, Vec2<f64>, Vec2<f64>);
    Incircle = verbs::Incircle: Triangle2<f64>;
    MoveSegment = verbs::Move: (Pose2<f64>, Segment2<f64>);
    IouObb2 = verbs::Iou: (Obb2<f64>, Obb2<f64>);
    IouAabb2 = verbs::Iou: (Aabb2<f64>, Aabb2<f64>);
    IofObb2 = verbs::Iof: (Obb2<f64>, Obb2<f64>);
    IofAabb2 = verbs::Iof: (Aabb2<f64>, Aabb2<f64>);
    IntersectionAreaObb2 = verbs::IntersectionArea: (Obb2<f64>, Obb2<f64>);
    IntersectionAreaAabb2 = verbs::IntersectionArea: (Aabb2<f64>, Aabb2<f64>);
    GiouObb2 = verbs::Giou: (Obb2<f64>, Obb2<f64>);
}

/// Folds over paths.
macro_rules! folds {
    ($($Name:ident = $verb:ident $Path:ident;)*) => { $(
        pub type $Name = <verbs::$verb as OverPath<$Path>>::By;
        #[allow(non_upper_case_globals)]
        pub const $Name: $Name = <verbs::$verb as OverPath<$Path>>::BY;
    )* };
}
folds! {
    DistancePointPolyline = Distance Polyline;
    DistancePointRing = Distance Ring;
    SignedDistancePointRing = SignedDistance Ring;
    DepthPointRing = Depth Ring;
    WindingOfRing = Winding Ring;
    LengthOfPolyline = Length Polyline;
    LengthInsideRing = LengthInside Ring;
    SecondMomentsOfRing = SecondMoments Ring;
    SignedAreaOfRing = SignedArea Ring;
    AreaOfRing = Area Ring;
    PerimeterOfRing = Perimeter Ring;
    CentroidOfRing = Centroid Ring;
    DistancePointPolyline3 = Distance Polyline3;
    LengthOfPolyline3 = Length Polyline3;
    CentroidOfCloud3 = Centroid Cloud3;
    CovarianceOfCloud3 = SecondMoments Cloud3;
}

pub mod distance {
    pub use super::{
        ClosestPointsAabb2, ClosestPointsCapsules, ClosestPointsCircleObb2, ClosestPointsObb2,
        ClosestPointsOfSegments, ClosestPointsPointObb2, ClosestPointsPointSegment,
        ClosestPointsPointTriangle, ClosestPointsTriangles, DepthPointAabb2, DepthPointObb2,
        DistanceAabb2, DistanceCapsules, DistanceCircleObb2, DistanceCircles, DistanceObb2,
        DistancePointAabb2, DistancePointCapsule, DistancePointCircle, DistancePointObb2,
        DistancePointSegment, DistancePointTriangle, DistanceSegmentCircle, DistanceSegmentObb2,
        DistanceSegments, DistanceTriangles, FarthestDistanceAabb2, FarthestDistanceCircleObb2,
        FarthestDistanceObb2, FarthestDistancePointObb2, FarthestDistanceTriangles,
        PenetrationAabb2, PenetrationCapsules, PenetrationCircleObb2, PenetrationCircles,
        PenetrationObb2, PenetrationTriangles, SignedDistanceAabb2, SignedDistanceCapsules,
        SignedDistanceCircleObb2, SignedDistanceCircles, SignedDistanceObb2,
        SignedDistancePointAabb2, SignedDistancePointCapsule, SignedDistancePointCircle,
        SignedDistancePointObb2, SignedDistancePointTriangle, SignedDistanceSegmentCircle,
        SignedDistanceSegmentObb2, SignedDistanceTriangles, SquaredDistanceAabb2,
        SquaredDistanceObb2, SquaredDistancePointSegment, SquaredDistancePointTriangle,
        SquaredDistanceSegments, SquaredDistanceTriangles,
    };
}
pub mod fold {
    pub use super::{
        CentroidOfCloud3, CovarianceOfCloud3, DepthPointRing, DistancePointPolyline,
        DistancePointPolyline3, DistancePointRing, LengthInsideRing, LengthOfPolyline,
        LengthOfPolyline3, SecondMomentsOfRing, SignedDistancePointRing, WindingOfRing,
    };
}
pub mod iou {
    pub use super::{
        AlphaIouAabb2, AlphaIouObb2, CiouAabb2, CiouObb2, DiouAabb2, DiouObb2, EiouAabb2, EiouObb2,
        GiouAabb2, GiouObb2, HullAreaAabb2, HullAreaObb2,
    };
}
pub mod iou3 {
    pub use super::{
        CiouAabbObb3, CiouObb3, CiouYaw, DiouAabbObb3, DiouObb3, DiouYaw, EiouAabbObb3, EiouObb3,
        EiouYaw, GiouAabbObb3, GiouObb3, GiouYaw, SeparationAwareAabb3, SeparationAwareObb2,
        SeparationAwareObb3, SeparationAwareYaw,
    };
}
pub mod overlap {
    pub use super::{
        IntersectionAreaAabb2, IntersectionAreaObb2, IofAabb2, IofObb2, IouAabb2, IouObb2,
    };
}
pub mod overlap3 {
    pub use super::{
        IntersectionVolumeAabb3, IntersectionVolumeObb3, IntersectionVolumeYaw, IofAabb3, IofObb3,
        IofYaw, IouAabb3, IouAabb3Obb3, IouAabb3Yaw, IouBirdsEye, IouObb3, IouYaw, IouYawObb3,
    };
}
pub mod ring {
    pub use super::{
        AreaOfRing as Area, CentroidOfRing as Centroid, PerimeterOfRing as Perimeter,
        SignedAreaOfRing as SignedArea,
    };
}
