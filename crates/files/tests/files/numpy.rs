//! Arrays as programs save them: other integers, unknown values, archives, and what makes them mean less than they seem.

use crate::support::{Nobody, measure, percents, probabilities, read_twice, refusal, warnings};
use mean_information_files::{
    ArrayEncoding, Contents, ErrorKind, Options, Warning, read_map_contents, read_weights,
};
use mean_information_test_support::formats::{Folder, npy};
use std::fs;
use std::io::{Cursor, Write};
use std::path::Path;
use zip::CompressionMethod;
use zip::write::{SimpleFileOptions, ZipWriter};

fn doubles(cells: &[f64]) -> Vec<u8> {
    let data: Vec<u8> = cells.iter().flat_map(|x| x.to_le_bytes()).collect();
    npy("'<f8'", false, &format!("(1, {})", cells.len()), &data)
}

fn read(bytes: &[u8], options: &Options) -> mean_information_files::Map {
    let folder = Folder::new();
    read_twice(&folder.write("map.npy", bytes), options).unwrap()
}

fn percent() -> Options {
    Options { encoding: Some(ArrayEncoding::Percent), ..Options::default() }
}

#[test]
fn integers_whose_values_fit_are_read_as_what_they_are_said_to_be() {
    let values = [0_i8, 100, -1, 50, 7, 93];
    let wide: [(&str, Vec<u8>); 4] = [
        ("'<i2'", values.iter().flat_map(|&v| i16::from(v).to_le_bytes()).collect()),
        ("'>i4'", values.iter().flat_map(|&v| i32::from(v).to_be_bytes()).collect()),
        ("'<i8'", values.iter().flat_map(|&v| i64::from(v).to_le_bytes()).collect()),
        ("'|i1'", values.iter().map(|&v| v.cast_unsigned()).collect()),
    ];
    for (descr, data) in wide {
        for (order, shape) in [(false, "(2, 3)"), (true, "(1, 6)")] {
            let map = read(&npy(descr, order, shape, &data), &percent());
            assert_eq!(percents(&map), values, "{descr}");
        }
        let mrpt = Options { encoding: Some(ArrayEncoding::Mrpt), ..Options::default() };
        assert_eq!(measure(&read(&npy(descr, false, "(2, 3)", &data), &mrpt)).unknown, 1);
    }
    // Without being said, only those of one byte are plain.
    let map = read(&npy("'|u1'", false, "(1, 4)", &[0, 100, 255, 7]), &Options::default());
    assert_eq!(percents(&map), [0, 100, -1, 7]);
    let map = read(&npy("'|b1'", false, "(1, 3)", &[0, 1, 1]), &Options::default());
    assert_eq!(percents(&map), [0, 100, 100]);
    let line =
        refusal("map.npy", npy("'<i8'", false, "(1, 1)", &[7, 0, 0, 0, 0, 0, 0, 0]), &Options::default());
    assert!(line.contains("int64") && line.contains("int8") && line.contains("p.astype('i1')"), "{line}");
    let line = refusal("map.npy", npy("'<i2'", false, "(1, 2)", &[7, 0, 44, 1]), &percent());
    assert!(line.contains("row 0, column 1 is 300, allowed is a percentage"), "{line}");
    let line = refusal("map.npy", npy("'|u1'", false, "(1, 2)", &[7, 205]), &Options::default());
    assert!(line.contains("is 205") && line.contains("(255 - g) / 255"), "{line}");
}

#[test]
fn a_value_of_floats_may_mean_unknown() {
    for unknown in [f64::NAN, -1.0, 0.2, 77.5] {
        let options = Options { unknown: Some(unknown), ..Options::default() };
        assert_eq!(probabilities(&read(&doubles(&[0.25, unknown, 1.0]), &options)), [0.25, 0.5, 1.0]);
        let single: Vec<u8> = [0.25, unknown, 1.0].iter().flat_map(|&x| (x as f32).to_le_bytes()).collect();
        assert_eq!(measure(&read(&npy("'<f4'", true, "(3, 1)", &single), &options)).unknown, 1);
        let log_odds = Options { encoding: Some(ArrayEncoding::LogOdds), ..options };
        assert_eq!(measure(&read(&doubles(&[0.25, unknown, 1.0]), &log_odds)).unknown, 1);
    }
    // Any other value is what it is.
    let options = Options { unknown: Some(-1.0), ..Options::default() };
    let line = refusal("map.npy", doubles(&[0.25, f64::NAN]), &options);
    assert!(line.contains("is NaN"), "{line}");
    let line = refusal("map.npy", npy("'|i1'", false, "(1, 1)", &[7]), &options);
    assert!(line.contains("holds int8, where no value can be given for unknown"), "{line}");
}

