//! Numbers as people type them: arithmetic, units, and the decimal sign of any language.
//!
//! ```text
//! sum     = product { ("+" | "-") product }
//! product = signed { ("*" | "/") signed }
//! signed  = { "+" | "-" } power
//! power   = primary [ "^" signed ]
//! primary = ( number | constant | function "(" sum ")" | "(" sum ")" ) { unit }
//! ```
//!
//! A sign binds weaker than a power (−2² is −4), powers are chained from the right, and the unit after a quotient of
//! plain numbers is that of the quotient (1/2 m is half a meter).

use std::ops::Range;

use super::Unit;
use crate::base::texts::DecimalSign;

mod lexer;

use lexer::{Lexer, Token};

/// The longest text that is read, letters.
const MOST_LETTERS: usize = 200;
/// How deep parentheses, signs and powers may be nested.
const MOST_DEPTH: usize = 40;

/// The reason why a text is not a number, and its place, counted in letters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ExpressionError {
    pub(crate) kind: ExpressionErrorKind,
    pub(crate) place: Range<usize>,
}

/// The kind of error in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ExpressionErrorKind {
    /// A word or sign that means nothing here.
    Unknown,
    /// A number is missing.
    NumberMissing,
    /// Two numbers stand side by side.
    OperatorMissing,
    /// A parenthesis has no counterpart.
    Parenthesis,
    /// The parenthesis after the name of a function is missing.
    ArgumentMissing,
    /// A comma before three figures may be a decimal sign, or may group thousands.
    AmbiguousComma,
    /// A number with two decimal signs, or spaces in the wrong places.
    Number,
    /// The unit is not one of this quantity, or units do not go together.
    Unit,
    /// A power of a quantity with a unit is unclear.
    PowerOfUnit,
    /// There is no finite result.
    NotFinite,
    /// The text is too long or too deeply nested.
    TooLong,
}

/// Evaluates `text` as a quantity in `unit`: a plain number counts in this unit. The whole text is read, or none of it.
///
/// # Errors
/// What is wrong, and where.
pub(crate) fn evaluate(text: &str, unit: Unit, sign: DecimalSign) -> Result<f64, ExpressionError> {
    let letters = text.chars().count();
    if letters > MOST_LETTERS {
        return Err(ExpressionError { kind: ExpressionErrorKind::TooLong, place: MOST_LETTERS..letters });
    }
    let tokens = Lexer::new(text, sign).tokens()?;
    let is_computed = tokens.len() > 1;
    let mut parser = ExpressionParser { tokens, next: 0, end: letters, depth: 0 };
    let value = parser.sum()?;
    if let Some((token, place)) = parser.peek() {
        let kind = if token == Token::Close {
            ExpressionErrorKind::Parenthesis
        } else {
            ExpressionErrorKind::OperatorMissing
        };
        return Err(ExpressionError { kind, place });
    }
    let whole = 0..letters;
    if !value.number.is_finite() {
        return Err(ExpressionError { kind: ExpressionErrorKind::NotFinite, place: whole });
    }
    if value.dimension != Dimension::PLAIN && value.dimension != Dimension::of(unit) {
        return Err(ExpressionError { kind: ExpressionErrorKind::Unit, place: whole });
    }
    Ok(if is_computed { free_of_noise(value.number) } else { value.number })
}

/// A result without the noise of binary arithmetic, where fifteen digits end in zeros: 0.1 · 3 is 0.3.
fn free_of_noise(value: f64) -> f64 {
    let rounded = |digits: usize| format!("{value:.digits$e}").parse().unwrap_or(value);
    let (long, short): (f64, f64) = (rounded(14), rounded(11));
    if long == short { short + 0.0 } else { value }
}

/// The powers of length and angle in a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Dimension {
    length: i32,
    angle: i32,
}

impl Dimension {
    const PLAIN: Self = Self { length: 0, angle: 0 };
    const LENGTH: Self = Self { length: 1, angle: 0 };
    const ANGLE: Self = Self { length: 0, angle: 1 };

