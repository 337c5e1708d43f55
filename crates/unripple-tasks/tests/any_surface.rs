//! Whatever `check` passes, no other task refuses for the file's sake: random surfaces through `check`, `design`, `modes` and a focus.
//!
//! UNRIPPLE_SURFACES says how many, UNRIPPLE_SEED which, UNRIPPLE_FROM the first of them, for a run that goes on where another was stopped;
//! UNRIPPLE_FILES is a folder for their files, to look at one of them again. The three tasks share what they solve for by a cache. An error counts as a fault unless it is memory or an accuracy
//! that the message names, or a band without any mode, which `check` cannot know without solving for them. A focus ends with the WAV file
//! of its drive.

#[path = "any_surface/file.rs"]
mod file;

use file::{chance, file};
use std::collections::{BTreeMap, HashMap};
use std::ops::Range;
use std::panic::AssertUnwindSafe;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use unripple::act::{Act, Level, chosen_window, model};
use unripple::core::{Cache, Cached, Random, Surface};
use unripple::focus::{Options, Target};
use unripple_store::encode_wav;
use unripple_tasks::{Silent, SurfaceAsk, check, design, modes};

/// Surfaces where nothing else is said; ./soak takes 2000.
const FEW: u64 = 8;

/// One in three has more modes than this.
const MANY: f64 = 100.0;

/// What came of a surface.
#[derive(Debug)]
enum Outcome {
    /// `check` refused it.
    Refused,
    /// Everything was computed, on so many modes.
    Computed(usize),
    /// Memory or an accuracy stood in the way, and was named.
    Excused(String),
    /// No mode lies in the band, and `design` says so.
    Empty,
    /// Something passed `check` and was refused later, or is no number.
    Fault(String),
}

/// What was computed of one surface.
#[derive(Default)]
struct Kept(Mutex<HashMap<String, Vec<u8>>>);

impl Cache for Kept {
    fn read(&self, key: &str) -> Option<Vec<u8>> {
        self.0.lock().unwrap().get(key).cloned()
    }

    fn write(&self, key: &str, bytes: &[u8]) {
        self.0.lock().unwrap().insert(key.into(), bytes.into());
    }
}

/// Errors of memory and of accuracy name what was wanted and what there is.
fn excused(error: &str) -> bool {
    error.contains("GiB") || error.contains("expected an error of at most")
}

fn judged(text: &str) -> Outcome {
    let surface = SurfaceAsk::Text { toml: text.into(), name: None };
    match check::run(&check::Ask { surface: surface.clone() }, &mut Silent) {
        Ok(report) if !report.ok => return Outcome::Refused,
        Ok(_) => {}
        Err(error) => return Outcome::Fault(format!("check: {error}")),
    }
    let found =
        match modes::run(&modes::Ask { surface: surface.clone(), ..modes::Ask::default() }, &mut Silent) {
            Ok(found) => found,
            Err(error) if excused(&error.to_string()) => return Outcome::Excused(error.to_string()),
            Err(error) => return Outcome::Fault(format!("modes: {error}")),
        };
    if !found.frequencies_hz.iter().chain([&found.relative_error]).all(|x| x.is_finite()) {
        return Outcome::Fault("modes: expected numbers, found others".into());
    }
    if let Err(error) = design::run(&design::Ask { surface: surface.clone() }, &mut Silent) {
        if found.count == 0 && error.to_string().ends_with("expected at least 1, found 0") {
            return Outcome::Empty;
        }
        return Outcome::Fault(format!("design: {error}"));
    }
    match surface.load().map_err(|error| error.to_string()).and_then(|surface| focused(&surface)) {
        Ok(()) => Outcome::Computed(found.count),
        Err(error) if excused(&error) => Outcome::Excused(error),
        Err(error) => Outcome::Fault(format!("focus: {error}")),
    }
}

