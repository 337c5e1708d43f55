//! The queue of tasks to be computed, and the task that is being computed.

use super::{Asked, Task};
use crate::stop::{Stop, Underway};
use std::collections::VecDeque;

/// Largest number of computations of a focus that may wait. Design figures are not counted: of these one waits at most.
const MOST: usize = 16;

/// Tasks to be computed, in the order in which they were requested, and the one that is being computed.
#[derive(Default)]
pub struct Queue {
    waiting: VecDeque<Task>,
    running: Option<(Option<Asked>, Underway)>,
}

impl Queue {
    /// Adds a task. One for design figures replaces one that waits for an earlier edit, and is never
    /// refused, since pages would have no figures of the surface that they show. One for a focus is refused
    /// if too many wait.
    ///
    /// # Errors
    /// The page that requested the refused task, and the reason.
    pub fn push(&mut self, task: Task) -> Result<(), (u64, &'static str)> {
        match task.asked() {
            None => {
                self.waiting.retain(|other| other.asked().is_some());
                if let Some((None, underway)) = &self.running {
                    underway.hurry();
                }
            }
            Some(Asked { page, .. }) => {
                let acts = self.waiting.iter().filter(|other| other.asked().is_some());
                if acts.count() >= MOST {
                    return Err((page, "measuring: expected one after the other, found too many at once"));
                }
            }
        }
        self.waiting.push_back(task);
        Ok(())
    }

    /// Removes the next task from the queue, and returns it with its cancellation flag; `None` while another
    /// task is being computed.
    pub fn next(&mut self) -> Option<(Task, Stop)> {
        if self.running.is_some() {
            return None;
        }
        let task = self.waiting.pop_front()?;
        let underway = Underway::default();
        let stop = underway.stop();
        self.running = Some((task.asked(), underway));
        Some((task, stop))
    }

    /// Records that the task which was being computed has ended.
    pub fn done(&mut self) {
        self.running = None;
    }

    /// Cancels the tasks that answer the requests for which `which` is true. Returns the requests of those
    /// that were waiting, which the caller must answer, and whether the task that is being computed is
    /// cancelled.
    pub fn give_up(&mut self, which: impl Fn(&Asked) -> bool) -> (Vec<Asked>, bool) {
        let mut removed = Vec::new();
        self.waiting.retain(|task| {
            let asked = task.asked().filter(&which);
            removed.extend(asked);
            asked.is_none()
        });
        let runs = match &self.running {
            Some((Some(asked), underway)) if which(asked) => {
                underway.give_up();
                true
            }
            _ => false,
        };
        (removed, runs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edition::Edition;
    use crate::wire::Measure;
    use std::sync::Arc;
    use unripple::physics::design::papers_surface;
    use unripple_tasks::Progress;

    fn edition(edit: u64) -> Arc<Edition> {
        Arc::new(Edition { edit, surface: papers_surface() })
    }

    /// Tasks that wait, as numbers: an edit as its own, a measurement or comparison as 100 plus the edit that it is asked of.
    fn drained(queue: &mut Queue) -> Vec<u64> {
        let name = |task| match task {
            Task::Design(edition) => edition.edit,
            Task::Measure { of, .. } | Task::Compare { of, .. } => 100 + of.edit,
        };
        let next = || {
            queue.done();
            queue.next()
        };
        std::iter::from_fn(next).map(|(task, _)| name(task)).collect()
    }

    #[test]
    fn a_surface_gives_way_to_a_newer_one_and_to_nothing_else() {
        let act = |edit| Task::Measure { measure: Measure::default(), of: edition(edit), page: 7 };
        let mut queue = Queue::default();
        queue.push(Task::Design(edition(1))).unwrap();
        let refused = (0..20).filter_map(|_| queue.push(act(1)).err()).filter(|(page, _)| *page == 7).count();
        queue.push(Task::Design(edition(2))).unwrap();
        assert!(queue.push(act(2)).is_err());
        queue.push(Task::Design(edition(3))).unwrap();
        let mut expected = vec![101; 16];
        expected.push(3);
        assert_eq!(drained(&mut queue), expected);
        assert_eq!(refused, 4);
        // In the order in which it was asked for.
        for task in [Task::Design(edition(4)), act(4), Task::Design(edition(5)), act(5)] {
            queue.push(task).unwrap();
        }
        assert_eq!(drained(&mut queue), [104, 5, 105]);
    }

    #[test]
    fn what_is_asked_for_no_more_is_given_up() {
        let act = |page, id| {
            let measure = Measure { id, ..Measure::default() };
            Task::Measure { measure, of: edition(id), page }
        };
        let mut queue = Queue::default();
        for task in [act(7, 1), Task::Design(edition(2)), act(8, 3), act(7, 4)] {
            queue.push(task).unwrap();
        }
        let (_, stop) = queue.next().unwrap();
        assert!(queue.next().is_none(), "two are computed at once");
        let (removed, runs) = queue.give_up(|asked| asked.page == 8);
        assert!(matches!(removed[..], [Asked { page: 8, id: 3, .. }]) && !runs && !stop.watch().cancelled());
        let (removed, runs) = queue.give_up(|asked| asked.page == 7);
        assert!(matches!(removed[..], [Asked { page: 7, id: 4, .. }]) && runs && stop.watch().cancelled());
        assert_eq!(drained(&mut queue), [2]);
    }
}
