//! How accurate modes are to be, and with how much error they are still of use.

/// Largest error with which modes are given where no accuracy was asked for: a hundredth of a frequency. With twice this value, a mode
/// may be said to be where its neighbour is.
const USEFUL: f64 = 1e-2;

/// The relative error of natural frequencies that is aimed at, and the largest that is accepted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// The relative error aimed at: the solution is refined until its bound is at most this, from 1e-12 to 0.1.
    pub aim: f64,
    /// The largest relative error with which modes are still given, at least `aim`: where the aim is out of reach, the best that can be
    /// reached is given if it is within this, with its error ([`Modes::error`](crate::Modes::error)), and refused if not.
    pub most: f64,
}

impl Accuracy {
    /// An accuracy (a ratio) to aim at; where it is out of reach, the best that can be had, as long as frequencies are right to one part in a
    /// hundred.
    ///
    /// ```
    /// # use unripple_plates::Accuracy;
    /// assert_eq!(Accuracy::or_best(1e-4), Accuracy { aim: 1e-4, most: 1e-2 });
    /// assert_eq!(Accuracy::from(1e-4), Accuracy { aim: 1e-4, most: 1e-4 });
    /// ```
    pub fn or_best(aim: f64) -> Self {
        Self { aim, most: USEFUL.max(aim) }
    }

    /// The accuracy (a ratio) that was `asked` for, refused where it is out of reach; where none was, `default` or the best that can be had.
    pub fn of(asked: Option<f64>, default: f64) -> Self {
        asked.map_or(Self::or_best(default), Self::from)
    }
}

impl From<f64> for Accuracy {
    /// An accuracy (a ratio) that is refused where it is out of reach.
    fn from(accuracy: f64) -> Self {
        Self { aim: accuracy, most: accuracy }
    }
}
