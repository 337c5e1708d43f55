//! A sitting: a server, the program that plays through it, and ears at its ports.

use crate::ear::{Ear, Wanted};
use crate::faults::Fault;
use crate::hand::Hand;
use crate::link::Link;
use crate::program::{Held, LOOK, Program, Task};
use crate::server::Server;
use crate::tally::Tally;
use serde_json::Value;
use std::net::TcpStream;
use std::time::{Duration, Instant};
use unripple_core::Random;

/// Samples in a cycle of the first server, to which those that change come back.
pub const PERIOD: usize = 256;

/// How long it may take until all is well again. A lost server is looked for every four seconds, fingers that nothing is heard of are lifted
/// after two, and others may be at work.
const PATIENCE: Duration = Duration::from_secs(30);

/// How much the resident memory may grow after the first tenth of a sitting, in KiB. The drives of 256 places that are remembered take some
/// 20 MB, and the allocator keeps what several threads had at most. A leak of a quarter of a megabyte with each fault passes it within an hour.
const GROWS_KB: u64 = 64 << 10;

/// Files and threads more than at first: of a client that joins or leaves the server, and of links that are being closed.
const BESIDE: usize = 8;

/// Share of a sitting after which memory must not grow further.
const SETTLED: f64 = 0.1;

/// A sitting. What is first here is dropped first: nobody is at the server when that ends.
pub struct Sitting {
    pub ear: Ear,
    pub program: Program,
    pub server: Server,
    pub random: Random,
    /// Whether the server that is lost next ends as by a crash.
    pub crashes: bool,
    pub tally: Tally,
    /// What the program may hold.
    most: Held,
}

impl Sitting {
    /// Starts the program on a server, and waits until all is well.
    pub fn begin(task: Task, server: Server, seed: u64) -> Self {
        let ear = Ear::new(&server.name);
        ear.wait_for_server(Instant::now() + PATIENCE);
        let program = Program::start(task, &server.name);
        let (random, tally) = (Random::seeded(seed), Tally::default());
        let most = Held { memory_kb: u64::MAX, files: usize::MAX, threads: usize::MAX };
        let mut sitting = Self { ear, program, server, random, crashes: false, tally, most };
        sitting.well_again(Vec::new());
        let first = sitting.program.held();
        println!("{task:?}: at first {first:?}");
        sitting.most.files = first.files + BESIDE;
        sitting.most.threads = first.threads + BESIDE;
        sitting
    }

    /// Lets faults come for so many seconds, or each once.
    pub fn go_on(&mut self, seconds: Option<f64>) {
        let (task, began) = (self.program.task, Instant::now());
        let mut faults = Fault::of(task, seconds.is_none());
        loop {
            for last in (1..faults.len()).rev() {
                faults.swap(last, self.one_of(last + 1));
            }
            for (number, fault) in faults.iter().copied().enumerate() {
                self.tally.comes(fault);
                let company = self.suffer(fault);
                let took = self.well_again(company);
                self.tally.lasted(fault, took);
                let (held, passed) = (self.program.held(), began.elapsed().as_secs_f64());
                println!("{task:?} at {passed:.0} s: {fault:?}, well again after {took:.1?}; {held:?}");
                let over = seconds.map_or((number + 1) as f64 / faults.len() as f64, |all| passed / all);
                if over >= SETTLED && self.most.memory_kb == u64::MAX {
                    self.most.memory_kb = held.memory_kb + GROWS_KB;
                }
                if over >= 1.0 {
                    return;
                }
            }
        }
    }

    /// Ends the program as Ctrl+C does: it says what was, and what was lost, and what it recorded can be played.
    pub fn end(mut self) {
        let task = self.program.task;
        let (took, counted) = self.program.end();
        self.tally.print(task, &counted);
        println!("{task:?}: ended {took:.1?} after Ctrl+C");
        let count =
            |key: &str| counted.pointer(key).and_then(Value::as_u64).unwrap_or_else(|| panic!("{key}"));
        let [started, lost] = match task {
            Task::Play => ["/started", "/lost_blocks"],
            Task::View => ["/tally/started", "/tally/lost"],
        };
        assert!(count(started) > 0, "nothing was played: {counted}");
        assert!(self.tally.count(Fault::Killed) == 0 || count(lost) > 0, "nothing was lost: {counted}");
        if task == Task::Play {
            let refused = self.tally.count(Fault::Garbage) == 0 || count("/refused_touches") > 0;
            assert!(refused, "nothing was refused: {counted}");
            self.program.replay();
        }
    }

    /// Waits until all is well, with those who are there; how long that takes.
    pub fn well_again(&mut self, company: Vec<TcpStream>) -> Duration {
        let began = Instant::now();
        self.program.goes_on();
        if let Err(why) = self.recover(began + PATIENCE, company) {
            self.program.goes_on();
            panic!("not well within {PATIENCE:?}: {why}; it said:\n{}", self.program.last_words());
        }
        began.elapsed()
    }

    fn recover(&mut self, deadline: Instant, company: Vec<TcpStream>) -> Result<(), String> {
        let link = self.program.served(deadline)?;
        let (mut hand, at) = (self.hand(link), self.place());
        let ear = &mut self.ear;
        ear.until(Wanted::Silence, deadline, &mut || hand.stay())
            .map_err(|why| format!("no silence although all fingers have gone: {why}"))?;
        ear.until(Wanted::Sound, deadline, &mut || hand.touch(at))
            .map_err(|why| format!("no sound although a finger has come: {why}"))?;
        hand.lift();
        ear.until(Wanted::Silence, deadline, &mut || hand.stay())
            .map_err(|why| format!("no silence although the finger has gone: {why}"))?;
        ear.leave();
        drop((hand, company));
        self.settle(deadline)
    }

    /// Waits until the program holds no more than it may.
    fn settle(&self, deadline: Instant) -> Result<(), String> {
        loop {
            let (held, most) = (self.program.held(), self.most);
            let room = held.memory_kb <= most.memory_kb;
            if room && held.files <= most.files && held.threads <= most.threads {
                return Ok(());
            }
            if Instant::now() >= deadline {
                return Err(format!("held: expected at most {most:?}, found {held:?}"));
            }
            std::thread::sleep(LOOK);
        }
    }

    /// A link that says nothing yet.
    pub fn link(&self) -> Link {
        Link::open(self.program.task, self.program.links).unwrap()
    }

    /// A hand by datagrams, where they are received, or by a link.
    pub fn hand(&mut self, link: Link) -> Hand {
        match self.program.datagrams {
            Some(to) if self.random.uniform() < 0.5 => Hand::of_datagrams(to),
            _ => Hand::of_link(link),
        }
    }

    /// Strokes with a hand for so many seconds.
    pub fn stroke(&mut self, hand: &mut Hand, seconds: f64) {
        let began = Instant::now();
        while began.elapsed().as_secs_f64() < seconds {
            hand.touch(self.place());
            std::thread::sleep(LOOK);
        }
    }

    /// One of a hundred places on the film, in mm, so that drives are remembered.
    pub fn place(&mut self) -> [f64; 2] {
        [(); 2].map(|()| 15.0 + 13.0 * self.one_of(10) as f64)
    }

    /// A number from 0 on below another.
    pub fn one_of(&mut self, count: usize) -> usize {
        self.random.between(0.0, count as f64) as usize % count
    }
}
