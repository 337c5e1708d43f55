//! A film whose modes are known in closed form, played and recorded as benches do: by two clocks, with gaps, knocks, noise,
//! distortion, under a tension that drifts.

#![allow(dead_code)]

use crate::signals_bench::Noise;
use std::f64::consts::{PI, TAU};
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Channel, Listen, MeasureOptions, Rig, Session, Wires};
use unripple_calibrate::signals::Band;
use unripple_core::{Decay, Device, Layout, ModalResponses, PROBE, Point, Port, Responses, Surface};
use unripple_devices::Tape;
use unripple_physics::design::papers_surface;
use unripple_physics::{ResponseOptions, responses};

pub const RATE: f64 = 48e3;
const BLOCK: usize = 256;
const SIDE: f64 = 0.15;

/// Samples of silence before the played signal.
const PAUSE: f64 = 2048.0;

/// Highest mode, as a multiple of the top of the band: real sheets do not end there.
const BEYOND: f64 = 1.4;

/// Where the probe stands.
pub const AT: Point = Point { x: 0.062, y: 0.090 };

/// Faults of one take of a recording.
#[derive(Clone)]
pub struct Faults {
    /// Error of the recording's clock in parts per million, positive if it is fast.
    pub ppm: f64,
    /// Delay of the recording, in samples.
    pub late: f64,
    /// Samples lost (negative: repeated), and where in the recording.
    pub lost: Option<(i64, usize)>,
    /// A second such gap at another place, counted after the first.
    pub lost_again: Option<(i64, usize)>,
    /// Largest jitter of the latency, in samples, which takes ten values over the recording.
    pub jitter: f64,
    /// Relative change of tension since the first take, at the beginning and at the end.
    pub tension: [f64; 2],
    /// Noise of each channel below the rms of the loudest sweep, in dB.
    pub noise_db: Option<f64>,
    /// Share of the second and the third harmonic in the drive.
    pub harmonics: [f64; 2],
    /// A knock on the film, half a period of a sine: its time in s, its largest force relative to full drive, and its duration in s.
    pub knock: Option<[f64; 3]>,
    /// Delay of the probe alone, in samples.
    pub probe_late: f64,
    /// Bits per sample of the file.
    pub bits: Option<u32>,
    /// Level at which the drive is clipped.
    pub clip: Option<f64>,
    /// An actuator that does nothing.
    pub dead: Option<usize>,
    /// A sensor that records noise alone.
    pub deaf: Option<usize>,
}

impl Default for Faults {
    fn default() -> Self {
        Self {
            ppm: 0.0,
            late: 0.0,
            lost: None,
            lost_again: None,
            jitter: 0.0,
            tension: [0.0; 2],
            noise_db: None,
            harmonics: [0.0; 2],
            knock: None,
            probe_late: 0.0,
            bits: None,
            clip: None,
            dead: None,
            deaf: None,
        }
    }
}

/// The film as its file describes it, and its modes.
pub struct Bench {
    pub surface: Surface,
    pub model: ModalResponses,
    layout: Layout,
    /// Angular frequency, tension's share of its square, and the wavenumbers of each mode.
    modes: Vec<[f64; 4]>,
    decay: f64,
}

impl Bench {
    /// A film with so many actuators, a band and a decay time.
    pub fn new(actuators: usize, top: f64, decay: f64) -> Self {
        let mut surface = papers_surface();
        surface.actuators.truncate(actuators);
        surface.emission.band[1] = top;
        surface.sheet.decay = Decay::Time(decay);
        let model = match responses(&surface, &ResponseOptions::default()) {
            Ok(Responses::Modal(model)) => model,
            other => panic!("{other:?}"),
        };
        let sheet = &surface.sheet;
        let (density, tension) = (sheet.density * sheet.thickness, sheet.tension);
        let stiffness = sheet.young * sheet.thickness.powi(3) / 12.0 / (1.0 - sheet.poisson.powi(2));
        let mut modes = Vec::new();
        for m in 1..60_u32 {
            for n in 1..60_u32 {
                let [kx, ky] = [m, n].map(|m| PI * f64::from(m) / SIDE);
                let square = kx * kx + ky * ky;
                let [stretched, bent] = [tension * square, stiffness * square * square];
                let omega = ((stretched + bent) / density).sqrt();
                if omega < TAU * BEYOND * top {
                    modes.push([omega, stretched / (stretched + bent), kx, ky]);
                }
            }
        }
        let names: Vec<String> = surface.actuators.iter().map(|actuator| actuator.name.clone()).collect();
        let layout = Layout {
            device: "tape".into(),
            rate: RATE,
            block: BLOCK,
            inputs: names.iter().cloned().chain([PROBE.to_owned()]).collect(),
            outputs: names,
            full_scale: surface.emission.limit,
        };
        Self { surface, model, layout, modes, decay }
    }

