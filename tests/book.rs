//! The book in `docs/`: its scenes are written, and its commands run, in an empty folder.

use std::path::{Path, PathBuf};
use std::process::Command;

/// A fenced block: the words after its fence, its text, and the line it begins at.
struct Block {
    words: Vec<String>,
    text: String,
    line: usize,
}

fn blocks(page: &str) -> Vec<Block> {
    let mut found = Vec::new();
    let mut open: Option<Block> = None;
    for (number, line) in page.lines().enumerate() {
        match (line.strip_prefix("```"), &mut open) {
            (Some(_), Some(_)) => found.extend(open.take()),
            (Some(words), None) => {
                let words = words.split_whitespace().map(str::to_owned).collect();
                open = Some(Block { words, text: String::new(), line: number + 2 });
            }
            (None, Some(block)) => block.text += &format!("{line}\n"),
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "a fence is not closed");
    found
}

/// Runs a page and gives the number of its blocks that ran.
fn run(name: &str) -> usize {
    let page = std::fs::read_to_string(docs().join(name)).unwrap();
    let home = tempfile::tempdir().unwrap();
    let folder = Path::new(env!("CARGO_BIN_EXE_seam")).parent().unwrap();
    let path = std::env::join_paths(
        std::iter::once(folder.to_owned()).chain(std::env::split_paths(&std::env::var_os("PATH").unwrap())),
    )
    .unwrap();
    let mut ran = 0;
    for block in blocks(&page) {
        if let Some(file) = block.words.iter().find_map(|word| word.strip_prefix("file=")) {
            std::fs::write(home.path().join(file), &block.text).unwrap();
        }
        if block.words != ["sh", "run"] {
            continue;
        }
        let output = Command::new("sh")
            .args(["-eu", "-c", &block.text])
            .current_dir(home.path())
            .env("PATH", &path)
            .output()
            .unwrap();
        let said = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        assert!(output.status.success(), "docs/{name}, line {}:\n{}", block.line, said.concat());
        ran += 1;
    }
    ran
}

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs")
}

#[test]
fn the_tutorial_runs() {
    assert_eq!(run("tutorial.md"), 6);
}

#[test]
fn the_commands_of_the_other_pages_run() {
    let ran: Vec<usize> = ["verdicts.md", "theory.md", "extending.md"].map(run).to_vec();
    assert_eq!(ran, [1, 1, 1]);
}

#[test]
fn every_link_between_pages_leads_somewhere() {
    for page in std::fs::read_dir(docs()).unwrap().map(|entry| entry.unwrap().path()) {
        if page.extension().is_none_or(|e| e != "md") {
            continue;
        }
        let text = std::fs::read_to_string(&page).unwrap();
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            assert!(docs().join(link).exists(), "{}: {link}", page.display());
        }
    }
}
