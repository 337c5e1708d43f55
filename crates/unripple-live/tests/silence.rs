//! Every sound ends: two windows after the last finger has left there is exact silence, whatever was lost, refused or stood
//! still on the way.

mod common;
#[path = "common/rig.rs"]
mod rig;

use common::{BLOCK, RATE, clicks, touch};
use proptest::prelude::*;
use rig::*;
use unripple_core::{Phase, Point, Random, Touch};
use unripple_effects::{Effect, Tone};
use unripple_player::{Count, Options, WaveOptions};

/// All fingers go round and round.
fn stroke(fingers: u64, step: usize, time: f64) -> Vec<Touch> {
    let phase = if step == 0 { Phase::Down } else { Phase::Move };
    let place = |finger: u64| {
        let x = 75.0 + 50.0 * (0.006 * step as f64 + finger as f64).sin();
        Point::from_mm(x, 20.0 + 14.0 * finger as f64)
    };
    (0..fingers).map(|finger| at(finger, phase, place(finger), time)).collect()
}

fn lift(fingers: u64, time: f64) -> Vec<Touch> {
    (0..fingers).map(|finger| at(finger, Phase::Up, Point::from_mm(75.0, 75.0), time)).collect()
}

/// A server that freezes for two seconds while eight fingers stroke, and goes on when they have left.
#[test]
fn a_player_that_stood_still_while_fingers_stroked_and_left_falls_silent() {
    let mut rig = Rig::new(&set(vec![comb(20.0), grains(0.8e-3)]), &options());
    let mut step = 0;
    for _ in 0..200 {
        rig.touch(stroke(8, step, rig.now()));
        assert!(rig.play(1) <= 1.0);
        step += 1;
    }
    assert!(rig.drive.iter().any(|x| *x != 0.0));
    for _ in 0..(2.0 * RATE / BLOCK as f64) as usize {
        rig.touch(stroke(8, step, rig.now()));
        step += 1;
    }
    rig.touch(lift(8, rig.now()));
    rig.falls_silent(5.0);
}

/// What was sent before anybody knew is taken back, what comes later is not sent, and what fingers hold goes on.
#[test]
fn what_fingers_did_while_the_player_stood_still_is_not_made_up_for() {
    let mut all = vec![comb(20.0)];
    all.extend(clicks().effects);
    let mut rig = Rig::new(&set(all), &options());
    for step in 0..50 {
        rig.touch(stroke(4, step, rig.now()));
        rig.play(1);
    }
    let tap = |rig: &mut Rig| {
        for phase in [Phase::Down, Phase::Up] {
            rig.touch(vec![touch(9, phase, 60.0, 90.0, rig.now())]);
        }
    };
    (0..20).for_each(|_| tap(&mut rig));
    // By the machine's clock: longer than a player is believed to be between two blocks.
    std::thread::sleep(std::time::Duration::from_millis(250));
    (0..20).for_each(|_| tap(&mut rig));
    let started = |rig: &Rig| rig.conductor.desk().meters().count(Count::Started);
    let before = started(&rig);
    rig.play(1);
    assert!(started(&rig) - before <= 4, "more than a copy of each comb began");
    assert!(rig.rest(60) > 0.0 && started(&rig) > before, "what fingers hold goes on");
    assert!(rig.conductor.tally().stale > 0);
    rig.touch(lift(4, rig.now()));
    rig.falls_silent(1.0);
}

/// Forty textures at once are more than there is room for, and a comb among them ends all the same.
#[test]
fn a_comb_ends_however_much_else_is_asked_for() {
    let mut all = vec![comb(20.0)];
    all.extend((0..40).map(|_| grains(0.1e-3)));
    let mut rig = Rig::new(&set(all), &options());
    let place = |x: f64| Point::from_mm(x, 90.0);
    for step in 0..20 {
        let phase = if step == 0 { Phase::Down } else { Phase::Move };
        rig.touch(vec![at(1, phase, place(40.0 + 0.2 * f64::from(step)), rig.now())]);
        rig.play(8);
    }
    // A jump after 80 ms without a word: 64 grains of each texture at one moment, and the lift behind them.
    rig.play(60);
    let now = rig.now();
    rig.touch(vec![at(1, Phase::Move, place(60.0), now), at(1, Phase::Up, place(60.0), now)]);
    assert!(rig.conductor.tally().lost > 0);
    rig.falls_silent(3.0);
}

