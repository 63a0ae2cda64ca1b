//! One formula behind one name: methods, free functions and batches of a verb give the same bits.
use crate::straight::{Items, bits, inputs};
use geograd::Pack;
use geograd::ad::check::sample::Sample;
use geograd::distance::Convex;
use geograd::error::Validate;
use geograd::kernels::op::Op;
use geograd::kernels::{Cpu, Item};
use geograd::measure::moments::second_moments;
use geograd::{
    ConvexPolygon, Scalar, Triangle2, Vec2, distance, distance3, gaussian, intersection, iou, iou3,
    overlap, overlap3, ring,
};
use geograd_tests::Dice;
use geograd_tests::calls::Number;
use std::fmt::Debug;

/// Asserts equal bits of a batch, item by item, and of everything else with the name of its operation.
fn same<O: Op, T: Number>(spellings: &[&dyn Fn(O::In<T>) -> O::Out<T>])
where
    O::In<f64>: Sample,
    O::In<T>: Item<Scalar = T, Many: Items> + Validate + Debug,
    O::Out<T>: Item<Scalar = T, Many: Items>,
{
    let mut all = inputs::<O, T>(600);
    let is_inside = |x: &O::In<T>| {
        let numbers: Vec<f64> = x.scalars().iter().map(|x| x.widen()).collect();
        O::DECLARED.domain.is_none_or(|inside| inside(&numbers))
    };
    all.retain(|x| x.validate().is_ok() && is_inside(x));
    let least = if O::DECLARED.domain.is_some() {
        50
    } else {
        500
    };
    assert!(all.len() > least, "{}: {}", O::DECLARED.name, all.len());
    let batch = Cpu::new().aligned(O::default(), &all[..]).unwrap();
    for (i, &x) in all.iter().enumerate() {
        assert_eq!(
            batch.item(i),
            bits(&O::eval(x)),
            "{}: {x:?}",
            O::DECLARED.name
        );
        for (k, spelling) in spellings.iter().enumerate() {
            let found = bits(&spelling(x));
            assert_eq!(
                batch.item(i),
                found,
                "{}, spelling {k}: {x:?}",
                O::DECLARED.name
            );
        }
    }
}

/// Tests of operations and, after each, of what takes the same and bears the same name.
macro_rules! spellings {
    ($($test:ident { $($Op:ident |$input:pat_param| $($spelling:expr),+;)+ })+) => { $(
        #[test]
        fn $test() {
            $(
                same::<geograd_tests::rows::$Op, f64>(&[$(&|$input| $spelling),+]);
                same::<geograd_tests::rows::$Op, f32>(&[$(&|$input| $spelling),+]);
            )+
        }
    )+ };
}

