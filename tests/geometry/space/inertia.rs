//! Inertia against quadrature of its definition: no formula is shared.
use geograd::measure::inertia::displaced;
use geograd::{
    Aabb3, Capsule3, Cone, Cylinder, Obb3, Pack, Pose3, Rotation3, RoundBox3, Sphere, Symmetric3,
    Tetrahedron, Vec3, YawBox3,
};
use geograd_tests::Dice;

fn point(dice: &mut Dice) -> Vec3<f64> {
    let [x, y, z] = [0; 3].map(|_| dice.within(-2.0, 2.0));
    Vec3::new(x, y, z)
}

fn rotation(dice: &mut Dice) -> Rotation3<f64> {
    let [w, x, y, z] = [0; 4].map(|_| dice.within(-1.0, 1.0));
    Rotation3::new(w, x, y, z)
}

/// `∫ (d² 1 − d dᵀ)` over weighted points.
fn tensor(points: &[([f64; 3], f64)]) -> [f64; 6] {
    let total: f64 = points.iter().map(|p| p.1).sum();
    let mean = [0, 1, 2]
        .map(|k| points.iter().map(|(p, w)| p[k] * w).sum::<f64>() / total.max(f64::MIN_POSITIVE));
    let mut sums = [0.0; 6];
    for (p, w) in points {
        let d = [0, 1, 2].map(|k| p[k] - mean[k]);
        let square: f64 = d.iter().map(|x| x * x).sum();
        for (sum, (i, j)) in sums
            .iter_mut()
            .zip([(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)])
        {
            let one = if i == j { square } else { 0.0 };
            *sum += w * (one - d[i] * d[j]);
        }
    }
    sums
}

#[track_caller]
fn assert_near(found: Symmetric3<f64>, expected: [f64; 6], tolerance: f64) {
    let size = expected[0] + expected[1] + expected[2];
    for (x, y) in found.scalars().iter().zip(expected) {
        assert!((x - y).abs() <= tolerance * size, "{found:?} {expected:?}");
    }
}

/// The nodes of Gauss and Legendre's rule with three points on an interval, exact up to the fifth power.
fn gauss(low: f64, high: f64) -> [(f64, f64); 3] {
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let off = 0.6_f64.sqrt() * half;
    [
        (middle - off, 5.0 / 9.0 * half),
        (middle, 8.0 / 9.0 * half),
        (middle + off, 5.0 / 9.0 * half),
    ]
}

/// A solid of revolution by its radius at a share of the axis: rings of eight points in shells and slices.
fn revolved(
    from: Vec3<f64>,
    to: Vec3<f64>,
    range: [f64; 2],
    radius: impl Fn(f64) -> f64,
) -> Vec<([f64; 3], f64)> {
    let way = to - from;
    let length = way.length();
    let axis = way * (1.0 / length);
    let aside = if axis.x.abs() < 0.6 {
        Vec3::new(1.0, 0.0, 0.0)
    } else {
        Vec3::new(0.0, 1.0, 0.0)
    };
    let u = axis.cross(aside);
    let u = u * (1.0 / u.length());
    let v = axis.cross(u);
    let mut all = Vec::new();
    let slices = 400;
    for i in 0..slices {
        let step = (range[1] - range[0]) / f64::from(slices);
        for (at, weight) in gauss(
            range[0] + step * f64::from(i),
            range[0] + step * f64::from(i + 1),
        ) {
            let reach = radius(at);
            for (r, share) in gauss(0.0, reach) {
                for k in 0..8 {
                    let (sin, cos) = (f64::from(k) * std::f64::consts::FRAC_PI_4).sin_cos();
                    let p = from + axis * at + (u * cos + v * sin) * r;
                    all.push((
                        [p.x, p.y, p.z],
                        weight * share * r * std::f64::consts::FRAC_PI_4,
                    ));
                }
            }
        }
    }
    all
}

