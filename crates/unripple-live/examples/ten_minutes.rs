//! Ten fingers tapping and sliding on the paper's film for ten minutes of played time: `cargo run --release -p unripple-live
//! --example ten_minutes -- [MINUTES]`. An allocation by the player ends the program.

use assert_no_alloc::AllocDisabler;
use std::sync::Arc;
use std::time::Instant;
use unripple_devices::{Virtual, VirtualOptions};
use unripple_effects::{Curve, Effect, EffectSet, Hum, Kind, Level, Region, Texture, Tone};
use unripple_live::{Engine, FocusWorker, LiveOptions, Percentiles, Window};
use unripple_physics::design::papers_surface;
use unripple_physics::{ResponseOptions, responses};
use unripple_player::Count;
use unripple_touch::{Sources, Synthetic, SyntheticOptions};

#[global_allocator]
static ALLOCATOR: AllocDisabler = AllocDisabler;

const BLOCK: usize = 64;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let minutes: f64 = std::env::args().nth(1).map_or(Ok(10.0), |m| m.parse())?;
    let film = papers_surface();
    let window = Window::prompt(&film);
    let known = Arc::new(responses(&film, &ResponseOptions::default())?);
    let device = Virtual::new(&film, &VirtualOptions { block: BLOCK, ..VirtualOptions::default() })?;
    let mut sources = Sources::new(&film.outline);
    let ten = SyntheticOptions { fingers: 10, ..SyntheticOptions::default() };
    sources.push(Box::new(Synthetic::new(&film.outline, ten)?));
    let options = LiveOptions::new(&film, window.seconds);
    let maker = FocusWorker::new(known, &options.focus)?;
    let mut engine = Engine::new(&film, maker, &effects(), sources, Box::new(device), &options)?;
    println!("{window}");

    let began = Instant::now();
    while engine.stage().time() < 60.0 * minutes {
        engine.step()?;
    }
    let (taken, played) = (began.elapsed().as_secs_f64(), engine.stage().time());
    println!("{played:.0} s played in {taken:.0} s, {:.1} times as fast", played / taken);
    let period = BLOCK as f64 / film.emission.rate;
    println!("{:<28}{:>9}{:>9}{:>9}{:>9}", "ms", "p50", "p99", "p99.9", "worst");
    let row = |name: &str, times: &Percentiles| {
        let ms = times.four().unwrap_or_default().map(|s| format!("{:>9.4}", 1e3 * s));
        println!("{name:<28}{}", ms.concat());
    };
    row("a block, processor time", engine.heart().work());
    row("a drive for a new place", engine.stage().conductor().drives().making());
    row("all touches of a moment", engine.stage().computing());
    row("touch to first sample", &engine.stage().conductor().tally().first_sample);
    row("touch to focus", &engine.stage().conductor().tally().focus);
    println!("period {:.4} ms, half of it {:.4}", 1e3 * period, 500.0 * period);
    let stage = engine.stage();
    let (tally, meters) = (stage.conductor().tally(), stage.conductor().desk().meters());
    println!(
        "{} cues, {} started, {} limited, {} failed, {} late, {} put off, {} refused, {} lost",
        tally.cues,
        tally.started,
        tally.limited,
        tally.failed,
        tally.late,
        meters.count(Count::PutOff),
        tally.refused,
        tally.lost
    );
    Ok(())
}

/// Grains along every path, and a hum under every finger.
fn effects() -> EffectSet {
    let effect =
        |name: &str, level, kind| Effect { name: name.into(), region: Region::Everywhere, level, kind };
    let texture = Texture { pitch: 2e-3, grain: 0.5, seed: 1, speed_gain: Curve::constant(1.0) };
    let hum = Hum { tone: Tone::Sine(200.0), speed_gain: Curve::constant(1.0), fade: 0.02 };
    EffectSet {
        name: "grains and hum".into(),
        about: String::new(),
        effects: vec![
            effect("grains", Level::Share(0.1), Kind::Texture(texture)),
            effect("hum", Level::Share(0.02), Kind::Hum(hum)),
        ],
    }
}
