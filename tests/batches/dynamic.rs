//! The untyped face gives the bits of the typed one, for every row; what it refuses, it refuses by name.
use crate::rows::{Number, bits};
use geograd::ad::check::sample::Draw;
use geograd::error::{Argument, Field};
use geograd::kernels::dynamic::{
    Bound, Elementary, Function, Layout, Mode, Operation, Program, Rows, Sort, Symbol, Tracing,
    operation, operations, symbol,
};
use geograd::kernels::{Cpu, Op, fold::fold};
use geograd::{
    Error, Fixed, Flaw, Jet, Obb2, Pack, Pose2, Real, Scalar, Segment2, Unrecordable, Vec2, ad,
};
use geograd_tests::list;
use geograd_tests::rows::{IouObb2, MoveSegment, SignedDistancePointRing};

fn path<T: Copy>(numbers: &[T]) -> Vec<Vec2<T>> {
    numbers
        .chunks_exact(2)
        .map(|v| Vec2 { x: v[0], y: v[1] })
        .collect()
}

/// Bits of numbers, of which zeros have no sign.
fn bits_of<T: Into<f64> + Copy>(x: &[T]) -> Vec<u64> {
    x.iter().map(|&x| (x.into() + 0.0).to_bits()).collect()
}

/// Row by row of several columns, one after another.
fn by_item<T: Copy>(lists: &[Vec<T>], count: usize) -> Vec<Vec<T>> {
    let width = |list: &Vec<T>| list.len() / count;
    let row = |i: usize| {
        let lists = lists.iter();
        lists
            .flat_map(|x| x[i * width(x)..(i + 1) * width(x)].to_vec())
            .collect()
    };
    (0..count).map(row).collect()
}

#[test]
fn every_path_has_the_bits_of_its_function() {
    fn of<T: Number>() {
        for row in list::rows() {
            let operation = &row.operation;
            let Some(on_paths) = operation.on_paths::<T>() else {
                continue;
            };
            let (name, mut draw) = (row.name(), Draw::new(9));
            let wide: usize = on_paths.takes().iter().map(|x| x.1.fields()).sum();
            let (mut context, mut vertices, mut offsets) = (Vec::new(), Vec::new(), vec![0]);
            let mut items = Vec::new();
            for _ in 0..20 {
                let item: Vec<T> = row.random(&mut draw).into_iter().map(T::lit).collect();
                context.extend_from_slice(&item[..wide]);
                vertices.extend_from_slice(&item[wide..]);
                offsets.push(vertices.len() / on_paths.vertex());
                items.push(item);
            }
            let rows = if wide > 0 {
                vec![Rows::new(&context, wide)]
            } else {
                Vec::new()
            };
            let values = on_paths.values(&rows, &vertices, &offsets).expect(name);
            let mut expected = Vec::new();
            for item in &items {
                expected.extend(row.alone(item));
            }
            assert_eq!(bits_of(&values), bits_of(&expected), "{name}");
            let mut into = vec![T::one(); values.len()];
            on_paths
                .values_into(&rows, &vertices, &offsets, &mut into)
                .expect(name);
            assert_eq!(bits_of(&into), bits_of(&values), "{name}");

            // Recorded for one length, its derivatives are those of the batch but for rounding.
            let bars = vec![T::lit(0.5); values.len()];
            let (contexts, by_vertex) =
                on_paths.vjp(&rows, &vertices, &offsets, &bars).expect(name);
            assert_eq!(contexts.len(), rows.len());
            let long = items
                .iter()
                .position(|item| item.len() > wide + 3 * on_paths.vertex())
                .expect("a path");
            let program = operation
                .program_of_path::<T>((items[long].len() - wide) / on_paths.vertex())
                .expect(name);
            let given = [&items[long][..], &vec![T::lit(0.5); on_paths.gives()]].concat();
            let derivatives = program.vjp().expect(name).eval(&given).expect(name);
            let size = derivatives
                .iter()
                .map(|&x| x.into().abs())
                .fold(0.0, f64::max);
            let vertex = on_paths.vertex();
            let found = &by_vertex[vertex * offsets[long]..vertex * offsets[long + 1]];
            for (&x, &y) in found.iter().zip(&derivatives[wide..]) {
                let (x, y): (f64, f64) = (x.into(), y.into());
                assert!(
                    (x - y).abs() <= 256.0 * T::format().epsilon() * size,
                    "{name}: {x} {y}"
                );
            }
        }
    }
    of::<f64>();
    of::<f32>();
    assert_eq!(
        operation("signed_area").map(|x| x.value::<f64>().is_some()),
        Some(false)
    );
}

