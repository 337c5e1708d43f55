//! A cache of results of long computations, which whoever runs them may provide.

use crate::clock::Instant;
use crate::{Encoded, scope};
use std::cell::RefCell;
use std::sync::Arc;
use std::time::Duration;

/// Stores results of computations under keys. Its methods are called on the threads that compute.
pub trait Cache: Send + Sync {
    /// The bytes that were stored under a key; `None` if there are none, or if they are damaged.
    fn read(&self, key: &str) -> Option<Vec<u8>>;

    /// Whether there are bytes under a key, as far as can be told without reading them.
    fn holds(&self, key: &str) -> bool {
        self.read(key).is_some()
    }

    /// Stores bytes under a key, or does nothing if they cannot be stored.
    fn write(&self, key: &str, bytes: &[u8]);

    /// Time below which a computation is repeated rather than stored.
    fn least(&self) -> Duration {
        Duration::from_secs(1)
    }
}

thread_local! {
    /// The cache of computations that begin on this thread; `None` if there is none.
    static HERE: RefCell<Option<Arc<dyn Cache>>> = const { RefCell::new(None) };
}

/// The [`Cache`] of a computation, if there is one. A computation takes the handle that was set for the thread on which it begins;
/// functions in between need no parameter for it. It changes no result: what is read is what was computed, to the last bit.
///
/// ```
/// use std::collections::HashMap;
/// use std::convert::Infallible;
/// use std::sync::{Arc, Mutex};
/// use std::time::Duration;
/// use unripple_core::{Cache, Cached};
///
/// #[derive(Default)]
/// struct InMemory(Mutex<HashMap<String, Vec<u8>>>);
///
/// impl Cache for InMemory {
///     fn read(&self, key: &str) -> Option<Vec<u8>> {
///         self.0.lock().unwrap().get(key).cloned()
///     }
///
///     fn write(&self, key: &str, bytes: &[u8]) {
///         self.0.lock().unwrap().insert(key.into(), bytes.into());
///     }
///
///     fn least(&self) -> Duration {
///         Duration::ZERO
///     }
/// }
///
/// fn root(of: f64) -> f64 {
///     Cached::here().result(|| format!("root {of:?}"), || Ok::<f64, Infallible>(of.sqrt())).unwrap()
/// }
///
/// let cache = Arc::new(InMemory::default());
/// let (first, second) = Cached::by(Some(cache.clone())).during(|| (root(2.0), root(2.0)));
/// assert_eq!((first, second), (2f64.sqrt(), 2f64.sqrt()));
/// assert_eq!(cache.0.lock().unwrap().len(), 1);
/// ```
#[derive(Clone, Default)]
pub struct Cached(Option<Arc<dyn Cache>>);

impl std::fmt::Debug for Cached {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Cached").field("cache", &self.0.is_some()).finish()
    }
}

impl Cached {
    /// A handle to `cache`; with `None`, everything is computed.
    pub fn by(cache: Option<Arc<dyn Cache>>) -> Self {
        Self(cache)
    }

    /// The handle that is set for the current thread (see [`Cached::during`]); one without a cache if none is set.
    pub fn here() -> Self {
        Self(HERE.with_borrow(Clone::clone))
    }

    /// Runs `work` on the current thread with this handle set for that thread, and restores the previous handle afterwards.
    pub fn during<T>(&self, work: impl FnOnce() -> T) -> T {
        scope::during(&HERE, self.0.clone(), work)
    }

    /// Whether the cache holds a result under `key`.
    pub fn holds(&self, key: impl FnOnce() -> String) -> bool {
        self.0.as_ref().is_some_and(|cache| cache.holds(&key()))
    }

    /// The result of `work`, read from the cache if it holds it under `key`. The key has to contain the name of the computation and all that
    /// the result depends on: the `Debug` text of numbers is exact. Errors are not stored.
    ///
    /// # Errors
    /// Those of `work`.
    pub fn result<T: Encoded, E>(
        &self,
        key: impl FnOnce() -> String,
        work: impl FnOnce() -> Result<T, E>,
    ) -> Result<T, E> {
        self.result_by(key, work, T::encode, T::decode)
    }

