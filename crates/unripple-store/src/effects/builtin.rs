//! Built-in effects.

use super::parse_effects;
use unripple_effects::EffectSet;

/// Effects that come with the program, as the text of their file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuiltinEffects {
    /// Name of the effects, as it is passed to [`crate::load_effects`].
    pub name: &'static str,
    /// Description of the effects, in a line.
    pub about: &'static str,
    /// Text of the file of effects, comments included.
    pub text: &'static str,
}

macro_rules! builtin {
    ($name:literal, $about:literal) => {
        BuiltinEffects {
            name: $name,
            about: $about,
            text: include_str!(concat!("../../builtin/effects/", $name, ".toml")),
        }
    };
}

/// The effects that come with the program, in the order in which they are listed.
const BUILTINS: &[BuiltinEffects] = &[
    builtin!("click-button", "a button anywhere: a click when touched, a softer one when lifted"),
    builtin!("two-stage-button", "a shutter button: a soft click when touched, a hard one when pressed"),
    builtin!("sandpaper", "irregular grains, harder the faster the finger goes"),
    builtin!("corduroy", "even ribs every 2 mm"),
    builtin!("edge", "the border of a square, felt as a click when the finger crosses it"),
    builtin!("ruler-notches", "a detent every 5 mm from left to right, a stronger one every 50 mm"),
    builtin!("heartbeat", "two beats, over and over, while touched"),
    builtin!("rain", "drops around the finger, now here, now there"),
    builtin!("drawn-triangle", "a point that draws a triangle on a resting palm"),
    builtin!("purr", "a rough hum that grows when stroked"),
];

/// The built-in effects.
///
/// ```
/// let names: Vec<&str> = unripple_store::builtin_effects().iter().map(|b| b.name).collect();
/// assert!(names.len() >= 10 && names.contains(&"sandpaper"));
/// ```
pub fn builtin_effects() -> &'static [BuiltinEffects] {
    BUILTINS
}

/// The built-in effects with a name; `None` if there are none.
///
/// ```
/// let purr = unripple_store::builtin_effect("purr").unwrap();
/// assert_eq!(purr.effects[0].kind.name(), "hum");
/// assert!(unripple_store::builtin_effect("bark").is_none());
/// ```
pub fn builtin_effect(name: &str) -> Option<EffectSet> {
    let builtin = BUILTINS.iter().find(|builtin| builtin.name == name)?;
    parse_effects(builtin.text, builtin.name).ok()
}
