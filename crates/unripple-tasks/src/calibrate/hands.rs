//! People at a real surface, who move the probe and tap.

/// Callback that asks a person at the surface to do something, such as putting the probe at a place. It
/// returns when this is done, or else the reason why it cannot be done.
pub type Hands = Box<dyn FnMut(&str) -> Result<(), String> + Send>;

/// A callback for devices that need no person at the surface: it returns an error if called.
pub fn nobody() -> Hands {
    Box::new(|asked| Err(format!("expected somebody to {asked}, found nobody")))
}
