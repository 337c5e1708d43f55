//! Random commands on random surfaces end by themselves, with what they found or with an error: no panic, no abort, no hang.
//!
//! UNRIPPLE_COMMANDS says how many, UNRIPPLE_SEED which. Each runs within limits of memory and of processor time, so that an allocation
//! without bound is an abort here too, and a loop without end is ended.
#![cfg(unix)]

mod kinds;

use crate::any_file::{chance, file, pick};
use crate::common::{Scratch, program, schema};
use kinds::Value::{self, Area, Nothing, Number, One, Path, Place, Shape, Target, Waveform, Whole};
use kinds::{FIRST, KINDS, Kind};
use std::collections::BTreeMap;
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Output};
use unripple::core::Random;
use unripple_store::load_surface;

/// Commands where nothing else is said, so that a test run has some of most kinds; ./soak takes 10000.
const FEW: u64 = 24;

/// Commands in a folder, which find there what those before them wrote.
const IN_A_ROW: u64 = 8;

/// Modes in the band of a surface are fewer than this, so that a command takes less than a second and odd values are what is tried.
const FEW_MODES: f64 = 40.0;

/// Address space of a command, in KiB: 6 GiB, of which ordinary ones take a tenth.
const MEMORY_KIB: u64 = 6 << 20;

/// Processor time of a command, in s: ten times what the longest ordinary one takes with overflow checks.
const SECONDS: u64 = 240;

/// Numbers that somebody may type by mistake, or to see what happens.
const ODD: [&str; 14] = [
    "0",
    "-1",
    "nan",
    "inf",
    "-inf",
    "1e-9",
    "1e-300",
    "1e9",
    "1e18",
    "1e300",
    "-0.0",
    "",
    "x",
    "18446744073709551615",
];

/// How often a value is one of [`ODD`]: often enough that most rows of commands have one, seldom enough that most commands work.
const ODDLY: f64 = 0.06;

/// Random words for a surface of some extent, in mm.
struct Words<'a> {
    random: &'a mut Random,
    extent: [f64; 2],
}

impl Words<'_> {
    fn is(&mut self, share: f64) -> bool {
        chance(self.random, share)
    }

    fn number(&mut self, low: f64, high: f64) -> String {
        match self.is(ODDLY) {
            true => pick(self.random, &ODD).to_owned(),
            false => self.random.decades(low, high).to_string(),
        }
    }

    fn whole(&mut self, low: u64, high: u64) -> String {
        match self.is(ODDLY) {
            true => pick(self.random, &ODD).to_owned(),
            false => (self.random.between(low as f64, high as f64 + 1.0) as u64).min(high).to_string(),
        }
    }

    /// A place around the middle of the surface, now and then beside it.
    fn place(&mut self) -> String {
        let reach = if self.is(0.1) { [-0.2, 1.2] } else { [0.35, 0.65] };
        let [x, y] = self.extent.map(|length| (length * reach[0], length * reach[1]));
        match self.is(ODDLY) {
            true => format!("{},{}", pick(self.random, &ODD), y.0),
            false => format!("{},{}", self.random.between(x.0, x.1), self.random.between(y.0, y.1)),
        }
    }

    /// The text behind an option; none for a flag.
    fn value(&mut self, kind: Value) -> Option<String> {
        let size = self.extent[0].min(self.extent[1]);
        Some(match kind {
            Nothing => return None,
            Number(low, high) => self.number(low, high),
            Whole(low, high) => self.whole(low, high),
            Place => self.place(),
            Area => format!("{},{},{}", self.place(), self.place(), self.place()),
            Target => format!("{},{},{}", self.place(), self.number(0.1, 3.0), self.number(1.0, 100.0)),
            Waveform => {
                let what = match pick(self.random, &[0, 1, 2, 3]) {
                    0 => format!("sine:{},{}", self.number(20.0, 2000.0), self.number(1.0, 200.0)),
                    1 => format!("burst:{},{}", self.number(20.0, 2000.0), self.number(1.0, 20.0)),
                    2 => format!("click:{}", self.number(1.0, 20.0)),
                    _ => "out/drive.wav".to_owned(),
                };
                format!("{},{what},{}", self.place(), self.number(0.1, 100.0))
            }
            Path if self.is(0.7) => format!("line:{},{}", self.place(), self.place()),
            Path | Shape if self.is(0.5) => {
                format!("circle:{},{}", self.place(), self.number(0.05 * size, 0.3 * size))
            }
            Path | Shape => format!("triangle:{},{}", self.place(), self.number(0.05 * size, 0.3 * size)),
            One(of) => pick(self.random, of).to_owned(),
        })
    }

    /// The arguments of a command.
    fn command(&mut self, kind: &Kind) -> Vec<String> {
        let mut words: Vec<String> = kind.words.split(' ').map(str::to_owned).collect();
        let share = 1.5 / kind.perhaps.len() as f64;
        let given: Vec<_> = kind.perhaps.iter().filter(|_| self.is(share)).collect();
        for (option, kind) in kind.always.iter().chain(given) {
            match self.value(*kind) {
                // With a sign of equality a negative number is no option.
                Some(value) if option.starts_with("--") => words.push(format!("{option}={value}")),
                Some(value) => words.extend([(*option).to_owned(), value]),
                None => words.push((*option).to_owned()),
            }
        }
        if self.is(0.3) {
            words.push("--json".into());
        }
        words
    }
}