spellings! {
    overlap_in_the_plane {
        IntersectionAreaObb2 |(a, b)| overlap::intersection_area_obb2(a, b), a.intersection_area(b);
        IouObb2 |(a, b)| overlap::iou_obb2(a, b), a.iou(b);
        IofObb2 |(a, b)| overlap::iof_obb2(a, b), a.iof(b);
        IntersectionAreaAabb2 |(a, b)| overlap::intersection_area_aabb2(a, b), a.intersection_area(b);
        IouAabb2 |(a, b)| overlap::iou_aabb2(a, b), a.iou(b);
        IofAabb2 |(a, b)| overlap::iof_aabb2(a, b), a.iof(b);
        IntersectionAreaQuads |(a, b)| geograd::overlap_polygon::intersection_area_quads(a, b);
        HullAreaObb2 |(a, b)| iou::hull_area_obb2(a, b);
        HullAreaAabb2 |(a, b)| iou::hull_area_aabb2(a, b);
    }
    overlap_in_space {
        IntersectionVolumeAabb3 |(a, b)| overlap3::intersection_volume_aabb3(a, b), a.intersection_volume(b);
        IouAabb3 |(a, b)| overlap3::iou_aabb3(a, b), a.iou(b);
        IofAabb3 |(a, b)| overlap3::iof_aabb3(a, b), a.iof(b);
        IntersectionVolumeYaw |(a, b)| overlap3::intersection_volume_yaw(a, b), a.intersection_volume(b);
        IouYaw |(a, b)| overlap3::iou_yaw(a, b), a.iou(b);
        IofYaw |(a, b)| overlap3::iof_yaw(a, b), a.iof(b);
        IouBirdsEye |(a, b)| overlap3::iou_birds_eye(a, b), a.birds_eye().iou(b.birds_eye());
        IntersectionVolumeObb3 |(a, b)| overlap3::intersection_volume_obb3(a, b), a.intersection_volume(b);
        IouObb3 |(a, b)| overlap3::iou_obb3(a, b), a.iou(b);
        IofObb3 |(a, b)| overlap3::iof_obb3(a, b), a.iof(b);
        IouAabb3Yaw |(a, b)| a.iou(b);
        IouAabb3Obb3 |(a, b)| a.iou(b);
        IouYawObb3 |(a, b)| a.iou(b);
    }
    scores {
        GiouObb2 |(a, b)| iou::giou_obb2(a, b), a.giou(b);
        GiouAabb2 |(a, b)| iou::giou_aabb2(a, b), a.giou(b);
        DiouObb2 |(a, b)| iou::diou_obb2(a, b);
        DiouAabb2 |(a, b)| iou::diou_aabb2(a, b);
        CiouObb2 |(a, b)| iou::ciou_obb2(a, b);
        CiouAabb2 |(a, b)| iou::ciou_aabb2(a, b);
        EiouObb2 |(a, b)| iou::eiou_obb2(a, b);
        EiouAabb2 |(a, b)| iou::eiou_aabb2(a, b);
        SeparationAwareObb2 |(a, b)| iou::separation_aware_obb2(a, b);
        SeparationAwareAabb3 |(a, b)| iou3::separation_aware(a, b);
        SeparationAwareYaw |(a, b)| iou3::separation_aware(a, b);
        SeparationAwareObb3 |(a, b)| iou3::separation_aware(a, b);
        AlphaIouObb2 |(a, b, power)| iou::alpha_iou_obb2(a, b, power.alpha);
        AlphaIouAabb2 |(a, b, power)| iou::alpha_iou_aabb2(a, b, power.alpha);
    }
    gaussians {
        WassersteinObb2 |(a, b)| gaussian::wasserstein(a, b);
        WassersteinSquaredObb2 |(a, b)| gaussian::wasserstein_squared(a, b);
        KullbackLeiblerObb2 |(a, b)| gaussian::kullback_leibler(a, b);
        JeffreysObb2 |(a, b)| gaussian::jeffreys(a, b);
        BhattacharyyaObb2 |(a, b)| gaussian::bhattacharyya(a, b);
        ProbiouObb2 |(a, b)| gaussian::probiou(a, b);
        KfiouObb2 |(a, b)| gaussian::kfiou(a, b);
        WassersteinObb3 |(a, b)| gaussian::solid::wasserstein(a, b);
        WassersteinSquaredObb3 |(a, b)| gaussian::solid::wasserstein_squared(a, b);
        KullbackLeiblerObb3 |(a, b)| gaussian::solid::kullback_leibler(a, b);
        JeffreysObb3 |(a, b)| gaussian::solid::jeffreys(a, b);
        BhattacharyyaObb3 |(a, b)| gaussian::solid::bhattacharyya(a, b);
        ProbiouObb3 |(a, b)| gaussian::solid::probiou(a, b);
        KfiouObb3 |(a, b)| gaussian::solid::kfiou(a, b);
    }
    distances_of_boxes {
        DistanceAabb2 |(a, b)| distance::distance(a, b), a.distance(b), distance::upright::distance_aabb2(a, b);
        SignedDistanceAabb2 |(a, b)| distance::signed_distance(a, b), a.signed_distance(b),
            (-distance::depth(a, b)).canonical(), distance::upright::signed_distance_aabb2(a, b);
        SquaredDistanceAabb2 |(a, b)| distance::squared_distance(a, b), a.squared_distance(b),
            distance::upright::squared_distance_aabb2(a, b);
        FarthestDistanceAabb2 |(a, b)| distance::farthest_distance(a, b), a.farthest_distance(b),
            distance::upright::farthest_distance_aabb2(a, b);
        ClosestPointsAabb2 |(a, b)| distance::closest_points(a, b), a.closest_points(b),
            distance::upright::closest_points_aabb2(a, b);
        PenetrationAabb2 |(a, b)| distance::penetration(a, b), a.penetration(b),
            distance::upright::penetration_aabb2(a, b);
        DistanceObb2 |(a, b)| distance::distance(a, b), a.distance(b), distance::turned::distance_obb2(a, b);
        SignedDistanceObb2 |(a, b)| distance::signed_distance(a, b), a.signed_distance(b),
            (-distance::depth(a, b)).canonical(), distance::turned::signed_distance_obb2(a, b);
        SquaredDistanceObb2 |(a, b)| distance::squared_distance(a, b), a.squared_distance(b),
            distance::turned::squared_distance_obb2(a, b);
        FarthestDistanceObb2 |(a, b)| distance::farthest_distance(a, b), a.farthest_distance(b),
            distance::turned::farthest_distance_obb2(a, b);
        ClosestPointsObb2 |(a, b)| distance::closest_points(a, b), a.closest_points(b),
            distance::turned::closest_points_obb2(a, b);
        PenetrationObb2 |(a, b)| distance::penetration(a, b), a.penetration(b),
            distance::turned::penetration_obb2(a, b);
    }
    distances {
        DistancePointSegment |(a, b)| distance::distance(a, b), Convex::distance(a, b);
        DistanceSegments |(a, b)| distance::distance(a, b), Convex::distance(a, b);
        DistancePointCircle |(a, b)| distance::distance(a, b), Convex::distance(a, b);
        DistancePointTriangle |(a, b)| distance::distance(a, b), Convex::distance(a, b);
        DistancePointCapsule |(a, b)| distance::distance(a, b), Convex::distance(a, b);
        DistancePointAabb2 |(a, b)| distance::distance(a, b), Convex::distance(a, b);
        DistancePointObb2 |(a, b)| distance::distance(a, b), Convex::distance(a, b);
        DistanceSegmentCircle |(a, b)| distance::distance(a, b), Convex::distance(a, b);
        DistanceSegmentObb2 |(a, b)| distance::distance(a, b), Convex::distance(a, b);
        DistanceCircles |(a, b)| distance::distance(a, b), Convex::distance(a, b);
        DistanceCircleObb2 |(a, b)| distance::distance(a, b), Convex::distance(a, b);
        DistanceCapsules |(a, b)| distance::distance(a, b), Convex::distance(a, b);
        DistanceTriangles |(a, b)| distance::distance(a, b), Convex::distance(a, b);
        SquaredDistancePointSegment |(a, b)| distance::squared_distance(a, b), Convex::squared_distance(a, b);
        SquaredDistancePointTriangle |(a, b)| distance::squared_distance(a, b), Convex::squared_distance(a, b);
        SquaredDistanceSegments |(a, b)| distance::squared_distance(a, b), Convex::squared_distance(a, b);
        SquaredDistanceTriangles |(a, b)| distance::squared_distance(a, b), Convex::squared_distance(a, b);
        FarthestDistancePointObb2 |(a, b)| distance::farthest_distance(a, b), Convex::farthest_distance(a, b);
        FarthestDistanceCircleObb2 |(a, b)| distance::farthest_distance(a, b), Convex::farthest_distance(a, b);
        FarthestDistanceTriangles |(a, b)| distance::farthest_distance(a, b), Convex::farthest_distance(a, b);
    }
    signed_distances {
        SignedDistancePointObb2 |(a, b)| distance::signed_distance(a, b), Convex::signed_distance(a, b);
        SignedDistancePointCircle |(a, b)| distance::signed_distance(a, b), Convex::signed_distance(a, b);
        SignedDistancePointTriangle |(a, b)| distance::signed_distance(a, b), Convex::signed_distance(a, b);
        SignedDistancePointCapsule |(a, b)| distance::signed_distance(a, b), Convex::signed_distance(a, b);
        SignedDistancePointAabb2 |(a, b)| distance::signed_distance(a, b), Convex::signed_distance(a, b);
        SignedDistanceSegmentCircle |(a, b)| distance::signed_distance(a, b), Convex::signed_distance(a, b);
        SignedDistanceSegmentObb2 |(a, b)| distance::signed_distance(a, b), Convex::signed_distance(a, b);
        SignedDistanceCircles |(a, b)| distance::signed_distance(a, b), Convex::signed_distance(a, b);
        SignedDistanceCircleObb2 |(a, b)| distance::signed_distance(a, b), Convex::signed_distance(a, b);
        SignedDistanceCapsules |(a, b)| distance::signed_distance(a, b), Convex::signed_distance(a, b);
        SignedDistanceTriangles |(a, b)| distance::signed_distance(a, b), Convex::signed_distance(a, b);
        DepthPointAabb2 |(a, b)| distance::depth(a, b), (-distance::signed_distance(a, b)).canonical();
        DepthPointObb2 |(a, b)| distance::depth(a, b), (-distance::signed_distance(a, b)).canonical();
    }
    points_and_depths {
        PenetrationCircles |(a, b)| distance::penetration(a, b), Convex::penetration(a, b);
        PenetrationCapsules |(a, b)| distance::penetration(a, b), Convex::penetration(a, b);
        PenetrationTriangles |(a, b)| distance::penetration(a, b), Convex::penetration(a, b);
        PenetrationCircleObb2 |(a, b)| distance::penetration(a, b), Convex::penetration(a, b);
        ClosestPointsCircleObb2 |(a, b)| distance::closest_points(a, b), Convex::closest_points(a, b);
        ClosestPointsPointSegment |(a, b)| distance::closest_points(a, b), Convex::closest_points(a, b);
        ClosestPointsPointTriangle |(a, b)| distance::closest_points(a, b), Convex::closest_points(a, b);
        ClosestPointsPointObb2 |(a, b)| distance::closest_points(a, b), Convex::closest_points(a, b);
        ClosestPointsCapsules |(a, b)| distance::closest_points(a, b), Convex::closest_points(a, b);
        ClosestPointsTriangles |(a, b)| distance::closest_points(a, b), Convex::closest_points(a, b);
        ClosestPointsOfSegments |(a, b)| distance::segments::closest_points_of_segments(a, b);
    }
    distances_in_space {
        SignedDistancePointAabb3 |(p, shape)| distance3::signed_distance(p, shape);
        DistancePointAabb3 |(p, shape)| distance3::distance(p, shape);
        SignedDistancePointYaw |(p, shape)| distance3::signed_distance(p, shape);
        DistancePointYaw |(p, shape)| distance3::distance(p, shape);
        SignedDistancePointObb3 |(p, shape)| distance3::signed_distance(p, shape);
        DistancePointObb3 |(p, shape)| distance3::distance(p, shape);
    }
    lines {
        CrossingOfLines |(a, b)| intersection::crossing_of_lines(a, b);
        MeetingOfSegments |(a, b)| intersection::meeting_of_segments(a, b);
        FirstHitRayCircle |(ray, shape)| intersection::first_hit(ray, shape);
        SpanLineCircle |(line, shape)| intersection::span(line, shape);
        LengthInsideSegmentCircle |(segment, shape)| intersection::length_inside(segment, shape);
        FirstHitRayTriangle |(ray, shape)| intersection::first_hit(ray, shape);
        SpanLineTriangle |(line, shape)| intersection::span(line, shape);
        LengthInsideSegmentTriangle |(segment, shape)| intersection::length_inside(segment, shape);
        FirstHitRayCapsule |(ray, shape)| intersection::first_hit(ray, shape);
        SpanLineCapsule |(line, shape)| intersection::span(line, shape);
        LengthInsideSegmentCapsule |(segment, shape)| intersection::length_inside(segment, shape);
        FirstHitRayAabb2 |(ray, shape)| intersection::first_hit(ray, shape);
        SpanLineAabb2 |(line, shape)| intersection::span(line, shape);
        LengthInsideSegmentAabb2 |(segment, shape)| intersection::length_inside(segment, shape);
        FirstHitRayObb2 |(ray, shape)| intersection::first_hit(ray, shape);
        SpanLineObb2 |(line, shape)| intersection::span(line, shape);
        LengthInsideSegmentObb2 |(segment, shape)| intersection::length_inside(segment, shape);
    }
    measures_of_few_vertices {
        SignedAreaTriangle |shape| shape.signed_area();
        AreaTriangle |shape| shape.area();
        PerimeterTriangle |shape| shape.perimeter();
        CentroidTriangle |shape| shape.centroid();
        SignedAreaQuad |ring| ring::signed_area(&ring);
        PerimeterQuad |ring| ring::perimeter(&ring);
        CentroidQuad |ring| ring::centroid(&ring);
        Circumcircle |(a, b, c)| geograd::shape::circumcircle(a, b, c), Triangle2::new(a, b, c).circumcircle();
        Incircle |shape| shape.incircle();
        MoveSegment |(pose, segment)| pose.normalized() * segment;
        CornersOfObb2 |shape| shape.corners();
    }
    intervals {
        IouIntervals |(a, b)| a.iou(b);
        IntersectionLengthIntervals |(a, b)| a.intersection_length(b);
        DistanceIntervals |(a, b)| a.distance(b);
        SignedDistanceIntervals |(a, b)| a.signed_distance(b);
        DistanceNumberInterval |(x, interval)| interval.distance_to(x);
    }
}

