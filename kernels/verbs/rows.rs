//! Rows: which operation serves a verb and shapes.
use super::list::*;
use super::{Binary, OverPolyline, OverRing, Unary};
use crate::convention::{
    Detectron2Box, ImageBox, KittiBox, Le90, Le135, LidarBox, NuScenesBox, OpenCvBox, Xyxyr,
};
use crate::kernels::decided::Decided;
use crate::kernels::op::Op;
use crate::kernels::ops::convention::*;
use crate::kernels::ops::distance::*;
use crate::kernels::ops::extent::*;
use crate::kernels::ops::fold::*;
use crate::kernels::ops::intersection::*;
use crate::kernels::ops::iou3::*;
use crate::kernels::ops::overlap::*;
use crate::kernels::ops::overlap3::*;
use crate::kernels::ops::polygon::*;
use crate::kernels::ops::shape::{
    Circumcircle as ThroughThree, Incircle as Inscribed, MoveSegment,
};
use crate::{
    Aabb2, Aabb3, Capsule2, Circle, ConvexPolygon, Line2, Obb2, Obb3, Pose2, Ray2, Scalar,
    Segment2, Triangle2, Vec2, YawBox3,
};

/// Joins verbs and shapes to the operations that serve them.
macro_rules! rows {
    ($($Verb:ident($($shape:ty),+) by $By:ident;)*) => { $(
        crate::__takes!($Verb, ($($shape),+), $By, $By);
    )* };
}
rows! {
    IntersectionArea([Vec2<S>; 4], [Vec2<S>; 4]) by IntersectionAreaQuads;
    IntersectionArea(Obb2<S>, Obb2<S>) by IntersectionAreaObb2;
    IntersectionArea(Aabb2<S>, Aabb2<S>) by IntersectionAreaAabb2;
    IntersectionVolume(Aabb3<S>, Aabb3<S>) by IntersectionVolumeAabb3;
    IntersectionVolume(YawBox3<S>, YawBox3<S>) by IntersectionVolumeYaw;
    IntersectionVolume(Obb3<S>, Obb3<S>) by IntersectionVolumeObb3;
    Iou(Aabb3<S>, Aabb3<S>) by IouAabb3;
    Iou(YawBox3<S>, YawBox3<S>) by IouYaw;
    Iou(Obb3<S>, Obb3<S>) by IouObb3;
    Iou(Aabb3<S>, YawBox3<S>) by IouAabb3Yaw;
    Iou(Aabb3<S>, Obb3<S>) by IouAabb3Obb3;
    Iou(YawBox3<S>, Obb3<S>) by IouYawObb3;
    Iou(Obb2<S>, Obb2<S>) by IouObb2;
    Iou(Aabb2<S>, Aabb2<S>) by IouAabb2;
    Iof(Aabb3<S>, Aabb3<S>) by IofAabb3;
    Iof(YawBox3<S>, YawBox3<S>) by IofYaw;
    Iof(Obb3<S>, Obb3<S>) by IofObb3;
    Iof(Obb2<S>, Obb2<S>) by IofObb2;
    Iof(Aabb2<S>, Aabb2<S>) by IofAabb2;
    IouBev(YawBox3<S>, YawBox3<S>) by IouBirdsEye;
    AlphaIou(YawBox3<S>, YawBox3<S>) by AlphaIouYaw;
    AlphaIou(Aabb3<S>, Aabb3<S>) by AlphaIouAabb3;
    SeparationAware(Aabb3<S>, Aabb3<S>) by SeparationAwareAabb3;
    SeparationAware(YawBox3<S>, YawBox3<S>) by SeparationAwareYaw;
    SeparationAware(Obb3<S>, Obb3<S>) by SeparationAwareObb3;
    SeparationAware(Obb2<S>, Obb2<S>) by SeparationAwareObb2;
    Giou(Aabb3<S>, Aabb3<S>) by GiouAabb3;
    Giou(YawBox3<S>, YawBox3<S>) by GiouYaw;
    Giou(Obb3<S>, Obb3<S>) by GiouObb3;
    GiouAabb(YawBox3<S>, YawBox3<S>) by GiouAabbYaw;
    GiouAabb(Obb3<S>, Obb3<S>) by GiouAabbObb3;
    GiouRectangle(YawBox3<S>, YawBox3<S>) by GiouRectangleYaw;
    Diou(Aabb3<S>, Aabb3<S>) by DiouAabb3;
    Diou(YawBox3<S>, YawBox3<S>) by DiouYaw;
    Diou(Obb3<S>, Obb3<S>) by DiouObb3;
    DiouAabb(YawBox3<S>, YawBox3<S>) by DiouAabbYaw;
    DiouAabb(Obb3<S>, Obb3<S>) by DiouAabbObb3;
    DiouRectangle(YawBox3<S>, YawBox3<S>) by DiouRectangleYaw;
    Ciou(Aabb3<S>, Aabb3<S>) by CiouAabb3;
    Ciou(YawBox3<S>, YawBox3<S>) by CiouYaw;
    Ciou(Obb3<S>, Obb3<S>) by CiouObb3;
    CiouAabb(YawBox3<S>, YawBox3<S>) by CiouAabbYaw;
    CiouAabb(Obb3<S>, Obb3<S>) by CiouAabbObb3;
    CiouRectangle(YawBox3<S>, YawBox3<S>) by CiouRectangleYaw;
    Eiou(Aabb3<S>, Aabb3<S>) by EiouAabb3;
    Eiou(YawBox3<S>, YawBox3<S>) by EiouYaw;
    Eiou(Obb3<S>, Obb3<S>) by EiouObb3;
    EiouAabb(YawBox3<S>, YawBox3<S>) by EiouAabbYaw;
    EiouAabb(Obb3<S>, Obb3<S>) by EiouAabbObb3;
    EiouRectangle(YawBox3<S>, YawBox3<S>) by EiouRectangleYaw;
    Distance(Vec2<S>, Segment2<S>) by DistancePointSegment;
    Distance(Segment2<S>, Segment2<S>) by DistanceSegments;
    Distance(Aabb2<S>, Aabb2<S>) by DistanceAabb2;
    Distance(Obb2<S>, Obb2<S>) by DistanceObb2;
    Distance(Vec2<S>, Circle<S>) by DistancePointCircle;
    Distance(Vec2<S>, Triangle2<S>) by DistancePointTriangle;
    Distance(Vec2<S>, Capsule2<S>) by DistancePointCapsule;
    Distance(Vec2<S>, Aabb2<S>) by DistancePointAabb2;
    Distance(Vec2<S>, Obb2<S>) by DistancePointObb2;
    Distance(Segment2<S>, Circle<S>) by DistanceSegmentCircle;
    Distance(Segment2<S>, Obb2<S>) by DistanceSegmentObb2;
    Distance(Circle<S>, Circle<S>) by DistanceCircles;
    Distance(Circle<S>, Obb2<S>) by DistanceCircleObb2;
    Distance(Capsule2<S>, Capsule2<S>) by DistanceCapsules;
    Distance(Triangle2<S>, Triangle2<S>) by DistanceTriangles;
    SquaredDistance(Aabb2<S>, Aabb2<S>) by SquaredDistanceAabb2;
    SquaredDistance(Obb2<S>, Obb2<S>) by SquaredDistanceObb2;
    SquaredDistance(Vec2<S>, Segment2<S>) by SquaredDistancePointSegment;
    SquaredDistance(Vec2<S>, Triangle2<S>) by SquaredDistancePointTriangle;
    SquaredDistance(Segment2<S>, Segment2<S>) by SquaredDistanceSegments;
    SquaredDistance(Triangle2<S>, Triangle2<S>) by SquaredDistanceTriangles;
    SignedDistance(Aabb2<S>, Aabb2<S>) by SignedDistanceAabb2;
    SignedDistance(Obb2<S>, Obb2<S>) by SignedDistanceObb2;
    SignedDistance(Vec2<S>, Obb2<S>) by SignedDistancePointObb2;
    SignedDistance(Vec2<S>, Circle<S>) by SignedDistancePointCircle;
    SignedDistance(Vec2<S>, Triangle2<S>) by SignedDistancePointTriangle;
    SignedDistance(Vec2<S>, Capsule2<S>) by SignedDistancePointCapsule;
    SignedDistance(Vec2<S>, Aabb2<S>) by SignedDistancePointAabb2;
    SignedDistance(Segment2<S>, Circle<S>) by SignedDistanceSegmentCircle;
    SignedDistance(Segment2<S>, Obb2<S>) by SignedDistanceSegmentObb2;
    SignedDistance(Circle<S>, Circle<S>) by SignedDistanceCircles;
    SignedDistance(Circle<S>, Obb2<S>) by SignedDistanceCircleObb2;
    SignedDistance(Capsule2<S>, Capsule2<S>) by SignedDistanceCapsules;
    SignedDistance(Triangle2<S>, Triangle2<S>) by SignedDistanceTriangles;
    Clearance(Vec2<S>, Aabb2<S>) by ClearancePointAabb2;
    Clearance(Vec2<S>, Obb2<S>) by ClearancePointObb2;
    ClosestPoints(Aabb2<S>, Aabb2<S>) by ClosestPointsAabb2;
    ClosestPoints(Obb2<S>, Obb2<S>) by ClosestPointsObb2;
    ClosestPoints(Segment2<S>, Segment2<S>) by ClosestPointsOfSegments;
    ClosestPoints(Circle<S>, Obb2<S>) by ClosestPointsCircleObb2;
    ClosestPoints(Vec2<S>, Segment2<S>) by ClosestPointsPointSegment;
    ClosestPoints(Vec2<S>, Triangle2<S>) by ClosestPointsPointTriangle;
    ClosestPoints(Vec2<S>, Obb2<S>) by ClosestPointsPointObb2;
    ClosestPoints(Capsule2<S>, Capsule2<S>) by ClosestPointsCapsules;
    ClosestPoints(Triangle2<S>, Triangle2<S>) by ClosestPointsTriangles;
    FarthestDistance(Aabb2<S>, Aabb2<S>) by FarthestDistanceAabb2;
    FarthestDistance(Obb2<S>, Obb2<S>) by FarthestDistanceObb2;
    FarthestDistance(Vec2<S>, Obb2<S>) by FarthestDistancePointObb2;
    FarthestDistance(Circle<S>, Obb2<S>) by FarthestDistanceCircleObb2;
    FarthestDistance(Triangle2<S>, Triangle2<S>) by FarthestDistanceTriangles;
    Penetration(Obb2<S>, Obb2<S>) by PenetrationObb2;
    Penetration(Circle<S>, Circle<S>) by PenetrationCircles;
    Penetration(Capsule2<S>, Capsule2<S>) by PenetrationCapsules;
    Penetration(Triangle2<S>, Triangle2<S>) by PenetrationTriangles;
    Penetration(Aabb2<S>, Aabb2<S>) by PenetrationAabb2;
    Penetration(Circle<S>, Obb2<S>) by PenetrationCircleObb2;
    Crossing(Line2<S>, Line2<S>) by CrossingOfLines;
    Meeting(Segment2<S>, Segment2<S>) by MeetingOfSegments;
    FirstHit(Ray2<S>, Circle<S>) by FirstHitRayCircle;
    FirstHit(Ray2<S>, Triangle2<S>) by FirstHitRayTriangle;
    FirstHit(Ray2<S>, Capsule2<S>) by FirstHitRayCapsule;
    FirstHit(Ray2<S>, Aabb2<S>) by FirstHitRayAabb2;
    FirstHit(Ray2<S>, Obb2<S>) by FirstHitRayObb2;
    Span(Line2<S>, Circle<S>) by SpanLineCircle;
    Span(Line2<S>, Triangle2<S>) by SpanLineTriangle;
    Span(Line2<S>, Capsule2<S>) by SpanLineCapsule;
    Span(Line2<S>, Aabb2<S>) by SpanLineAabb2;
    Span(Line2<S>, Obb2<S>) by SpanLineObb2;
    LengthInside(Segment2<S>, Circle<S>) by LengthInsideSegmentCircle;
    LengthInside(Segment2<S>, Triangle2<S>) by LengthInsideSegmentTriangle;
    LengthInside(Segment2<S>, Capsule2<S>) by LengthInsideSegmentCapsule;
    LengthInside(Segment2<S>, Aabb2<S>) by LengthInsideSegmentAabb2;
    LengthInside(Segment2<S>, Obb2<S>) by LengthInsideSegmentObb2;
    SignedArea(Triangle2<S>) by SignedAreaTriangle;
    SignedArea([Vec2<S>; 4]) by SignedAreaQuad;
    Area(Triangle2<S>) by AreaTriangle;
    Perimeter(Triangle2<S>) by PerimeterTriangle;
    Perimeter([Vec2<S>; 4]) by PerimeterQuad;
    Centroid(Triangle2<S>) by CentroidTriangle;
    Centroid([Vec2<S>; 4]) by CentroidQuad;
    Corners(Obb2<S>) by CornersOfObb2;
    Circumcircle(Vec2<S>, Vec2<S>, Vec2<S>) by ThroughThree;
    Incircle(Triangle2<S>) by Inscribed;
    Move(Pose2<S>, Segment2<S>) by MoveSegment;
    FlipY(ImageBox<S>, S) by Obb2OfImageBox;
}

