//! The public names, read from the source: verbs are few, and no type stands for a verb of certain shapes. The documents
//! name files that exist.
use geograd::kernels::function;
use geograd::prelude::*;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}
fn read(file: &str) -> String {
    let path = root().join(file);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}
/// The identifier at the front; empty where there is none.
fn word(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_');
    &text[..end.unwrap_or(text.len())]
}

/// Names of the items that a path of public modules leads to, hidden ones included.
#[derive(Default)]
struct Names {
    seen: BTreeSet<PathBuf>,
    items: BTreeSet<String>,
    types: BTreeSet<String>,
    verbs: BTreeSet<String>,
}

impl Names {
    fn of_library() -> Self {
        let mut names = Names::default();
        names.read(&root().join("src/lib.rs"));
        // The one verb with a parameter.
        assert!(names.items.contains("Convert"));
        names.verbs.insert("Convert".to_owned());
        names
    }
    fn read(&mut self, file: &Path) {
        if !self.seen.insert(file.to_owned()) {
            return;
        }
        let text = std::fs::read_to_string(file).unwrap();
        let code: Vec<&str> = text
            .lines()
            .map(|line| line.split("//").next().unwrap().trim())
            .collect();
        let path = |name: &str, attribute: &str| match attribute.strip_prefix("#[path = \"") {
            Some(path) => file.parent().unwrap().join(path.trim_end_matches("\"]")),
            None => child(file, name),
        };
        for (i, line) in code.iter().enumerate() {
            let above = code[..i]
                .iter()
                .rev()
                .take_while(|x| x.starts_with("#["))
                .find(|x| x.starts_with("#[path"));
            let Some(item) = line.strip_prefix("pub ") else {
                continue;
            };
            if let Some(module) = item.strip_prefix("mod ") {
                if module.ends_with(';') {
                    self.read(&path(word(module), above.unwrap_or(&"")));
                }
            } else if let Some(used) = item.strip_prefix("use ") {
                let rest = std::iter::once(used).chain(code[i + 1..].iter().copied());
                let end = rest.clone().position(|x| x.ends_with(';')).unwrap();
                let used = rest.take(end + 1).collect::<String>();
                self.reexport(file, used.trim_end_matches(';'));
            } else if !self.declare(item) {
                let name = word(item);
                let rest = item[name.len()..].trim_start();
                // A verb, `pub Iou: (a, b)`, or an operation with a name of its own.
                if rest.starts_with(": (") {
                    self.verbs.insert(name.to_owned());
                    self.items.insert(name.to_owned());
                } else if rest.starts_with("= \"") {
                    self.items.insert(name.to_owned());
                }
            }
        }
    }
    /// An item of Rust.
    fn declare(&mut self, item: &str) -> bool {
        let words = [
            "struct", "enum", "union", "trait", "type", "const", "static", "fn",
        ];
        let mut item = item;
        let mut declared = false;
        let mut is_type = false;
        while let Some(kind) = words.iter().find(|&&kind| word(item) == kind) {
            declared = true;
            is_type |= ["struct", "enum", "type"].contains(kind);
            item = item[kind.len()..].trim_start();
        }
        if declared && !word(item).is_empty() {
            self.items.insert(word(item).to_owned());
            if is_type {
                self.types.insert(word(item).to_owned());
            }
        }
        declared
    }
    /// The names that a `pub use` gives.
    fn reexport(&mut self, file: &Path, used: &str) {
        for part in used.split(['{', '}', ',']).map(str::trim) {
            let name = part.rsplit(" as ").next().unwrap();
            let name = name.rsplit("::").next().unwrap().trim();
            if name == "*" {
                let module = part.trim_end_matches("::*");
                let module = match module.strip_prefix("crate::kernels::") {
                    Some(inner) => child(&root().join("kernels/mod.rs"), inner),
                    None => child(file, module),
                };
                self.read(&module);
            } else if name != "_" && !name.is_empty() {
                self.items.insert(name.to_owned());
            }
        }
    }
}

/// The file of a module that another file declares.
fn child(file: &Path, name: &str) -> PathBuf {
    let stem = file.file_stem().unwrap();
    let mut folder = file.parent().unwrap().to_owned();
    if stem != "mod" && stem != "lib" {
        folder = folder.join(stem);
    }
    let flat = folder.join(format!("{name}.rs"));
    match flat.exists() {
        true => flat,
        false => folder.join(name).join("mod.rs"),
    }
}

/// Nouns of shapes, as parts of names.
const NOUNS: &[&str] = &[
    "Aabb",
    "Box",
    "Capsule",
    "Circle",
    "Cone",
    "ConvexPolygon",
    "Cylinder",
    "Detectron",
    "Disc",
    "Ellipsoid",
    "Hull",
    "ImageBox",
    "Interval",
    "Kitti",
    "Le",
    "Lidar",
    "Line",
    "NuScenes",
    "Number",
    "Obb",
    "OpenCv",
    "Plane",
    "Point",
    "Polygon",
    "Polyline",
    "Pose",
    "Quad",
    "Ray",
    "Ring",
    "RoundBox",
    "Segment",
    "Sphere",
    "Symmetric3",
    "Tetrahedron",
    "Triangle",
    "Xyxyr",
    "Yaw",
];
fn begins_with_noun(name: &str) -> bool {
    NOUNS.iter().any(|noun| name.starts_with(noun))
}

