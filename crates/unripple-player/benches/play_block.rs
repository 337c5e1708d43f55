//! Processor time of a block, beside zita-convolver: `cargo bench -p unripple-player`.
//!
//! Times are those of the thread, so that what else the machine does counts only by what it takes from the caches.

use rustix::time::{ClockId, clock_gettime};
use std::path::{Path, PathBuf};
use std::process::Command as Run;
use std::sync::Arc;
use unripple_player::{
    At, Command, Convolver, Limit, Options, PreparedDrive, Running, Voice, WaveOptions, player,
};

const BLOCK: usize = 64;
const RATE: f64 = 48e3;
const TAPS: usize = 1440;

/// Blocks of waveforms that are timed, and of pulses: ten minutes of played time.
const BLOCKS: usize = 20_000;
const PULSES: usize = 450_000;

/// Ends here if the input is not what it must be.
type Outcome = Result<(), Box<dyn std::error::Error>>;

fn main() -> Outcome {
    let period = BLOCK as f64 / RATE * 1e6;
    println!(
        "\nplay_block: blocks of {BLOCK} at 48 kHz, thread time in µs; half the period is {:.0}",
        period / 2.0
    );
    println!("  load before {}", load());
    heading();
    pulses()?;
    starts(8)?;
    starts(64)?;
    println!(
        "\nwaveforms through the whole player, responses of {TAPS} samples, limits on peak, rms and heat"
    );
    heading();
    waveforms(10, 64)?;
    waveforms(5, 32)?;
    println!("\nthe convolver alone, beside zita-convolver in the same run: at most half is asked");
    heading();
    for [inputs, outputs] in [[10, 64], [5, 32], [1, 32]] {
        beside_zita(inputs, outputs)?;
    }
    println!("  load after {}", load());
    Ok(())
}

fn heading() {
    println!("  {:<46} {:>8} {:>8} {:>8} {:>8}", "", "p50", "p99", "p99.9", "worst");
}

/// Prints a row of times in seconds; their median.
fn row(name: &str, seconds: &mut [f64]) -> f64 {
    seconds.sort_by(f64::total_cmp);
    let at = |share: f64| seconds[((seconds.len() - 1) as f64 * share).round() as usize] * 1e6;
    let [p50, p99, p999, worst] = [0.5, 0.99, 0.999, 1.0].map(at);
    println!("  {name:<46} {p50:>8.1} {p99:>8.1} {p999:>8.1} {worst:>8.1}");
    p50 * 1e-6
}

fn load() -> String {
    let read = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    read.split(' ').next().unwrap_or("unknown").to_owned()
}

/// Processor seconds of this thread.
fn now() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

fn timed(work: impl FnOnce()) -> f64 {
    let start = now();
    work();
    now() - start
}

struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1u64 << 23) as f32 - 1.0
    }

    fn many(&mut self, count: usize) -> Vec<f32> {
        (0..count).map(|_| self.next()).collect()
    }
}

fn limits() -> Vec<Limit> {
    let running = |level, seconds| Some(Running { level, seconds });
    vec![Limit { peak: 1.0, rms: running(0.5, 0.05), thermal: running(0.4, 10.0) }]
}

/// Eight actuators, ten fingers, each a new drive of 30 ms every 100 to 200 ms, for ten minutes of played time.
fn pulses() -> Outcome {
    let (mut player, mut desk) = player(&Options { limits: limits(), ..Options::default() })?;
    let mut noise = Noise(7);
    let drives: Vec<Arc<PreparedDrive>> = (0..40)
        .map(|_| {
            let data = noise.many(8 * (TAPS + 1)).iter().map(|x| 0.4 * x).collect();
            PreparedDrive::new(8, data).map(Arc::new)
        })
        .collect::<Result<_, _>>()?;
    let mut out = vec![0.0; 8 * BLOCK];
    let mut next = [0u64; 10];
    let mut seconds = Vec::with_capacity(PULSES);
    for block in 0..PULSES as u64 {
        for (finger, next) in next.iter_mut().enumerate().filter(|(_, next)| **next <= block) {
            let pause = 75.0 * (1.5 + 0.5 * noise.next());
            *next = block + pause as u64;
            let drive = drives[(block as usize + 7 * finger) % 40].clone();
            let voice = Voice(finger as u64);
            let _ = desk.send(Command::Start { voice, drive, at: At::Now, gain: 1.0, period: None });
        }
        while desk.report().is_some() {}
        seconds.push(timed(|| player.process(&mut out)));
    }
    row("8 actuators, 10 fingers of pulses, 10 minutes", &mut seconds);
    Ok(())
}

