//! Counts of passed and failed tests in a test program's output.

/// Numbers of tests that passed and failed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Number of tests that passed.
    pub passed: usize,
    /// Number of tests that failed.
    pub failed: usize,
}

impl Tally {
    /// Reads the counts from the last `test result:` in a program's output: some programs run themselves, and their output may come before.
    /// `None` if there is none.
    pub fn of(output: &str) -> Option<Self> {
        let (_, result) = output.lines().rev().find_map(|line| line.split_once("test result: "))?;
        let count = |what: &str| {
            let part = result.split(['.', ';']).find_map(|part| part.trim().strip_suffix(what));
            part.and_then(|number| number.trim().parse().ok()).unwrap_or(0)
        };
        Some(Self { passed: count("passed"), failed: count("failed") })
    }

    /// Adds the counts of another program.
    pub fn add(&mut self, other: &Self) {
        self.passed += other.passed;
        self.failed += other.failed;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_result_counts() {
        let output = "test result: ok. 1 passed; 0 failed; 0 ignored; 0 measured\ntest a ... FAILED\n\
                      test result: FAILED. 12 passed; 3 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.01s\n";
        assert_eq!(Tally::of(output), Some(Tally { passed: 12, failed: 3 }));
        assert_eq!(Tally::of("Aborted"), None);
    }
}
