//! A drawing as a page of PDF 1.7 (ISO 32000-1): what the renderer makes of the SVG, curves as curves and text as outlines.

use crate::PlotError;
use crate::encode::{image_error, tree};
use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{FunctionShadingType, LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, TextStr};
use resvg::tiny_skia::{self, PathSegment, Point as Place, Transform};
use resvg::usvg::{self, FillRule, Group, ImageKind, Node, Paint, PaintOrder};

/// How hard streams are compressed, from 1 to 10: the default of zlib. More takes twice as long for a few per cent.
const LEVEL: u8 = 6;

/// Samples of a gradient, as many as the colour maps have levels.
const SAMPLES: usize = 256;

/// Objects of the file before those that drawings need: catalogue, pages, page, content, information.
const FIRST: i32 = 6;

/// The page of a drawing in SVG, `size` points wide and high, with a title.
pub(crate) fn page(svg: &str, size: [f64; 2], title: &str) -> Result<Vec<u8>, PlotError> {
    let tree = tree(svg)?;
    let [width, height] = size.map(|points| points as f32);
    let mut page =
        Page { content: Content::new(), opacities: Vec::new(), shadings: Vec::new(), images: Vec::new() };
    // From the renderer's pixels, which go down, to points, which go up.
    let scale = [width / tree.size().width(), height / tree.size().height()];
    page.content.transform([scale[0], 0.0, 0.0, -scale[1], 0.0, height]);
    page.group(tree.root())?;
    Ok(page.file([width, height], title))
}

/// A page under construction.
struct Page {
    content: Content,
    /// Pairs of opacities of fills and strokes, as graphics states.
    opacities: Vec<[f32; 2]>,
    /// Ends of gradients, and the colours of their samples.
    shadings: Vec<([f32; 4], Vec<u8>)>,
    /// Width and height of images in pixels, their colours, and their opacities.
    images: Vec<([i32; 2], Vec<u8>, Vec<u8>)>,
}

impl Page {
    fn group(&mut self, group: &Group) -> Result<(), PlotError> {
        self.content.save_state();
        if let Some(clip) = group.clip_path() {
            let place = group.abs_transform().pre_concat(clip.transform());
            for node in clip.root().children() {
                let Node::Path(path) = node else { continue };
                self.outline(path.data(), place);
                match path.fill().map_or(FillRule::NonZero, usvg::Fill::rule) {
                    FillRule::NonZero => self.content.clip_nonzero(),
                    FillRule::EvenOdd => self.content.clip_even_odd(),
                };
            }
            self.content.end_path();
        }
        for node in group.children() {
            match node {
                Node::Group(group) => self.group(group)?,
                Node::Path(path) => self.path(path),
                Node::Image(image) => self.image(image)?,
                Node::Text(text) => self.group(text.flattened())?,
            }
        }
        self.content.restore_state();
        Ok(())
    }

    fn path(&mut self, path: &usvg::Path) {
        let both: [fn(&mut Self, &usvg::Path); 2] = match path.paint_order() {
            PaintOrder::FillAndStroke => [Self::fill, Self::stroke],
            PaintOrder::StrokeAndFill => [Self::stroke, Self::fill],
        };
        both.iter().for_each(|paint| paint(self, path));
    }

    fn fill(&mut self, path: &usvg::Path) {
        let Some(fill) = path.fill() else { return };
        self.content.save_state();
        self.opacity([fill.opacity().get(), 1.0]);
        let even_odd = fill.rule() == FillRule::EvenOdd;
        match fill.paint() {
            Paint::LinearGradient(gradient) => {
                self.outline(path.data(), path.abs_transform());
                if even_odd {
                    self.content.clip_even_odd()
                } else {
                    self.content.clip_nonzero()
                };
                self.content.end_path();
                self.content.transform(matrix(path.abs_transform().pre_concat(gradient.transform())));
                let name = format!("G{}", self.shadings.len());
                self.shadings.push(sampled(gradient));
                self.content.shading(Name(name.as_bytes()));
            }
            paint => {
                let [r, g, b] = colour(paint);
                self.content.set_fill_rgb(r, g, b);
                self.outline(path.data(), path.abs_transform());
                if even_odd {
                    self.content.fill_even_odd()
                } else {
                    self.content.fill_nonzero()
                };
            }
        }
        self.content.restore_state();
    }

