//! netCDF-4 files: HDF5 whose datasets say which of them are axes of which.

use super::bytes::{Bytes, NOWHERE, aligned};
use super::heap::Heap;
use super::message::{Header, Kind};
use std::io::{self, Write};

/// Bytes of the superblock, version 2: the root's header follows right after, so the format fixes the value.
const SUPERBLOCK: u64 = 48;

/// A netCDF-4 file in the making: named axes, and arrays over them.
#[derive(Clone, Debug, Default)]
pub(super) struct NetCdf {
    /// Names and texts of the global attributes.
    pub attributes: Vec<(String, String)>,
    /// Names and lengths of the axes; a variable refers to them by index.
    pub axes: Vec<(&'static str, u64)>,
    /// The arrays, in the order in which their values are written.
    pub variables: Vec<Variable>,
}

/// One array of the file: its type, its axes and its attributes.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    /// Name of the array.
    pub name: &'static str,
    /// Type of its elements.
    pub kind: Kind,
    /// Axes of the variable, by their index, the slowest first.
    pub axes: Vec<usize>,
    /// Names and texts of its attributes.
    pub attributes: Vec<(&'static str, String)>,
}

/// Where each thing is in the file.
#[derive(Clone, Debug, Default)]
struct Places {
    /// Headers of axes and then variables.
    headers: Vec<u64>,
    heap: u64,
    /// Values of the variables.
    data: Vec<u64>,
    end: u64,
}

impl NetCdf {
    /// Number of elements of a variable along each of its axes.
    pub fn shape(&self, variable: &Variable) -> Vec<u64> {
        variable.axes.iter().map(|axis| self.axes[*axis].1).collect()
    }

    /// Number of bytes of a variable's values.
    pub fn bytes(&self, variable: &Variable) -> u64 {
        self.shape(variable).iter().fold(variable.kind.size(), |size, n| size.saturating_mul(*n))
    }

    /// Writes the file. `values` is to write the values of each variable in turn, by its index, little-endian.
    ///
    /// # Errors
    /// Those of `out` and `values`, and [`io::ErrorKind::InvalidData`] for more or fewer values than a variable holds.
    pub fn write<W: Write>(
        &self,
        out: &mut W,
        mut values: impl FnMut(usize, &mut Counted<'_, W>) -> io::Result<()>,
    ) -> io::Result<()> {
        let places = self.places();
        let mut head = Bytes::default()
            .raw(b"\x89HDF\r\n\x1a\n")
            .raw(&[2, 8, 8, 0])
            .u64(0)
            .u64(NOWHERE)
            .u64(places.end)
            .u64(SUPERBLOCK)
            .checked();
        let (headers, heap) = self.encoded(&places);
        for (header, at) in headers.iter().zip([SUPERBLOCK].iter().chain(&places.headers)) {
            head.resize(*at as usize, 0);
            head.extend_from_slice(header);
        }
        head.resize(places.heap as usize, 0);
        head.extend_from_slice(&heap);
        out.write_all(&head)?;
        let mut written = head.len() as u64;
        for (index, (variable, at)) in self.variables.iter().zip(&places.data).enumerate() {
            out.write_all(&vec![0; (at - written) as usize])?;
            let mut counted = Counted { out, left: self.bytes(variable) };
            values(index, &mut counted)?;
            if counted.left > 0 {
                return Err(io::Error::new(io::ErrorKind::InvalidData, "fewer values than a variable holds"));
            }
            written = at + self.bytes(variable);
        }
        Ok(())
    }

    /// Lays out the file: sizes of headers do not depend on what addresses they hold.
    fn places(&self) -> Places {
        let count = self.axes.len() + self.variables.len();
        let blank =
            Places { headers: vec![0; count], data: vec![0; self.variables.len()], ..Places::default() };
        let (headers, heap) = self.encoded(&blank);
        let mut end = SUPERBLOCK;
        let mut take = |size: u64| {
            let at = aligned(end);
            end = at + size;
            at
        };
        let headers: Vec<u64> = headers.iter().map(|header| take(header.len() as u64)).collect();
        let heap = take(heap.len() as u64);
        let data = self.variables.iter().map(|variable| take(self.bytes(variable))).collect();
        // The first header is the root's, right after the superblock.
        Places { headers: headers[1..].to_vec(), heap, data, end }
    }

    /// Headers of the root, the axes and the variables, and the heap.
    fn encoded(&self, places: &Places) -> (Vec<Vec<u8>>, Vec<u8>) {
        let mut heap = Heap::default();
        let mut headers = vec![self.root(places)];
        headers.extend(self.axes.iter().enumerate().map(|(i, (_, size))| axis(i, *size)));
        let (axes, _) = places.headers.split_at(self.axes.len());
        for (variable, at) in self.variables.iter().zip(&places.data) {
            let said = variable.axes.iter().flat_map(|axis| heap.keep(axes[*axis], places.heap));
            let list: Vec<u8> = said.collect();
            let header = Header::default().dataset(variable.kind, &self.shape(variable), *at);
            let header =
                header.attribute("DIMENSION_LIST", Kind::References, &[variable.axes.len() as u64], &list);
            let texts = variable.attributes.iter();
            headers.push(texts.fold(header, |header, (name, text)| header.text(name, text)).encoded());
        }
        (headers, heap.encoded())
    }

    fn root(&self, places: &Places) -> Vec<u8> {
        let names: Vec<&str> =
            self.axes.iter().map(|(name, _)| *name).chain(self.variables.iter().map(|v| v.name)).collect();
        let texts = self.attributes.iter();
        let header = texts.fold(Header::default(), |header, (name, text)| header.text(name, text));
        let links = names.into_iter().zip(&places.headers).enumerate();
        links
            .fold(header.group(places.headers.len() as u64), |header, (order, (name, at))| {
                header.link(name, order as u64, *at)
            })
            .encoded()
    }
}

/// The dataset that an axis is: of no values, and named as netCDF names those.
fn axis(index: usize, size: u64) -> Vec<u8> {
    let text = |text: &str, size: usize| {
        let mut bytes = text.as_bytes().to_vec();
        bytes.resize(size, 0);
        bytes
    };
    let name = format!("This is a netCDF dimension but not a netCDF variable.{size:10}");
    Header::default()
        .dataset(Kind::F32, &[size], NOWHERE)
        .attribute("CLASS", Kind::Text(16), &[], &text("DIMENSION_SCALE", 16))
        .attribute("NAME", Kind::Text(64), &[], &text(&name, 64))
        .attribute("_Netcdf4Dimid", Kind::I32, &[], &(index as i32).to_le_bytes())
        .encoded()
}

/// Takes exactly the bytes of one variable.
pub(super) struct Counted<'a, W> {
    out: &'a mut W,
    left: u64,
}

impl<W: Write> Write for Counted<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.left = self
            .left
            .checked_sub(bytes.len() as u64)
            .ok_or_else(|| io::Error::new(io::ErrorKind::InvalidData, "more values than a variable holds"))?;
        self.out.write_all(bytes)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
