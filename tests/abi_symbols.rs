//! The shared library exports exactly the functions that the header declares, bears its name, and needs nothing but
//! the C library and the compiler's own. (ctest checks the same of the release build.)

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Cargo puts the shared library beside this test.
fn library() -> PathBuf {
    let test = std::env::current_exe().expect("a test has a path");
    let path = test.parent().expect("a file is in a directory").join("libgentrack2.so");
    assert!(path.exists(), "{} is missing", path.display());
    path
}

fn output_of(command: &str, arguments: &[&str]) -> String {
    let output = Command::new(command).args(arguments).arg(library()).output();
    let output = output.unwrap_or_else(|e| panic!("{command} (Debian package binutils): {e}"));
    assert!(output.status.success(), "{command}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

fn header() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("include/gentrack2.h");
    std::fs::read_to_string(path).expect("the header is there")
}

/// Names before an opening parenthesis outside of comments, macros and inline functions.
fn declared_functions() -> BTreeSet<String> {
    let header = header();
    let declarations = header.split("#ifndef GENTRACK2_H").nth(1).expect("the guard comes after the first comment");
    let mut names = BTreeSet::new();
    let mut inline = false;
    for line in declarations.lines() {
        inline = (inline && line != "}") || line.starts_with("static inline");
        if inline || line.starts_with("//") || line.starts_with('#') || line.starts_with([' ', '\t']) {
            continue;
        }
        if let Some((before, _)) = line.split_once('(') {
            let start = before.rfind(|c: char| !c.is_ascii_alphanumeric() && c != '_').map_or(0, |i| i + 1);
            names.insert(before[start..].to_string());
        }
    }
    names
}

#[test]
fn exports_are_the_functions_of_the_header() {
    let symbols = output_of("nm", &["-D", "--defined-only", "--format=posix"]);
    let exported: BTreeSet<String> =
        symbols.lines().map(|l| l.split(' ').next().expect("a name").to_string()).collect();
    let declared = declared_functions();
    assert!(declared.len() > 30, "only {} functions found in the header", declared.len());
    let only_exported: Vec<_> = exported.difference(&declared).collect();
    let only_declared: Vec<_> = declared.difference(&exported).collect();
    assert!(
        only_exported.is_empty() && only_declared.is_empty(),
        "exported but not declared: {only_exported:?}; declared but not exported: {only_declared:?}"
    );
}

/// The names in square brackets in the lines of a kind.
fn dynamic_entries(kind: &str) -> Vec<String> {
    let dynamic = output_of("readelf", &["-d"]);
    let in_brackets = |line: &str| Some(line.split_once('[')?.1.split_once(']')?.0.to_string());
    dynamic.lines().filter(|l| l.contains(kind)).filter_map(in_brackets).collect()
}

#[test]
fn nothing_else_is_needed() {
    let needed = dynamic_entries("(NEEDED)");
    assert!(!needed.is_empty());
    for library in needed {
        let allowed = ["libc.so.6", "libm.so.6", "libgcc_s.so.1"].contains(&library.as_str());
        assert!(allowed || library.starts_with("ld-linux"), "{library} is needed");
    }
}

#[test]
fn the_soname_has_the_abi_version() {
    let header = header();
    let abi = header.lines().find_map(|l| l.strip_prefix("#define GT2_ABI_VERSION ")).expect("the header has it");
    assert_eq!(dynamic_entries("(SONAME)"), [format!("libgentrack2.so.{abi}")]);
}
