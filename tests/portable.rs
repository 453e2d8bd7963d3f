//! Tallies that travel as text (feature `serde`).

use mean_information::expected::Hypotheses;
use mean_information::map::encoding::{Percent, Probability};
use mean_information::map::{Geometry, Grid, Histogram};
use mean_information::{InformationSum, Tally, cell::Cell};
use proptest::collection::vec;
use proptest::prelude::*;

fn tally(occupancies: &[f64]) -> Tally<f64> {
    occupancies.iter().map(|&p| Cell::from_occupancy(p).expect("in [0, 1]")).collect()
}

proptest! {
    #[test]
    fn a_tally_survives_the_journey_and_merges_there(
        here in vec(0.0..=1.0, 0..50),
        there in vec((0_u64..=1.0_f64.to_bits()).prop_map(f64::from_bits), 0..50),
    ) {
        let text = serde_json::to_string(&tally(&here)).unwrap();
        let mut arrived: Tally<f64> = serde_json::from_str(&text).unwrap();
        prop_assert_eq!(&arrived, &tally(&here));
        arrived.merge(&tally(&there));
        prop_assert_eq!(arrived, tally(&[&here[..], &there].concat()));

        let text = serde_json::to_string(&InformationSum::from_occupancies(&here)).unwrap();
        let mut arrived: InformationSum<f64> = serde_json::from_str(&text).unwrap();
        prop_assert_eq!(&arrived, &InformationSum::from_occupancies(&here));
        arrived.merge(&InformationSum::from_occupancies(&there));
        prop_assert_eq!(arrived, InformationSum::from_occupancies(&[here, there].concat()));
    }
}

#[test]
fn a_histogram_travels_as_its_counts() {
    let mut histogram = Histogram::from_cells(&[-1_i8, 3, 3]);
    histogram.add_many(0_i8, u64::MAX - 3);
    let text = serde_json::to_string(&histogram).unwrap();
    assert_eq!(text, format!("[{},0,0,2,{}1]", u64::MAX - 3, "0,".repeat(251)));
    let arrived: Histogram = serde_json::from_str(&text).unwrap();
    assert_eq!((&arrived, arrived.cells()), (&histogram, u64::MAX));
    let arrived: Histogram = serde_json::from_str(&format!("[{}7]", "0,".repeat(255))).unwrap();
    assert_eq!(arrived.tally::<Percent>().unknown(), 7);

    let refused = |text: &str| serde_json::from_str::<Histogram>(text).unwrap_err().to_string();
    let many = refused(&text.replace(",2,", ",3,"));
    assert!(many.contains("number of cells of the histogram is 18446744073709552000"), "{many}");
    for count in [0, 255, 257] {
        let words = format!("a histogram is a list of 256 counts, not of {count}");
        assert!(refused(&format!("{:?}", vec![1; count])).contains(&words));
    }
    let many = refused(&text.replace(",2,", ",3,"));
    assert!(many.contains("number of cells of the histogram is 18446744073709552000"), "{many}");
    for count in [0, 255, 257] {
        let words = format!("a histogram is a list of 256 counts, not of {count}");
        assert!(refused(&format!("{:?}", vec![1; count])).contains(&words));
    }
    assert!(refused(&text.replace(",2,", ",-2,")).contains("-2"));
}

/// Its sums are finer than floats, and still sums of the smallest numbers of the format.
#[test]
fn the_tally_of_an_expected_map_travels_too() {
    let geometry = Geometry::new(0.25, [0.0; 2]).unwrap();
    let map = |cells| Grid::<Probability<f32>>::new(3, 1, geometry, cells).unwrap();
    let maps = [map(vec![0.3, 1e-30, 0.500_000_06]), map(vec![0.4, 1e-40, 0.5])];
    let expected = Hypotheses::new(&maps, &[0.3, 0.1]).unwrap().expected_map().unwrap();
    let text = serde_json::to_string(expected.tally()).unwrap();
    assert_eq!(&serde_json::from_str::<Tally<f32>>(&text).unwrap(), expected.tally());
}

