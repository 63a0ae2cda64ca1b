//! The order of the source, read from its files' names and their `mod` and `use` lines: no file imports itself on a way
//! over others, but for known ones, and no two files of a crate have one name without a reason. A name that a module
//! passes on counts as an import of the file that defines it.
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// All source files from a folder on, from the root of the repository; what is built and what is hidden left out.
fn sources(folder: &Path, found: &mut BTreeSet<String>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        if path.is_dir() && name != "target" && !name.starts_with('.') {
            sources(&path, found);
        } else if path.extension().is_some_and(|kind| kind == "rs") {
            let path = path.strip_prefix(root()).unwrap().to_str().unwrap();
            found.insert(path.replace('\\', "/"));
        }
    }
}

/// The code of a file without comments.
fn code(file: &str) -> String {
    let text = std::fs::read_to_string(root().join(file)).unwrap();
    let lines = text.lines().map(|line| line.split("//").next().unwrap());
    lines.collect::<Vec<_>>().join("\n")
}

/// A file that declares modules.
fn is_face(file: &str) -> bool {
    ["mod.rs", "lib.rs", "main.rs"].contains(&file.rsplit('/').next().unwrap())
}

/// The modules of a crate by their paths, beginning with its root.
fn modules(file: &str, path: &str, found: &mut BTreeMap<String, String>) {
    found.insert(path.to_owned(), file.to_owned());
    let (at, text) = (Path::new(file), code(file));
    let folder = match is_face(file) || path == "crate" {
        true => at.parent().unwrap().to_owned(),
        false => at.with_extension(""),
    };
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    for (i, line) in lines.iter().enumerate() {
        let Some(name) = line.strip_suffix(';').and_then(|x| x.rsplit_once("mod ")) else {
            continue;
        };
        let above = lines[..i].iter().rev().take_while(|x| x.starts_with("#["));
        let given = above.filter_map(|x| x.strip_prefix("#[path = \"")?.strip_suffix("\"]"));
        let next = match given.last() {
            Some(given) => folder_of(at).join(given),
            None => {
                let flat = folder.join(name.1).with_extension("rs");
                match root().join(&flat).exists() {
                    true => flat,
                    false => folder.join(name.1).join("mod.rs"),
                }
            }
        };
        let next = simple(&next);
        if root().join(&next).exists() {
            modules(&next, &format!("{path}::{}", name.1), found);
        }
    }
}

fn folder_of(file: &Path) -> &Path {
    file.parent().unwrap()
}

/// A path without steps back.
fn simple(path: &Path) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.iter().map(|part| part.to_str().unwrap()) {
        match part {
            ".." => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    parts.join("/")
}

/// The paths that a `use` of several names stands for.
fn spread(tree: &str) -> Vec<String> {
    let Some((head, rest)) = tree.split_once('{') else {
        return vec![tree.trim().to_owned()];
    };
    let inner = rest
        .trim()
        .trim_end_matches(',')
        .strip_suffix('}')
        .unwrap_or(rest);
    let (mut parts, mut depth, mut from) = (Vec::new(), 0, 0);
    for (i, c) in inner.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&inner[from..i]);
                from = i + 1;
            }
            _ => {}
        }
    }
    parts.push(&inner[from..]);
    let parts = parts.into_iter().filter(|part| !part.trim().is_empty());
    let whole = |part: &str| spread(&format!("{}{}", head.trim(), part.trim()));
    parts.flat_map(whole).collect()
}

/// The paths of the `use` lines of a text: of names that it takes, or of those that it passes on.
fn uses(text: &str, passed_on: bool) -> Vec<String> {
    let mut all = Vec::new();
    for (at, _) in text.match_indices("use ") {
        let before = text[..at].rsplit('\n').next().unwrap_or("").trim();
        let is_wanted = match passed_on {
            true => before.starts_with("pub"),
            false => before.is_empty(),
        };
        if is_wanted {
            let end = text[at..].find(';').unwrap_or(0);
            all.extend(spread(&text[at..at + end][4..].replace('\n', " ")));
        }
    }
    all
}

