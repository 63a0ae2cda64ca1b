//! Cells of sites: areas by enumeration, tilings, derivatives, ties, hard inputs, errors.
use super::cases::at;
use super::cell_oracle;
use geograd::ad::adjoint::cells::{areas_vjp, centroids_vjp, moments_vjp};
use geograd::cells::{CellBorder, CellMoments, PowerDiagram};
use geograd::error::{Argument, Field, Flaw, VertexFault};
use geograd::polygon::{self, Rings};
use geograd::{Aabb2, Error, Polygon, Vec2};
use geograd_tests::Dice;
use num_dual::Dual64;

type Sites = Vec<Vec2<f64>>;

fn near(found: f64, expected: f64, by: f64) {
    let size = 1.0 + expected.abs();
    assert!((found - expected).abs() <= by * size, "{found} {expected}");
}
fn on(rings: &[Vec<[i64; 2]>]) -> Polygon<f64> {
    let place = |&[x, y]: &[i64; 2]| at(x as f64, y as f64);
    let rings: Vec<Sites> = rings
        .iter()
        .map(|ring| ring.iter().map(place).collect())
        .collect();
    Polygon::from_rings(rings.iter().map(Vec::as_slice))
}
/// A square, a notched one, one with a hole, and all of it twice with rings of other orientations.
fn domains() -> Vec<Polygon<f64>> {
    let square = vec![[0, 0], [10, 0], [10, 10], [0, 10]];
    let notched = [0, 0, 10, 0, 10, 10, 6, 10, 6, 3, 4, 3, 4, 10, 0, 10];
    let notched = notched.chunks(2).map(|v| [v[0], v[1]]).collect();
    let hole = vec![[3, 3], [7, 4], [6, 7], [3, 6]];
    let part = vec![[20, 0], [25, 10], [30, 0]];
    let turned: Vec<[i64; 2]> = square.iter().rev().copied().collect();
    vec![
        on(std::slice::from_ref(&square)),
        on(&[notched]),
        on(&[square, hole.clone()]),
        on(&[turned, hole, part]),
    ]
}
fn spread(dice: &mut Dice, count: usize) -> Sites {
    let mut place = || at(dice.within(-1.0, 11.0), dice.within(-1.0, 11.0));
    (0..count).map(|_| place()).collect()
}
/// The centres of equal squares that tile one of side 10.
fn lattice(count: usize) -> Sites {
    let step = 10.0 / count as f64;
    let place = |k: usize| (k as f64 + 0.5) * step;
    let all = (0..count * count).map(|k| at(place(k % count), place(k / count)));
    all.collect()
}

#[test]
fn areas_are_those_of_enumeration() {
    let mut dice = Dice(5);
    let square = vec![[0, 0], [6, 0], [6, 6], [0, 6]];
    let pentagon = vec![[0, 0], [5, -1], [8, 3], [4, 7], [-1, 4]];
    let diamond = vec![[3, 2], [4, 3], [3, 4], [2, 3]];
    let domains = [vec![square.clone()], vec![pentagon], vec![square, diamond]];
    let mut hidden = 0;
    for round in 0..1500 {
        let domain = &domains[round % 3];
        let count = 1 + dice.below(9);
        // On the border, outside, on circles, on lines, at one place.
        let mut number = |low: f64, high: f64| dice.within(low, high).floor() as i64;
        let sites: Vec<[i64; 2]> = (0..count)
            .map(|_| [number(-1.0, 8.0), number(-1.0, 8.0)])
            .collect();
        let most = [0.5, 2.0, 30.0][round / 3 % 3];
        let weights: Vec<i64> = (0..count).map(|_| number(-most, most)).collect();
        let expected = cell_oracle::areas(&sites, &weights, domain);
        let places: Sites = sites.iter().map(|&[x, y]| at(x as f64, y as f64)).collect();
        let numbers: Vec<f64> = weights.iter().map(|&w| w as f64).collect();
        let domain = on(domain);
        let diagram = PowerDiagram::new(&places, &numbers, &domain).unwrap();
        let trace = diagram.search();
        let found = diagram.cells(&trace).areas();
        for (i, (found, expected)) in found.iter().zip(&expected).enumerate() {
            assert!(
                (found - expected).abs() <= 1e-13 * 36.0,
                "{sites:?} {weights:?} {domain:?}: cell {i} has {found}, not {expected}"
            );
            hidden += usize::from(trace.is_hidden(i));
        }
    }
    assert!(hidden > 100, "{hidden}");
}

