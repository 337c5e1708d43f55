//! What holds for every membrane and every target.

use crate::common;

use common::{Membrane, velocity};
use proptest::prelude::*;
use unripple_core::{Drive, Point};
use unripple_focus::{Method, Options, Target, focus};

fn scenes() -> impl Strategy<Value = (Membrane, Vec<Target>)> {
    let place = || (0.1..0.9, 0.1..0.9);
    let ports = prop::collection::vec(place(), 1..5);
    let targets = prop::collection::vec((place(), 0.2..2.0, any::<bool>()), 1..4);
    (0.06..0.12, 0.06..0.12, 50.0..400.0, 5e-3..0.2, ports, targets).prop_map(
        |(width, height, tension, decay_time, ports, targets)| {
            let place = |(x, y): (f64, f64)| Point::new(x * width, y * height);
            let ports = ports.into_iter().map(place).collect();
            let target = |(at, gain, flip): ((f64, f64), f64, bool)| {
                Target::at(place(at)).with_gain(if flip { -gain } else { gain })
            };
            let targets = targets.into_iter().map(target).collect();
            let membrane =
                Membrane { width, height, tension, decay_time, ports, top_hz: 1200.0, ..Membrane::small() };
            (membrane, targets)
        },
    )
}

fn options() -> Options {
    Options { window: 0.008, accuracy: 1e-10, ..Options::default() }
}

fn values(drive: &Drive) -> impl Iterator<Item = f64> + '_ {
    drive.channels().iter().flatten().copied()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, ..ProptestConfig::default() })]

    #[test]
    fn every_drive_just_keeps_the_limit((membrane, targets) in scenes(), limit in 1e-3..1e3) {
        for method in Method::ALL {
            let drive = focus(&membrane.responses(), &targets, &Options { method, limit, ..options() }).unwrap().drive;
            prop_assert_eq!(drive.peak(), limit);
            if method == Method::OneBit {
                prop_assert!(values(&drive).all(|d| d == 0.0 || d.abs() == limit));
            }
        }
    }

    #[test]
    fn common_gains_and_the_order_of_targets_do_not_matter((membrane, targets) in scenes(), factor in 0.01..100.0) {
        let louder: Vec<Target> =
            targets.iter().rev().map(|t| t.clone().with_gain(factor * t.gain)).collect();
        let drives = [&targets, &louder].map(|t| focus(&membrane.responses(), t, &options()).unwrap().drive);
        for (a, b) in values(&drives[0]).zip(values(&drives[1])) {
            prop_assert!((a - b).abs() < 1e-9);
        }
    }

    #[test]
    fn targets_superpose((membrane, targets) in scenes()) {
        let modal = membrane.modal();
        let alone = targets.iter().map(|t| {
            let drive = focus(&membrane.responses(), std::slice::from_ref(t), &options()).unwrap().drive;
            // Scaled to the limit when alone: undone through the target's own level.
            let energy: f64 = common::responses_at(&modal, t.points[0], 97).concat().iter().map(|h| h * h).sum();
            let level = velocity(&modal, &drive, t.points[0], 96);
            drive.scaled(energy * t.gain / level)
        });
        let alone: Vec<Drive> = alone.collect();
        let together = focus(&membrane.responses(), &targets, &options()).unwrap().drive;
        let sum: Vec<f64> = (0..values(&together).count())
            .map(|i| alone.iter().map(|d| d.channels()[i / 97][i % 97]).sum())
            .collect();
        let peak = sum.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
        for (found, sum) in values(&together).zip(&sum) {
            prop_assert!((found - sum / peak).abs() < 1e-6, "{found} {}", sum / peak);
        }
    }

    #[test]
    fn time_reversal_is_the_matched_filter((membrane, targets) in scenes(), seed in prop::collection::vec(-1.0..1.0, 97)) {
        let modal = membrane.modal();
        let at = targets[0].points[0];
        let drive = focus(&membrane.responses(), &[Target::at(at)], &options()).unwrap().drive;
        let level = |d: &Drive| velocity(&modal, d, at, 96).abs() / d.energy().sqrt();
        let nudged = drive.channels().iter().map(|c| c.iter().zip(&seed).map(|(d, s)| d + 0.2 * s).collect());
        let nudged = Drive::new(drive.rate(), drive.names().to_vec(), nudged.collect()).unwrap();
        prop_assert!(level(&nudged) <= level(&drive) * (1.0 + 1e-9));
        let hard = focus(&membrane.responses(), &[Target::at(at)], &Options { method: Method::OneBit, ..options() });
        prop_assert!(level(&hard.unwrap().drive) <= level(&drive) * (1.0 + 1e-9));
    }

    #[test]
    fn repeated_drives_focus_in_their_last_period((membrane, targets) in scenes(), hz in 20.0..400.0) {
        let repeated: Vec<Target> = targets.iter().map(|t| t.clone().repeated(hz)).collect();
        let focused = focus(&membrane.responses(), &repeated, &options()).unwrap();
        let period = focused.period.unwrap();
        let length = focused.drive.samples();
        prop_assert!(length - period >= 96 + (6.9 * membrane.decay_time * membrane.rate) as usize);
        for timing in &focused.timing {
            prop_assert!(timing.instant < length && timing.instant + period >= length);
            prop_assert_eq!((timing.instant - 96) % period, 0);
        }
        for channel in focused.drive.channels() {
            for i in 96..length - period {
                prop_assert!((channel[i] - channel[i + period]).abs() < 1e-9);
            }
        }
    }
}