/// The paths that a file takes: those of its `use` lines but for names that it passes on, and those that begin with
/// `crate` or `super` elsewhere.
fn named(file: &str) -> Vec<String> {
    let text = code(file);
    let mut all = uses(&text, false);
    // The rest of the text, without `use` lines, each of which ends at its semicolon.
    let mut in_use = false;
    let is_rest = |line: &&str| {
        let line = line.trim();
        let starts = line.starts_with("use ") || line.starts_with("pub") && line.contains(" use ");
        let is_rest = !(in_use || starts);
        in_use = !is_rest && !line.ends_with(';');
        is_rest
    };
    let text: String = text.split_inclusive('\n').filter(is_rest).collect();
    for start in ["crate::", "super::"] {
        for (at, _) in text.match_indices(start) {
            let before = text[..at].chars().next_back();
            if before.is_none_or(|c| !c.is_alphanumeric() && !"_$:".contains(c)) {
                let end = |c: char| !c.is_alphanumeric() && !"_:".contains(c);
                let end = text[at..].find(end).unwrap_or(text.len() - at);
                all.push(text[at..at + end].to_owned());
            }
        }
    }
    all
}

/// A crate's modules, and of each the names that it passes on, by the paths that they have there.
struct Crate {
    modules: BTreeMap<String, String>,
    passed_on: BTreeMap<String, Vec<(String, String)>>,
    texts: BTreeMap<String, String>,
}

impl Crate {
    fn new(start: &str) -> Self {
        let mut found = BTreeMap::new();
        modules(start, "crate", &mut found);
        let texts: BTreeMap<_, _> = found
            .iter()
            .map(|(module, file)| (module.clone(), code(file)))
            .collect();
        let passed_on = |text: &String| {
            let paths = uses(text, true).into_iter();
            let named = |path: String| match path.split_once(" as ") {
                Some((path, name)) => (name.trim().to_owned(), path.trim().to_owned()),
                None => (path.rsplit("::").next().unwrap().trim().to_owned(), path),
            };
            paths.map(named).collect()
        };
        Crate {
            passed_on: texts
                .iter()
                .map(|(module, text)| (module.clone(), passed_on(text)))
                .collect(),
            modules: found,
            texts,
        }
    }

    /// `true` for a module whose own text defines an item of a name.
    fn defines(&self, module: &str, name: &str) -> bool {
        const ITEMS: [&str; 9] = [
            "struct ",
            "enum ",
            "trait ",
            "type ",
            "fn ",
            "const ",
            "static ",
            "mod ",
            "macro_rules! ",
        ];
        let text = &self.texts[module];
        ITEMS.iter().any(|item| {
            let item = format!("{item}{name}");
            text.match_indices(&item).any(|(at, _)| {
                let next = text[at + item.len()..].chars().next();
                next.is_none_or(|c| !c.is_alphanumeric() && c != '_')
            })
        })
    }

    /// The module that a path leads to from another one: the last of its parts that is one or, for a name that is passed
    /// on, the module that has it.
    fn target(&self, path: &str, from: &str, depth: usize) -> Option<String> {
        let mut parts = path.split("::").map(str::trim).peekable();
        let mut at = match parts.peek() {
            Some(&"crate") => {
                parts.next();
                "crate".to_owned()
            }
            Some(&("super" | "self")) => from.to_owned(),
            // A name of a module beside, which a face passes on.
            Some(first) if self.modules.contains_key(&format!("{from}::{first}")) => {
                from.to_owned()
            }
            _ => return None,
        };
        for part in parts {
            let part = part.split(" as ").next().unwrap();
            let next = format!("{at}::{part}");
            match part {
                "self" => {}
                "super" => at = at.rsplit_once("::")?.0.to_owned(),
                _ if self.modules.contains_key(&next) => at = next,
                part => return self.origin(part, &at, depth),
            }
        }
        Some(at)
    }

