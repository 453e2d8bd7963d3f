//! Reading map files: real maps, maps written by the tests, and files that must be refused.

mod arrays;
mod bad;
mod gridmaps;
mod images;
mod png_bytes;
mod png_kinds;
mod real;
mod rules;
mod seeds;
mod support;
mod warnings;
