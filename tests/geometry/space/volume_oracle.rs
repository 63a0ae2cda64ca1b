//! Volumes that hulls share: every plane through three corners that has all others behind it, each clipped by all other
//! planes of both hulls, and the divergence theorem, in numbers of 320 binary places. No code is shared with the library,
//! and no hull has corners or edges here.
use super::super::polygon::exact::Big;
use super::hull_oracle::Point;

type BigPoint = [Big; 3];

fn minus(a: &BigPoint, b: &BigPoint) -> BigPoint {
    [0, 1, 2].map(|i| a[i].sub(&b[i]))
}
fn plus(a: &BigPoint, b: &BigPoint) -> BigPoint {
    [0, 1, 2].map(|i| a[i].add(&b[i]))
}
fn times(a: &BigPoint, by: &Big) -> BigPoint {
    [0, 1, 2].map(|i| a[i].mul(by))
}
fn dot(a: &BigPoint, b: &BigPoint) -> Big {
    (a[0].mul(&b[0]).add(&a[1].mul(&b[1]))).add(&a[2].mul(&b[2]))
}
fn cross(a: &BigPoint, b: &BigPoint) -> BigPoint {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i].mul(&b[j]).sub(&a[j].mul(&b[i])))
}

/// A plane by a point and its normal, outwards.
struct Plane {
    at: BigPoint,
    normal: BigPoint,
}

impl Plane {
    fn height(&self, p: &BigPoint) -> Big {
        dot(&self.normal, &minus(p, &self.at))
    }
    fn is(&self, other: &Plane) -> bool {
        let along = cross(&self.normal, &other.normal);
        self.height(&other.at).sign() == 0
            && along.iter().all(|x| x.sign() == 0)
            && dot(&self.normal, &other.normal).sign() > 0
    }
    /// A square of the plane with sides of at least `half` about a point of it.
    fn square(&self, half: f64) -> Vec<BigPoint> {
        let sizes = [0, 1, 2].map(|i| self.normal[i].to_f64().abs());
        let axis = (0..3)
            .min_by(|&i, &j| sizes[i].total_cmp(&sizes[j]))
            .unwrap();
        let mut along = [0.0, 0.0, 0.0].map(Big::new);
        along[axis] = Big::new(1.0);
        let long = |v: &BigPoint| {
            let most = v.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
            times(v, &Big::new((half / most).log2().ceil().exp2()))
        };
        let u = long(&cross(&self.normal, &along));
        let v = long(&cross(&long(&self.normal), &u));
        let (low, high) = (minus(&self.at, &u), plus(&self.at, &u));
        vec![
            minus(&low, &v),
            minus(&high, &v),
            plus(&high, &v),
            plus(&low, &v),
        ]
    }
}

fn big([x, y, z]: Point) -> BigPoint {
    [x, y, z].map(Big::new)
}

/// The planes of the faces of a hull; none without a volume.
fn planes(corners: &[Point]) -> Vec<Plane> {
    let corners: Vec<BigPoint> = corners.iter().map(|&p| big(p)).collect();
    let mut all: Vec<Plane> = Vec::new();
    for i in 0..corners.len() {
        for j in 0..i {
            for k in 0..j {
                let at = corners[i].clone();
                let normal = cross(&minus(&corners[j], &at), &minus(&corners[k], &at));
                if normal.iter().all(|x| x.sign() == 0) {
                    continue;
                }
                let plane = Plane { at, normal };
                let sides = corners.iter().map(|p| plane.height(p).sign());
                let (least, most) = sides.fold((0, 0), |(least, most), side| {
                    (side.min(least), side.max(most))
                });
                if least < 0 && most > 0 {
                    continue;
                }
                if least == 0 && most == 0 {
                    return Vec::new();
                }
                let normal = match most {
                    0 => plane.normal,
                    _ => [0, 1, 2].map(|i| Big::new(0.0).sub(&plane.normal[i])),
                };
                let plane = Plane { normal, ..plane };
                if !all.iter().any(|other| other.is(&plane)) {
                    all.push(plane);
                }
            }
        }
    }
    all
}

fn clipped(ring: &[BigPoint], plane: &Plane) -> Vec<BigPoint> {
    let heights: Vec<Big> = ring.iter().map(|p| plane.height(p)).collect();
    let mut kept = Vec::new();
    for k in 0..ring.len() {
        let next = (k + 1) % ring.len();
        let (here, there) = (&heights[k], &heights[next]);
        if here.sign() <= 0 {
            kept.push(ring[k].clone());
        }
        if here.sign() * there.sign() < 0 {
            let share = here.div(&here.sub(there));
            kept.push(plus(
                &ring[k],
                &times(&minus(&ring[next], &ring[k]), &share),
            ));
        }
    }
    kept
}

/// The volume behind all planes, of a body within `reach` of the first point.
fn volume(all: &[Plane], reach: f64) -> f64 {
    let Some(first) = all.first() else {
        return 0.0;
    };
    let from = first.at.clone();
    let mut six = Big::new(0.0);
    for (k, plane) in all.iter().enumerate() {
        if all[..k].iter().any(|other| other.is(plane)) {
            continue;
        }
        let mut ring = plane.square(reach);
        for other in all.iter().filter(|other| !other.is(plane)) {
            ring = clipped(&ring, other);
        }
        for pair in ring.get(1..).unwrap_or(&[]).windows(2) {
            let [a, b, c] = [&ring[0], &pair[0], &pair[1]].map(|p| minus(p, &from));
            let part = dot(&a, &cross(&b, &c));
            // The square may turn either way.
            let turn = cross(&minus(&b, &a), &minus(&c, &a));
            six = match dot(&turn, &plane.normal).sign() {
                -1 => six.sub(&part),
                _ => six.add(&part),
            };
        }
    }
    six.to_f64() / 6.0
}

/// The volume that two hulls share, of coordinates below about 10.
pub fn shared(a: &[Point], b: &[Point]) -> f64 {
    let (mut all, other) = (planes(a), planes(b));
    if all.is_empty() || other.is_empty() {
        return 0.0;
    }
    all.extend(other);
    volume(&all, 256.0)
}
