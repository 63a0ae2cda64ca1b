//! Adjoint of cells: cotangents of measures go back to sites, weights and the domain.
use crate::cells::{CellBorder, CellMoments, Cells, Piece, side_share};
use crate::{Scalar, Vec2};

/// The cotangents of the input of a diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagramBars<S> {
    /// By site.
    pub sites: Vec<Vec2<S>>,
    /// By weight; of a diagram without weights, by the zeros in their place.
    pub weights: Vec<S>,
    /// By vertex of the domain, one ring after the other.
    pub domain: Vec<Vec2<S>>,
}

/// Returns the cotangents of the input from those of the [areas](Cells::areas) of its cells. See [`moments_vjp`].
///
/// # Panics
///
/// When there is another number of cotangents than of sites.
pub fn areas_vjp<S: Scalar<Mask = bool>>(
    cells: &Cells<'_, '_, S>,
    areas_bar: &[S],
) -> DiagramBars<S> {
    let of_area = |&area| CellMoments {
        area,
        ..CellMoments::zero()
    };
    let bars: Vec<_> = areas_bar.iter().map(of_area).collect();
    moments_vjp(cells, &bars)
}

/// Returns the cotangents of the input from those of the [centroids](Cells::centroids) of its cells.
///
/// # Panics
///
/// When there is another number of cotangents than of sites.
pub fn centroids_vjp<S: Scalar<Mask = bool>>(
    cells: &Cells<'_, '_, S>,
    centroids_bar: &[Vec2<S>],
) -> DiagramBars<S> {
    let moments = cells.moments();
    let of_moments = |i: usize| {
        let (own, bar) = (moments[i], centroids_bar[i]);
        // The centroid is y + first/area.
        if !cells.has_area(i) {
            return CellMoments::zero();
        }
        let first = Vec2::new(bar.x.over(own.area), bar.y.over(own.area));
        CellMoments {
            area: -first.dot(own.first).over(own.area),
            first,
            second: S::zero(),
        }
    };
    let bars: Vec<_> = (0..cells.len()).map(of_moments).collect();
    let mut found = moments_vjp(cells, &bars);
    for (site, &bar) in found.sites.iter_mut().zip(centroids_bar) {
        *site += bar;
    }
    found
}

/// Returns the cotangents of the input from those of the [moments](Cells::moments) of its cells.
///
/// Cotangents `(a, f, c)` of a cell's moments make the integrand `g(x) = a + f·(x − y) + c|x − y|²`. By Reynolds'
/// transport theorem its integral changes by `∫ g v` over the border, whose points move by `v` along the outward normal,
/// and by `−f·area − 2c·first` times the motion of the site. With the distance `D` of both sites, `v` is
/// `((x − yᵢ)·dyᵢ − (x − yⱼ)·dyⱼ)/D + (dwᵢ − dwⱼ)/(2D)` on a bisector, and linear between the ends of an edge. All
/// integrands are cubic along a side, and exact by Simpson's rule.
///
/// # Panics
///
/// When there is another number of cotangents than of sites.
pub fn moments_vjp<S: Scalar<Mask = bool>>(
    cells: &Cells<'_, '_, S>,
    moments_bar: &[CellMoments<S>],
) -> DiagramBars<S> {
    let count = cells.len();
    assert_eq!(moments_bar.len(), count, "one cotangent for each site");
    let vertices = cells.vertex_count();
    let mut bars = DiagramBars {
        sites: vec![Vec2::zero(); count],
        weights: vec![S::zero(); count],
        domain: vec![Vec2::zero(); vertices],
    };
    // The cotangents of whole cells, at the first of equal sites.
    let mut whole_bars = vec![CellMoments::zero(); count];
    for (i, &bar) in moments_bar.iter().enumerate() {
        let first = cells.trace.first(i);
        let whole = &mut whole_bars[first];
        let own = bar.scaled(cells.part(first));
        whole.area += own.area;
        whole.first += own.first;
        whole.second += own.second;
    }
    for (i, &whole) in whole_bars.iter().enumerate() {
        if cells.trace.first(i) == i {
            pull(cells, i, whole, &mut bars);
        }
    }
    // Equal sites move their mean. The first of them comes last, since the others read what it has.
    for i in (0..count).rev() {
        let first = cells.trace.first(i);
        if cells.counts[first] > 1 {
            let part = cells.part(first);
            bars.sites[i] = bars.sites[first] * part;
            bars.weights[i] = bars.weights[first] * part;
        }
    }
    bars
}

/// Adds what a cell's own cotangents send to the input.
fn pull<S: Scalar<Mask = bool>>(
    cells: &Cells<'_, '_, S>,
    i: usize,
    bar: CellMoments<S>,
    bars: &mut DiagramBars<S>,
) {
    let (four, sixth) = (S::lit(4.0), S::lit(1.0 / 6.0));
    let integrand = |v: Vec2<S>| bar.area + bar.first.dot(v) + bar.second * v.length_squared();
    cells.each_piece(i, |Piece { border, ends }| {
        let [p, q] = ends;
        let middle = (p + q) * S::lit(0.5);
        let [at_p, at_middle, at_q] = [p, middle, q].map(integrand);
        // Simpson's weights.
        let [at_p, at_middle, at_q] = [at_p * sixth, at_middle * four * sixth, at_q * sixth];
        match border {
            CellBorder::Site(j) => {
                let n = cells.apart(i, j);
                let share = side_share(ends, n);
                let sum = (at_p + at_middle + at_q) * share;
                let by_own = (p * at_p + middle * at_middle + q * at_q) * share;
                bars.sites[i] += by_own;
                bars.sites[j] += n * sum - by_own;
                bars.weights[i] += sum.halved();
                bars.weights[j] -= sum.halved();
            }
            CellBorder::Edge([from, to]) => {
                let [a, b] = cells.edge(i, [from, to]);
                let way = b - a;
                let square = way.length_squared();
                let place = |v: Vec2<S>| (v - a).dot(way).over(square);
                let (start, end) = (place(p), place(q));
                let between = (start + end).halved();
                // Points of the edge move by the shares of both ends; the normal has the edge's length.
                let by_to = at_p * start + at_middle * between + at_q * end;
                let by_from = (at_p + at_middle + at_q) - by_to;
                let normal = Vec2::new(way.y, -way.x) * (end - start);
                bars.domain[from] += normal * by_from;
                bars.domain[to] += normal * by_to;
            }
        }
    });
    let own = cells.whole(i);
    let twice = bar.second + bar.second;
    bars.sites[i] -= bar.first * own.area + own.first * twice;
}
