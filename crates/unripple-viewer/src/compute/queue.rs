//! Tasks that wait to be computed.

use super::Task;
use std::collections::VecDeque;

/// Largest number of computations of a focus that may wait. Design figures are not counted: of these one waits at most.
const MOST: usize = 16;

/// Tasks to be computed, in the order in which they were asked for.
#[derive(Default)]
pub struct Queue {
    waiting: VecDeque<Task>,
}

impl Queue {
    /// Adds a task. Design figures take the place of those that wait for an earlier edit, and are never refused: pages would have no
    /// figures of the surface that they show. A focus is refused if too many wait.
    ///
    /// # Errors
    /// The page that asked for the refused task, and the reason.
    pub fn push(&mut self, task: Task) -> Result<(), (u64, &'static str)> {
        match &task {
            Task::Design(_) => self.waiting.retain(|other| !matches!(other, Task::Design(_))),
            Task::Measure { page, .. } | Task::Compare { page, .. } => {
                let acts = self.waiting.iter().filter(|other| !matches!(other, Task::Design(_)));
                if acts.count() >= MOST {
                    return Err((*page, "measuring: expected one after the other, found too many at once"));
                }
            }
        }
        self.waiting.push_back(task);
        Ok(())
    }

    /// Removes the next task from the queue.
    pub fn next(&mut self) -> Option<Task> {
        self.waiting.pop_front()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edition::Edition;
    use crate::wire::Measure;
    use std::sync::Arc;
    use unripple::physics::design::papers_surface;

    fn edition(edit: u64) -> Arc<Edition> {
        Arc::new(Edition { edit, surface: papers_surface() })
    }

    /// What waits: edits as they are, acts by 100 and the edit that they are asked of.
    fn drained(queue: &mut Queue) -> Vec<u64> {
        let name = |task| match task {
            Task::Design(edition) => edition.edit,
            Task::Measure { of, .. } | Task::Compare { of, .. } => 100 + of.edit,
        };
        std::iter::from_fn(|| queue.next()).map(name).collect()
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
}