#[test]
fn cells_tile_the_domain() {
    let mut dice = Dice(1);
    for domain in domains() {
        let whole = polygon::area(&domain);
        let inertia = {
            let own = polygon::second_moments(&domain);
            own.xx + own.yy
        };
        let middle = polygon::centroid(&domain);
        for count in [1, 2, 3, 17, 300] {
            for heaviest in [0.0, 0.1, 3.0, 1e4] {
                let sites = spread(&mut dice, count);
                let weights: Vec<f64> = sites.iter().map(|_| dice.roll() * heaviest).collect();
                let diagram = PowerDiagram::new(&sites, &weights, &domain).unwrap();
                let trace = diagram.search();
                let cells = diagram.cells(&trace);
                near(cells.areas().iter().sum(), whole, 1e-14);
                // Moments about the domain's centroid add up, too.
                let about = |(own, &site): (&CellMoments<f64>, &Vec2<f64>)| {
                    let way = site - middle;
                    own.second + 2.0 * own.first.dot(way) + own.area * way.length_squared()
                };
                let found: f64 = cells.moments().iter().zip(&sites).map(about).sum();
                near(found, inertia, 1e-12);
            }
        }
    }
}

#[test]
fn polygons_and_sides_have_the_measures_of_cells() {
    let mut dice = Dice(2);
    for domain in domains() {
        let sites = spread(&mut dice, 60);
        let diagram = PowerDiagram::new(&sites, &[], &domain).unwrap();
        let trace = diagram.search();
        let cells = diagram.cells(&trace);
        for (i, own) in cells.moments().iter().enumerate() {
            let polygon = cells.polygon(i);
            near(polygon::signed_area(&polygon), own.area, 1e-13);
            assert_eq!(polygon.rings().count() == 0, trace.is_hidden(i));
            for side in cells.sides(i) {
                let CellBorder::Site(j) = side.border else {
                    continue;
                };
                // Both sites are as far from each end, and each names the other.
                for end in [side.from, side.to] {
                    near((end - sites[i]).length(), (end - sites[j]).length(), 1e-12);
                }
                assert!(trace.neighbours(j).contains(&i), "{i} {j}");
            }
        }
        for (centroid, own) in cells.centroids().iter().zip(0..) {
            if !trace.is_hidden(own) && cells.polygon(own).rings().count() == 1 {
                let expected = polygon::centroid(&cells.polygon(own));
                near(centroid.x, expected.x, 1e-10);
                near(centroid.y, expected.y, 1e-10);
            }
        }
    }
}

/// What a diagram becomes when everything moves along a direction.
struct Moving {
    sites: Vec<Vec2<Dual64>>,
    weights: Vec<Dual64>,
    domain: Polygon<Dual64>,
}
struct Direction {
    sites: Sites,
    weights: Vec<f64>,
    domain: Sites,
}
fn direction(dice: &mut Dice, sites: usize, vertices: usize) -> Direction {
    let mut number = || dice.within(-1.0, 1.0);
    Direction {
        sites: (0..sites).map(|_| at(number(), number())).collect(),
        weights: (0..sites).map(|_| number()).collect(),
        domain: (0..vertices).map(|_| at(number(), number())).collect(),
    }
}
fn moving(sites: &[Vec2<f64>], weights: &[f64], domain: &Polygon<f64>, way: &Direction) -> Moving {
    let lift = |v: &[Vec2<f64>], way: &[Vec2<f64>]| -> Vec<Vec2<Dual64>> {
        let both = v.iter().zip(way);
        both.map(|(v, by)| Vec2::new(Dual64::new(v.x, by.x), Dual64::new(v.y, by.y)))
            .collect()
    };
    let vertices = lift(domain.vertices(), &way.domain);
    Moving {
        sites: lift(sites, &way.sites),
        weights: weights
            .iter()
            .zip(&way.weights)
            .map(|(&w, &by)| Dual64::new(w, by))
            .collect(),
        domain: Rings::flat(&vertices, domain.ends()).to_polygon(),
    }
}