/// The text is a contract: other machines read it.
#[test]
fn the_text_is_readable_anywhere() {
    let one = format!("4{}", "0".repeat(268)); // 2^1074 units of 2^-1074
    let expected = format!(
        r#"{{"format":"f64","entropy":"{one}","information":"{one}","unknown":1,"free":1,"occupied":0}}"#
    );
    assert_eq!(serde_json::to_string(&tally(&[0.5, 0.0])).unwrap(), expected);
    let empty = r#"{"format":"f32","entropy":"0","information":"0","unknown":0,"free":0,"occupied":0}"#;
    assert_eq!(serde_json::from_str::<Tally<f32>>(empty).unwrap(), Tally::new());

    let expected = format!(r#"{{"format":"f64","information":"{one}","unknown":1,"observed":1}}"#);
    assert_eq!(serde_json::to_string(&InformationSum::from(&tally(&[0.5, 0.0]))).unwrap(), expected);
    let empty = r#"{"format":"f32","information":"0","unknown":0,"observed":0}"#;
    assert_eq!(serde_json::from_str::<InformationSum<f32>>(empty).unwrap(), InformationSum::new());
}

#[test]
fn a_tally_that_cannot_be_is_refused() {
    let good = serde_json::to_value(tally(&[0.25, 0.5, 1.0])).unwrap();
    let refused = |key: &str, value: serde_json::Value| {
        let mut bad = good.clone();
        bad[key] = value;
        serde_json::from_value::<Tally<f64>>(bad).unwrap_err().to_string()
    };
    assert!(serde_json::from_value::<Tally<f64>>(good.clone()).is_ok());
    assert_eq!(refused("format", "f32".into()), "a tally of f32 cells, wanted is f64");
    let entropy =
        "entropy of the tally is 0, allowed is 1 bit for each unknown cell, and at most 1 for each other";
    assert!(refused("free", 0.into()).ends_with("allowed is at most 1 bit for each observed cell"));
    assert_eq!(refused("entropy", "0".into()), entropy);
    assert!(
        refused("unknown", 7.into())
            .ends_with("allowed is 1 bit for each unknown cell, and at most 1 for each other")
    );
    assert!(refused("occupied", 2.into()).ends_with("allowed is 1 bit for each cell"));
    assert!(refused("free", u64::MAX.into()).ends_with("allowed is at most 2^64 - 1"));
    assert!(refused("entropy", "f".repeat(288).into()).ends_with("at most 1 for each other"));
    assert!(refused("entropy", "f".repeat(289).into()).starts_with("a sum is 1 to 288 hexadecimal digits"));
    assert!(refused("information", "0x1".into()).contains("not \"0x1\""));
    assert!(refused("information", "".into()).contains("hexadecimal digits"));
    assert!(refused("mean", 1.into()).contains("unknown field"));
    // The smallest f32 is 2^925 times the smallest f64, 2^(4 * 231 + 1).
    for (sum, holds) in [("2", true), ("1", false), ("3", false)] {
        let [sum, one] = [(sum, 231), ("4", 268)].map(|(digit, zeros)| digit.to_owned() + &"0".repeat(zeros));
        let text = format!(
            r#"{{"format":"f32","entropy":"{sum}","information":"{one}","unknown":0,"free":1,"occupied":0}}"#
        );
        assert_eq!(serde_json::from_str::<Tally<f32>>(&text).is_ok(), holds, "{text}");
    }
}

#[test]
fn information_that_cannot_be_is_refused() {
    let good = serde_json::to_value(InformationSum::from(&tally(&[0.25, 0.5, 1.0]))).unwrap();
    let refused = |key: &str, value: serde_json::Value| {
        let mut bad = good.clone();
        bad[key] = value;
        serde_json::from_value::<InformationSum<f64>>(bad).unwrap_err().to_string()
    };
    assert!(serde_json::from_value::<InformationSum<f64>>(good.clone()).is_ok());
    assert_eq!(refused("format", "f32".into()), "a tally of f32 cells, wanted is f64");
    assert!(refused("observed", 1.into()).ends_with("allowed is at most 1 bit for each observed cell"));
    assert!(refused("unknown", u64::MAX.into()).ends_with("allowed is at most 2^64 - 1"));
    assert!(refused("entropy", "0".into()).contains("unknown field"));
    let mut least = good.clone();
    (least["format"], least["information"]) = ("f32".into(), "1".into());
    let error = serde_json::from_value::<InformationSum<f32>>(least).unwrap_err().to_string();
    assert!(error.ends_with("allowed is a sum of numbers of the tally's format"), "{error}");
}