#[test]
fn rows_say_what_they_are() {
    for operation in operations() {
        let name = operation.name;
        let summary = operation.summary();
        assert!(
            !summary.is_empty() && !summary.contains("](") && !summary.contains('`'),
            "{name}: {summary}"
        );
        assert!(!operation.verb().is_empty(), "{name}");
        let shapes: Vec<_> = operation
            .arguments()
            .into_iter()
            .map(|x| (Some(x.name), x.shape))
            .collect();
        let all = shapes
            .into_iter()
            .chain(operation.result().into_iter().map(|shape| (None, shape)));
        for (argument, shape) in all {
            assert!(
                !shape.fields.is_empty() && !shape.name.contains("f64"),
                "{name}: {}",
                shape.name
            );
            if let Some(argument) = argument {
                assert!(matches!(argument, Argument::Named(_)), "{name}: {argument}");
            }
        }
    }
    let iou = operation("iou_obb2").expect("is listed");
    let [a, b] = &iou.arguments()[..] else {
        panic!("two boxes")
    };
    assert_eq!(
        (a.name, b.name),
        (Argument::Named("a"), Argument::Named("b"))
    );
    assert_eq!(a.shape.name, "Obb2");
    let fields: Vec<_> = a
        .shape
        .fields
        .iter()
        .map(|x| (x.name.to_string(), x.bound))
        .collect();
    let expected = [
        ("x", Bound::Any),
        ("y", Bound::Any),
        ("width", Bound::NotNegative),
        ("height", Bound::NotNegative),
        ("heading", Bound::Any),
    ];
    assert_eq!(
        fields,
        expected.map(|(name, bound)| (name.to_owned(), bound))
    );
    assert_eq!(
        (iou.verb().as_str(), iou.summary()),
        (
            "iou",
            "Intersection over union of two rotated boxes, 0 to 1.".to_owned()
        )
    );
    let distance = operation("distance_point_segment").expect("is listed");
    let names: Vec<_> = distance
        .arguments()
        .iter()
        .map(|x| x.name.to_string())
        .collect();
    assert_eq!(names, ["point", "segment"]);
    let interval = operation("iou_aabb2").expect("is listed").arguments()[0]
        .shape
        .fields[0];
    assert_eq!(interval.bound, Bound::AtMost(2));
    assert_eq!(
        operation("move_segment").expect("is listed").result()[0].name,
        "Segment2"
    );
}

/// Three boxes.
const BOXES: [f64; 15] = [
    0.0, 0.0, 2.0, 2.0, 0.0, 5.0, 5.0, 1.0, 3.0, 0.7, 1.0, 0.5, 4.0, 1.0, -0.3,
];
/// Two others.
const TRUTHS: [f64; 10] = [1.0, 0.0, 2.0, 2.0, 0.0, 5.0, 4.0, 2.0, 2.0, 0.1];

fn boxes(numbers: &[f64]) -> Vec<Obb2<f64>> {
    numbers.chunks_exact(5).map(Obb2::load).collect()
}
fn iou(mode: Mode) -> Function<f64> {
    let iou = operation("iou_obb2").expect("is listed");
    iou.function(mode).expect("is of fixed size")
}

#[test]
fn several_numbers_have_no_one_gradient() {
    let several = |row: &&Operation| {
        row.sort == Sort::Straight && row.value::<f64>().is_some_and(|x| x.gives() != [1])
    };
    let rows: Vec<&Operation> = operations().iter().filter(several).collect();
    assert!(rows.len() > 20);
    for row in rows {
        assert!(
            row.function::<f64>(Mode::ValueGrad).is_none(),
            "{}",
            row.name
        );
    }
}

#[test]
fn one_row_stands_for_all() {
    let all = [Rows::new(&BOXES, 5), Rows::one(&TRUTHS[..5])];
    let found = iou(Mode::ValueGrad).aligned(&all).unwrap();
    let one = geograd::kernels::One(boxes(&TRUTHS)[0]);
    let (value, (by_a, by_b)) = Cpu::new()
        .aligned(IouObb2.value_grad(), (&boxes(&BOXES), one))
        .unwrap();
    assert_eq!(found[0], value);
    assert_eq!(
        found[1],
        by_a.iter().flat_map(Pack::scalars).collect::<Vec<_>>()
    );
    assert_eq!(
        found[2],
        by_b.iter().flat_map(Pack::scalars).collect::<Vec<_>>()
    );
    // One of each is one result.
    let ones = [Rows::one(&BOXES[..5]), Rows::one(&TRUTHS[..5])];
    assert_eq!(iou(Mode::Value).aligned(&ones).unwrap()[0].len(), 1);

    let (mut value, mut derivatives) = (vec![9.0; 3], vec![9.0; 15]);
    iou(Mode::ValueGrad)
        .aligned_into(&all, &mut [Some(&mut value), None, Some(&mut derivatives)])
        .unwrap();
    assert_eq!((&value, &derivatives), (&found[0], &found[2]));
}