    /// As [`Cached::result`], for any type of result: `encode` appends the bytes of a result, and `decode` makes the result from these
    /// bytes, or returns `None` if they are not those of one.
    ///
    /// # Errors
    /// Those of `work`.
    pub fn result_by<T, E>(
        &self,
        key: impl FnOnce() -> String,
        work: impl FnOnce() -> Result<T, E>,
        encode: impl FnOnce(&T, &mut Vec<u8>),
        decode: impl FnOnce(&mut &[u8]) -> Option<T>,
    ) -> Result<T, E> {
        let Some(cache) = &self.0 else { return work() };
        let key = key();
        let known = cache.read(&key).and_then(|bytes| {
            let mut bytes = bytes.as_slice();
            decode(&mut bytes).filter(|_| bytes.is_empty())
        });
        if let Some(known) = known {
            return Ok(known);
        }
        let begun = Instant::now();
        let found = work()?;
        if begun.elapsed() >= cache.least() {
            let mut bytes = Vec::new();
            encode(&found, &mut bytes);
            cache.write(&key, &bytes);
        }
        Ok(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Pole;
    use std::collections::HashMap;
    use std::sync::{Mutex, PoisonError};
    use unripple_linalg::{Mat, mat};

    #[derive(Default)]
    struct InMemory {
        entries: Mutex<HashMap<String, Vec<u8>>>,
        least: Duration,
    }

    impl InMemory {
        fn change(&self, key: &str, change: impl FnOnce(&mut Vec<u8>)) {
            change(self.entries.lock().unwrap_or_else(PoisonError::into_inner).get_mut(key).unwrap());
        }
    }

    impl Cache for InMemory {
        fn read(&self, key: &str) -> Option<Vec<u8>> {
            self.entries.lock().unwrap().get(key).cloned()
        }

        fn write(&self, key: &str, bytes: &[u8]) {
            self.entries.lock().unwrap().insert(key.into(), bytes.into());
        }

        fn least(&self) -> Duration {
            self.least
        }
    }

    type Value = (Vec<[f64; 2]>, (Mat<f64>, Vec<Pole>));

    fn value() -> Value {
        let poles = vec![Pole::new(1.0, 0.5), Pole::moved(f64::MIN_POSITIVE, -0.0)];
        (vec![[1.0 / 3.0, f64::INFINITY]; 3], (mat![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0_f64]], poles))
    }

    #[test]
    fn what_is_read_is_what_was_computed() {
        let cache = Arc::new(InMemory::default());
        let mut computed = 0;
        Cached::by(Some(cache.clone())).during(|| {
            for _ in 0..3 {
                let found = Cached::here().result(
                    || "value".into(),
                    || {
                        computed += 1;
                        Ok::<Value, String>(value())
                    },
                );
                assert_eq!(found, Ok(value()));
            }
        });
        assert_eq!(computed, 1);
        assert!(Cached::here().0.is_none());
    }

    #[test]
    fn damaged_bytes_are_computed_again() {
        let cache = Arc::new(InMemory::default());
        let cached = Cached::by(Some(cache.clone()));
        let found = || cached.result(|| "value".into(), || Ok::<Value, String>(value())).unwrap();
        assert_eq!(found(), value());
        let whole = cache.read("value").unwrap().len();
        for length in 0..whole {
            cache.change("value", |bytes| bytes.truncate(length));
            assert_eq!(found(), value());
        }
        cache.change("value", |bytes| bytes.push(0));
        assert_eq!(found(), value());
        // A count that asks for all memory.
        cache.change("value", |bytes| bytes[..8].fill(0xff));
        assert_eq!(found(), value());
    }

    #[test]
    fn errors_and_what_is_quick_are_not_stored() {
        let cache = Arc::new(InMemory { least: Duration::from_secs(3600), ..InMemory::default() });
        let cached = Cached::by(Some(cache.clone()));
        assert_eq!(cached.result(|| "value".into(), || Ok::<Value, String>(value())), Ok(value()));
        let cached = Cached::by(Some(Arc::new(InMemory::default())));
        let failed = || cached.result(|| "none".into(), || Err::<f64, _>("failed"));
        assert_eq!((failed(), failed()), (Err("failed"), Err("failed")));
        assert!(cache.entries.lock().unwrap().is_empty());
    }
}
