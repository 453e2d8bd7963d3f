#![doc = include_str!("links.md")]
#![doc = include_str!("../../docs/README.md")]
#![doc = include_str!("style.html")]
#![doc = "<script type=\"module\">"]
#![doc = include_str!("mathml.mjs")]
#![doc = include_str!("page.mjs")]
#![doc = "</script>"]

/// Makes a module of each chapter in `docs/`, in the order of reading. In `docs/` the links lead to files, here to items;
/// figures are part of the page, since rustdoc copies no files. A failing doctest is named by the line of its chapter plus
/// the number of lines of `links.md`.
macro_rules! chapters {
    ($($name:ident $(shows $($figure:literal)+)?;)*) => {
        chapters! { @all concat!($(stringify!($name), " "),*); $($name $(shows $($figure)+)?;)* }
    };
    (@all $order:expr; $($name:ident $(shows $($figure:literal)+)?;)*) => {$(
        #[doc = include_str!("links.md")]
        #[doc = include_str!(concat!("../../docs/", stringify!($name), ".md"))]
        $($(
            #[doc = concat!("\n<script type=\"image/svg+xml\" data-figure=\"", $figure, "\">")]
            #[doc = include_str!(concat!("../../docs/", $figure))]
            #[doc = "</script>"]
        )+)?
        #[doc = concat!("<script type=\"text/plain\" data-chapters=\"", $order, "\"></script>")]
        #[doc = include_str!("style.html")]
        #[doc = "<script type=\"module\">"]
        #[doc = include_str!("mathml.mjs")]
        #[doc = include_str!("page.mjs")]
        #[doc = "</script>"]
        pub mod $name {}
    )*};
}

chapters! {
    notation;
    cell;
    map;
    sensor;
    grids;
    fusion;
    scan;
    evidence shows "figures/evidence.svg";
    expected shows "figures/csail.svg";
    limit;
    closed_form;
    convergence;
    erratum shows "figures/convergence.svg";
    figures shows
        "figures/figure-1.svg" "figures/figure-2.svg" "figures/figure-3.svg"
        "figures/figure-4.svg" "figures/figure-5.svg" "figures/loop-closure.svg";
    rounding;
    sums;
    quadrature;
    integration;
    guarantees;
    operations;
    porting;
    files;
    octrees;
    tally_format;
    fleets;
    paper;
    architecture;
}