/// `true` if a name is that of a verb with its shapes, such as `IouObb2`, `AreaOfRing` or `KittiOfYaw`.
fn joins_shapes(name: &str, verbs: &BTreeSet<String>) -> bool {
    let (before, of) = name.split_once("Of").unwrap_or((name, ""));
    if begins_with_noun(before) && begins_with_noun(of) {
        return true;
    }
    let shaped = |verb: &String| {
        let rest = name.strip_prefix(verb.as_str());
        rest.is_some_and(|rest| begins_with_noun(rest.strip_prefix("Of").unwrap_or(rest)))
    };
    !verbs.contains(name) && verbs.iter().any(shaped)
}

#[test]
fn a_verb_is_one_name_whatever_its_shapes() {
    let names = Names::of_library();
    assert!(
        names.seen.len() > 100 && names.items.len() > 500,
        "{}",
        names.items.len()
    );
    for (name, expected) in [
        ("IouObb2", true),
        ("DistancePointSegment", true),
        ("AreaOfRing", true),
        ("KittiOfYaw", true),
        ("Iou", false),
        ("GiouAabb", false),
        ("GiouAabb2", true),
    ] {
        assert_eq!(joins_shapes(name, &names.verbs), expected, "{name}");
    }
    let count = names.verbs.len();
    assert!(
        (40..=71).contains(&count),
        "{count} verbs: {:?}",
        names.verbs
    );
    let joined: Vec<_> = names
        .items
        .iter()
        .filter(|name| joins_shapes(name, &names.verbs))
        .collect();
    assert!(joined.is_empty(), "{joined:?}");
    // `Convert` is a struct with a parameter. An import of another type of that name would hide the verb.
    let hiding: Vec<_> = names.types.intersection(&names.verbs).collect();
    assert_eq!(hiding, ["Convert"]);
}

/// Text between backticks, fenced blocks left out.
fn quoted(text: &str) -> Vec<String> {
    let prose: String = text.split("```").step_by(2).collect();
    prose
        .split('`')
        .skip(1)
        .step_by(2)
        .map(str::to_owned)
        .collect()
}

#[test]
fn documents_name_files_that_exist() {
    let mut found = 0;
    for document in ["README.md", "ARCHITECTURE.md", "CHANGELOG.md"] {
        let text = read(document);
        let links = text
            .split("](")
            .skip(1)
            .map(|x| x.split(')').next().unwrap().to_owned());
        let links = links.filter(|link| !link.contains("://") && !link.starts_with('#'));
        let is_path = |x: &String| {
            let kinds = [".rs", ".md", ".toml", ".wgsl", ".txt", "/", ".ci/run"];
            kinds.iter().any(|kind| x.ends_with(kind)) && !x.contains(['<', ' ', '*', '…'])
        };
        for path in links.chain(quoted(&text).into_iter().filter(is_path)) {
            assert!(root().join(&path).exists(), "{document} names {path}");
            found += 1;
        }
    }
    assert!(found > 30, "{found}");
}

#[test]
fn readme_installs_from_the_repository_of_the_package() {
    let manifest = read("Cargo.toml");
    let of = |line: &str| line.split('"').nth(1).unwrap().to_owned();
    let mut lines = manifest.lines();
    let repository = of(lines
        .find(|line| line.starts_with("repository = "))
        .unwrap());
    let readme = read("README.md");
    let lines = readme.lines().filter(|line| line.contains("git = "));
    let addresses: Vec<String> = lines.map(of).collect();
    assert_eq!(addresses, [repository.clone(), repository]);
}

/// The programs of README print what README says.
#[test]
fn readme_shows_what_its_programs_print() {
    let truth = Obb2::new(0.0_f64, 0.0, 4.0, 2.0, 0.0);
    let guess = Obb2::new(0.5, 0.2, 4.2, 1.8, 0.1);
    let cpu = Cpu::new();
    let run = Iou.value_grad();
    let (iou, (by_guess, _)) = cpu.aligned(run, (&[guess], One(truth))).unwrap();
    let posts = [Circle::new(Vec2::new(9.0, 0.0), 1.0)];
    let distances = cpu.all_pairs(Distance, &posts, &[truth, guess]).unwrap();
    let clearance = function(|point: Vec2<_>, car: Obb2<_>, margin| point.distance(car) - margin);
    let points = [Vec2::new(5.0, 0.0), Vec2::new(0.0, 3.0)];
    let car = Obb2::new(0.0_f64, 0.0, 4.0, 2.0, 0.3);
    let columns = (&points, One(car), One(0.5));
    let (value, (_, by_car, _)) = cpu.aligned(clearance.value_grad(), columns).unwrap();
    let (far, heading) = (guess.distance(Vec2::new(5.0, 0.2)), by_guess[0].heading);
    let printed = [
        format!("IoU {:.3}, distance {far:.1}", guess.iou(truth)),
        format!("IoU {:.3}, derivative by heading {heading:.3}", iou[0]),
        format!("distances {:.3?}", distances.values()),
        format!(
            "{value:.3?}, derivative by heading {:.3}",
            by_car[0].heading
        ),
    ];
    let readme = read("README.md");
    for line in printed {
        assert!(readme.lines().any(|shown| shown == line), "{line}");
    }
}