/// A surface in a folder, most often one that `check` passes, and the extent of its outline in mm.
fn surface(folder: &Scratch, random: &mut Random) -> (String, [f64; 2]) {
    for _ in 0..8 {
        let text = file(random, |random| random.decades(4.0, FEW_MODES));
        let path = folder.file("surface.toml", &text);
        if let Ok(surface) = load_surface(&path) {
            let (width, height) = surface.outline.extent();
            return (text, [width * 1e3, height * 1e3]);
        }
    }
    (std::fs::read_to_string(folder.join("surface.toml")).unwrap(), [100.0; 2])
}

/// Runs a command in a folder, within the limits.
fn run(folder: &Scratch, arguments: &[String]) -> Output {
    let limits = format!("ulimit -v {MEMORY_KIB}; ulimit -t {SECONDS}; exec \"$@\"");
    let own = program();
    let mut shell = Command::new("sh");
    shell.args(["-c", &limits, "sh"]).arg(own.get_program()).args(arguments);
    // Each thread reserves address space of its own.
    shell
        .env("UNRIPPLE_CONFIG", "")
        .env("UNRIPPLE_CACHE", "")
        .env("RAYON_NUM_THREADS", "2")
        .current_dir(folder.path());
    shell.output().unwrap()
}

/// What is wrong with how a command ended, if anything is.
fn fault(arguments: &[String], output: &Output) -> Option<String> {
    let errors = String::from_utf8_lossy(&output.stderr);
    let told = String::from_utf8_lossy(&output.stdout);
    if let Some(signal) = output.status.signal() {
        return Some(format!("ended by signal {signal}: {errors}"));
    }
    let code = output.status.code().unwrap_or(-1);
    if !(0..=2).contains(&code) || errors.contains("panicked") {
        return Some(format!("exit {code}: {errors}"));
    }
    if code == 2 && errors.trim().is_empty() {
        return Some("refused without a word".into());
    }
    let json = arguments.iter().any(|argument| argument == "--json");
    if json && !told.is_empty() {
        let Ok(report) = serde_json::from_str(&told) else { return Some(format!("no JSON: {told}")) };
        let faults = schema::faults(&report);
        if !faults.is_empty() {
            return Some(format!("not as report-1.json describes: {}", faults.join("; ")));
        }
    }
    let none = |word: &str| {
        ["NaN", "inf", "-inf"].contains(&word.trim_matches(|c: char| !c.is_alphanumeric() && c != '-'))
    };
    let odd = told.split_whitespace().find(|word| none(word))?;
    Some(format!("{odd} in what was told: {told}"))
}

#[test]
fn commands_end_by_themselves() {
    let set =
        |name: &str, usual: u64| std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(usual);
    let (count, seed) = (set("UNRIPPLE_COMMANDS", FEW), set("UNRIPPLE_SEED", 1));
    let mut ends: BTreeMap<String, [u64; 3]> = BTreeMap::new();
    let mut faults = Vec::new();
    for row in 0..count.div_ceil(IN_A_ROW) {
        let mut random = Random::seeded(seed * 1_000_003 + row);
        let folder = Scratch::new("any-command");
        let (text, extent) = surface(&folder, &mut random);
        for place in 0..IN_A_ROW as usize {
            // What others read comes first: a drive and a library.
            let kind = FIRST.get(place).map_or_else(|| pick(&mut random, KINDS), |index| KINDS[*index]);
            let arguments = Words { random: &mut random, extent }.command(&kind);
            let output = run(&folder, &arguments);
            if let Some(fault) = fault(&arguments, &output) {
                println!("row {row} of seed {seed}: unripple {}\n{fault}\n{text}\n", arguments.join(" "));
                faults.push(format!(
                    "row {row}: unripple {}: {}",
                    arguments.join(" "),
                    fault.lines().next().unwrap_or("")
                ));
            } else if let Some(code) = output.status.code() {
                ends.entry(arguments[0].clone()).or_default()[code as usize] += 1;
            }
        }
    }
    println!("{count} commands of seed {seed}; those that ended with 0, 1 and 2: {ends:?}");
    assert!(faults.is_empty(), "{} of {count}: {faults:#?}", faults.len());
    let done: u64 = ends.values().map(|ends| ends[0]).sum();
    assert!(done * 4 > count, "most were refused, so that little was tried: {ends:?}");
}