/// Focuses near the middle of the surface, judges that, and writes the drive.
fn focused(surface: &Surface) -> Result<(), String> {
    let responses = model(surface, None, &[]).map_err(|error| error.to_string())?;
    let (width, height) = surface.outline.extent();
    let at = surface.outline.nearest(unripple::core::Point::new(0.45 * width, 0.52 * height));
    let window = chosen_window(surface, &responses).seconds;
    let options = Options { window, limit: surface.emission.limit, ..Options::default() };
    let targets = [Target::at(at)];
    let act =
        Act { surface, responses: &responses, targets: &targets, options: &options, level: Level::Linear };
    let acted = act.run().map_err(|error| error.to_string())?;
    let peak = acted.judged.measured.targets[0].peak_velocity_m_s;
    if !peak.is_finite() {
        return Err(format!("expected a peak, found {peak}"));
    }
    // As `focus` writes it in the end.
    encode_wav(&acted.drive).map(drop).map_err(|error| error.to_string())
}

fn number(name: &str, usual: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(usual)
}

/// The surface of a number, and what came of it.
fn outcome(seed: u64, surface: u64) -> (String, Outcome) {
    let text = file(&mut Random::seeded(seed * 1_000_003 + surface), |random| match chance(random, 0.4) {
        true => random.decades(MANY, 260.0),
        false => random.decades(4.0, MANY),
    });
    if let Some(folder) = std::env::var_os("UNRIPPLE_FILES") {
        let path = std::path::Path::new(&folder).join(format!("{surface}.toml"));
        std::fs::write(path, &text).expect("a folder for the files of surfaces");
    }
    let cached = Cached::by(Some(Arc::new(Kept::default())));
    let outcome = std::panic::catch_unwind(AssertUnwindSafe(|| cached.during(|| judged(&text))));
    (text, outcome.unwrap_or_else(|_| Outcome::Fault("a panic".into())))
}

/// What came of the surfaces of these numbers, as many at a time as there are processors: much of the work on one uses a single processor.
fn outcomes(seed: u64, surfaces: Range<u64>) -> Vec<(u64, Outcome)> {
    let (next, found) = (AtomicU64::new(surfaces.start), Mutex::new(Vec::new()));
    let work = || {
        loop {
            let surface = next.fetch_add(1, Ordering::Relaxed);
            if surface >= surfaces.end {
                return;
            }
            let (text, outcome) = outcome(seed, surface);
            match &outcome {
                Outcome::Fault(why) => println!("surface {surface} of seed {seed}: {why}\n{text}\n"),
                Outcome::Excused(why) => println!("surface {surface} of seed {seed}: {why}"),
                outcome => println!("surface {surface} of seed {seed}: {outcome:?}"),
            }
            found.lock().unwrap().push((surface, outcome));
        }
    };
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| (0..processors).for_each(|_| drop(scope.spawn(work))));
    found.into_inner().unwrap()
}

#[test]
fn what_check_passes_is_computed() {
    let (count, seed) = (number("UNRIPPLE_SURFACES", FEW), number("UNRIPPLE_SEED", 1));
    let from = number("UNRIPPLE_FROM", 0);
    let mut counts: BTreeMap<&str, u64> = BTreeMap::new();
    let (mut many, mut faults) = (0, Vec::new());
    for (surface, outcome) in outcomes(seed, from..from + count) {
        let kind = match outcome {
            Outcome::Refused => "refused by check",
            Outcome::Computed(modes) => {
                many += u64::from(modes as f64 > MANY);
                "computed"
            }
            Outcome::Excused(_) => "memory or accuracy",
            Outcome::Empty => "no mode in the band",
            Outcome::Fault(why) => {
                faults.push((surface, why));
                "fault"
            }
        };
        *counts.entry(kind).or_default() += 1;
    }
    println!("{count} surfaces of seed {seed}: {counts:?}, {many} with more than {MANY} modes");
    assert!(faults.is_empty(), "{faults:?}");
    assert!(counts.get("computed").is_some_and(|computed| computed * 3 > count), "{counts:?}");
}
