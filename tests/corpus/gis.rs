//! Geographic information: distances on the sphere, projections, terrain, areas, interpolation.
//! Angles are radians, lengths kilometres unless said otherwise.
use crate::corpus::function::{Function, row};
use crate::corpus::tools::{array, inverse, literals, step};
use geograd::Scalar;
use std::array::from_fn;

pub(crate) const FUNCTIONS: &[Function] = &[
    row!(haversine, haversine_derivatives, [[-1.2, 1.2], [-3.0, 3.0], [-1.2, 1.2], [-3.0, 3.0]],
        kinks [[0.5, 0.25, 0.5, 0.25]],
        wrong ["degrees for radians": haversine_degrees, "half of the half angle forgotten": haversine_twice]),
    row!(equirectangular_distance, equirectangular_distance_derivatives,
        [[-1.2, 1.2], [-3.0, 3.0], [-1.2, 1.2], [-3.0, 3.0]],
        kinks [[0.5, 0.25, 0.5, 0.25]],
        wrong ["cosine of the mean latitude taken as constant": equirectangular_distance_fixed]),
    row!(initial_bearing, initial_bearing_derivatives,
        [[-1.2, 0.0], [-1.0, 1.0], [0.2, 1.2], [-1.0, 1.0]],
        wrong ["longitudes only": initial_bearing_longitudes]),
    row!(cross_track, cross_track_derivatives, [[100.0, 5000.0], [-1.2, 1.2], [-1.2, 1.2]],
        wrong ["arcsine's own derivative forgotten": cross_track_no_arc]),
    row!(mercator, mercator_derivatives, [[-1.3, 1.3], [-3.0, 3.0], [0.5, 2.0]],
        wrong ["derivative of the spherical cosine": mercator_cosine]),
    row!(geocentric, geocentric_derivatives, [[-1.5, 1.5], [-3.0, 3.0], [0.0, 9.0]],
        wrong ["radius of curvature taken as constant": geocentric_sphere]),
    row!(ring_area, ring_area_derivatives,
        [[-2.0, 0.0], [-2.0, 0.0], [0.0, 2.0], [-2.0, 0.0], [0.0, 2.0], [0.0, 2.0], [-2.0, 0.0], [0.0, 2.0]],
        wrong ["last edge forgotten": ring_area_open]),
    row!(ring_centroid, ring_centroid_derivatives,
        [[-2.0, -0.5], [-2.0, -0.5], [0.5, 2.0], [-2.0, -0.5], [0.5, 2.0], [0.5, 2.0], [-2.0, -0.5], [0.5, 2.0]],
        wrong ["area taken as constant": ring_centroid_fixed_area]),
    row!(terrain_slope, terrain_slope_derivatives,
        [[0.0, 50.0], [0.0, 50.0], [0.0, 50.0], [0.0, 50.0], [10.0, 30.0]],
        kinks [[20.0, 20.0, 30.0, 30.0, 10.0]],
        wrong ["arctangent forgotten": terrain_slope_ratio]),
    row!(terrain_aspect, terrain_aspect_derivatives, [[0.0, 20.0], [30.0, 50.0], [0.0, 50.0], [0.0, 50.0]],
        wrong ["east and north exchanged": terrain_aspect_exchanged]),
    row!(hillshade, hillshade_derivatives, [[-2.0, 2.0], [-2.0, 2.0], [0.2, 1.4], [-3.0, 3.0]],
        wrong ["normal not normalised": hillshade_unnormalised]),
    row!(inverse_distance, inverse_distance_derivatives,
        [[0.0, 1.0], [0.0, 1.0], [-5.0, 5.0], [-5.0, 5.0], [-5.0, 5.0], [1.0, 3.0]],
        wrong ["sum of the weights taken as constant": inverse_distance_fixed_sum]),
    row!(variogram, variogram_derivatives, [[0.0, 3.0], [0.0, 1.0], [0.5, 2.0], [1.0, 2.0]],
        kinks [[1.5, 0.5, 1.0, 1.5]],
        wrong ["sill beyond the range forgotten": variogram_endless]),
];

const EARTH: f64 = 6371.0;

