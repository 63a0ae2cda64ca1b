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