#[test]
fn refusals_give_the_line_of_python_that_helps() {
    let log_odds = Options { encoding: Some(ArrayEncoding::LogOdds), ..Options::default() };
    for (bytes, options, words) in [
        (doubles(&[0.1, f64::NAN]), &Options::default(), "np.nan_to_num(p, nan=0.5)"),
        (doubles(&[0.1, f64::NAN]), &log_odds, "np.nan_to_num(l, nan=0.0)"),
        (doubles(&[0.1, 50.0]), &Options::default(), "; np.where(p == -1, 0.5, p / 100) makes"),
        (doubles(&[0.1, 2.25]), &Options::default(), "1 / (1 + np.exp(-l)) of log-odds"),
        (doubles(&[0.1, 205.0]), &Options::default(), "(255 - g) / 255"),
        (npy("'<f8'", false, "()", &[0; 8]), &Options::default(), "p.reshape(rows, columns)"),
        (npy("'<f8'", false, "(1, 1, 1, 2)", &[0; 16]), &Options::default(), "np.squeeze(p)"),
        (npy("'<f8'", false, "(2, 1, 1)", &[0; 16]), &Options::default(), "a[:, :, 0] is its map"),
        (b"\x80\x04\x95".to_vec(), &Options::default(), "it is a pickle; load it with pickle.load"),
        (
            b"PK\x03\x04".to_vec(),
            &Options::default(),
            "it is a zip archive; if np.savez wrote it, name it .npz",
        ),
        (b"\x89HDF\r\n\x1a\n".to_vec(), &Options::default(), "it is HDF5; load it with h5py"),
        (b"<!DOCTYPE html>".to_vec(), &Options::default(), "it is a web page"),
        (b"0.5 0.25\n".to_vec(), &Options::default(), "np.loadtxt(FILE)"),
        (Vec::new(), &Options::default(), "it is empty; copy or save it again"),
        (b"\x01\x02\x03\x04".to_vec(), &Options::default(), "np.save('p.npy', p) writes one"),
        (doubles(&[0.1, 0.2])[..140].to_vec(), &Options::default(), "it is cut short; copy or save it again"),
        (doubles(&[0.1, 0.2]).repeat(2), &Options::default(), "more follows; save one array by itself"),
        (doubles(&[0.1, -1.0]), &Options::default(), "np.where(p == -1, 0.5, p / 100) makes"),
        (doubles(&[0.1, 1.0000000000000002]), &Options::default(), "np.clip(p, 0, 1)"),
        (doubles(&[0.1, -3.5]), &Options::default(), "1 / (1 + np.exp(-l))"),
        (npy("'<f2'", false, "(1, 1)", &[0, 0]), &Options::default(), "p.astype('f8')"),
        (npy("'<c16'", false, "(1, 1)", &[0; 16]), &Options::default(), "p.real"),
        (npy("'<f8'", false, "(2,)", &[0; 16]), &Options::default(), "p.reshape(rows, columns)"),
        (npy("'<f8'", false, "(1, 1, 2)", &[0; 16]), &Options::default(), "a[0]"),
        (npy("'|i1'", false, "(1, 1)", &[0]), &log_odds, "l.astype('f4')"),
    ] {
        let line = refusal("map.npy", bytes, options);
        assert!(line.contains(words), "{line}: {words}");
    }
    let line = refusal("map.npy", doubles(&[0.2, -5e-324]), &Options::default());
    assert!(line.contains("is -5e-324, allowed is a probability from 0 to 1") && line.len() < 200, "{line}");
}

