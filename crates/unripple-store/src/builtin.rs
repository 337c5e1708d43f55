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
/// assert_eq!(names, ["hudin-2012", "glass-plate", "picture-frame", "stadium-film", "drum"]);
/// ```
pub const BUILTINS: &[Builtin] = &[
    Builtin { name: "hudin-2012", text: include_str!("../builtin/hudin-2012.toml") },
    Builtin { name: "glass-plate", text: include_str!("../builtin/glass-plate.toml") },
    Builtin { name: "picture-frame", text: include_str!("../builtin/picture-frame.toml") },
    Builtin { name: "stadium-film", text: include_str!("../builtin/stadium-film.toml") },
    Builtin { name: "drum", text: include_str!("../builtin/drum.toml") },
];