/// Rings of a few vertices, every third in a raster where vertices and edges lie on each other, and a point for each.
fn rings<T: Number>() -> (Vec<Vec2<T>>, Vec<Vec2<T>>, Vec<usize>) {
    let mut dice = Dice(77);
    let (mut points, mut vertices, mut offsets) = (Vec::new(), Vec::new(), vec![0]);
    for round in 0..600 {
        let mut at = || {
            let x = [(); 2].map(|()| dice.within(-3.0, 3.0));
            let [x, y] = if round % 3 == 0 { x.map(f64::round) } else { x };
            Vec2::new(T::lit(x), T::lit(y))
        };
        points.push(at());
        vertices.extend((0..3 + round % 7).map(|_| at()));
        offsets.push(vertices.len());
    }
    (points, vertices, offsets)
}

fn folds_and_rings_are_the_same<T: Number>() {
    use geograd::distance::ring as to;
    use geograd::kernels::{Centroid, One, Perimeter, SignedArea, fold::fold};
    use geograd_tests::rows::ring as ring_rows;
    use geograd_tests::rows::{
        DistancePointPolyline, DistancePointRing, SecondMomentsOfRing, SignedDistancePointRing,
        WindingOfRing,
    };
    let (points, vertices, offsets) = rings::<T>();
    let cpu = Cpu::new();
    macro_rules! fold {
        ($op:expr, $context:expr) => {
            cpu.fold($op, $context, &vertices, &offsets).unwrap()
        };
    }
    let distances = fold!(DistancePointRing, &points);
    let signed = fold!(SignedDistancePointRing, &points);
    let windings = fold!(WindingOfRing, &points);
    let to_paths = fold!(DistancePointPolyline, &points);
    let moments = fold!(SecondMomentsOfRing, One([]));
    let areas = cpu
        .ragged(SignedArea.over_ring(), &vertices, &offsets)
        .unwrap();
    let perimeters = cpu
        .ragged(Perimeter.over_ring(), &vertices, &offsets)
        .unwrap();
    let centroids = cpu
        .ragged(Centroid.over_ring(), &vertices, &offsets)
        .unwrap();
    for (i, at) in offsets.windows(2).enumerate() {
        let (point, path) = (points[i], &vertices[at[0]..at[1]]);
        let mut polygon = ConvexPolygon::<T, 9> {
            vertices: [Vec2::zero(); 9],
            count: path.len(),
        };
        polygon.vertices[..path.len()].copy_from_slice(path);
        macro_rules! equal {
            ($batch:expr, $($spelling:expr),+) => { $(
                assert_eq!(bits(&$batch[i]), bits(&$spelling), "{} {point:?} {path:?}", stringify!($spelling));
            )+ };
        }
        equal!(distances, to::distance_to_ring(point, path));
        equal!(signed, to::signed_distance_to_ring(point, path));
        equal!(windings, to::winding_of_ring(point, path).canonical());
        equal!(to_paths, to::distance_to_polyline(point, path));
        let both = &[path][..];
        equal!(moments, second_moments(both), polygon.second_moments());
        equal!(
            areas,
            ring::signed_area(path),
            fold::<ring_rows::SignedArea, T>([], path),
            polygon.area()
        );
        equal!(perimeters, ring::perimeter(path), polygon.perimeter());
        equal!(centroids, ring::centroid(path), polygon.centroid());
    }
}

