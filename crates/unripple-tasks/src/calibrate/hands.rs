//! People at a real surface, who move the probe and tap.

/// Callback that asks a person at the surface to do something, such as putting the probe at a place, and returns when it is done, or says
/// why it cannot be done.
pub type Hands = Box<dyn FnMut(&str) -> Result<(), String> + Send>;

/// Callback for devices that need no person at the surface: it always fails.
pub fn nobody() -> Hands {
    Box::new(|asked| Err(format!("expected somebody to {asked}, found nobody")))
}