/// The distance of two points on the sphere: latitude and longitude of each.
fn haversine<S: Scalar>([a, b, c, d]: [S; 4]) -> S {
    let half = S::lit(0.5);
    let (s, t) = ((half * (c - a)).sin(), (half * (d - b)).sin());
    let h = s * s + a.cos() * c.cos() * t * t;
    S::lit(2.0 * EARTH) * h.root().atan2((S::one() - h).root())
}
fn haversine_derivatives<S: Scalar>([a, b, c, d]: [S; 4]) -> [S; 4] {
    let half = S::lit(0.5);
    let ((s, sc), (t, tc)) = ((half * (c - a)).sin_cos(), (half * (d - b)).sin_cos());
    let ((sa, ca), (sb, cb)) = (a.sin_cos(), c.sin_cos());
    let h = s * s + ca * cb * t * t;
    let g = S::lit(EARTH) * inverse((h * (S::one() - h)).root());
    let by_longitude = g * ca * cb * t * tc;
    [
        g * (-s * sc - sa * cb * t * t),
        -by_longitude,
        g * (s * sc - ca * sb * t * t),
        by_longitude,
    ]
}
fn haversine_degrees(x: [f64; 4]) -> [f64; 4] {
    haversine_derivatives(x).map(f64::to_radians)
}
fn haversine_twice(x: [f64; 4]) -> [f64; 4] {
    let mut g = haversine_derivatives(x);
    g[1] *= 2.0;
    g[3] *= 2.0;
    g
}

/// The distance of two near points by a plane: latitude and longitude of each.
fn equirectangular_distance<S: Scalar>([a, b, c, d]: [S; 4]) -> S {
    let x = (d - b) * (S::lit(0.5) * (a + c)).cos();
    let y = c - a;
    S::lit(EARTH) * (x * x + y * y).root()
}
fn equirectangular_parts<S: Scalar>([a, b, c, d]: [S; 4], cosine_moves: S) -> [S; 4] {
    let (sin, cos) = (S::lit(0.5) * (a + c)).sin_cos();
    let (x, y) = ((d - b) * cos, c - a);
    let g = S::lit(EARTH) * inverse((x * x + y * y).root());
    let mean = -cosine_moves * S::lit(0.5) * g * x * (d - b) * sin;
    [mean - g * y, -g * x * cos, mean + g * y, g * x * cos]
}
fn equirectangular_distance_derivatives<S: Scalar>(x: [S; 4]) -> [S; 4] {
    equirectangular_parts(x, S::one())
}
fn equirectangular_distance_fixed(x: [f64; 4]) -> [f64; 4] {
    equirectangular_parts(x, 0.0)
}

/// The direction in which a great circle leaves, clockwise from north.
fn initial_bearing<S: Scalar>([a, b, c, d]: [S; 4]) -> S {
    let ((sa, ca), (sc, cc), (sl, cl)) = (a.sin_cos(), c.sin_cos(), (d - b).sin_cos());
    (sl * cc).atan2(ca * sc - sa * cc * cl)
}
fn initial_bearing_derivatives<S: Scalar>([a, b, c, d]: [S; 4]) -> [S; 4] {
    let ((sa, ca), (sc, cc), (sl, cl)) = (a.sin_cos(), c.sin_cos(), (d - b).sin_cos());
    let (y, x) = (sl * cc, ca * sc - sa * cc * cl);
    let r = S::one() / (x * x + y * y);
    let (by_y, by_x) = (x * r, -y * r);
    let by_longitude = by_y * cl * cc + by_x * sa * cc * sl;
    [
        by_x * (-sa * sc - ca * cc * cl),
        -by_longitude,
        -by_y * sl * sc + by_x * (ca * cc + sa * sc * cl),
        by_longitude,
    ]
}
fn initial_bearing_longitudes(x: [f64; 4]) -> [f64; 4] {
    let g = initial_bearing_derivatives(x);
    [0.0, g[1], 0.0, g[3]]
}