/// Joins verbs of convex polygons to the searches that serve them.
macro_rules! polygons {
    ($($Verb:ident of one by $By:ident;)*) => { $(
        impl<S: Scalar<Mask = bool>, const N: usize> Unary<ConvexPolygon<S, N>> for $Verb {
            type Out = <$By<N> as Decided>::Out<S>;
            type By = $By<N>;
            const BY: $By<N> = $By;
            #[inline]
            fn apply(a: ConvexPolygon<S, N>) -> Self::Out {
                <$By<N> as Decided>::replay(a, <$By<N> as Decided>::decide(a))
            }
        }
    )* };
    ($($Verb:ident of two by $By:ident;)*) => { $(
        polygons!(@two [const N: usize] $Verb, N, $By, <N>);
    )* };
    // The hull of both has up to as many corners as both together, which the type must say.
    ($($Verb:ident in hulls by $By:ident;)*) => { $(
        polygons!(@two [] $Verb, 3, $By, <3, 6>);
        polygons!(@two [] $Verb, 4, $By, <4, 8>);
        polygons!(@two [] $Verb, 5, $By, <5, 10>);
        polygons!(@two [] $Verb, 6, $By, <6, 12>);
        polygons!(@two [] $Verb, 7, $By, <7, 14>);
        polygons!(@two [] $Verb, 8, $By, <8, 16>);
    )* };
    (@two [$($constant:tt)*] $Verb:ident, $N:tt, $By:ident, <$($capacity:tt),+>) => {
        impl<S: Scalar<Mask = bool>, $($constant)*> Binary<ConvexPolygon<S, $N>, ConvexPolygon<S, $N>>
            for $Verb
        {
            type Out = <$By<$($capacity),+> as Decided>::Out<S>;
            type By = $By<$($capacity),+>;
            const BY: Self::By = $By;
            #[inline]
            fn apply(a: ConvexPolygon<S, $N>, b: ConvexPolygon<S, $N>) -> Self::Out {
                let found = <$By<$($capacity),+> as Decided>::decide((a, b));
                <$By<$($capacity),+> as Decided>::replay((a, b), found)
            }
        }
    };
}
polygons! {
    Diameter of one by DiameterOfPolygon;
    Width of one by WidthOfPolygon;
    MinimumRectangle of one by RectangleAroundPolygon;
    MinimumCircle of one by CircleAroundPolygon;
}
polygons! {
    IntersectionArea of two by IntersectionAreaPolygons;
    Iou of two by IouPolygons;
    Iof of two by IofPolygons;
    Diou of two by DiouPolygons;
}
polygons! {
    HullArea in hulls by HullAreaPolygons;
    Giou in hulls by GiouPolygons;
}