/// As many drives of 30 ms as a block may judge, all started in one block; those blocks alone are timed.
fn starts(outputs: usize) -> Outcome {
    let options = Options { outputs, limits: limits(), ..Options::default() };
    let (mut player, mut desk) = player(&options)?;
    let mut noise = Noise(7);
    let data = noise.many(outputs * (TAPS + 1)).iter().map(|x| 0.1 * x).collect();
    let drive = Arc::new(PreparedDrive::new(outputs, data)?);
    let many = options.work / (outputs * (TAPS + 1));
    let mut out = vec![0.0; outputs * BLOCK];
    let mut seconds = Vec::new();
    for block in 0..BLOCKS {
        if block % 40 == 0 {
            for voice in 0..many as u64 {
                let (voice, drive) = (Voice(voice), drive.clone());
                let _ = desk.send(Command::Start { voice, drive, at: At::Now, gain: 1.0, period: None });
            }
        }
        while desk.report().is_some() {}
        let time = timed(|| player.process(&mut out));
        if block % 40 == 0 {
            seconds.push(time);
        }
    }
    row(&format!("{outputs} actuators, {many} starts in one block"), &mut seconds);
    Ok(())
}

/// Fingers of continuous waveforms, each with new responses ten times a second.
fn waveforms(inputs: usize, outputs: usize) -> Outcome {
    let waves = WaveOptions { inputs, taps: TAPS, ..WaveOptions::default() };
    let options = Options { outputs, limits: limits(), waves: Some(waves), ..Options::default() };
    let (mut player, mut desk) = player(&options)?;
    let mut noise = Noise(3);
    let mut responses =
        || (0..outputs).map(|_| noise.many(TAPS).iter().map(|x| 2e-3 * x).collect()).collect::<Vec<_>>();
    let filters = (0..3 * inputs).map(|_| desk.filters(&responses())).collect::<Result<Vec<_>, _>>()?;
    let mut out = vec![0.0; outputs * BLOCK];
    let mut seconds = Vec::with_capacity(BLOCKS);
    let mut noise = Noise(5);
    for block in 0..BLOCKS {
        for input in 0..inputs {
            if (block + 7 * input) % 75 == 0 {
                let filters = filters[(3 * input + block / 75 % 3) % filters.len()].clone();
                let _ = desk.send(Command::SetFilters { input, filters, at: At::Now, fade: 128 });
            }
            desk.feed(input, &noise.many(BLOCK));
        }
        while desk.report().is_some() {}
        let time = timed(|| player.process(&mut out));
        if block >= 100 {
            seconds.push(time);
        }
    }
    row(&format!("{inputs} inputs x {outputs} outputs"), &mut seconds);
    Ok(())
}