#[test]
fn a_flaw_far_down_is_the_same_error_in_new_arrays_and_in_old_ones() {
    // A program checks the numbers of a stretch just before it computes them, where results are new.
    let row = operation("distance_point_segment").expect("is listed");
    let distance = row.value::<f32>().expect("is listed");
    let mut draw = Draw::new(11);
    let numbers: Vec<f32> = (0..6 * 5000).map(|_| draw.unit() as f32).collect();
    let (points, segments) = numbers.split_at(2 * 5000);
    let found = distance
        .aligned(&[Rows::new(points, 2), Rows::new(segments, 4)])
        .unwrap();
    for item in [0, 2047, 2048, 4999] {
        let mut wrong = segments.to_vec();
        wrong[4 * item + 3] = f32::NAN;
        let rows = [Rows::new(points, 2), Rows::new(&wrong, 4)];
        let error = Error::Invalid {
            argument: Argument::named("segment"),
            item,
            flaw: Flaw::NotFinite(Segment2::<f32>::name(3)),
        };
        assert_eq!(distance.aligned(&rows).err(), Some(error));
        let mut old = vec![7.0_f32; 5000];
        let refused = distance.aligned_into(&rows, &mut [Some(&mut old)]);
        assert_eq!(refused, Err(error));
        assert!(old.iter().all(|&x| x == 7.0));
        let refused = distance.aligned_into_new(&rows, &mut [Some(&mut old)]);
        assert_eq!(refused, Err(error));
        // Stretches without a flaw may be there.
        let whole = [Rows::new(points, 2), Rows::new(segments, 4)];
        distance
            .aligned_into_new(&whole, &mut [Some(&mut old)])
            .unwrap();
        assert_eq!(old, found[0]);
    }
}

#[test]
fn all_pairs_and_reductions_are_those_of_the_typed_face() {
    let (a, b) = (boxes(&BOXES), boxes(&TRUTHS));
    let (rows, columns) = (Rows::new(&BOXES, 5), Rows::new(&TRUTHS, 5));
    let (cpu, value) = (Cpu::new(), iou(Mode::Value));
    assert_eq!(
        value.all_pairs(rows, columns).unwrap(),
        cpu.all_pairs(IouObb2, &a, &b).unwrap().values()
    );
    let both = cpu.all_pairs(IouObb2.value_grad(), &a, &b).unwrap();
    let planes = iou(Mode::ValueGrad).all_pairs(rows, columns).unwrap();
    for (i, j) in [(0, 0), (1, 1), (2, 0)] {
        let expected = both.at(i, j);
        let expected = [vec![expected.0], expected.1.scalars()].concat();
        let found: Vec<f64> = (0..11).map(|k| planes[k * 6 + i * 2 + j]).collect();
        assert_eq!(bits(&found), bits(&expected));
    }
    let mut into = vec![0.0; 6];
    value.all_pairs_into(rows, columns, &mut into).unwrap();
    assert_eq!(into, cpu.all_pairs(IouObb2, &a, &b).unwrap().values());
    assert_eq!(
        value.row_max(rows, columns).unwrap(),
        cpu.row_max(IouObb2, &a, &b).unwrap()
    );
    assert_eq!(
        value.column_max(rows, columns).unwrap(),
        cpu.column_max(IouObb2, &a, &b).unwrap()
    );
    for threshold in [-1.0, 0.0, 0.2] {
        assert_eq!(
            value.above(rows, columns, threshold).unwrap(),
            cpu.above(IouObb2, &a, &b, threshold).unwrap()
        );
        assert_eq!(
            value.count_above(rows, columns, threshold).unwrap(),
            cpu.count_above(IouObb2, &a, &b, threshold).unwrap()
        );
    }
    assert_eq!(
        value.sum(rows, columns).unwrap(),
        cpu.sum(IouObb2, &a, &b).unwrap()
    );
    assert_eq!(
        value.mean(rows, columns).unwrap(),
        cpu.mean(IouObb2, &a, &b).unwrap()
    );
    let flat = |(x, a, b): (f64, Vec<Obb2<f64>>, Vec<Obb2<f64>>)| (x, a.scalars(), b.scalars());
    assert_eq!(
        value.sum_grad(rows, columns).unwrap(),
        flat(cpu.sum_grad(IouObb2, &a, &b).unwrap())
    );
    assert_eq!(
        value.mean_grad(rows, columns).unwrap(),
        flat(cpu.mean_grad(IouObb2, &a, &b).unwrap())
    );
    for steep in [1.0, 1e300] {
        let upstream: Vec<f64> = (0..6).map(|k| steep * f64::from(k)).collect();
        let (a_bar, b_bar) = cpu.all_pairs_vjp(IouObb2, &a, &b, &upstream).unwrap();
        let expected = (a_bar.scalars(), b_bar.scalars());
        assert_eq!(
            value.all_pairs_vjp(rows, columns, &upstream).unwrap(),
            expected
        );
    }
    // A program has the same forms.
    let program = operation("iou_obb2")
        .unwrap()
        .program::<f64>()
        .unwrap()
        .function();
    assert_eq!(
        program.all_pairs(rows, columns).unwrap(),
        value.all_pairs(rows, columns).unwrap()
    );
    assert_eq!(
        program.sum_grad(rows, columns).unwrap().0,
        value.sum(rows, columns).unwrap()
    );
}

