//! Recordings of all inputs while each output plays a burst.

use super::{Expected, WiringOptions};
use std::f64::consts::TAU;
use unripple_core::{Device, DeviceError, Layout};
use unripple_dsp::rms;

/// Recordings of every input while each output plays its burst, from the burst's start on.
#[derive(Clone, Debug)]
pub(super) struct Takes {
    pub(super) outputs: usize,
    pub(super) inputs: usize,
    /// Recordings, `[output · inputs + input][sample]`.
    pub(super) heard: Vec<Vec<f64>>,
    /// Root mean square of each input while nothing played.
    pub(super) noise: Vec<f64>,
    /// Samples compared with the model.
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

/// Plays a burst at each output in turn.
pub(super) fn record(
    device: &mut dyn Device,
    layout: &Layout,
    options: &WiringOptions,
) -> Result<Takes, DeviceError> {
    let Layout { rate, block, .. } = *layout;
    let (outputs, inputs) = (layout.outputs.len(), layout.inputs.len());
    let samples = |time: f64| (time * rate).ceil() as usize;
    let (window, most) = (samples(options.listen), samples(options.max_latency));
    let burst = burst(options, rate);
    let pause = samples(options.pause).div_ceil(block);
    let blocks = (window + most).div_ceil(block).max(1);
    let mut drive = vec![0.0f32; outputs * block];
    let mut heard = vec![0.0f32; inputs * block];
    // The first silence lets a device settle; its end is the noise.
    let mut listen = |device: &mut dyn Device, blocks: usize, output: Option<usize>| {
        let mut takes = vec![Vec::with_capacity(blocks * block); inputs];
        for start in (0..blocks).map(|b| b * block) {
            drive.fill(0.0);
            if let Some(output) = output {
                let plane = &mut drive[output * block..(output + 1) * block];
                let from = burst.get(start..).unwrap_or(&[]);
                plane.iter_mut().zip(from).for_each(|(to, x)| *to = (options.level * x) as f32);
            }
            device.exchange(&drive, &mut heard)?;
            for (take, plane) in takes.iter_mut().zip(heard.chunks_exact(block)) {
                take.extend(plane.iter().map(|x| f64::from(*x)));
            }
        }
        Ok::<_, DeviceError>(takes)
    };
    listen(device, pause, None)?;
    let noise = listen(device, blocks, None)?.iter().map(|take| rms(take)).collect();
    let mut all = Vec::with_capacity(outputs * inputs);
    for output in 0..outputs {
        all.extend(listen(device, blocks, Some(output))?);
        listen(device, pause, None)?;
    }
    Ok(Takes { outputs, inputs, heard: all, noise, window, most })
}

/// Recordings of the same bursts, as they follow from measured responses.
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
        noise: vec![0.0; inputs],
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

/// The recordings of the same bursts that a model predicts.
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
