//! The source of one file with a switch at each place.

use std::collections::HashSet;
use std::fmt::Write;
use std::ops::Range;

use crate::places::{Kind, Place};

/// A file with its switches, and which bytes of it belong to which mutants: where an error of the compiler leads.
#[derive(Default)]
pub struct Switched {
    pub text: String,
    owners: Vec<(Range<usize>, Vec<u32>)>,
}

impl Switched {
    /// `source` with a switch at each of `places` for its mutants that are not among `refused`.
    pub fn new(source: &str, places: &[Place], refused: &HashSet<u32>) -> Self {
        let mut switched = Self::default();
        Writer { source, places, refused }.copy(&mut switched, 0..source.len(), 0);
        switched
    }

    /// Every mutant that has a switch.
    pub fn mutants(&self) -> impl Iterator<Item = u32> {
        self.owners.iter().flat_map(|(_, ids)| ids).copied()
    }

    /// The mutants of the smallest owner of a byte: one alternative, or all of a place.
    pub fn owners(&self, byte: usize) -> Option<&[u32]> {
        let around = self.owners.iter().filter(|(range, _)| range.contains(&byte));
        around.min_by_key(|(range, _)| range.len()).map(|(_, ids)| ids.as_slice())
    }
}

struct Writer<'a> {
    source: &'a str,
    places: &'a [Place],
    refused: &'a HashSet<u32>,
}

impl Writer<'_> {
    /// Copies `range` with the switches of the places inside, of which the first may be `next`.
    fn copy(&self, out: &mut Switched, range: Range<usize>, mut next: usize) {
        let mut at = range.start;
        while let Some(place) = self.places.get(next) {
            if place.range.start > range.end {
                break;
            }
            next += 1;
            if place.range.start < at || place.range.end > range.end {
                continue;
            }
            let ids: Vec<u32> = place
                .mutants
                .iter()
                .map(|mutant| mutant.id)
                .filter(|id| !self.refused.contains(id))
                .collect();
            if !ids.is_empty() {
                out.text.push_str(&self.source[at..place.range.start]);
                let start = out.text.len();
                self.switch(out, place, next);
                out.owners.push((start..out.text.len(), ids));
                at = place.range.end;
            }
        }
        out.text.push_str(&self.source[at..range.end]);
    }

    /// One place. Operands are evaluated once, in their order, before the switch.
    fn switch(&self, out: &mut Switched, place: &Place, next: usize) {
        let source = |range: &Range<usize>| &self.source[range.clone()];
        let first = place.mutants[0].id;
        let ask = format!("crate::mutant::at({first})");
        let put = |out: &mut Switched, pieces: &[Piece]| {
            for piece in pieces {
                match piece {
                    Piece::Text(text) => out.text.push_str(text),
                    Piece::Source(range) => self.copy(out, (*range).clone(), next),
                    Piece::Arms(arm) => {
                        write!(out.text, "match {ask} {{").expect("a string takes all");
                        for mutant in place.mutants.iter().filter(|mutant| !self.refused.contains(&mutant.id))
                        {
                            let start = out.text.len();
                            write!(out.text, " {} => {},", mutant.id, arm(&mutant.replacement))
                                .expect("as above");
                            out.owners.push((start..out.text.len(), vec![mutant.id]));
                        }
                        out.text.push_str(" _ => ");
                    }
                }
            }
        };
        use Piece::{Arms, Source, Text};
        match &place.kind {
            Kind::Body => put(out, &[Arms(&|with| format!("return {with}")), Text("{} } ")]),
            Kind::Whole => {
                let mutant = &place.mutants[0];
                let (start, length) = (place.range.start, self.source.len() - place.range.end);
                let applied = mutant.applied(self.source);
                let arm = |_: &str| format!("({})", &applied[start..applied.len() - length]);
                put(out, &[Text("("), Arms(&arm), Text("("), Source(&place.range), Text(") })")]);
            }
            Kind::Guard => put(out, &[Arms(&|with| with.to_owned()), Source(&place.range), Text(" }")]),
            Kind::Arithmetic { left, op, right } => {
                let all = format!("__l {} __r }} }})", source(op));
                let arm = |with: &str| format!("__l {with} __r");
                put(
                    out,
                    &[Text("(match ("), Source(left), Text(", "), Source(right), Text(") { (__l, __r) => ")],
                );
                put(out, &[Arms(&arm), Text(&all)]);
            }
            Kind::Comparison { left, op, right } => {
                let all = format!("*__l {} *__r }} }})", source(op));
                let arm = |with: &str| format!("*__l {with} *__r");
                put(out, &[Text("(match (&("), Source(left), Text("), &("), Source(right)]);
                put(out, &[Text(")) { (__l, __r) => "), Arms(&arm), Text(&all)]);
            }
            Kind::Logical { left, and, right } => {
                // `&&` ends at false, `||` at true.
                let ends = if *and { "==" } else { "!=" };
                let test = format!(") {{ __l => if __l {ends} ({ask} == {first}) {{ __l }} else {{ ");
                put(out, &[Text("(match ("), Source(left), Text(&test), Source(right), Text(" } })")]);
            }
            Kind::Assignment { left, op, right } => {
                let all = format!("*__l {} __r }} }} }})", source(op));
                let arm = |with: &str| format!("*__l {with} __r");
                put(
                    out,
                    &[Text("(match ("), Source(right), Text(") { __r => { let __l = &mut ("), Source(left)],
                );
                put(out, &[Text("); "), Arms(&arm), Text(&all)]);
            }
            Kind::Unary { op, operand } => {
                let rest =
                    format!(") {{ __v => if {ask} == {first} {{ __v }} else {{ {}__v }} }})", source(op));
                put(out, &[Text("(match ("), Source(operand), Text(&rest)]);
            }
            Kind::Arm { guard } => {
                write!(out.text, " if {ask} != {first}").expect("a string takes all");
                if let Some(guard) = guard {
                    put(out, &[Text(" && ("), Source(guard), Text(")")]);
                }
            }
            Kind::Field { member, value, base } => {
                let start = format!("{member}: if {ask} == {first} {{ (");
                let middle = format!(").{member} }} else {{ ");
                put(out, &[Text(&start), Source(base), Text(&middle), Source(value), Text(" }")]);
            }
        }
    }
}

/// A piece of a switch.
enum Piece<'a> {
    Text(&'a str),
    Source(&'a Range<usize>),
    /// The start of a `match`: an arm for each mutant, and the pattern of the last arm.
    Arms(&'a dyn Fn(&str) -> String),
}
