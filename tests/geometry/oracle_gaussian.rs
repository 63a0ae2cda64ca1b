//! An independent oracle for boxes as Gaussians: covariance matrices and the formulas of the papers, in
//! fixed-point numbers of 256 fractional bits from the exact values of the floats. It shares no code with the
//! library, and no formula: inverses, determinants and eigenvalues, where the library has closed forms.
use super::oracle_boxes::{BITS, Fixed};
use super::pairs::{FAMILIES, Random, pair};
use geograd::gaussian::{self, solid};
use geograd::{Jet, Obb2, Obb3, Rotation3, Scalar, Vec3};
use num_bigint::BigInt;

type Matrix = Vec<Vec<Fixed>>;

fn number(x: f64) -> Fixed {
    Fixed::new(x)
}
fn root(x: &Fixed) -> Fixed {
    assert!(!x.is_negative());
    Fixed((&x.0 << BITS).sqrt())
}
fn halved(x: &Fixed) -> Fixed {
    Fixed(&x.0 / 2)
}
fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let entry = |i: usize, j: usize| {
        (0..a.len()).fold(number(0.0), |sum, k| sum.add(&a[i][k].mul(&b[k][j])))
    };
    (0..a.len())
        .map(|i| (0..a.len()).map(|j| entry(i, j)).collect())
        .collect()
}
fn combined(a: &Matrix, b: &Matrix, of: impl Fn(&Fixed, &Fixed) -> Fixed) -> Matrix {
    let row = |(a, b): (&Vec<Fixed>, &Vec<Fixed>)| a.iter().zip(b).map(|(a, b)| of(a, b)).collect();
    a.iter().zip(b).map(row).collect()
}
fn trace(a: &Matrix) -> Fixed {
    (0..a.len()).fold(number(0.0), |sum, i| sum.add(&a[i][i]))
}
/// The matrix without a row and a column.
fn minor(a: &Matrix, row: usize, column: usize) -> Matrix {
    let keep = |r: &Vec<Fixed>| {
        (0..a.len())
            .filter(|&j| j != column)
            .map(|j| r[j].clone())
            .collect()
    };
    (0..a.len())
        .filter(|&i| i != row)
        .map(|i| keep(&a[i]))
        .collect()
}
/// By Laplace's expansion.
fn det(a: &Matrix) -> Fixed {
    if a.is_empty() {
        return number(1.0);
    }
    (0..a.len()).fold(number(0.0), |sum, j| {
        let term = a[0][j].mul(&det(&minor(a, 0, j)));
        if j % 2 == 0 {
            sum.add(&term)
        } else {
            sum.sub(&term)
        }
    })
}
fn inverse(a: &Matrix) -> Matrix {
    let all = det(a);
    let entry = |i: usize, j: usize| {
        let cofactor = det(&minor(a, j, i)).div(&all);
        if (i + j).is_multiple_of(2) {
            cofactor
        } else {
            number(0.0).sub(&cofactor)
        }
    };
    (0..a.len())
        .map(|i| (0..a.len()).map(|j| entry(i, j)).collect())
        .collect()
}
/// Eigenvalues of a symmetric matrix by Jacobi's rotations.
fn eigenvalues(mut a: Matrix) -> Vec<Fixed> {
    let (n, zero, one) = (a.len(), number(0.0), number(1.0));
    for _ in 0..12 {
        for p in 0..n {
            for q in p + 1..n {
                // Eigenvalues differ by the square of it.
                if a[p][q].0.magnitude().bits() < 100 {
                    continue;
                }
                let theta = a[q][q].sub(&a[p][p]).div(&a[p][q].add(&a[p][q]));
                let back = theta.is_negative();
                let size = if back { zero.sub(&theta) } else { theta };
                let tan = one.div(&size.add(&root(&size.mul(&size).add(&one))));
                let tan = if back { zero.sub(&tan) } else { tan };
                let cos = one.div(&root(&tan.mul(&tan).add(&one)));
                let sin = tan.mul(&cos);
                let mut turn: Matrix = (0..n)
                    .map(|i| (0..n).map(|j| number(f64::from(i == j))).collect())
                    .collect();
                (turn[p][p], turn[q][q]) = (cos.clone(), cos);
                (turn[p][q], turn[q][p]) = (sin.clone(), zero.sub(&sin));
                let other = (0..n)
                    .map(|i| (0..n).map(|j| turn[j][i].clone()).collect())
                    .collect();
                a = product(&other, &product(&a, &turn));
            }
        }
    }
    (0..n).map(|i| a[i][i].clone()).collect()
}
/// The natural logarithm: `2 atanh((m − 1) / (m + 1))` of the significand, and that of a power of two.
fn ln(x: &Fixed) -> Fixed {
    let atanh2 = |y: &Fixed| {
        let square = y.mul(y);
        let (mut power, mut sum) = (y.clone(), number(0.0));
        for odd in (1..400).step_by(2) {
            sum = sum.add(&Fixed(&power.0 / odd));
            power = power.mul(&square);
        }
        sum.add(&sum)
    };
    let two = atanh2(&number(1.0).div(&number(3.0)));
    let power = x.0.bits() as i64 - BITS as i64;
    let significand = match power {
        0.. => Fixed(&x.0 >> power),
        _ => Fixed(&x.0 << -power),
    };
    let (below, above) = (significand.sub(&number(1.0)), significand.add(&number(1.0)));
    atanh2(&below.div(&above)).add(&Fixed(two.0 * power))
}
/// The exponential of a number that is not above a thousand or so: of a 2⁻²⁴ part, squared again.
fn exp(x: &Fixed) -> Fixed {
    // Below the last digit; the series is for small parts only.
    if x.to_f64() < -200.0 {
        return number(0.0);
    }
    let small = Fixed(&x.0 >> 24);
    let (mut term, mut sum) = (number(1.0), number(1.0));
    for n in 1..20 {
        term = Fixed(term.mul(&small).0 / n);
        sum = sum.add(&term);
    }
    (0..24).fold(sum, |power, _| power.mul(&power))
}

