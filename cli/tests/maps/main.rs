//! Reading map files: real maps, maps written by the tests, and files that must be refused.

mod arrays;
mod bad;
mod gridmaps;
mod images;
mod png_bytes;
mod real;
mod seeds;
mod support;
mod warnings;
