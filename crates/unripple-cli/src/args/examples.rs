//! Examples at the end of each command's help.

/// For `check`: a user's file, since built-in surfaces have no faults.
pub const CHECK: &str = "Examples:
  unripple check my-surface.toml";

/// For `materials`: all materials, and one whose name has a space.
pub const MATERIALS: &str = "Examples:
  unripple materials
  unripple materials 'soda-lime glass'";

/// For `design`: a built-in surface, and a change to it.
pub const DESIGN: &str = "Examples:
  unripple design hudin-2012
  unripple design hudin-2012 --set sheet.tension_n_per_m=300 --json";

/// For `modes`: a highest frequency and an accuracy.
pub const MODES: &str = "Examples:
  unripple modes hudin-2012
  unripple modes my-surface.toml --max-hz 1000 --accuracy 1e-4";

/// For `respond`: a library of a built-in surface.
pub const RESPOND: &str = "Examples:
  unripple respond hudin-2012 --grid-mm 5 -o film.zarr";

/// For `focus`: a line for each kind of target.
pub const FOCUS: &str = "Examples:
  A focus at one place:
    unripple focus hudin-2012 --at 62,90 -o out
  Two at once, the second half as strong, with the most contrast:
    unripple focus hudin-2012 --at 40,60 --at 90,120,0.5 --method concentrate -o out
  A focus repeated 50 times a second, as it is under a finger:
    unripple focus hudin-2012 --at 62,90,1,50 --finger 62,90 -o out
  The outline of a triangle:
    unripple focus hudin-2012 --shape triangle:66,93,40 -o out
  A burst at one place while another stays still:
    unripple focus hudin-2012 --waveform 62,90,burst:250,5 --silent 100,60 -o out";

/// For `compare`: methods on one surface, and several surfaces.
pub const COMPARE: &str = "Examples:
  All methods, in a table and in a folder:
    unripple compare hudin-2012 --at 62,90
    unripple compare my-surface.toml --at 62,90 --peak-um 5 -o out
  Two surfaces, and one whose tension is varied:
    unripple compare film.toml glass.toml --at 62,90 --method concentrate --method felt -o out
    unripple compare hudin-2012 --vary sheet.tension_n_per_m=200,300,400 --at 62,90 -o out";

/// For `place`: near the rim, around a screen, for another method, one more, those of a library to keep.
pub const PLACE: &str = "Examples:
  Eight actuators, 6 to 12 mm from the rim:
    unripple place hudin-2012 --rim-mm 6,12 -o placed
  Four that tolerate mounting errors of 1 mm, around a screen:
    unripple place my-surface.toml --count 4 --mounting-mm 1 --screen 30,30,120,30,120,120,30,120
  Eight for what is felt of drives of another method:
    unripple place hudin-2012 --rim-mm 6,12 --method concentrate --by felt-contrast -o placed
  One more, with those of the file kept:
    unripple place my-surface.toml --count 1 --keep-all
  The eight of a library's actuators to keep:
    unripple place film.zarr --count 8 -o chosen";

/// For `sensors`: sensors, taps, and one more.
pub const SENSORS: &str = "Examples:
  Four places of a sensor that records sweeps:
    unripple sensors hudin-2012 --count 4 --rim-mm 10,75 -o planned
  Six taps on a screen, for a fit of a uniform tension:
    unripple sensors my-surface.toml --taps --count 6 --profile 0 --within 30,30,120,30,120,120,30,120
  One more beside those that have been measured:
    unripple sensors my-surface.toml --count 1 --keep 62,90 --keep 40,50";

/// For `sweep`: how many designs, all of them, and one shard.
pub const SWEEP: &str = "Examples:
  unripple sweep plan.toml --count
  unripple sweep plan.toml --jobs 4 -o swept
  unripple sweep plan.toml --shard 7 -o swept";

/// For `optimise`: a search, and what can be computed of it without Python.
pub const OPTIMISE: &str = "Examples:
  unripple optimise plan.toml --jobs 4 -o searched
  unripple optimise plan.toml --no-ask -o searched";

/// For `field`: the drive that `focus` wrote.
pub const FIELD: &str = "Examples:
  unripple field hudin-2012 --drive out/drive.wav
  unripple field hudin-2012 --drive out/drive.wav --at 62,90 --finger 62,90 -o out-field";

/// For `calibrate`: a line for each way to a library.
pub const CALIBRATE: &str = "Examples:
  Without hardware, on a surface that differs from its file:
    unripple calibrate hudin-2012 --unknowns 1 --grid-mm 20 -o rig.zarr
  With a probe, through a sound server:
    unripple calibrate my-surface.toml --device jack --grid-mm 10 -o rig.zarr
  Levels alone, before the long run:
    unripple calibrate my-surface.toml --device jack --grid-mm 10 --check-levels -o rig.zarr
  With a finger that taps in place of a probe:
    unripple calibrate my-surface.toml --device jack --by tap --repeats 5 --at 62,90 -o rig.zarr
  With a hammer whose force is recorded, 100 N at full scale:
    unripple calibrate my-surface.toml --device card --by hammer --repeats 3 --input-scale force=100 --input-scale 0.5 --at 62,90 -o rig.zarr
  From recordings made elsewhere; the first run writes the file to play:
    unripple calibrate my-surface.toml --device tape --tape takes --grid-mm 10 -o rig.zarr";