    /// The module in which a name of a module is defined.
    fn origin(&self, name: &str, at: &str, depth: usize) -> Option<String> {
        if depth == 0 || self.defines(at, name) {
            return Some(at.to_owned());
        }
        let of = self.passed_on[at].iter();
        let by_name = of.clone().find(|(other, _)| other == name);
        if let Some((_, path)) = by_name {
            return self.target(path, at, depth - 1).or(Some(at.to_owned()));
        }
        let globs = of.filter(|(other, _)| other == "*");
        for (_, path) in globs {
            let inner = self.target(path.trim_end_matches("::*"), at, depth - 1);
            let found = inner.and_then(|inner| self.origin(name, &inner, depth - 1));
            if found
                .as_ref()
                .is_some_and(|found| self.defines(found, name))
            {
                return found;
            }
        }
        Some(at.to_owned())
    }
}

/// The files that every file of a crate imports: those that define what it names, whoever passes it on.
fn imports(start: &str) -> BTreeMap<String, BTreeSet<String>> {
    let of = Crate::new(start);
    let mut all: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (module, file) in &of.modules {
        let paths = named(file);
        let used = paths
            .iter()
            .filter_map(|path| of.target(path, module, 8))
            .map(|other| of.modules[&other].clone())
            .filter(|other| other != file);
        all.entry(file.clone()).or_default().extend(used);
    }
    all
}

/// The files that a file leads to.
fn beyond<'a>(file: &str, imports: &'a BTreeMap<String, BTreeSet<String>>) -> BTreeSet<&'a str> {
    let (mut found, mut next) = (BTreeSet::new(), vec![file]);
    while let Some(file) = next.pop() {
        for other in &imports[file] {
            if found.insert(other.as_str()) {
                next.push(other);
            }
        }
    }
    found
}

/// The folders of `kernels/`, from below: a file imports those of its own folder and of folders before it.
const FLOORS: [&str; 12] = [
    "row", "call", "machine", "cpu", "gpu", "backend", "verbs", "ops", "dynamic", "check", "fuzz",
    "mod.rs",
];

/// The floor of a file of `kernels/`.
fn floor(file: &str) -> Option<usize> {
    let folder = file.strip_prefix("kernels/")?.split('/').next().unwrap();
    let found = FLOORS.iter().position(|floor| *floor == folder);
    Some(found.unwrap_or_else(|| panic!("{file} is on no floor")))
}

/// No file of `kernels/` imports one of a floor above its own.
#[test]
fn no_folder_imports_one_above() {
    let all = imports("src/lib.rs");
    let (mut upward, mut arrows) = (Vec::new(), 0);
    for (file, others) in &all {
        let Some(own) = floor(file) else { continue };
        for other in others {
            let Some(theirs) = floor(other) else { continue };
            arrows += 1;
            if theirs > own {
                upward.push(format!("{file} imports {other}"));
            }
        }
    }
    assert!(upward.is_empty(), "{upward:#?}");
    assert!(arrows > 700, "{arrows} imports");
}

