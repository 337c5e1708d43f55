//! Encoding of a picture as bytes: a JSON head, then 16-bit cells and traces.

use serde::Serialize;

/// Largest count of a cell or sample: 16 bits with a sign hold 32 767, and 32 000 leaves room for rounding.
const FULL: f32 = 32_000.0;

/// The field at an instant, as it goes over the wire: a JSON head, then the cells and the traces as 16-bit counts.
///
/// The bytes are a u32 (little-endian) with the length of the head, the head padded with spaces to a multiple of four bytes, the cells row
/// by row from the bottom, then the samples of each trace; cells and samples as i16 (little-endian).
#[derive(Clone, Debug)]
pub struct Frame {
    /// Description of the frame, sent before the cells.
    pub head: Head,
    /// Value of every cell, in m or m/s.
    pub cells: Vec<f32>,
    /// Motion at some places, in the same unit, `[trace][sample]`.
    pub traces: Vec<Vec<f32>>,
}

/// The JSON head of a frame.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Head {
    /// Number of the frame, which rises with each frame.
    pub frame: u64,
    /// Number of the picture among those shown side by side, from 0.
    pub pane: usize,
    /// Number of pictures side by side.
    pub panes: usize,
    /// Number of cells along x.
    pub columns: usize,
    /// Number of cells along y.
    pub rows: usize,
    /// Field, in m or m/s, that corresponds to one count of a cell.
    pub scale: f32,
    /// The instant that is shown, in s of the surface's clock.
    pub time_s: f64,
    /// Quantity that is shown: `displacement` or `velocity`.
    pub quantity: &'static str,
    /// Whether the picture shows the instant of the strongest motion since the frame before, rather than the
    /// instant requested.
    pub strobed: bool,
    /// Largest magnitude of all cells, in m or m/s.
    pub peak: f32,
    /// Drive of every actuator at that instant, as a ratio to its limit.
    pub drive: Vec<f32>,
    /// Fingers on the surface.
    pub fingers: Vec<Resting>,
    /// Places of the targets, in mm.
    pub targets: Vec<[f64; 2]>,
    /// Number of samples of each trace.
    pub samples: usize,
    /// Duration of the traces, in s; they end at the instant shown.
    pub span_s: f64,
    /// Names and places of the traces.
    pub traces: Vec<Strip>,
}

/// One finger that rests on the surface.
#[derive(Clone, Debug, Serialize)]
pub struct Resting {
    /// Number of the finger.
    pub id: u64,
    /// Place of the finger, in mm.
    pub at_mm: [f64; 2],
    /// Force of the surface on the finger, in N.
    pub force_n: f64,
}

/// Name, place and scale of a trace.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Strip {
    /// Name of the place.
    pub name: String,
    /// Place of the trace, in mm.
    pub at_mm: [f64; 2],
    /// Motion, in m or m/s, that corresponds to one count of a sample.
    pub scale: f32,
}

impl Frame {
    /// Encodes the frame as bytes for the link to a page.
    pub fn encode(mut self) -> Vec<u8> {
        let (scale, peak) = scale(&self.cells);
        (self.head.scale, self.head.peak) = (scale, peak);
        let scales: Vec<f32> = self.traces.iter().map(|trace| self::scale(trace).0).collect();
        self.head.traces.iter_mut().zip(&scales).for_each(|(strip, scale)| strip.scale = *scale);
        // A head of numbers and names is always JSON.
        let mut head = serde_json::to_vec(&self.head).unwrap_or_default();
        head.resize(head.len().next_multiple_of(4), b' ');
        let samples = self.cells.len() + self.traces.iter().map(Vec::len).sum::<usize>();
        let mut bytes = Vec::with_capacity(4 + head.len() + 2 * samples);
        bytes.extend((head.len() as u32).to_le_bytes());
        bytes.append(&mut head);
        count(&self.cells, scale, &mut bytes);
        self.traces.iter().zip(scales).for_each(|(trace, scale)| count(trace, scale, &mut bytes));
        bytes
    }
}

/// Value of one count, and the largest magnitude.
fn scale(values: &[f32]) -> (f32, f32) {
    let peak = values.iter().fold(0.0, |m: f32, x| m.max(x.abs()));
    (if peak > 0.0 { peak / FULL } else { 1.0 }, peak)
}

fn count(values: &[f32], scale: f32, bytes: &mut Vec<u8>) {
    bytes.extend(values.iter().flat_map(|x| ((x / scale).round() as i16).to_le_bytes()));
}