/// A box: its centre, its axes as columns, its sizes.
#[derive(Clone)]
struct Shape {
    center: Vec<Fixed>,
    axes: Matrix,
    size: Vec<Fixed>,
}

/// The box of five numbers, in the plane, or of ten, in space; in their order.
fn shape(x: &[Fixed]) -> Shape {
    let zero = number(0.0);
    if let [u, v, width, height, heading] = x {
        let (cos, sin) = heading.cos_sin();
        return Shape {
            center: vec![u.clone(), v.clone()],
            axes: vec![vec![cos.clone(), zero.sub(&sin)], vec![sin, cos]],
            size: vec![width.clone(), height.clone()],
        };
    }
    let norm = x[6..]
        .iter()
        .fold(zero.clone(), |sum, q| sum.add(&q.mul(q)));
    let length = root(&norm);
    let q: Vec<Fixed> = x[6..].iter().map(|q| q.div(&length)).collect();
    // v + 2 w (q × v) + 2 q × (q × v), for each axis v.
    let cross = |a: &[Fixed], b: &[Fixed]| -> Vec<Fixed> {
        let at = |i: usize, j: usize| a[i].mul(&b[j]).sub(&a[j].mul(&b[i]));
        vec![at(1, 2), at(2, 0), at(0, 1)]
    };
    let turned: Matrix = (0..3)
        .map(|k| {
            let axis: Vec<Fixed> = (0..3).map(|i| number(f64::from(i == k))).collect();
            let once = cross(&q[1..], &axis);
            let twice = cross(&q[1..], &once);
            (0..3)
                .map(|i| {
                    let by = q[0].mul(&once[i]).add(&twice[i]);
                    axis[i].add(&by).add(&by)
                })
                .collect()
        })
        .collect();
    Shape {
        center: x[..3].to_vec(),
        axes: (0..3)
            .map(|i| (0..3).map(|k| turned[k][i].clone()).collect())
            .collect(),
        size: x[3..6].to_vec(),
    }
}

