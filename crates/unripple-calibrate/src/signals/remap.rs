//! Signals whose frequency components are moved to other frequencies, each by a different amount.

use super::transform::{Transform, turns};
use std::f64::consts::TAU;
use std::sync::LazyLock;
use unripple_dsp::{Complex, kaiser, sinc};

/// Spectral lines on either side from which a value between lines is interpolated. With half as many the kernel's error
/// rises from -120 dB to about -60 dB.
const HALF: usize = 8;

/// Shape of the Kaiser window over the interpolation kernel. A signal that fills half of the transform leaves the other half
/// for the kernel to fall in: with 16 lines and this shape it is down by 120 dB (Kaiser's rule).
const BETA: f64 = 12.0;

/// Steps of the tabulated kernel between two lines: interpolated linearly, it is accurate to 1e-7.
const FINE: usize = 1024;

/// Weights of the kernel's lines, for one place between two lines.
type Weights = [f64; 2 * HALF];

/// The weights of the lines around a place `i / FINE` of the way from one line to the next, of which the former is number `HALF - 1`.
static KERNEL: LazyLock<Vec<Weights>> = LazyLock::new(|| {
    let value = |away: f64| sinc(away) * kaiser(away / HALF as f64, BETA);
    let place = |i: usize| i as f64 / FINE as f64 + (HALF - 1) as f64;
    (0..=FINE).map(|i| std::array::from_fn(|k| value((place(i) - k as f64).abs()))).collect()
});

/// The weights of the lines around a place, `part` of the way from one line to the next.
fn weights(part: f64) -> Weights {
    let place = part * FINE as f64;
    let left = (place as usize).min(FINE - 1);
    let (part, kernel) = (place - left as f64, &KERNEL[left..left + 2]);
    std::array::from_fn(|k| kernel[0][k] * (1.0 - part) + kernel[1][k] * part)
}

/// For each spectral line of a moved signal, the original frequency from which it is interpolated, as
/// weights and a phase factor.
#[derive(Clone, Debug)]
pub struct Moves(Vec<Move>);

/// Interpolation of one line: the signal's lines from `first` on, times the kernel's weights and a phase
/// factor.
#[derive(Clone, Copy, Debug)]
struct Move {
    first: i64,
    weights: Weights,
    turn: Complex<f64>,
}

/// A signal prepared for moving its frequencies: `h'(t) = 1/π Re ∫ H(ω) e^{jω't} dω`, for any rising ω'(ω).
///
/// The spectrum is interpolated between its lines by a windowed sinc, at the frequencies that move to the lines of the
/// result. This is accurate to about -120 dB, since the signal is padded to twice its length. Decay rates are multiplied by
/// the slope of ω'(ω).
///
/// ```
/// use unripple_calibrate::signals::Remap;
///
/// let ring = |hz: f64| -> Vec<f64> {
///     (0..4000).map(|i| (-f64::from(i) / 400.0).exp() * (std::f64::consts::TAU * hz * f64::from(i) / 48e3).sin()).collect()
/// };
/// let moved = Remap::new(&ring(800.0), 48e3, 0.0).moved([0.0, 24e3], |hz| [hz / 1.01, 1.0 / 1.01]);
/// let off = moved.iter().zip(ring(808.0)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
/// assert!(off < 0.01); // the decay is a hundredth quicker, too
/// ```
#[derive(Clone, Debug)]
pub struct Remap {
    plan: Transform,
    samples: usize,
    rate: f64,
    /// Spectrum of the signal with its middle moved to time 0, so that phases change slowly from line to line.
    lines: Vec<Complex<f64>>,
    centre: f64,
    origin: f64,
}

impl Remap {
    /// Prepares a signal, zero beyond its ends, of `rate` samples per second, whose time 0 is `origin`
    /// samples after its first.
    pub fn new(signal: &[f64], rate: f64, origin: f64) -> Self {
        let plan = Transform::smooth(2 * signal.len().max(HALF));
        let mut work = plan.work();
        plan.forward(signal, &mut work);
        let centre = (signal.len() / 2) as f64;
        let step = TAU * centre / plan.size() as f64;
        let lines = work.lines.iter().zip(turns(step, 0)).map(|(x, turn)| x * turn).collect();
        Self { plan, samples: signal.len(), rate, lines, centre, origin }
    }

