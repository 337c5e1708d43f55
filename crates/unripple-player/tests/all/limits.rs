//! No limit is ever passed, and nothing is clipped, whatever is asked.

use crate::common;

use common::{Rig, noise, rough, smooth};
use proptest::prelude::*;
use std::sync::Arc;
use unripple_player::{
    At, Command, Limit, Options, PreparedDrive, PreparedFilters, Report, Running, Voice, WaveOptions,
};

const OUTPUTS: usize = 2;

/// What a session does; numbers are taken modulo what there is.
#[derive(Clone, Debug)]
struct Act {
    what: u8,
    voice: u64,
    block: u64,
    offset: u64,
    seed: u64,
    samples: usize,
    gain: f32,
    period: f64,
    fade: u32,
}

fn acts(most: usize) -> impl Strategy<Value = Vec<Act>> {
    let gain = prop_oneof![-3f32..3.0, Just(1.0), Just(f32::NAN), Just(f32::INFINITY), Just(1e30), Just(0.0)];
    let period = prop_oneof![64f64..900.0, Just(0.0), Just(f64::NAN), Just(1e300), Just(-5.0)];
    let act = (0u8..12, 0u64..8, 0u64..120, 0u64..200, 1u64..1 << 30, 1usize..1200, gain, period, 0u32..700);
    let act = act.prop_map(|(what, voice, block, offset, seed, samples, gain, period, fade)| Act {
        what,
        voice,
        block,
        offset,
        seed,
        samples,
        gain,
        period,
        fade,
    });
    prop::collection::vec(act, 1..most)
}

fn options(waves: bool) -> Options {
    let running = |level, seconds| Some(Running { level, seconds });
    Options {
        outputs: OUTPUTS,
        limits: vec![
            Limit { peak: 1.0, rms: running(0.35, 0.01), thermal: running(0.25, 0.3) },
            Limit { peak: 0.8, rms: None, thermal: running(0.3, 0.1) },
        ],
        longest: 1400,
        copies: 24,
        voices: 6,
        work: 12_000,
        waves: waves.then_some(WaveOptions { inputs: 2, taps: 200, sounds: 4, ..WaveOptions::default() }),
        ..Options::default()
    }
}

fn when(act: &Act) -> At {
    match act.seed % 3 {
        0 => At::Now,
        1 => At::Sample((act.block * 64 + act.offset).saturating_sub(64)),
        _ => At::Sample(act.block * 64 + act.offset),
    }
}

fn command(act: &Act, rig: &Rig) -> Option<Command> {
    let (voice, at) = (Voice(act.voice), when(act));
    let drive = || match act.seed % 4 {
        0 => rough(act.seed, OUTPUTS, act.samples, 1.5),
        1 => Arc::new(
            PreparedDrive::new(
                OUTPUTS,
                vec![if act.seed % 8 < 4 { 0.9 } else { -0.9 }; OUTPUTS * act.samples],
            )
            .unwrap(),
        ),
        2 => {
            let pass = act.samples.max(140);
            Arc::new(PreparedDrive::looped(OUTPUTS, noise(act.seed, OUTPUTS * pass), 64).unwrap())
        }
        _ => smooth(act.seed, OUTPUTS, act.samples, 1.0),
    };
    Some(match act.what {
        0..=3 => Command::Start { voice, drive: drive(), at, gain: act.gain, period: None },
        4 => Command::Start { voice, drive: drive(), at, gain: act.gain, period: Some(act.period) },
        5 => Command::Swap { voice, drive: drive(), at },
        6 => Command::Gain { voice, gain: act.gain, at },
        9 => {
            let filters = filters(act, rig)?;
            Command::SetFilters { input: (act.voice % 3) as usize, filters, at, fade: act.fade }
        }
        _ => {
            let samples: Arc<[f32]> = smooth(act.seed, 1, act.samples, 3.0).channel(0).into();
            let input = (act.voice % 2) as usize;
            let looped = act.seed.is_multiple_of(2);
            let filters = filters(act, rig).filter(|_| act.seed.is_multiple_of(3)).map(|own| (own, act.fade));
            Command::Wave { voice, input, filters, samples, at, gain: act.gain, looped }
        }
    })
}

fn filters(act: &Act, rig: &Rig) -> Option<Arc<PreparedFilters>> {
    let response = |o: u64| noise(act.seed + o, 200).iter().map(|x| 0.2 * x).collect::<Vec<f32>>();
    rig.desk.filters(&[response(0), response(1)]).ok()
}

