//! What is emitted without limits in the way is what was prepared, where it was asked for.

use crate::common;

use common::{Rig, noise, rough, smooth, start};
use proptest::prelude::*;
use std::sync::Arc;
use unripple_player::{
    At, Command, Count, FilterPlan, Limit, Options, PreparedDrive, Report, Voice, WaveOptions, Which, Why,
    player,
};

fn options(outputs: usize) -> Options {
    Options { outputs, limits: vec![Limit { peak: 100.0, ..Limit::default() }], ..Options::default() }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn one_voice_is_emitted_bit_for_bit(seed in 1u64..1 << 40, at in 0u64..300, samples in 1usize..400) {
        let mut rig = Rig::new(options(3));
        let drive = rough(seed, 3, samples, 2.0);
        rig.start(1, &drive, at);
        let heard = rig.play(12);
        for (output, heard) in heard.iter().enumerate() {
            let at = at as usize;
            let (before, rest) = heard.split_at(at);
            prop_assert!(before.iter().chain(&rest[samples..]).all(|x| *x == 0.0));
            prop_assert_eq!(&rest[..samples], drive.channel(output));
        }
    }

    #[test]
    fn voices_add(seed in 1u64..1 << 40, starts in prop::collection::vec((0u64..500, 1usize..300, -2f32..2.0), 1..12)) {
        let mut rig = Rig::new(options(2));
        let mut sum = vec![vec![0f64; 1024]; 2];
        for (i, &(at, samples, gain)) in starts.iter().enumerate() {
            let drive = rough(seed + i as u64, 2, samples, 1.0);
            for (sum, output) in sum.iter_mut().zip(0..) {
                let parts = sum[at as usize..].iter_mut().zip(drive.channel(output));
                parts.for_each(|(sum, &x)| *sum += f64::from(gain) * f64::from(x));
            }
            let (voice, period) = (Voice(i as u64), None);
            rig.send(Command::Start { voice, drive, at: At::Sample(at), gain, period });
        }
        let heard = rig.play(16);
        for (heard, sum) in heard.iter().flatten().zip(sum.iter().flatten()) {
            prop_assert!((f64::from(*heard) - sum).abs() < 3e-6);
        }
    }

    #[test]
    fn the_time_of_sending_does_not_matter(seed in 1u64..1 << 40, ahead in prop::collection::vec(0u64..9, 24)) {
        let session = |ahead: &[u64]| {
            let tight = vec![Limit { peak: 0.7, ..Limit::default() }];
            let waves = Some(WaveOptions { inputs: 2, taps: 100, ..WaveOptions::default() });
            let mut rig = Rig::new(Options { limits: tight, waves, ..options(2) });
            let plan = rig.desk.plan().unwrap().clone();
            let mut heard = Vec::new();
            for block in 0..40u64 {
                let sent = |i: usize| 9 + i as u64 - ahead[i];
                for i in 0..ahead.len() {
                    let due = (9 + i as u64) * 64;
                    // What has not been sent cannot be stopped.
                    if i % 8 == 4 && block == sent(i).max(sent(i - 4)) {
                        let at = At::Sample(due + (seed ^ i as u64) % 64);
                        rig.stop(Voice(i as u64 - 4), at, Some(80));
                    } else if i % 8 != 4 && block == sent(i) {
                        rig.send(command(&plan, seed, i as u64, due));
                    }
                }
                heard.extend(rig.block());
            }
            heard.iter().map(|x| x.to_bits()).collect::<Vec<_>>()
        };
        prop_assert_eq!(session(&[0; 24]), session(&ahead));
    }
}

/// One of a session's commands, each for another block.
fn command(plan: &FilterPlan, seed: u64, i: u64, block: u64) -> Command {
    let at = At::Sample(block + (seed ^ i) % 64);
    let drive = smooth(seed + i, 2, 50 + (seed % 211) as usize, 0.5);
    match i % 8 {
        0 => Command::Start { voice: Voice(i), drive, at, gain: 1.0, period: Some(70.5) },
        2 => Command::Swap { voice: Voice(i - 2), drive, at },
        5 => Command::Gain { voice: Voice(i - 5), gain: 0.7, at },
        6 => {
            let filters = Arc::new(plan.prepare(&[noise(seed + i, 100), noise(i, 50)]).unwrap());
            Command::SetFilters { input: 1, filters, at, fade: 100 }
        }
        7 => {
            let samples = noise(seed + i, 700).into();
            let (voice, filters) = (Voice(i), None);
            Command::Wave { voice, input: 1, filters, samples, at, gain: 0.1, looped: true }
        }
        _ => Command::Start { voice: Voice(i), drive, at, gain: 0.8, period: None },
    }
}

