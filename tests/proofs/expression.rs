//! Integer expressions of Rust, and how a Gappa script writes them.
//!
//! The rules: an integer is a real number, casts are nothing, a shift to the right is a floored product with a power of 2,
//! and a call is a name of its own. Gappa proves apart that no cast and no operation loses a bit.

/// An expression, without its casts.
#[derive(Clone, Debug)]
pub(crate) enum Expression {
    Number(String),
    Name(String),
    Call(String, Vec<Expression>),
    Negative(Box<Expression>),
    Binary(&'static str, Box<Expression>, Box<Expression>),
}

use Expression::{Binary, Call, Name, Negative, Number};

/// The binary operators, those that bind least first.
const OPERATORS: [&[&str]; 4] = [&["&"], &["<<", ">>"], &["+", "-"], &["*", "/"]];

/// Splits Rust text into words, numbers and operators.
pub(crate) fn tokens(text: &str) -> Vec<String> {
    let mut tokens = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let word = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        let length = match word {
            0 if ["<<", ">>", "::"].iter().any(|operator| rest.starts_with(operator)) => 2,
            0 => first.len_utf8(),
            _ => word,
        };
        tokens.push(rest[..length].to_owned());
        rest = rest[length..].trim_start();
    }
    tokens
}

/// All whole expressions in the text of a statement: what stands after `=`, `(`, `{` and so on, and their parts.
pub(crate) fn expressions(text: &str) -> Vec<Expression> {
    let tokens = tokens(text);
    let starts = |i: usize| {
        i == 0 || matches!(tokens[i - 1].as_str(), "=" | "(" | "{" | "}" | "," | ";" | ":" | "else" | "|")
    };
    let whole = |i: usize| {
        let mut parser = Parser { tokens: &tokens[i..] };
        let expression = parser.binary(0)?;
        let ends = parser.tokens.first().is_none_or(|t| matches!(t.as_str(), ";" | ")" | "," | "}"));
        ends.then_some(expression)
    };
    (0..tokens.len()).filter(|&i| starts(i)).filter_map(whole).collect()
}

struct Parser<'a> {
    tokens: &'a [String],
}

impl Parser<'_> {
    fn take(&mut self, token: &str) -> bool {
        let found = self.tokens.first().is_some_and(|t| t == token);
        if found {
            self.tokens = &self.tokens[1..];
        }
        found
    }

    fn next(&mut self) -> Option<String> {
        let (first, rest) = self.tokens.split_first()?;
        self.tokens = rest;
        Some(first.clone())
    }

    fn binary(&mut self, level: usize) -> Option<Expression> {
        let Some(operators) = OPERATORS.get(level) else {
            return self.cast();
        };
        let mut left = self.binary(level + 1)?;
        while let Some(operator) = operators.iter().find(|operator| self.take(operator)) {
            left = Binary(operator, Box::new(left), Box::new(self.binary(level + 1)?));
        }
        Some(left)
    }

    fn cast(&mut self) -> Option<Expression> {
        let expression = self.unary()?;
        while self.take("as") {
            self.next()?;
        }
        Some(expression)
    }

    fn unary(&mut self) -> Option<Expression> {
        if self.take("-") {
            return Some(Negative(Box::new(self.unary()?)));
        }
        self.take("&");
        if self.take("(") {
            let inner = self.binary(0)?;
            return self.take(")").then_some(inner);
        }
        let mut word = self.next()?;
        if word.starts_with(|c: char| c.is_ascii_digit()) {
            // A float of the kernels is whole.
            if self.take(".") && !self.take("0") {
                return None;
            }
            return Some(Number(word.split('_').next()?.to_owned()));
        }
        let mut path = vec![word.clone()];
        while self.take("::") {
            if self.take("<") {
                while !self.take(">") {
                    self.next()?;
                }
                continue;
            }
            word = self.next()?;
            path.push(word.clone());
        }
        let is_name =
            word.starts_with(char::is_alphabetic) && !matches!(word.as_str(), "let" | "if" | "else");
        if !is_name {
            return None;
        }
        if self.take(".") {
            // Only a method without arguments: a call of its name.
            let method = self.next()?;
            return (self.take("(") && self.take(")")).then(|| Call(method, vec![Name(word)]));
        }
        if self.take("(") {
            let mut arguments = Vec::new();
            while !self.take(")") {
                arguments.push(self.binary(0)?);
                self.take(",");
            }
            let widening = path.len() == 2 && word == "from";
            return if widening { arguments.pop() } else { Some(Call(word, arguments)) };
        }
        if self.take("[") {
            let index = self.next()?;
            return self.take("]").then(|| Name(format!("{word}_{index}")));
        }
        Some(Name(word))
    }
}

