//! Tests with a card whose two sides have different clocks, which start late, run apart, stop, never start,
//! and use chunks of odd sizes.

use super::ferry::Ferry;
use super::stand_in::{BLOCK, Clock, Held, RATE};
use unripple_core::{Device, DeviceError, State};

/// A sample that no other is like; floats hold whole numbers up to 2^24.
fn sample(output: usize, i: usize) -> f32 {
    (1 + i % (1 << 24)) as f32 * if output == 0 { 1.0 } else { -1.0 }
}

/// Exchanges blocks from one to before another; by how many samples inputs came later than their drive, where all of
/// a block's samples came so, and in how many blocks they did not.
fn exchange(ferry: &mut Ferry, blocks: std::ops::Range<usize>) -> Result<(Vec<i64>, usize), DeviceError> {
    let (mut late, mut broken, mut heard) = (Vec::new(), 0, [7.0f32; 2 * BLOCK]);
    for block in blocks {
        let drive: Vec<f32> =
            (0..2).flat_map(|output| (0..BLOCK).map(move |i| sample(output, block * BLOCK + i))).collect();
        ferry.exchange(&drive, &mut heard)?;
        let of = |n: usize| (block * BLOCK) as i64 + n as i64 + 1 - heard[n] as i64;
        let whole = (0..BLOCK).all(|n| heard[n] > 0.0 && heard[BLOCK + n] == -heard[n] && of(n) == of(0));
        if whole { late.push(of(0)) } else { broken += 1 }
    }
    Ok((late, broken))
}

/// Whether everything that was driven was played, nothing between, from some frame on.
fn unbroken(card: &Held, from: usize) -> bool {
    let card = card.0.lock().unwrap();
    let first = (from..card.played.len()).find(|i| card.played[*i][0] != 0.0).unwrap();
    // What is in the card's own buffer may not be driven yet.
    let last = card.played.iter().rposition(|frame| frame[0] != 0.0).unwrap();
    card.played[first..=last].windows(2).all(|pair| pair[1][0] == pair[0][0] + 1.0)
}

/// Sizes of chunks, in turn, that sound systems hand over: even, uneven, and larger than a block.
const CHUNKS: [&[usize]; 5] = [&[64], &[32], &[48, 1, 90, 17], &[300], &[147, 148]];

#[test]
fn chunks_of_any_size_change_nothing() {
    for plays in CHUNKS {
        for records in CHUNKS {
            let (card, mut ferry) = Held::open(Clock::nominal(plays), Clock::nominal(records), true, None);
            exchange(&mut ferry, 0..40).unwrap();
            let (late, broken) = exchange(&mut ferry, 40..1000).unwrap();
            assert_eq!(broken, 0, "{plays:?} {records:?}");
            assert!(late.iter().all(|x| *x == late[0]), "{plays:?} {records:?}: {late:?}");
            assert!(unbroken(&card, 0), "{plays:?} {records:?}");
            assert_eq!((ferry.status().lost, ferry.status().state), (0, State::Running));
        }
    }
}

#[test]
fn drive_waits_as_long_as_the_card_says() {
    for chunks in [&[64][..], &[32], &[300], &[1024]] {
        let clock = || Clock::nominal(chunks);
        let (card, mut ferry) = Held::open(clock(), clock(), true, None);
        let mut told = Vec::new();
        for block in 0..400 {
            exchange(&mut ferry, block..block + 1).unwrap();
            told.push((card.0.lock().unwrap().now, ferry.status().waiting as f64));
        }
        exchange(&mut ferry, 400..500).unwrap();
        let card = card.0.lock().unwrap();
        for (block, (now, waiting)) in told.into_iter().enumerate().skip(200) {
            // When the first sample of the next block passes the converter, in frames since the card was opened.
            let first = sample(0, (block + 1) * BLOCK);
            let left = card.played.iter().position(|frame| frame[0] == first).unwrap() as f64;
            // Blocks come back in bursts, a chunk's worth at a time, and what the card holds is one to two chunks.
            let (found, grain) = (left - now, (2 * clock().largest() + BLOCK) as f64);
            assert!((waiting - found).abs() <= grain, "{chunks:?}: says {waiting}, waits {found}");
        }
    }
}

#[test]
fn a_card_of_larger_periods_than_blocks_needs_more_lead() {
    let clock = || Clock::nominal(&[300]);
    let (card, mut ferry) = Held::open(clock(), clock(), true, Some(4));
    exchange(&mut ferry, 0..1000).unwrap();
    assert!(!unbroken(&card, 0) && ferry.status().lost > 100);
}

#[test]
fn a_side_that_starts_late_is_waited_for() {
    // A fifth of a second, as a card on USB may need.
    for side in 0..2 {
        let mut clocks = [Clock::nominal(&[64]), Clock::nominal(&[64])];
        clocks[side].begins = 9600.0;
        let [plays, records] = clocks;
        let (card, mut ferry) = Held::open(plays, records, true, None);
        exchange(&mut ferry, 0..400).unwrap();
        let before = ferry.status().lost;
        let played = card.0.lock().unwrap().played.len();
        let (late, broken) = exchange(&mut ferry, 400..2000).unwrap();
        assert!(broken == 0 && late.iter().all(|x| *x == late[0]), "{side}: {broken} {late:?}");
        assert!(unbroken(&card, played), "{side}");
        assert_eq!(ferry.status().lost, before, "{side}");
    }
}

