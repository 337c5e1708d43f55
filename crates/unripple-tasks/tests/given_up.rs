//! A task on a thread of its own: whoever cancels it is back within 0.2 s, at most one that was given up lives, and none puts anything in
//! place after that.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use unripple_tasks::{Progress, TaskError, apart};

/// Cancels after some time.
struct Until(Instant);

impl Progress for Until {
    fn cancelled(&self) -> bool {
        Instant::now() >= self.0
    }
}

fn soon() -> Until {
    Until(Instant::now() + Duration::from_millis(50))
}

/// What a task that cannot be interrupted does to others.
#[derive(Clone, Default)]
struct Ask {
    living: Arc<AtomicUsize>,
    most: Arc<AtomicUsize>,
    placed: Arc<AtomicBool>,
}

/// Never looks at its progress for a second, and then puts something in place.
fn stubborn(ask: &Ask, progress: &mut dyn Progress) -> Result<(), TaskError> {
    let living = ask.living.fetch_add(1, Ordering::SeqCst) + 1;
    ask.most.fetch_max(living, Ordering::SeqCst);
    std::thread::sleep(Duration::from_secs(1));
    let done = progress.place(&mut || {
        ask.placed.store(true, Ordering::SeqCst);
        Ok(())
    });
    ask.living.fetch_sub(1, Ordering::SeqCst);
    done
}

#[test]
fn whoever_gives_up_is_back_at_once() {
    let ask = Ask::default();
    let start = Instant::now();
    let mut slowest = Duration::ZERO;
    for _ in 0..4 {
        // While the one before still runs, the next waits for it, and can be given up too.
        let began = Instant::now();
        assert!(matches!(apart(ask.clone(), stubborn, &mut soon()), Err(TaskError::Cancelled)));
        slowest = slowest.max(began.elapsed());
    }
    println!("back within {slowest:?}");
    assert!(slowest < Duration::from_millis(50 + 200), "{slowest:?}");
    // One that nobody gives up begins after those that were, and its result is placed.
    assert!(!ask.placed.load(Ordering::SeqCst));
    apart(ask.clone(), stubborn, &mut unripple_tasks::Silent).unwrap();
    assert!(ask.placed.load(Ordering::SeqCst) && start.elapsed() > Duration::from_secs(2));
    assert_eq!(ask.most.load(Ordering::SeqCst), 1);
}

#[test]
fn a_panic_is_an_error() {
    fn falls(_: &(), _: &mut dyn Progress) -> Result<(), TaskError> {
        panic!("on purpose")
    }
    let error = apart((), falls, &mut unripple_tasks::Silent).unwrap_err();
    assert!(error.to_string().contains("panic"), "{error}");
}