    fn stroke(&mut self, path: &usvg::Path) {
        let Some(stroke) = path.stroke() else { return };
        let [r, g, b] = colour(stroke.paint());
        self.content.save_state();
        self.opacity([1.0, stroke.opacity().get()]);
        // Widths and dashes are in the path's own unit.
        self.content.transform(matrix(path.abs_transform()));
        self.content.set_stroke_rgb(r, g, b).set_line_width(stroke.width().get());
        self.content.set_miter_limit(stroke.miterlimit().get());
        self.content.set_line_cap(match stroke.linecap() {
            usvg::LineCap::Butt => LineCapStyle::ButtCap,
            usvg::LineCap::Round => LineCapStyle::RoundCap,
            usvg::LineCap::Square => LineCapStyle::ProjectingSquareCap,
        });
        self.content.set_line_join(match stroke.linejoin() {
            usvg::LineJoin::Round => LineJoinStyle::RoundJoin,
            usvg::LineJoin::Bevel => LineJoinStyle::BevelJoin,
            usvg::LineJoin::Miter | usvg::LineJoin::MiterClip => LineJoinStyle::MiterJoin,
        });
        if let Some(dashes) = stroke.dasharray() {
            self.content.set_dash_pattern(dashes.iter().copied(), stroke.dashoffset());
        }
        self.outline(path.data(), Transform::identity());
        self.content.stroke();
        self.content.restore_state();
    }

    fn image(&mut self, image: &usvg::Image) -> Result<(), PlotError> {
        let ImageKind::PNG(bytes) = image.kind() else { return Ok(()) };
        let failed = image_error("reading a field's image");
        let pixmap = tiny_skia::Pixmap::decode_png(bytes).map_err(|error| failed(&error))?;
        let pixels = pixmap.pixels().iter().map(|pixel| pixel.demultiply());
        let colours = pixels.clone().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect();
        let opacities = pixels.map(|pixel| pixel.alpha()).collect();
        let name = format!("I{}", self.images.len());
        self.images.push(([pixmap.width(), pixmap.height()].map(|n| n as i32), colours, opacities));
        let size = image.size();
        self.content.save_state();
        self.content.transform(matrix(image.abs_transform()));
        // An image fills the unit square, its first row at the top.
        self.content.transform([size.width(), 0.0, 0.0, -size.height(), 0.0, size.height()]);
        self.content.x_object(Name(name.as_bytes()));
        self.content.restore_state();
        Ok(())
    }

    fn opacity(&mut self, pair: [f32; 2]) {
        if pair == [1.0; 2] {
            return;
        }
        let known = self.opacities.iter().position(|known| *known == pair);
        let number = known.unwrap_or(self.opacities.len());
        if known.is_none() {
            self.opacities.push(pair);
        }
        self.content.set_parameters(Name(format!("S{number}").as_bytes()));
    }

    fn outline(&mut self, path: &tiny_skia::Path, place: Transform) {
        let Some(path) = path.clone().transform(place) else { return };
        let mut from = Place::zero();
        for segment in path.segments() {
            match segment {
                PathSegment::MoveTo(p) => self.content.move_to(p.x, p.y),
                PathSegment::LineTo(p) => self.content.line_to(p.x, p.y),
                PathSegment::QuadTo(c, p) => {
                    // The cubic that is the same curve.
                    let third =
                        |end: Place| [end.x + (c.x - end.x) * 2.0 / 3.0, end.y + (c.y - end.y) * 2.0 / 3.0];
                    let ([x1, y1], [x2, y2]) = (third(from), third(p));
                    self.content.cubic_to(x1, y1, x2, y2, p.x, p.y)
                }
                PathSegment::CubicTo(a, b, p) => self.content.cubic_to(a.x, a.y, b.x, b.y, p.x, p.y),
                PathSegment::Close => self.content.close_path(),
            };
            from = match segment {
                PathSegment::MoveTo(p) | PathSegment::LineTo(p) => p,
                PathSegment::QuadTo(_, p) | PathSegment::CubicTo(_, _, p) => p,
                PathSegment::Close => from,
            };
        }
    }

