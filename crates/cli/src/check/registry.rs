//! The list of operations, written: its JSON is that of `vectors/v1/operations.json`.

use crate::output::{Record, Report, Value, folded, text_table};
use mean_information::operations::{Argument, OPERATIONS, Operation, Shape};

/// The number of characters, about, to which the table folds equations.
const EQUATION_WIDTH: usize = 60;

/// The list of every operation of the protocol.
#[derive(Clone, Copy, Debug, Default)]
pub struct Registry;

/// Returns the arguments as they are written in a formula: `p`, `cells[]`, `particles[][]`.
fn arguments(operation: &Operation) -> Vec<String> {
    let brackets = |argument: &Argument| match argument.shape {
        Shape::Float => "",
        Shape::List => "[]",
        Shape::Rows => "[][]",
        other => other.name(),
    };
    operation.arguments.iter().map(|argument| format!("{}{}", argument.name, brackets(argument))).collect()
}

/// Returns the record of an operation, with the arguments as given.
fn record(operation: &Operation, arguments: Value) -> Record {
    let text = |text: &str| Value::Text(text.to_owned());
    Record(vec![
        ("name", text(operation.name)),
        ("arguments", arguments),
        ("result", text(operation.result.name())),
        ("domain", text(operation.domain)),
        ("equation", text(operation.equation)),
        ("function", text(operation.function)),
        ("tolerance_ulp", Value::Given(Some(operation.tolerance_ulp))),
    ])
}

impl Report for Registry {
    fn table(&self) -> String {
        let row = |operation: &Operation| {
            [
                operation.name.to_owned(),
                arguments(operation).join("\n"),
                folded(operation.equation, EQUATION_WIDTH),
                operation.tolerance_ulp.to_string(),
            ]
        };
        let header = ["operation", "arguments", "exact result", "tolerance\n(ulp)"];
        text_table(header, OPERATIONS.iter().map(row))
    }

    fn rows(&self) -> Vec<Record> {
        OPERATIONS.iter().map(|operation| record(operation, Value::Texts(arguments(operation)))).collect()
    }

    fn json(&self) -> Value {
        let argument = |argument: &Argument| {
            let text = |text: &str| Value::Text(text.to_owned());
            Record(vec![("name", text(argument.name)), ("shape", text(argument.shape.name()))])
        };
        let nested = |operation: &Operation| {
            record(operation, Value::Records(operation.arguments.iter().map(argument).collect()))
        };
        Value::Records(OPERATIONS.iter().map(nested).collect())
    }
}
