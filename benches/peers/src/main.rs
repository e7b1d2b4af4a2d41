//! The trackers of this library and those of others side by side: `make bench`. Prints its progress, writes a table.
//!
//! ```text
//! peers TABLE READINGS...      READINGS are files of lines of a name and a number, which other programs measured
//! ```

mod contest;
mod others;
mod ours;
mod sections;
mod table;

use std::collections::BTreeMap;
use std::process::ExitCode;

use table::Table;

const INTRODUCTION: &str = "Microseconds per step unless a unit is given; `make bench` wrote this. Trackers take turns \
over the same frames; a number is the mean over the frames of the median over the rounds.";

/// What other programs measured, by name.
type Readings = BTreeMap<String, f64>;

fn read(path: &str, readings: &mut Readings) -> Result<(), String> {
    let text = std::fs::read_to_string(path).map_err(|e| format!("{path}: {e}"))?;
    for line in text.lines().filter(|line| !line.is_empty()) {
        let reading = line.split_once(' ').and_then(|(name, number)| Some((name.to_string(), number.parse().ok()?)));
        let (name, number) = reading.ok_or_else(|| format!("{path}: {line}"))?;
        readings.insert(name, number);
    }
    Ok(())
}

fn measure(arguments: &[String]) -> Result<(), String> {
    let [path, files @ ..] = arguments else { return Err("usage: peers TABLE READINGS...".into()) };
    let mut readings = Readings::new();
    files.iter().try_for_each(|file| read(file, &mut readings))?;
    let mut table = Table::default();
    sections::mot17(&mut table);
    sections::crowds(&mut table);
    sections::growth(&mut table);
    sections::large_crowds(&mut table);
    sections::images(&mut table, &readings);
    sections::streams(&mut table, &readings);
    sections::memory_and_library(&mut table, &readings);
    std::fs::write(path, table.finish(INTRODUCTION)).map_err(|e| format!("{path}: {e}"))
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match measure(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("peers: {message}");
            ExitCode::FAILURE
        }
    }
}