    pub fn session(&self, options: &MeasureOptions) -> Session {
        let ports: Vec<Port> = self.model.ports.clone();
        let wires = Wires::by_name(&ports, &self.layout, &[]).unwrap();
        Session::new(&self.surface, &self.layout, wires, options).unwrap()
    }

    /// Readouts of all modes at a place, mass-normalised.
    fn shape(&self, at: Point) -> Vec<f64> {
        let mass = self.surface.sheet.density * self.surface.sheet.thickness * SIDE * SIDE / 4.0;
        let value = |[_, _, kx, ky]: &[f64; 4]| (kx * at.x).sin() * (ky * at.y).sin() / mass.sqrt();
        self.modes.iter().map(value).collect()
    }

    /// True responses at the probe, `[actuator][sample]`, in a band, as many samples as asked for.
    pub fn truth(&self, band: Band, samples: usize) -> Vec<Vec<f64>> {
        const LEAD: usize = 2000;
        let probe = self.shape(AT);
        let one = |actuator: &unripple_core::Actuator| -> Vec<f64> {
            let own = self.shape(actuator.at);
            let mut response = vec![0.0; LEAD + samples + 8000];
            for (mode, weight) in self.modes.iter().zip(own.iter().zip(&probe).map(|(a, b)| a * b)) {
                for (i, x) in response[LEAD..].iter_mut().enumerate() {
                    let t = i as f64 / RATE;
                    *x += weight * (-t / self.decay).exp() * (mode[0] * t).cos();
                }
            }
            band.limit(&mut response, RATE).unwrap();
            response[LEAD..LEAD + samples].to_vec()
        };
        self.surface.actuators.iter().map(one).collect()
    }

    /// Signals of all inputs for a drive (full scale 1).
    pub fn hear(&self, drive: &[Vec<f32>], faults: &Faults, seed: u64) -> Vec<Vec<f32>> {
        let samples = drive[0].len();
        let places = self.surface.actuators.iter().map(|actuator| actuator.at).chain([AT]);
        let shapes: Vec<Vec<f64>> = places.map(|at| self.shape(at)).collect();
        let [at, strength, seconds] = faults.knock.unwrap_or_default();
        let knock = |i: usize| {
            let part = (i as f64 + 0.5 - (at * RATE).floor()) / (seconds * RATE).max(1.0);
            if (0.0..1.0).contains(&part) { strength * (PI * part).sin() / RATE } else { 0.0 }
        };
        let elsewhere = self.shape(Point::from_mm(88.0, 51.0));
        let distort = |x: f64| {
            let x = faults.clip.map_or(x, |most| x.clamp(-most, most));
            // Of a sine of amplitude 1, x² is half second harmonic and x³ a quarter third.
            x + 2.0 * faults.harmonics[0] * x * x - 4.0 * faults.harmonics[1] * x * x * x
        };
        let mut states = vec![(0.0, 0.0); self.modes.len()];
        let mut turns = Vec::new();
        let mut heard = vec![vec![0.0; samples]; shapes.len()];
        for i in 0..samples {
            if i % 64 == 0 {
                let [from, to] = faults.tension;
                turns = self.turns(from + (to - from) * i as f64 / samples as f64);
            }
            let kicks: Vec<f64> = drive
                .iter()
                .enumerate()
                .map(
                    |(a, line)| if faults.dead == Some(a) { 0.0 } else { distort(f64::from(line[i])) / RATE },
                )
                .collect();
            for (m, ((re, im), (cos, sin))) in states.iter_mut().zip(&turns).enumerate() {
                *re += kicks.iter().zip(&shapes).map(|(kick, shape)| kick * shape[m]).sum::<f64>();
                *re += knock(i) * elsewhere[m];
                (*re, *im) = {
                    for (line, shape) in heard.iter_mut().zip(&shapes) {
                        line[i] += shape[m] * *re;
                    }
                    (*re * cos - *im * sin, *re * sin + *im * cos)
                };
            }
        }
        self.recorded(heard, faults, seed)
    }

