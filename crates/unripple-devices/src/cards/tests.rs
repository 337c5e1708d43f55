//! A card of two threads' halves, stepped by hand: what is heard is what was driven, later by the same time whatever was missed.

use super::crossing::{Events, Player, Recorder, crossing};
use super::ferry::{Ferry, Manners};
use super::streams::Streams;
use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;
use unripple_core::{Device, DeviceError, Layout, State};

const BLOCK: usize = 64;
const LEAD: usize = 2;
/// Samples by which the loop comes late.
const LATE: usize = 77;

/// Nothing moves on while somebody waits.
struct Still;

impl Streams for Still {
    fn wait(&mut self, at_most: Duration) -> Duration {
        at_most
    }
}

/// A card whose outputs lead to its inputs, late by [`LATE`].
struct Loop {
    player: Player,
    recorder: Recorder,
    wire: VecDeque<[f32; 2]>,
    events: Arc<Events>,
    seed: usize,
}

impl Loop {
    fn with(strict: bool) -> (Self, Ferry) {
        let events = Arc::new(Events::default());
        let (player, recorder, shore) = crossing(2, 2, 1024, &events);
        let names = || vec!["a".to_owned(), "b".to_owned()];
        let layout = Layout {
            device: "loop".into(),
            rate: 48e3,
            block: BLOCK,
            outputs: names(),
            inputs: names(),
            full_scale: 1.0,
        };
        let manners = Manners { lead: LEAD as u64, patience: Duration::from_millis(5), strict };
        let ferry = Ferry::new(layout, (shore, events.clone()), Box::new(Still), manners);
        let wire = VecDeque::from(vec![[0.0; 2]; LATE]);
        (Self { player, recorder, wire, events, seed: 1 }, ferry)
    }

    /// So many frames pass, in pieces of any size.
    fn step(&mut self, mut frames: usize) {
        while frames > 0 {
            self.seed = self.seed.wrapping_mul(25_173).wrapping_add(13_849) % 65_536;
            let piece = (1 + self.seed % 90).min(frames);
            let mut played = vec![[9.0_f32; 2]; piece];
            self.player.play(piece, |frame, output, x| played[frame][output] = x);
            self.wire.extend(played);
            let heard: Vec<[f32; 2]> = self.wire.drain(..piece).collect();
            self.recorder.hear(piece, |frame, input| heard[frame][input]);
            frames -= piece;
        }
    }
}

/// A sample of drive that no other is like.
fn sample(output: usize, i: usize) -> f32 {
    (i as f32 + 1.0) * if output == 0 { 1.0 } else { -1.0 }
}

fn drive(block: usize) -> Vec<f32> {
    (0..2).flat_map(|output| (0..BLOCK).map(move |i| sample(output, block * BLOCK + i))).collect()
}

/// What is to be heard at a sample of the answer, playing having begun, or gone on after a pause, with sample `from`.
fn expected(input: usize, i: usize, from: usize) -> f32 {
    i.checked_sub(LATE).filter(|i| *i >= from).map_or(0.0, |i| sample(input, i))
}

/// Exchanges a block and holds what is heard against what was driven [`LEAD`] blocks and [`LATE`] samples before.
fn exchange(ferry: &mut Ferry, block: usize, from: usize) {
    let mut heard = [7.0; 2 * BLOCK];
    ferry.exchange(&drive(block), &mut heard).unwrap();
    for (n, x) in heard.iter().enumerate() {
        let i = (block * BLOCK + n % BLOCK).checked_sub(LEAD * BLOCK);
        assert_eq!(*x, i.map_or(0.0, |i| expected(n / BLOCK, i, from)), "block {block}, sample {n}");
    }
}

#[test]
fn what_is_heard_is_what_was_driven_however_it_was_cut_up() {
    let (mut card, mut ferry) = Loop::with(true);
    for block in 0..40 {
        exchange(&mut ferry, block, 0);
        card.step(BLOCK);
    }
    let status = ferry.status();
    assert_eq!((status.state, status.blocks, status.lost), (State::Running, 40, 0));
}

#[test]
fn after_a_pause_latency_is_as_before_and_the_pause_is_counted() {
    let (mut card, mut ferry) = Loop::with(true);
    for block in 0..20 {
        exchange(&mut ferry, block, 0);
        card.step(BLOCK);
    }
    // More than the rings hold: silence is played, sound is dropped. What was driven before is played and heard yet.
    card.step(5000);
    for block in 20..22 {
        exchange(&mut ferry, block, 0);
        card.step(BLOCK);
        assert_eq!(ferry.status().lost, 0);
    }
    // Blocks from 20 on were played after the pause.
    for block in 22..40 {
        exchange(&mut ferry, block, 20 * BLOCK);
        card.step(BLOCK);
    }
    let gap = (5000 / BLOCK) as u64;
    assert!((gap..=gap + 1).contains(&ferry.status().lost), "{}", ferry.status().lost);
}

#[test]
fn a_card_that_stalls_goes_on_where_it_was() {
    let (mut card, mut ferry) = Loop::with(false);
    for block in 0..10 {
        exchange(&mut ferry, block, 0);
        card.step(BLOCK);
    }
    // It stops in the middle of block 10, whose answer is due with block 12.
    let mut heard = [0.0; 2 * BLOCK];
    exchange(&mut ferry, 10, 0);
    card.step(BLOCK / 2);
    exchange(&mut ferry, 11, 0);
    let error = ferry.exchange(&drive(12), &mut heard).unwrap_err();
    assert!(matches!(error, DeviceError::Stalled { .. }), "{error}");
    assert!(matches!(ferry.status().state, State::Stalled(_)));
    // The answer that came too late is thrown away.
    card.step(2 * BLOCK + BLOCK / 2);
    for block in 13..30 {
        exchange(&mut ferry, block, 0);
        card.step(BLOCK);
    }
    assert_eq!(ferry.status().state, State::Running);
}

#[test]
fn a_card_that_is_gone_is_lost_and_one_that_ran_out_of_samples_if_latency_matters() {
    let mut heard = [0.0; 2 * BLOCK];
    for strict in [false, true] {
        let (card, mut ferry) = Loop::with(strict);
        ferry.exchange(&drive(0), &mut heard).unwrap();
        card.events.xruns.fetch_add(1, Ordering::Relaxed);
        let result = ferry.exchange(&drive(1), &mut heard);
        assert_eq!((result.is_err(), ferry.status().lost), (strict, 1));
        if let Err(error) = result {
            assert!(error.to_string().contains("open it again"), "{error}");
        }
    }
    let (card, mut ferry) = Loop::with(true);
    card.events.lose("unplugged".into());
    card.events.lose("something later".into());
    assert_eq!(ferry.status().state, State::Lost("unplugged".into()));
    let error = ferry.exchange(&drive(0), &mut heard).unwrap_err();
    assert_eq!(error.to_string(), "device `loop` is lost: unplugged");
}

#[test]
fn numbers_of_frames_go_round() {
    // At 48 kHz that takes 25 hours.
    let (mut card, mut ferry) = Loop::with(true);
    card.player.begin_at(u32::MAX - 500);
    card.recorder.begin_at(u32::MAX - 500);
    for block in 0..40 {
        exchange(&mut ferry, block, 0);
        card.step(BLOCK);
    }
    assert_eq!(ferry.status().lost, 0);
}
