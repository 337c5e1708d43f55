//! Tests of unripple-physics that share one program: a file a kind of truth. What needs a process of its own is beside it.

mod cache_oracle;
mod coil_oracle;
#[path = "../coupled_common/mod.rs"]
mod coupled_common;
mod coupled_convergence;
mod coupled_oracle;
mod coupled_property;
mod design_air;
mod design_notes;
mod design_oracle;
#[path = "../exciter_common/mod.rs"]
mod exciter_common;
mod exciter_oracle;
mod finger_oracle;
mod loaded_modes_oracle;
#[path = "../../../unripple-plates/tests/modes_common/mod.rs"]
mod modes_common;
mod modes_property;
mod resonator_oracle;
mod response_error_oracle;
mod responses_oracle;
#[path = "../stepper_common/mod.rs"]
mod stepper_common;
mod stepper_convergence;
mod stepper_faults;
mod stepper_oracle;
mod stepper_property;
#[path = "../stepper_common/truth.rs"]
mod truth;
