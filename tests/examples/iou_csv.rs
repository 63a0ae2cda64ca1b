//! `iou_csv` with other scores than IoU, on polygons and on boxes of space.
use crate::{folder, run, status, stderr, stdout};
use std::path::Path;

/// The output of a run: the header, and the rows as numbers (`None` for empty fields).
fn table(at: &Path, arguments: &str) -> (String, Vec<Vec<Option<f64>>>) {
    let done = run("iou_csv", at, arguments);
    assert_eq!((status(&done), stderr(&done)), (0, ""), "{arguments}");
    let (header, rows) = stdout(&done).split_once('\n').unwrap();
    let row = |row: &str| row.split(',').map(|x| x.parse().ok()).collect();
    (header.to_string(), rows.lines().map(row).collect())
}

/// The scores of a run without derivatives.
fn scores(at: &Path, arguments: &str) -> Vec<f64> {
    let (_, rows) = table(at, arguments);
    rows.into_iter().map(|row| row[0].unwrap()).collect()
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-12, "{found} {expected}");
}

/// Every derivative that a run prints agrees with what central differences of its own scores say. `moved`
/// moves a row along its direction k by h.
fn derivatives_agree(
    at: &Path,
    options: &str,
    rows: [&[f64]; 2],
    moved: impl Fn(&[f64], usize, f64) -> Vec<f64>,
    directions: [usize; 2],
) {
    let line = |row: &[f64]| {
        let fields: Vec<String> = row.iter().map(f64::to_string).collect();
        fields.join(",") + "\n"
    };
    std::fs::write(at.join("a.csv"), line(rows[0])).unwrap();
    std::fs::write(at.join("b.csv"), line(rows[1])).unwrap();
    let (_, found) = table(at, &format!("--a a.csv --b b.csv --grad {options}"));
    assert_eq!(
        found[0].len(),
        1 + directions[0] + directions[1],
        "{options}"
    );
    let h = 1e-6;
    let (mut a, mut b) = (String::new(), String::new());
    for side in 0..2 {
        for k in 0..directions[side] {
            for h in [h, -h] {
                let mut both = [rows[0].to_vec(), rows[1].to_vec()];
                both[side] = moved(rows[side], k, h);
                a += &line(&both[0]);
                b += &line(&both[1]);
            }
        }
    }
    std::fs::write(at.join("a.csv"), a).unwrap();
    std::fs::write(at.join("b.csv"), b).unwrap();
    let values = scores(at, &format!("--a a.csv --b b.csv {options}"));
    for (k, pair) in values.chunks_exact(2).enumerate() {
        let (derivative, difference) = (found[0][1 + k].unwrap(), (pair[0] - pair[1]) / (2.0 * h));
        assert!(
            (derivative - difference).abs() < 1e-7,
            "{options} {k}: {derivative} {difference}"
        );
    }
}

fn number(row: &[f64], k: usize, h: f64) -> Vec<f64> {
    let mut row = row.to_vec();
    row[k] += h;
    row
}

#[test]
fn the_column_bears_the_name_of_the_metric() {
    let at = folder("iou_csv_metrics");
    std::fs::write(at.join("a.csv"), "0,0,2,2,0\n").unwrap();
    std::fs::write(at.join("b.csv"), "4,0,2,4,0\n").unwrap();
    std::fs::write(at.join("half.csv"), "1,0,2,2,0\n").unwrap();
    for (metric, apart) in [
        ("iou", 0.0),
        ("iof", 0.0),
        // A trapezium before b, then b: 4 (2 + 4) / 2 + 8.
        ("giou", -(20.0 - 12.0) / 20.0),
        // The farthest corners are (−1, ±1) and (5, ∓2).
        ("diou", -16.0 / 45.0),
        ("diou-box", -16.0 / 52.0),
    ] {
        let (header, rows) = table(&at, &format!("--a a.csv --b b.csv --metric {metric}"));
        assert_eq!(header, metric);
        near(rows[0][0].unwrap(), apart);
    }
    near(
        scores(&at, "--a a.csv --b b.csv --metric giou --enclosing aabb")[0],
        -0.5,
    );
    near(
        scores(&at, "--a a.csv --b b.csv --metric giou --enclosing rect")[0],
        -0.5,
    );
    near(scores(&at, "--a a.csv --b half.csv --metric iof")[0], 0.5);
    // Proportions that differ: v = 4/π² (atan 1 − atan ½)².
    let v = 4.0 / std::f64::consts::PI.powi(2) * (1.0_f64.atan() - 0.5_f64.atan()).powi(2);
    for (metric, expected) in [
        ("ciou", -16.0 / 45.0 - v * v / (1.0 + v)),
        ("ciou --enclosing aabb", -16.0 / 52.0 - v * v / (1.0 + v)),
        ("diou --enclosing aabb", -16.0 / 52.0),
        ("eiou", -16.0 / 45.0 - 4.0 / 45.0),
        ("eiou --enclosing aabb", -16.0 / 52.0 - 4.0 / 16.0),
    ] {
        let found = scores(&at, &format!("--a a.csv --b b.csv --metric {metric}"));
        near(found[0], expected);
    }
    let (header, _) = table(&at, "--a a.csv --b b.csv --metric ciou --grad");
    assert_eq!(header, "ciou,dax,day,daw,dah,dar,dbx,dby,dbw,dbh,dbr");
}