#[test]
fn two_clocks_are_called_so_and_do_not_hold_up_playing() {
    // 100 millionths, the one or the other faster: after 384 frames apart, three times both chunks, no buffer explains it.
    let apart = 384.0 / 100e-6;
    for ppm in [-100.0, 100.0, 3000.0] {
        let plays = Clock { pace: 1.0 + ppm * 1e-6, ..Clock::nominal(&[64]) };
        let open = |strict| Held::open(plays.clone(), Clock::nominal(&[64]), strict, None);
        let (card, mut ferry) = open(true);
        let blocks = (2.0 * apart) as usize / BLOCK;
        let error = exchange(&mut ferry, 0..blocks).unwrap_err();
        let (slow, fast) = if ppm > 0.0 { ("records", "plays") } else { ("plays", "records") };
        let wanted = format!("the side that {slow} fell");
        assert!(matches!(&error, DeviceError::Lost { why, .. } if why.starts_with(&wanted)), "{error}");
        assert!(error.to_string().contains(fast) && error.to_string().contains("two clocks"), "{error}");
        let after = card.0.lock().unwrap().now;
        let due = apart * 100.0 / f64::abs(ppm);
        assert!(after > 0.5 * due && after < 1.5 * due, "{ppm}: after {after} frames, {due} are due");

        let (card, mut ferry) = open(false);
        let (late, broken) = exchange(&mut ferry, 0..blocks).unwrap();
        assert!(unbroken(&card, 0), "{ppm}");
        assert!(late.iter().all(|x| (x - late[0]).abs() <= 512), "{ppm}: {late:?}");
        assert_eq!(ferry.status().state, State::Running);
        println!("{ppm} ppm: {broken} of {blocks} blocks broken, {} lost", ferry.status().lost);
        assert!(
            broken * 100 < blocks * 2.max(ppm.abs() as usize / 100) && ferry.status().lost > 0,
            "{ppm}: {broken} of {blocks}"
        );
    }
}

#[test]
fn sides_without_a_clock_never_stall() {
    // As ALSA's null device: each side as fast as its thread is.
    for pace in [0.01, 0.3, 0.9, 1.1, 3.0, 100.0] {
        let plays = Clock { pace, ..Clock::nominal(&[256]) };
        let open = |strict| Held::open(plays.clone(), Clock::nominal(&[256]), strict, Some(4));
        let error = exchange(&mut open(true).1, 0..100_000).unwrap_err();
        assert!(
            matches!(&error, DeviceError::Lost { why, .. } if why.contains("two clocks")),
            "{pace}: {error}"
        );
        let (_, mut ferry) = open(false);
        exchange(&mut ferry, 0..10_000).unwrap();
    }
}

#[test]
fn a_side_that_stops_for_a_while_is_noticed() {
    for side in 0..2 {
        let open = |strict| {
            let mut clocks = [Clock::nominal(&[64]), Clock::nominal(&[64])];
            clocks[side].stop = [100_000.0, 110_000.0];
            let [plays, records] = clocks;
            Held::open(plays, records, strict, None)
        };
        let error = exchange(&mut open(true).1, 0..3000).unwrap_err();
        let slow = ["the side that plays fell", "the side that records fell"][side];
        assert!(matches!(&error, DeviceError::Lost { why, .. } if why.starts_with(slow)), "{error}");
        let (card, mut ferry) = open(false);
        exchange(&mut ferry, 0..2000).unwrap();
        let (late, broken) = exchange(&mut ferry, 2000..4000).unwrap();
        assert!(broken == 0 && late.iter().all(|x| *x == late[0]), "{side}: {broken} {late:?}");
        assert!(unbroken(&card, 0), "{side}");
        let lost = ferry.status().lost;
        assert!(lost >= 100, "{side}: {lost}");
    }
}

#[test]
fn a_side_that_never_starts_is_named() {
    for (side, did) in ["played", "recorded"].into_iter().enumerate() {
        for strict in [true, false] {
            let mut clocks = [Clock::nominal(&[64]), Clock::nominal(&[64])];
            clocks[side].begins = f64::INFINITY;
            let [plays, records] = clocks;
            let (card, mut ferry) = Held::open(plays, records, strict, None);
            let error = exchange(&mut ferry, 0..100_000).unwrap_err();
            assert!(matches!(&error, DeviceError::Stalled { why, .. } if why.contains(did)), "{error}");
            assert!(matches!(ferry.status().state, State::Stalled(_)));
            let time = card.0.lock().unwrap().now / RATE;
            assert!((2.9..3.1).contains(&time), "{side} {strict}: after {time} s");
            // It is waited for as long the next time, not refused at once.
            exchange(&mut ferry, 0..100_000).unwrap_err();
            let time = card.0.lock().unwrap().now / RATE;
            assert!((5.9..6.1).contains(&time), "{side} {strict}: after {time} s");
        }
    }
}
