//! The oracle: areas of boolean combinations of rings of any kind, in big fixed-point numbers. The plane
//! is cut into vertical strips in which no edges cross, and those into trapezoids; shares no code and no
//! method with the library.
use super::exact::{Big, Point, points};
use geograd::Vec2;
use geograd::polygon::Fill;

pub type Ring = Vec<Vec2<f64>>;

struct Edge {
    second: bool,
    from: Point,
    to: Point,
}

fn edges(rings: &[Ring], second: bool) -> Vec<Edge> {
    let mut all = Vec::new();
    for ring in rings {
        let ring = points(ring);
        for k in 0..ring.len() {
            let (from, to) = (ring[k].clone(), ring[(k + 1) % ring.len()].clone());
            if from[0] != to[0] {
                all.push(Edge { second, from, to });
            }
        }
    }
    all
}

fn less(a: &Big, b: &Big) -> bool {
    a.sub(b).sign() < 0
}

fn cross(u: &Point, v: &Point) -> Big {
    u[0].mul(&v[1]).sub(&u[1].mul(&v[0]))
}

fn minus(a: &Point, b: &Point) -> Point {
    [a[0].sub(&b[0]), a[1].sub(&b[1])]
}

/// The x at which two edges cross.
fn meeting(a: &Edge, b: &Edge) -> Option<Big> {
    let (u, v) = (minus(&a.to, &a.from), minus(&b.to, &b.from));
    let turn = cross(&u, &v);
    if turn.sign() == 0 {
        return None;
    }
    let between = minus(&b.from, &a.from);
    let (t, s) = (
        cross(&between, &v).div(&turn),
        cross(&between, &u).div(&turn),
    );
    let (zero, one) = (Big::new(0.0), Big::new(1.0));
    let inside = |x: &Big| !less(x, &zero) && !less(&one, x);
    (inside(&t) && inside(&s)).then(|| a.from[0].add(&u[0].mul(&t)))
}

impl Edge {
    fn spans(&self, low: &Big, high: &Big) -> bool {
        let (left, right) = match less(&self.from[0], &self.to[0]) {
            true => (&self.from[0], &self.to[0]),
            false => (&self.to[0], &self.from[0]),
        };
        !less(low, left) && !less(right, high)
    }
    fn at(&self, x: &Big) -> Big {
        let way = minus(&self.to, &self.from);
        let along = x.sub(&self.from[0]).mul(&way[1]).div(&way[0]);
        self.from[1].add(&along)
    }
}

/// The areas of what is in a only, in both, and in b only.
pub fn areas(a: &[Ring], b: &[Ring], fill: Fill) -> [f64; 3] {
    let mut all = edges(a, false);
    all.extend(edges(b, true));
    let mut cuts: Vec<Big> = all
        .iter()
        .flat_map(|e| [e.from[0].clone(), e.to[0].clone()])
        .collect();
    for i in 0..all.len() {
        cuts.extend((0..i).filter_map(|j| meeting(&all[i], &all[j])));
    }
    cuts.sort_by(|x, y| x.0.cmp(&y.0));
    cuts.dedup();
    let is_in = |winding: i32| match fill {
        Fill::NonZero => winding != 0,
        Fill::EvenOdd => winding % 2 != 0,
    };
    let mut twice = [(); 3].map(|()| Big::new(0.0));
    for strip in cuts.windows(2) {
        let (low, high) = (&strip[0], &strip[1]);
        let wide = high.sub(low);
        let mut here: Vec<_> = all
            .iter()
            .filter(|edge| edge.spans(low, high))
            .map(|edge| (edge.at(low).add(&edge.at(high)), edge))
            .collect();
        here.sort_by(|x, y| x.0.0.cmp(&y.0.0));
        let mut windings = [0, 0];
        for pair in here.windows(2) {
            let (below, above) = (&pair[0], &pair[1]);
            let to_right = less(&below.1.from[0], &below.1.to[0]);
            windings[usize::from(below.1.second)] += if to_right { 1 } else { -1 };
            let kind = match windings.map(is_in) {
                [true, false] => 0,
                [true, true] => 1,
                [false, true] => 2,
                [false, false] => continue,
            };
            twice[kind] = twice[kind].add(&wide.mul(&above.0.sub(&below.0)));
        }
    }
    twice.map(|twice| twice.to_f64() / 2.0)
}