/// The player holds as many commands as it may, for later.
#[test]
fn a_lift_is_obeyed_when_the_player_can_take_no_more_commands() {
    let mut all = vec![comb(40.0)];
    all.extend((0..8).map(|_| pulses(300.0)));
    let mut rig = Rig::new(&set(all), &Options { commands: 24, ..options() });
    rig.touch_ahead(vec![touch(1, Phase::Down, 60.0, 90.0, 0.0)], 4800);
    rig.play(1);
    for _ in 0..4 {
        rig.touch_ahead(Vec::new(), 4800);
        rig.play(1);
    }
    // Some more that it must refuse, and the lift behind them.
    rig.touch_ahead(Vec::new(), 5200);
    rig.touch_ahead(vec![touch(1, Phase::Up, 60.0, 90.0, rig.now())], 5200);
    rig.play(1);
    assert!(rig.conductor.desk().meters().count(Count::Refused) > 0);
    rig.falls_silent(2.0);
}

/// As before a server of long cycles: what is known ahead is given two of them ahead.
#[test]
fn a_lift_takes_back_what_was_given_ahead() {
    let mut rig = Rig::new(&set(vec![pulses(300.0), score(2, 0.2)]), &options());
    rig.touch_ahead(vec![touch(1, Phase::Down, 60.0, 90.0, 0.0)], 8192);
    rig.play(1);
    for _ in 0..8 {
        rig.touch_ahead(Vec::new(), 8192);
        assert!(rig.play(32) > 0.0);
    }
    rig.touch_ahead(vec![touch(1, Phase::Up, 60.0, 90.0, rig.now())], 8192);
    let (stale, refused) = (rig.conductor.tally().stale, rig.conductor.tally().refused);
    rig.rings_out(2.0);
    // Nothing of that went wrong.
    let tally = rig.conductor.tally();
    assert_eq!((tally.stale, tally.refused), (stale, refused));
}

/// Of two waveforms at once one is refused each time; inputs are there again for those that come later.
#[test]
fn a_waveform_that_is_refused_gives_its_input_back() {
    let waves = WaveOptions { inputs: 3, sounds: 1, ..options().waves.unwrap() };
    let mut rig = Rig::new(&set(vec![score(2, 0.05)]), &Options { waves: Some(waves), ..options() });
    for finger in 0..6 {
        rig.touch(vec![touch(finger, Phase::Down, 60.0, 90.0, rig.now())]);
        assert!(rig.rest(200) > 0.0, "touch {finger} is not answered");
        assert!(rig.conductor.tally().crowded == 0, "touch {finger} finds all inputs taken");
    }
    assert!(rig.conductor.tally().refused >= 6);
    rig.touch(lift(6, rig.now()));
    rig.rings_out(1.0);
}

/// What waveforms are over is known even if the word of it was lost.
#[test]
fn inputs_are_free_again_when_reports_were_lost() {
    let waves = WaveOptions { inputs: 2, ..options().waves.unwrap() };
    let small = Options { commands: 24, copies: 16, waves: Some(waves), ..options() };
    let mut rig = Rig::new(&set(vec![score(2, 1.0), comb(500.0)]), &small);
    for finger in 0..3 {
        rig.touch(vec![touch(finger, Phase::Down, 60.0, 90.0, rig.now())]);
        // Nobody listens for a second and a half: first the words of starts fill the way, then those of ends are lost.
        rig.play(1125);
        rig.rest(4);
        assert!(rig.conductor.tally().crowded == 0, "touch {finger} finds all inputs taken");
    }
    assert!(rig.conductor.desk().meters().count(Count::ReportsLost) > 0);
    rig.touch(lift(3, rig.now()));
    rig.rings_out(1.0);
}