/// Files that import each other on ways over others. The list may only shrink.
const KNOWN: [&[&str]; 7] = [
    &["benches/peers/gpu/list.rs", "benches/peers/gpu/main.rs"],
    &[
        "examples/iou_csv/boxes/mod.rs",
        "examples/iou_csv/input.rs",
        "examples/iou_csv/main.rs",
        "examples/iou_csv/polygon/mod.rs",
        "examples/iou_csv/polygon/part.rs",
    ],
    &[
        "examples/refine_detections/svg/close_up.rs",
        "examples/refine_detections/svg/mod.rs",
    ],
    &[
        "kernels/backend.rs",
        "kernels/bounds.rs",
        "kernels/cpu/aligned.rs",
        "kernels/cpu/arch/entry.rs",
        "kernels/cpu/arch/native.rs",
        "kernels/cpu/checked.rs",
        "kernels/cpu/drivers.rs",
        "kernels/cpu/folds/folding.rs",
        "kernels/cpu/folds/mod.rs",
        "kernels/cpu/folds/paths.rs",
        "kernels/cpu/folds/programs.rs",
        "kernels/cpu/greedy.rs",
        "kernels/cpu/grouped.rs",
        "kernels/cpu/mod.rs",
        "kernels/cpu/nearest.rs",
        "kernels/cpu/pairs.rs",
        "kernels/cpu/plan/compiled.rs",
        "kernels/cpu/plan/computation.rs",
        "kernels/cpu/plan/makers.rs",
        "kernels/cpu/plan/mod.rs",
        "kernels/cpu/polygons.rs",
        "kernels/cpu/program/execute.rs",
        "kernels/cpu/program/mod.rs",
        "kernels/cpu/program/native/compile.rs",
        "kernels/cpu/program/rowwise.rs",
        "kernels/cpu/quads.rs",
        "kernels/cpu/ragged.rs",
        "kernels/cpu/reductions.rs",
        "kernels/cpu/stretches.rs",
        "kernels/cpu/sweep.rs",
        "kernels/cpu/table.rs",
        "kernels/cpu/tree.rs",
        "kernels/dynamic/catalogue.rs",
        "kernels/dynamic/described.rs",
        "kernels/dynamic/forms.rs",
        "kernels/dynamic/paths.rs",
        "kernels/dynamic/program.rs",
        "kernels/dynamic/rows.rs",
        "kernels/formats.rs",
        "kernels/gpu/device/block.rs",
        "kernels/gpu/device/data.rs",
        "kernels/gpu/device/download.rs",
        "kernels/gpu/device/generated/aligned.rs",
        "kernels/gpu/device/generated/held/mod.rs",
        "kernels/gpu/device/generated/mod.rs",
        "kernels/gpu/device/generated/operation.rs",
        "kernels/gpu/device/generated/template.rs",
        "kernels/gpu/device/generated/text.rs",
        "kernels/gpu/device/generated/uploaded.rs",
        "kernels/gpu/device/matrix.rs",
        "kernels/gpu/device/mod.rs",
        "kernels/gpu/device/reduce.rs",
        "kernels/gpu/device/reducer.rs",
        "kernels/gpu/device/seed.rs",
        "kernels/gpu/device/work.rs",
        "kernels/gpu/device/written.rs",
        "kernels/item/column.rs",
        "kernels/item/layout.rs",
        "kernels/machine/all_pairs.rs",
        "kernels/machine/location.rs",
        "kernels/machine/mod.rs",
        "kernels/machine/primitives.rs",
        "kernels/modes.rs",
        "kernels/op.rs",
        "kernels/ops/walk.rs",
        "kernels/recording.rs",
        "kernels/reduce.rs",
        "kernels/replayed.rs",
        "kernels/resident/held.rs",
        "kernels/resident/mod.rs",
        "kernels/search.rs",
        "kernels/suppress.rs",
        "kernels/targets.rs",
    ],
    &[
        "kernels/check/mod.rs",
        "kernels/fuzz/mod.rs",
        "kernels/fuzz/properties.rs",
    ],
    &[
        "kernels/cpu/arch/x86/items.rs",
        "kernels/cpu/arch/x86/mod.rs",
    ],
    &[
        "kernels/identities/mod.rs",
        "kernels/identities/sentences.rs",
    ],
];

/// The sets of files of which each leads to all others.
fn circles(imports: &BTreeMap<String, BTreeSet<String>>) -> BTreeSet<BTreeSet<String>> {
    let beyond: BTreeMap<&str, BTreeSet<&str>> = imports
        .keys()
        .map(|file| (file.as_str(), beyond(file, imports)))
        .collect();
    let of = |file: &str| -> BTreeSet<String> {
        let others = beyond[file].iter();
        let back = others.filter(|other| beyond[**other].contains(file));
        back.map(|other| (*other).to_owned()).collect()
    };
    imports
        .keys()
        .map(|file| of(file))
        .filter(|all| !all.is_empty())
        .collect()
}

/// No circle of imports in any crate of the repository, but for those that are known.
#[test]
fn no_file_imports_itself() {
    let mut all = BTreeSet::new();
    sources(root(), &mut all);
    let starts = all.iter().filter(|file| {
        let name = file.rsplit('/').next().unwrap();
        ["lib.rs", "main.rs"].contains(&name)
    });
    let (mut files, mut arrows, mut found) = (0, 0, BTreeSet::new());
    for start in starts {
        let imports = imports(start);
        files += imports.len();
        arrows += imports.values().map(BTreeSet::len).sum::<usize>();
        found.extend(circles(&imports));
    }
    let is_known = |circle: &&BTreeSet<String>| {
        let holds = |known: &&[&str]| circle.iter().all(|file| known.contains(&file.as_str()));
        KNOWN.iter().any(holds)
    };
    let new: Vec<_> = found.iter().filter(|circle| !is_known(circle)).collect();
    assert!(new.is_empty(), "circles of imports: {new:#?}");
    let open: Vec<&&str> = KNOWN
        .iter()
        .flat_map(|known| known.iter())
        .filter(|file| !found.iter().any(|circle| circle.contains(**file)))
        .collect();
    assert!(
        open.is_empty(),
        "in no circle any more, and listed: {open:?}"
    );
    // The reading itself: a library of some hundred files, and imports of each.
    assert!(
        files > 500 && arrows > 3000,
        "{files} files, {arrows} imports"
    );
}