    fn turns(&self, change: f64) -> Vec<(f64, f64)> {
        let fall = (-1.0 / (self.decay * RATE)).exp();
        let turn = |[omega, share, ..]: &[f64; 4]| {
            let (sin, cos) = (omega * (1.0 + change * share).sqrt() / RATE).sin_cos();
            (fall * cos, fall * sin)
        };
        self.modes.iter().map(turn).collect()
    }

    /// The signals as a recorder stores them, with its faults.
    fn recorded(&self, heard: Vec<Vec<f64>>, faults: &Faults, seed: u64) -> Vec<Vec<f32>> {
        let probe = heard.len() - 1;
        let one = |(input, line): (usize, Vec<f64>)| -> Vec<f32> {
            let late = faults.late + if input == probe { faults.probe_late } else { 0.0 };
            let step = 1.0 / (1.0 + 1e-6 * faults.ppm);
            let mut line: Vec<f64> = match late == 0.0 && faults.ppm == 0.0 {
                true => line,
                // The clocks agree where the sweeps begin, after the blocks of silence.
                false => {
                    let at = |i: usize| PAUSE + (i as f64 - PAUSE) * step - late;
                    (0..line.len()).map(|i| between(&line, at(i))).collect()
                }
            };
            for (lost, at) in [faults.lost, faults.lost_again].into_iter().flatten() {
                match usize::try_from(lost) {
                    Ok(count) => drop(line.drain(at..at + count)),
                    Err(_) => {
                        let again = line[at - lost.unsigned_abs() as usize..at].to_vec();
                        line.splice(at..at, again);
                    }
                }
            }
            if faults.jitter > 0.0 {
                let late = wandering(faults.jitter, line.len());
                line = late.iter().enumerate().map(|(i, late)| between(&line, i as f64 - late)).collect();
            }
            let rms = (line.iter().map(|x| x * x).sum::<f64>() / line.len() as f64).sqrt();
            if let Some(db) = faults.noise_db {
                let mut noise = Noise(seed * 1000 + input as u64);
                let level = rms * 10f64.powf(-db / 20.0);
                line.iter_mut().for_each(|x| *x += level * noise.gauss());
            }
            if faults.deaf == Some(input) {
                let mut noise = Noise(seed * 1000 + 500 + input as u64);
                line.iter_mut().for_each(|x| *x = 1e-3 * rms * noise.gauss());
            }
            if let Some(bits) = faults.bits {
                let peak = line.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
                let step = 2.0 * peak / f64::from(1 << bits);
                line.iter_mut().for_each(|x| *x = (*x / step).round() * step);
            }
            line.into_iter().map(|x| x as f32).collect()
        };
        let played = heard[0].len();
        let mut lines: Vec<Vec<f32>> = heard.into_iter().enumerate().map(one).collect();
        // The recorder goes on after what is played, however many samples it lost.
        let longest = lines.iter().map(Vec::len).fold(played, usize::max) + 4 * BLOCK;
        lines.iter_mut().for_each(|line| line.resize(longest, 0.0));
        lines
    }

    /// The drive that a session plays.
    pub fn drive(&self, session: &Session) -> Vec<Vec<f32>> {
        let mut recorder = Recorder(Tape::recorder(self.layout.clone()).unwrap());
        // What it makes of silence does not matter.
        let _ = session.measure(&mut recorder, 0, AT, 0, Listen::Probe);
        recorder.0.into_drive()
    }

