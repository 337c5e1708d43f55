//! Errors of mounting: actuators that are some way off their nominal places.

use crate::{PlacementError, Plant};
use unripple_core::{ModalResponses, Point};
use unripple_linalg::Mat;

/// Offsets of an actuator from its nominal place by errors of mounting: nodes of a quadrature, all of the
/// same weight.
///
/// Errors along both axes are independent and uniform. Four nodes, the product of two-point Gauss-Legendre rules, integrate polynomials of
/// degree three in each coordinate.
#[derive(Debug)]
pub struct Mounting(Vec<[f64; 2]>);

/// Responses to actuators at every node of the errors of mounting.
#[derive(Debug)]
pub struct Inputs {
    /// Responses to the actuators at their nominal places.
    pub nominal: ModalResponses,
    /// Input weights at every node, actuators x modes.
    nodes: Vec<Mat<f64>>,
}

impl Mounting {
    /// The nodes for errors of up to `error` (m) along each axis; a single node if `error` is 0.
    pub fn of(error: f64) -> Self {
        let at = error / 3.0_f64.sqrt();
        let nodes = [[-at, -at], [at, -at], [-at, at], [at, at]];
        Self(if error == 0.0 { vec![[0.0; 2]] } else { nodes.to_vec() })
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.0.len()
    }

    /// The responses to the kept actuators, which have no error, and to one more at each of `places` (m), for every node. If an actuator
    /// cannot be at a node (beyond the rim), it is taken to be at the place itself.
    ///
    /// # Errors
    /// Those of [`Plant::responses`].
    pub fn inputs(&self, plant: &Plant, places: &[Point]) -> Result<Inputs, PlacementError> {
        let nominal = plant.responses(places)?;
        let moved = |[x, y]: [f64; 2]| -> Vec<Point> {
            let there = |place: &Point| Point::new(place.x + x, place.y + y);
            places
                .iter()
                .map(|place| Some(there(place)).filter(|p| plant.holds(*p)).unwrap_or(*place))
                .collect()
        };
        let nodes = match self.0.as_slice() {
            [_] => vec![nominal.input.clone()],
            nodes => {
                let inputs = nodes.iter().map(|node| Ok(plant.responses(&moved(*node))?.input));
                inputs.collect::<Result<_, PlacementError>>()?
            }
        };
        Ok(Inputs { nominal, nodes })
    }
}

impl Inputs {
    /// Number of modes.
    pub fn modes(&self) -> usize {
        self.nominal.poles.len()
    }

    /// The largest input weight of all modes, actuators and nodes, in the unit of [`ModalResponses::input`].
    pub fn largest(&self) -> f64 {
        let all = self.nodes.iter().flat_map(|node| node.col_iter().flat_map(|column| column.iter()));
        all.fold(0.0, |most: f64, weight| most.max(weight.abs())).max(f64::MIN_POSITIVE)
    }

    /// The input weights at every node in single precision, modes x actuators, relative to the [`largest`](Self::largest).
    pub fn scaled(&self) -> Vec<Mat<f32>> {
        let largest = self.largest();
        let scaled = |node: &Mat<f64>| {
            Mat::from_fn(node.ncols(), node.nrows(), |m, a| (node[(a, m)] / largest) as f32)
        };
        self.nodes.iter().map(scaled).collect()
    }
}