    const fn of(unit: Unit) -> Self {
        match unit {
            Unit::Meters => Self::LENGTH,
            Unit::Degrees => Self::ANGLE,
            Unit::None | Unit::Pixels | Unit::Stops => Self::PLAIN,
        }
    }

    fn times(self, other: Self, sign: i32) -> Self {
        Self { length: self.length + sign * other.length, angle: self.angle + sign * other.angle }
    }

    fn to_power(self, power: i32) -> Option<Self> {
        Some(Self { length: self.length.checked_mul(power)?, angle: self.angle.checked_mul(power)? })
            .filter(|raised| raised.length.abs() <= 64 && raised.angle.abs() <= 64)
    }
}

/// A number in meters, degrees, their powers, or by itself.
#[derive(Clone, Copy, Debug)]
struct TypedValue {
    number: f64,
    dimension: Dimension,
}

impl TypedValue {
    const fn plain(number: f64) -> Self {
        Self { number, dimension: Dimension::PLAIN }
    }

    fn is_plain(self) -> bool {
        self.dimension == Dimension::PLAIN
    }

    fn times(self, other: Self) -> Self {
        Self { number: self.number * other.number, dimension: self.dimension.times(other.dimension, 1) }
    }

    fn over(self, other: Self) -> Self {
        Self { number: self.number / other.number, dimension: self.dimension.times(other.dimension, -1) }
    }
}

/// The meaning of a word.
#[derive(Clone, Copy, Debug)]
enum TypedWord {
    Constant(f64),
    Function(Function),
    Unit(TypedValue),
}

#[derive(Clone, Copy, Debug)]
enum Function {
    Sqrt,
    Abs,
    Exp,
    Ln,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
}

fn word(text: &str) -> Option<TypedWord> {
    let length = |meters| Some(TypedWord::Unit(TypedValue { number: meters, dimension: Dimension::LENGTH }));
    let angle = |degrees| Some(TypedWord::Unit(TypedValue { number: degrees, dimension: Dimension::ANGLE }));
    match text {
        "m" | "м" => return length(1.0),
        "cm" | "см" => return length(0.01),
        "mm" | "мм" => return length(0.001),
        "km" | "км" => return length(1000.0),
        "°" | "deg" | "град" => return angle(1.0),
        "rad" | "рад" => return angle(1.0_f64.to_degrees()),
        "π" => return Some(TypedWord::Constant(std::f64::consts::PI)),
        "√" => return Some(TypedWord::Function(Function::Sqrt)),
        _ => {}
    }
    Some(match text.to_lowercase().as_str() {
        "pi" | "пи" => TypedWord::Constant(std::f64::consts::PI),
        "sqrt" => TypedWord::Function(Function::Sqrt),
        "abs" => TypedWord::Function(Function::Abs),
        "exp" => TypedWord::Function(Function::Exp),
        "ln" => TypedWord::Function(Function::Ln),
        "sin" => TypedWord::Function(Function::Sin),
        "cos" => TypedWord::Function(Function::Cos),
        "tan" | "tg" => TypedWord::Function(Function::Tan),
        "asin" | "arcsin" => TypedWord::Function(Function::Asin),
        "acos" | "arccos" => TypedWord::Function(Function::Acos),
        "atan" | "arctan" | "arctg" => TypedWord::Function(Function::Atan),
        _ => return None,
    })
}

