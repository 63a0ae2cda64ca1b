//! The table of verbs by shapes in the documentation is that of the list.
use geograd::kernels::dynamic::names;
use std::fmt::Write;

/// A line per verb, in the order of the list.
fn table() -> String {
    let all = names();
    let mut text = String::from("| verb | shapes |\n| --- | --- |\n");
    let mut verbs: Vec<&str> = Vec::new();
    for name in &all {
        if !verbs.contains(&&*name.verb) {
            verbs.push(&name.verb);
        }
    }
    verbs.sort_unstable();
    for verb in verbs {
        let mut shapes: Vec<String> = all
            .iter()
            .filter(|name| name.verb == verb)
            .map(|name| format!("`{}`", name.shapes.join(" ")))
            .collect();
        shapes.sort_unstable();
        shapes.dedup();
        // `signed_area` is the verb `SignedArea`.
        let words = verb
            .split('_')
            .map(|word| word[..1].to_uppercase() + &word[1..]);
        let unit: String = words.collect();
        writeln!(text, "| [`{unit}`] | {} |", shapes.join(", ")).unwrap();
    }
    text.push_str("\nPolygons may have other numbers of corners. Other pairs run by `function`.\n");
    text
}

#[test]
fn the_table_of_verbs_is_that_of_the_list() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../kernels/verbs/shapes.md");
    let found = std::fs::read_to_string(path).unwrap();
    let expected = table();
    if found != expected && std::env::var_os("GEOGRAD_WRITE_TABLES").is_some() {
        std::fs::write(path, &expected).unwrap();
        return;
    }
    assert_eq!(
        found, expected,
        "GEOGRAD_WRITE_TABLES=1 writes the file anew"
    );
}

/// The shapes behind the words of the table of distances in space.
fn meant(word: &str) -> &'static [&'static str] {
    match word {
        "point" => &["Vec3"],
        "ball" => &["Sphere"],
        "segment" => &["Segment3"],
        "capsule" => &["Capsule3"],
        "triangle" => &["Triangle3"],
        "tetrahedron" => &["Tetrahedron"],
        "box" => &["Obb3", "YawBox3"],
        "upright box" => &["Aabb3"],
        "round box" => &["RoundBox3"],
        "half-space" => &["Plane3"],
        "cylinder" => &["Cylinder"],
        "cone" => &["Cone"],
        "line" => &["Line3"],
        "ray" => &["Ray3"],
        "hull" => &["Hull3_8"],
        "ellipsoid" => &["Ellipsoid"],
        "disc" => &["Disc"],
        // Without rows.
        "own shape" => &[],
        _ => panic!("{word} is no shape of the table"),
    }
}

/// The letters of a cell: a capital for every verb with a row that takes these shapes.
fn letters(rows: &str, columns: &str, cell: &str) -> String {
    let verbs = [
        ("d", "distance"),
        ("q", "squared_distance"),
        ("s", "signed_distance"),
        ("c", "closest_points"),
        ("p", "penetration"),
        ("f", "farthest_distance"),
    ];
    let all = names();
    let known = verbs.map(|(letter, verb)| {
        let is = |a: &str, b: &str| {
            let of = |shapes: &[String]| shapes.len() == 2 && shapes[0] == a && shapes[1] == b;
            all.iter().any(|name| name.verb == verb && of(&name.shapes))
        };
        let pairs = |a: &'static str| meant(columns).iter().map(move |b| (a, *b));
        let any = meant(rows)
            .iter()
            .flat_map(|a| pairs(a))
            .any(|(a, b)| is(a, b) || is(b, a));
        if any {
            letter.to_uppercase()
        } else {
            letter.to_string()
        }
    });
    let there = cell.to_lowercase();
    let kept = known
        .iter()
        .filter(|letter| there.contains(&letter.to_lowercase()));
    kept.cloned().collect::<Vec<_>>().join(" ")
}

#[test]
fn the_table_of_distances_in_space_says_which_pairs_have_rows() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../src/distance3/mod.rs");
    let text = std::fs::read_to_string(path).unwrap();
    let lines = text.lines().filter_map(|line| line.strip_prefix("//! | "));
    let cells = |line: &str| -> Vec<String> {
        line.trim_end_matches('|')
            .split('|')
            .map(|cell| cell.trim().to_string())
            .collect()
    };
    let table: Vec<_> = lines
        .skip_while(|line| !line.starts_with("| point"))
        .map(cells)
        .collect();
    let columns = &table[0][1..];
    assert_eq!(columns.len(), 8);
    let mut wrong = vec![];
    for line in table.iter().skip(2) {
        let name = line[0].trim_end_matches(", two");
        for (column, cell) in columns.iter().zip(&line[1..]) {
            let column = if line[0].ends_with(", two") {
                name
            } else {
                column.as_str()
            };
            if cell.is_empty() || cell == "-" {
                continue;
            }
            let told = cell.replace(" -", "");
            let found = letters(name, column, &told);
            if told != found {
                wrong.push(format!(
                    "{name} and {column}: {told} in the table, {found} in the list"
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