impl Shape {
    /// `R diag(d) Rᵀ` for `d` of the sizes.
    fn along(&self, of: impl Fn(&Fixed) -> Fixed) -> Matrix {
        let d: Vec<Fixed> = self.size.iter().map(of).collect();
        let entry = |i: usize, j: usize| {
            (0..d.len()).fold(number(0.0), |sum, k| {
                sum.add(&self.axes[i][k].mul(&d[k]).mul(&self.axes[j][k]))
            })
        };
        (0..d.len())
            .map(|i| (0..d.len()).map(|j| entry(i, j)).collect())
            .collect()
    }
    /// With half the sizes as standard deviations.
    fn covariance(&self) -> Matrix {
        self.along(|s| halved(s).mul(&halved(s)))
    }
    fn floored(&self, least: &Fixed) -> Shape {
        let size = self
            .size
            .iter()
            .map(|s| if s < least { least } else { s }.clone());
        Shape {
            size: size.collect(),
            ..self.clone()
        }
    }
}

fn form(m: &Matrix, v: &[Fixed]) -> Fixed {
    let row = |r: &Vec<Fixed>| {
        r.iter()
            .zip(v)
            .fold(number(0.0), |sum, (m, v)| sum.add(&m.mul(v)))
    };
    m.iter()
        .zip(v)
        .fold(number(0.0), |sum, (r, v)| sum.add(&row(r).mul(v)))
}

/// Wasserstein's distance and its square, `KL(a ‖ b)`, Jeffreys' divergence, Bhattacharyya's distance, ProbIoU, KFIoU.
fn losses(a: &[Fixed], b: &[Fixed]) -> [Fixed; 7] {
    let (a, b) = (shape(a), shape(b));
    let way: Vec<Fixed> = a
        .center
        .iter()
        .zip(&b.center)
        .map(|(a, b)| b.sub(a))
        .collect();
    let squared = way.iter().fold(number(0.0), |sum, d| sum.add(&d.mul(d)));
    // Olkin and Pukelsheim, 1982: |d|² + tr (Σa + Σb − 2 (√Σa Σb √Σa)^½).
    let (p, q, half) = (a.covariance(), b.covariance(), a.along(halved));
    let roots = eigenvalues(product(&half, &product(&q, &half)));
    let positive = |x: &Fixed| {
        if x.is_negative() {
            number(0.0)
        } else {
            root(x)
        }
    };
    let roots = roots
        .iter()
        .fold(number(0.0), |sum, x| sum.add(&positive(x)));
    let wasserstein = squared
        .add(&trace(&p))
        .add(&trace(&q))
        .sub(&roots.add(&roots));
    // The others take sizes from 2⁻²³ of the largest length on.
    let largest = a.size.iter().chain(&b.size).cloned();
    let largest = largest.fold(root(&squared), |x, y| if x < y { y } else { x });
    let least = Fixed(largest.0 >> 23);
    let (p, q) = (
        a.floored(&least).covariance(),
        b.floored(&least).covariance(),
    );
    let dimension = number(way.len() as f64);
    let divergence = |p: &Matrix, q: &Matrix| {
        let back = inverse(q);
        let sum = form(&back, &way)
            .add(&trace(&product(&back, p)))
            .sub(&dimension);
        halved(&sum.sub(&ln(&det(p).div(&det(q)))))
    };
    let bhattacharyya = |p: &Matrix, q: &Matrix| {
        let mean = combined(p, q, |p, q| halved(&p.add(q)));
        let far = form(&inverse(&mean), &way);
        let spread = ln(&det(&mean).div(&root(&det(p).mul(&det(q)))));
        Fixed(far.0 / 8).add(&halved(&spread))
    };
    let even = |m: &Matrix| combined(m, m, |x, _| Fixed(&x.0 / 3));
    let similar = exp(&number(0.0).sub(&bhattacharyya(&even(&p), &even(&q))));
    let hellinger = positive(&number(1.0).sub(&similar));
    // Kalman's gain K = Σa (Σa + Σb)⁻¹ leaves Σa − K Σa.
    let gain = product(&p, &inverse(&combined(&p, &q, Fixed::add)));
    let fused = positive(&det(&combined(&p, &product(&gain, &p), Fixed::sub)));
    let total = root(&det(&p)).add(&root(&det(&q))).sub(&fused);
    let forth = divergence(&p, &q);
    [
        positive(&wasserstein),
        wasserstein,
        forth.clone(),
        forth.add(&divergence(&q, &p)),
        bhattacharyya(&p, &q),
        number(1.0).sub(&hellinger),
        fused.div(&total),
    ]
}