impl Function {
    /// The function of `value`. Angles of plain numbers are radians, as in mathematics.
    fn apply(self, value: TypedValue) -> Option<TypedValue> {
        let TypedValue { number, dimension } = value;
        let plain = |function: fn(f64) -> f64| value.is_plain().then(|| TypedValue::plain(function(number)));
        let of_angle = |function: fn(f64) -> f64| {
            let radians = match dimension {
                Dimension::PLAIN => number,
                Dimension::ANGLE => number.to_radians(),
                _ => return None,
            };
            Some(TypedValue::plain(function(radians)))
        };
        let to_angle = |function: fn(f64) -> f64| {
            let angle = plain(function)?.number.to_degrees();
            Some(TypedValue { number: angle, dimension: Dimension::ANGLE })
        };
        match self {
            Self::Sqrt => {
                let is_square = dimension.length % 2 == 0 && dimension.angle % 2 == 0;
                let dimension = Dimension { length: dimension.length / 2, angle: dimension.angle / 2 };
                is_square.then(|| TypedValue { number: number.sqrt(), dimension })
            }
            Self::Abs => Some(TypedValue { number: number.abs(), dimension }),
            Self::Exp => plain(f64::exp),
            Self::Ln => plain(f64::ln),
            Self::Sin => of_angle(f64::sin),
            Self::Cos => of_angle(f64::cos),
            Self::Tan => of_angle(f64::tan),
            Self::Asin => to_angle(f64::asin),
            Self::Acos => to_angle(f64::acos),
            Self::Atan => to_angle(f64::atan),
        }
    }
}

/// Reads the tokens by recursive descent.
struct ExpressionParser<'t> {
    tokens: Vec<(Token<'t>, Range<usize>)>,
    next: usize,
    /// The end of the text, letters.
    end: usize,
    depth: usize,
}

impl<'t> ExpressionParser<'t> {
    fn peek(&self) -> Option<(Token<'t>, Range<usize>)> {
        self.tokens.get(self.next).cloned()
    }

    /// The next sign, if it is one of `signs`.
    fn take_sign(&mut self, signs: &[char]) -> Option<char> {
        match self.peek() {
            Some((Token::Sign(sign), _)) if signs.contains(&sign) => {
                self.next += 1;
                Some(sign)
            }
            _ => None,
        }
    }

    /// The place from token `first` to the one read last.
    fn place_from(&self, first: usize) -> Range<usize> {
        let start = self.tokens.get(first).map_or(self.end, |(_, place)| place.start);
        let end = self.tokens.get(self.next.saturating_sub(1)).map_or(self.end, |(_, place)| place.end);
        start..end.max(start)
    }

    fn fault<T>(&self, kind: ExpressionErrorKind, first: usize) -> Result<T, ExpressionError> {
        Err(ExpressionError { kind, place: self.place_from(first) })
    }

    fn sum(&mut self) -> Result<TypedValue, ExpressionError> {
        let first = self.next;
        let mut sum = self.product()?;
        while let Some(sign) = self.take_sign(&['+', '-']) {
            let other = self.product()?;
            // A plain number counts in the unit of the other.
            let dimension = match (sum.is_plain(), other.is_plain()) {
                (true, _) => other.dimension,
                (_, true) => sum.dimension,
                _ if sum.dimension == other.dimension => sum.dimension,
                _ => return self.fault(ExpressionErrorKind::Unit, first),
            };
            let number = if sign == '+' { sum.number + other.number } else { sum.number - other.number };
            sum = TypedValue { number, dimension };
        }
        Ok(sum)
    }

    fn product(&mut self) -> Result<TypedValue, ExpressionError> {
        let mut product = self.signed()?;
        product = self.units(product)?;
        while let Some(sign) = self.take_sign(&['*', '/']) {
            let factor = self.signed()?;
            product = match sign {
                '*' => {
                    let factor = self.units(factor)?;
                    product.times(factor)
                }
                _ if product.is_plain() && factor.is_plain() => self.units(product.over(factor))?,
                _ => {
                    let factor = self.units(factor)?;
                    product.over(factor)
                }
            };
        }
        Ok(product)
    }

    /// Units after a value.
    fn units(&mut self, mut value: TypedValue) -> Result<TypedValue, ExpressionError> {
        let first = self.next;
        while let Some((Token::Word(text), place)) = self.peek() {
            let Some(TypedWord::Unit(unit)) = word(text) else { break };
            self.next += 1;
            if !value.is_plain() {
                return Err(ExpressionError { kind: ExpressionErrorKind::Unit, place });
            }
            value = value.times(unit);
        }
        match self.peek() {
            Some((Token::Sign('^'), _)) if self.next > first => {
                self.fault(ExpressionErrorKind::PowerOfUnit, first)
            }
            _ => Ok(value),
        }
    }