#[test]
fn errors_name_argument_row_and_field_and_nothing_is_written() {
    let distance = operation("distance_point_segment")
        .unwrap()
        .value::<f64>()
        .unwrap();
    let (point, segment) = (Argument::Named("point"), Argument::Named("segment"));
    let points = [0.0, 1.0, 2.0, f64::NAN];
    let segments = [0.0, 0.0, 1.0, 0.0];
    let mut result = [7.0; 2];
    let mut into = |points: &[f64], fields: usize, segments: &[f64], many: usize| {
        let rows = [Rows::new(points, fields), Rows::new(segments, many)];
        let error = distance
            .aligned_into(&rows, &mut [Some(&mut result)])
            .unwrap_err();
        assert_eq!(result, [7.0; 2]);
        error
    };
    let flaw = Flaw::NotFinite(Field::new("y"));
    assert_eq!(
        into(&points, 2, &[segments; 2].concat(), 4),
        Error::Invalid {
            argument: point,
            item: 1,
            flaw
        }
    );
    let fields = Error::Fields {
        argument: segment,
        expected: 4,
        found: 2,
    };
    assert_eq!(into(&points, 2, &segments, 2), fields);
    assert_eq!(
        fields.to_string(),
        "items of `segment` have 2 numbers where 4 are needed"
    );
    let length = |argument, expected, found| Error::Length {
        argument,
        expected,
        found,
    };
    assert_eq!(
        into(&points[..2], 2, &[segments; 2].concat(), 4),
        length(segment, 1, 2)
    );
    assert_eq!(into(&points[..3], 2, &segments, 4), length(point, 2, 3));
    assert_eq!(
        into(&points[..2], 2, &segments, 4),
        length(Argument::Result(0), 1, 2)
    );
    let one = [Rows::new(&points[..2], 2)];
    assert_eq!(
        distance.aligned(&one),
        Err(Error::Arguments {
            expected: 2,
            found: 1
        })
    );

    let wrong = [0.0, 0.0, 1.0, -1.0, 0.0];
    let error = iou(Mode::Value)
        .row_max(Rows::new(&BOXES, 5), Rows::new(&wrong, 5))
        .unwrap_err();
    assert_eq!(error.to_string(), "`b` item 0: height is negative");
    let error = iou(Mode::Value)
        .row_max(Rows::new(&BOXES, 5), Rows::new(&[], 5))
        .unwrap_err();
    let argument = Argument::Named("b");
    assert_eq!(error, Error::NoLargest { argument });
    let bars = [1.0, f64::INFINITY, 0.0];
    let rows = [
        Rows::new(&BOXES, 5),
        Rows::one(&TRUTHS[..5]),
        Rows::new(&bars, 1),
    ];
    let flaw = Flaw::NotFinite(Field::VALUE);
    assert_eq!(
        iou(Mode::Vjp).aligned(&rows),
        Err(Error::Invalid {
            argument: Argument::Upstream,
            item: 1,
            flaw
        })
    );
    assert_eq!(
        iou(Mode::Vjp).all_pairs(rows[0], rows[1]),
        Err(Error::Arguments {
            expected: 3,
            found: 2
        })
    );
    assert_eq!(
        iou(Mode::ValueGrad).sum(rows[0], rows[1]),
        Err(Error::NotOneNumber { found: 11 })
    );
    let movement = operation("move_segment").unwrap();
    assert!(movement.value_grad::<f64>().is_none());
    let refused = movement.program::<f64>().unwrap().hessian().unwrap_err();
    assert_eq!(refused, Error::NotOneNumber { found: 4 });
    let ring = operation("signed_distance_point_ring").unwrap();
    let refused =
        ring.on_paths::<f64>()
            .unwrap()
            .values(&[Rows::new(&points, 2)], &[0.0; 6], &[0, 1, 3]);
    assert_eq!(
        refused,
        Err(Error::Invalid {
            argument: point,
            item: 1,
            flaw: Flaw::NotFinite(Field::new("y"))
        })
    );
    assert_eq!(
        ring.program::<f64>().unwrap_err(),
        Error::Program(Unrecordable::Path)
    );
    assert!(operation("no_such_thing").is_none());
}

/// A function of three arguments with two results, traced.
fn traced<T: Real>() -> Program<T> {
    use symbol::*;
    let layouts = [
        Layout::of::<Vec2<T>>(),
        Layout::numbers(1),
        Layout::numbers(3),
    ];
    let tracing = Tracing::<T>::start(&layouts).unwrap();
    let inputs = tracing.inputs();
    let ([p, s, w], mut sum) = (&inputs[..], literal::<T>(0.0).unwrap()) else {
        unreachable!()
    };
    for &x in w {
        sum = add(sum, mul(x, s[0]).unwrap()).unwrap();
    }
    let far = hypot(p[0], p[1]).unwrap();
    let turned = atan2(p[1], sin(sum).unwrap()).unwrap();
    let chosen = select(
        below(far, sum).unwrap(),
        exp(neg(far).unwrap()).unwrap(),
        turned,
    )
    .unwrap();
    let least = least(far, most(w[0], w[1]).unwrap()).unwrap();
    tracing.finish(&[&[chosen], &[least, far]]).unwrap()
}
fn typed<S: Scalar>(x: &[S]) -> Vec<S> {
    let [px, py, s, u, v, w] = x[..] else {
        panic!("six numbers")
    };
    let sum = S::zero() + u * s + v * s + w * s;
    let far = px.hypot(py);
    let chosen = S::select(far.below(sum), (-far).exp(), py.atan2(sum.sin()));
    vec![chosen, far.least(u.most(v)), far]
}