/// Joins encodings of boxes to the operations that convert them.
macro_rules! conversions {
    ($($From:ident to $To:ident by $By:ident;)*) => { $(
        impl<S: Scalar> Unary<$From<S>> for Convert<$To<S>> {
            type Out = $To<S>;
            type By = $By;
            const BY: $By = $By;
            #[inline]
            fn apply(a: $From<S>) -> $To<S> {
                <$By as Op>::eval(a)
            }
        }
    )* };
}
conversions! {
    ImageBox to Le90 by Le90OfImageBox;
    ImageBox to Le135 by Le135OfImageBox;
    ImageBox to OpenCvBox by OpenCvOfImageBox;
    ImageBox to Detectron2Box by Detectron2OfImageBox;
    Detectron2Box to ImageBox by ImageBoxOfDetectron2;
    Xyxyr to Obb2 by Obb2OfXyxyr;
    Obb2 to Xyxyr by XyxyrOfObb2;
    KittiBox to YawBox3 by YawOfKitti;
    YawBox3 to KittiBox by KittiOfYaw;
    LidarBox to YawBox3 by YawOfLidar;
    NuScenesBox to Obb3 by Obb3OfNuScenes;
    YawBox3 to Obb3 by Obb3OfYaw;
}

/// Joins verbs to the folds that serve paths.
macro_rules! folds {
    ($($Verb:ident $Over:ident $method:ident by $By:ident;)*) => { $(
        impl $Over for $Verb {
            type By = $By;
            const BY: $By = $By;
        }
        impl $Verb {
            /// The operation over the edges of a path, for [`Cpu::fold`](crate::kernels::Cpu::fold).
            #[must_use]
            pub const fn $method(self) -> $By {
                $By
            }
        }
    )* };
}
folds! {
    Distance OverRing over_ring by DistancePointRing;
    Distance OverPolyline over_polyline by DistancePointPolyline;
    SignedDistance OverRing over_ring by SignedDistancePointRing;
    Clearance OverRing over_ring by ClearancePointRing;
    Winding OverRing over_ring by WindingOfRing;
    Length OverPolyline over_polyline by LengthOfPolyline;
    SecondMoments OverRing over_ring by SecondMomentsOfRing;
}
