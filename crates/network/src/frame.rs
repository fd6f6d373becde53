//! Frames: titled rectangles with notes behind the processors, for whoever reads the network.

use crate::edit::EditError;
use crate::network::Network;

/// A titled rectangle with a text. It changes nothing of what is computed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Its heading.
    pub title: String,
    /// What it says, any number of lines.
    pub text: String,
    /// Left, top, width and height in the editor, points; as positions of processors.
    pub rect: [f64; 4],
}

impl Network {
    /// The frames, the first at the back.
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// Replaces the frames.
    ///
    /// # Errors
    /// A rectangle that is not finite, or has no width or height.
    pub fn set_frames(&mut self, frames: Vec<Frame>) -> Result<(), EditError> {
        let fits =
            |frame: &Frame| frame.rect.iter().all(|x| x.is_finite()) && frame.rect[2] > 0.0 && frame.rect[3] > 0.0;
        match frames.iter().find(|frame| !fits(frame)) {
            Some(frame) => Err(EditError::Frame(frame.title.clone())),
            None => {
                self.frames = frames;
                Ok(())
            }
        }
    }
}
