//! Maps of the surface with its rim, actuators and targets.

use super::When;
use unripple::core::{Point, Surface};
use unripple::field::{self, Maps, Measured};
use unripple_plot::{ColourMap, Colours, Figure, Grid, Map, Marker, Panel, Ring, Scatter, Symbol, prefixed};

/// Number of straight pieces in which a full circle of a rim is drawn. At the size of a page a circle of so
/// many looks round.
const TURN: usize = 240;

/// What every map of one surface shows besides the field: rim, actuators, targets and their focal discs.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The rims of the surface and of its holes as closed polygons, in m.
    pub outline: Vec<Ring>,
    /// Actuators, targets and focal discs.
    pub markers: Vec<Marker>,
}

impl Scene {
    /// The rim and actuators of a surface, and targets with focal discs of `radius` (m); no discs if it is 0.
    pub fn new(surface: &Surface, targets: &[Vec<Point>], radius: f64) -> Self {
        let place = |p: &Point| [p.x, p.y];
        let rims = std::iter::once(surface.outline.rim(TURN)).chain(surface.outline.hole_rims(TURN));
        let outline = rims.map(|rim| rim.iter().map(place).collect()).collect();
        let mut markers: Vec<Marker> = surface
            .actuators
            .iter()
            .map(|a| Marker { at: place(&a.at), symbol: Symbol::Actuator, name: String::new() })
            .collect();
        for target in targets {
            if let [point] = target.as_slice() {
                markers.push(Marker { at: place(point), symbol: Symbol::Target, ..Marker::default() });
                if radius > 0.0 {
                    let disc = Symbol::Circle(radius);
                    markers.push(Marker { at: place(point), symbol: disc, ..Marker::default() });
                }
            }
        }
        Self { outline, markers }
    }

    /// This scene with markers where the velocity outside the focal discs is largest, each labelled with
    /// its share of the peak.
    fn with_worst_spots(&self, measured: &Measured) -> Self {
        // Small enough that its name stands beside it.
        let radius = measured.focal_radius_m / 8.0;
        let found = measured.targets.iter().filter_map(|target| {
            let (at, share) = (target.worst_spot_at_m?, 100.0 / target.worst_spot?);
            Some(Marker { at, symbol: Symbol::Circle(radius), name: format!("{share:.0} %") })
        });
        Self { outline: self.outline.clone(), markers: self.markers.iter().cloned().chain(found).collect() }
    }

    /// A map of one field over the surface.
    pub fn map(&self, grid: Grid, title: impl Into<String>, colours: Colours) -> Map {
        Map {
            grid,
            outline: self.outline.clone(),
            markers: self.markers.clone(),
            colours,
            title: title.into(),
            ..Map::default()
        }
    }

    /// A panel with one value per point of the maps: a field on a grid, or discs at the points of a
    /// library.
    fn panel(&self, maps: &Maps, values: &[f32], title: impl Into<String>, colours: Colours) -> Panel {
        if let Some(cells) = &maps.grid {
            return self.map(drawn(cells, values), title, colours).into();
        }
        Scatter {
            points: maps.points.iter().map(|point| [point.x, point.y]).collect(),
            values: values.iter().map(|value| f64::from(*value)).collect(),
            outline: self.outline.clone(),
            markers: self.markers.clone(),
            colours,
            title: title.into(),
            ..Scatter::default()
        }
        .into()
    }
}

/// Converts values at the points of a field's grid to a grid that can be drawn.
pub fn drawn(cells: &field::Grid, values: &[f32]) -> Grid {
    Grid {
        columns: cells.columns,
        rows: cells.rows,
        first: [cells.width / 2.0, cells.height / 2.0],
        pitch: [cells.width, cells.height],
        values: cells.spread(values),
    }
}

/// A colour scale with a bar in the prefixed unit that suits the largest value.
pub fn scale(what: &str, unit: &str, map: ColourMap, values: &[f32]) -> Colours {
    let largest = values.iter().fold(0.0, |m: f64, v| m.max(f64::from(v.abs())));
    let (multiplier, unit) = prefixed(largest, unit);
    Colours { title: format!("{what} ({unit})"), map, multiplier, ..Colours::default() }
}

fn velocity(map: ColourMap, values: &[f32]) -> Colours {
    scale("Velocity", "m/s", map, values)
}

fn displacement(map: ColourMap, values: &[f32]) -> Colours {
    scale("Displacement", "m", map, values)
}

/// A time (s) in ms, which no title is broken within.
fn milliseconds(seconds: f64) -> String {
    format!("{:.2}\u{a0}ms", seconds * 1e3)
}

/// An instant (s) as text for titles.
fn time(instant: f64) -> String {
    format!("t\u{a0}=\u{a0}{}", milliseconds(instant))
}

/// Difference of time, in s, below which two instants count as the same: half of the last digit in titles.
const AT_ONCE: f64 = 5e-6;

