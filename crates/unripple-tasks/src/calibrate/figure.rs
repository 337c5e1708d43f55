//! The figure of a library's quality: signal-to-noise ratio and coherence over frequency, and which point
//! is bad in which frequency band.

use super::ask::Ask;
use super::campaign::Campaign;
use crate::TaskError;
use crate::{figures, folder, source};
use unripple_plot::{
    Along, Axis, Cells, ColourMap, Colours, Figure, Ink, Layer, Legend, Line, Panel, Plot, Rule,
};
use unripple_store::{BandQuality, Library, OutputDir};

/// Range of the signal-to-noise ratios that are drawn, in dB: from 0, where noise is all there is, to 40,
/// which is worth aiming at. Values beyond an end get its colour.
const SHOWN_DB: [f64; 2] = [0.0, 40.0];

/// Share of the responses that are worse than the lower of the two lines drawn.
const WORST: f64 = 0.1;

/// Ratio of a third-octave band's upper edge to its middle: 2^(1/6), so that neighbouring bands meet.
const HALF: f64 = 1.122_462_048_309_373;

/// Creates the folder for the figure, if the request names one, before anything is measured.
pub fn place(ask: &Ask) -> Result<Option<OutputDir>, TaskError> {
    let Some(place) = &ask.figure else { return Ok(None) };
    if *place == ask.output {
        return Err(TaskError::Input(format!(
            "`figure` {}: expected a folder of its own, found that of the library",
            place.display()
        )));
    }
    let reads = source::reads(&ask.surface).into_iter().chain([ask.output.clone()]);
    let reads: Vec<_> = reads.chain(ask.device.tape.clone()).collect();
    Ok(Some(OutputDir::create_beside(place, &reads)?))
}

/// Draws the figure of the library's quality, if the request names a folder for it, and puts the folder in
/// its place.
pub fn write(campaign: &mut Campaign<'_>, library: &Library) -> Result<(), TaskError> {
    let Some(out) = campaign.figure.take() else { return Ok(()) };
    let known = Known::of(library, campaign.places.probed)?;
    figures::write(&out, &[("bands", known.figure(campaign.settings.min_snr_db))])?;
    campaign.with_progress(|progress| folder::finish(out, progress))
}

/// Quality of a library's responses by frequency band, `[point][actuator][band]`.
struct Known<'a> {
    library: &'a Library,
    middles: &'a [f64],
    probed: Vec<Vec<Vec<BandQuality>>>,
    own: Vec<Vec<Vec<BandQuality>>>,
}

impl<'a> Known<'a> {
    fn of(library: &'a Library, probed: usize) -> Result<Self, TaskError> {
        let points = 0..library.points().len();
        let all = points.map(|point| Ok(library.band_quality(point)?.unwrap_or_default()));
        let mut all = all.collect::<Result<Vec<_>, TaskError>>()?;
        let own = all.split_off(probed.min(all.len()));
        let found = Self { library, middles: library.bands().unwrap_or_default(), probed: all, own };
        if found.responses().next().is_some() {
            return Ok(found);
        }
        Err(TaskError::Work(format!(
            "`figure`: expected a library with signal-to-noise ratios by band, found none in {}: nothing in it was measured \
             with sweeps, or an earlier version of this program measured it; measure again into another folder",
            library.path().display()
        )))
    }

    /// Responses whose quality is known: those at probed points, or at the actuators if there are no
    /// others.
    fn responses(&self) -> impl Iterator<Item = &[BandQuality]> {
        let known = |point: &&Vec<Vec<BandQuality>>| point.iter().flatten().any(is_known);
        let points = if self.probed.iter().any(|point| known(&point)) { &self.probed } else { &self.own };
        points.iter().flatten().map(Vec::as_slice).filter(|row| row.iter().any(is_known))
    }

