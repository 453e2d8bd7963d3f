//! Saved states of Cartographer put together from their parts.

use super::gzip;

const MAGIC: [u8; 8] = 0x7b1d_1f7b_5bf5_01db_u64.to_le_bytes();

/// Writes an integer of any size.
fn varint(mut number: u64) -> Vec<u8> {
    let mut bytes = Vec::new();
    while number >= 0x80 {
        bytes.push(number as u8 | 0x80);
        number >>= 7;
    }
    bytes.push(number as u8);
    bytes
}

/// Writes a field that is an integer.
pub fn integer(number: u64, value: u64) -> Vec<u8> {
    [varint(number << 3), varint(value)].concat()
}

/// Writes a field that is a message of these parts.
pub fn message(number: u64, parts: &[&[u8]]) -> Vec<u8> {
    let bytes = parts.concat();
    [varint(number << 3 | 2), varint(bytes.len() as u64), bytes].concat()
}

/// Writes a grid that claims 3 x 2 cells of 0.25 m, with these cells and more fields.
pub fn grid(cells: &[u64], more: &[u8]) -> Vec<u8> {
    let size = message(3, &[&integer(1, 3), &integer(2, 2)]);
    let limits = message(1, &[&[0x09], &0.25_f64.to_le_bytes(), &size]);
    let cells: Vec<u8> = cells.iter().flat_map(|&cell| varint(cell)).collect();
    message(4, &[&limits, &message(2, &[&cells]), more])
}

/// Writes a record with submap 5 of trajectory 2, in the plane.
pub fn submap(of_plane: &[u8]) -> Vec<u8> {
    submap_of([2, 5], of_plane)
}

/// Writes a record with a submap, given the number of its trajectory and its own, in the plane.
pub fn submap_of([trajectory, index]: [u64; 2], of_plane: &[u8]) -> Vec<u8> {
    let name = message(1, &[&integer(1, trajectory), &integer(2, index)]);
    message(3, &[&name, &message(2, &[&integer(3, 1), of_plane])])
}

/// Writes a state of a header of format version 2 and these records.
pub fn state(records: &[Vec<u8>]) -> Vec<u8> {
    stream(&[&[integer(1, 2)], records].concat())
}

/// Returns the byte at which the records of a [`state`] begin.
pub fn first_record() -> u64 {
    state(&[]).len() as u64
}

/// Writes a state of these records, of which the first is to be the header.
pub fn stream(records: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    for record in records {
        let packed = gzip(record);
        bytes.extend((packed.len() as u64).to_le_bytes());
        bytes.extend(packed);
    }
    bytes
}

/// Writes a field that is a number in double precision.
pub fn double(number: u64, value: f64) -> Vec<u8> {
    [varint(number << 3 | 1), value.to_le_bytes().to_vec()].concat()
}

/// Writes a pose: its position, and its orientation `[x, y, z, w]`.
pub fn rigid(number: u64, position: [f64; 3], turn: [f64; 4]) -> Vec<u8> {
    let numbers = |values: &[f64]| -> Vec<u8> {
        (1..).zip(values).flat_map(|(number, &value)| double(number, value)).collect()
    };
    message(number, &[&message(1, &[&numbers(&position)]), &message(2, &[&numbers(&turn)])])
}

/// Writes a compressed cloud that claims so many points.
pub fn cloud(number: u64, points: u64, data: &[i32]) -> Vec<u8> {
    let data: Vec<u8> = data.iter().flat_map(|&number| varint(i64::from(number).cast_unsigned())).collect();
    message(number, &[&integer(1, points), &message(3, &[&data])])
}

/// Writes a record with a node, by the numbers of its trajectory and of itself, at a time in steps of 100 ns since the year 1.
pub fn node([trajectory, index]: [u64; 2], time: u64, parts: &[&[u8]]) -> Vec<u8> {
    let id = message(1, &[&integer(1, trajectory), &integer(2, index)]);
    message(4, &[&id, &message(5, &[&integer(1, time), &parts.concat()])])
}

/// Writes a record with a pose graph of one trajectory: of each node the number and the pose.
pub fn graph(trajectory: u64, nodes: &[(u64, [f64; 3], [f64; 4])]) -> Vec<u8> {
    let nodes: Vec<u8> = nodes
        .iter()
        .flat_map(|&(index, position, turn)| message(1, &[&rigid(5, position, turn), &integer(7, index)]))
        .collect();
    message(1, &[&message(4, &[&nodes, &integer(3, trajectory)])])
}