#[test]
fn folds_and_measures_of_rings() {
    folds_and_rings_are_the_same::<f64>();
    folds_and_rings_are_the_same::<f32>();
}

/// Operations with a search: what decides and replays is the function.
#[test]
fn searches() {
    use geograd::kernels::{Diou, Giou, HullArea};
    use geograd::kernels::{IntersectionArea, Iof, Iou};
    use geograd::overlap_polygon::{intersection_area_polygons, iof_polygons, iou_polygons};
    let mut dice = Dice(78);
    let mut polygons = || -> Vec<ConvexPolygon<f64, 5>> {
        let mut one = || {
            let points =
                [(); 5].map(|()| Vec2::new(dice.within(-2.0, 2.0), dice.within(-2.0, 2.0)));
            geograd::hull::hull(&points).unwrap()
        };
        (0..200).map(|_| one()).collect()
    };
    let (a, b) = (polygons(), polygons());
    let cpu = Cpu::new();
    macro_rules! same {
        ($op:expr, $($spelling:expr),+) => {{
            let batch = cpu.aligned($op, (&a, &b)).unwrap();
            for (k, (a, b)) in a.iter().zip(&b).enumerate() {
                $(
                    let spelling: fn(&ConvexPolygon<f64, 5>, &ConvexPolygon<f64, 5>) -> f64 = $spelling;
                    assert_eq!(batch[k].to_bits(), spelling(a, b).to_bits(), "{}", stringify!($spelling));
                )+
            }
        }};
    }
    same!(IntersectionArea, intersection_area_polygons, |a, b| a
        .intersection_area(b));
    same!(Iou, iou_polygons, |a, b| a.iou(b));
    same!(Iof, iof_polygons, |a, b| a.iof(b));
    same!(Giou, |a, b| iou::giou_polygons_search::<_, 5, 5, 10>(a, b)
        .unwrap()
        .0);
    same!(Diou, |a, b| iou::diou_polygons_search(a, b).0);
    same!(HullArea, |a, b| geograd::hull::merge::<_, 5, 5, 10>(a, b)
        .unwrap()
        .area());
}
