//! Counting the grids of a circular room: the time of a cell, in each way that the builders have.
//!
//! `cargo bench --bench room`.

#![allow(missing_docs)]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use mean_information::room::{CartesianRoom, PolarRoom, Sampling};
use mean_information::sensor::GaussianSensor;
use std::hint::black_box;

/// The room of the report's Fig. 4, in cells of 1 cm.
fn rooms(criterion: &mut Criterion) {
    let sensor = GaussianSensor::new(2.0_f64, 0.2).expect("a sensor");
    let mut group = criterion.benchmark_group("room");
    group.sample_size(20);

    let polar = PolarRoom::new(sensor, 0.001).expect("a room");
    group.throughput(Throughput::Elements(polar.rings().expect("rings")));
    group.bench_function("polar", |bencher| {
        bencher.iter(|| {
            let tally = black_box(&polar).tally().expect("a tally");
            assert_eq!(tally.mean_information(), 0.789_507_117_268_832_8);
        });
    });

    // Each evaluated cell stands for eight, two, one.
    for (name, offsets, expected) in [
        ("corner", [0.5, 0.5], 0.652_433_257_125_607_8),
        ("diagonal", [0.3, 0.3], 0.652_516_409_145_671_1),
        ("anywhere", [0.3, 0.1], 0.652_495_650_926_320_4),
    ] {
        let room = CartesianRoom::new(sensor, 0.01, offsets).expect("a room");
        let cells = room.width().expect("columns") * room.height().expect("rows");
        group.throughput(Throughput::Elements(cells));
        group.bench_function(format!("Cartesian, {name}"), |bencher| {
            bencher.iter(|| {
                let tally = black_box(&room).tally().expect("a tally");
                assert_eq!(tally.mean_information(), expected);
            });
        });
    }

    let room = CartesianRoom::new(sensor, 0.04, [0.5, 0.5]).expect("a room");
    let room = room.with_sampling(Sampling::Averaged(4)).expect("a room");
    let cells = room.width().expect("columns") * room.height().expect("rows");
    group.throughput(Throughput::Elements(cells));
    group.bench_function("Cartesian, corner, averaged over 4 x 4", |bencher| {
        bencher.iter(|| {
            let tally = black_box(&room).tally().expect("a tally");
            assert_eq!(tally.mean_information(), 0.640_061_879_793_278_7);
        });
    });
    group.finish();
}

criterion_group!(benches, rooms);
criterion_main!(benches);