/// For `import`: what files say themselves, and what has to be said.
pub const IMPORT: &str = "Examples:
  What `export` wrote, and a universal file that says places and units:
    unripple import my-surface.toml rig-wav -o again.zarr
    unripple import my-surface.toml scan.uff -o scanned.zarr
  Accelerations in g per volt, of a shaker that makes 2 N of a volt, placed by a table:
    unripple import my-surface.toml taps.csv --table places.csv --unit g --per volt --drive-per-reference 2 -o tapped.zarr
  WAV files whose names say where they are from:
    unripple import my-surface.toml sweeps --pattern '{actuator}_{x_mm}_{y_mm}.wav' --kind filters --unit mm/s --per newton -o swept.zarr";

/// For `export`: a line for each format.
pub const EXPORT: &str = "Examples:
  unripple export rig.zarr -o rig-wav
  unripple export rig.zarr -o rig.sofa --author 'Ada, ada@lab.example'
  unripple export rig.zarr -o rig.uff
  unripple export rig.zarr --format uff-modes -o modes.unv
  unripple export rig.zarr -o rig.mat";

/// For `play`: where touches come from and go to.
pub const PLAY: &str = "Examples:
  Simulated fingers on a simulated surface:
    unripple play hudin-2012 --seconds 10
  Fingers of a tracker on a real one:
    unripple play rig.zarr --device jack --tuio --effect click-button
  A session recorded, and played again:
    unripple play hudin-2012 --tuio --record session.jsonl
    unripple play hudin-2012 --session session.jsonl --keep-drive drive.wav";

/// For `drift`: on a simulated sheet and on a real one.
pub const DRIFT: &str = "Examples:
  unripple drift hudin-2012 --changed-percent 2
  unripple drift rig.zarr --device jack";

/// For `verify`: what would be played, a simulated sheet with a fault, and a real one.
pub const VERIFY: &str = "Examples:
  What would be played, and how loud:
    unripple verify hudin-2012 --drive out/drive.wav --dry-run
  On a simulated sheet whose tension is 2 % higher:
    unripple verify hudin-2012 --drive out/drive.wav --changed-percent 2
  On a real one, with a vibrometer of 0.5 m/s at full scale:
    unripple verify rig.zarr --drive out/drive.wav --device jack --output-scale 2 --probe-scale 0.5";

/// For `view`: on this machine alone, and for other machines.
pub const VIEW: &str = "Examples:
  unripple view
  unripple view my-surface.toml --listen 0.0.0.0 --no-browser";

/// For `fit`: the parameters of the model alone, a library of its responses, and frequencies in place of a library.
pub const FIT: &str = "Examples:
  unripple fit rig.zarr
  unripple fit rig.zarr --grid-mm 5 -o fitted.zarr
  unripple fit my-plate.toml --modes 73.2,148,376:20,431,559:Q40,910 --error-percent 3 -o fitted";

/// For `listen`: a knock as it is, and one before another.
pub const LISTEN: &str = "Examples:
  unripple listen knock.wav
  unripple listen knocks.wav --hit 1 --band-hz 50,2000 -o heard";

/// For `devices`: the devices of this machine, and a JACK server that is not the default one.
pub const DEVICES: &str = "Examples:
  unripple devices
  unripple devices --server stage";

/// For `doctor`: without hardware, and with it.
pub const DOCTOR: &str = "Examples:
  unripple doctor
  unripple doctor my-surface.toml --device jack";

/// For `reproduce`: only its required option, since the others are seldom needed.
pub const REPRODUCE: &str = "Examples:
  unripple reproduce -o paper";

/// For `rerun`: a new folder, so that the folder of the earlier run stays.
pub const RERUN: &str = "Examples:
  unripple rerun out/report.json -o again";

/// For `cache`: to see how large it is, and to empty it.
pub const CACHE: &str = "Examples:
  unripple cache
  unripple cache --empty";

/// For `completions`: where bash looks for them.
pub const COMPLETIONS: &str = "Examples:
  unripple completions bash > ~/.local/share/bash-completion/completions/unripple";

/// For `man`: a new folder for the pages.
pub const MAN: &str = "Examples:
  unripple man -o man";

#[cfg(test)]
mod tests {
    use crate::args::Arguments;
    use clap::{CommandFactory, Parser};

    /// The words of a command line as a shell would split it, without a redirection; of quotes only single ones are handled.
    fn words(line: &str) -> Vec<String> {
        let line = line.split(" > ").next().unwrap();
        let quoted = line.split('\'').enumerate();
        quoted
            .flat_map(|(n, part)| match n % 2 {
                0 => part.split_whitespace().map(str::to_owned).collect(),
                _ => vec![part.to_owned()],
            })
            .collect()
    }

    #[test]
    fn every_command_has_examples_and_all_are_understood() {
        for command in Arguments::command().get_subcommands() {
            let name = command.get_name();
            if name == "help" {
                continue;
            }
            let help =
                command.get_after_help().unwrap_or_else(|| panic!("{name} has no examples")).to_string();
            let lines: Vec<&str> = help.lines().filter(|line| line.trim().starts_with("unripple ")).collect();
            assert!(!lines.is_empty(), "{name}");
            for line in lines {
                assert_eq!(words(line)[1], name);
                if let Err(error) = Arguments::try_parse_from(words(line)) {
                    panic!("{line}: {error}");
                }
            }
        }
    }

    #[test]
    fn every_option_stands_under_a_heading_where_there_are_many() {
        for command in Arguments::command().get_subcommands() {
            let bare = command.get_opts().filter(|option| option.get_help_heading().is_none());
            let bare: Vec<_> = bare.filter_map(|option| option.get_long()).collect();
            assert!(bare.len() <= 5, "{}: {bare:?}", command.get_name());
        }
    }
}
