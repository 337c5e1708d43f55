//! The velocity of the sheet under the contacts of actuators, from which the work of their forces follows.

use crate::Field;
use crate::modal::ModalField;
use crate::motion::Motion;
use unripple_core::{Drive, Mixture, Point, Shapes};
use unripple_linalg::{Mat, product};

impl Field<'_> {
    /// The drive that is simulated.
    pub fn drive(&self) -> &Drive {
        self.drive
    }

    /// Velocity under each contact at each sample of the drive, in m/s times the unit of the weights. A
    /// contact is a list of points (m) with weights, and its velocity the weighted sum of theirs. `None` for
    /// sampled responses, which are known at their stored points only.
    ///
    /// The drive acts as an impulse at each sample, and the velocity is the mean of those just before and just after it. An impulse does
    /// the work of its momentum times this mean on an oscillator of any mass, so that the work on the simulated sheet comes out exactly.
    pub fn under(&self, contacts: &[&[(Point, f64)]]) -> Option<Vec<Vec<f64>>> {
        self.source.under(contacts)
    }
}

impl ModalField<'_> {
    /// The velocities under contacts that [`Field::under`] returns.
    pub(crate) fn velocities_under(&self, contacts: &[&[(Point, f64)]]) -> Vec<Vec<f64>> {
        let weights = summed(self.responses.shapes.as_ref(), contacts);
        let channels = self.drive.channels();
        // Half of what the impulse of a sample adds to the velocity at once, per unit of each channel.
        let half = Mat::from_fn(contacts.len(), channels.len(), |c, a| {
            let added = |(m, pole): (usize, &unripple_core::Pole)| {
                weights[(c, m)] * pole.kick()[1] * self.responses.input[(a, m)]
            };
            self.responses.poles.iter().enumerate().map(added).sum::<f64>() / (2.0 * self.drive.rate())
        });
        let mut found = vec![Vec::with_capacity(self.drive.samples()); contacts.len()];
        let mut motion = Motion::new(self.responses, self.drive);
        while motion.next() < self.drive.samples() {
            let first = motion.next();
            let count = (self.drive.samples() - first).min(self.samples_at_once());
            let after = product(weights.as_ref(), motion.velocities(count).as_ref());
            for (c, found) in found.iter_mut().enumerate() {
                let added = |i: usize| {
                    (0..channels.len()).map(|a| half[(c, a)] * channels[a][first + i]).sum::<f64>()
                };
                found.extend((0..count).map(|i| after[(c, i)] - added(i)));
            }
        }
        found
    }
}

/// Weighted sums of shapes over each contact, contacts x shapes. Of combinations, those of the base are summed and then combined, since contacts
/// have many points.
pub(crate) fn summed(shapes: &dyn Shapes, contacts: &[&[(Point, f64)]]) -> Mat<f64> {
    if let Some(Mixture { base, mixing, columns }) = shapes.mixture() {
        let mixed = product(summed(base, contacts).as_ref(), mixing);
        return Mat::from_fn(contacts.len(), columns.len(), |c, m| mixed[(c, columns[m])]);
    }
    let mut weights = Mat::zeros(contacts.len(), shapes.modes());
    for (c, contact) in contacts.iter().enumerate() {
        let points: Vec<Point> = contact.iter().map(|(point, _)| *point).collect();
        let read = shapes.at_all(&points);
        for m in 0..shapes.modes() {
            weights[(c, m)] = contact.iter().enumerate().map(|(p, (_, w))| w * read[(p, m)]).sum();
        }
    }
    weights
}
