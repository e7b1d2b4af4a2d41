//! `docs/parameters.md` is made from the parameters' own descriptions and committed. After a change of a parameter,
//! write it anew with `cargo test --test parameter_table -- --ignored`.

use std::collections::BTreeSet;
use std::path::PathBuf;

use gentrack2::parameters::{Kind, ParameterSet, ParameterSpec};
use gentrack2::{Algorithm, Config};

/// What the names of a choice stand for; the descriptions of parameters name choices without explaining them.
const CHOICES: &[(&str, &[(&str, &str)])] = &[
    ("particle_source", &[("optimal_state", "all in one place"), ("prior_particles", "each in its own place")]),
    (
        "history_reference",
        &[("predicted", "the previous state moved on by its velocity"), ("previous", "the previous state (the paper)")],
    ),
    (
        "resampling",
        &[("none", "nothing"), ("global", "they are replaced by the global best"), ("discard", "they are dropped")],
    ),
    (
        "strong_update",
        &[("blend", "blended by confidence"), ("replace", "the detection replaces the state (the paper)")],
    ),
    ("weak_motion", &[("own", "by its own velocity"), ("neighbours", "with its trustworthy neighbours")]),
    (
        "asso_func",
        &[
            ("iou", "intersection over union"),
            ("giou", "less the empty share of the box around both"),
            ("diou", "IoU less the distance of the centres"),
            ("ciou", "the same less a term for different shapes"),
            ("centre_distance", "one minus the distance of the centres over the largest of all pairs"),
        ],
    ),
    (
        "class_policy",
        &[
            ("ignore", "nothing, a track takes detections of any class"),
            ("same_class", "a track takes detections of its own class only, all else is shared"),
            ("separate", "each class is tracked as if the others were not there"),
        ],
    ),
    (
        "regression_lags",
        &[("sparse", "half and the whole of the window"), ("all", "every lag up to the window (the paper)")],
    ),
];

const INTRODUCTION: &str = "\
# Parameters

Made from the library's own descriptions: do not edit, write it anew with
`cargo test --test parameter_table -- --ignored`.

Any of them is set by `gt2_config_set(config, \"key\", \"value\")` in C, `config.set(\"key\", value)` in C++,
`--set key=value` of `gt2_mot`, or a line `key = value` of a TOML file. A value outside its range is refused with a
message that names the range. A program finds this table at run time with `gt2_config_parameter_info`.

- A *tick* is 1/30 s, so that one set of values serves every frame rate.
- *Symbol* is that of the GenTrack2 paper, where the parameter has one.
- *Box widths*, *heights* and *diagonals* are those of the target in question.
";

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs/parameters.md")
}

fn code(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("`{text}`") }
}

/// The largest 64-bit integer is more readable as a power than as digits, which a real number rounds.
fn bound(number: f64) -> String {
    if number >= i64::MAX as f64 { "2^63 - 1".to_string() } else { format!("{number}") }
}

fn range(spec: &ParameterSpec) -> String {
    match spec.kind {
        Kind::Float => format!("{} to {}", bound(spec.minimum), bound(spec.maximum)),
        Kind::Integer => format!("{} to {}, whole", bound(spec.minimum), bound(spec.maximum)),
        Kind::Boolean => "`true`, `false`".to_string(),
        Kind::Choice(names) => names.iter().map(|name| code(name)).collect::<Vec<_>>().join(", "),
        Kind::Areas => "`left,top,width,height;...`".to_string(),
    }
}

fn default(spec: &ParameterSpec) -> String {
    let text = spec.default.to_string();
    if text.is_empty() { "none".to_string() } else { code(&text) }
}

fn meaning(spec: &ParameterSpec) -> String {
    let mut text = spec.documentation.clone();
    if let Some((_, names)) = CHOICES.iter().find(|(key, _)| *key == spec.key) {
        let names: Vec<String> = names.iter().map(|(name, stands_for)| format!("`{name}`: {stands_for}")).collect();
        text = format!("{text} {}.", names.join("; "));
    }
    text.replace('|', "\\|")
}

fn table(set: &dyn ParameterSet) -> String {
    let mut text = String::from("| key | default | range | unit | symbol | meaning |\n|---|---|---|---|---|---|\n");
    for spec in set.specs() {
        let cells = [code(spec.key), default(spec), range(spec), spec.unit.into(), code(spec.symbol), meaning(spec)];
        text += &format!("| {} |\n", cells.join(" | "));
    }
    text
}

/// What a preset changes.
fn preset(algorithm: Algorithm, name: &str) -> String {
    let defaults = Config::of(algorithm);
    let mut config = Config::of(algorithm);
    config.load_preset(name).expect("a listed preset exists");
    let mut text = format!(
        "\n### Preset `{name}`\n\nSet the key `preset` to `{name}`, before any other. It differs from the defaults in:\n\n\
         | key | default | `{name}` |\n|---|---|---|\n"
    );
    for spec in defaults.parameters.as_set().specs() {
        let values = [&defaults, &config].map(|c| c.get(spec.key).expect("a listed parameter exists").to_string());
        if values[0] != values[1] {
            text += &format!("| {} | {} | {} |\n", code(spec.key), code(&values[0]), code(&values[1]));
        }
    }
    text
}

fn generate() -> String {
    let mut text = INTRODUCTION.to_string();
    for &algorithm in Algorithm::ALL {
        let config = Config::of(algorithm);
        text += &format!("\n## Algorithm `{}`\n\n{}\n\n", algorithm.name(), algorithm.description());
        text += &table(config.parameters.as_set());
        for name in &algorithm.presets()[1..] {
            text += &preset(algorithm, name);
        }
    }
    text += "\n## Every algorithm\n\n";
    text += &table(&Config::of(Algorithm::ALL[0]).common);
    text
}

#[test]
fn the_committed_table_is_what_the_library_says() {
    let committed = std::fs::read_to_string(path()).expect("docs/parameters.md is there");
    let generated = generate();
    let differing = generated.lines().zip(committed.lines()).find(|(g, c)| g != c);
    assert!(
        generated == committed,
        "docs/parameters.md is out of date: run `cargo test --test parameter_table -- --ignored`; {}",
        differing.map_or("it differs at its end".to_string(), |(g, c)| format!("it should say\n{g}\nbut says\n{c}"))
    );
}

#[test]
fn every_choice_is_explained() {
    let mut declared = BTreeSet::new();
    for &algorithm in Algorithm::ALL {
        for spec in Config::of(algorithm).specs() {
            if let Kind::Choice(names) = spec.kind {
                declared.extend(names.iter().map(|name| (spec.key, *name)));
            }
        }
    }
    let explained: BTreeSet<_> =
        CHOICES.iter().flat_map(|(key, names)| names.iter().map(move |(name, _)| (*key, *name))).collect();
    assert_eq!(explained, declared, "CHOICES of this file");
}

#[test]
#[ignore = "writes docs/parameters.md"]
fn regenerate_parameter_table() {
    let path = path();
    std::fs::create_dir_all(path.parent().expect("it lies in docs")).expect("docs can be made");
    std::fs::write(path, generate()).expect("docs/parameters.md can be written");
}