fn of_plane<S: Scalar>(x: &[S]) -> Obb2<S> {
    Obb2::new(x[0], x[1], x[2], x[3], x[4])
}
fn of_space<S: Scalar>(x: &[S]) -> Obb3<S> {
    let turn = Rotation3::new(x[6], x[7], x[8], x[9]);
    Obb3::new(
        Vec3::new(x[0], x[1], x[2]),
        Vec3::new(x[3], x[4], x[5]),
        turn,
    )
}

/// The same by the library.
fn found<S: Scalar>(a: &[S], b: &[S]) -> [S; 7] {
    if a.len() == 5 {
        let (a, b) = (of_plane(a), of_plane(b));
        return [
            gaussian::wasserstein(a, b),
            gaussian::wasserstein_squared(a, b),
            gaussian::kullback_leibler(a, b),
            gaussian::jeffreys(a, b),
            gaussian::bhattacharyya(a, b),
            gaussian::probiou(a, b),
            gaussian::kfiou(a, b),
        ];
    }
    let (a, b) = (of_space(a), of_space(b));
    [
        solid::wasserstein(a, b),
        solid::wasserstein_squared(a, b),
        solid::kullback_leibler(a, b),
        solid::jeffreys(a, b),
        solid::bhattacharyya(a, b),
        solid::probiou(a, b),
        solid::kfiou(a, b),
    ]
}

/// Pairs of the plane and of space: the families, and with sizes and distances spread over powers of ten.
fn pairs(random: &mut Random) -> Vec<(String, Vec<f64>, Vec<f64>)> {
    let numbers = |x: &Obb3<f64>| {
        let (c, s, q) = (x.center, x.size, x.rotation);
        vec![c.x, c.y, c.z, s.x, s.y, s.z, q.w, q.x, q.y, q.z]
    };
    let flat = |x: &[f64]| vec![x[0], x[1], x[3], x[4], 3.0 * x[7]];
    let mut all = Vec::new();
    for family in FAMILIES {
        // Lengths whose squares have too few digits at fixed points.
        if ["tiny", "huge"].contains(&family) {
            continue;
        }
        for _ in 0..2 {
            let (a, b) = pair(family, random);
            all.push((family.into(), numbers(&a), numbers(&b)));
        }
    }
    for n in 0..30 {
        let (a, b) = pair("random", random);
        let (mut a, mut b) = (numbers(&a), numbers(&b));
        let mut power = |low: f64, high: f64| 10_f64.powf(random.between(low, high));
        for x in a[3..6].iter_mut().chain(&mut b[3..6]) {
            *x *= power(-4.0, 0.0);
        }
        let (far, small) = (power(0.0, 7.0), power(-5.0, 0.0));
        match n % 3 {
            0 => b[0] *= far,
            1 => b[3..6].iter_mut().for_each(|x| *x *= small),
            _ => {}
        }
        all.push(([" far", " small", " spread"][n % 3].into(), a, b));
    }
    let plane: Vec<_> = all
        .iter()
        .map(|(name, a, b)| (format!("{name} in the plane"), flat(a), flat(b)))
        .collect();
    all.extend(plane);
    all
}

const NAMES: [&str; 7] = [
    "W",
    "W²",
    "KL",
    "Jeffreys",
    "Bhattacharyya",
    "ProbIoU",
    "KFIoU",
];

