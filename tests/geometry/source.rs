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

/// One module may hold `unsafe`; every other one forbids it, and cannot be told otherwise.
#[test]
fn only_one_module_is_unsafe() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let mut files = Vec::new();
    for folder in ["src", "ad", "kernels"] {
        sources(&root.join(folder), &mut files);
    }
    assert!(files.len() > 50);
    // Parents of the one module cannot forbid it; they declare modules and hold no unsafe code.
    let one = Path::new("kernels/cpu/arch");
    let parents = ["kernels", "arch", "cpu"];
    let mut declared = 0;
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        let file = file.strip_prefix(root).unwrap();
        if file.starts_with(one) {
            continue;
        }
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        for (i, line) in lines.iter().enumerate() {
            let words = line.split("//").next().unwrap();
            let is_lint = words.starts_with("#[forbid(unsafe_code)]")
                || words.starts_with("#![deny(unsafe_code)]")
                || file == Path::new("kernels/cpu/mod.rs") && words == "#[allow(unsafe_code)]";
            assert!(
                is_lint || !words.contains("unsafe"),
                "{}: {line}",
                file.display()
            );
            let module = words
                .trim_start_matches("pub ")
                .trim_start_matches("pub(crate) ");
            let Some(name) = module
                .strip_prefix("mod ")
                .and_then(|x| x.strip_suffix(';'))
            else {
                continue;
            };
            let is_parent = parents.contains(&name);
            let is_top = matches!(
                file.to_str().unwrap().replace('\\', "/").as_str(),
                "src/lib.rs" | "kernels/mod.rs" | "kernels/cpu/mod.rs"
            );
            if is_top && !is_parent {
                let above = lines[..i].iter().rev().take(3);
                let mut above = above.take_while(|line| line.starts_with("#["));
                assert!(
                    above.any(|&line| line == "#[forbid(unsafe_code)]"),
                    "{}: `{name}` does not forbid unsafe code",
                    file.display()
                );
                declared += 1;
            }
        }
    }
    assert!(declared > 20);
}

/// The layers that a folder may use: `src` neither derivatives nor batches, `ad` no batches. Links in documentation
/// may lead anywhere.
#[test]
fn layers_use_those_below() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    // The root of the library, what the derive writes, a module of links, and a test beside its code.
    let excepted = [
        "src/lib.rs",
        "src/derived.rs",
        "src/detection.rs",
        "src/scalar/dual_vector.rs",
    ];
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
