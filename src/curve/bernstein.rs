//! Zeros of polynomials between 0 and 1, isolated by the signs of Bernstein's coefficients.

/// Halvings until an interval is a point.
const DEEPEST: u32 = 52;

/// Calls something with every place from 0 to 1 where a polynomial is zero, or as near to it as rounding lets it see.
///
/// The polynomial is given by its Bernstein coefficients, which err by up to `noise`. By Descartes' rule it has no zeros
/// inside where the coefficients have one sign, and one where their signs change once; else both halves are
/// searched. A place may be reported more than once, and one of several zeros nearer to each other than
/// rounding stands for all. The middle stands for a polynomial of noise alone.
pub(super) fn zeros<const N: usize>(
    coefficients: [f64; N],
    noise: f64,
    found: &mut impl FnMut(f64),
) {
    descend(coefficients, noise, [0.0, 1.0], DEEPEST, found);
}

/// Returns the coefficients on both halves (de Casteljau).
fn halves<const N: usize>(mut c: [f64; N]) -> [[f64; N]; 2] {
    let mut left = c;
    for (k, place) in left.iter_mut().enumerate().skip(1) {
        for i in 0..N - k {
            c[i] = 0.5 * c[i] + 0.5 * c[i + 1];
        }
        *place = c[0];
    }
    [left, c]
}

/// Returns the value and the slope at a place of the interval.
fn value<const N: usize>(mut c: [f64; N], u: f64) -> [f64; 2] {
    let mut slope = 0.0;
    for k in 1..N {
        slope = (N - 1) as f64 * (c[1] - c[0]);
        for i in 0..N - k {
            c[i] += (c[i + 1] - c[i]) * u;
        }
    }
    [c[0], slope]
}

fn descend<const N: usize>(
    c: [f64; N],
    noise: f64,
    [low, high]: [f64; 2],
    depth: u32,
    found: &mut impl FnMut(f64),
) {
    let middle = low + 0.5 * (high - low);
    if c.iter().all(|x| x.abs() <= noise) {
        return found(middle);
    }
    if c[0].abs() <= noise {
        found(low);
    }
    if c[N - 1].abs() <= noise {
        found(high);
    }
    let mut changes = 0;
    let mut last = 0.0;
    for x in c.into_iter().filter(|&x| x != 0.0) {
        changes += u32::from(last * x.signum() < 0.0);
        last = x.signum();
    }
    match changes {
        0 => {}
        1 => found(low + (high - low) * between(c, last)),
        _ if depth == 0 => found(middle),
        _ => {
            let [left, right] = halves(c);
            descend(left, noise, [low, middle], depth - 1, found);
            descend(right, noise, [middle, high], depth - 1, found);
        }
    }
}

/// Returns the one zero between 0 and 1, given the sign at the end: by Newton's steps, and by a halving in place of one that leaves
/// the interval or is no shorter than half of the step before the last one.
fn between<const N: usize>(c: [f64; N], last: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    let (from, to) = (c[0] * last, c[N - 1] * last);
    let chord = from / (from - to);
    let mut u = if chord > 0.0 && chord < 1.0 {
        chord
    } else {
        0.5
    };
    let mut steps = [1.0, 1.0];
    for _ in 0..2 * DEEPEST {
        let [at, slope] = value(c, u);
        let at = at * last;
        if at > 0.0 {
            high = u;
        } else {
            low = u;
        }
        let next = u - at / (slope * last);
        let is_short = (next - u).abs() < 0.5 * steps[0];
        let next = if next > low && next < high && is_short {
            next
        } else {
            low + 0.5 * (high - low)
        };
        steps = [steps[1], (next - u).abs()];
        if at == 0.0 || steps[1] <= 4.0 * f64::EPSILON {
            break;
        }
        u = next;
    }
    u
}
