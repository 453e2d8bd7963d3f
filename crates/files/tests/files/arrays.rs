//! `.npy` arrays written here: every element, byte order, memory order and encoding.

use crate::support::{measure, read_twice, refusal, refusal_of};
use mean_information_files::{ArrayEncoding, Cells, Options};
use mean_information_test_support::formats::{Folder, npy};

/// How a number is stored.
type Bytes = fn(f64) -> Vec<u8>;

/// Rows from the lowest.
const CELLS: [[f64; 3]; 2] = [[0.25, 0.5, 1.0], [0.0, 0.75, 0.125]];

fn data(fortran_order: bool, bytes: Bytes) -> Vec<u8> {
    let mut order: Vec<f64> = Vec::new();
    if fortran_order {
        (0..3).for_each(|column| order.extend([CELLS[0][column], CELLS[1][column]]));
    } else {
        order.extend(CELLS.concat());
    }
    order.into_iter().flat_map(bytes).collect()
}

#[test]
fn floats_of_both_sizes_byte_orders_and_memory_orders() {
    let folder = Folder::new();
    let formats: [(&str, Bytes); 4] = [
        ("'<f8'", |x| x.to_le_bytes().to_vec()),
        ("'>f8'", |x| x.to_be_bytes().to_vec()),
        ("'<f4'", |x| (x as f32).to_le_bytes().to_vec()),
        ("'>f4'", |x| (x as f32).to_be_bytes().to_vec()),
    ];
    for (descr, bytes) in formats {
        for fortran_order in [false, true] {
            let path =
                folder.write("map.npy", npy(descr, fortran_order, "(2, 3)", &data(fortran_order, bytes)));
            let map = read_twice(&path, &Options { resolution: Some(0.125), ..Options::default() }).unwrap();
            assert_eq!(map.resolution, Some(0.125));
            let cells: Vec<f64> = match map.cells {
                Cells::Probability64(grid) => {
                    assert_eq!((grid.width(), grid.height(), grid.geometry().resolution()), (3, 2, 0.125));
                    grid.cells().to_vec()
                }
                Cells::Probability32(grid) => grid.cells().iter().copied().map(f64::from).collect(),
                other => panic!("{other:?}"),
            };
            assert_eq!(cells, CELLS.concat(), "{descr} {fortran_order}");

            let options = Options { encoding: Some(ArrayEncoding::LogOdds), ..Options::default() };
            let log_odds = read_twice(&path, &options).unwrap();
            // Of log-odds, only 0 is unknown.
            assert_eq!((measure(&log_odds).unknown, measure(&log_odds).occupied), (1, 5));
            assert_eq!(log_odds.resolution, None);
        }
    }
}

#[test]
fn bytes_are_percentages_unless_they_are_said_to_be_mrpt_s() {
    let folder = Folder::new();
    let bytes = [0_i8, 100, -1, 50, 7, 93].map(i8::cast_unsigned);
    let path = folder.write("map.npy", npy("'|i1'", false, "(3, 2)", &bytes));
    let percent = measure(&read_twice(&path, &Options::default()).unwrap());
    assert_eq!((percent.free, percent.occupied, percent.unknown), (2, 2, 2));
    let options = Options { encoding: Some(ArrayEncoding::Mrpt), ..Options::default() };
    let mrpt = measure(&read_twice(&path, &options).unwrap());
    // Positive is free.
    assert_eq!((mrpt.free, mrpt.occupied, mrpt.unknown), (4, 1, 1));
}

#[test]
fn newer_versions_of_the_format() {
    let folder = Folder::new();
    for version in [2, 3] {
        let header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }\n";
        let mut bytes = vec![0x93, b'N', b'U', b'M', b'P', b'Y', version, 0];
        bytes.extend((header.len() as u32).to_le_bytes());
        bytes.extend(header);
        bytes.extend(data(false, |x| x.to_le_bytes().to_vec()));
        let map = read_twice(&folder.write("map.npy", bytes), &Options::default()).unwrap();
        assert_eq!((measure(&map).free, measure(&map).occupied, measure(&map).unknown), (3, 2, 1));
    }
}

#[test]
fn no_cells_are_a_map_of_no_cells() {
    let folder = Folder::new();
    for (order, shape) in [(false, "(0, 5)"), (true, "(5, 0)")] {
        let path = folder.write("map.npy", npy("'<f8'", order, shape, &[]));
        let measured = measure(&read_twice(&path, &Options::default()).unwrap());
        assert_eq!((measured.mean_information, measured.width * measured.height), (0.0, 0));
    }
}

