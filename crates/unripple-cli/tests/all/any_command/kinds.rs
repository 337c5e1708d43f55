//! The commands that are tried at random, with their options and what these may be.

/// What stands behind an option.
#[derive(Clone, Copy)]
pub enum Value {
    Nothing,
    /// A number between two, by decades.
    Number(f64, f64),
    /// A whole number between two.
    Whole(u64, u64),
    /// A place on the surface, now and then beside it.
    Place,
    /// A polygon of three such places.
    Area,
    /// A place with gain and rate.
    Target,
    Waveform,
    Path,
    Shape,
    One(&'static [&'static str]),
}

use Value::{Area, Nothing, Number, One, Path, Place, Shape, Target, Waveform, Whole};

const METHODS: &[&str] = &["time-reversal", "one-bit", "inverse", "concentrate", "limited", "robust", "felt"];

/// A command: its words, the options that it is given always, and those that it may be given.
#[derive(Clone, Copy)]
pub struct Kind {
    pub words: &'static str,
    pub always: &'static [(&'static str, Value)],
    pub perhaps: &'static [(&'static str, Value)],
}

const FOCUS: &[(&str, Value)] = &[
    ("--at", Target),
    ("--shape", Shape),
    ("--peak-um", Number(1e-3, 1e3)),
    ("--felt-db", Number(0.1, 60.0)),
    ("--full-limit", Nothing),
    ("--method", One(METHODS)),
    ("--strength", Number(0.01, 1.0)),
    ("--push", Number(0.01, 1.0)),
    ("--total-rms", Number(1e-3, 10.0)),
    ("--spread-percent", Number(0.01, 5.0)),
    ("--worst", Number(0.01, 1.0)),
    ("--economy", Number(1e-6, 1.0)),
    ("--rest", Nothing),
    ("--window-ms", Number(0.5, 60.0)),
    ("--losses", One(&["none", "uniform", "per-mode"])),
    ("--duration-ms", Number(1.0, 2000.0)),
    ("--finger", Place),
    ("--finger-aware", Nothing),
    ("--bear-tension-percent", Number(0.1, 5.0)),
    ("--bear-finger", Place),
    ("--on", One(&["surface.toml", "hudin-2012", "lib"])),
    ("--judge-hz", Number(50.0, 5e3)),
    ("--listen-m", Number(0.01, 10.0)),
    ("--between", One(&["kernel", "nearest", "linear"])),
];

const PLACE: &[(&str, Value)] = &[
    ("--keep-all", Nothing),
    ("--rim-mm", One(&["1,8", "2,30", "8,1", "0,0", "nan,1", "5"])),
    ("--keep-out", Area),
    ("--place", Place),
    ("--grid-mm", Number(2.0, 50.0)),
    ("--apart-mm", Number(0.1, 100.0)),
    ("--at", Place),
    ("--screen", Area),
    ("--targets", Whole(1, 30)),
    ("--objective", One(&["mean", "worst", "quantile"])),
    ("--mounting-mm", Number(0.01, 5.0)),
    ("--tension-percent", Number(0.1, 10.0)),
    ("--window-ms", Number(0.5, 60.0)),
    ("--restarts", Whole(0, 5)),
    ("--up-to", Whole(1, 8)),
    ("--method", One(&["time-reversal", "one-bit", "inverse", "concentrate"])),
    ("-o", One(&["placed", "out"])),
];

const SENSORS: &[(&str, Value)] = &[
    ("--taps", Nothing),
    ("--keep", Place),
    ("--rim-mm", One(&["1,8", "2,30", "8,1", "0,0", "nan,1", "5"])),
    ("--within", Area),
    ("--keep-out", Area),
    ("--place", Place),
    ("--apart-mm", Number(0.1, 100.0)),
    ("--snr-db", Number(1.0, 80.0)),
    ("--restarts", Whole(0, 5)),
    ("--up-to", Whole(1, 8)),
    ("-o", One(&["planned", "out"])),
];

