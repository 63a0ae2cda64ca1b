//! Rules of the source, checked.
use std::path::{Path, PathBuf};

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|kind| kind == "rs") {
            found.push(path);
        }
    }
}

/// Two modules hold `unsafe`: vectors, and shapes as numbers. The lint of the workspace denies it everywhere else.
#[test]
fn only_two_modules_are_unsafe() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let manifest = std::fs::read_to_string(root.join("Cargo.toml")).unwrap();
    assert!(manifest.contains("\nunsafe_code = \"deny\"\n"));
    let mut files = Vec::new();
    for folder in ["src", "ad", "kernels"] {
        sources(&root.join(folder), &mut files);
    }
    assert!(files.len() > 50);
    let holders = ["kernels/cpu/arch", "kernels/row/item/memory.rs"];
    let parents = ["kernels/cpu/mod.rs", "kernels/row/item/mod.rs"].map(Path::new);
    let mut allowed = 0;
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        let file = file.strip_prefix(root).unwrap();
        if holders.iter().any(|holder| file.starts_with(holder)) {
            continue;
        }
        for line in text.lines() {
            let words = line.split("//").next().unwrap().trim();
            let allows = words == "#[allow(unsafe_code)]" && parents.contains(&file);
            allowed += usize::from(allows);
            let is_free = allows || !words.contains("unsafe");
            assert!(is_free, "{}: {line}", file.display());
        }
    }
    assert_eq!(allowed, parents.len());
}

/// The layers that a folder may use: `src` neither derivatives nor batches, `ad` no batches. Links in documentation
/// may lead anywhere.
#[test]
fn layers_use_those_below() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    // The root of the library, and what the derive writes.
    let excepted = ["src/lib.rs", "src/derived.rs"];
    for (folder, above) in [
        ("src", &["crate::ad", "crate::kernels"][..]),
        ("ad", &["crate::kernels"]),
    ] {
        let mut files = Vec::new();
        sources(&root.join(folder), &mut files);
        assert!(files.len() > 20, "{folder}");
        for file in files {
            let name = file
                .strip_prefix(root)
                .unwrap()
                .to_str()
                .unwrap()
                .replace('\\', "/");
            if excepted.contains(&name.as_str()) {
                continue;
            }
            let text = std::fs::read_to_string(&file).unwrap();
            for (number, line) in text.lines().enumerate() {
                let code = line.split("//").next().unwrap();
                let is_link = code.trim_start().starts_with("#[doc") || code.contains("#![doc");
                for layer in above.iter().filter(|_| !is_link) {
                    assert!(!code.contains(layer), "{name}:{}: {line}", number + 1);
                }
            }
        }
    }
}

/// Every row in both formats is four times the code of the library: the crate that asks for all rows compiles them.
/// So a function that asks is inlined into its caller, or has types of its caller.
#[test]
fn the_library_compiles_no_list_of_all_rows() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let (mut files, mut asking) = (Vec::new(), 0);
    for folder in ["src", "ad", "kernels"] {
        sources(&root.join(folder), &mut files);
    }
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        let asks = |line: &str| {
            let code = line.split("//").next().unwrap();
            ["rows()", "operations()", "ops::each("].iter().any(|call| {
                code.find(call).is_some_and(|at| {
                    let before = code[..at].chars().next_back().unwrap_or(' ');
                    !code[..at].ends_with("fn ")
                        && !before.is_alphanumeric()
                        && !"._".contains(before)
                })
            })
        };
        for (at, line) in lines.iter().enumerate().filter(|(_, line)| asks(line)) {
            let is_function =
                |line: &str| line.trim_start().starts_with("fn ") || line.contains(" fn ");
            let head = lines[..=at]
                .iter()
                .rposition(|line| is_function(line))
                .unwrap();
            let attributes = lines[..head].iter().rev();
            let mut attributes =
                attributes.take_while(|line| line.trim_start().starts_with(['#', '/']));
            let place = format!("{}:{}: {}", file.display(), at + 1, line.trim());
            let is_generic = lines[head].split('(').next().unwrap().contains('<');
            let is_callers = is_generic || attributes.any(|line| line.trim() == "#[inline]");
            assert!(is_callers, "compiles every row with the library: {place}");
            asking += 1;
        }
    }
    assert!(asking >= 4, "{asking}");
}
