//! How a player ends, and when it is silent.

use crate::common;

use common::{Rig, noise, rough};
use unripple_player::{At, Command, Options, Voice, WaveOptions};

#[test]
fn a_player_whose_desk_is_gone_fades_out_by_itself() {
    let mut rig = Rig::new(Options { outputs: 2, ..Options::default() });
    let (voice, drive) = (Voice(1), rough(1, 2, 500, 0.4));
    rig.send(Command::Start { voice, drive, at: At::Now, gain: 1.0, period: Some(480.0) });
    assert!(rig.play(100)[0].iter().any(|x| *x != 0.0));
    let Rig { mut player, desk, .. } = rig;
    drop(desk);
    let mut out = [0.0; 128];
    // A tenth of a second.
    (0..75).for_each(|_| player.process(&mut out));
    for _ in 0..10_000 {
        player.process(&mut out);
        assert!(out.iter().all(|x| *x == 0.0));
    }
}

#[test]
fn a_player_that_is_to_end_fades_out_and_takes_nothing_more() {
    let mut rig = Rig::new(Options { outputs: 2, ..Options::default() });
    let (voice, drive) = (Voice(1), rough(1, 2, 2000, 0.4));
    let comb = Command::Start { voice, drive: drive.clone(), at: At::Now, gain: 1.0, period: Some(2000.0) };
    rig.send(comb);
    rig.start(2, &drive, 7000);
    rig.play(100);
    assert!(!rig.desk.meters().is_silent() && !rig.desk.is_over());
    let before = rig.player.clock() as usize;
    rig.desk.end(640);
    rig.start(3, &drive, 0);
    let heard = rig.play(400);
    for (output, heard) in heard.iter().enumerate() {
        for (i, x) in heard.iter().enumerate() {
            let whole = drive.channel(output)[(before + i) % 2000];
            let expected = whole * (640f32 - i as f32).max(0.0) / 641.0;
            assert!((x - expected).abs() < 1e-6 && (i < 640 || *x == 0.0), "sample {i}: {x}, not {expected}");
        }
    }
    assert!(rig.desk.is_over() && rig.desk.meters().is_silent());
}

#[test]
fn a_silent_player_is_over_at_once() {
    let mut rig = Rig::new(Options::default());
    rig.play(3);
    assert!(rig.desk.meters().is_silent());
    rig.desk.end(48_000);
    assert!(!rig.desk.is_over());
    rig.play(1);
    assert!(rig.desk.is_over());
}

/// Silence is told when it is exact and stays, and not a block before waveforms have rung out.
#[test]
fn silence_is_told_when_waveforms_have_rung_out() {
    let waves = WaveOptions { inputs: 2, taps: 700, ..WaveOptions::default() };
    let mut rig = Rig::new(Options { outputs: 1, waves: Some(waves), ..Options::default() });
    let response: Vec<f32> = noise(3, 700).iter().map(|x| 0.02 * x).collect();
    let filters = rig.desk.filters(&[response]).unwrap();
    rig.send(Command::SetFilters { input: 1, filters, at: At::Now, fade: 64 });
    rig.play(3);
    let samples = noise(5, 1000).into();
    let (voice, filters, at) = (Voice(1), None, At::Now);
    rig.send(Command::Wave { voice, input: 1, filters, samples, at, gain: 1.0, looped: false });
    let mut last = (0, 0);
    for block in 0..200 {
        let sounds = rig.block().iter().any(|x| *x != 0.0);
        last.0 = if sounds { block } else { last.0 };
        last.1 = if rig.desk.meters().is_silent() { last.1 } else { block };
    }
    assert!((20..40).contains(&last.0) && (last.0..last.0 + 8).contains(&last.1), "{last:?}");
}