#[test]
fn percentages_of_0_and_1_may_be_states() {
    let of = |bytes: &[u8]| {
        read(&npy("'|i1'", false, &format!("(1, {})", bytes.len()), bytes), &Options::default())
    };
    assert_eq!(of(&[0, 1, 255, 1]).warnings, [Warning::NoPercentageAbove1 { count: 2 }]);
    assert!(warnings(&of(&[0, 1]))[0].starts_with("no cell above 1: 0 and 1 are read as 0 % and 1 %"));
    assert_eq!(of(&[0, 1, 2]).warnings, []);
    assert_eq!(of(&[0, 255, 0]).warnings, []);
}

#[test]
fn averages_beside_unknown_are_counted() {
    let beside = 0.5_f64.next_down();
    let mut cells = vec![0.25; 98];
    cells.extend([beside, 0.5_f64.next_up()]);
    assert_eq!(read(&doubles(&cells), &Options::default()).warnings, [Warning::BesideUnknown { count: 2 }]);
    cells[99] = 0.5;
    assert_eq!(read(&doubles(&cells), &Options::default()).warnings, []);
    let single: Vec<u8> = [0.5_f32.next_up(), 0.25].iter().flat_map(|x| x.to_le_bytes()).collect();
    let map = read(&npy("'<f4'", false, "(2, 1)", &single), &Options::default());
    assert_eq!(map.warnings, [Warning::BesideUnknown { count: 1 }]);
    let log_odds = Options { encoding: Some(ArrayEncoding::LogOdds), ..Options::default() };
    assert_eq!(read(&doubles(&[1e-17, 1.0]), &log_odds).warnings, [Warning::BesideUnknown { count: 1 }]);
    assert_eq!(read(&doubles(&[1e-3, 1.0, 0.0]), &log_odds).warnings, []);
    // An average in single precision, saved in double.
    let widened = f64::from(0.5_f32.next_up());
    assert_eq!(
        read(&doubles(&[widened, 0.25]), &Options::default()).warnings,
        [Warning::BesideUnknown { count: 1 }]
    );
    assert_eq!(read(&doubles(&[widened.next_up(), 0.25]), &Options::default()).warnings, []);
}

#[test]
fn greys_of_255_that_often_mean_unknown_are_said() {
    for grey in [127_u8, 128, 205, 50] {
        let value = f64::from(grey) / 255.0;
        let many = [value, value, 0.25, 1.0, 0.0, 0.75, 0.125];
        let expected = Warning::OftenUnknownValue { grey, value, count: 2 };
        assert_eq!(read(&doubles(&many), &Options::default()).warnings, [expected]);
        let few = [value, 0.25, 1.0, 0.0, 0.75];
        assert_eq!(read(&doubles(&few), &Options::default()).warnings, []);
        let options = Options { unknown: Some(value), ..Options::default() };
        assert_eq!(read(&doubles(&many), &options).warnings, []);
    }
    assert_eq!(read(&doubles(&[126.0 / 255.0; 9]), &Options::default()).warnings, []);
}