#[test]
fn now_is_the_first_sample_of_the_next_block() {
    let mut rig = Rig::new(options(1));
    rig.play(3);
    let drive = rough(5, 1, 10, 1.0);
    rig.send(Command::Start { voice: Voice(3), drive: drive.clone(), at: At::Now, gain: 1.0, period: None });
    assert_eq!(rig.block()[..10], *drive.channel(0));
    assert_eq!(
        rig.reports,
        [
            Report::Started { voice: Voice(3), sample: 192, gain: 1.0 },
            Report::Ended { voice: Voice(3), sample: 202 },
        ]
    );
}

#[test]
fn what_has_passed_is_late_and_said_so() {
    let mut rig = Rig::new(options(1));
    rig.play(3);
    let drive = rough(5, 1, 10, 1.0);
    rig.start(3, &drive, 150);
    assert_eq!(rig.block()[..10], *drive.channel(0));
    assert_eq!(rig.reports[0], Report::Late { voice: Some(Voice(3)), by: 42 });
    assert_eq!(rig.desk.meters().count(Count::Late), 1);
}

#[test]
fn a_comb_repeats_at_rounded_multiples_of_its_period() {
    let mut rig = Rig::new(options(1));
    let drive = Arc::new(PreparedDrive::new(1, vec![1.0]).unwrap());
    let (voice, period) = (Voice(1), Some(70.3));
    rig.send(Command::Start { voice, drive, at: At::Sample(5), gain: 1.0, period });
    rig.stop(voice, At::Sample(900), None);
    let heard = rig.play(20);
    let found: Vec<usize> = (0..heard[0].len()).filter(|&i| heard[0][i] != 0.0).collect();
    let wanted: Vec<usize> = (0..13).map(|k| 5 + (f64::from(k) * 70.3).round() as usize).collect();
    assert_eq!(found, wanted);
    assert_eq!(rig.reports.last(), Some(&Report::Ended { voice, sample: 900 }));
}

#[test]
fn a_loop_has_no_seam_and_turns_into_another() {
    let mut rig = Rig::new(options(1));
    let pass = |seed| noise(seed, 200);
    let looped = |pass: Vec<f32>| Arc::new(PreparedDrive::looped(1, pass, 64).unwrap());
    let (voice, period) = (Voice(1), None);
    rig.send(Command::Start { voice, drive: looped(pass(1)), at: At::Sample(0), gain: 1.0, period });
    rig.send(Command::Swap { voice, drive: looped(pass(2)), at: At::Sample(500) });
    let heard = rig.play(20).remove(0);
    assert!((64..600).all(|i| heard[i] == pass(1)[(i - 64) % 200]), "the first, bit for bit");
    assert!((664..1280).all(|i| heard[i] == pass(2)[(i - 64) % 200]), "then the second");
    for (i, x) in heard.iter().enumerate().take(664).skip(600) {
        let share = (i - 599) as f32 / 65.0;
        let mixed = (1.0 - share) * pass(1)[(i - 64) % 200] + share * pass(2)[(i - 64) % 200];
        assert!((x - mixed).abs() < 1e-6);
    }
}

#[test]
fn starts_beyond_the_work_of_a_block_wait_and_say_so() {
    let mut rig = Rig::new(Options { work: 1000, ..options(1) });
    let drive = rough(1, 1, 400, 1.0);
    (0..5).for_each(|voice| rig.send(start(voice, &drive, 7)));
    rig.play(20);
    let started: Vec<u64> = rig
        .reports
        .iter()
        .filter_map(|r| if let Report::Started { sample, .. } = r { Some(*sample) } else { None })
        .collect();
    assert_eq!(started, [7, 7, 64, 64, 128]);
    assert!(rig.reports.contains(&Report::Late { voice: Some(Voice(4)), by: 121 }));
    assert_eq!(rig.desk.meters().count(Count::PutOff), 3);
}

#[test]
fn a_drive_is_scaled_by_just_what_is_left() {
    let limits = vec![Limit { peak: 1.0, ..Limit::default() }];
    let mut rig = Rig::new(Options { limits, ..options(1) });
    let wide = |x: f32| Arc::new(PreparedDrive::new(1, vec![x; 100]).unwrap());
    rig.start(1, &wide(0.75), 0);
    rig.start(2, &wide(0.5), 10);
    // Parts of the other sign may vanish, so they leave no more.
    rig.start(3, &wide(-1.0), 20);
    rig.play(2);
    let by = |voice, scale| Report::Limited { voice: Voice(voice), scale, which: Which::Peak, output: 0 };
    let limited: Vec<Report> =
        rig.reports.iter().copied().filter(|r| matches!(r, Report::Limited { .. })).collect();
    let [Report::Limited { voice, scale, which, output }] = limited[..] else { panic!("{limited:?}") };
    assert_eq!(by(2, scale), Report::Limited { voice, scale, which, output });
    assert!((scale - 0.5).abs() < 1e-6 && scale <= 0.5);
}