    fn signed(&mut self) -> Result<TypedValue, ExpressionError> {
        let mut is_negative = false;
        while let Some(sign) = self.take_sign(&['+', '-']) {
            is_negative ^= sign == '-';
        }
        let value = self.power()?;
        Ok(if is_negative { TypedValue { number: -value.number, ..value } } else { value })
    }

    fn power(&mut self) -> Result<TypedValue, ExpressionError> {
        let first = self.next;
        let base = self.primary()?;
        if self.take_sign(&['^']).is_none() {
            return Ok(base);
        }
        let exponent = self.deeper(Self::signed)?;
        if !exponent.is_plain() {
            return self.fault(ExpressionErrorKind::Unit, first);
        }
        let number = base.number.powf(exponent.number);
        if base.is_plain() {
            return Ok(TypedValue::plain(number));
        }
        let is_whole = exponent.number.fract() == 0.0 && exponent.number.abs() <= 64.0;
        match base.dimension.to_power(exponent.number as i32).filter(|_| is_whole) {
            Some(dimension) => Ok(TypedValue { number, dimension }),
            None => self.fault(ExpressionErrorKind::Unit, first),
        }
    }

    fn primary(&mut self) -> Result<TypedValue, ExpressionError> {
        let first = self.next;
        let Some((token, place)) = self.peek() else {
            return Err(ExpressionError {
                kind: ExpressionErrorKind::NumberMissing,
                place: self.end..self.end,
            });
        };
        self.next += 1;
        match token {
            Token::Number(number) => Ok(TypedValue::plain(number)),
            Token::Open => self.rest_of_parenthesis(first),
            Token::Word(text) => match word(text) {
                Some(TypedWord::Constant(number)) => Ok(TypedValue::plain(number)),
                Some(TypedWord::Function(function)) => {
                    if !matches!(self.peek(), Some((Token::Open, _))) {
                        return Err(ExpressionError { kind: ExpressionErrorKind::ArgumentMissing, place });
                    }
                    let open = self.next;
                    self.next += 1;
                    let argument = self.rest_of_parenthesis(open)?;
                    match function.apply(argument) {
                        Some(value) if value.number.is_finite() => Ok(value),
                        Some(_) => self.fault(ExpressionErrorKind::NotFinite, first),
                        None => self.fault(ExpressionErrorKind::Unit, first),
                    }
                }
                Some(TypedWord::Unit(_)) => {
                    Err(ExpressionError { kind: ExpressionErrorKind::NumberMissing, place })
                }
                None => Err(ExpressionError { kind: ExpressionErrorKind::Unknown, place }),
            },
            Token::Sign(_) => Err(ExpressionError { kind: ExpressionErrorKind::NumberMissing, place }),
            Token::Close => Err(ExpressionError { kind: ExpressionErrorKind::Parenthesis, place }),
        }
    }

    /// What stands after an opening parenthesis, the token `open`, with the closing one.
    fn rest_of_parenthesis(&mut self, open: usize) -> Result<TypedValue, ExpressionError> {
        let value = self.deeper(Self::sum)?;
        match self.peek() {
            Some((Token::Close, _)) => {
                self.next += 1;
                Ok(value)
            }
            Some((_, place)) => Err(ExpressionError { kind: ExpressionErrorKind::OperatorMissing, place }),
            None => {
                let place = self.tokens.get(open).map_or(self.end..self.end, |(_, place)| place.clone());
                Err(ExpressionError { kind: ExpressionErrorKind::Parenthesis, place })
            }
        }
    }

    fn deeper(
        &mut self,
        read: fn(&mut Self) -> Result<TypedValue, ExpressionError>,
    ) -> Result<TypedValue, ExpressionError> {
        if self.depth >= MOST_DEPTH {
            return self.fault(ExpressionErrorKind::TooLong, self.next);
        }
        self.depth += 1;
        let value = read(self);
        self.depth -= 1;
        value
    }
}

#[cfg(test)]
mod tests;