    fn figure(&self, least_db: f64) -> Figure {
        let signal = |band: &BandQuality| band.signal_to_noise_db.max(SHOWN_DB[0]);
        let signal = |band: &BandQuality| if is_known(band) { signal(band) } else { f64::NAN };
        let mut layers = self.lines(signal);
        let label = format!("{least_db:.0} dB");
        layers.push(Rule { at: least_db, along: Along::X, label, ..Rule::default() }.into());
        let y = Axis::new("Signal to noise (dB)").from(SHOWN_DB[0]);
        let mut panels: Vec<Panel> = vec![self.plot(y, layers)];
        if self.responses().flatten().any(|band| band.coherence.is_finite()) {
            // A little more than 1, so that a line at 1 is seen whole.
            let y = Axis::new("Coherence (0 to 1)").from(0.0).to(1.04);
            panels.push(self.plot(y, self.lines(|band| band.coherence)));
        }
        let numbers = (1..=self.probed.len()).map(|number| number.to_string()).collect();
        panels.extend(self.worst(&self.probed, numbers, "Point", "The worst actuator at each point"));
        let names = self.library.plan().ports.iter().map(|port| port.name.clone()).collect();
        let title = "The worst actuator at each sensor";
        panels.extend(self.worst(&self.own, names, "Sensor of", title));
        let library = self.library.path().display();
        Figure {
            width_mm: 130.0,
            panels,
            description: format!("Signal to noise and coherence of {library} by thirds of an octave"),
            ..Figure::default()
        }
    }

    /// Edges of all third-octave bands, in Hz.
    fn edges(&self) -> Vec<f64> {
        let last = self.middles.last().map(|hz| hz * HALF);
        self.middles.iter().map(|hz| hz / HALF).chain(last).collect()
    }

    /// The same axis for all panels, one above the other.
    fn across(&self) -> Axis {
        let edges = self.edges();
        let ends = edges.first().zip(edges.last());
        let axis = Axis::log("Frequency (Hz)");
        ends.map_or(axis.clone(), |(low, high)| axis.from(*low).to(*high))
    }

    fn plot(&self, y: Axis, layers: Vec<Layer>) -> Panel {
        // Inside the frame it would hide a line that falls steeply.
        Plot { x: self.across(), y, layers, legend: Legend::Above, height_mm: Some(38.0), ..Plot::default() }
            .into()
    }

    /// Median and worst tenth over all responses, band by band.
    fn lines(&self, value: impl Fn(&BandQuality) -> f64) -> Vec<Layer> {
        let sorted = |band: usize| {
            let values = self.responses().filter_map(|row| row.get(band)).map(&value);
            let mut values: Vec<f64> = values.filter(|value| !value.is_nan()).collect();
            values.sort_unstable_by(f64::total_cmp);
            values
        };
        let bands: Vec<Vec<f64>> = (0..self.middles.len()).map(sorted).collect();
        let at = |share: f64| {
            let one = |values: &Vec<f64>| {
                let place = share * values.len().saturating_sub(1) as f64;
                values.get(place as usize).copied().unwrap_or(f64::NAN)
            };
            bands.iter().map(one).collect::<Vec<f64>>()
        };
        let line = |share: f64, label: &str, ink: usize| {
            let (x, y, label) = (self.middles.to_vec(), at(share), label.to_owned());
            Layer::from(Line { x, y, label, ink: Ink::Palette(ink), ..Line::default() })
        };
        vec![line(0.5, "median of all responses", 0), line(WORST, "worst tenth", 1)]
    }

    /// Map of points against bands, each coloured by the worst of its responses; `None` if the quality of
    /// none is known.
    fn worst(
        &self,
        points: &[Vec<Vec<BandQuality>>],
        rows: Vec<String>,
        label: &str,
        title: &str,
    ) -> Option<Panel> {
        let one = |point: &Vec<Vec<BandQuality>>, band: usize| {
            let values = point.iter().filter_map(|row| row.get(band)).filter(|band| is_known(band));
            let worst = values.map(|band| band.signal_to_noise_db).reduce(f64::min);
            worst.map_or(f64::NAN, |db| db.max(SHOWN_DB[0]))
        };
        let bands = 0..self.middles.len();
        let values: Vec<f64> =
            points.iter().flat_map(|point| bands.clone().map(move |band| one(point, band))).collect();
        let colours = Colours {
            title: "Signal to noise (dB)".into(),
            map: ColourMap::Sequential,
            low: Some(SHOWN_DB[0]),
            high: Some(SHOWN_DB[1]),
            ..Colours::default()
        };
        let known = values.iter().any(|value| value.is_finite()) && rows.len() == points.len();
        let (x, label, title) = (self.across(), label.to_owned(), title.to_owned());
        let cells = Cells { edges: self.edges(), rows, values, x, label, colours, title, height_mm: None };
        known.then(|| cells.into())
    }
}

fn is_known(band: &BandQuality) -> bool {
    !band.signal_to_noise_db.is_nan()
}