impl Expression {
    /// The expression and every part of it.
    pub(crate) fn parts(&self) -> Vec<&Expression> {
        let mut parts = vec![self];
        match self {
            Number(_) | Name(_) => {}
            Call(_, arguments) => parts.extend(arguments.iter().flat_map(Expression::parts)),
            Negative(inner) => parts.extend(inner.parts()),
            Binary(_, left, right) => {
                parts.extend(left.parts());
                parts.extend(right.parts());
            }
        }
        parts
    }

    /// The call of `horner` that this expression is, as the names of the coefficients and the argument, and the scale.
    pub(crate) fn horner(&self) -> Option<(&str, &str, &str)> {
        match self {
            Call(name, arguments) if name == "horner" => match arguments.as_slice() {
                [Name(coefficients), Name(x), Number(scale)] => Some((coefficients, x, scale)),
                _ => None,
            },
            _ => None,
        }
    }

    /// The expression as a Gappa script writes it.
    pub(crate) fn gappa(&self) -> String {
        match self {
            Number(text) | Name(text) => text.clone(),
            Negative(inner) => format!("-{}", inner.factor()),
            Call(name, arguments) => match (name.as_str(), arguments.as_slice()) {
                ("mul_high", [a, b]) => format!("floor({} * {} * 1b-128)", a.left_factor(), b.factor()),
                ("shift_right", [x, amount]) => shifted_right(x, amount),
                (_, [Name(first) | Number(first), ..]) => format!("{name}_{first}"),
                _ => name.clone(),
            },
            Binary("+", a, b) => format!("{} + {}", a.gappa(), b.term()),
            Binary("-", a, b) => format!("{} - {}", a.gappa(), b.term()),
            Binary("*", a, b) => format!("{} * {}", a.left_factor(), b.factor()),
            Binary("/", a, b) => format!("floor({} / {})", a.left_factor(), b.factor()),
            Binary(">>", x, amount) => shifted_right(x, amount),
            Binary("<<", x, amount) => match (x.as_ref(), powers_of_two(amount, false).join(" * ")) {
                (Number(one), power) if one == "1" => power,
                (_, power) => format!("{} * {power}", x.left_factor()),
            },
            Binary("&", x, mask) => match mask.as_ref() {
                // The low bits: x & ((1 << s) - 1).
                Binary("-", power, _) => {
                    let Binary("<<", _, amount) = power.as_ref() else {
                        panic!("a mask of another shape: {mask:?}")
                    };
                    let power = powers_of_two(amount, false).join(" * ");
                    format!("{} - {} * {power}", x.gappa(), shifted_right(x, amount))
                }
                _ => panic!("a mask of another shape: {mask:?}"),
            },
            Binary(operator, ..) => panic!("no rule for {operator}"),
        }
    }

