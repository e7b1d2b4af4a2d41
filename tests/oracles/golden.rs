//! Rows of a track file: the oracles', and those that a tracker reports.

use std::path::Path;

use gentrack2::Rect;

/// A track as reported in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    pub id: u64,
    pub rect: Rect,
}

/// The rows of every frame of a sequence, the first frame at 0.
pub type Rows = Vec<Vec<Row>>;

const HEADER: &str = "frame,id,left,top,width,height";

/// Reads an oracle for a sequence of so many frames.
pub fn read(path: &Path, frames: usize) -> Result<Rows, String> {
    let text = std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
    parse(&text, frames).map_err(|e| format!("{}: {e}", path.display()))
}

/// Reads the text of an oracle.
pub fn parse(text: &str, frames: usize) -> Result<Rows, String> {
    let mut lines = text.lines();
    if lines.next() != Some(HEADER) {
        return Err(format!("does not begin with {HEADER}"));
    }
    let mut rows = vec![Vec::new(); frames];
    for (index, line) in lines.enumerate() {
        let (frame, row) = parse_row(line).ok_or_else(|| format!("line {}: {line}", index + 2))?;
        // Frames count from 1.
        let place = frame.checked_sub(1).and_then(|at| rows.get_mut(at));
        place.ok_or_else(|| format!("line {}: there is no frame {frame}", index + 2))?.push(row);
    }
    Ok(rows)
}

fn parse_row(line: &str) -> Option<(usize, Row)> {
    let mut fields = line.split(',');
    let frame = fields.next()?.parse().ok()?;
    let id = fields.next()?.parse().ok()?;
    let numbers: Vec<f64> = fields.map(|f| f.parse().ok()).collect::<Option<_>>()?;
    let [left, top, width, height] = numbers[..] else { return None };
    Some((frame, Row { id, rect: Rect::new(left, top, width, height) }))
}