    /// The whole file.
    fn file(self, [width, height]: [f32; 2], title: &str) -> Vec<u8> {
        let mut pdf = Pdf::new();
        let [catalogue, pages, page, content, information] = [1, 2, 3, 4, 5].map(Ref::new);
        let mut next = FIRST;
        let mut new = || {
            next += 1;
            Ref::new(next - 1)
        };
        let states: Vec<Ref> = self.opacities.iter().map(|_| new()).collect();
        let shadings: Vec<[Ref; 2]> = self.shadings.iter().map(|_| [new(), new()]).collect();
        let images: Vec<[Ref; 2]> = self.images.iter().map(|_| [new(), new()]).collect();
        pdf.catalog(catalogue).pages(pages);
        pdf.pages(pages).kids([page]).count(1);
        pdf.document_info(information).title(TextStr(title)).creator(TextStr("Unripple"));
        let mut sheet = pdf.page(page);
        sheet.media_box(Rect::new(0.0, 0.0, width, height)).parent(pages).contents(content);
        let mut resources = sheet.resources();
        let name = |kind: char, i: usize| format!("{kind}{i}");
        let mut entries = resources.ext_g_states();
        for (i, id) in states.iter().enumerate() {
            entries.pair(Name(name('S', i).as_bytes()), *id);
        }
        entries.finish();
        let mut entries = resources.shadings();
        for (i, [id, _]) in shadings.iter().enumerate() {
            entries.pair(Name(name('G', i).as_bytes()), *id);
        }
        entries.finish();
        let mut entries = resources.x_objects();
        for (i, [id, _]) in images.iter().enumerate() {
            entries.pair(Name(name('I', i).as_bytes()), *id);
        }
        entries.finish();
        resources.finish();
        sheet.finish();
        let stream = compress_to_vec_zlib(&self.content.finish(), LEVEL);
        pdf.stream(content, &stream).filter(Filter::FlateDecode);
        for (id, [fill, stroke]) in states.iter().zip(&self.opacities) {
            pdf.ext_graphics(*id).non_stroking_alpha(*fill).stroking_alpha(*stroke);
        }
        for (ids, shading) in shadings.iter().zip(&self.shadings) {
            axial(&mut pdf, *ids, shading);
        }
        for ([id, mask], (size, colours, opacities)) in images.iter().zip(&self.images) {
            raster(&mut pdf, *id, *size, colours, Some(*mask));
            raster(&mut pdf, *mask, *size, opacities, None);
        }
        pdf.finish()
    }
}

/// A gradient along a line, and the function that it takes its colours from.
fn axial(pdf: &mut Pdf, [id, function_id]: [Ref; 2], (ends, samples): &([f32; 4], Vec<u8>)) {
    let mut shading = pdf.function_shading(id);
    shading.shading_type(FunctionShadingType::Axial);
    shading.color_space().device_rgb();
    shading.coords(*ends).function(function_id).extend([true; 2]);
    shading.finish();
    let stream = compress_to_vec_zlib(samples, LEVEL);
    let mut function = pdf.sampled_function(function_id, &stream);
    function
        .domain([0.0, 1.0])
        .range([0.0, 1.0, 0.0, 1.0, 0.0, 1.0])
        .size([SAMPLES as i32])
        .bits_per_sample(8);
    function.filter(Filter::FlateDecode);
}

/// An image of colours that has a mask of opacities, or that mask, which has none.
fn raster(pdf: &mut Pdf, id: Ref, [width, height]: [i32; 2], samples: &[u8], mask: Option<Ref>) {
    let stream = compress_to_vec_zlib(samples, LEVEL);
    let mut image = pdf.image_xobject(id, &stream);
    image.filter(Filter::FlateDecode);
    image.width(width).height(height).bits_per_component(8).interpolate(true);
    match mask {
        Some(mask) => {
            image.color_space().device_rgb();
            image.s_mask(mask);
        }
        None => image.color_space().device_gray(),
    }
}

/// Ends of a gradient in its own coordinates, and the colours from one to the other.
fn sampled(gradient: &usvg::LinearGradient) -> ([f32; 4], Vec<u8>) {
    let stops = gradient.stops();
    let at = |place: f32| {
        let after = stops.iter().position(|stop| stop.offset().get() >= place).unwrap_or(stops.len() - 1);
        let (a, b) = (&stops[after.saturating_sub(1)], &stops[after]);
        let span = b.offset().get() - a.offset().get();
        let t = if span > 0.0 { ((place - a.offset().get()) / span).clamp(0.0, 1.0) } else { 1.0 };
        let mix = |a: u8, b: u8| (f32::from(a) + t * (f32::from(b) - f32::from(a))).round() as u8;
        let (a, b) = (a.color(), b.color());
        [mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)]
    };
    let samples = (0..SAMPLES).flat_map(|i| at(i as f32 / (SAMPLES - 1) as f32)).collect();
    ([gradient.x1(), gradient.y1(), gradient.x2(), gradient.y2()], samples)
}

/// The colour of a paint that has only one; black stands for what drawings never have.
fn colour(paint: &Paint) -> [f32; 3] {
    match paint {
        Paint::Color(colour) => [colour.red, colour.green, colour.blue].map(|level| f32::from(level) / 255.0),
        _ => [0.0; 3],
    }
}

fn matrix(t: Transform) -> [f32; 6] {
    [t.sx, t.ky, t.kx, t.sy, t.tx, t.ty]
}
