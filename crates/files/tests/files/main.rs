//! Reading files: real maps, maps written by the tests, and files that must be refused.

mod arrays;
mod bad;
mod bag_messages;
mod bag_seeds;
mod bags;
mod decoded;
mod errors;
mod field;
mod filters;
mod gridmaps;
mod images;
mod numpy;
mod octrees;
mod pbstreams;
mod png_kinds;
mod real;
mod rules;
mod scans;
mod seeds;
mod sources;
mod support;
mod table;
mod trajectories;
mod tree_seeds;
mod warnings;