/// Plays a session; all that was emitted.
fn play(acts: &[Act], options: Options) -> (Vec<Vec<f32>>, Vec<Report>) {
    let mut rig = Rig::new(options);
    let mut heard = vec![Vec::new(); OUTPUTS];
    for block in 0..160 {
        for act in acts.iter().filter(|act| act.block == block) {
            if let 7 | 8 = act.what {
                let fade = (!act.seed.is_multiple_of(5)).then_some(act.fade);
                rig.stop(Voice(act.voice), when(act), fade);
            } else if let Some(command) = command(act, &rig) {
                rig.offer(command);
            }
        }
        let part = rig.play(1);
        heard.iter_mut().zip(part).for_each(|(heard, part)| heard.extend(part));
    }
    (heard, rig.reports)
}

/// The running powers of what was emitted, sample by sample, in double precision.
fn worst_power(heard: &[f32], running: Running) -> f64 {
    let step = (-1.0 / (running.seconds * 48e3)).exp();
    let mut power = 0.0;
    heard.iter().fold(0.0, |worst: f64, &x| {
        power = step * power + (1.0 - step) * f64::from(x) * f64::from(x);
        worst.max(power.sqrt())
    })
}

fn check(heard: &[Vec<f32>], options: &Options) -> Result<(), TestCaseError> {
    for (output, heard) in heard.iter().enumerate() {
        let limit = options.limit(output);
        let peak = heard.iter().fold(0.0, |m, x| f32::max(m, x.abs()));
        prop_assert!(heard.iter().all(|x| x.is_finite()) && f64::from(peak) <= limit.peak, "peak {peak}");
        for running in [limit.rms, limit.thermal].into_iter().flatten() {
            let worst = worst_power(heard, running);
            prop_assert!(worst <= running.level, "rms {worst} of {running:?}");
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, max_shrink_iters: 200, ..ProptestConfig::default() })]

    #[test]
    fn drives_never_pass_a_limit(acts in acts(60)) {
        let options = options(false);
        let (heard, _) = play(&acts, options.clone());
        check(&heard, &options)?;
    }

    #[test]
    fn drives_and_waveforms_together_never_pass_a_limit(acts in acts(60)) {
        let options = options(true);
        let (heard, _) = play(&acts, options.clone());
        check(&heard, &options)?;
    }

    #[test]
    fn peaks_alone_are_held_to_the_last_bit(acts in acts(60)) {
        let options = Options { limits: vec![Limit { peak: 0.3, ..Limit::default() }], ..options(true) };
        let (heard, _) = play(&acts, options.clone());
        check(&heard, &options)?;
    }

    /// The formula of the ledger, by brute force over all samples: two drives, the second overlapping the first.
    #[test]
    fn the_gain_is_the_largest(seed in 1u64..1 << 40, at in 0u64..200, first in 10usize..300, second in 10usize..300) {
        let limits = vec![Limit { peak: 1.0, ..Limit::default() }];
        let mut rig = Rig::new(Options { limits, ..options(false) });
        let (one, two) = (rough(seed, OUTPUTS, first, 0.9), rough(seed + 7, OUTPUTS, second, 0.9));
        rig.start(1, &one, 0);
        rig.start(2, &two, at);
        rig.play(12);
        let mut largest = 1f64;
        for output in 0..OUTPUTS {
            for (i, &y) in two.channel(output).iter().enumerate().filter(|(_, y)| **y != 0.0) {
                let x = one.channel(output).get(at as usize + i).copied().unwrap_or(0.0);
                let held = if (x > 0.0) == (y > 0.0) { x.abs() } else { 0.0 };
                largest = largest.min((1.0 - f64::from(held)) / f64::from(y.abs()));
            }
        }
        let given = rig.reports.iter().find_map(|report| match report {
            Report::Started { voice: Voice(2), gain, .. } => Some(f64::from(*gain)),
            _ => None,
        });
        prop_assert!((given.unwrap() - largest).abs() < 2e-6, "{given:?} {largest}");
    }
}

#[test]
fn what_stops_gives_back_what_it_held() {
    let limits = vec![Limit { peak: 1.0, ..Limit::default() }];
    let mut rig = Rig::new(Options { limits, longest: 10_000, ..options(false) });
    let long = Arc::new(PreparedDrive::new(OUTPUTS, vec![1.0; OUTPUTS * 10_000]).unwrap());
    rig.start(1, &long, 0);
    rig.stop(Voice(1), At::Sample(640), Some(64));
    rig.play(60);
    rig.start(2, &long, 60 * 64);
    rig.play(60);
    assert!(rig.reports.contains(&Report::Started { voice: Voice(2), sample: 3840, gain: 1.0 }));
}

