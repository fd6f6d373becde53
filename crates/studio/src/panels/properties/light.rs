//! A light: its direction on a small sphere, what it is fixed to, its colour.

use egui::{Color32, Mesh, Pos2, Rect, Sense, Stroke, Ui, Vec2};
use rayloom_network::{Light, LightSpace, PropertyDecl};

use super::editor::{Surroundings, rgb_button};
use super::number::Number;
use super::vector;

/// Diameter of the sphere, points.
const SIZE: f32 = 66.0;

/// Shows a light; the new one if the user changed it.
pub(super) fn show(
    ui: &mut Ui,
    decl: &PropertyDecl,
    light: &Light,
    surroundings: &mut Surroundings<'_>,
) -> Option<Light> {
    let mut after = *light;
    ui.horizontal(|ui| {
        sphere(ui, decl, &mut after);
        ui.vertical(|ui| {
            ui.horizontal(|ui| {
                ui.weak("Fixed to");
                ui.selectable_value(&mut after.space, LightSpace::Camera, "Camera")
                    .on_hover_text("Moves with the viewer");
                ui.selectable_value(&mut after.space, LightSpace::World, "World").on_hover_text("Stays in the scene");
            });
            ui.horizontal(|ui| color(ui, decl, &mut after, surroundings));
            ui.horizontal(|ui| {
                let direction = vector::triple(ui, decl, "Direction", after.direction, surroundings);
                after.direction = direction.unwrap_or(after.direction);
            });
        });
    });
    if after == *light {
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

/// Colour and strength: the picker shows the colour at full strength, the strength scales it.
fn color(ui: &mut Ui, decl: &PropertyDecl, light: &mut Light, surroundings: &mut Surroundings<'_>) {
    let strength = light.color.iter().fold(0.0_f64, |most, c| most.max(*c));
    let hue = light.color.map(|c| if strength > 0.0 { c / strength } else { 1.0 });
    ui.weak("Colour");
    if let Some(picked) = rgb_button(ui, "Light colour", hue) {
        light.color = picked.map(|c| c * strength.max(1e-3));
    }
    let label = "Strength";
    let field = Number {
        label,
        range: [0.0, 100.0],
        slider: Some([0.0, 3.0]),
        unit: "strength",
        logarithmic: false,
        whole: false,
    };
    let entered = field.show(ui, strength, ui.available_width());
    if let Some(strength) = surroundings.number(decl, entered) {
        light.color = hue.map(|c| c * strength);
    }
}

/// The sphere as lit from the direction; dragging moves the light. The half towards the viewer (camera) is shown: x right,
/// y up; for a light in the world it is seen from the front, right is left.
fn sphere(ui: &mut Ui, decl: &PropertyDecl, light: &mut Light) {
    let (area, response) = ui.allocate_exact_size(Vec2::splat(SIZE), Sense::click_and_drag());
    response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::WidgetType::Other, true, format!("Direction of {}", decl.label))
    });
    let radius = SIZE / 2.0 - 2.0;
    let length = light.direction.iter().map(|c| c * c).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
    let unit = to_screen(light.space, light.direction.map(|c| c / length));
    paint(ui, area, radius, unit, light);
    let at = area.center() + Vec2::new(unit[0] as f32, -unit[1] as f32) * radius;
    let dot = if unit[2] >= 0.0 { Color32::WHITE } else { Color32::GRAY };
    ui.painter().circle(at, 4.0, dot, Stroke::new(1.5, Color32::from_black_alpha(180)));
    let response = response.on_hover_text("Drag to move the light; beyond the rim it shines from behind");
    if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged() || response.clicked()) {
        let direction = direction_at((pointer - area.center()) / radius);
        light.direction = to_screen(light.space, direction).map(|c| (c * 1000.0).round() / 1000.0);
    }
}

/// Exchanges the light's coordinates and those of the sphere; the same both ways.
fn to_screen(space: LightSpace, [x, y, z]: [f64; 3]) -> [f64; 3] {
    match space {
        LightSpace::Camera => [x, y, z],
        // Seen from the front: anterior towards the viewer, superior up, right on the left side.
        LightSpace::World => [-x, z, y],
    }
}

/// The direction of a point of the disc: the front inside of the rim, the back between one and two radii.
fn direction_at(at: Vec2) -> [f64; 3] {
    let (x, y) = (f64::from(at.x), f64::from(-at.y));
    let distance = x.hypot(y);
    if distance <= 1.0 {
        return [x, y, (1.0 - distance * distance).sqrt()];
    }
    let inner = (2.0 - distance).clamp(0.0, 1.0);
    let scale = inner / distance;
    [x * scale, y * scale, -(1.0 - inner * inner).sqrt()]
}

/// A sphere with diffuse light, as a fan of rings.
fn paint(ui: &Ui, area: Rect, radius: f32, light: [f64; 3], source: &Light) {
    const RINGS: u32 = 10;
    const SPOKES: u32 = 40;
    let shade = |x: f32, y: f32| {
        let z = (1.0 - x * x - y * y).max(0.0).sqrt();
        let lambert = (f64::from(x) * light[0] + f64::from(y) * light[1] + f64::from(z) * light[2]).max(0.0);
        let [r, g, b] = source.color.map(|c| (255.0 * (0.12 + 0.75 * lambert * c)).clamp(0.0, 255.0) as u8);
        Color32::from_rgb(r, g, b)
    };
    let mut mesh = Mesh::default();
    mesh.colored_vertex(area.center(), shade(0.0, 0.0));
    for ring in 1..=RINGS {
        for spoke in 0..SPOKES {
            let (sin, cos) = (std::f32::consts::TAU * spoke as f32 / SPOKES as f32).sin_cos();
            let r = ring as f32 / RINGS as f32;
            let at: Pos2 = area.center() + Vec2::new(cos, -sin) * r * radius;
            mesh.colored_vertex(at, shade(cos * r, sin * r));
            let index = |ring: u32, spoke: u32| if ring == 0 { 0 } else { 1 + (ring - 1) * SPOKES + spoke % SPOKES };
            mesh.add_triangle(index(ring, spoke), index(ring, spoke + 1), index(ring - 1, spoke));
            mesh.add_triangle(index(ring, spoke + 1), index(ring - 1, spoke + 1), index(ring - 1, spoke));
        }
    }
    ui.painter().add(mesh);
    ui.painter().circle_stroke(area.center(), radius, Stroke::new(1.0, ui.visuals().weak_text_color()));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_direction_of_the_disc_has_length_one() {
        for at in [Vec2::ZERO, Vec2::new(0.6, 0.3), Vec2::new(1.0, 0.0), Vec2::new(-1.4, 0.2), Vec2::new(5.0, 0.0)] {
            let length: f64 = direction_at(at).iter().map(|c| c * c).sum::<f64>().sqrt();
            assert!((length - 1.0).abs() < 1e-6, "{at:?}");
        }
        assert!(direction_at(Vec2::new(-1.4, 0.2))[2] < 0.0);
    }
}