#[test]
fn functions_of_any_arity_are_traced() {
    fn of<T: Number>() {
        let program = traced::<T>();
        assert_eq!((program.sizes(), program.gives()), ([6, 3], &[1, 2][..]));
        let inputs: [[f64; 6]; 3] = [
            [0.3, -0.4, 1.5, 0.2, 0.9, 0.1],
            [2.0, 1.0, -1.0, 3.0, 3.0, 0.5],
            [0.0, 0.0, 1.0, 1.0, 2.0, 3.0],
        ];
        let inputs = inputs.map(|x| x.map(T::lit));
        let columns = [[0, 2], [2, 3], [3, 6]].map(|[from, to]| {
            inputs
                .iter()
                .flat_map(|x| x[from..to].to_vec())
                .collect::<Vec<_>>()
        });
        let rows = [
            Rows::new(&columns[0], 2),
            Rows::new(&columns[1], 1),
            Rows::new(&columns[2], 3),
        ];
        let found = by_item(&program.aligned(&rows).unwrap(), 3);
        let jacobian = by_item(&program.jacobian().unwrap().aligned(&rows).unwrap(), 3);
        for (i, x) in inputs.iter().enumerate() {
            assert_eq!(bits_of(&found[i]), bits_of(&typed(x)));
            let dual: [Jet<T, 6>; 6] = std::array::from_fn(|k| Jet::variable(x[k], k));
            let derivatives: Vec<T> = typed(&dual).iter().flat_map(|x| x.derivative).collect();
            near(&jacobian[i], &derivatives, "jacobian");
        }
        let wild: Vec<T> = [1.0, f64::NAN, 0.0].map(T::lit).to_vec();
        let error = program
            .aligned(&[rows[0], rows[1], Rows::new(&[&wild[..]; 3].concat(), 3)])
            .unwrap_err();
        assert_eq!(error.to_string(), "`c` item 0: [1] is not a finite number");
        let named = program.named(&["place", "speed", "weights"]).unwrap();
        let error = named
            .aligned(&[rows[0], rows[1], Rows::new(&[&wild[..]; 3].concat(), 3)])
            .unwrap_err();
        assert_eq!(
            error.to_string(),
            "`weights` item 0: [1] is not a finite number"
        );
        assert!(named.to_string().contains("place.x"), "{named}");
    }
    of::<f64>();
    of::<f32>();
    // More arguments than the typed face has.
    let tracing = Tracing::<f64>::start(&[Layout::numbers(1); 9]).unwrap();
    let inputs = tracing.inputs();
    let sum = inputs.iter().fold(symbol::literal(0.0).unwrap(), |sum, x| {
        symbol::add(sum, x[0]).unwrap()
    });
    let sum = tracing.finish(&[&[sum]]).unwrap();
    let (two, wild) = ([2.0], [f64::NAN]);
    let mut rows = vec![Rows::new(&two, 1); 9];
    assert_eq!(sum.aligned(&rows).unwrap(), [[18.0]]);
    rows[7] = Rows::new(&wild, 1);
    let flaw = Flaw::NotFinite(Field::VALUE);
    assert_eq!(
        sum.aligned(&rows),
        Err(Error::Invalid {
            argument: Argument::Input(7),
            item: 0,
            flaw
        })
    );
}

#[test]
fn recordings_refuse_what_is_not_theirs() {
    let foreign = Some(Error::Program(Unrecordable::ForeignSymbol));
    assert!(!symbol::is_recording());
    assert_eq!(symbol::literal::<f64>(1.0).err(), foreign);
    let old = {
        let tracing = Tracing::<f64>::start(&[Layout::numbers(1)]).unwrap();
        assert!(symbol::is_recording());
        assert_eq!(
            Tracing::<f32>::start(&[Layout::numbers(1)]).err(),
            Some(Error::Program(Unrecordable::Nested))
        );
        tracing.inputs()[0][0]
    };
    // Dropped, it is closed.
    assert!(!symbol::is_recording());
    assert_eq!(symbol::sin(old).err(), foreign);
    let tracing = Tracing::<f64>::start(&[Layout::numbers(2)]).unwrap();
    let x = tracing.inputs()[0].clone();
    assert_eq!(symbol::add(x[0], old).err(), foreign);
    assert_eq!(symbol::literal::<f32>(1.0).err(), foreign);
    assert_eq!(old.belongs().err(), foreign);
    assert_eq!(
        operation("signed_area")
            .unwrap()
            .on_symbols(&[&[old, old]])
            .err(),
        foreign
    );
    let elsewhere = std::thread::spawn(move || {
        let own = Tracing::<f64>::start(&[Layout::numbers(1)]).is_ok();
        (own, symbol::sin(x[0]).err(), symbol::is_recording())
    });
    assert_eq!(elsewhere.join().unwrap(), (true, foreign, false));
    let x = tracing.inputs()[0].clone();
    let search = operation("diameter_of_polygon").unwrap();
    assert_eq!(
        search.on_symbols(&[&x]).err(),
        Some(Error::Program(Unrecordable::Search))
    );
    let iou = operation("iou_obb2").unwrap();
    assert_eq!(
        iou.on_symbols(&[&x]).err(),
        Some(Error::Arguments {
            expected: 2,
            found: 1
        })
    );
    let fields = Error::Fields {
        argument: Argument::Named("a"),
        expected: 5,
        found: 2,
    };
    assert_eq!(iou.on_symbols(&[&x, &x]).err(), Some(fields));
    // Refusals leave the recording as it was.
    let sum = symbol::add(x[0], x[1]).unwrap();
    assert_eq!(
        tracing
            .finish(&[&[sum]])
            .unwrap()
            .eval(&[1.0, 2.0])
            .unwrap(),
        [3.0]
    );
    let tracing = Tracing::<f64>::start(&[Layout::numbers(1)]).unwrap();
    assert_eq!(tracing.finish(&[&[old]]).err(), foreign);
    assert!(!symbol::is_recording());
    let tracing = Tracing::<f64>::start(&[Layout::numbers(1)]).unwrap();
    let infinite = symbol::literal(f64::INFINITY).unwrap();
    assert_eq!(
        tracing.finish(&[&[infinite]]).err(),
        Some(Error::Program(Unrecordable::Constant))
    );
    let polygon = operation("diameter_of_polygon").unwrap().layouts::<f64>();
    assert_eq!(
        Tracing::start(&polygon).err(),
        Some(Error::Program(Unrecordable::Codes))
    );
}