#[test]
fn adjoints_and_hessians_are_those_of_duals() {
    let mut dice = Dice(3);
    for domain in domains() {
        for (count, heaviest) in [(1, 1.0), (2, 1.0), (40, 0.0), (40, 2.0), (150, 1.0)] {
            for sites in [spread(&mut dice, count), lattice(count.min(9))] {
                let weights: Vec<f64> = sites.iter().map(|_| dice.roll() * heaviest).collect();
                let diagram = PowerDiagram::new(&sites, &weights, &domain).unwrap();
                let trace = diagram.search();
                let cells = diagram.cells(&trace);
                let mut way = direction(&mut dice, sites.len(), domain.vertices().len());
                let moved = moving(&sites, &weights, &domain, &way);
                let along = PowerDiagram::new(&moved.sites, &moved.weights, &moved.domain);
                let along = along.unwrap();
                let along = along.cells(&trace);

                let mut number = || dice.within(-1.0, 1.0);
                let bars: Vec<CellMoments<f64>> = sites
                    .iter()
                    .map(|_| CellMoments {
                        area: number(),
                        first: at(number(), number()),
                        second: number() / 10.0,
                    })
                    .collect();
                let by_duals: f64 = along
                    .moments()
                    .iter()
                    .zip(&bars)
                    .map(|(own, bar)| {
                        let first = own.first.x.eps * bar.first.x + own.first.y.eps * bar.first.y;
                        own.area.eps * bar.area + first + own.second.eps * bar.second
                    })
                    .sum();
                let back = moments_vjp(&cells, &bars);
                let pushed = |bars: &[Vec2<f64>], way: &[Vec2<f64>]| -> f64 {
                    bars.iter().zip(way).map(|(bar, way)| bar.dot(*way)).sum()
                };
                let weighed = |bars: &[f64]| -> f64 {
                    bars.iter()
                        .zip(&way.weights)
                        .map(|(bar, way)| bar * way)
                        .sum()
                };
                let size = back.sites.iter().map(|bar| bar.length()).sum::<f64>();
                let found = pushed(&back.sites, &way.sites)
                    + weighed(&back.weights)
                    + pushed(&back.domain, &way.domain);
                assert!(
                    (found - by_duals).abs() <= 1e-12 * (1.0 + size),
                    "{found} {by_duals}"
                );

                let bars: Sites = sites.iter().map(|_| at(number(), number())).collect();
                let by_duals: f64 = along
                    .centroids()
                    .iter()
                    .zip(&bars)
                    .map(|(own, bar)| own.x.eps * bar.x + own.y.eps * bar.y)
                    .sum();
                let back = centroids_vjp(&cells, &bars);
                let found = pushed(&back.sites, &way.sites)
                    + weighed(&back.weights)
                    + pushed(&back.domain, &way.domain);
                near(found, by_duals, 1e-9);

                // The energy's gradient by sites and weights, and its Hessian along the direction.
                way.domain = vec![at(0.0, 0.0); way.domain.len()];
                let moved = moving(&sites, &weights, &domain, &way);
                let along = PowerDiagram::new(&moved.sites, &moved.weights, &moved.domain);
                let along = along.unwrap();
                let along = along.cells(&trace);
                let moments = cells.moments();
                let gradient: f64 = moments
                    .iter()
                    .enumerate()
                    .map(|(i, own)| -2.0 * own.first.dot(way.sites[i]) - own.area * way.weights[i])
                    .sum();
                near(along.energy().eps, gradient, 1e-11);
                let mut product = vec![[0.0; 3]; sites.len()];
                for (i, j, block) in cells.energy_hessian() {
                    let by = [way.sites[j].x, way.sites[j].y, way.weights[j]];
                    for (to, row) in product[i].iter_mut().zip(block) {
                        *to += row.iter().zip(by).map(|(x, by)| x * by).sum::<f64>();
                    }
                }
                for (own, product) in along.moments().iter().zip(product) {
                    let expected = [
                        -2.0 * own.first.x.eps,
                        -2.0 * own.first.y.eps,
                        -own.area.eps,
                    ];
                    for (found, expected) in product.into_iter().zip(expected) {
                        near(found, expected, 1e-10);
                    }
                }
            }
        }
    }
}

