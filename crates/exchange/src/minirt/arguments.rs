//! The arguments of an element: points, numbers, properties.

use std::ops::Range;

use catoptric_scene::{Color, Number};
use glam::DVec3;

use crate::draft::Draft;
use crate::lines::{MOST_WORDS, Word, number, without_decimal_comma};
use crate::message::Message;
use crate::phrase::Argument;

/// A value with its place.
#[derive(Clone, Debug)]
pub(crate) struct Spanned<T> {
    pub(crate) value: T,
    pub(crate) span: Range<usize>,
}

/// The arguments of an element, sorted by what they look like: the order of points and numbers among each other differs
/// between programs.
#[derive(Debug)]
pub(crate) struct Arguments<'t> {
    /// The word that says which element it is.
    pub(crate) element: Word<'t>,
    points: std::vec::IntoIter<Spanned<DVec3>>,
    numbers: std::vec::IntoIter<Spanned<f64>>,
    /// Words that are neither: `reflection=0.3`.
    pub(crate) properties: Vec<Word<'t>>,
    /// All words.
    pub(crate) span: Range<usize>,
    /// Whether a word could not be read, so that what is missing may stand there.
    has_faults: bool,
}

impl<'t> Arguments<'t> {
    /// Reads the words of a line of the `source`; `None` if there are too many.
    pub(crate) fn new(words: Vec<Word<'t>>, source: &'t str, draft: &mut Draft) -> Option<Self> {
        let is_too_long = words.len() > MOST_WORDS;
        let span = words.first()?.span.start..words.last()?.span.end;
        if is_too_long {
            draft.error(&span, Message::LineTooLong { most: MOST_WORDS.to_string() });
            return None;
        }
        let mut words = words.into_iter();
        let element = words.next()?;
        let (mut points, mut numbers, mut properties) = (Vec::new(), Vec::new(), Vec::new());
        let mut has_faults = false;
        for word in joined(words, source) {
            let begins = |letters: fn(char) -> bool| word.text.trim_start_matches('-').starts_with(letters);
            let looks_like_number = begins(|letter| letter.is_ascii_digit() || "+-.,".contains(letter));
            if !looks_like_number {
                properties.push(word);
            } else if word.text.contains(',') {
                match point(&word, draft) {
                    Some(value) => points.push(Spanned { value, span: word.span }),
                    None => has_faults = true,
                }
            } else {
                match scalar(&word, draft) {
                    Some(value) => numbers.push(Spanned { value, span: word.span }),
                    None => has_faults = true,
                }
            }
        }
        let (points, numbers) = (points.into_iter(), numbers.into_iter());
        Some(Self { element, points, numbers, properties, span, has_faults })
    }

    /// The next three numbers.
    pub(crate) fn point(&mut self, argument: Argument, draft: &mut Draft) -> Option<Spanned<DVec3>> {
        let point = self.points.next();
        if point.is_none() {
            self.lack(argument, draft);
        }
        point
    }

    /// The next three numbers as a direction of length 1.
    pub(crate) fn direction(&mut self, argument: Argument, draft: &mut Draft) -> Option<Spanned<DVec3>> {
        let Spanned { value, span } = self.point(argument, draft)?;
        if value.abs().max_element() > 1.0 {
            let help = Message::DirectionIs;
            draft.error_with_help(&span, Message::NotADirection { argument, element: self.name() }, help);
            return None;
        }
        match value.try_normalize() {
            Some(value) => Some(Spanned { value, span }),
            None => {
                draft.error_with_help(&span, Message::ZeroDirection { argument }, Message::DirectionIs);
                None
            }
        }
    }

    /// The next three numbers as a color, 0 to 255 each.
    pub(crate) fn color(&mut self, draft: &mut Draft) -> Option<Spanned<Color>> {
        let Spanned { value, span } = self.point(Argument::Color, draft)?;
        let value = color(value, &span, draft)?;
        Some(Spanned { value, span })
    }

    /// Whether three more numbers stand there.
    pub(crate) fn has_point(&self) -> bool {
        !self.points.as_slice().is_empty()
    }

    /// The numbers that stand there still.
    pub(crate) fn numbers_left(&self) -> &[Spanned<f64>] {
        self.numbers.as_slice()
    }

    /// The next number, from `low` to `high`.
    pub(crate) fn number(
        &mut self,
        argument: Argument,
        [low, high]: [f64; 2],
        draft: &mut Draft,
    ) -> Option<Spanned<f64>> {
        let Some(found) = self.numbers.next() else {
            self.lack(argument, draft);
            return None;
        };
        if (low..=high).contains(&found.value) {
            return Some(found);
        }
        draft.error(&found.span, out_of_range(argument, found.value, [low, high]));
        None
    }

    /// The next number, above 0.
    pub(crate) fn size(&mut self, argument: Argument, draft: &mut Draft) -> Option<Spanned<f64>> {
        let found = self.number(argument, [f64::NEG_INFINITY, f64::INFINITY], draft)?;
        if found.value > 0.0 {
            return Some(found);
        }
        draft.error(&found.span, Message::NotPositive { argument, value: found.value.into() });
        None
    }