#[test]
fn upright_boxes() {
    let at = folder("iou_csv_yaw3");
    let names = "x,y,z,dx,dy,dz,heading\n";
    std::fs::write(
        at.join("a.csv"),
        format!("{names}0,0,0,2,2,2,0\n0,0,0,4,2,1,0.3\n"),
    )
    .unwrap();
    std::fs::write(at.join("b.csv"), "1,0,1,2,2,2,0\n0,0,0,4,2,1,0.3\n").unwrap();
    for (metric, first) in [
        ("iou", 2.0 / 14.0),
        ("iof", 0.25),
        ("giou", 2.0 / 14.0 - (18.0 - 14.0) / 18.0),
        ("diou", 2.0 / 14.0 - 2.0 / 22.0),
        ("diou-box", 2.0 / 14.0 - 2.0 / 22.0),
        ("diou --enclosing rect", 2.0 / 14.0 - 2.0 / 22.0),
        ("ciou", 2.0 / 14.0 - 2.0 / 22.0),
        ("eiou", 2.0 / 14.0 - 2.0 / 22.0),
    ] {
        let found = scores(
            &at,
            &format!("--format yaw3 --a a.csv --b b.csv --metric {metric}"),
        );
        near(found[0], first);
        near(found[1], 1.0);
    }
    let (header, rows) = table(&at, "--format yaw3 --a a.csv --b b.csv --grad --all-pairs");
    let expected = "iou,dax,day,daz,dadx,dady,dadz,dar,dbx,dby,dbz,dbdx,dbdy,dbdz,dbr";
    assert_eq!((header.as_str(), rows.len()), (expected, 4));
    // The same box twice.
    assert!(
        rows[3][1..]
            .iter()
            .all(|derivative| *derivative == Some(0.0))
    );
    let (a, b) = (
        [0.1, -0.2, 0.3, 3.0, 1.5, 1.2, 0.4],
        [0.6, 0.3, 0.1, 2.5, 1.8, 1.4, -0.5],
    );
    for metric in [
        "iou",
        "iof",
        "giou",
        "giou --enclosing rect",
        "diou",
        "diou-box",
        "ciou",
        "ciou --enclosing rect",
        "eiou",
        "eiou --enclosing aabb",
    ] {
        let options = format!("--format yaw3 --metric {metric}");
        derivatives_agree(&at, &options, [&a, &b], number, [7, 7]);
    }
}

#[test]
fn boxes_of_any_orientation() {
    let at = folder("iou_csv_obb3");
    // The same upright boxes as quaternions of any length.
    let (sin, cos) = (0.15_f64.sin(), 0.15_f64.cos());
    let a = format!("0,0,0,2,2,2,2,0,0,0\n0.5,0,0,4,2,1,{cos},0,0,{sin}\n");
    std::fs::write(at.join("a.csv"), a).unwrap();
    std::fs::write(
        at.join("b.csv"),
        "1,0,1,2,2,2,-1,0,0,0\n0,0,0,4,2,1,3,0,0,0\n",
    )
    .unwrap();
    std::fs::write(at.join("c.csv"), "0,0,0,2,2,2,0\n0.5,0,0,4,2,1,0.3\n").unwrap();
    std::fs::write(at.join("d.csv"), "1,0,1,2,2,2,0\n0,0,0,4,2,1,0\n").unwrap();
    for metric in [
        "iou",
        "iof",
        "giou --enclosing aabb",
        "diou --enclosing aabb",
        "diou-box",
        "ciou --enclosing aabb",
        "eiou --enclosing aabb",
    ] {
        let tilted = scores(
            &at,
            &format!("--format obb3 --a a.csv --b b.csv --metric {metric}"),
        );
        let upright = scores(
            &at,
            &format!("--format yaw3 --a c.csv --b d.csv --metric {metric}"),
        );
        for (tilted, upright) in tilted.into_iter().zip(upright) {
            near(tilted, upright);
        }
    }
    let (header, _) = table(&at, "--format obb3 --a a.csv --b b.csv --grad");
    let expected = "iou,dax,day,daz,dadx,dady,dadz,darx,dary,darz,\
        dbx,dby,dbz,dbdx,dbdy,dbdz,dbrx,dbry,dbrz";
    assert_eq!(header, expected);
    let (a, b) = (
        [0.1, -0.2, 0.3, 3.0, 1.5, 1.2, 1.8, 0.4, -0.6, 0.2],
        [0.6, 0.3, 0.1, 2.5, 1.8, 1.4, 0.3, -0.1, 0.5, 0.7],
    );
    // The last three directions turn about the box's own axes.
    let moved = |row: &[f64], k: usize, h: f64| {
        if k < 6 {
            return number(row, k, h);
        }
        let (sin, cos) = (0.5 * h).sin_cos();
        let mut axis = [0.0; 3];
        axis[k - 6] = sin;
        let ([w, x, y, z], [p, q, r]) = ([row[6], row[7], row[8], row[9]], axis);
        let turned = [
            w * cos - x * p - y * q - z * r,
            w * p + x * cos + y * r - z * q,
            w * q - x * r + y * cos + z * p,
            w * r + x * q - y * p + z * cos,
        ];
        [&row[..6], &turned].concat()
    };
    for metric in [
        "iou",
        "iof",
        "giou",
        "giou --enclosing aabb",
        "diou",
        "diou-box",
        "ciou",
        "eiou",
    ] {
        let options = format!("--format obb3 --metric {metric}");
        derivatives_agree(&at, &options, [&a, &b], moved, [9, 9]);
    }
}