#[test]
fn derivatives_are_those_of_differences() {
    let mut dice = Dice(4);
    for domain in domains() {
        let sites = spread(&mut dice, 12);
        let weights: Vec<f64> = sites.iter().map(|_| dice.roll()).collect();
        let bars: Vec<f64> = sites.iter().map(|_| dice.within(-1.0, 1.0)).collect();
        let value = |sites: &[Vec2<f64>], weights: &[f64]| -> f64 {
            let diagram = PowerDiagram::new(sites, weights, &domain).unwrap();
            let areas = diagram.cells(&diagram.search()).areas();
            areas.iter().zip(&bars).map(|(area, bar)| area * bar).sum()
        };
        let diagram = PowerDiagram::new(&sites, &weights, &domain).unwrap();
        let found = areas_vjp(&diagram.cells(&diagram.search()), &bars);
        let step = 1e-6;
        for i in 0..sites.len() {
            for (k, found) in [found.sites[i].x, found.sites[i].y].into_iter().enumerate() {
                let moved = |by: f64| {
                    let mut all = sites.clone();
                    all[i] += if k == 0 { at(by, 0.0) } else { at(0.0, by) };
                    value(&all, &weights)
                };
                near((moved(step) - moved(-step)) / (2.0 * step), found, 1e-6);
            }
            let moved = |by: f64| {
                let mut all = weights.clone();
                all[i] += by;
                value(&sites, &all)
            };
            near(
                (moved(step) - moved(-step)) / (2.0 * step),
                found.weights[i],
                1e-6,
            );
        }
    }
}

#[test]
fn area_slopes_are_a_symmetric_matrix_without_sum() {
    let mut dice = Dice(6);
    for domain in domains() {
        for sites in [spread(&mut dice, 80), lattice(8)] {
            let weights: Vec<f64> = sites.iter().map(|_| dice.roll()).collect();
            let diagram = PowerDiagram::new(&sites, &weights, &domain).unwrap();
            let trace = diagram.search();
            let slopes = diagram.cells(&trace).area_slopes();
            assert!(
                slopes
                    .windows(2)
                    .all(|two| (two[0].0, two[0].1) < (two[1].0, two[1].1))
            );
            let mut sums = vec![0.0; sites.len()];
            for &(i, j, slope) in &slopes {
                sums[i] += slope;
                let place = slopes.binary_search_by_key(&(j, i), |&(i, j, _)| (i, j));
                near(slopes[place.expect("has both")].2, slope, 1e-12);
            }
            sums.into_iter().for_each(|sum| near(sum, 0.0, 1e-12));
        }
    }
}

#[test]
fn equal_sites_share_a_cell_and_its_slopes() {
    let domain = Aabb2::new(0.0, 0.0, 4.0, 2.0).corners();
    let sites = [at(1.0, 1.0), at(3.0, 1.0), at(1.0, 1.0), at(1.0, 1.0)];
    let weights = [0.0, 0.0, 0.0, -1.0];
    let diagram = PowerDiagram::new(&sites, &weights, &domain).unwrap();
    let trace = diagram.search();
    let cells = diagram.cells(&trace);
    assert_eq!(cells.areas(), [2.0, 4.0, 2.0, 0.0]);
    assert_eq!([0, 1, 2, 3].map(|i| trace.first(i)), [0, 1, 0, 3]);
    assert_eq!(
        [0, 1, 2, 3].map(|i| trace.is_hidden(i)),
        [false, false, false, true]
    );
    assert_eq!(cells.polygon(2), cells.polygon(0));
    // The side between both cells has the length 2 and the distance 2: the weight of a half moves by a half.
    let found = areas_vjp(&cells, &[1.0, 0.0, 0.0, 0.0]);
    for (found, expected) in found.weights.iter().zip([0.125, -0.25, 0.125, 0.0]) {
        near(*found, expected, 1e-15);
    }
    assert_eq!(found.sites[0], found.sites[2]);

    // The energy's slope by one of them is the mean of both sides.
    let energy = |by: Vec2<f64>| {
        let mut moved = sites;
        moved[0] += by;
        let diagram = PowerDiagram::new(&moved, &weights, &domain).unwrap();
        diagram.cells(&diagram.search()).energy()
    };
    let (step, here) = (1e-6, energy(at(0.0, 0.0)));
    let slope = cells.moments()[0].first * -2.0;
    for (way, slope) in [(at(step, 0.0), slope.x), (at(0.0, step), slope.y)] {
        let right = (energy(way) - here) / step;
        let left = (here - energy(way * -1.0)) / step;
        assert!(
            right.max(left) - right.min(left) > 0.5,
            "a kink: {left} {right}"
        );
        near((left + right) / 2.0, slope, 1e-5);
    }
}