/// Parts of the library: the folder that a file is in, the innermost first.
const PARTS: [&str; 15] = [
    "src",
    "ad/adjoint",
    "ad/check",
    "ad/program",
    "ad/sample",
    "ad",
    "kernels/check",
    "kernels/cpu",
    "kernels/dynamic",
    "kernels/fuzz",
    "kernels/gpu",
    "kernels/ops",
    "kernels/resident",
    "kernels/verbs",
    "kernels",
];

/// Parts whose files of one name speak of one thing: a formula, its adjoint and its rows; a call and how each machine
/// and the calls by name run it; the harness, and the harness of rows.
const MIRRORS: [&[&str]; 3] = [
    &["src", "ad/adjoint", "kernels/ops"],
    &[
        "kernels",
        "kernels/cpu",
        "kernels/gpu",
        "kernels/resident",
        "kernels/dynamic",
    ],
    &["ad/check", "kernels/check"],
];

fn part(file: &str) -> Option<&'static str> {
    let holds = |part: &&&str| {
        file.strip_prefix(**part)
            .is_some_and(|x| x.starts_with('/'))
    };
    PARTS.iter().find(holds).copied()
}

/// The folder of `src/` that a file is in; empty for a file beside them.
fn family(file: &str) -> &str {
    let inner = file.strip_prefix("src/").unwrap_or(file);
    inner.split_once('/').map_or("", |(family, _)| family)
}

/// `true` for two files whose one name is on purpose.
fn are_mirrors(a: &str, b: &str) -> bool {
    let (Some(own), Some(other)) = (part(a), part(b)) else {
        // Beside the library: folders side by side, such as tests of the plane and of space.
        let folders = |file: &str| {
            let mut parts: Vec<String> = file.split('/').map(str::to_owned).collect();
            parts.truncate(parts.len() - 1);
            (parts.pop(), parts)
        };
        let ((own, above), (other, over)) = (folders(a), folders(b));
        return own != other && above == over && above.len() > 1;
    };
    if own != other {
        return MIRRORS
            .iter()
            .any(|parts| parts.contains(&own) && parts.contains(&other));
    }
    // Two families of formulas: of the plane and of space, or what both have for one shape.
    let (own, other) = (family(a), family(b));
    let stem = a.rsplit('/').next().unwrap();
    // A ring is a slice of points, and so has no file among shapes.
    let is_of_shape = stem == "ring.rs" || root().join("src/shape").join(stem).exists();
    let are_dimensions = format!("{own}3") == other || format!("{other}3") == own;
    a.starts_with("src/") && own != other && (is_of_shape || are_dimensions)
}

