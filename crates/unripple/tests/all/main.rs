//! Tests of unripple that share one program: a file a kind of truth. What needs a process of its own is beside it.

mod act_oracle;
mod act_readouts;
mod act_report;
#[path = "../bench/mod.rs"]
mod bench;
mod contrast_map_oracle;
mod contrast_oracle;
mod contrast_statistics;
mod design_golden;
mod drafting_oracle;
mod felt_contrast;
mod method_oracle;
mod past_drift;
mod past_reversal;
mod power_oracle;
mod published_surfaces;
mod sound_report;
mod surface_property;
mod touch_oracle;
mod waveform_stroke;
mod waveform_two_fingers;
#[path = "../window_common/mod.rs"]
mod window_common;
mod window_oracle;