/// Maps of the velocity at the first target's instant, and of the displacement at the instant when that of
/// the first target is largest; titles state both instants. `None` without targets.
pub fn snapshots(scene: &Scene, measured: &Measured, when: When) -> Option<Figure> {
    let maps = &measured.maps;
    let (v, u) = (maps.at_peak.first()?, maps.at_displacement_peak.first()?);
    let (instant, apart) = (when.words(&measured.targets), u.instant - v.instant);
    let target = if measured.targets.len() > 1 { "first target" } else { "target" };
    let then = if apart.abs() < AT_ONCE {
        format!("at the {instant}")
    } else {
        let side = if apart > 0.0 { "after" } else { "before" };
        format!("{} {side} the {instant}", milliseconds(apart.abs()))
    };
    let left = format!("at the {instant}, {}", time(v.instant));
    let right = format!("when largest at the {target}, {}, {then}", time(u.instant));
    let described = format!(
        "Velocity of the surface at the {instant}, and displacement when it is largest at the {target}"
    );
    let velocity = velocity(ColourMap::Diverging, &v.velocity);
    let displacement = displacement(ColourMap::Diverging, &u.displacement);
    let left = scene.panel(maps, &v.velocity, left, velocity);
    let right = scene.panel(maps, &u.displacement, right, displacement);
    Some(side_by_side(left, right, &described))
}

/// Maps of the largest velocity and displacement at each place over the whole evaluated time.
pub fn peaks(scene: &Scene, measured: &Measured) -> Figure {
    let maps = &measured.maps;
    let title = "largest over time";
    let marked = scene.with_worst_spots(measured);
    let colours = velocity(ColourMap::Sequential, &maps.peak_velocity);
    let left = marked.panel(maps, &maps.peak_velocity, title, colours);
    let colours = displacement(ColourMap::Sequential, &maps.peak_displacement);
    let right = scene.panel(maps, &maps.peak_displacement, title, colours);
    let described = "Largest velocity and displacement of the surface over the time evaluated; small circles mark the largest velocity \
        elsewhere, as a share of the peak";
    side_by_side(left, right, described)
}

/// Range of the map of felt levels, in dB below its largest value.
const FELT_RANGE: f64 = 30.0;

/// Map of the largest felt level at each place over the whole evaluated time, in dB above the threshold of
/// touch; `None` where nothing moves.
pub fn felt(scene: &Scene, measured: &Measured) -> Option<Figure> {
    let maps = &measured.maps;
    let most = maps.felt_peak.iter().copied().fold(0.0, f32::max);
    if most <= 0.0 {
        return None;
    }
    let high = 20.0 * f64::from(most).log10();
    let low = high - FELT_RANGE;
    let level = |x: &f32| (20.0 * x.log10()).max(low as f32);
    let levels: Vec<f32> = maps.felt_peak.iter().map(level).collect();
    let colours = Colours {
        title: "Felt (dB above threshold)".into(),
        map: ColourMap::Sequential,
        low: Some(low),
        high: Some(high),
        ..Colours::default()
    };
    let panel = scene.panel(maps, &levels, "largest over time, as felt", colours);
    Some(Figure {
        width_mm: 89.0,
        panels: vec![panel],
        description:
            "Largest vibration of the surface over the time evaluated, in dB above the threshold of touch"
                .into(),
        ..Figure::default()
    })
}

fn side_by_side(left: Panel, right: Panel, description: &str) -> Figure {
    Figure {
        width_mm: 178.0,
        columns: 2,
        panels: vec![left, right],
        description: description.into(),
        ..Figure::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple::field::{Aim, Field};
    use unripple::focus::{Focuser, Options, Target};
    use unripple::physics::{ResponseOptions, design::papers_surface, responses};

    /// The paper's film up to 1 kHz, driven to focus at one place, as measured.
    fn measured(at: Point) -> (Surface, Measured) {
        let mut surface = papers_surface();
        surface.emission.band[1] = 1000.0;
        let plant = responses(&surface, &ResponseOptions::default()).unwrap();
        let options = Options { window: 0.03, ..Options::default() };
        let focused = Focuser::new(&plant, &options).unwrap().focus(&[Target::at(at)]).unwrap();
        let drive = focused.drive.as_emitted();
        let instant = focused.timing[0].instant as f64 / drive.rate();
        let field = Field::new(&plant, &drive, 8.0).unwrap();
        (surface, field.measure(&[Aim::at(at, instant)], None).unwrap())
    }

    /// The circles on a panel that bear a name: places and names.
    fn circles(panel: &Panel) -> Vec<([f64; 2], String)> {
        let Panel::Map(map) = panel else { panic!("a map") };
        let named = |m: &&Marker| matches!(m.symbol, Symbol::Circle(_)) && !m.name.is_empty();
        map.markers.iter().filter(named).map(|m| (m.at, m.name.clone())).collect()
    }

    #[test]
    fn a_circle_marks_the_largest_velocity_elsewhere() {
        let at = Point::from_mm(62.0, 90.0);
        let (surface, measured) = measured(at);
        let scene = Scene::new(&surface, &[vec![at]], measured.focal_radius_m);
        let figure = peaks(&scene, &measured);
        // From the map itself: the largest of its values farther from the target than the focal disc reaches.
        let maps = &measured.maps;
        let beyond = maps.points.iter().zip(&maps.peak_velocity);
        let beyond = beyond.filter(|(place, _)| place.distance(at) > measured.focal_radius_m);
        let (place, largest) = beyond.max_by(|a, b| a.1.total_cmp(b.1)).unwrap();
        let share = 100.0 * f64::from(*largest) / measured.targets[0].peak_velocity_m_s.abs();
        let expected = ([place.x, place.y], format!("{share:.0} %"));
        assert!((1.0..100.0).contains(&share) && place.distance(at) > 0.02, "{expected:?}");
        assert_eq!(circles(&figure.panels[0]), std::slice::from_ref(&expected));
        assert_eq!(circles(&figure.panels[1]), [], "of displacement, nothing is said");
        let drawn = figure.draw().unwrap();
        assert!(drawn.svg().contains(&format!(">{}</text>", expected.1)), "{}", expected.1);
    }
}
