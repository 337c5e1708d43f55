//! Libraries that are loaded at run time, on the systems that have them.

#[cfg(any(unix, windows))]
pub(super) use libloading::{Error, Library};

#[cfg(not(any(unix, windows)))]
pub(super) use nowhere::{Error, Library};

/// The same where there are no such libraries: none is ever found.
#[cfg(not(any(unix, windows)))]
mod nowhere {
    use std::convert::Infallible;

    /// Why no library is found.
    #[derive(Debug, thiserror::Error)]
    #[error("no libraries can be loaded on this system")]
    pub(in super::super) struct Error;

    /// A loaded library, which there never is.
    pub(in super::super) struct Library(Infallible);

    impl Library {
        pub(in super::super) unsafe fn new(_name: &str) -> Result<Self, Error> {
            Err(Error)
        }

        pub(in super::super) unsafe fn get<T>(&self, _name: &[u8]) -> Result<&T, Error> {
            match self.0 {}
        }
    }
}
