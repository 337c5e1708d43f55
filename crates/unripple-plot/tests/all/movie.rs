//! An animation decoded frame by frame and compared with the field it shows.

use unripple_plot::*;

/// Frames as whole pictures of colours, with the number of plays and the delay of each in seconds.
fn frames(file: &[u8]) -> (Vec<Vec<Rgb>>, usize, u32, f64) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
    let info = reader.info().clone();
    let palette = info.palette.clone().unwrap();
    let colour = |i: &u8| {
        Rgb(palette[3 * usize::from(*i)], palette[3 * usize::from(*i) + 1], palette[3 * usize::from(*i) + 2])
    };
    let (width, height) = (info.width as usize, info.height as usize);
    let control = info.animation_control.unwrap();
    let mut picture = vec![Rgb::BLACK; width * height];
    let mut frames = Vec::new();
    let mut delay = 0.0;
    for _ in 0..control.num_frames {
        let mut buffer = vec![0; width * height];
        let part = reader.next_frame(&mut buffer).unwrap();
        let place = *reader.info().frame_control().unwrap();
        delay = f64::from(place.delay_num) / f64::from(place.delay_den);
        for (row, indices) in buffer[..part.buffer_size()].chunks_exact(part.line_size).enumerate() {
            let start = (place.y_offset as usize + row) * width + place.x_offset as usize;
            for (to, index) in picture[start..].iter_mut().zip(&indices[..part.width as usize]) {
                *to = colour(index);
            }
        }
        frames.push(picture.clone());
    }
    (frames, width, control.num_plays, delay)
}

fn shot(level: f64) -> Shot {
    let mut grid = Grid { columns: 20, rows: 10, first: [0.5, 0.5], pitch: [1.0, 1.0], values: Vec::new() };
    grid.values = (0..200).map(|i| if i % 20 < 10 { level } else { -level }).collect();
    Shot { grid, caption: format!("{level}") }
}

fn off(a: Rgb, b: Rgb) -> u8 {
    a.0.abs_diff(b.0).max(a.1.abs_diff(b.1)).max(a.2.abs_diff(b.2))
}

#[test]
fn every_frame_shows_its_field_on_the_shared_scale_and_repeats_for_ever() {
    let levels = [0.0, 0.5, 1.0, -0.25];
    let outline = vec![vec![[0.0, 0.0], [20.0, 0.0], [20.0, 10.0], [0.0, 10.0]]];
    let movie = Movie {
        shots: levels.iter().map(|level| shot(*level)).collect(),
        outline,
        colours: Colours { title: "v".into(), ..Colours::default() },
        width_px: 300,
        rate: 20.0,
        ..Movie::default()
    };
    let (frames, width, plays, delay) = frames(&movie.apng().unwrap());
    assert_eq!((frames.len(), width, plays), (4, 300, 0));
    assert!((delay - 0.05).abs() < 1e-9);
    let middle = frames[0].len() / width * 45 / 100;
    for (frame, level) in frames.iter().zip(levels) {
        for (x, sign) in [(40, 1.0), (180, -1.0)] {
            let expected = ColourMap::Diverging.colour((sign * level + 1.0) / 2.0);
            let found = frame[middle * width + x];
            assert!(off(found, expected) <= 6, "{level} at {x}: {found} for {expected}");
        }
        assert_eq!(frame[2 * width + 2], Rgb::WHITE);
    }
    let black = |frame: &Vec<Rgb>| frame[..14 * width].iter().filter(|c| off(**c, Rgb::BLACK) < 90).count();
    assert!(frames.iter().all(|frame| black(frame) > 4), "captions are missing");
}

#[test]
fn unusable_movies_are_refused() {
    let good = Movie { shots: vec![shot(1.0), shot(0.5)], ..Movie::default() };
    assert!(matches!(Movie::default().apng(), Err(PlotError::Empty { .. })));
    let mut short = good.clone();
    short.shots[1].grid.values.pop();
    assert!(matches!(short.apng(), Err(PlotError::Length { expected: 200, found: 199, .. })));
    let mut turned = good.clone();
    (turned.shots[1].grid.columns, turned.shots[1].grid.rows) = (10, 20);
    assert!(matches!(turned.apng(), Err(PlotError::Length { expected: 20, found: 10, .. })));
    for movie in [
        Movie { rate: 0.0, ..good.clone() },
        Movie { rate: f64::NAN, ..good.clone() },
        Movie { width_px: 10, ..good.clone() },
    ] {
        assert!(matches!(movie.apng(), Err(PlotError::Range { .. })));
    }
}

#[test]
fn a_frame_without_any_value_shows_an_empty_field() {
    let mut empty = shot(1.0);
    empty.grid.values.fill(f64::NAN);
    let movie = Movie { shots: vec![shot(1.0), empty], ..Movie::default() };
    let (frames, width, ..) = frames(&movie.apng().unwrap());
    let middle = frames[1].len() / width * 45 / 100;
    assert_eq!(frames[1][middle * width + 60], Rgb::WHITE);
    assert_ne!(frames[0][middle * width + 60], Rgb::WHITE);
}