/// Within a crate a file's name is its own.
#[test]
fn no_name_twice() {
    let mut all = BTreeSet::new();
    sources(root(), &mut all);
    let mut stems: BTreeMap<(String, &str), Vec<&str>> = BTreeMap::new();
    let starts: Vec<&String> = all.iter().filter(|file| is_face(file)).collect();
    for file in all.iter().filter(|file| !is_face(file)) {
        let name = file.rsplit('/').next().unwrap();
        let crate_of = match part(file) {
            Some(_) => "library".to_owned(),
            // The innermost folder with a root, or the file's own.
            None => {
                let within = |start: &&&String| {
                    let folder = start.rsplit_once('/').map_or("", |x| x.0);
                    !start.ends_with("/mod.rs") && file.starts_with(&format!("{folder}/"))
                };
                let start = starts.iter().filter(within).max_by_key(|start| start.len());
                start.map_or_else(|| file.clone(), |start| (*start).clone())
            }
        };
        stems.entry((crate_of, name)).or_default().push(file);
    }
    let mut doubled = Vec::new();
    for files in stems.values() {
        for (i, a) in files.iter().enumerate() {
            let others = files[i + 1..].iter().filter(|b| !are_mirrors(a, b));
            doubled.extend(others.map(|b| format!("{a} and {b}")));
        }
    }
    assert!(doubled.is_empty(), "{doubled:#?}");
    // The reading itself: mirrors exist, and what is none is told apart.
    assert!(stems.values().filter(|files| files.len() > 1).count() > 20);
    assert!(are_mirrors("src/overlap.rs", "ad/adjoint/overlap.rs"));
    assert!(!are_mirrors("src/overlap.rs", "kernels/cpu/overlap.rs"));
    assert!(!are_mirrors(
        "kernels/cpu/plan/face.rs",
        "kernels/cpu/program/face.rs"
    ));
}

/// Public types of one name that are one thing in two forms.
const FORMS: [(&str, &str); 6] = [
    ("Frame", "of a data set, by two rules of detection"),
    ("Function", "by types, and by name"),
    ("Judged", "the result of two rules of detection"),
    ("Matrix", "in memory, and on a machine"),
    ("Program", "by types, and by name"),
    ("Rings", "in memory, and on a machine"),
];

/// The public types that files define: of every name the files, but those without a GPU, which repeat those of one.
fn public_types() -> BTreeMap<String, BTreeSet<String>> {
    let mut all = BTreeSet::new();
    sources(root(), &mut all);
    let mut modules_of = BTreeMap::new();
    modules("src/lib.rs", "crate", &mut modules_of);
    let path_of: BTreeMap<&str, &str> = modules_of
        .iter()
        .map(|(path, file)| (file.as_str(), path.as_str()))
        .collect();
    // A module is public if every `mod` on the way to it is; a type also where such a module passes it on.
    let texts: BTreeMap<&str, String> = path_of.keys().map(|&file| (file, code(file))).collect();
    let is_public = |path: &str| {
        let parts: Vec<&str> = path.split("::").collect();
        (1..parts.len()).all(|k| {
            let text = &texts[modules_of[&parts[..k].join("::")].as_str()];
            text.contains(&format!("pub mod {};", parts[k]))
        })
    };
    let mut uses = BTreeSet::new();
    for (file, text) in &texts {
        if is_public(path_of[file]) {
            uses.append(&mut spread_uses(text));
        }
    }
    let mut types: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (&file, &path) in &path_of {
        if file == "kernels/gpu/none.rs" {
            continue;
        }
        for line in texts[file].lines() {
            let kinds = ["pub struct ", "pub enum ", "pub trait ", "pub type "];
            let Some(item) = kinds.iter().find_map(|kind| line.strip_prefix(kind)) else {
                continue;
            };
            let end = item
                .find(|c: char| !c.is_alphanumeric())
                .unwrap_or(item.len());
            let name = &item[..end];
            let stem = path.rsplit_once("::").map_or("", |x| x.1);
            let way = format!("{stem}::{name}");
            let passed_on = || uses.iter().any(|x| x.ends_with(&way));
            if is_public(path) || passed_on() {
                types
                    .entry(name.to_owned())
                    .or_default()
                    .insert(file.to_owned());
            }
        }
    }
    types
}

/// The paths that `pub use` of a file passes on.
fn spread_uses(text: &str) -> BTreeSet<String> {
    let lines = text
        .split(';')
        .filter_map(|x| x.trim().rsplit_once("pub use "));
    lines.flat_map(|(_, tree)| spread(tree)).collect()
}

/// A public type's name has one meaning.
#[test]
fn no_public_type_twice() {
    let types = public_types();
    assert!(types.len() > 250, "{}", types.len());
    let twice: BTreeMap<_, _> = types.iter().filter(|(_, files)| files.len() > 1).collect();
    let names: Vec<&str> = twice.keys().map(|name| name.as_str()).collect();
    assert_eq!(names, FORMS.map(|form| form.0), "{twice:#?}");
}
