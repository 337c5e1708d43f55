//! Report of the task `focus`: the report on a drive and its field that `waveform`, `stroke` and `field` use too.

pub use unripple::act::Report;

impl crate::Report for Report {
    fn text(&self) -> String {
        Report::text(self)
    }
}
