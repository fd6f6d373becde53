//! Scalar fields over the domain `[-1, 1]^3`, with gradients where there are any.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::hydrogen;

/// Corners of the truncated icosahedron: even permutations of these with all signs, edge length 2.
const BALL_CORNERS: [[f64; 3]; 3] = {
    const GOLDEN: f64 = 1.618_033_988_749_895;
    [[0.0, 1.0, 3.0 * GOLDEN], [1.0, 2.0 + GOLDEN, 2.0 * GOLDEN], [GOLDEN, 2.0, 2.0 * GOLDEN + 1.0]]
};

/// A scalar field over the domain `[-1, 1]^3`, defined beyond it too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Field {
    /// The same value everywhere.
    Constant {
        /// That value.
        value: f64,
    },
    /// 0 at one side of the domain, 1 at the other: `(p[axis] + 1) / 2`.
    Ramp {
        /// 0, 1 or 2: along x, y or z.
        axis: usize,
    },
    /// `|p| - radius`: negative inside of the sphere.
    SphereDistance {
        /// Domain units.
        radius: f64,
    },
    /// `exp(-|p|^2 / (2 sigma^2))`.
    GaussianBlob {
        /// Standard deviation, domain units.
        sigma: f64,
    },
    /// The test signal of Marschner and Lobb (1994):
    /// `(1 - sin(pi z / 2) + alpha (1 + cos(2 pi f cos(pi r / 2)))) / (2 (1 + alpha))` with `r = |(x, y)|`.
    MarschnerLobb {
        /// The largest local frequency is `pi / 2` times this, per domain unit; 6 in the paper.
        frequency: f64,
        /// How strong the waves are; 0.25 in the paper.
        alpha: f64,
    },
    /// Hydrogen, state 1s: `|psi|^2`.
    Hydrogen1s {
        /// The Bohr radius, domain units.
        bohr: f64,
    },
    /// Hydrogen, state 2p along z: `|psi|^2`.
    Hydrogen2p {
        /// The Bohr radius, domain units.
        bohr: f64,
    },
    /// Hydrogen, state 3d along z: `|psi|^2`.
    Hydrogen3d {
        /// The Bohr radius, domain units.
        bohr: f64,
    },
    /// Sixty Gaussian atoms at the corners of a truncated icosahedron.
    BuckyBall {
        /// Distance of the atoms from the centre, domain units.
        radius: f64,
        /// Standard deviation of an atom, domain units.
        sigma: f64,
    },
    /// Cubes of 0 and 1; the first is 0.
    Checkerboard {
        /// Cubes along each side of the domain.
        cells: u32,
    },
    /// Spherical waves around the centre: `(1 + cos(2 pi count |p|)) / 2`.
    Shells {
        /// Shells from the centre to the side of the domain.
        count: f64,
    },
}

impl Field {
    /// One of every kind, with parameters that look good and fill the domain.
    pub const EXAMPLES: [Self; 11] = [
        Self::Constant { value: 1.0 },
        Self::Ramp { axis: 0 },
        Self::SphereDistance { radius: 0.7 },
        Self::GaussianBlob { sigma: 0.3 },
        Self::MarschnerLobb { frequency: 6.0, alpha: 0.25 },
        Self::Hydrogen1s { bohr: 0.3 },
        Self::Hydrogen2p { bohr: 0.12 },
        Self::Hydrogen3d { bohr: 0.06 },
        Self::BuckyBall { radius: 0.75, sigma: 0.08 },
        Self::Checkerboard { cells: 8 },
        Self::Shells { count: 4.0 },
    ];