    /// Frequency of a spectral line, in Hz.
    pub fn hz(&self, line: usize) -> f64 {
        self.plan.hz(line, self.rate)
    }

    /// Range of spectral lines that lie in a band (Hz): the index of the first line in it, and of the first
    /// line beyond it.
    pub fn within(&self, band: [f64; 2]) -> [usize; 2] {
        let step = self.rate / self.plan.size() as f64;
        let at = |hz: f64| ((hz / step).max(0.0).ceil() as usize).min(self.lines.len());
        [at(band[0]), (at(band[1]) + 1).min(self.lines.len())]
    }

    /// Spectrum of the moved signal at the lines of a band (Hz). `from` returns, for a frequency (Hz) after
    /// the move, the original frequency (Hz), and the derivative of the latter by the former.
    pub fn lines(&self, band: [f64; 2], from: impl Fn(f64) -> [f64; 2]) -> Vec<Complex<f64>> {
        self.lines_by(&self.moves(band, from))
    }

    /// Interpolation weights for the moved lines of a band (Hz), for [`Remap::lines_by`]; they are valid for
    /// all signals of this length and origin. `from` as in [`Remap::lines`].
    pub fn moves(&self, band: [f64; 2], from: impl Fn(f64) -> [f64; 2]) -> Moves {
        let [first, end] = self.within(band);
        let step = self.rate / self.plan.size() as f64;
        let move_of = |line: usize| {
            let [hz, slope] = from(self.hz(line));
            let at = hz / step;
            // A frequency outside the spectrum, or none.
            if !(at >= 0.0 && at <= (self.lines.len() - 1) as f64) {
                return Move { first: 0, weights: [0.0; 2 * HALF], turn: Complex::default() };
            }
            // Back from the middle of the signal, and moved about its time 0.
            let back = (self.centre - self.origin) * at + self.origin * line as f64;
            let turn = Complex::from_polar(slope, -TAU * back / self.plan.size() as f64);
            let whole = at.floor();
            Move { first: whole as i64 + 1 - HALF as i64, weights: weights(at - whole), turn }
        };
        Moves((first..end).map(move_of).collect())
    }

    /// Spectrum of the moved signal at the lines of `moves`, which were computed for a signal of the same
    /// length and origin.
    pub fn lines_by(&self, moves: &Moves) -> Vec<Complex<f64>> {
        moves.0.iter().map(|of| self.between(of) * of.turn).collect()
    }

    /// The spectrum of the centred signal between its lines.
    fn between(&self, of: &Move) -> Complex<f64> {
        // Nearly everywhere all lines of the kernel exist, side by side: this is the innermost loop of every
        // comparison of takes.
        let inside = usize::try_from(of.first).ok().and_then(|first| self.lines.get(first..first + 2 * HALF));
        let mut sum = Complex::default();
        match inside {
            Some(inside) => inside.iter().zip(&of.weights).for_each(|(line, weight)| sum += line * weight),
            None => {
                let last = self.lines.len() as i64 - 1;
                let lines = (of.first..).map(|k| self.line(k, last));
                lines.zip(&of.weights).for_each(|(line, weight)| sum += line * weight);
            }
        }
        sum
    }

    /// A line of the two-sided spectrum.
    fn line(&self, k: i64, last: i64) -> Complex<f64> {
        let at = |k: i64| usize::try_from(k).ok().and_then(|k| self.lines.get(k)).copied();
        match k {
            k if k < 0 => at(-k).unwrap_or_default().conj(),
            k if k > last => at(self.plan.size() as i64 - k).unwrap_or_default().conj(),
            k => at(k).unwrap_or_default(),
        }
    }

    /// The moved signal, of the original length, limited to `band` (Hz, after the move).
    pub fn moved(&self, band: [f64; 2], from: impl Fn(f64) -> [f64; 2]) -> Vec<f64> {
        let mut work = self.plan.work();
        let first = self.within(band)[0];
        let scale = 1.0 / self.plan.size() as f64;
        work.lines.fill(Complex::default());
        let moved = self.lines(band, from);
        work.lines.iter_mut().skip(first).zip(moved).for_each(|(to, x)| *to = x * scale);
        self.plan.inverse(&mut work);
        work.signal[..self.samples].to_vec()
    }
}