#[test]
fn a_steady_drive_comes_close_to_its_power() {
    let options = options(false);
    let mut rig = Rig::new(options.clone());
    let hum = |i: usize| 0.6 * (0.3 * i as f32).sin();
    let pulse = Arc::new(
        PreparedDrive::new(OUTPUTS, [0; OUTPUTS].iter().flat_map(|_| (0..960).map(hum)).collect()).unwrap(),
    );
    let (voice, period) = (Voice(1), Some(960.0));
    rig.send(Command::Start { voice, drive: pulse, at: At::Now, gain: 1.0, period });
    let heard = rig.play(1500);
    let running = options.limit(0).thermal.unwrap();
    let worst = worst_power(&heard[0], running);
    assert!(rig.desk.meters().heat(0) > 0.9 && rig.desk.meters().take_peak(0) <= 1.0);
    assert!(worst <= running.level && worst > 0.9 * running.level, "{worst}");
}

#[test]
fn waveforms_fill_what_drives_leave_and_come_back() {
    let limits = vec![Limit { peak: 1.0, ..Limit::default() }];
    let mut rig = Rig::new(Options { limits, ..options(true) });
    let filters = rig.desk.filters(&[vec![1.0], vec![0.5]]).unwrap();
    rig.send(Command::SetFilters { input: 0, filters, at: At::Now, fade: 64 });
    let hum: Arc<[f32]> = (0..4800).map(|i| 0.9 * (i as f32 * std::f32::consts::TAU / 96.0).sin()).collect();
    let (voice, at, filters) = (Voice(9), At::Now, None);
    rig.send(Command::Wave { voice, input: 0, filters, samples: hum, at, gain: 1.0, looped: true });
    let before = rig.play(50);
    let mut last = before[0][before[0].len() - 1];
    let peak = |heard: &[f32]| heard.iter().fold(0.0, |m, x| f32::max(m, x.abs()));
    assert!((peak(&before[0][640..]) - 0.9).abs() < 1e-3 && rig.desk.meters().wave_gain() == 1.0);
    let drive = smooth(3, OUTPUTS, 1400, 0.8);
    rig.start(1, &drive, 50 * 64);
    let during = rig.play(12);
    assert!(rig.reports.iter().any(|r| matches!(r, Report::WavesLimited { .. })));
    assert!(rig.reports.contains(&Report::Started { voice: Voice(1), sample: 3200, gain: 1.0 }));
    assert!(peak(&during[0]) <= 1.0 && rig.desk.meters().wave_gain() < 0.8);
    // No step beyond the waveform's, the drive's, and the gain's: from 1 to 0 over a block at the most.
    let own = |x: &[f32]| x.windows(2).fold(0.0, |m, pair| f32::max(m, (pair[1] - pair[0]).abs()));
    let allowed = own(&before[0][640..]) + own(drive.channel(0)) + 0.9 / 64.0;
    for x in &during[0] {
        assert!((x - last).abs() < 1.01 * allowed);
        last = *x;
    }
    rig.play(120);
    assert_eq!(rig.desk.meters().wave_gain(), 1.0);
}

/// Many copies, each of which is rounded the most when it is added, begin beside a waveform that is as loud as may be.
#[test]
fn copies_beside_a_waveform_keep_the_peak_to_the_last_bit() {
    // About as many steps of the sum as there is room for.
    for (copies, steps) in [(256, 330..390), (2000, 40..50)] {
        let least = steps.start;
        for steps in steps {
            let most = loudest(copies, steps as f32 + 0.49);
            assert!(f64::from(most) <= PEAK, "{copies} copies of {steps} steps: {most} of {PEAK}");
            assert!(steps > least || f64::from(most) > 0.99 * PEAK, "the limit is not reached: {most}");
        }
    }
}

const PEAK: f64 = 1.02;

/// The largest sample where so many copies, each so many steps of float32 above 1 high, begin in one block beside a waveform.
fn loudest(copies: usize, steps: f32) -> f32 {
    let waves = WaveOptions { inputs: 1, taps: 8, sounds: 1, ..WaveOptions::default() };
    let mut rig = Rig::new(Options {
        outputs: 1,
        block: 1024,
        limits: vec![Limit { peak: PEAK, ..Limit::default() }],
        copies,
        commands: 4096,
        waves: Some(waves),
        ..Options::default()
    });
    let filters = rig.desk.filters(&[vec![1.0]]).unwrap();
    rig.send(Command::SetFilters { input: 0, filters, at: At::Now, fade: 64 });
    let samples: Arc<[f32]> = vec![1.01; 100_000].into();
    let (voice, at, filters) = (Voice(0), At::Now, None);
    rig.send(Command::Wave { voice, input: 0, filters, samples, at, gain: 1.0, looped: true });
    rig.play(20);
    for voice in 1..=copies as u64 {
        let drive = Arc::new(PreparedDrive::new(1, vec![steps * f32::EPSILON; 900]).unwrap());
        rig.send(Command::Start { voice: Voice(voice), drive, at, gain: 1.0, period: None });
    }
    rig.play(3)[0].iter().fold(0.0, |m, x| f32::max(m, x.abs()))
}
