//! A camera: numbers, projection, usual views, fit to the data.

use egui::{Grid, Ui};
use rayloom_network::{Camera, Projection, PropertyDecl};

use super::editor::Surroundings;
use super::number::Number;
use super::vector;
use crate::upstream;
use crate::views::VIEWS;

/// Shows a camera; the new one if the user changed it into one that forms an image.
pub(super) fn show(
    ui: &mut Ui,
    decl: &PropertyDecl,
    camera: &Camera,
    surroundings: &mut Surroundings<'_>,
) -> Option<Camera> {
    let mut after = *camera;
    views(ui, &mut after, surroundings);
    let name = |ui: &mut Ui, text: &str| ui.weak(text);
    Grid::new("camera").num_columns(2).spacing([6.0, 3.0]).show(ui, |ui| {
        for (label, values) in [("Position", &mut after.position), ("Focus", &mut after.focus), ("Up", &mut after.up)] {
            name(ui, label);
            ui.horizontal(|ui| *values = vector::triple(ui, decl, label, *values, surroundings).unwrap_or(*values));
            ui.end_row();
        }
        name(ui, "Projection");
        ui.horizontal(|ui| projection(ui, decl, &mut after, surroundings));
        ui.end_row();
        name(ui, "Near");
        ui.horizontal(|ui| near(ui, decl, &mut after, surroundings));
        ui.end_row();
    });
    if after == *camera {
        return None;
    }
    match after.validate() {
        Ok(()) => Some(after),
        Err(error) => {
            surroundings.number(decl, super::number::Entered::Bad(format!("Not set: {error}.")));
            None
        }
    }
}

fn views(ui: &mut Ui, camera: &mut Camera, surroundings: &Surroundings<'_>) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        ui.spacing_mut().button_padding.x = 5.0;
        for view in &VIEWS {
            if ui.button(egui::RichText::new(view.name).size(11.5)).on_hover_text("Keeps focus and distance").clicked()
            {
                *camera = view.of(camera);
            }
        }
        let volume = surroundings.volume.as_deref();
        let fit = ui.add_enabled(volume.is_some(), egui::Button::new(egui::RichText::new("Fit").size(11.5)));
        let fit = fit.on_hover_text("Shows the whole volume, from the same side");
        if let Some(volume) = volume.filter(|_| fit.clicked()) {
            let (center, radius) = upstream::bounds(volume);
            *camera = camera.framing(center, radius);
        }
    });
}

/// World height that the picture shows at the focus.
fn height_at_focus(camera: &Camera, fov_degrees: f64) -> f64 {
    2.0 * camera.distance() * (0.5 * fov_degrees.to_radians()).tan()
}

fn projection(ui: &mut Ui, decl: &PropertyDecl, camera: &mut Camera, surroundings: &mut Surroundings<'_>) {
    let orthographic = matches!(camera.projection, Projection::Orthographic { .. });
    ui.spacing_mut().item_spacing.x = 3.0;
    if ui.selectable_label(!orthographic, "Perspective").clicked() && orthographic {
        camera.projection = Projection::Perspective { fov_degrees: 30.0 };
    }
    if ui.selectable_label(orthographic, "Orthographic").on_hover_text("Parallel rays").clicked()
        && let Projection::Perspective { fov_degrees } = camera.projection
    {
        // The focus keeps its size in the picture.
        camera.projection = Projection::Orthographic { height: height_at_focus(camera, fov_degrees) };
    }
    let width = ui.available_width();
    let field = |label, range, slider, unit| Number { label, range, slider, unit, logarithmic: false, whole: false };
    match &mut camera.projection {
        Projection::Perspective { fov_degrees } => {
            let field = field("Field of view", [0.01, 179.0], Some([1.0, 120.0]), "°");
            let entered = field.show(ui, *fov_degrees, width);
            *fov_degrees = surroundings.number(decl, entered).unwrap_or(*fov_degrees);
        }
        Projection::Orthographic { height } => {
            let entered = field("Height", [1e-9, f64::INFINITY], None, "high").show(ui, *height, width);
            *height = surroundings.number(decl, entered).unwrap_or(*height);
        }
    }
}

fn near(ui: &mut Ui, decl: &PropertyDecl, camera: &mut Camera, surroundings: &mut Surroundings<'_>) {
    let mut cuts = camera.near.is_some();
    let checkbox = ui.checkbox(&mut cuts, "");
    if checkbox.on_hover_text("Draws nothing nearer than this along the viewing direction, world units").changed() {
        camera.near = cuts.then(|| 0.5 * camera.distance());
    }
    match &mut camera.near {
        Some(near) => {
            let range = [0.0, f64::INFINITY];
            let field = Number { label: "Near", range, slider: None, unit: "", logarithmic: false, whole: false };
            let entered = field.show(ui, *near, ui.available_width());
            *near = surroundings.number(decl, entered).unwrap_or(*near);
        }
        None => {
            ui.weak("from the eye on");
        }
    }
}