#[test]
fn the_first_bad_cell_is_named() {
    let mut bytes = data(false, |x| x.to_le_bytes().to_vec());
    bytes[4 * 8..5 * 8].copy_from_slice(&f64::NAN.to_le_bytes());
    bytes[5 * 8..].copy_from_slice(&1.5_f64.to_le_bytes());
    let refused = refusal("map.npy", npy("'<f8'", false, "(2, 3)", &bytes), &Options::default());
    assert!(
        refused.ends_with(
            "cell at row 1, column 1 is NaN, allowed is a probability from 0 to 1; np.nan_to_num(p, nan=0.5) makes NaN \
             unknown"
        ),
        "{refused}"
    );

    let mut bytes = data(true, |x| (x as f32).to_be_bytes().to_vec());
    bytes[3 * 4..4 * 4].copy_from_slice(&(-0.25_f32).to_be_bytes());
    let refused = refusal("map.npy", npy("'>f4'", true, "(2, 3)", &bytes), &Options::default());
    assert!(refused.contains("cell at row 1, column 1 is -0.25"), "{refused}");

    let refused = refusal("map.npy", npy("'|i1'", false, "(2, 2)", &[1, 2, 3, 101]), &Options::default());
    assert!(refused.contains("row 1, column 1 is 101, allowed is a percentage"), "{refused}");
}

/// Many cells are read some at a time: each is visited once, and the first that is none is named, wherever it stands.
#[test]
fn arrays_of_several_pieces() {
    let folder = Folder::new();
    let (rows, columns) = (307, 500);
    let mut cells: Vec<f32> = (0..rows * columns).map(|k| (k * 7 % 13) as f32 / 12.0).collect();
    let written = |cells: &[f32]| {
        let bytes: Vec<u8> = cells.iter().flat_map(|p| p.to_le_bytes()).collect();
        folder.write("map.npy", npy("'<f4'", false, &format!("({rows}, {columns})"), &bytes))
    };
    let measured = measure(&read_twice(&written(&cells), &Options::default()).unwrap());
    // Of 13 successive cells one has 6/12.
    assert_eq!(measured.unknown, cells.iter().filter(|&&p| p == 0.5).count() as u64);
    assert_eq!(measured.unknown + measured.free + measured.occupied, cells.len() as u64);
    for (row, column) in [(306, 499), (131, 36), (131, 35), (32, 384), (0, 3)] {
        cells[row * columns + column] = 1.25;
        let refused = refusal_of(&written(&cells), &Options::default());
        let words = format!("cell at row {row}, column {column} is 1.25, ");
        assert!(refused.contains(&words), "{refused}");
    }
}

#[test]
fn what_is_no_map_is_refused() {
    let six = data(false, |x| x.to_le_bytes().to_vec());
    let good = npy("'<f8'", false, "(2, 3)", &six);
    let cases: Vec<(Vec<u8>, &str)> = vec![
        (Vec::new(), "is no .npy file"),
        (b"PK\x03\x04 a zip file".to_vec(), "is no .npy file"),
        (good[..9].to_vec(), "cut short"),
        (good[..40].to_vec(), "cut short"),
        (good[..good.len() - 1].to_vec(), "its header claims"),
        ([good.as_slice(), &[0]].concat(), "its header claims"),
        (npy("'|O'", false, "(2, 3)", &six), "Python objects"),
        (npy("'<c16'", false, "(1, 3)", &six), "complex"),
        (npy("'<f8'", false, "(1, 2, 3)", &six), "3 dimensions"),
        (npy("'<f8'", false, "(6,)", &six), "1 dimension"),
        (npy("[('p', '<f8')]", false, "(2, 3)", &six), "structured"),
        (npy("'<f8'", false, "(100000, 1000)", &six), "claims 800000128"),
        ([&b"\x93NUMPY\x02\x00\xff\xff\xff\xff"[..], &six].concat(), "claims a header of 4294967295 bytes"),
        ([&b"\x93NUMPY\x04\x00\x10\x00\x00\x00"[..], &six].concat(), "version 4"),
    ];
    for (bytes, words) in cases {
        let refused = refusal("map.npy", bytes, &Options::default());
        assert!(refused.contains(words), "{refused}: {words}");
    }
    for encoding in [ArrayEncoding::Percent, ArrayEncoding::Mrpt] {
        let options = Options { encoding: Some(encoding), ..Options::default() };
        let refused = refusal("map.npy", &good, &options);
        assert!(refused.contains("holds float64") && refused.contains("needs integers"), "{refused}");
    }
    for encoding in [ArrayEncoding::Probability, ArrayEncoding::LogOdds] {
        let options = Options { encoding: Some(encoding), ..Options::default() };
        let refused = refusal("map.npy", npy("'|i1'", false, "(2, 3)", &[1; 6]), &options);
        assert!(refused.contains("holds int8") && refused.contains("needs float32 or float64"), "{refused}");
    }
    for resolution in [0.0, -1.0, f64::NAN] {
        let options = Options { resolution: Some(resolution), ..Options::default() };
        assert!(refusal("map.npy", &good, &options).contains("resolution is"));
    }
}