/// Numbers that are equal but for the last digits of the largest of them, or of one.
fn near<T: Number>(found: &[T], expected: &[T], what: &str) {
    within(found, expected, 65536.0 * T::format().epsilon(), what);
}
/// The same but for so much of it.
fn within<T: Number>(found: &[T], expected: &[T], share: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let size = expected.iter().map(|&x| x.into().abs()).fold(1.0, f64::max);
    for (&x, &y) in found.iter().zip(expected) {
        let (x, y): (f64, f64) = (x.into(), y.into());
        assert!((x - y).abs() <= share * size, "{what}: {x} is not {y}");
    }
}

#[test]
fn operations_of_symbols_are_the_operations() {
    // A segment is moved; IoU of boxes that depend on it; signed distance and area of a ring.
    let layouts = [
        Layout::of::<Pose2<f64>>(),
        Layout::of::<Segment2<f64>>(),
        Layout::of::<Obb2<f64>>(),
        Layout::numbers(8),
    ];
    let tracing = Tracing::start(&layouts).unwrap();
    let inputs = tracing.inputs();
    let [pose, segment, shape, ring] = &inputs[..] else {
        unreachable!()
    };
    let call = |name: &str, arguments: &[&[Symbol<f64>]]| {
        operation(name).unwrap().on_symbols(arguments).unwrap()
    };
    let moved = call("move_segment", &[pose, segment]);
    let other = [moved[0], moved[1], shape[2], shape[3], moved[2]];
    let iou = call("iou_obb2", &[&other, shape])[0];
    let distance = call("signed_distance_point_ring", &[&moved[..2], ring])[0];
    let area = call("signed_area", &[ring])[0];
    let loss = symbol::add(iou, symbol::mul(distance, area).unwrap()).unwrap();
    let loss = tracing.finish(&[&[loss]]).unwrap();

    fn plain<S: Scalar>(x: &[S]) -> S {
        let moved = MoveSegment::eval((Pose2::load(&x[..4]), Segment2::load(&x[4..8])));
        let shape = Obb2::load(&x[8..13]);
        let other = Obb2 {
            center: moved.from,
            size: shape.size,
            heading: moved.to.x,
        };
        let ring = path(&x[13..]);
        let distance = fold::<SignedDistancePointRing, S>(moved.from, &ring);
        IouObb2::eval((other, shape)) + distance * geograd::ring::signed_area(&ring)
    }
    let x = [
        0.3, -0.2, 0.8, 0.6, 1.0, 0.5, 0.4, 2.0, 0.1, 0.4, 1.5, 2.0, 0.3, -1.0, -1.0, 2.0, -1.0,
        1.5, 2.0, -1.0, 1.0,
    ];
    assert_eq!(loss.eval(&x).unwrap(), [plain(&x) + 0.0]);
    let (_, derivatives) = ad::gradient(|x: Vec<_>| plain(&x), x.to_vec());
    near(
        &loss.value_grad().unwrap().eval(&x).unwrap()[1..],
        &derivatives,
        "gradient",
    );
    let columns = [
        Rows::one(&x[..4]),
        Rows::one(&x[4..8]),
        Rows::one(&x[8..13]),
        Rows::one(&x[13..]),
    ];
    assert_eq!(loss.aligned(&columns).unwrap(), [[plain(&x) + 0.0]]);
}

/// Operations of the longest programs, boxes of any orientation.
const LONG: usize = 5000;

