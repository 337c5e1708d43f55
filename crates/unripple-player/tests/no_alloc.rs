//! The audio thread neither allocates nor frees.

mod common;

use assert_no_alloc::{AllocDisabler, assert_no_alloc};
use common::{noise, rough};
use std::sync::Arc;
use unripple_player::{At, Command, Hold, Limit, Options, Running, Voice, WaveOptions, player};

#[global_allocator]
static ALLOCATOR: AllocDisabler = AllocDisabler;

#[test]
fn ten_fingers_waveforms_and_changes_of_filters_without_an_allocation() {
    let running = |level, seconds| Some(Running { level, seconds });
    let options = Options {
        outputs: 4,
        limits: vec![Limit { peak: 1.0, rms: running(0.4, 0.05), thermal: running(0.3, 2.0) }],
        copies: 24,
        commands: 64,
        waves: Some(WaveOptions { inputs: 2, taps: 300, ..WaveOptions::default() }),
        ..Options::default()
    };
    let (mut player, mut desk) = player(&options).unwrap();
    let mut out = vec![0.0; 4 * 64];
    let responses =
        |seed| (0..4).map(|o| noise(seed + o, 300).iter().map(|x| x * 0.02).collect()).collect::<Vec<_>>();
    let samples: Arc<[f32]> = noise(77, 1000).into();
    let mut holds = [const { None }; 10];
    for block in 0u64..4000 {
        let voice = Voice(block % 10);
        if block % 3 == 0 {
            let (drive, period) = (rough(block + 1, 4, 1441, 0.4), (block % 4 == 0).then_some(480.5));
            let start = Command::Start { voice, drive, at: At::Now, gain: 1.0, period };
            holds[voice.0 as usize] = desk.hold(start).ok();
        }
        if block % 7 == 0 {
            let _ = desk.send(Command::Swap { voice, drive: rough(block + 1, 4, 700, 0.4), at: At::Now });
            holds[block as usize % 5].iter().for_each(|hold: &Hold| hold.stop(At::Now, Some(100)));
        }
        if block % 11 == 0 {
            let input = (block % 3) as usize;
            let filters = || Arc::new(desk.plan().unwrap().prepare(&responses(block)).unwrap());
            let (own, filters, at) = ((block % 22 == 0).then(|| (filters(), 200)), filters(), At::Now);
            let _ = desk.send(Command::SetFilters { input, filters, at, fade: 200 });
            let (samples, looped) = (samples.clone(), block % 2 == 0);
            let wave = Command::Wave { voice, input, filters: own, samples, at, gain: 1.0, looped };
            holds[voice.0 as usize] = desk.hold(wave).ok();
        }
        desk.feed(1, &noise(block, 64));
        if block % 500 > 100 {
            while desk.report().is_some() {}
        }
        assert_no_alloc(|| player.process(&mut out));
    }
    desk.withdraw();
    assert_no_alloc(|| player.process(&mut out));
    assert_no_alloc(|| player.process(&mut out[1..]));
    assert!(out[1..].iter().all(|x| *x == 0.0));
    drop(desk);
    (0..100).for_each(|_| assert_no_alloc(|| player.process(&mut out)));
    assert!(out.iter().all(|x| *x == 0.0));
}
