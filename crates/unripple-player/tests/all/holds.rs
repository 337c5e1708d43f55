//! What goes on sounds as long as it is held, and no longer, whatever else is lost or refused.

use crate::common;

use common::{Rig, noise, rough, start};
use std::sync::Arc;
use unripple_player::{At, Command, Hold, Limit, Options, Report, Voice, WaveOptions, Why};

fn options() -> Options {
    let waves = Some(WaveOptions { inputs: 2, taps: 100, sounds: 1, ..WaveOptions::default() });
    let limits = vec![Limit { peak: 100.0, ..Limit::default() }];
    Options { outputs: 1, limits, commands: 8, waves, ..Options::default() }
}

fn comb(voice: u64, at: At) -> Command {
    Command::Start { voice: Voice(voice), drive: rough(voice, 1, 70, 1.0), at, gain: 1.0, period: Some(64.0) }
}

fn wave(rig: &Rig, voice: u64, input: usize, looped: bool) -> Command {
    let filters = Some((rig.desk.filters(&[noise(voice, 100)]).unwrap(), 64));
    let samples = noise(voice, 300).into();
    Command::Wave { voice: Voice(voice), input, filters, samples, at: At::Now, gain: 1.0, looped }
}

fn sounds(heard: &[Vec<f32>]) -> bool {
    heard.iter().flatten().any(|x| *x != 0.0)
}

fn refused(rig: &Rig, name: u64, reason: Why) -> bool {
    rig.reports.contains(&Report::Refused { voice: Some(Voice(name)), why: reason })
}

/// Neither on its way nor in the player is there room for anything.
#[test]
fn what_is_let_go_ends_where_nothing_finds_room() {
    let mut rig = Rig::new(options());
    let comb = rig.desk.hold(comb(1, At::Now)).unwrap();
    let looped = wave(&rig, 2, 0, true);
    let hum = rig.desk.hold(looped).unwrap();
    assert!(sounds(&rig.play(50)));
    let late = rough(9, 1, 10, 1.0);
    (0..8).for_each(|i| rig.start(10 + i, &late, 1 << 40));
    rig.play(1);
    while rig.offer(start(20, &late, 1 << 40)) {}
    drop((comb, hum));
    // A copy rings out, a waveform fades over a block and rings on through its filters.
    rig.play(20);
    assert!(!sounds(&rig.play(1000)));
    assert!(refused(&rig, 20, Why::Pending));
}

#[test]
fn what_is_let_go_before_it_begins_never_does() {
    let mut rig = Rig::new(options());
    let ahead = rig.desk.hold(comb(1, At::Sample(640))).unwrap();
    rig.play(3);
    ahead.stop(At::Sample(600), None);
    let looped = wave(&rig, 2, 0, true);
    let gone = rig.desk.hold(looped).unwrap();
    gone.stop(At::Now, Some(0));
    assert!(!sounds(&rig.play(100)));
    assert!(ahead.over().is_some() && gone.over().is_some());
    assert!(refused(&rig, 1, Why::Stale) && refused(&rig, 2, Why::Stale));
}

#[test]
fn holds_tell_what_is_over_or_was_refused_although_nobody_reads_reports() {
    let mut rig = Rig::new(options());
    let hold = |rig: &mut Rig, command| rig.desk.hold(command).unwrap();
    let play = |rig: &mut Rig, blocks| (0..blocks).for_each(|_| rig.player.process(&mut [0.0; 64]));
    let noisy = hold(&mut rig, comb(9, At::Now));
    // So many starts that there is no room for a word more.
    play(&mut rig, 20_000);
    let (first, second) = (wave(&rig, 1, 0, false), wave(&rig, 2, 1, false));
    let (first, second) = (hold(&mut rig, first), hold(&mut rig, second));
    play(&mut rig, 1);
    assert!(first.over().is_none() && second.over().is_some(), "one sounds, and only one may");
    play(&mut rig, 10);
    assert!(first.over().is_some() && noisy.over().is_none());
    noisy.stop(At::Now, None);
    play(&mut rig, 3);
    assert!(noisy.over().is_some());
}

#[test]
fn what_goes_on_is_sent_with_a_hold_alone() {
    let mut rig = Rig::new(options());
    let looped = wave(&rig, 2, 0, true);
    assert!(rig.desk.send(comb(1, At::Now)).is_err() && rig.desk.send(looped).is_err());
    let once = wave(&rig, 2, 0, false);
    assert!(rig.desk.send(once).is_ok());
}

/// Replacing by name ends the old; letting the old go then does nothing to the new.
#[test]
fn a_hold_ends_what_it_holds_and_nothing_else_of_that_name() {
    let mut rig = Rig::new(options());
    let old = rig.desk.hold(comb(1, At::Now)).unwrap();
    rig.play(4);
    let new = rig.desk.hold(comb(1, At::Now)).unwrap();
    rig.play(4);
    assert!(old.over().is_some() && new.over().is_none());
    drop(old);
    assert!(sounds(&rig.play(4)[..]));
    drop(new);
    rig.play(4);
    assert!(!sounds(&rig.play(100)));
}

/// Taking back reaches what is on its way and what waits in the player, but not what goes on.
#[test]
fn what_is_taken_back_does_not_begin() {
    let mut rig = Rig::new(options());
    let drive = rough(1, 1, 500, 1.0);
    rig.start(1, &drive, 2000);
    rig.play(1);
    rig.start(2, &drive, 0);
    let kept = rig.desk.hold(comb(3, At::Now)).unwrap();
    rig.desk.withdraw();
    rig.start(4, &drive, 3000);
    rig.play(100);
    let begun =
        |voice| rig.reports.iter().any(|r| matches!(r, Report::Started { voice: v, .. } if v.0 == voice));
    assert!(!begun(1) && !begun(2) && begun(3) && begun(4));
    assert!(refused(&rig, 1, Why::Stale) && refused(&rig, 2, Why::Stale));
    assert_eq!(kept.over(), None);
}

#[test]
fn a_waveform_takes_its_filters_with_it() {
    let mut rig = Rig::new(options());
    let (first, second) = (wave(&rig, 1, 0, false), wave(&rig, 2, 0, false));
    rig.send(first);
    assert!(sounds(&rig.play(10)));
    rig.play(10);
    let Command::Wave { voice, input, samples, at, gain, looped, .. } = second else { panic!() };
    let bare = |samples: &Arc<[f32]>| {
        let (filters, samples) = (None, samples.clone());
        Command::Wave { voice, input, filters, samples, at, gain, looped }
    };
    rig.send(bare(&samples));
    assert!(!sounds(&rig.play(20)), "it goes through what the first had");
}

/// Those that wait for time in a block for longer than they last are wanted by nobody.
#[test]
fn starts_that_were_put_off_for_longer_than_they_last_are_refused() {
    let mut rig = Rig::new(Options { work: 1000, commands: 64, ..options() });
    let drive = rough(1, 1, 200, 1.0);
    (0..40).for_each(|voice| rig.start(voice, &drive, 0));
    rig.play(2 * 200 / 64 + 2);
    assert!(!sounds(&rig.play(100)));
    assert!(refused(&rig, 39, Why::Stale));
}

/// A hold may go to another thread, and outlive both ends.
#[test]
fn a_hold_may_outlive_the_player() {
    let mut rig = Rig::new(options());
    let held = rig.desk.hold(comb(1, At::Now)).unwrap();
    rig.play(2);
    drop(rig);
    let other = std::thread::spawn(move || held.stop(At::Now, Some(5)));
    assert!(other.join().is_ok());
    fn sent<T: Send + Sync>() {}
    sent::<Hold>();
}
