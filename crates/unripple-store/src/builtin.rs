//! Built-in surfaces.

/// A surface that comes with the program, as the text of its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Builtin {
    /// Name of the surface, as it is passed to [`crate::load_surface`].
    pub name: &'static str,
    /// Text of the surface file, comments included.
    pub text: &'static str,
}

/// The built-in surfaces.
///
/// ```
/// let names: Vec<&str> = unripple_store::BUILTINS.iter().map(|b| b.name).collect();
/// assert_eq!(names[..5], ["hudin-2012", "glass-plate", "picture-frame", "stadium-film", "drum"]);
/// // Surfaces that others measured or computed.
/// assert_eq!(names[5..], ["copper", "spruce-a", "spruce-b", "phone-board", "leissa", "glass-2015"]);
/// ```
pub const BUILTINS: &[Builtin] = &[
    Builtin { name: "hudin-2012", text: include_str!("../builtin/hudin-2012.toml") },
    Builtin { name: "glass-plate", text: include_str!("../builtin/glass-plate.toml") },
    Builtin { name: "picture-frame", text: include_str!("../builtin/picture-frame.toml") },
    Builtin { name: "stadium-film", text: include_str!("../builtin/stadium-film.toml") },
    Builtin { name: "drum", text: include_str!("../builtin/drum.toml") },
    Builtin { name: "copper", text: include_str!("../builtin/copper.toml") },
    Builtin { name: "spruce-a", text: include_str!("../builtin/spruce-a.toml") },
    Builtin { name: "spruce-b", text: include_str!("../builtin/spruce-b.toml") },
    Builtin { name: "phone-board", text: include_str!("../builtin/phone-board.toml") },
    Builtin { name: "leissa", text: include_str!("../builtin/leissa.toml") },
    Builtin { name: "glass-2015", text: include_str!("../builtin/glass-2015.toml") },
];
