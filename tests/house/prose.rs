//! The documentation of functions, read from the source: its first word is a verb in the third person, such as
//! "Returns" or "Adds". A list of words cannot know all verbs; it excludes the nouns and pronouns that end like one.
use std::path::Path;

/// Folders whose functions are read.
const FOLDERS: [&str; 3] = ["src", "ad", "kernels"];

/// Words that end in "s" and are no verbs, or none that says what a function does.
const NO_VERBS: [&str; 58] = [
    "Across",
    "Always",
    "Angles",
    "As",
    "Axes",
    "Axis",
    "Bars",
    "Bits",
    "Bounds",
    "Cases",
    "Columns",
    "Conventions",
    "Coordinates",
    "Corners",
    "Derivatives",
    "Detections",
    "Differences",
    "Directions",
    "Does",
    "Edges",
    "Errors",
    "Gaps",
    "Has",
    "Heights",
    "His",
    "Indices",
    "Inputs",
    "Is",
    "Its",
    "Items",
    "Lengths",
    "Less",
    "Lines",
    "Minus",
    "Names",
    "Numbers",
    "Others",
    "Pairs",
    "Parameters",
    "Perhaps",
    "Plus",
    "Points",
    "Properties",
    "Results",
    "Rows",
    "Shapes",
    "Sides",
    "Squares",
    "Terms",
    "This",
    "Thus",
    "Times",
    "Units",
    "Us",
    "Values",
    "Vertices",
    "Was",
    "Zeros",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// Adds the source files of a folder and of the folders in it.
fn sources(folder: &Path, files: &mut Vec<std::path::PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, files);
        } else if path.extension().is_some_and(|kind| kind == "rs") {
            files.push(path);
        }
    }
}

/// Returns `true` for the first line of a function, whatever stands before `fn`.
fn is_function(line: &str) -> bool {
    let words = line
        .split_whitespace()
        .map(|word| word.split('(').next().unwrap());
    let before = [
        "pub", "crate)", "super)", "const", "unsafe", "default", "async",
    ];
    let mut words = words.skip_while(|word| before.contains(word));
    words.next() == Some("fn")
}

/// Returns the first line of documentation of every function of a file, with its number.
fn first_lines(text: &str) -> Vec<(usize, &str)> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let is_doc = |line: &str| line.starts_with("///") && !line.starts_with("////");
    let mut first = Vec::new();
    let mut at = 0;
    while at < lines.len() {
        if !is_doc(lines[at]) {
            at += 1;
            continue;
        }
        let start = at;
        at += lines[at..].iter().take_while(|line| is_doc(line)).count();
        // Attributes, which may take several lines, and comments stand between.
        let mut depth = 0_i64;
        let item = lines[at..].iter().find(|line| {
            let inside = depth > 0 || line.starts_with("#[") || line.starts_with("//");
            if depth > 0 || line.starts_with("#[") {
                depth += line.matches('[').count() as i64 - line.matches(']').count() as i64;
            }
            !inside
        });
        // In a macro the first line may be the caller's, and an empty one follows.
        let sentence = lines[start][3..].trim();
        if !sentence.is_empty() && item.is_some_and(|line| is_function(line)) {
            first.push((start + 1, sentence));
        }
    }
    first
}

/// Returns `true` if a sentence begins with a verb in the third person, as far as a list can know.
fn begins_with_verb(sentence: &str) -> bool {
    let word = sentence.split([' ', ',', ':', '.', ';']).next().unwrap();
    let is_word = word.chars().all(char::is_alphabetic);
    let is_capital = word.starts_with(char::is_uppercase);
    is_word && is_capital && word.ends_with('s') && !NO_VERBS.contains(&word)
}

#[test]
fn documentation_of_functions_begins_with_a_verb() {
    for (sentence, expected) in [
        ("Returns the area.", true),
        ("Adds: one more.", true),
        ("The area.", false),
        ("Numbers of a box.", false),
        ("`true` if it is empty.", false),
        ("From a centre.", false),
        ("", false),
    ] {
        assert_eq!(begins_with_verb(sentence), expected, "{sentence}");
    }
    let text =
        "/// Of one.\n#[cfg(\n    any()\n)]\npub(crate) const fn a() {}\n/// A type.\nstruct B;\n";
    assert_eq!(first_lines(text), [(1, "Of one.")]);

    let mut files = Vec::new();
    for folder in FOLDERS {
        sources(&root().join(folder), &mut files);
    }
    files.sort();
    let (mut count, mut wrong) = (0, Vec::new());
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        for (line, sentence) in first_lines(&text) {
            count += 1;
            if !begins_with_verb(sentence) {
                let file = file.strip_prefix(root()).unwrap();
                wrong.push(format!("{}:{line}: {sentence}", file.display()));
            }
        }
    }
    assert!(count > 3000, "{count} functions with documentation");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
