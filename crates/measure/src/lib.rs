//! Measures the trade of speed for accuracy of a network.
//!
//! A [`Plan`] names settings of a network: variations of its properties ([`Vary`]) and ready ladders of knobs ([`ladder`]).
//! [`measure`] renders every setting from several views, times it, counts its samples and compares it with a reference; a
//! [`Measurements`] is written as CSV, JSON and a page to read ([`write_all`]). [`Subject`] translates what a ray traversal
//! shows into a scene of the float64 reference, which can also be drawn on its own ([`draw`]). [`tune`] picks a setting.

mod error;
mod errors;
mod report;
mod run;
mod subject;
mod text;
mod tune;
pub mod verify;

pub use error::{MeasureError, Refusal};
pub use errors::Errors;
pub use errors::color::{FAINTEST_ERROR, error_color, error_colors};
pub use errors::estimate::Estimate;
pub use errors::surface::{Spread, SurfaceErrors};
pub use report::output::write_all;
pub use run::budget::{Budget, Row};
pub use run::draw::{draw, user_cache};
pub use run::figures::{Counts, Displayed, Figures, Summary};
pub use run::ladder::{LADDERS, Ladder, ladder};
pub use run::measure;
pub use run::measurements::{Measured, Measurements, Refused};
pub use run::pareto;
pub use run::plan::{Listener, MOST_SETTINGS, Plan, silent};
pub use run::refine::Refiner;
pub use run::setting::{Assignment, Setting, Vary};
pub use run::yardstick::Standard;
pub use subject::Subject;
pub use subject::chain::Chain;
pub use tune::{Goal, Progress, Tried, Tuned, Verdict, picture_error, tune};