#[test]
fn solids_of_revolution() {
    let mut dice = Dice(71);
    for _ in 0..12 {
        let (a, b, r) = (point(&mut dice), point(&mut dice), dice.within(0.05, 2.0));
        let length = (b - a).length();
        let cylinder = Cylinder::new(a, b, r);
        assert_near(
            cylinder.inertia(),
            tensor(&revolved(a, b, [0.0, length], |_| r)),
            1e-12,
        );
        let cone = Cone::new(a, b, r);
        assert_near(
            cone.inertia(),
            tensor(&revolved(a, b, [0.0, length], |z| r * z / length)),
            1e-12,
        );
        // The radius of a capsule bends at its seams, and is vertical at its ends.
        let outline = |z: f64| {
            let beyond = (-z).max(z - length).max(0.0);
            (r * r - beyond * beyond).max(0.0).sqrt()
        };
        let mut parts = revolved(a, b, [-r, 0.0], outline);
        parts.extend(revolved(a, b, [0.0, length], outline));
        parts.extend(revolved(a, b, [length, length + r], outline));
        assert_near(Capsule3::new(a, b, r).inertia(), tensor(&parts), 1e-9);
        let ball = revolved(a, b, [-r, r], |z| (r * r - z * z).max(0.0).sqrt());
        assert_near(Sphere::new(a, r).inertia(), tensor(&ball), 1e-8);
        assert_eq!(
            Capsule3::new(a, a, r).inertia(),
            Capsule3::new(b, b, r).inertia()
        );
        assert_near(Capsule3::new(a, a, r).inertia(), tensor(&ball), 1e-8);
    }
}

/// Points of a box in its own axes, with a density of sections that a function gives.
fn in_box(place: Pose3<f64>, size: [f64; 3]) -> Vec<([f64; 3], f64)> {
    let axes = size.map(|s| gauss(-0.5 * s, 0.5 * s));
    let mut all = Vec::new();
    for (x, wx) in axes[0] {
        for (y, wy) in axes[1] {
            for (z, wz) in axes[2] {
                let p = place * Vec3::new(x, y, z);
                all.push(([p.x, p.y, p.z], wx * wy * wz));
            }
        }
    }
    all
}

#[test]
fn boxes_and_tetrahedra() {
    let mut dice = Dice(72);
    for _ in 0..200 {
        let (center, turn) = (point(&mut dice), rotation(&mut dice));
        let size = [0; 3].map(|_| dice.within(0.0, 3.0));
        let lengths = Vec3::new(size[0], size[1], size[2]);
        let inertia = Obb3::new(center, lengths, turn).inertia();
        assert_near(
            inertia,
            tensor(&in_box(Pose3::new(center, turn), size)),
            1e-13,
        );
        let heading = dice.within(-3.0, 3.0);
        let place = Pose3::new(center, Rotation3::from_yaw(heading));
        let inertia = YawBox3::new(center, lengths, heading).inertia();
        assert_near(inertia, tensor(&in_box(place, size)), 1e-13);
        let half = lengths * 0.5;
        let inertia = Aabb3::new(center - half, center + half).inertia();
        assert_near(
            inertia,
            tensor(&in_box(Pose3::new(center, Rotation3::identity()), size)),
            1e-13,
        );
        // Four points of equal weight integrate squares over a tetrahedron exactly.
        let corners = [0; 4].map(|_| point(&mut dice));
        let [a, b, c, d] = corners;
        let shape = Tetrahedron::new(a, b, c, d);
        let volume = (b - a).cross(c - a).dot(d - a).abs() / 6.0;
        let (far, near) = (
            (5.0 + 3.0 * 5.0_f64.sqrt()) / 20.0,
            (5.0 - 5.0_f64.sqrt()) / 20.0,
        );
        let nodes: Vec<([f64; 3], f64)> = (0..4)
            .map(|i| {
                let weights = (0..4).map(|k| corners[k] * if k == i { far } else { near });
                let p = weights.fold(Vec3::zero(), |sum, x| sum + x);
                ([p.x, p.y, p.z], 0.25 * volume)
            })
            .collect();
        assert_near(shape.inertia(), tensor(&nodes), 1e-12);
    }
}