/// How far a point lies beside a path: its distance from the start, two bearings.
fn cross_track<S: Scalar>([distance, bearing, path]: [S; 3]) -> S {
    let s = (distance / S::lit(EARTH)).sin() * (bearing - path).sin();
    S::lit(EARTH) * s.atan2((S::one() - s * s).root())
}
fn cross_track_derivatives<S: Scalar>([distance, bearing, path]: [S; 3]) -> [S; 3] {
    let ((sd, cd), (sb, cb)) = (
        (distance / S::lit(EARTH)).sin_cos(),
        (bearing - path).sin_cos(),
    );
    let s = sd * sb;
    let g = S::one() / (S::one() - s * s).root();
    let by_bearing = S::lit(EARTH) * g * sd * cb;
    [g * cd * sb, by_bearing, -by_bearing]
}
fn cross_track_no_arc([distance, bearing, path]: [f64; 3]) -> [f64; 3] {
    let ((sd, cd), (sb, cb)) = ((distance / EARTH).sin_cos(), (bearing - path).sin_cos());
    [cd * sb, EARTH * sd * cb, -EARTH * sd * cb]
}

/// Northing and easting of a Mercator map, weighted: latitude, longitude, scale.
fn mercator<S: Scalar>([lat, lon, scale]: [S; 3]) -> S {
    let half = S::lit(0.5) * lat + S::lit(std::f64::consts::FRAC_PI_4);
    scale * (half.tan().ln() + S::lit(0.25) * lon)
}
fn mercator_derivatives<S: Scalar>([lat, lon, scale]: [S; 3]) -> [S; 3] {
    let half = S::lit(0.5) * lat + S::lit(std::f64::consts::FRAC_PI_4);
    let quarter = S::lit(0.25);
    [
        scale / lat.cos(),
        scale * quarter,
        half.tan().ln() + quarter * lon,
    ]
}
fn mercator_cosine(x: [f64; 3]) -> [f64; 3] {
    let g = mercator_derivatives(x);
    [x[2] * x[0].cos(), g[1], g[2]]
}

const AXIS: f64 = 6378.137;
const ECCENTRICITY_SQUARED: f64 = 0.006_694_379_990_14;
const WATCHED: [f64; 3] = [0.6, -0.3, 0.7];

/// A place on the ellipsoid in coordinates of its centre, weighted: latitude, longitude, height.
fn geocentric<S: Scalar>([lat, lon, height]: [S; 3]) -> S {
    let ((sp, cp), (sl, cl), [u, v, w]) = (lat.sin_cos(), lon.sin_cos(), literals::<S, _>(WATCHED));
    let e = S::lit(ECCENTRICITY_SQUARED);
    let n = S::lit(AXIS) / (S::one() - e * sp * sp).root();
    (n + height) * cp * (u * cl + v * sl) + (n * (S::one() - e) + height) * sp * w
}
fn geocentric_parts<S: Scalar>([lat, lon, height]: [S; 3], radius_moves: S) -> [S; 3] {
    let ((sp, cp), (sl, cl), [u, v, w]) = (lat.sin_cos(), lon.sin_cos(), literals::<S, _>(WATCHED));
    let (e, one) = (S::lit(ECCENTRICITY_SQUARED), S::one());
    let square = one - e * sp * sp;
    let n = S::lit(AXIS) / square.root();
    let by_lat = radius_moves * n * e * sp * cp / square;
    let across = u * cl + v * sl;
    [
        by_lat * cp * across - (n + height) * sp * across
            + by_lat * (one - e) * sp * w
            + (n * (one - e) + height) * cp * w,
        (n + height) * cp * (v * cl - u * sl),
        cp * across + sp * w,
    ]
}
fn geocentric_derivatives<S: Scalar>(x: [S; 3]) -> [S; 3] {
    geocentric_parts(x, S::one())
}
fn geocentric_sphere(x: [f64; 3]) -> [f64; 3] {
    geocentric_parts(x, 0.0)
}

/// The signed area of a ring of four points, without unit.
fn ring_area<S: Scalar>(p: [S; 8]) -> S {
    let mut sum = S::zero();
    for i in 0..4 {
        let j = (i + 1) % 4;
        sum += p[2 * i] * p[2 * j + 1] - p[2 * j] * p[2 * i + 1];
    }
    sum * S::lit(0.5)
}
fn ring_area_derivatives<S: Scalar>(p: [S; 8]) -> [S; 8] {
    from_fn(|k| {
        let (next, last) = ((k / 2 + 1) % 4, (k / 2 + 3) % 4);
        let across = if k % 2 == 0 {
            p[2 * next + 1] - p[2 * last + 1]
        } else {
            p[2 * last] - p[2 * next]
        };
        across * S::lit(0.5)
    })
}
fn ring_area_open(p: [f64; 8]) -> [f64; 8] {
    let mut g = ring_area_derivatives(p);
    // The part that the edge from the last point to the first adds to each of them.
    g[0] += 0.5 * p[7];
    g[1] -= 0.5 * p[6];
    g[6] -= 0.5 * p[1];
    g[7] += 0.5 * p[0];
    g
}

