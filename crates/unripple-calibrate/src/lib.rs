//! Recordings to responses: measuring, interpolating, fitting a model, following drift.
