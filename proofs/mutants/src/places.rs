//! Where the mutants of one file stand: the pieces of source that a switch replaces.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Expr};

/// One mutant of cargo-mutants' list.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// Its number in the list, from 1.
    pub id: u32,
    pub name: String,
    pub file: String,
    pub genre: String,
    pub replacement: String,
    /// The type its function returns, as `-> Type`.
    pub returned: String,
    /// Line from 1 and column from 0 where it begins.
    pub start: (usize, usize),
    pub end: (usize, usize),
}

impl Mutant {
    /// The source with this mutant in it, as cargo-mutants would write it.
    pub fn applied(&self, source: &str) -> String {
        let (start, end) = (offset(source, self.start), offset(source, self.end));
        [&source[..start], &self.replacement, &source[end..]].concat()
    }
}

/// The byte of a line and column.
fn offset(source: &str, (line, column): (usize, usize)) -> usize {
    let before: usize = source.split_inclusive('\n').take(line - 1).map(str::len).sum();
    let rest = &source[before..];
    before + rest.char_indices().nth(column).map_or(rest.len(), |(k, _)| k)
}

/// A piece of source with its mutants.
#[derive(Debug)]
pub struct Place {
    pub range: Range<usize>,
    pub kind: Kind,
    pub mutants: Vec<Mutant>,
}

/// The code at a place; ranges are bytes of the source.
#[derive(Debug)]
pub enum Kind {
    /// The start of a function's body.
    Body,
    /// `left op right`, both taken by value.
    Arithmetic { left: Range<usize>, op: Range<usize>, right: Range<usize> },
    /// `left op right`, both taken by reference.
    Comparison { left: Range<usize>, op: Range<usize>, right: Range<usize> },
    /// `left && right` or `left || right`.
    Logical { left: Range<usize>, and: bool, right: Range<usize> },
    /// `left op= right`.
    Assignment { left: Range<usize>, op: Range<usize>, right: Range<usize> },
    /// `-operand` or `!operand`.
    Unary { op: Range<usize>, operand: Range<usize> },
    /// An expression that parses differently with the mutant's operator, which binds tighter or less tight.
    Whole,
    /// The guard of a match arm.
    Guard,
    /// What follows the pattern of a match arm: nothing, or its guard.
    Arm { guard: Option<Range<usize>> },
    /// `member: value` in a struct expression with `..base`.
    Field { member: String, value: Range<usize>, base: Range<usize> },
}

/// The places of `mutants` in `source`, and the mutants that have none.
pub fn find(source: &str, mutants: &[Mutant]) -> (Vec<Place>, Vec<Mutant>) {
    let file = syn::parse_file(source).expect("the library parses");
    let mut open: HashMap<(String, usize, usize), Vec<Mutant>> = HashMap::new();
    for mutant in mutants {
        open.entry((mutant.genre.clone(), mutant.start.0, mutant.start.1)).or_default().push(mutant.clone());
    }
    let mut finder = Finder { open, ..Finder::default() };
    finder.visit_file(&file);
    // Bodies and guards are whole ranges of the list itself.
    let (mut places, mut without) = (Vec::new(), Vec::new());
    for mut place in finder.places {
        let operands = match &place.kind {
            Kind::Arithmetic { left, right, .. } | Kind::Comparison { left, right, .. } => {
                [left, right].map(Clone::clone)
            }
            Kind::Logical { left, right, .. } | Kind::Assignment { left, right, .. } => {
                [left, right].map(Clone::clone)
            }
            _ => {
                places.push(place);
                continue;
            }
        };
        for mutant in std::mem::take(&mut place.mutants) {
            match whole(
                source,
                &finder.expressions,
                &mutant,
                &[&operands[..], &[place.range.clone()]].concat(),
            ) {
                None => without.push(mutant),
                Some(None) => place.mutants.push(mutant),
                // A binding would not reach the branch behind it.
                Some(Some(range)) if source[range.clone()].contains("let ") => without.push(mutant),
                Some(Some(range)) => places.push(Place { range, kind: Kind::Whole, mutants: vec![mutant] }),
            }
        }
        if !place.mutants.is_empty() {
            places.push(place);
        }
    }
    for ((genre, ..), mutants) in finder.open {
        let (start, end) = (offset(source, mutants[0].start), offset(source, mutants[0].end));
        match genre.as_str() {
            // The type behind an `impl` is that of one body.
            "FnValue" if !mutants[0].returned.contains("impl ") => {
                places.push(Place { range: start..start, kind: Kind::Body, mutants })
            }
            "MatchArmGuard" => places.push(Place { range: start..end, kind: Kind::Guard, mutants }),
            _ => without.extend(mutants),
        }
    }
    // Outer before inner; what is put in front of an expression before that expression.
    places.sort_by_key(|place| {
        // A guard is often one comparison.
        let inner = !matches!(place.kind, Kind::Body | Kind::Guard | Kind::Whole);
        (place.range.start, !matches!(place.kind, Kind::Body), std::cmp::Reverse(place.range.end), inner)
    });
    (places, without)
}