/// The centroid of a ring of four points: both coordinates, weighted.
fn ring_centroid<S: Scalar>(p: [S; 8]) -> S {
    let (mut sum, mut twice) = (S::zero(), S::zero());
    for i in 0..4 {
        let j = (i + 1) % 4;
        let cross = p[2 * i] * p[2 * j + 1] - p[2 * j] * p[2 * i + 1];
        let mean = (p[2 * i] + p[2 * j]) - S::lit(0.5) * (p[2 * i + 1] + p[2 * j + 1]);
        sum += cross * mean;
        twice += cross;
    }
    sum / (S::lit(3.0) * twice)
}
fn ring_centroid_parts<S: Scalar>(p: [S; 8], area_moves: S) -> [S; 8] {
    let (mut by_sum, mut by_twice) = ([S::zero(); 8], [S::zero(); 8]);
    let (mut sum, mut twice) = (S::zero(), S::zero());
    let half = S::lit(0.5);
    for i in 0..4 {
        let j = (i + 1) % 4;
        let [x, y, u, v] = [p[2 * i], p[2 * i + 1], p[2 * j], p[2 * j + 1]];
        let (cross, mean) = (x * v - u * y, (x + u) - half * (y + v));
        sum += cross * mean;
        twice += cross;
        for (k, by_cross, by_mean) in [
            (2 * i, v, S::one()),
            (2 * i + 1, -u, -half),
            (2 * j, -y, S::one()),
            (2 * j + 1, x, -half),
        ] {
            by_sum[k] += by_cross * mean + cross * by_mean;
            by_twice[k] += by_cross;
        }
    }
    let share = area_moves * sum / twice;
    from_fn(|k| (by_sum[k] - share * by_twice[k]) / (S::lit(3.0) * twice))
}
fn ring_centroid_derivatives<S: Scalar>(p: [S; 8]) -> [S; 8] {
    ring_centroid_parts(p, S::one())
}
fn ring_centroid_fixed_area(p: [f64; 8]) -> [f64; 8] {
    ring_centroid_parts(p, 0.0)
}

/// The steepness of a cell of a grid from its four neighbours: north, south, east, west; its size.
fn terrain_slope<S: Scalar>([north, south, east, west, cell]: [S; 5]) -> S {
    let twice = cell + cell;
    let (x, y) = ((east - west) / twice, (north - south) / twice);
    (x * x + y * y).root().atan2(S::one())
}
fn terrain_slope_derivatives<S: Scalar>([north, south, east, west, cell]: [S; 5]) -> [S; 5] {
    let twice = cell + cell;
    let (x, y) = ((east - west) / twice, (north - south) / twice);
    let square = x * x + y * y;
    let steep = square.root();
    let g = inverse(steep) / (S::one() + square);
    let (by_x, by_y) = (g * x / twice, g * y / twice);
    [
        by_y,
        -by_y,
        by_x,
        -by_x,
        -steep / (S::one() + square) / cell,
    ]
}
fn terrain_slope_ratio(p: [f64; 5]) -> [f64; 5] {
    let (x, y) = ((p[2] - p[3]) / (2.0 * p[4]), (p[0] - p[1]) / (2.0 * p[4]));
    terrain_slope_derivatives(p).map(|g| g * (1.0 + x * x + y * y))
}

/// The direction in which a cell of a grid falls, from its four neighbours.
fn terrain_aspect<S: Scalar>([north, south, east, west]: [S; 4]) -> S {
    (west - east).atan2(south - north)
}
fn terrain_aspect_derivatives<S: Scalar>([north, south, east, west]: [S; 4]) -> [S; 4] {
    let (y, x) = (west - east, south - north);
    let r = S::one() / (x * x + y * y);
    [y * r, -y * r, -x * r, x * r]
}
fn terrain_aspect_exchanged(p: [f64; 4]) -> [f64; 4] {
    let g = terrain_aspect_derivatives(p);
    [g[2], g[3], g[0], g[1]]
}

