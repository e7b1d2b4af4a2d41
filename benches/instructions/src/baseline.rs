//! The committed counts. Another compiler makes other code, so they are of one version and machine architecture.

use std::path::Path;
use std::process::Command;

/// The compiler by its own words, and the architecture.
pub fn compiler() -> String {
    // What cargo built this with.
    let rustc = Command::new("rustc").arg("--version").output();
    let version = rustc.ok().map(|o| String::from_utf8_lossy(&o.stdout).trim().to_string()).unwrap_or_default();
    format!("{version}, {}", std::env::consts::ARCH)
}

/// Counts by case.
pub struct Baseline {
    /// The compiler they are of.
    pub compiler: String,
    counts: Vec<(String, u64)>,
}

impl Baseline {
    /// Reads the file that [`write`](Self::write) wrote.
    pub fn read(path: &Path) -> Result<Self, String> {
        let text = std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
        let mut lines = text.lines();
        let compiler = lines.next().unwrap_or_default().to_string();
        let count = |line: &str| {
            let (name, number) = line.split_once(' ')?;
            Some((name.to_string(), number.trim().parse().ok()?))
        };
        let counts: Option<Vec<_>> = lines.map(count).collect();
        Ok(Self { compiler, counts: counts.ok_or_else(|| format!("{}: not a baseline", path.display()))? })
    }

    /// Writes the counts: a line with the compiler, then one for each case.
    pub fn write(path: &Path, counts: &[(&str, u64)]) -> Result<(), String> {
        let lines: String = counts.iter().map(|(name, n)| format!("{name} {n}\n")).collect();
        std::fs::write(path, format!("{}\n{lines}", compiler())).map_err(|e| format!("{}: {e}", path.display()))
    }

    /// The count of a case.
    pub fn of(&self, name: &str) -> Option<u64> {
        self.counts.iter().find(|(known, _)| known == name).map(|(_, count)| *count)
    }
}