/// The smallest expression about a mutant that is one with and without it; none if its `parts`, the operation and the operands,
/// stay the same. Nothing if the mutant does not parse.
fn whole(
    source: &str,
    expressions: &[Range<usize>],
    mutant: &Mutant,
    parts: &[Range<usize>],
) -> Option<Option<Range<usize>>> {
    let (start, end) = (offset(source, mutant.start), offset(source, mutant.end));
    let file = syn::parse_file(&mutant.applied(source)).ok()?;
    let mut finder = Finder::default();
    finder.visit_file(&file);
    let longer = mutant.replacement.len() as isize - (end - start) as isize;
    let back = |at: usize| if at <= start { at } else { at.strict_add_signed(-longer) };
    let there: HashSet<Range<usize>> =
        finder.expressions.iter().map(|range| back(range.start)..back(range.end)).collect();
    if parts.iter().all(|part| there.contains(part)) {
        return Some(None);
    }
    let about =
        expressions.iter().filter(|range| range.start < start && end < range.end && there.contains(range));
    about.min_by_key(|range| range.len()).cloned().map(Some)
}

#[derive(Default)]
struct Finder {
    /// The mutants without a place yet, by genre and start.
    open: HashMap<(String, usize, usize), Vec<Mutant>>,
    places: Vec<Place>,
    /// Where every expression stands.
    expressions: Vec<Range<usize>>,
}

impl Finder {
    fn place(&mut self, genre: &str, at: Span, range: Range<usize>, kind: impl FnOnce() -> Kind) {
        let start = at.start();
        if let Some(mutants) = self.open.remove(&(genre.to_owned(), start.line, start.column)) {
            self.places.push(Place { range, kind: kind(), mutants });
        }
    }
}

fn range(node: &impl Spanned) -> Range<usize> {
    node.span().byte_range()
}

/// Whether an operand is a `let` of a chain, which is no value.
fn has_let(expression: &Expr) -> bool {
    match expression {
        Expr::Let(_) => true,
        Expr::Binary(binary) => has_let(&binary.left) || has_let(&binary.right),
        _ => false,
    }
}

impl<'ast> Visit<'ast> for Finder {
    fn visit_expr(&mut self, node: &'ast Expr) {
        self.expressions.push(range(node));
        visit::visit_expr(self, node);
    }

    fn visit_expr_binary(&mut self, node: &'ast syn::ExprBinary) {
        let (left, op, right) = (range(&node.left), range(&node.op), range(&node.right));
        let kind = || match node.op {
            BinOp::And(_) => Kind::Logical { left, and: true, right },
            BinOp::Or(_) => Kind::Logical { left, and: false, right },
            BinOp::Eq(_) | BinOp::Ne(_) | BinOp::Lt(_) | BinOp::Le(_) | BinOp::Gt(_) | BinOp::Ge(_) => {
                Kind::Comparison { left, op, right }
            }
            BinOp::Add(_)
            | BinOp::Sub(_)
            | BinOp::Mul(_)
            | BinOp::Div(_)
            | BinOp::Rem(_)
            | BinOp::BitXor(_)
            | BinOp::BitAnd(_)
            | BinOp::BitOr(_)
            | BinOp::Shl(_)
            | BinOp::Shr(_) => Kind::Arithmetic { left, op, right },
            _ => Kind::Assignment { left, op, right },
        };
        if !has_let(&node.left) && !has_let(&node.right) {
            self.place("BinaryOperator", node.op.span(), range(node), kind);
        }
        visit::visit_expr_binary(self, node);
    }

    fn visit_expr_unary(&mut self, node: &'ast syn::ExprUnary) {
        let (op, operand) = (range(&node.op), range(&node.expr));
        self.place("UnaryOperator", node.op.span(), range(node), || Kind::Unary { op, operand });
        visit::visit_expr_unary(self, node);
    }

    fn visit_arm(&mut self, node: &'ast syn::Arm) {
        let guard = node.guard.as_ref().map(|(_, guard)| range(guard));
        let start = range(&node.pat).end;
        let end = guard.as_ref().map_or(start, |guard| guard.end);
        // Without an arm that takes all, a match does not compile.
        if !matches!(node.pat, syn::Pat::Ident(syn::PatIdent { subpat: None, .. })) {
            self.place("MatchArm", node.span(), start..end, || Kind::Arm { guard });
        }
        visit::visit_arm(self, node);
    }

    fn visit_expr_struct(&mut self, node: &'ast syn::ExprStruct) {
        for field in &node.fields {
            if let (syn::Member::Named(member), Some(base)) = (&field.member, &node.rest) {
                let (value, base) = (range(&field.expr), range(base));
                let member = member.to_string();
                self.place("StructField", field.span(), range(field), || Kind::Field { member, value, base });
            }
        }
        visit::visit_expr_struct(self, node);
    }
}