pub const KINDS: &[Kind] = &[
    Kind { words: "check surface.toml", always: &[], perhaps: &[] },
    Kind { words: "design surface.toml", always: &[], perhaps: &[] },
    Kind {
        words: "modes surface.toml",
        always: &[],
        perhaps: &[("--max-hz", Number(10.0, 2e3)), ("--accuracy", Number(1e-8, 0.5))],
    },
    Kind {
        words: "respond surface.toml -o lib",
        always: &[("--grid-mm", Number(5.0, 300.0))],
        perhaps: &[("--length-ms", Number(1.0, 200.0))],
    },
    Kind { words: "focus surface.toml -o out", always: &[("--at", Place)], perhaps: FOCUS },
    Kind { words: "focus surface.toml -o out --no-figures", always: &[("--at", Target)], perhaps: FOCUS },
    Kind { words: "focus lib -o out", always: &[("--at", Place)], perhaps: FOCUS },
    Kind {
        words: "focus surface.toml -o waves",
        always: &[("--waveform", Waveform)],
        perhaps: &[("--waveform", Waveform), ("--silent", Place), ("--judge-hz", Number(50.0, 5e3))],
    },
    Kind {
        words: "focus surface.toml -o stroke",
        always: &[("--path", Path), ("--speed-mm-s", Number(20.0, 2000.0))],
        perhaps: &[("--level-mm-s", Number(0.1, 1e3)), ("--window-ms", Number(0.5, 60.0))],
    },
    Kind {
        words: "compare surface.toml",
        always: &[("--at", Place)],
        perhaps: &[
            ("--window-ms", Number(0.5, 60.0)),
            ("--judge-hz", Number(50.0, 5e3)),
            ("--listen-m", Number(0.01, 10.0)),
            ("--peak-um", Number(1e-3, 1e3)),
        ],
    },
    Kind {
        words: "field surface.toml --drive out/drive.wav",
        always: &[],
        perhaps: &[
            ("--at", Place),
            ("--at-ms", Number(0.1, 100.0)),
            ("--finger", Place),
            ("--period-ms", Number(1.0, 300.0)),
            ("--judge-hz", Number(50.0, 5e3)),
            ("--listen-m", Number(0.01, 10.0)),
            ("--frames", Whole(0, 30)),
            ("--movie-ms", One(&["0,3", "3,0", "-1,1", "0,1e9", "nan,1", "5"])),
            ("-o", One(&["seen", "out", "lib"])),
        ],
    },
    Kind {
        words: "export lib",
        always: &[("-o", One(&["exported", "lib.sofa", "out", "lib"]))],
        perhaps: &[],
    },
    Kind {
        words: "calibrate surface.toml -o measured",
        always: &[("--at", Place), ("--sweep-ms", Number(20.0, 100.0)), ("--response-ms", Number(5.0, 50.0))],
        perhaps: &[
            ("--by", One(&["sweep", "tap", "hammer"])),
            ("--repeats", Whole(1, 2)),
            ("--level", Number(0.01, 1.0)),
            ("--unknowns", Whole(0, 9)),
            ("--probe-delay-ms", Number(0.01, 5.0)),
            ("--no-model", Nothing),
            ("--any-wiring", Nothing),
            ("--check-levels", Nothing),
        ],
    },
    Kind {
        words: "fit measured",
        always: &[],
        perhaps: &[("--strays", Whole(0, 2)), ("--profile", Whole(0, 2)), ("--even-if-doubtful", Nothing)],
    },
    Kind {
        words: "play surface.toml",
        always: &[("--fingers", Whole(1, 3)), ("--seconds", Number(0.01, 1.0))],
        perhaps: &[
            ("--effect", One(&["click-button", "sandpaper", "none-such"])),
            ("--method", One(METHODS)),
            ("--window-ms", Number(0.5, 60.0)),
            ("--block", Whole(1, 512)),
            ("--full-limit", Nothing),
            ("--follow-tension", Nothing),
            ("--drift-percent", Number(0.01, 5.0)),
            ("--keep-drive", One(&["kept.wav", "out/drive.wav"])),
        ],
    },
    Kind {
        words: "drift surface.toml",
        always: &[("--seconds", Number(0.5, 2.0))],
        perhaps: &[("--within-percent", Number(1.0, 10.0)), ("--changed-percent", Number(0.1, 10.0))],
    },
    Kind {
        words: "verify surface.toml --drive out/drive.wav",
        always: &[("--probes", Whole(0, 3))],
        perhaps: &[
            ("--at", Place),
            ("--at-ms", Number(0.1, 100.0)),
            ("--probe-mm", Place),
            ("--level", Number(0.01, 1.0)),
            ("--dry-run", Nothing),
            ("--changed-percent", Number(0.1, 10.0)),
            ("--clipped", Number(0.1, 1.0)),
        ],
    },
    Kind { words: "doctor surface.toml --tuio 0", always: &[], perhaps: &[] },
    Kind {
        words: "listen out/drive.wav",
        always: &[],
        perhaps: &[
            ("--channel", Whole(1, 3)),
            ("--band-hz", One(&["20,2000", "2000,20", "nan,1", "5"])),
            ("--mains-hz", Number(40.0, 70.0)),
            ("--hit", Whole(1, 3)),
            ("--most", Whole(1, 10)),
            ("-o", One(&["heard", "out"])),
        ],
    },
    Kind { words: "place surface.toml", always: &[("--count", Whole(1, 4))], perhaps: PLACE },
    Kind {
        words: "sensors surface.toml",
        always: &[("--count", Whole(1, 4)), ("--grid-mm", Number(10.0, 50.0)), ("--profile", Whole(0, 2))],
        perhaps: SENSORS,
    },
];

/// Indices into [`KINDS`] of what others read the results of: a focus and a library.
pub const FIRST: [usize; 2] = [4, 3];