/// Every derivative program of a program against duals of its function.
fn derivatives(program: &Program<f64>, x: &[f64], name: &str) {
    type Dual = Jet<f64, 1>;
    type Second = Jet<Jet<f64, 1>, 1>;
    let [inputs, outputs] = program.sizes();
    let direction: Vec<f64> = (0..inputs).map(|k| 0.3 + 0.17 * (k % 5) as f64).collect();
    let bars: Vec<f64> = (0..outputs).map(|k| 1.0 - 0.4 * (k % 3) as f64).collect();
    let along = |direction: &[f64]| -> Vec<f64> {
        let dual: Vec<Dual> = x
            .iter()
            .zip(direction)
            .map(|(&value, &t)| Jet {
                value,
                derivative: [t],
            })
            .collect();
        program
            .eval_on(&dual)
            .unwrap()
            .iter()
            .map(|x| x.derivative[0])
            .collect()
    };
    let axis =
        |k: usize| -> Vec<f64> { (0..inputs).map(|i| f64::from(u8::from(i == k))).collect() };
    let columns: Vec<Vec<f64>> = (0..inputs).map(|k| along(&axis(k))).collect();
    let jacobian: Vec<f64> = (0..outputs)
        .flat_map(|i| columns.iter().map(move |column| column[i]))
        .collect();
    near(
        &program.jacobian().unwrap().eval(x).unwrap(),
        &jacobian,
        name,
    );
    let with = |more: &[f64]| [x, more].concat();
    let jvp = program.jvp().eval(&with(&direction)).unwrap();
    near(&jvp[outputs..], &along(&direction), name);
    let vjp: Vec<f64> = columns
        .iter()
        .map(|column| column.iter().zip(&bars).map(|(x, y)| x * y).sum())
        .collect();
    near(
        &program.vjp().unwrap().eval(&with(&bars)).unwrap(),
        &vjp,
        name,
    );
    if outputs != 1 {
        return;
    }
    near(
        &program.value_grad().unwrap().eval(x).unwrap()[1..],
        &jacobian,
        name,
    );
    // Second derivatives of the longest programs take minutes; they are made node by node, as those of all others.
    if program.cost().total() > LONG {
        return;
    }
    // Second derivatives of an adjoint by hand are those of its formula, those of duals are of the function.
    let second = |s: &[f64], t: &[f64]| -> f64 {
        let point = |k: usize| Second {
            value: Jet {
                value: x[k],
                derivative: [s[k]],
            },
            derivative: [Jet {
                value: t[k],
                derivative: [0.0],
            }],
        };
        let dual: Vec<Second> = (0..inputs).map(point).collect();
        program.eval_on(&dual).unwrap()[0].derivative[0].derivative[0]
    };
    let hessian: Vec<f64> = (0..inputs * inputs)
        .map(|k| second(&axis(k / inputs), &axis(k % inputs)))
        .collect();
    within(
        &program.hessian().unwrap().eval(x).unwrap(),
        &hessian,
        1e-7,
        name,
    );
    let product: Vec<f64> = (0..inputs).map(|k| second(&axis(k), &direction)).collect();
    within(
        &program.hvp().unwrap().eval(&with(&direction)).unwrap(),
        &product,
        1e-7,
        name,
    );
    // The vjp of the vjp at cotangent c: c times the Hessian product, then the derivative along the direction.
    let twice = program.vjp().unwrap().vjp().unwrap();
    let given = [x, &[0.5][..], &direction].concat();
    let found = twice.eval(&given).unwrap();
    let half: Vec<f64> = product.iter().map(|x| 0.5 * x).collect();
    within(&found[..inputs], &half, 1e-7, name);
    near(&found[inputs..], &along(&direction), name);
}

#[test]
fn derivative_programs_are_those_of_duals() {
    list::each(&list::sample(list::rows(), &["iou_obb2"]), |row| {
        let Ok(program) = row.operation.program::<f64>() else {
            return;
        };
        let mut draw = Draw::new(17);
        for _ in 0..2 {
            derivatives(&program, &row.ordinary(&mut draw), row.name());
        }
    });
    derivatives(&traced::<f64>(), &[0.3, -0.4, 1.5, 0.2, 0.9, 0.1], "traced");
    let one = operation("perimeter")
        .unwrap()
        .program_of_path::<f64>(4)
        .unwrap();
    derivatives(
        &one,
        &[0.0, 0.1, 3.0, 0.2, 2.5, 2.0, -0.3, 1.0],
        "perimeter",
    );
}

