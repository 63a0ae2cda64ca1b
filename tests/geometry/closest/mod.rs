//! Closest points lie on their shapes and are as far apart as the signed distance says; shifted by the way between
//! them, shapes that overlap only touch.
mod draw;
mod flat;
mod space;

/// The checks of a pair of shapes by a module of distances.
///
/// `size` bounds their coordinates. A shift is asked of pairs whose coordinates are exact alone: of others, roundings
/// decide the way between cores that all but meet.
macro_rules! check {
    ($verbs:ident, $a:expr, $b:expr, $moved:expr, $size:expr, $format:ty) => {{
        let (a, b) = ($a, $b);
        let slack = 64.0 * <$format>::EPSILON * $size as $format;
        let signed = $verbs::signed_distance(a, b);
        let found = $verbs::closest_points(a, b);
        let way = found.on_b - found.on_a;
        let about = || format!("{a:?} {b:?}: {signed}, {found:?}");
        assert!((way.length() - signed.abs()).abs() <= slack, "{}", about());
        let off = [
            $verbs::distance(found.on_a, a),
            $verbs::distance(found.on_b, b),
        ];
        assert!(
            off[0] <= slack && off[1] <= slack,
            "{off:?} off: {}",
            about()
        );
        if let Some(moved) = $moved
            && signed < 0.0
        {
            let rest = $verbs::signed_distance(a, moved(b, -way));
            assert!(rest.abs() <= 4.0 * slack, "{rest} is left: {}", about());
        }
    }};
}
use check;
