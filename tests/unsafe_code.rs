//! Unsafe code is where it is looked for. That each block says why it is sound is clippy's to demand
//! (`undocumented_unsafe_blocks`), and that unsafe functions have such blocks, too, the compiler's; both read
//! `Cargo.toml`. What they cannot see is who lifts their ban.

use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All Rust sources below a directory or, if it is one, the file itself.
fn sources(path: &Path) -> Vec<PathBuf> {
    if path.is_dir() {
        let entries = std::fs::read_dir(path).expect("a directory of sources can be read");
        return entries.flat_map(|entry| sources(&entry.expect("an entry").path())).collect();
    }
    path.extension().filter(|e| *e == "rs").map(|_| path.to_path_buf()).into_iter().collect()
}

/// Whether a source says a word outside of comments, as a word of its own.
fn says(text: &str, word: &str) -> bool {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    code.flat_map(|line| line.split(|c: char| !c.is_alphanumeric() && c != '_')).any(|w| w == word)
}

/// Those of the files that say a word.
fn that_say(word: &str, paths: &[PathBuf]) -> Vec<String> {
    let says = |path: &PathBuf| says(&std::fs::read_to_string(path).expect("a source can be read"), word);
    let name = |path: &PathBuf| path.strip_prefix(root()).expect("it lies within").display().to_string();
    let mut names: Vec<_> = paths.iter().filter(|path| says(path)).map(name).collect();
    names.sort();
    names
}

#[test]
fn the_library_is_unsafe_in_capi_only() {
    let paths = [sources(&root().join("src")), vec![root().join("build.rs")]].concat();
    let unsafe_files = that_say("unsafe", &paths);
    assert!(unsafe_files.len() > 10, "hardly any unsafe code was found, so it was not looked for: {unsafe_files:?}");
    let elsewhere: Vec<_> = unsafe_files.iter().filter(|name| !name.starts_with("src/capi/")).collect();
    assert!(elsewhere.is_empty(), "unsafe code outside of src/capi: {elsewhere:?}");
}

#[test]
fn no_more_than_one_module_lifts_the_ban() {
    assert_eq!(that_say("unsafe_code", &sources(&root().join("src"))), ["src/capi/mod.rs"]);
    let lints = std::fs::read_to_string(root().join("Cargo.toml")).expect("the manifest is there");
    for lint in ["unsafe_code", "unsafe_op_in_unsafe_fn", "undocumented_unsafe_blocks"] {
        assert!(lints.contains(&format!("\n{lint} = \"deny\"\n")), "Cargo.toml does not deny {lint}");
        let lifted = that_say(lint, &sources(&root().join("src")));
        assert!(lint == "unsafe_code" || lifted.is_empty(), "{lint} is mentioned in {lifted:?}");
    }
}

#[test]
fn words_are_told_from_parts_of_words_and_from_comments() {
    assert!(says("let x = unsafe{ 1 };", "unsafe") && says("#[unsafe(no_mangle)]", "unsafe"));
    assert!(!says("#![deny(unsafe_code)] // unsafe\n/// unsafe", "unsafe"));
}
