//! `include/gentrack2.h` is generated from `src/capi` and committed. After a change there, write it anew with
//! `cargo test --test header -- --ignored`.

use std::path::Path;

/// The files of the ABI in the order in which the header presents them.
const SOURCES: &[&str] = &[
    "version",
    "status",
    "algorithm",
    "parameter_info",
    "config",
    "detection",
    "image",
    "frame",
    "track",
    "particle",
    "neighbourhood",
    "tracker",
    "snapshot",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn generate() -> String {
    let config = cbindgen::Config::from_file(root().join("cbindgen.toml")).expect("cbindgen.toml is valid");
    let mut builder = cbindgen::Builder::new().with_config(config);
    for source in SOURCES {
        builder = builder.with_src(root().join(format!("src/capi/{source}.rs")));
    }
    let mut header = Vec::new();
    builder.generate().expect("the sources of the ABI can be read").write(&mut header);
    String::from_utf8(header).expect("the header is UTF-8")
}

fn committed() -> String {
    std::fs::read_to_string(root().join("include/gentrack2.h")).expect("the header is there")
}

#[test]
fn the_committed_header_is_what_the_sources_say() {
    let (generated, committed) = (generate(), committed());
    let differing = generated.lines().zip(committed.lines()).position(|(g, c)| g != c);
    assert!(
        generated == committed,
        "include/gentrack2.h is out of date, first at line {}: run `cargo test --test header -- --ignored`",
        differing.map_or("(its end)".to_string(), |line| (line + 1).to_string())
    );
}

#[test]
fn every_exported_function_of_the_sources_is_in_the_header() {
    let header = committed();
    let mut found = 0;
    for entry in std::fs::read_dir(root().join("src/capi")).expect("the sources are there") {
        let text = std::fs::read_to_string(entry.expect("a file").path()).expect("a source file");
        for part in text.split("#[unsafe(no_mangle)]").skip(1) {
            let name = part.split("fn ").nth(1).and_then(|rest| rest.split('(').next()).expect("a function follows");
            assert!(header.contains(&format!("{name}(")), "{name} is missing: is its file listed in SOURCES?");
            found += 1;
        }
    }
    assert!(found > 30, "only {found} functions");
}

#[test]
fn the_version_text_is_that_of_the_package() {
    let line = format!("#define GT2_VERSION \"{}\"", env!("CARGO_PKG_VERSION"));
    assert!(committed().lines().any(|l| l == line), "{line} is missing: it is written in cbindgen.toml");
}

#[test]
fn cargo_c_gives_the_library_the_soname_of_the_header() {
    let manifest = std::fs::read_to_string(root().join("Cargo.toml")).expect("the manifest is there");
    let table = manifest.split("[package.metadata.capi.library]").nth(1).expect("cargo-c's table");
    let value = |key: &str| {
        let line =
            table.lines().take_while(|l| !l.starts_with('[')).find_map(|l| l.strip_prefix(key)?.strip_prefix(" = "));
        line.map(|text| text.trim_matches('"').to_string())
    };
    // So many numbers of the version are in the SONAME; the package's is taken where none is given.
    assert_eq!(value("version_suffix_components").as_deref(), Some("1"));
    let version = value("version").unwrap_or(env!("CARGO_PKG_VERSION").to_string());
    let abi = format!("#define GT2_ABI_VERSION {}", version.split('.').next().expect("a number"));
    assert!(committed().lines().any(|l| l == abi), "cargo-c's version {version} is another ABI: set it in Cargo.toml");
}

#[test]
#[ignore = "writes include/gentrack2.h"]
fn regenerate_header() {
    std::fs::write(root().join("include/gentrack2.h"), generate()).expect("the header can be written");
}
