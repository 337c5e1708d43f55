//! People at a real surface, who move the probe and tap.

/// Asks somebody to do something, such as putting the probe at a place, and comes back when it is done; why not, where nobody is there.
pub type Hands = Box<dyn FnMut(&str) -> Result<(), String> + Send>;

/// Hands for devices that need nobody.
pub fn nobody() -> Hands {
    Box::new(|asked| Err(format!("expected somebody to {asked}, found nobody")))
}
