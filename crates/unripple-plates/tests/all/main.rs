//! Tests of unripple-plates that share one program: a file a kind of truth. What needs a process of its own is beside it.

mod air_oracle;
mod decay_bounds;
mod discs_oracle;
mod error_bounds;
mod memory;
#[path = "../modes_common/mod.rs"]
mod modes_common;
mod modes_convergence;
mod modes_oracle;
mod modes_readout;
mod outline_oracle;
#[path = "../round_common/mod.rs"]
mod round_common;
mod springs_oracle;
#[path = "../truth_common/mod.rs"]
mod truth_common;
