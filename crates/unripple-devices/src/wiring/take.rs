//! Recordings of all inputs while each output plays a burst.

use super::{Expected, WiringOptions};
use std::f64::consts::TAU;
use unripple_core::{Device, DeviceError, Layout};
use unripple_dsp::rms;

/// Smallest ratio of a channel's level to the noise (10 dB) at which the channel counts as carrying a
/// signal. With half of it, noise alone may be taken for a signal.
pub(super) const ABOVE_NOISE: f64 = 3.0;

/// Number of bursts that are averaged if a single one is hardly louder than the noise; this lowers the noise
/// by 9 dB. Sweeps, a hundred times longer than a burst, measure well at such levels, so that the wiring has
/// to be testable there too; more bursts would take longer than the sweeps.
const AGAIN: usize = 8;

/// Smallest ratio of a recording's level to the noise at which it may hold a signal that `AGAIN` bursts
/// would reveal, even if the signal is spread over two of the parts in which it is searched. Below it there
/// is only noise, and repeating the burst would only delay the report that a cable is not plugged in.
const PERHAPS: f64 = 1.2;

/// Recordings of every input while each output plays its burst, from the burst's start on.
#[derive(Clone, Debug)]
pub(super) struct Takes {
    pub(super) outputs: usize,
    pub(super) inputs: usize,
    /// Recordings, `[output · inputs + input][sample]`, each a mean over its bursts.
    pub(super) heard: Vec<Vec<f64>>,
    /// Root mean square of the noise in each recording: that of a mean over as many recordings of silence.
    pub(super) noise: Vec<f64>,
    /// Number of samples compared with the model.
    pub(super) window: usize,
    /// Largest latency that is searched, in samples.
    pub(super) most: usize,
}

/// The burst: a sine under a Hann window, peak 1.
fn burst(options: &WiringOptions, rate: f64) -> Vec<f64> {
    let samples = (options.cycles * rate / options.frequency).ceil().max(2.0) as usize;
    let at = |i: usize| {
        let x = (i as f64 + 0.5) / samples as f64;
        0.5 * (1.0 - (TAU * x).cos()) * (TAU * options.cycles * x).sin()
    };
    (0..samples).map(at).collect()
}

/// Plays a burst at each output in turn, and repeats it several times if it is hardly louder than the noise.
pub(super) fn record(
    device: &mut dyn Device,
    layout: &Layout,
    options: &WiringOptions,
) -> Result<Takes, DeviceError> {
    let (outputs, inputs) = (layout.outputs.len(), layout.inputs.len());
    let samples = |time: f64| (time * layout.rate).ceil() as usize;
    let (window, most) = (samples(options.listen), samples(options.max_latency));
    let mut bench = Bench {
        device,
        layout,
        burst: burst(options, layout.rate).into_iter().map(|x| (options.level * x) as f32).collect(),
        pause: samples(options.pause).div_ceil(layout.block),
        blocks: (window + most).div_ceil(layout.block).max(1),
    };
    // The first silence lets a device settle.
    bench.listen(bench.pause, None)?;
    let levels = |takes: &[Vec<f64>]| takes.iter().map(|take| rms(take)).collect::<Vec<f64>>();
    let silence = levels(&bench.listen(bench.blocks, None)?);
    let mut heard: Vec<Vec<f64>> = Vec::with_capacity(outputs * inputs);
    for output in 0..outputs {
        heard.extend(bench.mean(Some(output), 1)?);
    }
    let mut noise: Vec<f64> = (0..outputs).flat_map(|_| silence.iter().copied()).collect();
    let loudest = |take: &Vec<f64>| take.chunks_exact(window.max(1)).map(rms).fold(0.0, f64::max);
    let above: Vec<f64> = heard.iter().zip(&noise).map(|(take, noise)| loudest(take) / noise).collect();
    let unsure = |pairs: &mut dyn Iterator<Item = usize>| {
        let most = pairs.map(|pair| above[pair]).fold(0.0, f64::max);
        most > PERHAPS && most <= ABOVE_NOISE
    };
    let all = (0..inputs).any(|input| unsure(&mut (input..above.len()).step_by(inputs)));
    let again: Vec<usize> =
        (0..outputs).filter(|output| all || unsure(&mut (output * inputs..(output + 1) * inputs))).collect();
    if !again.is_empty() {
        let silence = levels(&bench.mean(None, AGAIN)?);
        for output in again {
            let own = output * inputs..(output + 1) * inputs;
            heard.splice(own.clone(), bench.mean(Some(output), AGAIN)?);
            noise[own].copy_from_slice(&silence);
        }
    }
    Ok(Takes { outputs, inputs, heard, noise, window, most })
}

