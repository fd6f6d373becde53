//! Reference pictures kept on disk, by what they show.

mod digest;
mod file;

use crate::image::{Image, Rectangle};
use crate::progress::{Progress, RenderError};
use crate::reference::Reference;
use crate::scene::Scene;
use std::io;
use std::path::PathBuf;

/// A folder of reference pictures.
///
/// A picture is found again by a hash of everything it depends on: the values and place of the volume, the material, the
/// camera, the light and the renderer. A file that is damaged, of another version or of another scene counts as missing.
#[derive(Debug, Clone)]
pub struct Cache {
    folder: PathBuf,
}

/// Where a picture came from.
#[derive(Debug)]
pub enum Source {
    /// It was in the folder.
    Found,
    /// It was rendered and written.
    Rendered,
    /// It was rendered but could not be written; it will be rendered again next time.
    NotKept(io::Error),
}

/// A picture and where it came from.
#[derive(Debug)]
pub struct Cached {
    /// The picture.
    pub image: Image,
    /// Where it came from.
    pub source: Source,
}

impl Cache {
    /// The cache in a folder, which is made once there is something to keep.
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        Self { folder: folder.into() }
    }

    /// The file that holds the picture of a scene, whether it exists or not. Hashes the volume.
    pub fn path(&self, reference: Reference, scene: &Scene<'_>, part: Option<Rectangle>) -> PathBuf {
        self.path_of(reference, digest::key(reference, scene, part))
    }

    /// Finds the picture of a scene, or of `part` of it, or renders and keeps it. That it cannot be kept is no error.
    ///
    /// # Errors
    /// The scene or the part makes no sense, or `progress` cancelled the picture.
    pub fn render(
        &self,
        reference: Reference,
        scene: &Scene<'_>,
        part: Option<Rectangle>,
        progress: Progress<'_>,
    ) -> Result<Cached, RenderError> {
        scene.check()?;
        if let Some(part) = part {
            part.check_within(scene.size)?;
        }
        let size = part.map_or(scene.size, |part| [part.width, part.height]);
        let key = digest::key(reference, scene, part);
        let path = self.path_of(reference, key);
        if let Some(image) = file::read(&path, key, size) {
            return Ok(Cached { image, source: Source::Found });
        }
        let image = reference.render(scene, part, progress)?;
        let source = file::write(&path, key, &image).map_or_else(Source::NotKept, |()| Source::Rendered);
        Ok(Cached { image, source })
    }

    fn path_of(&self, reference: Reference, key: u128) -> PathBuf {
        self.folder.join(format!("{}-{key:032x}.picture", reference.id()))
    }
}