/// One finger more than there is room for: it gets its turn when another has left, and not before.
fn waits_for_room(kind: Effect, options: Options, room: u64) {
    let mut rig = Rig::new(&set(vec![kind]), &options);
    rig.touch(stroke(room, 0, 0.0));
    assert!(rig.rest(100) > 0.0);
    rig.touch(vec![at(room, Phase::Down, Point::from_mm(100.0, 100.0), rig.now())]);
    rig.rest(100);
    rig.touch(lift(room, rig.now()));
    // Long enough for those to be over, and for one more to begin.
    rig.rest(100);
    assert!(rig.rest(400) > 0.0, "the last finger feels nothing although there is room");
    rig.touch(lift(room + 1, rig.now()));
    rig.rings_out(1.0);
}

#[test]
fn a_hum_for_which_there_is_no_input_waits_for_one() {
    let waves = WaveOptions { inputs: 3, ..options().waves.unwrap() };
    waits_for_room(hum(Tone::Sine(200.0)), Options { waves: Some(waves), ..options() }, 3);
}

#[test]
fn a_hum_for_which_the_player_has_no_room_waits_for_it() {
    let waves = WaveOptions { sounds: 3, ..options().waves.unwrap() };
    waits_for_room(hum(Tone::Sine(200.0)), Options { waves: Some(waves), ..options() }, 3);
}

#[test]
fn a_comb_for_which_the_player_has_no_voice_waits_for_one() {
    waits_for_room(comb(40.0), Options { voices: 3, ..options() }, 3);
}

/// A comb faster than blocks are can never be played, and is asked for once.
#[test]
fn a_comb_that_can_never_be_played_is_not_asked_for_again() {
    let mut rig = Rig::new(&set(vec![comb(400.0)]), &Options { block: 256, ..options() });
    rig.touch(stroke(1, 0, 0.0));
    rig.rest(200);
    assert!((1..=2).contains(&rig.conductor.tally().refused), "{}", rig.conductor.tally().refused);
}

#[derive(Clone, Debug)]
enum Act {
    /// Touches of this phase, of a finger, somewhere, so many in a row.
    Touch(u64, u8, u8),
    /// Both sides go on, for some blocks.
    Play(usize),
    /// The player alone, for some blocks.
    Deaf(usize),
    /// The conductor alone, for so many steps.
    Frozen(usize),
}

fn acts() -> impl Strategy<Value = Vec<Act>> {
    let act = prop_oneof![
        6 => (0u64..6, 0u8..3, 1u8..40).prop_map(|(finger, phase, count)| Act::Touch(finger, phase, count)),
        4 => (1usize..40).prop_map(Act::Play),
        1 => (1usize..200).prop_map(Act::Deaf),
        1 => (1usize..100).prop_map(Act::Frozen),
    ];
    prop::collection::vec(act, 1..60)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, max_shrink_iters: 60, ..ProptestConfig::default() })]

    #[test]
    fn whatever_happened_there_is_silence_in_the_end(seed in 0u64..1 << 40, acts in acts(), small in any::<bool>()) {
        let mut random = Random::seeded(seed);
        let waves = WaveOptions { inputs: 3, sounds: 4, ..options().waves.unwrap() };
        let few = Options { commands: 32, copies: 24, voices: 4, waves: Some(waves), ..options() };
        let mut rig = Rig::new(&everything(&mut random), &if small { few } else { options() });
        for act in acts {
            match act {
                Act::Touch(finger, phase, count) => {
                    let phase = [Phase::Down, Phase::Move, Phase::Up][usize::from(phase)];
                    for _ in 0..count {
                        rig.touch(vec![at(finger, phase, somewhere(&mut random), rig.now())]);
                    }
                }
                Act::Play(blocks) => prop_assert!(rig.rest(blocks) <= 1.0),
                Act::Deaf(blocks) => prop_assert!(rig.play(blocks) <= 1.0),
                Act::Frozen(steps) => (0..steps).for_each(|_| rig.touch(Vec::new())),
            }
        }
        rig.touch(lift(6, rig.now()));
        rig.rings_out(1.0);
    }

    #[test]
    fn hums_end(tones in prop::collection::vec(20.0..900.0, 1..4), blocks in 1usize..200) {
        let mut rig = Rig::new(&set(tones.into_iter().map(|f| hum(Tone::Sine(f))).collect()), &options());
        rig.touch(stroke(5, 0, 0.0));
        prop_assert!(rig.rest(blocks + 50) > 0.0);
        rig.touch(lift(5, rig.now()));
        rig.rings_out(1.0);
    }
}