/// An archive of arrays.
fn npz(arrays: &[(&str, &[u8])], method: CompressionMethod) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in arrays {
        let options = SimpleFileOptions::default().compression_method(method);
        archive.start_file(format!("{name}.npy"), options).unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

#[test]
fn an_array_of_an_archive_is_named_by_its_key() {
    let (map, weights) =
        (doubles(&[0.25, 0.5, 1.0]), npy("'<f8'", false, "(2,)", &doubles(&[0.5, 0.25])[128..]));
    let folder = Folder::new();
    for method in [CompressionMethod::Stored, CompressionMethod::Deflated] {
        let both = npz(&[("map", &map[..]), ("w", &weights)], method);
        let path = folder.write("both.npz", both);
        let key = |key: &str| Path::new(&format!("{}:{key}", path.display())).to_owned();
        let read_map = read_twice(&key("map"), &Options::default()).unwrap();
        assert_eq!(probabilities(&read_map), [0.25, 0.5, 1.0]);
        assert_eq!(read_map.files, std::slice::from_ref(&path));
        assert_eq!(read_weights(&key("w"), &Options::default()).unwrap(), [0.5, 0.25]);
        let refused = read_twice(&path, &Options::default()).unwrap_err().to_string();
        assert!(refused.contains("holds 2 arrays; name one, as FILE.npz:KEY; it has "), "{refused}");
        let refused = read_twice(&key("p"), &Options::default()).unwrap_err();
        // The file is there.
        assert_eq!(refused.kind(), ErrorKind::Choice);
        let refused = refused.to_string();
        assert!(refused.contains("both.npz:p: has no array \"p\""), "{refused}");
        let one = folder.write("one.npz", npz(&[("map", &map)], method));
        assert_eq!(probabilities(&read_twice(&one, &Options::default()).unwrap()), [0.25, 0.5, 1.0]);
    }
    assert!(refusal("map.npz", "no archive", &Options::default()).contains("is no .npz file"));
}

/// As in NumPy a key may have the ending of its member, and colons; other members than arrays are none, and a checksum that
/// does not fit is found.
#[test]
fn archives_are_read_as_numpy_reads_them() {
    let map = doubles(&[0.25, 0.5, 1.0]);
    let folder = Folder::new();
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in [("readme.txt", &b"text"[..]), ("a:b.npy", &map)] {
        archive
            .start_file(name, SimpleFileOptions::default().compression_method(CompressionMethod::Stored))
            .unwrap();
        archive.write_all(bytes).unwrap();
    }
    let bytes = archive.finish().unwrap().into_inner();
    let path = folder.write("one.npz", &bytes);
    for key in ["", ":a:b", ":a:b.npy"] {
        let named = Path::new(&format!("{}{key}", path.display())).to_owned();
        assert_eq!(
            probabilities(&read_twice(&named, &Options::default()).unwrap()),
            [0.25, 0.5, 1.0],
            "{key}"
        );
    }
    let place = bytes.windows(8).position(|window| window == 0.25_f64.to_le_bytes()).unwrap();
    let mut damaged = bytes.clone();
    damaged[place] ^= 1;
    assert!(
        refusal("map.npz", &damaged, &Options::default()).contains("the checksum of the array is another")
    );
    assert!(refusal("map.npz", &bytes[..99], &Options::default()).contains("is no .npz file, or cut short"));
    let none = npz(&[], CompressionMethod::Stored);
    assert!(refusal("map.npz", &none, &Options::default()).contains("holds no array"));
    // A method of compression that NumPy does not write: its number stands in both heads of the member.
    let mut packed = npz(&[("map", &map)], CompressionMethod::Stored);
    let central = packed.windows(4).position(|window| window == b"PK\x01\x02").unwrap();
    (packed[8], packed[central + 10]) = (12, 12);
    let line = refusal("map.npz", &packed, &Options::default());
    assert!(
        line.contains("is an .npz file that is not read") && line.contains("np.savez_compressed"),
        "{line}"
    );
}

/// 400 million cells are above the limit on those that are kept; which is no matter of a file that only claims them.
#[test]
fn cells_that_are_only_counted_have_no_limit() {
    let folder = Folder::new();
    let path = folder.write("map.npy", npy("'|i1'", false, "(20000, 20000)", &[0; 8]));
    let few = || Options { max_cells: Some(1 << 20), ..Options::default() };
    let kept = || mean_information_files::read_map(&path, &Options::default()).unwrap_err().to_string();
    let counted = |options| read_map_contents(&path, &options, &mut Nobody).unwrap_err().to_string();
    for refused in [kept(), counted(Options::default()), counted(few())] {
        assert!(refused.contains("its header claims 400000128: it is cut short"), "{refused}");
    }
    fs::File::options().write(true).open(&path).unwrap().set_len(400_000_128).unwrap();
    assert!(kept().contains("more than the limit of 268435456"), "{}", kept());
    assert!(counted(few()).contains("more than the limit of 1048576"));
    let path = folder.write("map.npy", npy("'|i1'", false, "(2, 2)", &[0, 100, 50, 255]));
    let contents = read_map_contents(&path, &Options::default(), &mut Nobody).unwrap().cells;
    assert!(matches!(contents, Contents::Counted(_)), "{contents:?}");
}
