//! Pixels to PNG files.

use crate::PlotError;
use crate::colour::Rgb;
use crate::colourmap::{ColourMap, LEVELS};
use resvg::{tiny_skia, usvg};
use std::fmt::Display;

pub(crate) fn image_error(what: &'static str) -> impl Fn(&dyn Display) -> PlotError {
    move |found| PlotError::Image { what, found: found.to_string() }
}

/// Index of the transparent colour in a palette of a colour map; the map's colours follow.
pub(crate) const CLEAR: u8 = 0;

/// Palette of a colour map, the transparent colour first.
pub(crate) fn palette(map: ColourMap) -> Vec<u8> {
    std::iter::once(&Rgb::WHITE).chain(map.colours()).flat_map(|&Rgb(r, g, b)| [r, g, b]).collect()
}

/// Index into [`palette`] of a position from 0 to 1 along the map; transparent where it is not a number.
pub(crate) fn index(position: f64) -> u8 {
    if position.is_nan() {
        return CLEAR;
    }
    // Below 256 by the table's size.
    (1 + (position.clamp(0.0, 1.0) * (LEVELS - 1) as f64 + 0.5) as usize).min(LEVELS) as u8
}

/// A file of indices into a palette of a colour map, row by row from the top.
pub(crate) fn indexed(
    width: usize,
    height: usize,
    indices: &[u8],
    map: ColourMap,
) -> Result<Vec<u8>, PlotError> {
    let failed = image_error("writing a field's image");
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width as u32, height as u32);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette(map));
    encoder.set_trns(vec![0]);
    encoder.set_compression(png::Compression::Fast);
    encoder.set_filter(png::Filter::Paeth);
    let mut writer = encoder.write_header().map_err(|e| failed(&e))?;
    writer.write_image_data(indices).map_err(|e| failed(&e))?;
    writer.finish().map_err(|e| failed(&e))?;
    Ok(file)
}

/// A drawing as the renderer reads it, text with the embedded typeface.
pub(crate) fn tree(svg: &str) -> Result<usvg::Tree, PlotError> {
    let options = usvg::Options {
        fontdb: crate::font::database(),
        font_family: "DejaVu Sans".to_owned(),
        ..usvg::Options::default()
    };
    usvg::Tree::from_str(svg, &options).map_err(|e| image_error("reading the drawing")(&e))
}

/// Renders a drawing at a number of pixels for each of its CSS pixels (1/96 inch), over a background if any.
pub(crate) fn render(svg: &str, scale: f32, background: Option<Rgb>) -> Result<tiny_skia::Pixmap, PlotError> {
    rendered(&tree(svg)?, scale, background)
}

/// Renders a drawing that has been read, as [`render`] does.
pub(crate) fn rendered(
    tree: &usvg::Tree,
    scale: f32,
    background: Option<Rgb>,
) -> Result<tiny_skia::Pixmap, PlotError> {
    let (width, height) = (tree.size().width() * scale, tree.size().height() * scale);
    let mut pixmap = tiny_skia::Pixmap::new(width.round() as u32, height.round() as u32)
        .ok_or_else(|| image_error("rendering the drawing")(&"no memory for its pixels"))?;
    if let Some(Rgb(r, g, b)) = background {
        pixmap.fill(tiny_skia::Color::from_rgba8(r, g, b, 255));
    }
    resvg::render(tree, tiny_skia::Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    Ok(pixmap)
}

/// A file of an opaque picture, red, green and blue, with its resolution noted.
pub(crate) fn opaque(pixmap: &tiny_skia::Pixmap, dpi: f64) -> Result<Vec<u8>, PlotError> {
    let failed = image_error("writing the picture");
    let rgb: Vec<u8> =
        pixmap.data().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    let mut file = Vec::with_capacity(rgb.len() / 8);
    let mut encoder = png::Encoder::new(&mut file, pixmap.width(), pixmap.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    let per_metre = (dpi / 0.0254).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header().map_err(|e| failed(&e))?;
    writer.write_image_data(&rgb).map_err(|e| failed(&e))?;
    writer.finish().map_err(|e| failed(&e))?;
    Ok(file)
}
