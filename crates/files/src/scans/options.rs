//! How logs of scans are read.

/// The options of the readers of scans. The default is everything as the file says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ScanOptions {
    /// The greatest range, in metres: from there on a number means no return. The file's own if absent.
    pub maximum_range: Option<f64>,
    /// The field of a CARMEN message that has its time.
    pub time: TimeField,
}

/// The field of a CARMEN message that has its time. A message ends with `ipc_timestamp host logger_timestamp`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum TimeField {
    /// The first one, `ipc_timestamp`: when the message was made, since 1970.
    #[default]
    Sent,
    /// The last one, `logger_timestamp`: when it was written, since the logger began.
    Logged,
}
