//! The operations that a port of this measure implements: one list, by name, with the exact meaning of each.
//!
//! The port protocol, the vectors, the command `meaninfo check`, the bench `operations` and the page
//! [`operations`](crate::book::operations) are driven by [`OPERATIONS`]. Arguments are the exact values of the floats,
//! and the tolerance counts from the exact real result.
//!
//! ```
//! use mean_information::operations::{Answer, Value, find};
//! let operation = find("map.mean_information").expect("in the list");
//! let cells = Value::List(vec![0.25_f64, 0.5, 0.96875]);
//! assert_eq!(operation.run(&[cells])?, Answer::Float(0.49404977561407626));
//! # Ok::<(), mean_information::operations::Refusal>(())
//! ```

mod answer;
mod operation;
mod run;
mod table;

pub use answer::{Answer, Refusal, Value};
pub use operation::{Argument, Operation, Outcome, Shape};
pub use table::{OPERATIONS, find};
