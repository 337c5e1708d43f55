//! The page without a server: the [session](unripple_session) as WebAssembly, in a worker of the page.
//!
//! A [`Page`] is the session with what the server does around it for one page: it reads the page's messages, lets time pass by the page's
//! clock, does long work in between, and keeps the files that the page may save. There are no threads: long work keeps pictures waiting, and
//! who does not want to wait for it ends the worker. `exports` are the functions that JavaScript calls. They exchange bytes and numbers
//! alone, so that no generator of bindings is needed; the page's file `session-worker.js` is their other side.
//!
//! ```
//! use unripple::physics::design::papers_surface;
//! use unripple_web::{Message, Page};
//!
//! let mut surface = papers_surface();
//! surface.emission.band = [0.0, 300.0];
//! let mut page = Page::open(surface, "film".into())?;
//! page.hear(r#"{"do":"touch","finger":0,"phase":"down","at_mm":[62,90]}"#);
//! page.tick();
//! let said: Vec<Message> = std::iter::from_fn(|| page.take()).collect();
//! assert!(said.iter().any(|message| matches!(message, Message::Frame(_))));
//! # Ok::<(), unripple_session::ViewError>(())
//! ```

#[cfg(target_family = "wasm")]
mod exports;
mod page;

pub use page::{Message, Page};