/// How bright the sun makes a derivative: steepness eastwards and northwards, zenith angle, azimuth.
fn hillshade<S: Scalar>([x, y, zenith, azimuth]: [S; 4]) -> S {
    let ((sz, cz), (sa, ca)) = (zenith.sin_cos(), azimuth.sin_cos());
    let lit = (cz - sz * (x * sa + y * ca)) / (S::one() + x * x + y * y).root();
    lit.most(S::zero())
}
fn hillshade_parts<S: Scalar>([x, y, zenith, azimuth]: [S; 4], norm_moves: S) -> [S; 4] {
    let ((sz, cz), (sa, ca)) = (zenith.sin_cos(), azimuth.sin_cos());
    let (along, square) = (x * sa + y * ca, S::one() + x * x + y * y);
    let light = cz - sz * along;
    let g = step(light) / square.root();
    let share = norm_moves * light / square;
    [
        -g * (sz * sa + share * x),
        -g * (sz * ca + share * y),
        -g * (sz + cz * along),
        -g * sz * (x * ca - y * sa),
    ]
}
fn hillshade_derivatives<S: Scalar>(x: [S; 4]) -> [S; 4] {
    hillshade_parts(x, S::one())
}
fn hillshade_unnormalised(x: [f64; 4]) -> [f64; 4] {
    hillshade_parts(x, 0.0)
}

const STATIONS: [[f64; 2]; 3] = [[-0.5, -0.5], [1.5, -0.25], [0.5, 2.0]];

/// The interpolated measurements of three stations: the place, the measurements, the power of the distance.
fn inverse_distance<S: Scalar>([x, y, a, b, c, power]: [S; 6]) -> S {
    let (mut sum, mut all) = (S::zero(), S::zero());
    for ([u, v], value) in STATIONS.map(literals::<S, _>).into_iter().zip([a, b, c]) {
        let (dx, dy) = (x - u, y - v);
        let weight = (-S::lit(0.5) * power * (dx * dx + dy * dy).ln()).exp();
        sum += weight * value;
        all += weight;
    }
    sum / all
}
fn inverse_distance_parts<S: Scalar>([x, y, a, b, c, power]: [S; 6], sum_moves: S) -> [S; 6] {
    let value = inverse_distance([x, y, a, b, c, power]) * sum_moves;
    let (mut g, mut all) = ([S::zero(); 6], S::zero());
    for (i, ([u, v], z)) in STATIONS
        .map(literals::<S, _>)
        .into_iter()
        .zip([a, b, c])
        .enumerate()
    {
        let (dx, dy) = (x - u, y - v);
        let square = dx * dx + dy * dy;
        let weight = (-S::lit(0.5) * power * square.ln()).exp();
        let share = weight * (z - value);
        g[0] -= share * power * dx / square;
        g[1] -= share * power * dy / square;
        g[2 + i] = weight;
        g[5] -= share * S::lit(0.5) * square.ln();
        all += weight;
    }
    g.map(|g| g / all)
}
fn inverse_distance_derivatives<S: Scalar>(x: [S; 6]) -> [S; 6] {
    inverse_distance_parts(x, S::one())
}
fn inverse_distance_fixed_sum(x: [f64; 6]) -> [f64; 6] {
    inverse_distance_parts(x, 0.0)
}

/// A spherical variogram: distance, nugget, sill, range.
fn variogram<S: Scalar>([h, nugget, sill, range]: [S; 4]) -> S {
    let t = (h / range).least(S::one());
    nugget + sill * t * (S::lit(1.5) - S::lit(0.5) * t * t)
}
fn variogram_derivatives<S: Scalar>([h, _, sill, range]: [S; 4]) -> [S; 4] {
    let t = (h / range).least(S::one());
    let g = S::lit(1.5) * sill * (S::one() - t * t) / range;
    [g, S::one(), t * (S::lit(1.5) - S::lit(0.5) * t * t), -g * t]
}
fn variogram_endless([h, _, sill, range]: [f64; 4]) -> [f64; 4] {
    let t = h / range;
    let g = 1.5 * sill * (1.0 - t * t) / range;
    [g, 1.0, t * (1.5 - 0.5 * t * t), -g * t]
}
