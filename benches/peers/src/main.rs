//! The trackers of this library and those of others side by side: `make bench`. Prints its progress, writes
//! `out/bench.md`.
//!
//! ```text
//! peers OUT-DIRECTORY [--library FILE] [--hog FILE] [--memory FILE] [--streams FILE]
//! ```

mod contest;
mod others;
mod ours;

use std::time::{Duration, Instant};
use gentrack2::Algorithm;
use scenes::*;
use contest::*;

fn main() {
    let t0 = Instant::now();
    let quick = std::env::args().nth(1).as_deref() == Some("ours");
    let line = |what: &str, entries: &[Entry], us: &[f64]| {
        print!("{:6.1}s {what:24}", t0.elapsed().as_secs_f64());
        for (e, u) in entries.iter().zip(us) { print!(" {}={:.1}", e.name, u); }
        println!();
    };
    let plan = Plan { rounds: 3, warm_up: 8, budget: Duration::from_millis(500) };
    for &a in Algorithm::ALL {
        let all = |v: &Video| if wants_strong(a) || a == Algorithm::OcSort { v.scored_from(STRONG) } else { v.clone() };
        let entries = || { let mut e = vec![ours::entry(a)]; if !quick { e.extend(others::entries(a)); } e };
        if let Some(v) = mot17_04() {
            let mut e = entries();
            let us = run(&all(&v), &mut e, &Plan { rounds: 3, warm_up: 10, budget: Duration::from_millis(3000) });
            line(&format!("{} mot17", a.name()), &e, &us);
        }
        for n in [10, 100, 200, 1000, 2000, 5000, 20000] {
            let v = Crowd::new(n, Canvas::Fixed, 1).video(40);
            let mut e = entries();
            if n > 1000 { e.truncate(1); }
            let us = run(&v, &mut e, &plan);
            line(&format!("{} crowd {n}", a.name()), &e, &us);
        }
        let mut pts = vec![];
        for n in [100, 200, 500, 1000, 2000] {
            let v = Crowd::new(n, Canvas::Growing, 1).video(40);
            let mut e = vec![ours::entry(a)];
            let us = run(&v, &mut e, &plan);
            pts.push((n as f64, us[0]));
        }
        println!("{} growing {:?} exponent {:.3}", a.name(), pts, exponent(&pts));
    }
}
