//! Lists the folders of `catalogue/`, so that a new case is a new folder and nothing else.

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let root = Path::new(&env::var("CARGO_MANIFEST_DIR").unwrap_or_default()).join("catalogue");
    println!("cargo::rerun-if-changed={}", root.display());
    let mut ids: Vec<String> = fs::read_dir(&root)?
        .filter_map(Result::ok)
        .filter(|entry| entry.path().join("case.toml").is_file())
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    ids.sort();
    let mut list = String::from("&[\n");
    for id in ids {
        let file = |name: &str| format!("{:?}", root.join(&id).join(name));
        let _ = writeln!(
            list,
            "({id:?}, include_str!({}), include_str!({})),",
            file("case.toml"),
            file("page.md")
        );
    }
    list.push(']');
    fs::write(Path::new(&env::var("OUT_DIR").unwrap_or_default()).join("catalogue.rs"), list)
}
