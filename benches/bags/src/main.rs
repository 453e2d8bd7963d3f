//! Reads a bag in MCAP as a stream by the crate `mcap` and counts its messages and their bytes: what reading alone takes.
//!
//! `cargo run --release --manifest-path benches/bags/Cargo.toml -- BAG`

use mcap::sans_io::{LinearReadEvent, LinearReader};
use std::error::Error;
use std::fs::File;
use std::io::Read;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("give the name of a bag")?;
    let mut file = File::open(path)?;
    let mut reader = LinearReader::new();
    let (mut messages, mut bytes) = (0_u64, 0_u64);
    while let Some(event) = reader.next_event() {
        match event? {
            LinearReadEvent::ReadRequest(need) => {
                let read = file.read(reader.insert(need))?;
                reader.notify_read(read);
            }
            LinearReadEvent::Record { data, opcode } => {
                if opcode == mcap::records::op::MESSAGE {
                    messages += 1;
                    bytes += data.len() as u64;
                }
            }
        }
    }
    println!("{messages} messages, {bytes} bytes");
    Ok(())
}
