//! Rigorous integration: [`Rigorous`], whose results contain the integral, always.
//!
//! ```text
//! int_a^b f  in  sum of w_i f(x_i) + [-R, R],    |R| <= (64/15) (b - a)/2 G r^-2n / (1 - r^-2),    |f| <= G
//! ```
//!
//! on panels with an ellipse about them on which `f` is analytic, and `int_a^b f in (b - a) f([a, b])` on tiny ones
//! where it is not. The chapter [`integration`](crate::book::integration) derives the bound.

mod gauss;
mod integrate;
mod nodes;
mod search;
mod settings;
mod state;
mod survey;
#[cfg(test)]
mod tests;

pub(crate) use integrate::break_points;
pub use settings::Rigorous;
