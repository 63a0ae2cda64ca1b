//! Areas of cells in a convex domain, by exact enumeration: every crossing of two lines that no line cuts off.
//!
//! It shares no decision with the library: nothing is cut, and every number is a quotient of integers.

/// A closed half-plane `a x + b y ≤ c`.
type Line = [i128; 3];

/// Returns the area of what all half-planes share, which is bounded.
fn area(lines: &[Line]) -> f64 {
    let mut corners: Vec<[f64; 2]> = Vec::new();
    for (k, [a, b, c]) in lines.iter().enumerate() {
        for [d, e, f] in &lines[k + 1..] {
            let det = a * e - b * d;
            if det == 0 {
                continue;
            }
            let (x, y) = (c * e - b * f, a * f - c * d);
            let is_kept = lines
                .iter()
                .all(|[a, b, c]| (a * x + b * y - c * det) * det.signum() <= 0);
            if is_kept {
                corners.push([x as f64 / det as f64, y as f64 / det as f64]);
            }
        }
    }
    if corners.is_empty() {
        return 0.0;
    }
    let count = corners.len() as f64;
    let [mut u, mut v] = [0.0; 2];
    for [x, y] in &corners {
        u += x / count;
        v += y / count;
    }
    let angle = |[x, y]: &[f64; 2]| (y - v).atan2(x - u);
    corners.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    let next = corners.iter().cycle().skip(1);
    let crosses = corners.iter().zip(next);
    let twice: f64 = crosses
        .map(|([a, b], [c, d])| (a - u) * (d - v) - (b - v) * (c - u))
        .sum();
    twice / 2.0
}

/// Returns the areas of the power cells of sites on integers with integer weights, in a domain that is the first
/// polygon less the others: convex, counter-clockwise, on integers, the others inside of the first and apart.
pub fn areas(sites: &[[i64; 2]], weights: &[i64], domain: &[Vec<[i64; 2]>]) -> Vec<f64> {
    let wide = |[x, y]: [i64; 2]| [i128::from(x), i128::from(y)];
    let edges = |ring: &[[i64; 2]]| -> Vec<Line> {
        let ends = ring.iter().zip(ring.iter().cycle().skip(1));
        ends.map(|(&p, &q)| {
            let ([x, y], [u, v]) = (wide(p), wide(q));
            [v - y, x - u, (v - y) * x + (x - u) * y]
        })
        .collect()
    };
    let power = |i: usize| {
        let [x, y] = wide(sites[i]);
        x * x + y * y - i128::from(weights[i])
    };
    (0..sites.len())
        .map(|i| {
            let [x, y] = wide(sites[i]);
            let mut bisectors: Vec<Line> = Vec::new();
            let mut sharing = 1;
            for j in 0..sites.len() {
                let [u, v] = wide(sites[j]);
                match ([u, v] == [x, y], weights[j].cmp(&weights[i])) {
                    (true, std::cmp::Ordering::Greater) => return 0.0,
                    (true, std::cmp::Ordering::Equal) => sharing += usize::from(j != i),
                    (true, std::cmp::Ordering::Less) => {}
                    (false, _) => {
                        bisectors.push([2 * (u - x), 2 * (v - y), power(j) - power(i)]);
                    }
                }
            }
            let within = |ring: &Vec<[i64; 2]>| area(&[edges(ring), bisectors.clone()].concat());
            let holes: f64 = domain[1..].iter().map(within).sum();
            (within(&domain[0]) - holes) / sharing as f64
        })
        .collect()
}