/// An L, the square in its corner, and a triangle, clockwise and with the empty fields of a spreadsheet.
const SHAPES: &str = "0,0,2,0,2,1,1,1,1,2,0,2\n1,1,1,2,2,2,2,1,,,,\n0,0,0,2,2,0\n";

#[test]
fn polygons() {
    let at = folder("iou_csv_polygons");
    std::fs::write(at.join("a.csv"), SHAPES).unwrap();
    std::fs::write(at.join("b.csv"), "0,0,2,0,2,2,0,2\n").unwrap();
    let table = |rest: &str| {
        let files = "--format polygons --a a.csv --b b.csv --all-pairs";
        table(&at, &format!("{files} {rest}"))
    };
    for (metric, expected) in [
        ("iou", [0.75, 0.25, 0.5]),
        ("iof", [1.0, 1.0, 1.0]),
        ("giou", [0.75, 0.25, 0.5]),
        ("giou --enclosing aabb", [0.75, 0.25, 0.5]),
        (
            "diou",
            [
                0.75 - 2.0 / 36.0 / 8.0,
                0.25 - 0.5 / 8.0,
                0.5 - 2.0 / 9.0 / 8.0,
            ],
        ),
        (
            "diou-box",
            [
                0.75 - 2.0 / 36.0 / 8.0,
                0.25 - 0.5 / 8.0,
                0.5 - 2.0 / 9.0 / 8.0,
            ],
        ),
    ] {
        let (_, rows) = table(&format!("--metric {metric}"));
        for (row, expected) in rows.iter().zip(expected) {
            near(row[0].unwrap(), expected);
        }
    }
    let (header, rows) = table("--grad");
    let mut expected = String::from("iou");
    for (owner, count) in [("da", 6), ("db", 4)] {
        for k in 1..=count {
            expected += &format!(",{owner}{k}x,{owner}{k}y");
        }
    }
    assert_eq!(header, expected);
    // The square has four vertices, the triangle three; the other fields are empty.
    for (row, count) in rows.iter().zip([6, 4, 3]) {
        assert_eq!(row.len(), 1 + 12 + 8);
        let filled: Vec<bool> = row.iter().map(Option::is_some).collect();
        let expected = |k: usize| k <= 2 * count || k > 12;
        assert!((0..21).all(|k| filled[k] == expected(k)), "{filled:?}");
    }
    // The L and the square in its corner share an edge or nothing, the same polygon is the same from
    // wherever it starts.
    std::fs::write(
        at.join("b.csv"),
        "1,1,2,1,2,2,1,2\n1,2,0,2,0,0,2,0,2,1,1,1\n",
    )
    .unwrap();
    let (_, rows) = self::table(
        &at,
        "--format polygons --a a.csv --b b.csv --all-pairs --grad",
    );
    assert_eq!((rows[0][0], rows[1][0]), (Some(0.0), Some(1.0)));
    assert!(
        rows[1][1..]
            .iter()
            .all(|derivative| *derivative == Some(0.0))
    );
}