    /// Reports what stands there still.
    pub(crate) fn end(&mut self, draft: &mut Draft) {
        let left = self.points.by_ref().map(|point| point.span);
        let left: Vec<_> = left.chain(self.numbers.by_ref().map(|number| number.span)).collect();
        for span in left {
            let message = Message::TooMany { element: self.name() };
            if draft.options.is_approximate {
                draft.unsupported(&span, message, Message::LeftOut);
            } else {
                self.refuse(&span, message, draft);
            }
        }
    }

    /// The element's name.
    pub(crate) fn name(&self) -> String {
        self.element.text.to_owned()
    }

    fn lack(&mut self, argument: Argument, draft: &mut Draft) {
        // One mistake is reported once.
        if std::mem::replace(&mut self.has_faults, true) {
            return;
        }
        self.refuse(&self.span, Message::Lacks { element: self.name(), argument }, draft);
    }

    /// Adds an error, and how the element is written.
    fn refuse(&self, span: &Range<usize>, message: Message, draft: &mut Draft) {
        match usage(self.element.text) {
            Some(usage) => draft.error_with_help(span, message, Message::Write { usage: usage.to_owned() }),
            None => draft.error(span, message),
        }
    }
}

/// Words with points of which the commas are followed by spaces put together: `0, 1, 2`.
fn joined<'t>(words: impl Iterator<Item = Word<'t>>, source: &'t str) -> Vec<Word<'t>> {
    let commas = |text: &str| text.matches(',').count();
    let mut joined: Vec<Word<'t>> = Vec::new();
    for word in words {
        let is_number =
            word.text.starts_with(|letter: char| letter.is_ascii_digit() || "+-.".contains(letter));
        match joined.last_mut() {
            Some(last)
                if is_number && last.text.ends_with(',') && commas(last.text) + commas(word.text) <= 2 =>
            {
                last.span.end = word.span.end;
                last.text = source.get(last.span.clone()).unwrap_or(last.text);
            }
            _ => joined.push(word),
        }
    }
    joined
}

/// That a number is out of its range.
pub(crate) fn out_of_range(argument: Argument, value: f64, [low, high]: [f64; 2]) -> Message {
    let [value, low, high] = [value, low, high].map(Number::from);
    Message::OutOfRange { argument, value, low, high }
}

/// Codes of 0 to 255 as light.
pub(crate) fn color(codes: DVec3, span: &Range<usize>, draft: &mut Draft) -> Option<Color> {
    if codes.min_element() < 0.0 || codes.max_element() > 255.0 {
        let wrong = codes.to_array().into_iter().find(|code| !(0.0..=255.0).contains(code));
        let value = Number::from(wrong.unwrap_or_default());
        draft.error_with_help(span, Message::NotAColor { value }, Message::ColorIs);
        return None;
    }
    Some(Color::from((codes / 255.0).to_array()))
}

/// Three numbers with commas between them.
fn point(word: &Word<'_>, draft: &mut Draft) -> Option<DVec3> {
    let parts: Vec<_> = word.text.split(',').map(str::trim).take(7).collect();
    if let Some(example) = without_decimal_comma(word.text) {
        let message = Message::DecimalComma { word: word.text.to_owned() };
        draft.error_with_help(&word.span, message, Message::DecimalPoint { example });
        return None;
    }
    let numbers: Vec<f64> = parts.iter().map_while(|part| number(part)).collect();
    match (numbers.as_slice(), parts.len()) {
        (&[x, y, z], 3) => Some(DVec3::new(x, y, z)),
        (_, 6) if numbers.len() == 6 => {
            let example = parts.chunks(2).map(|pair| pair.join(".")).collect::<Vec<_>>().join(",");
            let message = Message::DecimalComma { word: word.text.to_owned() };
            draft.error_with_help(&word.span, message, Message::DecimalPoint { example });
            None
        }
        _ => {
            let message = Message::NotThreeNumbers { word: word.text.to_owned() };
            draft.error_with_help(&word.span, message, Message::ThreeNumbersAre);
            None
        }
    }
}

fn scalar(word: &Word<'_>, draft: &mut Draft) -> Option<f64> {
    let value = number(word.text);
    if value.is_none() {
        draft.error(&word.span, Message::NotANumber { word: word.text.to_owned() });
    }
    value
}

/// How an element is written.
pub(crate) fn usage(element: &str) -> Option<&'static str> {
    Some(match element {
        "R" => "R width height",
        "A" => "A ratio R,G,B",
        "C" => "C x,y,z nx,ny,nz degrees",
        "c" => "c x,y,z nx,ny,nz degrees",
        "L" => "L x,y,z brightness R,G,B",
        "l" => "l x,y,z brightness R,G,B",
        "sp" => "sp x,y,z diameter R,G,B",
        "pl" => "pl x,y,z nx,ny,nz R,G,B",
        "cy" => "cy x,y,z nx,ny,nz diameter height R,G,B",
        "sq" => "sq x,y,z nx,ny,nz side R,G,B",
        "co" => "co x,y,z nx,ny,nz diameter height R,G,B",
        "tr" => "tr x,y,z x,y,z x,y,z R,G,B",
        _ => return None,
    })
}