#[test]
fn nodes_are_the_program() {
    let program = operation("iou_obb2")
        .unwrap()
        .program::<f64>()
        .unwrap()
        .value_grad()
        .unwrap();
    let nodes = program.nodes();
    let x = [BOXES[..5].to_vec(), TRUTHS[..5].to_vec()].concat();
    let mut slots: Vec<f64> = Vec::new();
    for step in &nodes.nodes {
        let at = |k: usize| slots[step.operands[k] as usize];
        let truth = |x: bool| f64::from(u8::from(x));
        use Elementary::*;
        let number = match step.operation {
            Constant(number) => number,
            Input(place) => x[place as usize],
            Bool(known) => truth(known),
            Neg => -at(0),
            Canonical => at(0) + 0.0,
            Add => at(0) + at(1),
            Sub => at(0) - at(1),
            Mul => at(0) * at(1),
            Div => at(0) / at(1),
            Least => {
                if at(0) < at(1) {
                    at(0)
                } else {
                    at(1)
                }
            }
            Most => {
                if at(0) > at(1) {
                    at(0)
                } else {
                    at(1)
                }
            }
            Magnitude => at(0).abs(),
            Root => {
                if at(0) > 0.0 {
                    at(0).sqrt()
                } else {
                    0.0
                }
            }
            Sin => at(0).sin_cos().0,
            Cos => at(0).sin_cos().1,
            Lt => truth(at(0) < at(1)),
            Le => truth(at(0) <= at(1)),
            Eq => truth(at(0) == at(1)),
            And => truth(at(0) + at(1) == 2.0),
            Or => truth(at(0) + at(1) > 0.0),
            Not => 1.0 - at(0),
            Select => {
                if at(0) == 1.0 {
                    at(1)
                } else {
                    at(2)
                }
            }
            Binade => at(0).binade(),
            other => panic!("{} is in no IoU", other.name()),
        };
        assert_eq!(
            step.operation.is_truth(),
            matches!(
                step.operation.name(),
                "bool" | "lt" | "le" | "eq" | "and" | "or" | "not"
            )
        );
        slots.push(number);
    }
    let found: Vec<f64> = nodes
        .outputs
        .iter()
        .map(|&place| slots[place as usize])
        .collect();
    assert_eq!(found, program.eval(&x).unwrap());
    assert_eq!(nodes.inputs, 10);
}

#[test]
fn rows_by_indices_have_the_bits_of_copied_rows() {
    let mut draw = Draw::new(5);
    let shared: Vec<f64> = (0..90).map(|_| draw.within(-1.0, 1.0)).collect();
    let indices: Vec<u32> = (0..3 * 2500).map(|k| (17 * k + k / 3) % 30).collect();
    let copied: Vec<f64> = indices
        .iter()
        .flat_map(|&i| shared[3 * i as usize..][..3].to_vec())
        .collect();
    let (own, rows) = (
        Rows::indexed(&shared, 3, &indices, 3),
        Rows::new(&copied, 9),
    );
    assert_eq!((own.count(), own.fields()), (Some(2500), 9));
    assert_eq!(own.numbers(), copied);
    let points: Vec<f64> = (0..3 * 2500).map(|_| draw.within(-1.0, 1.0)).collect();
    let (points, few) = (Rows::new(&points, 3), Rows::new(&points[..30], 3));
    let distance = operation("distance_point_triangle3").expect("is listed");
    let (value, slopes) = (distance.value::<f64>(), distance.value_grad::<f64>());
    let (value, slopes) = (value.expect("has values"), slopes.expect("has slopes"));
    let found = slopes.aligned(&[points, own]).expect("valid");
    assert_eq!(found, slopes.aligned(&[points, rows]).expect("valid"));
    assert_eq!(value.all_pairs(few, own), value.all_pairs(few, rows));
    assert_eq!(value.row_min(few, own), value.row_min(few, rows));
    let by_shared = own.gathered(&found[2]).expect("one per number");
    let mut expected = vec![0.0; 90];
    for (k, &x) in found[2].iter().enumerate() {
        expected[3 * indices[k / 3] as usize + k % 3] += x;
    }
    assert_eq!(by_shared, expected);
    assert_eq!(rows.gathered(&found[2]).expect("as it is"), found[2]);

    // Refused: an index beyond the shared column, parts of rows, another number of derivatives.
    let mut beyond = indices.clone();
    beyond[3001] = 30;
    let wrong = value.aligned(&[points, Rows::indexed(&shared, 3, &beyond, 3)]);
    let Err(Error::Invalid {
        argument,
        item,
        flaw,
    }) = wrong
    else {
        panic!("{wrong:?}");
    };
    assert_eq!((argument, item), (Argument::Named("triangle"), 1000));
    assert_eq!(
        flaw,
        Flaw::Broken(
            Field::new("index 30 in place 1"),
            "is not one of the shared column"
        )
    );
    for rows in [
        Rows::indexed(&shared[1..], 3, &indices, 3),
        Rows::indexed(&shared, 3, &indices[1..], 3),
    ] {
        let wrong = value.aligned(&[points, rows]);
        assert!(matches!(wrong, Err(Error::Length { .. })), "{wrong:?}");
    }
    let wrong = own.gathered(&found[2][1..]);
    assert!(matches!(wrong, Err(Error::Length { .. })), "{wrong:?}");
    let wrong = value.aligned(&[points, Rows::indexed(&shared, 3, &indices, 2)]);
    assert!(matches!(wrong, Err(Error::Fields { .. })), "{wrong:?}");
    // Not finite: the first row that has it.
    let mut broken = shared.clone();
    broken[3 * 7] = f64::NAN;
    let first = indices.iter().position(|&i| i == 7).expect("is used") / 3;
    let wrong = value.aligned(&[points, Rows::indexed(&broken, 3, &indices, 3)]);
    assert!(
        matches!(wrong, Err(Error::Invalid { item, .. }) if item == first),
        "{wrong:?}"
    );
}
