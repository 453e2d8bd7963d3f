//! The occupancies of a tree that only tells free from occupied, as the command line takes them.

use std::str::FromStr;

/// The occupancies that stand for free and for occupied, where a file tells only these apart: 0 and 1 if they are not given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clamp {
    free: f64,
    occupied: f64,
}

impl Default for Clamp {
    fn default() -> Self {
        Self { free: 0.0, occupied: 1.0 }
    }
}

impl FromStr for Clamp {
    type Err = String;

    /// Reads `MIN,MAX`.
    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once(',').and_then(|(free, occupied)| {
            Some(Self { free: free.trim().parse().ok()?, occupied: occupied.trim().parse().ok()? })
        });
        match numbers {
            Some(clamp)
                if (0.0..0.5).contains(&clamp.free) && 0.5 < clamp.occupied && clamp.occupied <= 1.0 =>
            {
                Ok(clamp)
            }
            _ => Err("allowed are two occupancies MIN,MAX with 0 <= MIN < 1/2 < MAX <= 1".to_owned()),
        }
    }
}

impl Clamp {
    /// Returns the occupancy of what is free, below 1/2.
    pub fn free(self) -> f64 {
        self.free
    }

    /// Returns the occupancy of what is occupied, above 1/2.
    pub fn occupied(self) -> f64 {
        self.occupied
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clamp_has_one_half_between_its_ends() {
        assert_eq!("0.1192, 0.971".parse(), Ok(Clamp { free: 0.1192, occupied: 0.971 }));
        for text in ["0.5,0.9", "0.1,0.5", "-0.1,0.9", "0.1,1.1", "nan,0.9", "0.1", "0.1,x"] {
            assert!(text.parse::<Clamp>().is_err(), "{text}");
        }
    }
}