fn beside_zita(inputs: usize, outputs: usize) -> Outcome {
    let mut convolver = Convolver::new([inputs, outputs], BLOCK, RATE, TAPS, 3e3)?;
    let mut noise = Noise(3);
    for input in 0..inputs {
        let responses: Vec<Vec<f32>> = (0..outputs).map(|_| noise.many(TAPS)).collect();
        convolver.turn(input, Arc::new(convolver.plan().prepare(&responses)?), 1);
    }
    let mut out = vec![0.0; outputs * BLOCK];
    let mut seconds = Vec::with_capacity(BLOCKS);
    for block in 0..BLOCKS {
        let input = noise.many(inputs * BLOCK);
        let time = timed(|| convolver.process(&input, &mut out));
        if block >= 100 {
            seconds.push(time);
        }
    }
    let name = format!("{inputs} x {outputs}");
    let ours = row(&format!("{name}, ours"), &mut seconds);
    let (flops, bytes) = work(inputs, outputs, convolver.factor());
    println!(
        "    {:.2} Mflop, {:.2} MB of responses per block: {:.1} Gflop/s, {:.1} GB/s",
        flops / 1e6,
        bytes / 1e6,
        flops / ours / 1e9,
        bytes / ours / 1e9
    );
    for (largest, what) in [(BLOCK, "zita, one thread"), (1024, "zita, partitions up to 1024")] {
        match zita(inputs, outputs, largest) {
            Ok((mut theirs, all)) => {
                let worst = seconds[seconds.len() - 1];
                let median = row(&format!("{name}, {what}"), &mut theirs);
                let other = if largest > BLOCK { all } else { median };
                let mean = seconds.iter().sum::<f64>() / seconds.len() as f64;
                let mine = if largest > BLOCK { mean } else { ours };
                println!(
                    "    all its threads, mean: {:.1}; ours over that {:.2} (worst over worst {:.2})",
                    all * 1e6,
                    mine / other,
                    worst / theirs[theirs.len() - 1]
                );
            }
            Err(why) => println!("  {name}, {what}: skipped: {why}"),
        }
    }
    Ok(())
}

/// Floating-point operations of products and changes of rate, and bytes of spectra of responses read, per block.
fn work(inputs: usize, outputs: usize, factor: usize) -> (f64, f64) {
    let low = BLOCK / factor;
    let reach = 56;
    let partitions = (TAPS + reach).div_ceil(factor).div_ceil(low);
    let products = (inputs * outputs * partitions * low) as f64;
    let rates = (inputs * low * reach + outputs * BLOCK * reach / factor) as f64;
    let transform = 2.5 * (2 * low) as f64 * (2.0 * low as f64).log2();
    (8.0 * products + 2.0 * rates + transform * (inputs + outputs) as f64, 8.0 * products)
}

/// Runs the peer: seconds of each block, and of all threads per block on average.
fn zita(inputs: usize, outputs: usize, largest: usize) -> Result<(Vec<f64>, f64), String> {
    let program = peer()?;
    let blocks = BLOCKS / 4;
    let arguments = [inputs, outputs, TAPS, BLOCK, largest, blocks].map(|x| x.to_string());
    let output = Run::new(program).args(arguments).output().map_err(|error| error.to_string())?;
    if !output.status.success() {
        return Err(format!("zita-convolver refused: {}", output.status));
    }
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let numbers = |name: &str| -> Vec<f64> {
        let line = text.lines().find_map(|line| line.strip_prefix(name)).unwrap_or_default();
        line.split_whitespace().filter_map(|word| word.parse().ok()).collect()
    };
    match (numbers("seconds "), numbers("all ").first()) {
        (seconds, Some(&all)) if !seconds.is_empty() => Ok((seconds, all)),
        _ => Err("zita-convolver printed no times".into()),
    }
}

/// The peer's program, compiled into the target folder.
fn peer() -> Result<PathBuf, String> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers/zita.cpp");
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("zita");
    let mut compiler = Run::new("g++");
    compiler
        .args(["-O3", "-march=native", "-o"])
        .arg(&program)
        .arg(source)
        .args(["-lzita-convolver", "-lpthread"]);
    let output = compiler.output().map_err(|error| format!("g++: {error}"))?;
    if output.status.success() {
        return Ok(program);
    }
    let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
    Err(format!("g++ with zita-convolver.h: {}", complaint.lines().next().unwrap_or("failed")))
}
