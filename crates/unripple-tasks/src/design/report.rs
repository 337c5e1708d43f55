//! Report of the task `design`.

pub use unripple::physics::design::Design as Report;

impl crate::Report for Report {
    fn text(&self) -> String {
        self.to_string()
    }
}
