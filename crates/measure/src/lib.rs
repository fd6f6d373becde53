//! Measures the trade of speed for accuracy of a network.
//!
//! A [`Plan`] names settings of a network: variations of its properties ([`Vary`]) and ready ladders of knobs ([`ladder`]).
//! [`measure`] renders every setting from several views, times it, counts its samples and compares it with a reference; a
//! [`Measurements`] is written as CSV, JSON and a page to read ([`write_all`]). [`Subject`] translates what a ray traversal
//! shows into a scene of the float64 reference, which can also be drawn on its own ([`draw`]). [`tune`] picks a setting.

mod advice;
mod bench;
mod budget;
mod chain;
mod csv;
mod draw;
mod error;
mod error_color;
mod errors;
mod estimate;
mod figures;
mod ladder;
mod lighting;
mod measurements;
mod output;
pub mod pareto;
mod plan;
pub mod probe;
pub mod rays;
mod refine;
mod report;
mod run;
mod scene;
mod setting;
mod surface;
mod tune;
pub mod verify;
mod views;
mod yardstick;

pub use budget::{Budget, Row};
pub use chain::Chain;
pub use draw::{draw, user_cache};
pub use error::{MeasureError, Refusal};
pub use error_color::{FAINTEST_ERROR, error_color, error_colors};
pub use errors::Errors;
pub use estimate::Estimate;
pub use figures::{Counts, Displayed, Figures, Summary};
pub use ladder::{LADDERS, Ladder, ladder};
pub use measurements::{Measured, Measurements, Refused};
pub use output::write_all;
pub use plan::{Listener, MOST_SETTINGS, Plan, silent};
pub use refine::Refiner;
pub use run::measure;
pub use scene::Subject;
pub use setting::{Assignment, Setting, Vary};
pub use surface::{Spread, SurfaceErrors};
pub use tune::{Goal, Progress, Tried, Tuned, Verdict, picture_error, tune};
pub use yardstick::Standard;
