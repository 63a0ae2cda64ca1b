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