#[test]
fn polygons_have_derivatives_by_every_vertex() {
    let at = folder("iou_csv_polygon_derivatives");
    // An arrow that is not convex, and a clockwise pentagon with one re-entrant vertex.
    let a = [0.0, 0.1, 3.0, -0.2, 2.1, 1.2, 3.2, 2.6, 0.2, 2.4];
    let b = [1.1, 3.3, 2.0, 1.9, 4.1, 1.7, 3.0, 0.4, 0.8, 0.7];
    for metric in [
        "iou",
        "iof",
        "giou",
        "giou --enclosing aabb",
        "diou",
        "diou-box",
    ] {
        let options = format!("--format polygons --metric {metric}");
        derivatives_agree(&at, &options, [&a, &b], number, [10, 10]);
    }
}

#[test]
fn bad_rows_of_other_formats() {
    let at = folder("iou_csv_bad_formats");
    for (format, rows, why) in [
        ("polygons", "0,0,1,0,1\n", "row 1 (line 1): x3 has no y3"),
        ("polygons", "0,0,1,0\n", "row 1 (line 1): 2 vertices where"),
        ("polygons", "0,0,1,zero,1,1\n", "y2 is not a number: `zero`"),
        ("polygons", "0,0,1,,1,1\n", "y2 is not a number: ``"),
        ("polygons", "0,0,1,inf,1,1\n", "y2 is not finite: `inf`"),
        (
            "polygons",
            "x1,y1,x2,y2,x3,y3\n0,0,1,1,1,0,0,1\n",
            "row 1 (line 2): the edges after vertices 1 and 3 cross each other",
        ),
        (
            "polygons",
            "y1,x1,y2,x2,y3,x3\n0,0,1,1,1,0\n",
            "the order must be x1,y1,",
        ),
        (
            "yaw3",
            "0,0,0,2,-2,2,0\n",
            "row 1 (line 1): dy is negative: `-2`",
        ),
        (
            "yaw3",
            "0,0,0,2,2,0\n",
            "6 fields where x,y,z,dx,dy,dz,heading is needed",
        ),
        (
            "yaw3",
            "0,0,0,2,2,2,south\n",
            "heading is not a number: `south`",
        ),
        (
            "obb3",
            "0,0,0,2,2,2,1,0,0,0\n0,0,0,1,1,1,0,0,0,0\n",
            "row 2 (line 2): qw, qx, qy and qz are all zero",
        ),
        ("obb3", "0,0,0,2,2,2,1,0,NaN,0\n", "qy is not finite: `NaN`"),
    ] {
        std::fs::write(at.join("bad.csv"), rows).unwrap();
        let done = run(
            "iou_csv",
            &at,
            &format!("--format {format} --a bad.csv --b bad.csv"),
        );
        assert_eq!((status(&done), stdout(&done)), (1, ""), "{rows}");
        let told = stderr(&done);
        assert!(
            told.contains("bad.csv") && told.contains(why),
            "{why}: {told}"
        );
    }
}

#[test]
fn extreme_polygons_have_finite_scores_and_derivatives() {
    let at = folder("iou_csv_extreme");
    let rows = [
        "0,0,2,0,2,2,0,2",
        // Repeated and collinear vertices, no area, a sliver, far away, tiny, huge.
        "0,0,1,0,1,0,2,0,2,2,0,2,0,0",
        "0,0,1,1,2,2",
        "1,1,1,1,1,1",
        "0,0,2,0,1,1e-9",
        "1e9,1e9,1000000002,1e9,1000000002,1000000002,1e9,1000000002",
        "1e-200,0,2e-200,1e-200,2e-200,0",
        "0,0,1e150,0,1e150,1e150,0,1e150",
        "-1e308,-1e308,1e308,-1e308,1e308,1e308,-1e308,1e308",
    ];
    std::fs::write(at.join("a.csv"), rows.join("\n")).unwrap();
    for metric in [
        "iou",
        "iof",
        "giou",
        "giou --enclosing aabb",
        "diou",
        "diou-box",
    ] {
        let options = "--format polygons --a a.csv --b a.csv --all-pairs --grad";
        let (_, found) = table(&at, &format!("{options} --metric {metric}"));
        for (i, row) in found.iter().enumerate() {
            let (a, b) = (i / rows.len(), i % rows.len());
            let value = row[0].unwrap();
            assert!((-1.0..=1.0).contains(&value), "{metric} {a} {b}: {value}");
            assert!(
                row.iter().flatten().all(|x| x.is_finite()),
                "{metric} {a} {b}"
            );
            // The same with an area; all of these are convex, but not all are boxes.
            if a == b && ![2, 3].contains(&a) && !metric.contains("aabb") {
                assert_eq!(value, 1.0, "{metric} {a}");
            }
        }
    }
}
