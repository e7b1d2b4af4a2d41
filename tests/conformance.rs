//! The compared trackers do what their published reference implementations do: every row of every golden output, and
//! no row more.
//!
//! Which of these tests can run depends on the data at hand, so they are made at run time, and those without data are
//! counted as ignored. One alone: `cargo test --test conformance -- --exact sort/syn_a1`. With `--nocapture` the share
//! reproduced of each oracle is printed at the end.

mod oracles;

use std::collections::BTreeMap;
use std::path::Path;
use std::process::ExitCode;
use std::sync::{Arc, Mutex};

#[cfg(feature = "snapshot")]
use gentrack2::Tracker;
use libtest_mimic::{Arguments, Completion, Failed, Trial};
use oracles::compare::Report;
use oracles::place;
use oracles::variants::{self, Mistake, Variant};

/// By name of the test, the outcome of its comparison.
type Outcomes = Arc<Mutex<BTreeMap<String, String>>>;

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let outcomes = Outcomes::default();
    let mut trials = Vec::new();
    for variant in variants::all() {
        trials.extend(variant.synthetic.iter().map(|name| synthetic(variant.clone(), name, &outcomes)));
        trials.extend(variant.mot17.iter().map(|name| mot17(variant.clone(), name, &outcomes)));
    }
    #[cfg(feature = "snapshot")]
    for variant in variants::all().into_iter().chain([variants::gentrack2()]) {
        trials.extend(variant.mot17.iter().map(|name| saved_and_loaded(variant.clone(), name)));
    }
    trials.extend(variants::mistakes().into_iter().map(|mistake| noticed(mistake, &outcomes)));
    trials.push(needing_data("fixtures/are those of the measurement data".to_string(), fixtures_have_not_drifted));
    let conclusion = libtest_mimic::run(&arguments, trials);
    if arguments.nocapture {
        for (name, outcome) in outcomes.lock().expect("no test holds it any more").iter() {
            println!("{name}: {outcome}");
        }
    }
    conclusion.exit_code()
}

fn synthetic(variant: Variant, sequence: &'static str, outcomes: &Outcomes) -> Trial {
    let outcomes = outcomes.clone();
    let name = format!("{}/{sequence}", variant.folder);
    Trial::test(name.clone(), move || {
        let report = place::reproduce_synthetic(&variant, sequence)?;
        note(&outcomes, name, &report);
        must_be_exact(&report)
    })
}

fn mot17(variant: Variant, sequence: &'static str, outcomes: &Outcomes) -> Trial {
    let outcomes = outcomes.clone();
    let name = format!("{}/{sequence}", variant.folder);
    needing_data(name.clone(), move |shared| {
        let report = place::reproduce_mot17(&variant, shared, sequence)?;
        note(&outcomes, name, &report);
        must_be_exact(&report)
    })
}

/// Saved and loaded again now and then, a tracker gives what it gives undisturbed.
#[cfg(feature = "snapshot")]
fn saved_and_loaded(variant: Variant, sequence: &'static str) -> Trial {
    needing_data(format!("saved/{}/{sequence}", variant.folder), move |shared| {
        let sequence = place::mot17(shared, sequence)?;
        let undisturbed = variant.play(&sequence)?;
        let disturbed = variant.play_interrupted(&sequence, |index, tracker| match index % 17 {
            0 => Tracker::load(&tracker.save()).expect("what was just saved can be loaded"),
            _ => tracker,
        })?;
        // The very bits, unlike the oracles' four decimals.
        if disturbed == undisturbed { Ok(()) } else { Err("the outputs differ".into()) }
    })
}

/// The oracles can tell: what is not the reference's tracker does not pass for it.
fn noticed(mistake: Mistake, outcomes: &Outcomes) -> Trial {
    let outcomes = outcomes.clone();
    let name = format!("mistake/{}/{}", mistake.name, mistake.sequence);
    Trial::test(name.clone(), move || {
        let report = place::reproduce_synthetic(&mistake.wrong, mistake.sequence)?;
        note(&outcomes, name, &report);
        if report.is_exact() { Err("not noticed".into()) } else { Ok(()) }
    })
}

/// A test that is ignored, with the reason, where the measurement data is not at hand.
fn needing_data(name: String, test: impl FnOnce(&Path) -> Result<(), Failed> + Send + 'static) -> Trial {
    Trial::ignorable_test(name, move || match place::shared() {
        Some(shared) => test(&shared).map(|()| Completion::Completed),
        None => Ok(Completion::ignored_with(format!("{} does not name the measurement data", place::SHARED))),
    })
}

fn note(outcomes: &Outcomes, name: String, report: &Report) {
    outcomes.lock().expect("no test fails while it holds it").insert(name, report.to_string());
}

fn must_be_exact(report: &Report) -> Result<(), Failed> {
    if report.is_exact() {
        return Ok(());
    }
    let differences: String = report.differences.iter().map(|d| format!("\n  {d}")).collect();
    Err(format!("{report}; the first differences, id (left top width height):{differences}").into())
}

/// The names and contents of the files of a directory of oracles, less those that no test needs.
fn contents(directory: &Path) -> Result<BTreeMap<String, Vec<u8>>, String> {
    let failed = |path: &Path, e: std::io::Error| format!("{}: {e}", path.display());
    let mut files = BTreeMap::new();
    for folder in std::fs::read_dir(directory).map_err(|e| failed(directory, e))? {
        let folder = folder.map_err(|e| failed(directory, e))?.path();
        if !folder.is_dir() {
            continue;
        }
        for file in std::fs::read_dir(&folder).map_err(|e| failed(&folder, e))? {
            let path = file.map_err(|e| failed(&folder, e))?.path();
            let name = path.strip_prefix(directory).expect("it lies within").display().to_string().replace('\\', "/");
            if !name.ends_with(".gt.txt") {
                files.insert(name, std::fs::read(&path).map_err(|e| failed(&path, e))?);
            }
        }
    }
    Ok(files)
}

fn fixtures_have_not_drifted(shared: &Path) -> Result<(), Failed> {
    let ours = contents(&place::fixtures())?;
    let theirs = contents(&shared.join("oracles"))?;
    let mut wrong = Vec::new();
    for (name, bytes) in &theirs {
        // Not a line of what is under MOT17's terms is committed.
        let expected = name.contains("/syn_").then_some(bytes);
        if ours.get(name) != expected {
            wrong.push(format!("{name} differs"));
        }
        let is_tested = |v: &Variant| {
            v.synthetic.iter().chain(v.mot17).any(|sequence| *name == format!("{}/{sequence}.csv", v.folder))
        };
        if !name.starts_with("synthetic/") && !variants::all().iter().any(is_tested) {
            wrong.push(format!("{name} is not tested"));
        }
    }
    wrong.extend(ours.keys().filter(|name| !theirs.contains_key(*name)).map(|name| format!("{name} is unknown there")));
    if wrong.is_empty() { Ok(()) } else { Err(wrong.join("\n").into()) }
}
