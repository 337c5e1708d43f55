//! The requested accuracy of modes, and the largest error that is accepted if it cannot be reached.

/// Largest relative error of frequencies that is accepted where no accuracy was requested. With twice this
/// value, the error could exceed the distance between neighbouring modes.
const USEFUL: f64 = 1e-2;

/// Two limits for the relative error of natural frequencies: the error aimed at, and the largest error
/// accepted if that cannot be reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// The relative error aimed at, from 1e-12 to 0.1: the solution is refined until the bound of its error
    /// is at most this.
    pub aim: f64,
    /// The largest relative error that is accepted, at least `aim`. If `aim` cannot be reached, the best
    /// solution is returned with its error ([`Modes::error`](crate::Modes::error)) if that error is at most
    /// this, and refused otherwise.
    pub most: f64,
}

impl Accuracy {
    /// Aims at the relative error `aim`; if it cannot be reached, accepts the best solution whose
    /// frequencies have an error of at most one per cent.
    ///
    /// ```
    /// # use unripple_plates::Accuracy;
    /// assert_eq!(Accuracy::or_best(1e-4), Accuracy { aim: 1e-4, most: 1e-2 });
    /// assert_eq!(Accuracy::from(1e-4), Accuracy { aim: 1e-4, most: 1e-4 });
    /// ```
    pub fn or_best(aim: f64) -> Self {
        Self { aim, most: USEFUL.max(aim) }
    }

    /// The accuracy (a relative error) in `asked`, refused if it cannot be reached; if `asked` is `None`,
    /// aims at `default` and accepts the best solution as [`Accuracy::or_best`] does.
    pub fn of(asked: Option<f64>, default: f64) -> Self {
        asked.map_or(Self::or_best(default), Self::from)
    }
}

impl From<f64> for Accuracy {
    /// An accuracy (a relative error) that is refused if it cannot be reached.
    fn from(accuracy: f64) -> Self {
        Self { aim: accuracy, most: accuracy }
    }
}