#[test]
fn bisectors_along_edges_of_the_domain_lose_nothing() {
    // The bisector of both runs along the notch's right side, in either order.
    let domain = &domains()[1];
    for order in [[0, 1], [1, 0]] {
        let all = [at(5.0, 6.0), at(7.0, 6.0)];
        let sites = order.map(|k| all[k]);
        let diagram = PowerDiagram::new(&sites, &[], domain).unwrap();
        let trace = diagram.search();
        let cells = diagram.cells(&trace);
        let areas = cells.areas();
        assert_eq!(order.map(|k| areas[k]), [46.0, 40.0]);
        let sum = areas_vjp(&cells, &[1.0, 1.0]);
        for (bar, weight) in sum.sites.iter().zip(&sum.weights) {
            near(bar.length(), 0.0, 1e-13);
            near(*weight, 0.0, 1e-13);
        }
        let way = Direction {
            sites: vec![at(0.5, 0.25), at(-1.0, 2.0)],
            weights: vec![],
            domain: vec![at(0.0, 0.0); 8],
        };
        let moved = moving(&sites, &[], domain, &way);
        let along = PowerDiagram::new(&moved.sites, &[], &moved.domain).unwrap();
        let expected: f64 = (0..2)
            .map(|i| -2.0 * cells.moments()[i].first.dot(way.sites[i]))
            .sum();
        near(along.cells(&trace).energy().eps, expected, 1e-13);
    }
}

#[test]
fn near_sites_far_origins_and_other_sizes_are_exact() {
    let mut dice = Dice(7);
    let domain = &domains()[0];
    // Pairs that nearly coincide.
    for gap in [1e-6, 1e-9, 1e-12, 2e-15] {
        let mut sites = spread(&mut dice, 25);
        let twins: Sites = sites.iter().map(|&v| v + at(gap, -gap / 3.0)).collect();
        sites.extend(twins);
        let diagram = PowerDiagram::new(&sites, &[], domain).unwrap();
        let cells = diagram.search();
        let areas = diagram.cells(&cells).areas();
        near(areas.iter().sum(), 100.0, 1e-14);
        assert!(areas.iter().all(|&area| area >= -1e-12));
    }
    // Powers of two change no digit.
    let sites = spread(&mut dice, 40);
    let weights: Vec<f64> = sites.iter().map(|_| dice.roll()).collect();
    let diagram = PowerDiagram::new(&sites, &weights, domain).unwrap();
    let areas = diagram.cells(&diagram.search()).areas();
    for power in [-140, -30, 30, 140] {
        let by = 2.0_f64.powi(power);
        let scaled = |v: &[Vec2<f64>]| -> Sites { v.iter().map(|&v| v * by).collect() };
        let (sites, corners) = (scaled(&sites), scaled(domain.vertices()));
        let weights: Vec<f64> = weights.iter().map(|w| w * by * by).collect();
        let diagram = PowerDiagram::new(&sites, &weights, &corners).unwrap();
        let found = diagram.cells(&diagram.search()).areas();
        assert!(found.iter().zip(&areas).all(|(x, y)| *x == y * by * by));
    }
    // Far from the origin sites and domain are rounded, the cells of what they are then are exact.
    let far = at(3e8, -7e8);
    let moved = |v: &[Vec2<f64>]| -> Sites { v.iter().map(|&v| v + far).collect() };
    let (away, corners) = (moved(&sites), moved(domain.vertices()));
    let diagram = PowerDiagram::new(&away, &weights, &corners).unwrap();
    let found = diagram.cells(&diagram.search()).areas();
    let back: Sites = away.iter().map(|&v| v - far).collect();
    let diagram = PowerDiagram::new(&back, &weights, domain).unwrap();
    let expected = diagram.cells(&diagram.search()).areas();
    for (found, expected) in found.iter().zip(expected) {
        near(*found, expected, 1e-12);
    }
    // Single precision decides as double precision does.
    let small: Vec<Vec2<f32>> = sites
        .iter()
        .map(|v| Vec2::new(v.x as f32, v.y as f32))
        .collect();
    let corners: Vec<Vec2<f32>> = domain
        .vertices()
        .iter()
        .map(|v| Vec2::new(v.x as f32, v.y as f32))
        .collect();
    let diagram = PowerDiagram::new(&small, &[], &corners).unwrap();
    let found = diagram.cells(&diagram.search()).areas();
    let wide: Sites = small.iter().map(|v| at(v.x.into(), v.y.into())).collect();
    let diagram = PowerDiagram::new(&wide, &[], domain).unwrap();
    let expected = diagram.cells(&diagram.search()).areas();
    for (found, expected) in found.iter().zip(expected) {
        near((*found).into(), expected, 4e-5);
    }
}

