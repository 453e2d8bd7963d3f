//! The loaders' rules, restated: from the samples of a pixel to a percentage.

use crate::support::read_twice;
use mean_information_files::{Map, Mode, Options};
use mean_information_test_support::formats::Folder;

/// Thresholds, and whether white is occupied.
#[derive(Clone, Copy)]
pub(crate) struct Rule {
    pub(crate) free: f64,
    pub(crate) occupied: f64,
    pub(crate) negate: bool,
}

impl Rule {
    pub(crate) fn nav2(&self, mode: Mode, [r, g, b, a]: [u32; 4], white: u32) -> i8 {
        let quantum = |sample: u32| if white == 65535 { sample } else { 257 * (sample * 255 / white) };
        let grey_16 = (0.299 * f64::from(quantum(r))
            + 0.587 * f64::from(quantum(g))
            + 0.114 * f64::from(quantum(b))
            + 1e-6)
            .round() as u32;
        let level = grey_16 / 257;
        if mode == Mode::Raw {
            return if level > 100 { -1 } else { level as i8 };
        }
        if a < white {
            return -1;
        }
        let shade = level as f32 / 255.0_f32;
        let x = if self.negate { shade } else { 1.0_f32 - shade };
        let (free, occupied) = (self.free as f32, self.occupied as f32);
        match mode {
            _ if x <= free => 0,
            _ if x >= occupied => 100,
            Mode::Scale => ((x - free) / ((self.occupied - self.free) as f32) * 100.0_f32).round() as i8,
            _ => -1,
        }
    }

    /// Before pull request 5071: colours, and in trinary mode the alpha of an image that has it, averaged as samples of 16
    /// bits; strict comparison.
    pub(crate) fn nav2_humble(&self, mode: Mode, [r, g, b, a]: [u32; 4], has_alpha: bool, white: u32) -> i8 {
        let quantum = |sample: u32| (f64::from(sample) * 65535.0 / f64::from(white)).round();
        let mut channels = vec![quantum(r), quantum(g), quantum(b)];
        if mode == Mode::Trinary && has_alpha {
            channels.push(quantum(a));
        }
        let shade = channels.iter().sum::<f64>() / channels.len() as f64 / 65535.0;
        if mode == Mode::Raw {
            let level = (shade * 255.0).round();
            return if level <= 100.0 { level as i8 } else { -1 };
        }
        let x = if self.negate { shade } else { 1.0 - shade };
        if mode == Mode::Scale && has_alpha && a < white {
            -1
        } else if self.occupied < x {
            100
        } else if x < self.free {
            0
        } else if mode == Mode::Scale {
            ((x - self.free) / (self.occupied - self.free) * 100.0).round_ties_even() as i8
        } else {
            -1
        }
    }

    pub(crate) fn ros1(&self, mode: Mode, surface: &[u8], alpha_mask: bool) -> i8 {
        let averaged = if mode == Mode::Trinary || !alpha_mask { surface.len() } else { surface.len() - 1 };
        let sum: u32 = surface[..averaged].iter().copied().map(u32::from).sum();
        let mut average = f64::from(sum) / averaged as f64;
        let alpha = if surface.len() == 1 { 1 } else { surface[surface.len() - 1] };
        if self.negate {
            average = 255.0 - average;
        }
        if mode == Mode::Raw {
            let value = average.floor() as u8 as i8;
            return if (-1..=100).contains(&value) { value } else { -1 };
        }
        let x = (255.0 - average) / 255.0;
        if x > self.occupied {
            100
        } else if x < self.free {
            0
        } else if mode == Mode::Trinary || alpha == 0 {
            -1
        } else {
            (1.0 + 98.0 * ((x - self.free) / (self.occupied - self.free))).floor() as i8
        }
    }
}

pub(crate) fn rules() -> [Rule; 3] {
    [
        Rule { free: 0.196, occupied: 0.65, negate: false },
        Rule { free: 0.25, occupied: 0.8, negate: true },
        Rule { free: 0.0, occupied: 1.0, negate: false },
    ]
}

pub(crate) fn read_with(folder: &Folder, image: &str, rule: Rule, options: &Options) -> Map {
    let text = format!(
        "image: {image}\nresolution: 0.05\norigin: [-3.5, 2.25, 0.125]\nnegate: {}\noccupied_thresh: {}\nfree_thresh: {}\n",
        i32::from(rule.negate),
        rule.occupied,
        rule.free
    );
    read_twice(&folder.write("map.yaml", text), options).unwrap()
}