/// How far a loss may be from the oracle, in roundings: thirty of itself, or of lengths of one where it is the
/// difference of boxes that are almost the same, or as many as sides of thin boxes go into each other.
fn allowed(name: &str, truth: f64) -> f64 {
    let is = |words: &[&str]| words.iter().any(|word| name.contains(word));
    if is(&["identical", "cubes"]) {
        return 30.0 * truth.abs().max(1.0);
    }
    match is(&["thin", " far", " small", " spread"]) {
        true => 3e4 * truth.abs().max(1e-3),
        false => 30.0 * truth.abs(),
    }
}

#[test]
fn losses_are_those_of_the_matrices() {
    let mut random = Random(75);
    for (name, a, b) in pairs(&mut random) {
        let single = |x: &[f64]| -> Vec<f32> { x.iter().map(|&x| x as f32).collect() };
        let double = |x: &[f32]| -> Vec<f64> { x.iter().map(|&x| f64::from(x)).collect() };
        let exact = |x: &[f64]| -> Vec<Fixed> { x.iter().map(|&x| number(x)).collect() };
        let (a, b) = (single(&a), single(&b));
        let (p, q) = (double(&a), double(&b));
        let truth = losses(&exact(&p), &exact(&q)).map(|x| x.to_f64());
        let formats = [
            (found(&a, &b).map(f64::from), f64::from(f32::EPSILON)),
            (found(&p, &q), f64::EPSILON),
        ];
        for (values, epsilon) in formats {
            for k in 0..7 {
                let error = (values[k] - truth[k]).abs();
                assert!(
                    error <= allowed(&name, truth[k]) * epsilon,
                    "{name}: {} {} {}",
                    NAMES[k],
                    values[k],
                    truth[k]
                );
            }
        }
    }
}

#[test]
fn derivatives_are_those_of_the_matrices() {
    if !geograd_tests::is_due("derivatives_are_those_of_the_matrices") {
        return;
    }
    let mut random = Random(76);
    let step = Fixed(BigInt::from(1) << (BITS - 64));
    for (n, (name, a, b)) in pairs(&mut random).into_iter().enumerate() {
        // Derivatives of identical boxes, and by sizes of zero, are those of a kink.
        let kink = ["identical", "cubes", "zero", "thin"]
            .iter()
            .any(|word| name.contains(word));
        if n % 4 != 0 || kink {
            continue;
        }
        let exact: Vec<Fixed> = a.iter().chain(&b).map(|&x| number(x)).collect();
        let half = a.len();
        let lifted = exact.iter().enumerate();
        let lifted: Vec<Jet<f64, 20>> = lifted.map(|(i, x)| Jet::variable(x.to_f64(), i)).collect();
        let values = found(&lifted[..half], &lifted[half..]);
        let mut truth = vec![[0.0; 7]; 2 * half];
        for (i, truth) in truth.iter_mut().enumerate() {
            let at = |h: &Fixed| {
                let mut x = exact.clone();
                x[i] = x[i].add(h);
                losses(&x[..half], &x[half..])
            };
            let (up, down) = (at(&step), at(&Fixed(-&step.0)));
            for k in 0..7 {
                truth[k] = up[k].sub(&down[k]).div(&step.add(&step)).to_f64();
            }
        }
        for k in 0..7 {
            let largest = truth.iter().fold(0.0_f64, |most, t| most.max(t[k].abs()));
            // Sizes down to 10⁻⁹ of others have derivatives by 10⁹ of which little is left.
            let roundings = if name.starts_with(' ') { 1e4 } else { 30.0 };
            for (i, (derivative, truth)) in values[k].derivative.iter().zip(&truth).enumerate() {
                let error = (derivative - truth[k]).abs();
                assert!(
                    error <= roundings * f64::EPSILON * largest + 1e-30,
                    "{name}: {} by {i}: {derivative} {}",
                    NAMES[k],
                    truth[k]
                );
            }
        }
    }
}
