//! A task on a thread of its own: whoever cancels it is back within 0.2 s, at most one that was given up lives, and none puts anything in
//! place after that.
//!
//! How long that takes on a clock is the machine's affair, too: one whose processors are held up for half a second is late by as much. So
//! what is asked is that the first look that finds it cancelled is the last, and that looks are close together.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use unripple_tasks::{Lane, Progress, Silent, TaskError, apart};

/// Cancels after some time, and keeps when it was looked at.
struct Until {
    instant: Instant,
    looks: RefCell<Vec<Instant>>,
}

impl Progress for Until {
    fn cancelled(&self) -> bool {
        let now = Instant::now();
        self.looks.borrow_mut().push(now);
        now >= self.instant
    }
}

impl Until {
    /// A quarter of a second from now: time for some looks.
    fn soon() -> Self {
        Self { instant: Instant::now() + Duration::from_millis(250), looks: RefCell::default() }
    }

    /// How often it was looked at after it was cancelled.
    fn late(&self) -> usize {
        self.looks.borrow().iter().filter(|look| **look >= self.instant).count()
    }

    /// The median of the times between looks.
    fn between(&self) -> Duration {
        let looks = self.looks.borrow();
        let mut between: Vec<Duration> = looks.windows(2).map(|pair| pair[1] - pair[0]).collect();
        between.sort();
        between[between.len() / 2]
    }
}

/// What a task that cannot be interrupted does to others.
#[derive(Clone, Default)]
struct Ask {
    released: Arc<AtomicBool>,
    living: Arc<AtomicUsize>,
    most: Arc<AtomicUsize>,
    placed: Arc<AtomicBool>,
}

/// Never looks at its progress until it is released, and then puts something in place.
fn stubborn(ask: &Ask, progress: &mut dyn Progress) -> Result<(), TaskError> {
    let living = ask.living.fetch_add(1, Ordering::SeqCst) + 1;
    ask.most.fetch_max(living, Ordering::SeqCst);
    while !ask.released.load(Ordering::SeqCst) {
        std::thread::sleep(Duration::from_millis(1));
    }
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
    for _ in 0..4 {
        // While the first still runs, the others wait for it, and can be given up too.
        let mut until = Until::soon();
        assert!(matches!(apart(ask.clone(), stubborn, &mut until), Err(TaskError::Cancelled)));
        assert_eq!(until.late(), 1, "the first look that finds it cancelled is the last");
        assert!(until.between() < Duration::from_millis(100), "{:?} between looks", until.between());
        assert_eq!(ask.living.load(Ordering::SeqCst), 1);
    }
    ask.released.store(true, Ordering::SeqCst);
    while ask.living.load(Ordering::SeqCst) > 0 {
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(!ask.placed.load(Ordering::SeqCst), "what was given up puts nothing in place");
    // One that nobody gives up begins after those that were, and its result is placed.
    apart(ask.clone(), stubborn, &mut Silent).unwrap();
    assert!(ask.placed.load(Ordering::SeqCst));
    assert_eq!(ask.most.load(Ordering::SeqCst), 1);
}

#[test]
fn a_lane_goes_on_beside_as_many_as_it_is_told() {
    let (lane, ask) = (Lane::new(1), Ask::default());
    let run = |progress: &mut dyn Progress| {
        let ask = ask.clone();
        lane.run(move |progress| stubborn(&ask, progress), progress)
    };
    assert!(matches!(run(&mut Until::soon()), Err(TaskError::Cancelled)));
    assert_eq!(lane.run(|_| Ok(7), &mut Silent).unwrap(), 7);
    // A second one that is given up is one too many for a third to begin.
    assert!(matches!(run(&mut Until::soon()), Err(TaskError::Cancelled)));
    assert!(matches!(lane.run(|_| Ok(7), &mut Until::soon()), Err(TaskError::Cancelled)));
    assert_eq!(ask.living.load(Ordering::SeqCst), 2);
    ask.released.store(true, Ordering::SeqCst);
    assert_eq!(lane.run(|_| Ok(7), &mut Silent).unwrap(), 7);
}

#[test]
fn a_lane_is_quiet_when_what_was_given_up_is_over() {
    let (lane, ask) = (Lane::new(1), Ask::default());
    let moment = Duration::from_millis(20);
    assert!(lane.quiet(Duration::ZERO));
    let given_up = ask.clone();
    let cancelled = lane.run(move |progress| stubborn(&given_up, progress), &mut Until::soon());
    assert!(matches!(cancelled, Err(TaskError::Cancelled)));
    assert!(!lane.quiet(moment), "it is still at work");
    ask.released.store(true, Ordering::SeqCst);
    // No clock is asked: an hour is never waited for.
    assert!(lane.quiet(Duration::from_secs(3600)));
    assert_eq!(ask.living.load(Ordering::SeqCst), 0);
}

#[test]
fn a_panic_is_an_error() {
    fn falls(_: &(), _: &mut dyn Progress) -> Result<(), TaskError> {
        panic!("on purpose")
    }
    let error = apart((), falls, &mut Silent).unwrap_err();
    assert!(error.to_string().contains("panic"), "{error}");
}
