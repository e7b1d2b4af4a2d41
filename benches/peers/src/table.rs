//! The table: what was measured, the fastest peer, their ratio, and what it should be.

use std::fmt::Write;

/// What a measure should be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// The peer takes at least so many times as long.
    Faster(f64),
    /// The measure is at most this.
    AtMost(f64),
    /// It is at most so many times the peer's.
    AtMostTimes(f64),
    /// It is at least this.
    AtLeast(f64),
    /// Nothing is asked.
    None,
}

/// A line.
#[derive(Clone, Debug)]
pub struct Line {
    pub what: String,
    pub ours: f64,
    pub unit: &'static str,
    /// The fastest peer, by name, and the others.
    pub peers: Vec<(String, f64)>,
    pub target: Target,
}

impl Line {
    /// The fastest of the peers that have the same algorithm; those that have another one say so in their name.
    pub fn fastest(&self) -> Option<&(String, f64)> {
        self.peers.iter().filter(|(name, _)| !name.contains("(not ")).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Whether the target is met; `None` where there is none, or nobody to compare with.
    pub fn is_met(&self) -> Option<bool> {
        let peer = self.fastest().map(|(_, peer)| *peer);
        match self.target {
            Target::Faster(times) => peer.map(|peer| peer >= times * self.ours),
            Target::AtMostTimes(times) => peer.map(|peer| self.ours <= times * peer),
            Target::AtMost(most) => Some(self.ours <= most),
            Target::AtLeast(least) => Some(self.ours >= least),
            Target::None => None,
        }
    }

    /// As a row of the table.
    pub fn row(&self) -> String {
        let fastest = self.fastest();
        let peer = fastest.map_or("-".into(), |(name, peer)| format!("{name} {}", number(*peer)));
        let ratio = fastest.map_or("-".into(), |(_, peer)| format!("{} x", number(peer / self.ours)));
        let others = self.peers.iter().filter(|p| Some(*p) != fastest);
        let others: Vec<String> = others.map(|(name, time)| format!("{name} {}", number(*time))).collect();
        let target = match self.target {
            Target::Faster(times) => format!("at least {times} x faster"),
            Target::AtMostTimes(times) => format!("at most {times} x as long"),
            Target::AtMost(most) => format!("at most {}", number(most)),
            Target::AtLeast(least) => format!("at least {}", number(least)),
            Target::None => String::new(),
        };
        let verdict = match (self.is_met(), self.target) {
            (Some(true), _) => "ok",
            (Some(false), _) => "**missed**",
            (None, Target::None) => "",
            (None, _) => "no peer",
        };
        let ours = format!("{} {}", number(self.ours), self.unit);
        format!("| {} | {} | {peer} | {ratio} | {} | {target} | {verdict} |", self.what, ours.trim(), others.join(", "))
    }
}

/// Three digits or so.
pub fn number(x: f64) -> String {
    match x.abs() {
        a if a >= 100.0 || a == x.abs().round() => format!("{x:.0}"),
        a if a >= 10.0 => format!("{x:.1}"),
        _ => format!("{x:.2}"),
    }
}

/// Sections of lines, with what was left out.
#[derive(Default)]
pub struct Table {
    text: String,
    missed: usize,
    met: usize,
    skipped: usize,
}

impl Table {
    /// Begins a section.
    pub fn section(&mut self, title: &str) {
        let head = "| | gentrack2 | fastest peer | ratio | other peers | target | |\n|---|---|---|---|---|---|---|";
        println!("\n{title}\n");
        let _ = write!(self.text, "\n## {title}\n\n{head}\n");
    }

    /// Adds a line, which is printed at once.
    pub fn add(&mut self, line: Line) {
        match line.is_met() {
            Some(true) => self.met += 1,
            Some(false) => self.missed += 1,
            None => (),
        }
        println!("{}", line.row());
        let _ = writeln!(self.text, "{}", line.row());
    }

    /// Says what is not there to be measured.
    pub fn skip(&mut self, why: &str) {
        self.skipped += 1;
        println!("{why}");
        let _ = writeln!(self.text, "| not measured: {why} | | | | | | |");
    }

    /// The whole text, beginning with how many targets were met.
    pub fn finish(self, introduction: &str) -> String {
        let Self { text, missed, met, skipped } = self;
        let count = format!("{met} targets met, {missed} missed, {skipped} sections not measured");
        println!("\n{count}");
        format!("# Speed\n\n{introduction}\n\n{count}\n{text}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(ours: f64, peers: &[f64], target: Target) -> Line {
        let peers = peers.iter().map(|time| ("peer".into(), *time)).collect();
        Line { what: "case".into(), ours, unit: "us", peers, target }
    }

    #[test]
    fn the_fastest_peer_counts() {
        assert_eq!(line(10.0, &[41.0, 39.0], Target::Faster(4.0)).is_met(), Some(false));
        assert_eq!(line(10.0, &[41.0, 43.0], Target::Faster(4.0)).is_met(), Some(true));
        assert_eq!(line(10.0, &[], Target::Faster(4.0)).is_met(), None);
    }

    #[test]
    fn limits_are_inclusive() {
        assert_eq!(line(1.15, &[], Target::AtMost(1.15)).is_met(), Some(true));
        assert_eq!(line(1.16, &[], Target::AtMost(1.15)).is_met(), Some(false));
        assert_eq!(line(20.0, &[10.0], Target::AtMostTimes(2.0)).is_met(), Some(true));
        assert_eq!(line(21.0, &[10.0], Target::AtMostTimes(2.0)).is_met(), Some(false));
        assert_eq!(line(1.7, &[], Target::AtLeast(1.8)).is_met(), Some(false));
    }
}
