//! What `focus` found: the report of an act of focusing, shared with `waveform`, `stroke` and `field`.

pub use unripple::act::Report;

impl crate::Report for Report {
    fn text(&self) -> String {
        Report::text(self)
    }
}
