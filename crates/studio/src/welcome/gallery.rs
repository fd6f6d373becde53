//! The shipped networks with their pictures, found and rendered in the background.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use egui::{ColorImage, Context, TextureHandle, TextureOptions};
use rayloom_gpu::Gpu;
use rayloom_network::Registry;
use rayloom_processors::Runner;

use super::shipped::{self, Shipped};
use super::thumbnail;
use crate::task::{Control, Task};

/// A network and its picture.
pub struct Entry {
    /// The network.
    pub network: Shipped,
    /// Its picture, once there is one.
    pub picture: Option<TextureHandle>,
}

enum News {
    Found(Vec<Shipped>),
    Picture(usize, ColorImage),
}

/// The networks found so far. Dropped, it waits for the picture that is being rendered.
pub struct Gallery {
    /// The networks, applications first.
    pub entries: Vec<Entry>,
    news: Receiver<News>,
    task: Task<()>,
    rests: bool,
}

impl Gallery {
    /// Looks for networks in a folder, and for their pictures in another.
    pub fn start(
        folder: PathBuf,
        cache: Option<PathBuf>,
        registry: Arc<Registry>,
        gpu: Gpu,
        context: &Context,
    ) -> Self {
        let (outbox, news) = channel();
        let task = Task::start(context, move |control| {
            // Ended early or not, there is nothing to tell.
            let _ = work(&folder, cache.as_deref(), &registry, gpu, &outbox, control);
        });
        Self { entries: Vec::new(), news, task, rests: false }
    }

    /// Takes in what was found since the last call.
    pub fn listen(&mut self, context: &Context) {
        while let Ok(news) = self.news.try_recv() {
            match news {
                News::Found(networks) => {
                    self.entries = networks.into_iter().map(|network| Entry { network, picture: None }).collect();
                }
                News::Picture(index, image) => {
                    if let Some(entry) = self.entries.get_mut(index) {
                        let name = format!("thumbnail of {}", entry.network.name);
                        entry.picture = Some(context.load_texture(name, image, TextureOptions::LINEAR));
                    }
                }
            }
        }
    }

    /// Renders no more pictures after the one being rendered: the device is wanted for something else.
    pub fn rest(&mut self) {
        self.task.cancel();
        self.rests = true;
    }

    /// Whether it was told to rest, and does; another one may start.
    pub fn ended_early(&mut self) -> bool {
        let _ = self.task.take();
        self.rests && !self.task.is_running()
    }
}

/// Ends with `None` when nobody wants more.
fn work(
    folder: &Path,
    cache: Option<&Path>,
    registry: &Arc<Registry>,
    gpu: Gpu,
    news: &Sender<News>,
    control: &Control,
) -> Option<()> {
    let networks = shipped::list(folder, registry);
    news.send(News::Found(networks.iter().map(|(shipped, _)| shipped.clone()).collect())).ok()?;
    let mut missing = Vec::new();
    for (index, (_, network)) in networks.iter().enumerate() {
        let file = cache.map(|cache| thumbnail::file(network, cache));
        match file.as_deref().and_then(thumbnail::load) {
            Some(image) => news.send(News::Picture(index, image)).ok()?,
            None => missing.push((index, file)),
        }
    }
    control.tell(0.0).is_continue().then_some(())?;
    let mut runner = if missing.is_empty() { return Some(()) } else { Runner::new(gpu).ok()? };
    let count = missing.len();
    for (done, (index, file)) in missing.into_iter().enumerate() {
        if let Some(image) = thumbnail::render(&networks[index].1, &mut runner, file.as_deref()) {
            news.send(News::Picture(index, image)).ok()?;
        }
        control.tell((done + 1) as f64 / count as f64).is_continue().then_some(())?;
    }
    Some(())
}