    /// A rig whose takes have one set of faults after the other; the last stays.
    pub fn rig(&self, session: &Session, faults: &[Faults]) -> Takes<'_> {
        let drive = self.drive(session);
        Takes { bench: self, drive, faults: faults.to_vec(), count: 0, tape: None }
    }

    /// A session with a first take as its reference, and the probe's responses in a second take, each with its faults.
    pub fn measured(
        &self,
        options: &MeasureOptions,
        first: &Faults,
        second: &Faults,
    ) -> Result<(Vec<Channel>, Channel, Session), CalibrateError> {
        let mut session = self.session(options);
        let mut rig = self.rig(&session, &[first.clone(), second.clone()]);
        let sensors = session.measure(&mut rig, 1, AT, 0, Listen::Sensors)?;
        session.set_reference(&sensors)?;
        let found = session.measure(&mut rig, 0, AT, 0, Listen::Probe)?.remove(0);
        Ok((sensors, found, session))
    }

    /// Rms error relative to the rms of the truth, over all actuators, without the first millisecond, which holds what the
    /// band takes from the onset.
    pub fn off(&self, channel: &Channel, session: &Session) -> f64 {
        let truth = self.truth(session.band(), channel.responses[0].len());
        off(&channel.responses, &truth)
    }
}

/// Rms error relative to the rms of the truth.
pub fn off(found: &[Vec<f64>], truth: &[Vec<f64>]) -> f64 {
    let (mut apart, mut all) = (0.0, 0.0);
    for (found, truth) in found.iter().zip(truth) {
        for (x, y) in found.iter().zip(truth).skip(48) {
            apart += (x - y).powi(2);
            all += y * y;
        }
    }
    (apart / all).sqrt()
}

/// Ten delays up to so many samples early or late, each for a tenth of the time, from one to the next within 10 ms.
fn wandering(most: f64, samples: usize) -> Vec<f64> {
    let mut random = Noise(77);
    let knots: Vec<f64> = (0..10).map(|_| most * (2.0 * random.uniform() - 1.0)).collect();
    let at = |i: usize| {
        let knot = (10 * i / samples).min(9);
        let since = i as f64 - knot as f64 * samples as f64 / 10.0;
        let before = knots[knot.saturating_sub(1)];
        before + (knots[knot] - before) * (since / (0.01 * RATE)).clamp(0.0, 1.0)
    };
    (0..samples).map(at).collect()
}

/// Value between samples by Lagrange's polynomial through twelve: signals here stay below a tenth of the rate.
fn between(line: &[f64], at: f64) -> f64 {
    let first = at.floor() as i64 - 5;
    (0..12)
        .map(|k| {
            let x = usize::try_from(first + k).ok().and_then(|i| line.get(i)).copied().unwrap_or(0.0);
            let weight = |j: i64| (at - (first + j) as f64) / (k - j) as f64;
            x * (0..12).filter(|j| *j != k).map(weight).product::<f64>()
        })
        .sum()
}

struct Recorder(Tape);

impl Rig for Recorder {
    fn device(&mut self) -> &mut dyn Device {
        &mut self.0
    }

    fn ready(&mut self, number: usize, _at: Point, _attempt: u64) -> Result<(), CalibrateError> {
        let fresh = Tape::recorder(self.0.layout().clone());
        self.0 = fresh.map_err(|error| CalibrateError::Rig { number, why: error.to_string() })?;
        Ok(())
    }

    fn tap(&mut self, number: usize, _at: Point, _attempt: u64) -> Result<(), CalibrateError> {
        Err(CalibrateError::Rig { number, why: "nobody taps".into() })
    }
}

/// Plays back one take after another.
pub struct Takes<'a> {
    bench: &'a Bench,
    drive: Vec<Vec<f32>>,
    faults: Vec<Faults>,
    count: usize,
    tape: Option<Tape>,
}

impl Rig for Takes<'_> {
    fn device(&mut self) -> &mut dyn Device {
        self.tape.as_mut().unwrap()
    }

    fn ready(&mut self, number: usize, _at: Point, _attempt: u64) -> Result<(), CalibrateError> {
        let faults = &self.faults[self.count.min(self.faults.len() - 1)];
        self.count += 1;
        let lines = self.bench.hear(&self.drive, faults, self.count as u64);
        let tape = Tape::player(self.bench.layout.clone(), lines);
        self.tape = Some(tape.map_err(|error| CalibrateError::Rig { number, why: error.to_string() })?);
        Ok(())
    }

    fn tap(&mut self, number: usize, _at: Point, _attempt: u64) -> Result<(), CalibrateError> {
        Err(CalibrateError::Rig { number, why: "nobody taps".into() })
    }
}