/// Sections of a box with round edges are rectangles with round corners: their areas tell the second moments.
#[test]
fn round_boxes() {
    let mut dice = Dice(73);
    for _ in 0..20 {
        let half = [0; 3].map(|_| dice.within(0.0, 2.0));
        let (r, turn) = (dice.within(0.01, 1.5), rotation(&mut dice));
        let moment = |k: usize| {
            let (a, b, c) = (half[(k + 1) % 3], half[(k + 2) % 3], half[k]);
            let section = |z: f64| {
                let beyond = (z - c).max(0.0);
                let round = (r * r - beyond * beyond).max(0.0).sqrt();
                4.0 * (a * b + round * (a + b)) + std::f64::consts::PI * round * round
            };
            let mut sum = 0.0;
            let steps = 4000;
            for (low, high) in [(0.0, c), (c, c + r)] {
                for i in 0..steps {
                    let at = |i: i32| low + (high - low) * f64::from(i) / f64::from(steps);
                    for (z, weight) in gauss(at(i), at(i + 1)) {
                        sum += 2.0 * weight * z * z * section(z);
                    }
                }
            }
            sum
        };
        let [x, y, z] = [0, 1, 2].map(moment);
        let size = Vec3::new(half[0], half[1], half[2]) * 2.0;
        let upright = RoundBox3::new(Obb3::new(point(&mut dice), size, Rotation3::identity()), r);
        assert_near(
            upright.inertia(),
            [y + z, x + z, x + y, 0.0, 0.0, 0.0],
            1e-6,
        );
        let turned = RoundBox3::new(Obb3::new(point(&mut dice), size, turn), r).inertia();
        assert!((turned.trace() - 2.0 * (x + y + z)).abs() < 1e-6 * turned.trace());
        // Along an axis of the box the moment is that of the upright one.
        let axis = turn.axes()[0];
        assert!(((turned * axis).dot(axis) - (y + z)).abs() < 1e-6 * turned.trace());
    }
}

/// A turn carries the tensor along; thin solids keep the digits of their small moment.
#[test]
fn turned_and_thin() {
    let mut dice = Dice(74);
    for _ in 0..200 {
        let (a, b, r) = (point(&mut dice), point(&mut dice), dice.within(0.0, 2.0));
        let (shift, turn) = (point(&mut dice), rotation(&mut dice));
        let pose = Pose3::new(shift, turn);
        let same = |x: Symmetric3<f64>, y: Symmetric3<f64>| {
            assert_near(x, y.scalars().try_into().unwrap(), 1e-13)
        };
        let capsule = Capsule3::new(a, b, r);
        same((pose * capsule).inertia(), capsule.inertia().turned(turn));
        let cone = Cone::new(a, b, r);
        same((pose * cone).inertia(), cone.inertia().turned(turn));
        let cylinder = Cylinder::new(a, b, r);
        same((pose * cylinder).inertia(), cylinder.inertia().turned(turn));
        let corner = Tetrahedron::new(a, b, shift, point(&mut dice));
        // A flat one has lost digits of its volume when it was moved.
        let moved = (pose * corner).inertia().scalars();
        let turned = corner.inertia().turned(turn).scalars();
        let near = moved
            .iter()
            .zip(&turned)
            .all(|(x, y)| (x - y).abs() < 1e-12);
        assert!(near, "{moved:?} {turned:?}");
        // A rod along x: its moment about itself is sixteen orders below the others.
        let rod = Capsule3::new(
            Vec3::new(-a.x.abs(), 0.0, 0.0),
            Vec3::new(1.0, 0.0, 0.0),
            1e-8,
        )
        .inertia();
        let expected = 1e-32 * std::f64::consts::FRAC_PI_2 * (1.0 + a.x.abs());
        assert!((rod.xx - expected).abs() < 1e-7 * expected, "{rod:?}");
        // Two halves of a cylinder, each about its own centre, make the whole.
        let middle = (a + b) * 0.5;
        let half = Cylinder::new(a, middle, r);
        let part = displaced(half.inertia(), half.volume(), (b - a) * 0.25);
        same(part + part, cylinder.inertia());
    }
}
