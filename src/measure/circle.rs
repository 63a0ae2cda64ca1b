//! The smallest circle around points.
use crate::arrays::Each;
use crate::hull::hull_search;
use crate::reference::Reference;
use crate::{Circle, Scalar, Vec2};

/// The points that a smallest enclosing circle goes through, by index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Support {
    /// All points coincide: the circle is that point.
    One(usize),
    /// These two are the ends of a diameter.
    Two([usize; 2]),
    /// These three are on the circle, none of their angles obtuse.
    Three([usize; 3]),
}

/// Returns the smallest circle that has all points inside, and the points that decide it. `None` for no
/// points. Expected `O(n)` after the hull, at worst cubic in the hull's size.
///
/// Kink: another point on the circle. Derivatives: see [`circle_replay`]. Source: Welzl, Smallest enclosing
/// disks, 1991, in its iterative form.
///
/// ```
/// use geograd::{Vec2, measure::circle::{Support, circle_search}};
/// let points = [(-1.0, 0.0), (1.0, 0.0), (0.0, 0.5)].map(|(x, y)| Vec2::new(x, y));
/// let (around, support) = circle_search(&points).unwrap();
/// assert_eq!((around.center, around.radius), (Vec2::new(0.0, 0.0), 1.0));
/// assert_eq!(support, Support::Two([0, 1]));
/// ```
#[must_use]
pub fn circle_search<S: Scalar<Mask = bool>>(points: &[Vec2<S>]) -> Option<(Circle<S>, Support)> {
    let mut hull = hull_search(points);
    let seen = Reference::of_ring(points);
    let place = |k: usize| {
        let at = seen.place(points[k]);
        Vec2::new(at.x.primal(), at.y.primal())
    };
    // A fixed shuffle: neighbours in a row are the worst order.
    let mut state = 0x9e37_79b9_u32;
    for k in (1..hull.len()).rev() {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        hull.swap(k, (state >> 8) as usize % (k + 1));
    }
    let &first = hull.first()?;
    let slack = S::Primal::lit(1.0 + 8.0 * S::format().epsilon());
    let outside = |support: Support, k: usize| {
        let circle = local(support, place);
        let reach = circle.center.squared_distance(place(k));
        reach.above(circle.radius * circle.radius * slack)
    };
    let mut support = Support::One(first);
    for (i, &p) in hull.iter().enumerate() {
        if !outside(support, p) {
            continue;
        }
        support = Support::One(p);
        for (j, &q) in hull[..i].iter().enumerate() {
            if !outside(support, q) {
                continue;
            }
            support = Support::Two([p, q]);
            for &r in &hull[..j] {
                if outside(support, r) {
                    support = Support::Three([p, q, r]);
                }
            }
        }
    }
    let support = match support {
        Support::One(k) => Support::One(k),
        Support::Two([p, q]) => Support::Two([p.min(q), p.max(q)]),
        Support::Three(mut three) => {
            three.sort_unstable();
            Support::Three(three)
        }
    };
    Some((circle_replay(points, support), support))
}

/// Returns the circle through one, two or three points.
fn local<S: Scalar>(support: Support, place: impl Fn(usize) -> Vec2<S>) -> Circle<S> {
    match support {
        Support::One(p) => Circle {
            center: place(p),
            radius: S::zero(),
        },
        Support::Two([p, q]) => {
            let half = place(q) - place(p);
            let half = Vec2::new(half.x.halved(), half.y.halved());
            Circle {
                center: place(p) + half,
                radius: half.length(),
            }
        }
        Support::Three([p, q, r]) => {
            let (start, to_q, to_r) = (place(p), place(q) - place(p), place(r) - place(p));
            let twice = to_q.perp_dot(to_r);
            let twice = twice + twice;
            let flat = twice.equals(S::zero());
            let per = S::one().over(S::select(flat, S::one(), twice));
            let (square_q, square_r) = (to_q.length_squared(), to_r.length_squared());
            let at = Vec2::new(
                to_r.y * square_q - to_q.y * square_r,
                to_q.x * square_r - to_r.x * square_q,
            ) * S::select(flat, S::zero(), per);
            Circle {
                center: start + at,
                radius: at.length(),
            }
        }
    }
}

/// Returns the circle that a record's points decide, with derivatives to those: for two, half their distance and
/// their middle; for three, the circle through them (the triangle's circumcircle).
///
/// # Panics
///
/// When the record has an index beyond the points.
#[must_use]
pub fn circle_replay<S: Scalar>(points: &[Vec2<S>], record: Support) -> Circle<S> {
    let seen = match record {
        Support::One(p) => Reference::of_ring(&[points[p]]),
        Support::Two(all) => Reference::of_ring(&all.each_as(|k| points[k])),
        Support::Three(all) => Reference::of_ring(&all.each_as(|k| points[k])),
    };
    let Circle { center, radius } = local(record, |k| seen.place(points[k]));
    Circle {
        center: seen.outer_place(center).canonical(),
        radius: seen.outer(radius).saturated().canonical(),
    }
}
