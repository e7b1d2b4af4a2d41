//! Counts the instructions of steps under valgrind's callgrind and compares them with the baseline beside this package.
//! Counts hardly depend on the machine and its load, so that they can be asserted where times cannot.
//!
//! ```text
//! instructions                 counts all cases and compares; exit status 1 if one takes 10 % more than its baseline
//! instructions --update        counts all cases and writes the baseline
//! instructions --case NAME     runs a case, which is what happens under callgrind
//! ```

mod baseline;
mod cases;

use std::path::Path;
use std::process::{Command, ExitCode};

use baseline::Baseline;
use cases::{CASES, MEASURED, run};

/// Growth over the baseline that is an error.
const TOLERANCE: f64 = 0.10;

/// Instructions per step of a case.
fn count(name: &str) -> Result<u64, String> {
    let program = std::env::current_exe().map_err(|e| e.to_string())?;
    let file = program.with_file_name(format!("callgrind.{}.{name}", std::process::id()));
    let status = Command::new("valgrind")
        .args(["--tool=callgrind", "--quiet", "--collect-atstart=no"])
        .arg(format!("--toggle-collect={MEASURED}"))
        .arg(format!("--callgrind-out-file={}", file.display()))
        .arg(&program)
        .args(["--case", name])
        .status()
        .map_err(|e| format!("valgrind (Debian package valgrind): {e}"))?;
    let text = std::fs::read_to_string(&file).map_err(|e| format!("{}: {e}", file.display()));
    let _ = std::fs::remove_file(&file);
    if !status.success() {
        return Err(format!("{name}: callgrind ended with {status}"));
    }
    let total = text?.lines().find_map(|line| line.strip_prefix("totals:")?.trim().parse::<u64>().ok());
    match total {
        Some(total) if total > 0 => Ok(total / cases::STEPS as u64),
        _ => Err(format!("{name}: callgrind counted nothing")),
    }
}

fn count_all() -> Result<Vec<(&'static str, u64)>, String> {
    let mut counts = Vec::new();
    for case in CASES {
        let instructions = count(case.name)?;
        eprintln!("{:<28} {instructions:>12} instructions per step", case.name);
        counts.push((case.name, instructions));
    }
    Ok(counts)
}

/// Compares and says so; whether nothing is amiss.
fn compare(counts: &[(&str, u64)], baseline: &Baseline) -> bool {
    let compiler = baseline::compiler();
    if baseline.compiler != compiler {
        println!(
            "instruction counts: the baseline is of {}, this is {compiler}: nothing to compare",
            baseline.compiler
        );
        println!("instructions: 0 passed, 0 failed, {} skipped", counts.len());
        return true;
    }
    let (mut passed, mut failed) = (0, 0);
    for (name, now) in counts {
        let Some(before) = baseline.of(name) else {
            println!("{name}: has no baseline; `make bench-instructions UPDATE=1` writes it");
            failed += 1;
            continue;
        };
        let growth = *now as f64 / before as f64 - 1.0;
        let verdict = if growth > TOLERANCE { "TOO MANY" } else { "ok" };
        println!("{name:<28} {before:>12} -> {now:>12}  {:+6.1} %  {verdict}", 100.0 * growth);
        if growth > TOLERANCE { failed += 1 } else { passed += 1 }
    }
    println!("instructions: {passed} passed, {failed} failed, 0 skipped");
    failed == 0
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("baseline.txt");
    let done = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["--case", name] => run(name).map(|()| true),
        ["--update"] => count_all().and_then(|counts| Baseline::write(&file, &counts)).map(|()| true),
        [] => Baseline::read(&file).and_then(|baseline| Ok(compare(&count_all()?, &baseline))),
        _ => Err("usage: instructions [--update | --case NAME]".into()),
    };
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("instructions: {message}");
            ExitCode::FAILURE
        }
    }
}
