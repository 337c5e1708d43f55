//! No start, stop, change or limit makes a step that no drive has by itself.

use crate::common;

use common::{Rig, smooth};
use proptest::prelude::*;
use std::sync::Arc;
use unripple_player::{At, Clicks, Command, Limit, Options, PreparedDrive, Report, Running, Voice};

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, max_shrink_iters: 200, ..ProptestConfig::default() })]

    #[test]
    fn random_sessions_have_no_clicks(seed in 1u64..1 << 30, acts in prop::collection::vec((0u8..5, 0u64..6, 0u64..100, 0u64..64, 80usize..1200, prop_oneof![0u32..4, 0u32..400]), 1..60)) {
        let running = Some(Running { level: 0.3, seconds: 0.05 });
        let limits = vec![Limit { peak: 0.9, rms: running, thermal: None }];
        let mut rig = Rig::new(Options { outputs: 2, limits, longest: 1400, ..Options::default() });
        let mut clicks = Clicks::new(2, 64);
        // The drive of a voice is always the same, so that reports tell what sounds.
        let drives: Vec<Arc<PreparedDrive>> = (0..6).map(|voice| {
            let length = acts[voice % acts.len()].4;
            let drive = smooth(seed + voice as u64, 2, length, 0.8);
            let looped = || PreparedDrive::looped(2, [drive.channel(0), drive.channel(1)].concat(), 64);
            if voice % 3 == 0 { Arc::new(looped().unwrap()) } else { drive }
        }).collect();
        for block in 0..140u64 {
            for &(what, voice, _, offset, _, fade) in acts.iter().filter(|act| act.2 == block) {
                let (at, drive) = (At::Sample(block * 64 + offset), drives[voice as usize].clone());
                let voice = Voice(voice);
                if what == 3 {
                    rig.stop(voice, at, Some(fade));
                    continue;
                }
                rig.send(match what {
                    0 | 1 => Command::Start { voice, drive, at, gain: 0.9, period: None },
                    2 => Command::Start { voice, drive, at, gain: 1.0, period: Some(64.0 + f64::from(fade)) },
                    _ => Command::Gain { voice, at, gain: 0.1 + fade as f32 / 400.0 },
                });
            }
            let heard = rig.block();
            for report in rig.reports.drain(..) {
                if let Report::Started { voice, sample, gain } = report {
                    clicks.expect(&drives[voice.0 as usize], gain, sample);
                }
            }
            prop_assert_eq!(clicks.hear(block * 64, &heard), 0);
        }
    }
}