#[test]
fn what_cannot_be_is_refused_with_the_reason() {
    let mut rig = Rig::new(Options { copies: 2, voices: 1, longest: 500, ..options(2) });
    let good = rough(1, 2, 100, 1.0);
    let ask = |voice: u64, drive: &Arc<PreparedDrive>, gain: f32, period: Option<f64>| {
        let (voice, drive) = (Voice(voice), drive.clone());
        Command::Start { voice, drive, at: At::Now, gain, period }
    };
    rig.send(ask(1, &rough(1, 3, 10, 1.0), 1.0, None));
    rig.send(ask(2, &rough(1, 2, 501, 1.0), 1.0, None));
    rig.send(ask(3, &good, f32::NAN, None));
    rig.send(ask(4, &good, 1.0, Some(0.0)));
    rig.send(ask(5, &good, 1.0, Some(f64::NAN)));
    rig.send(Command::Swap { voice: Voice(6), drive: good.clone(), at: At::Now });
    rig.send(ask(7, &good, 1.0, Some(1000.0)));
    rig.send(ask(8, &good, 1.0, Some(1000.0)));
    (9..12).for_each(|voice| rig.send(ask(voice, &good, 1.0, None)));
    rig.play(1);
    let mut refused: Vec<(u64, Why)> = Vec::new();
    for report in &rig.reports {
        if let Report::Refused { voice: Some(voice), why } = report {
            refused.push((voice.0, *why));
        }
    }
    refused.sort_by_key(|(voice, _)| *voice);
    let first = [Why::Outputs, Why::Samples, Why::Gain, Why::Period, Why::Period, Why::Unknown];
    assert_eq!(refused[..6].iter().map(|(_, why)| *why).collect::<Vec<_>>(), first);
    assert!(refused.contains(&(8, Why::Voices)) && refused.contains(&(11, Why::Copies)), "{refused:?}");
}

#[test]
fn a_million_starts_are_counted_and_played_as_far_as_there_is_room() {
    let mut rig = Rig::new(Options { copies: 16, commands: 256, ..options(2) });
    let drives = [rough(1, 2, 4800, 1.0), rough(2, 2, 1, 1.0), rough(3, 2, 64, 1.0)];
    let far = [u64::MAX, u64::MAX - 1, 1 << 62, 0, 500_000];
    let (mut lost, mut holds) = (0, Vec::new());
    for i in 0..1_000_000u64 {
        let drive = drives[i as usize % 3].clone();
        let at = if i % 5 == 0 { At::Sample(far[i as usize / 5 % 5]) } else { At::Now };
        let period = (i % 7 == 0).then_some(64.0 + (i % 1000) as f64);
        let start = Command::Start { voice: Voice(i % 9), drive, at, gain: 1.0, period };
        lost += u64::from(match period {
            Some(_) => rig.desk.hold(start).map(|hold| holds.push(hold)).is_err(),
            None => rig.desk.send(start).is_err(),
        });
        if i % 300 == 299 {
            assert!(rig.block().iter().all(|x| x.is_finite()));
            rig.reports.clear();
        }
    }
    let count = |what| rig.desk.meters().count(what);
    assert_eq!(count(Count::CommandsLost), lost);
    assert!(lost > 0 && count(Count::Refused) > 100_000 && count(Count::Started) > 1000);
    // All but what the player and this test hold has come back to be freed.
    rig.desk.collect();
    let held: usize = drives.iter().map(Arc::strong_count).sum();
    assert!(held <= 3 + 256 + 64 + 3 * 16, "{held}");
}

#[test]
fn a_block_of_another_size_is_silent_and_counted() {
    let mut rig = Rig::new(options(2));
    let mut out = [1.0; 100];
    rig.player.process(&mut out);
    assert_eq!((out, rig.player.clock()), ([0.0; 100], 0));
    assert_eq!(rig.desk.meters().count(Count::Misfits), 1);
}

#[test]
fn options_that_cannot_be_are_refused() {
    let refused = |options: Options| player(&options).unwrap_err().to_string();
    let fault = refused(Options { outputs: 3, limits: vec![Limit::default(); 2], ..Options::default() });
    assert_eq!(fault, "limits: expected 3, found 2");
    assert!(refused(Options { limits: vec![], ..Options::default() }).contains("expected 8"));
    assert!(refused(Options { block: 0, ..Options::default() }).contains("8 to 8192"));
    assert!(refused(Options { rate: f64::NAN, ..Options::default() }).contains("sample rate"));
    let limits = vec![Limit { peak: f64::INFINITY, ..Limit::default() }];
    assert!(refused(Options { limits, ..Options::default() }).contains("peak limit"));
    let waves = Some(WaveOptions { band_top_hz: 30e3, ..WaveOptions::default() });
    assert!(refused(Options { waves, ..Options::default() }).contains("top of the band"));
}