    /// The expression as a Gappa script writes it in floating point: each operation is rounded, `fused` once if the kernel
    /// has fused operations, and numbers are exact.
    pub(crate) fn rounded(&self, fused: bool) -> String {
        let of = |x: &Self| x.rounded(fused);
        match self {
            Number(text) | Name(text) => text.clone(),
            Negative(inner) => format!("-{}", of(inner)),
            Call(name, arguments) => match (name.as_str(), arguments.as_slice()) {
                ("one", []) => "1".to_owned(),
                ("high_origin" | "low_origin", []) => name.clone(),
                ("epsilon", []) => "EPSILON".to_owned(),
                ("head", [x]) => format!("cut({})", of(x)),
                ("fused", [a, b, c]) if fused => {
                    format!("rnd({} * {} + {})", of(a), of(b), of(c)).replace("+ -", "- ")
                }
                ("fused", [a, b, c]) => format!("rnd(rnd({} * {}) + {})", of(a), of(b), of(c)),
                ("horner", [Name(coefficients), Name(_)]) => format!("horner_{coefficients}"),
                ("unit", [a, b]) => format!("unit_{}_{}", of(a), of(b)).replace('-', "minus_"),
                _ => format!("no rule for {name}"),
            },
            Binary(operator @ ("+" | "-" | "*" | "/"), a, b) => {
                format!("rnd({} {operator} {})", of(a), of(b))
            }
            Binary(operator, ..) => format!("no rule for {operator}"),
        }
    }

    /// The expression and every part of it, as [`Expression::rounded`] writes them.
    pub(crate) fn rounded_parts(&self, fused: bool) -> Vec<String> {
        self.parts().into_iter().map(|part| part.rounded(fused)).collect()
    }

    fn is_sum(&self) -> bool {
        matches!(self, Binary("+" | "-" | "&", ..))
    }

    fn is_product(&self) -> bool {
        matches!(self, Binary("*" | "<<", x, _) if !matches!(x.as_ref(), Number(one) if one == "1"))
    }

    fn in_parentheses(&self, needed: bool) -> String {
        if needed { format!("({})", self.gappa()) } else { self.gappa() }
    }

    fn term(&self) -> String {
        self.in_parentheses(self.is_sum())
    }

    fn left_factor(&self) -> String {
        self.in_parentheses(self.is_sum())
    }

    fn factor(&self) -> String {
        self.in_parentheses(self.is_sum() || self.is_product())
    }
}

fn shifted_right(x: &Expression, amount: &Expression) -> String {
    format!("floor({} * {})", x.left_factor(), powers_of_two(amount, true).join(" * "))
}

/// `2^amount`, or its inverse, as factors: `k + 55` gives `two_to_k * 1b55`, or `two_to_minus_k * 1b-55`.
fn powers_of_two(amount: &Expression, inverse: bool) -> Vec<String> {
    let minus = |text| if inverse { text } else { "" };
    match amount {
        Number(n) => vec![format!("1b{}{n}", minus("-"))],
        Name(n) => vec![format!("two_to_{}{n}", minus("minus_"))],
        Negative(inner) => powers_of_two(inner, !inverse),
        Binary("+", a, b) => [powers_of_two(a, inverse), powers_of_two(b, inverse)].concat(),
        Binary("-", a, b) => [powers_of_two(a, inverse), powers_of_two(b, !inverse)].concat(),
        _ => panic!("no rule for a shift by {amount:?}"),
    }
}

/// Horner's rule with one floor at each step, for coefficients named `name_0`, `name_1`, ....
pub(crate) fn horner(name: &str, count: usize, x: &str, scale: &str) -> String {
    let last = format!("{name}_{}", count - 1);
    (0..count - 1).rev().fold(last, |sum, i| {
        let sum = if i == count - 2 { sum } else { format!("({sum})") };
        format!("{name}_{i} + floor({sum} * {x} * 1b-{scale})")
    })
}

/// Horner's rule in floating point, each step rounded once or twice, for coefficients named `name_0`, `name_1`, ....
pub(crate) fn rounded_horner(name: &str, count: usize, x: &str, fused: bool) -> String {
    let last = format!("{name}_{}", count - 1);
    (0..count - 1).rev().fold(last, |sum, i| {
        if fused {
            format!("rnd({sum} * {x} + {name}_{i})")
        } else {
            format!("rnd(rnd({sum} * {x}) + {name}_{i})")
        }
    })
}
