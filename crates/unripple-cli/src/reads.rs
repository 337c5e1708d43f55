//! What the command line names and a command reads, which no output may take the place of.

use crate::args::{CompareOptions, FieldOptions, FocusOptions, PlayOptions, TargetOptions};
use std::path::PathBuf;
use unripple_store::{Library, effect_files, surface_files};

/// Files and folders that are read.
pub trait Reads {
    /// All of them, whether they are there or not.
    fn reads(&self) -> Vec<PathBuf>;
}

/// A surface's or a library's own.
pub fn source(name: &str) -> Vec<PathBuf> {
    if Library::is_at(name) { vec![name.into()] } else { surface_files(name) }
}

impl Reads for TargetOptions {
    fn reads(&self) -> Vec<PathBuf> {
        let shapes = self.shape.iter().chain(&self.path).map(PathBuf::from);
        // `X,Y,FILE` or `X,Y,FILE,UM`: a file of either name, if there is one.
        let waveforms = self.waveform.iter().filter_map(|text| text.splitn(3, ',').nth(2)).flat_map(|what| {
            let level = what.rsplit_once(',').map(|(file, _)| PathBuf::from(file));
            level.into_iter().chain([PathBuf::from(what)])
        });
        shapes.chain(waveforms).collect()
    }
}

impl Reads for FocusOptions {
    fn reads(&self) -> Vec<PathBuf> {
        let sources = [Some(&self.surface), self.on.as_ref()].into_iter().flatten();
        sources.flat_map(|name| source(name)).chain(self.targets.reads()).collect()
    }
}

impl Reads for CompareOptions {
    fn reads(&self) -> Vec<PathBuf> {
        source(&self.surface).into_iter().chain(self.targets.reads()).collect()
    }
}

impl Reads for FieldOptions {
    fn reads(&self) -> Vec<PathBuf> {
        source(&self.surface).into_iter().chain([self.drive.clone()]).collect()
    }
}

impl Reads for PlayOptions {
    fn reads(&self) -> Vec<PathBuf> {
        let sessions = self.touch.session.iter().chain(&self.touch.screen).cloned();
        source(&self.surface).into_iter().chain(effect_files(&self.effect)).chain(sessions).collect()
    }
}