/// A device, and the signal played to it: a burst, then silence until the surface's response has decayed.
struct Bench<'a> {
    device: &'a mut dyn Device,
    layout: &'a Layout,
    /// The burst, scaled to its level.
    burst: Vec<f32>,
    /// Number of blocks between recordings, and in a recording.
    pause: usize,
    blocks: usize,
}

impl Bench<'_> {
    /// Records all inputs for some blocks, while the burst is played at one output, or nothing.
    fn listen(&mut self, blocks: usize, output: Option<usize>) -> Result<Vec<Vec<f64>>, DeviceError> {
        let block = self.layout.block;
        let (outputs, inputs) = (self.layout.outputs.len(), self.layout.inputs.len());
        let (mut drive, mut heard) = (vec![0.0f32; outputs * block], vec![0.0f32; inputs * block]);
        let mut takes = vec![Vec::with_capacity(blocks * block); inputs];
        for start in (0..blocks).map(|b| b * block) {
            drive.fill(0.0);
            if let Some(output) = output {
                let plane = &mut drive[output * block..(output + 1) * block];
                let from = self.burst.get(start..).unwrap_or(&[]);
                plane.iter_mut().zip(from).for_each(|(to, x)| *to = *x);
            }
            self.device.exchange(&drive, &mut heard)?;
            for (take, plane) in takes.iter_mut().zip(heard.chunks_exact(block)) {
                take.extend(plane.iter().map(|x| f64::from(*x)));
            }
        }
        Ok(takes)
    }

    /// The mean of `times` recordings of all inputs, each followed by silence.
    fn mean(&mut self, output: Option<usize>, times: usize) -> Result<Vec<Vec<f64>>, DeviceError> {
        let mut sum = vec![vec![0.0; self.blocks * self.layout.block]; self.layout.inputs.len()];
        for _ in 0..times {
            let takes = self.listen(self.blocks, output)?;
            self.listen(self.pause, None)?;
            for (sum, take) in sum.iter_mut().zip(&takes) {
                sum.iter_mut().zip(take).for_each(|(sum, x)| *sum += x / times as f64);
            }
        }
        Ok(sum)
    }
}

/// Recordings of the bursts that would follow from measured responses.
pub(super) fn played(heard: &[Vec<Vec<f64>>], layout: &Layout, options: &WiringOptions) -> Takes {
    let samples = |time: f64| (time * layout.rate).ceil() as usize;
    let (window, most) = (samples(options.listen), samples(options.max_latency));
    let burst = burst(options, layout.rate);
    let line = |response: &Vec<f64>| {
        let mut line = unripple_dsp::convolve(&burst, response);
        line.resize(window + most, 0.0);
        line
    };
    let inputs = layout.inputs.len();
    Takes {
        outputs: layout.outputs.len(),
        inputs,
        heard: heard.iter().flatten().map(line).collect(),
        noise: vec![0.0; heard.len() * inputs],
        window,
        most,
    }
}

/// Scales all inputs to the same level, over all outputs.
pub(super) fn level(lines: &mut [Vec<f64>], inputs: usize) {
    for input in 0..inputs {
        let own = lines.iter().skip(input).step_by(inputs);
        let level = own.map(|line| rms(line).powi(2)).sum::<f64>().sqrt();
        if level > 0.0 {
            let own = lines.iter_mut().skip(input).step_by(inputs);
            own.flatten().for_each(|x| *x /= level);
        }
    }
}

/// Recordings of the bursts that a model predicts.
pub(super) fn predict(expected: &Expected, layout: &Layout, options: &WiringOptions) -> Vec<Vec<f64>> {
    let window = (options.listen * layout.rate).ceil() as usize;
    let scale = options.level * layout.full_scale / layout.rate;
    let burst: Vec<f64> = burst(options, layout.rate).iter().map(|x| scale * x).collect();
    let pairs = (0..expected.outputs()).flat_map(|o| (0..expected.inputs()).map(move |i| (o, i)));
    pairs
        .map(|(o, i)| {
            let mut line = unripple_dsp::convolve(&burst, expected.response(o, i));
            line.resize(window, 0.0);
            line
        })
        .collect()
}