#[test]
fn lattices_and_circles_have_equal_cells() {
    let domain = &domains()[0];
    for count in [1, 2, 7, 30] {
        let sites = lattice(count);
        let diagram = PowerDiagram::new(&sites, &[], domain).unwrap();
        let trace = diagram.search();
        let cells = diagram.cells(&trace);
        let expected = 100.0 / (count * count) as f64;
        cells
            .areas()
            .iter()
            .for_each(|&area| near(area, expected, 1e-13));
        // By symmetry nothing but the border's cells has a slope of its own area by its own site.
        let bars = areas_vjp(&cells, &vec![1.0; sites.len()]);
        bars.sites
            .iter()
            .for_each(|bar| near(bar.length(), 0.0, 1e-12));
    }
    let turn = |k: usize| (k as f64 * std::f64::consts::TAU / 64.0).sin_cos();
    let mut sites: Sites = (0..64)
        .map(|k| at(5.0 + 3.0 * turn(k).1, 5.0 + 3.0 * turn(k).0))
        .collect();
    sites.push(at(5.0, 5.0));
    let diagram = PowerDiagram::new(&sites, &[], domain).unwrap();
    let areas = diagram.cells(&diagram.search()).areas();
    near(areas.iter().sum(), 100.0, 1e-14);
    // The middle one is a regular polygon of 64 sides about a circle of the radius 1.5.
    let expected = 64.0 * 1.5 * 1.5 * (std::f64::consts::PI / 64.0).tan();
    near(areas[64], expected, 1e-13);
    // All on a line.
    let sites: Sites = (0..20)
        .map(|k| at(0.25 + f64::from(k) / 2.0, 3.0))
        .collect();
    let diagram = PowerDiagram::new(&sites, &[], domain).unwrap();
    let areas = diagram.cells(&diagram.search()).areas();
    areas.iter().for_each(|&area| near(area, 5.0, 1e-13));
}

#[test]
fn nothing_and_bad_input() {
    let square = Aabb2::new(0.0, 0.0, 1.0, 1.0).corners();
    let none = PowerDiagram::<f64>::new(&[], &[], &square).unwrap();
    assert!(none.search().is_empty());
    assert!(none.cells(&none.search()).areas().is_empty());
    // A domain without rings has no area.
    let sites = [at(0.0, 0.0), at(1.0, 0.0)];
    let empty = PowerDiagram::new(&sites, &[], Rings::flat(&[], &[])).unwrap();
    assert_eq!(empty.cells(&empty.search()).areas(), [0.0; 2]);
    // A flat domain has none, either.
    let flat = [at(0.0, 0.0), at(2.0, 2.0), at(1.0, 1.0)];
    let diagram = PowerDiagram::new(&sites, &[], &flat).unwrap();
    let areas = diagram.cells(&diagram.search()).areas();
    areas.iter().for_each(|&area| near(area, 0.0, 1e-15));

    let invalid = |argument, item, flaw| Error::Invalid {
        argument: Argument::Named(argument),
        item,
        flaw,
    };
    let error = |sites: &[Vec2<f64>], weights: &[f64], domain: &[Vec2<f64>]| {
        PowerDiagram::new(sites, weights, domain).unwrap_err()
    };
    let expected = Error::Length {
        argument: Argument::Named("weights"),
        expected: 2,
        found: 1,
    };
    assert_eq!(error(&sites, &[1.0], &square), expected);
    let nan = [at(0.0, 0.0), at(0.0, f64::NAN)];
    let flaw = Flaw::NotFinite(Field::new("y"));
    assert_eq!(error(&nan, &[], &square), invalid("sites", 1, flaw));
    let flaw = Flaw::NotFinite(Field::VALUE);
    assert_eq!(
        error(&sites, &[0.0, f64::INFINITY], &square),
        invalid("weights", 1, flaw)
    );
    let flaw = Flaw::Ring {
        ring: 0,
        index: 2,
        fault: VertexFault::Missing,
    };
    assert_eq!(error(&sites, &[], &square[..2]), invalid("domain", 0, flaw));
}
