//! The usual chain as a network made in code: `source` -> `proxy` (box) -> `view` (entry and exit points) -> `traversal`.

use std::path::Path;
use std::sync::Arc;

use rayloom_network::{self as network, Network, Value};
use rayloom_processors::{Data, View, step_length};
use rayloom_reference::{Camera, Projection};
use rayloom_volume::{TransferFunction, Volume};
use serde_json::{Value as Json, json};

use crate::{Picture, Workbench, types};

impl Workbench {
    /// A chain on a volume file; the path is absolute.
    pub fn of_file(path: &Path) -> Self {
        let mut bench = Self::chain("volume_source");
        bench.put("source.file", json!(path));
        bench
    }

    /// A chain on a generated volume: `field` with its parameters, `dims` and `extent` as one JSON object.
    pub fn of_generator(properties: &Json) -> Self {
        let mut bench = Self::chain("volume_generator");
        // The field brings its parameters with it.
        bench.put("source.field", properties["field"].clone());
        for (id, value) in properties.as_object().into_iter().flatten() {
            bench.put(&format!("source.{id}"), value.clone());
        }
        bench
    }

    /// The chain behind a source: whole rays (no early termination), opacities per world unit.
    fn chain(source: &str) -> Self {
        let mut bench = Self::new(Network::new(types()));
        bench.add("source", source);
        bench.add_traversal("", "source.volume");
        bench
    }

    /// Adds a processor.
    pub fn add(&mut self, id: &str, type_id: &str) -> &mut Self {
        self.network.add(type_id, id).unwrap_or_else(|error| panic!("{error}"));
        self
    }

    /// Connects two ports, `PROCESSOR.PORT` each.
    pub fn join(&mut self, from: &str, to: &str) -> &mut Self {
        let address = |text: &str| text.parse::<network::Address>().unwrap_or_else(|error| panic!("{error}"));
        self.network.connect(address(from), address(to)).unwrap_or_else(|refusal| panic!("{refusal}"));
        self
    }

    /// Adds `proxy`, `view` and `traversal`, their ids ending in `suffix`, behind the outport `volume`.
    pub fn add_traversal(&mut self, suffix: &str, volume: &str) -> &mut Self {
        let [proxy, view, traversal] = ["proxy", "view", "traversal"].map(|id| format!("{id}{suffix}"));
        self.add(&proxy, "cube_proxy").add(&view, "entry_exit_points").add(&traversal, "ray_traversal");
        self.join(volume, &format!("{proxy}.volume"));
        self.join(&format!("{proxy}.geometry"), &format!("{view}.geometry"));
        self.join(volume, &format!("{traversal}.volume"));
        for port in ["entry", "exit"] {
            self.join(&format!("{view}.{port}"), &format!("{traversal}.{port}"));
        }
        self.put(&format!("{traversal}.termination_error"), json!(0.0));
        self.put(&format!("{traversal}.reference_length"), json!(1.0))
    }

    /// Looks through a camera of the reference.
    pub fn look(&mut self, camera: &Camera) -> &mut Self {
        self.look_from("view", camera)
    }

    /// Sets the camera of the entry and exit points with this id.
    pub fn look_from(&mut self, view: &str, camera: &Camera) -> &mut Self {
        self.assign(view, "camera", Value::Camera(network_camera(camera)))
    }

    /// Sets the transfer function.
    pub fn classify(&mut self, function: &TransferFunction) -> &mut Self {
        self.assign("traversal", "transfer_function", Value::TransferFunction(function.clone()))
    }

    /// Sets a property that has no handy JSON form.
    pub fn assign(&mut self, processor: &str, property: &str, value: Value) -> &mut Self {
        self.network.set_property(processor, property, value).unwrap_or_else(|error| panic!("{error}"));
        self
    }

    /// The picture of the traversal.
    pub fn render(&mut self, size: [u32; 2]) -> Picture {
        self.picture("traversal", "image", size)
    }

    /// The volume of the source, read or generated now if that has not happened yet.
    pub fn volume(&mut self) -> Arc<Volume> {
        let watch = vec![("source", "volume").into()];
        let report = self.evaluate(&network::Request { watch, ..Default::default() });
        match self.evaluator.output("source", "volume") {
            Some(Data::Volume(data)) => data.volume.clone(),
            _ => panic!("the source gave no volume: {report:?}"),
        }
    }
}

/// The same camera in the words of the network.
/// The distance between samples at a sampling rate, world units.
pub fn step(camera: &Camera, size: [u32; 2], volume: &Volume, rate: f64) -> f64 {
    let view = View::new(&network_camera(camera), size, volume.texture_to_world()).expect("a camera that makes sense");
    step_length(&view, volume, rate)
}

fn network_camera(camera: &Camera) -> network::Camera {
    network::Camera {
        position: camera.eye.into(),
        focus: camera.focus.into(),
        up: camera.up.into(),
        projection: match camera.projection {
            Projection::Perspective { fov_degrees } => network::Projection::Perspective { fov_degrees },
            Projection::Orthographic { height } => network::Projection::Orthographic { height },
        },
        near: camera.near,
    }
}
