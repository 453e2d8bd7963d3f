//! Where the mutants of one file stand: the pieces of source that a switch replaces.

use std::collections::HashMap;
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

/// A piece of source with its mutants.
#[derive(Debug)]
pub struct Place {
    pub range: Range<usize>,
    pub kind: Kind,
    pub mutants: Vec<Mutant>,
}

/// What stands there; ranges are bytes of the source.
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
    let mut finder = Finder { open, places: Vec::new() };
    finder.visit_file(&file);
    // Bodies and guards are whole ranges of the list itself.
    let lines: Vec<usize> =
        std::iter::once(0).chain(source.match_indices('\n').map(|(k, _)| k + 1)).collect();
    let offset = |(line, column): (usize, usize)| {
        let rest = &source[lines[line - 1]..];
        lines[line - 1] + rest.char_indices().nth(column).map_or(rest.len(), |(k, _)| k)
    };
    let mut places = finder.places;
    let mut without = Vec::new();
    for ((genre, ..), mutants) in finder.open {
        let (start, end) = (offset(mutants[0].start), offset(mutants[0].end));
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
        let inner = !matches!(place.kind, Kind::Body | Kind::Guard);
        (place.range.start, !matches!(place.kind, Kind::Body), std::cmp::Reverse(place.range.end), inner)
    });
    (places, without)
}

struct Finder {
    /// The mutants without a place yet, by genre and start.
    open: HashMap<(String, usize, usize), Vec<Mutant>>,
    places: Vec<Place>,
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