    /// A short stable name.
    pub fn id(&self) -> &'static str {
        match self {
            Self::Constant { .. } => "constant",
            Self::Ramp { .. } => "ramp",
            Self::SphereDistance { .. } => "sphere_distance",
            Self::GaussianBlob { .. } => "gaussian_blob",
            Self::MarschnerLobb { .. } => "marschner_lobb",
            Self::Hydrogen1s { .. } => "hydrogen_1s",
            Self::Hydrogen2p { .. } => "hydrogen_2p",
            Self::Hydrogen3d { .. } => "hydrogen_3d",
            Self::BuckyBall { .. } => "bucky_ball",
            Self::Checkerboard { .. } => "checkerboard",
            Self::Shells { .. } => "shells",
        }
    }

    /// What people call the field, and one line about it.
    pub fn help(&self) -> (&'static str, &'static str) {
        match self {
            Self::Constant { .. } => ("Constant", "The same value everywhere."),
            Self::Ramp { .. } => ("Ramp", "Rises linearly from 0 to 1 along one axis."),
            Self::SphereDistance { .. } => ("Sphere distance", "The signed distance to a sphere, negative inside."),
            Self::GaussianBlob { .. } => ("Gaussian blob", "A soft ball, 1 in the middle."),
            Self::MarschnerLobb { .. } => {
                ("Marschner-Lobb", "The classic test of reconstruction filters; sample it with 41 x 41 x 41 voxels.")
            }
            Self::Hydrogen1s { .. } => ("Hydrogen 1s", "The electron of a hydrogen atom in its ground state."),
            Self::Hydrogen2p { .. } => ("Hydrogen 2p", "The electron of a hydrogen atom: two lobes along z."),
            Self::Hydrogen3d { .. } => {
                ("Hydrogen 3d", "The electron of a hydrogen atom: two lobes along z and a ring.")
            }
            Self::BuckyBall { .. } => ("Bucky ball", "Sixty atoms on a football."),
            Self::Checkerboard { .. } => ("Checkerboard", "Cubes of 0 and 1: hard edges everywhere."),
            Self::Shells { .. } => ("Shells", "Concentric waves."),
        }
    }

    /// The value at a point of the domain.
    pub fn value(&self, p: DVec3) -> f64 {
        match *self {
            Self::Constant { value } => value,
            Self::Ramp { axis } => 0.5 * (p[axis.min(2)] + 1.0),
            Self::SphereDistance { radius } => p.length() - radius,
            Self::GaussianBlob { sigma } => gaussian(p, sigma),
            Self::MarschnerLobb { frequency, alpha } => {
                let wave = (2.0 * PI * frequency * (FRAC_PI_2 * p.x.hypot(p.y)).cos()).cos();
                (1.0 - (FRAC_PI_2 * p.z).sin() + alpha * (1.0 + wave)) / (2.0 * (1.0 + alpha))
            }
            Self::Hydrogen1s { bohr } => hydrogen::s1(p, bohr),
            Self::Hydrogen2p { bohr } => hydrogen::p2(p, bohr),
            Self::Hydrogen3d { bohr } => hydrogen::d3(p, bohr),
            Self::BuckyBall { radius, sigma } => ball_corners(radius).map(|corner| gaussian(p - corner, sigma)).sum(),
            Self::Checkerboard { cells } => {
                let cell = |x: f64| (0.5 * (x + 1.0) * f64::from(cells)).floor();
                (cell(p.x) + cell(p.y) + cell(p.z)).rem_euclid(2.0)
            }
            Self::Shells { count } => 0.5 * (1.0 + (2.0 * PI * count * p.length()).cos()),
        }
    }

    /// The gradient at a point of the domain, per domain unit; none where the field has jumps. At a cusp (the centre of
    /// distances and hydrogen atoms) it is zero.
    pub fn gradient(&self, p: DVec3) -> Option<DVec3> {
        Some(match *self {
            Self::Constant { .. } => DVec3::ZERO,
            Self::Ramp { axis } => 0.5 * DVec3::AXES[axis.min(2)],
            Self::SphereDistance { .. } => p.normalize_or_zero(),
            Self::GaussianBlob { sigma } => gaussian_gradient(p, sigma),
            Self::MarschnerLobb { frequency, alpha } => marschner_lobb_gradient(p, frequency, alpha),
            Self::Hydrogen1s { bohr } => hydrogen::s1_gradient(p, bohr),
            Self::Hydrogen2p { bohr } => hydrogen::p2_gradient(p, bohr),
            Self::Hydrogen3d { bohr } => hydrogen::d3_gradient(p, bohr),
            Self::BuckyBall { radius, sigma } => {
                ball_corners(radius).map(|corner| gaussian_gradient(p - corner, sigma)).sum()
            }
            Self::Checkerboard { .. } => return None,
            Self::Shells { count } => p.normalize_or_zero() * (-PI * count * (2.0 * PI * count * p.length()).sin()),
        })
    }
}

fn gaussian(p: DVec3, sigma: f64) -> f64 {
    (-p.length_squared() / (2.0 * sigma * sigma)).exp()
}

fn gaussian_gradient(p: DVec3, sigma: f64) -> DVec3 {
    p * (-gaussian(p, sigma) / (sigma * sigma))
}

fn marschner_lobb_gradient(p: DVec3, frequency: f64, alpha: f64) -> DVec3 {
    let radius = p.x.hypot(p.y);
    let phase = 2.0 * PI * frequency * (FRAC_PI_2 * radius).cos();
    let along_radius = alpha * phase.sin() * 2.0 * PI * frequency * FRAC_PI_2 * (FRAC_PI_2 * radius).sin();
    let outwards = DVec3::new(p.x, p.y, 0.0).normalize_or_zero();
    (outwards * along_radius - DVec3::Z * (FRAC_PI_2 * (FRAC_PI_2 * p.z).cos())) / (2.0 * (1.0 + alpha))
}

/// The sixty corners of a truncated icosahedron at this distance from the centre.
fn ball_corners(radius: f64) -> impl Iterator<Item = DVec3> {
    let signed = BALL_CORNERS.into_iter().flat_map(|corner| {
        (0..8_u32).filter_map(move |signs| {
            // A zero has no sign.
            let redundant = corner[0] == 0.0 && signs & 1 == 1;
            let signed = std::array::from_fn(|axis| if signs >> axis & 1 == 1 { -corner[axis] } else { corner[axis] });
            (!redundant).then_some(DVec3::from_array(signed))
        })
    });
    let turned = signed.flat_map(|c| [c, DVec3::new(c.y, c.z, c.x), DVec3::new(c.z, c.x, c.y)]);
    turned.map(move |corner| corner.normalize() * radius)
}
