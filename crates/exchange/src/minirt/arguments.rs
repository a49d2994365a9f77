//! The arguments of an element: points, numbers, properties.

use std::ops::Range;

use catoptric_scene::{Color, Number};
use glam::DVec3;

use crate::draft::Draft;
use crate::lines::{MOST_WORDS, Word, number, without_decimal_comma};
use crate::message::Message;
use crate::minirt::property::is_property;
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
    /// Whether something is missing, which is said once.
    has_gaps: bool,
}

impl<'t> Arguments<'t> {
    /// Reads the words of a line of the `source`; `None` if there are too many.
    pub(crate) fn new(words: Vec<Word<'t>>, source: &'t str, draft: &mut Draft) -> Option<Self> {
        let is_too_long = words.len() > MOST_WORDS;
        let span = words.first()?.span.start..words.last()?.span.end;
        if is_too_long {
            draft.refuse(&span, Message::LineTooLong { most: MOST_WORDS.to_string() }, None);
            return None;
        }
        let mut words = words.into_iter();
        let element = words.next()?;
        let (mut points, mut numbers, mut properties) = (Vec::new(), Vec::new(), Vec::new());
        let (mut has_faults, mut follows_option) = (false, false);
        for word in joined(words, source) {
            let begins = |letters: fn(char) -> bool| word.text.trim_start_matches('-').starts_with(letters);
            let looks_like_number = begins(|letter| letter.is_ascii_digit() || "+-.,".contains(letter));
            if !looks_like_number {
                // Its values may follow: `glossy 7 8`.
                follows_option = !is_property(word.text) && !word.text.contains(['=', ':']);
                properties.push(word);
            } else if word.text.contains(',') {
                match point(&word, draft) {
                    Some(value) => points.push((Spanned { value, span: word.span }, follows_option)),
                    None => has_faults = true,
                }
                follows_option = false;
            } else {
                match scalar(&word, draft) {
                    Some(value) => numbers.push((Spanned { value, span: word.span }, follows_option)),
                    None => has_faults = true,
                }
            }
        }
        let (point_count, number_count) = counts(element.text);
        let (points, numbers) =
            (without_options(points, point_count), without_options(numbers, number_count));
        Some(Self { element, points, numbers, properties, span, has_faults, has_gaps: false })
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
        let Some(direction) = value.try_normalize() else {
            draft.refuse(&span, Message::ZeroDirection { argument }, Some(Message::DirectionIs));
            return None;
        };
        if value.abs().max_element() > 1.0 {
            let message = Message::NotADirection { argument, element: self.name() };
            if !draft.options.is_approximate {
                draft.error_with_help(&span, message, Message::DirectionIs);
                return None;
            }
            draft.unsupported(&span, message, Message::TakenAsItIs);
        }
        Some(Spanned { value: direction, span })
    }

    /// The next three numbers as a color, 0 to 255 each. Where a body lacks it, white is taken if the options allow it: many
    /// programs have names or textures in its place.
    pub(crate) fn color(&mut self, draft: &mut Draft) -> Option<Spanned<Color>> {
        if draft.options.is_approximate && !self.has_point() && !self.has_faults && !self.has_gaps {
            let message = Message::Lacks { element: self.name(), argument: Argument::Color };
            draft.unsupported(&self.span, message, Message::WhiteTaken);
            return Some(Spanned { value: Color::WHITE, span: self.span.clone() });
        }
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
        draft.refuse(&found.span, out_of_range(argument, found.value, [low, high]), None);
        None
    }

    /// The next number, from `low` to `high`; the nearest one that is, if the options allow it.
    pub(crate) fn nearest(
        &mut self,
        argument: Argument,
        [low, high]: [f64; 2],
        draft: &mut Draft,
    ) -> Option<Spanned<f64>> {
        let value = self.numbers_left().first()?.value;
        if (low..=high).contains(&value) || !draft.options.is_approximate {
            return self.number(argument, [low, high], draft);
        }
        let Spanned { value, span } = self.numbers.next()?;
        draft.unsupported(&span, out_of_range(argument, value, [low, high]), Message::NearestTaken);
        Some(Spanned { value: value.clamp(low, high), span })
    }

    /// The next number, above 0.
    pub(crate) fn size(&mut self, argument: Argument, draft: &mut Draft) -> Option<Spanned<f64>> {
        let found = self.number(argument, [f64::NEG_INFINITY, f64::INFINITY], draft)?;
        if found.value > 0.0 {
            return Some(found);
        }
        draft.refuse(&found.span, Message::NotPositive { argument, value: found.value.into() }, None);
        None
    }

    /// Reports what stands there still.
    pub(crate) fn end(&mut self, draft: &mut Draft) {
        let left = self.points.by_ref().map(|point| point.span);
        let left: Vec<_> = left.chain(self.numbers.by_ref().map(|number| number.span)).collect();
        for span in left {
            self.refuse(&span, Message::TooMany { element: self.name() }, draft);
        }
    }

    /// The element's name.
    pub(crate) fn name(&self) -> String {
        self.element.text.to_owned()
    }

    fn lack(&mut self, argument: Argument, draft: &mut Draft) {
        // One mistake is reported once. Where words that cannot be read are left out, their element is, too.
        let is_said = self.has_gaps || self.has_faults && !draft.options.is_approximate;
        self.has_gaps = true;
        if is_said {
            return;
        }
        self.refuse(&self.span, Message::Lacks { element: self.name(), argument }, draft);
    }

    /// Refuses something, and says how the element is written.
    fn refuse(&self, span: &Range<usize>, message: Message, draft: &mut Draft) {
        let help = usage(self.element.text).map(|usage| Message::Write { usage: usage.to_owned() });
        draft.refuse(span, message, help);
    }
}

/// How many points and numbers an element has to have.
fn counts(element: &str) -> (usize, usize) {
    match element {
        "R" => (0, 2),
        "A" => (1, 1),
        "C" | "c" | "sp" => (2, 1),
        "L" | "l" => (1, 1),
        "pl" => (3, 0),
        "cy" => (3, 2),
        "sq" | "co" => (3, 1),
        "tr" => (4, 0),
        _ => (0, 0),
    }
}

/// Values without those that follow an option that is not known, as far as `count` of them are left.
fn without_options<T>(values: Vec<(T, bool)>, count: usize) -> std::vec::IntoIter<T> {
    let mut spare = values.len().saturating_sub(count);
    let mut kept = Vec::new();
    for (value, follows_option) in values {
        if follows_option && spare > 0 {
            spare -= 1;
        } else {
            kept.push(value);
        }
    }
    kept.into_iter()
}

/// Words put together: points with spaces around their commas, `0 , 1, 2`, and options with spaces before their values,
/// `reflection= 0.3`.
fn joined<'t>(words: impl Iterator<Item = Word<'t>>, source: &'t str) -> Vec<Word<'t>> {
    let commas = |text: &str| text.matches(',').count();
    let is_number =
        |text: &str| text.starts_with(|letter: char| letter.is_ascii_digit() || "+-.".contains(letter));
    let belongs = |last: &str, next: &str| {
        let is_point = is_number(last)
            && (last.ends_with(',') && is_number(next) || next.starts_with(','))
            && commas(last) + commas(next) <= 2;
        is_point || last.ends_with(['=', ':']) && last.len() > 1 && !is_number(last)
    };
    let mut joined: Vec<Word<'t>> = Vec::new();
    for word in words {
        match joined.last_mut() {
            Some(last) if belongs(last.text, word.text) => {
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
        if !draft.options.is_approximate {
            draft.error_with_help(span, Message::NotAColor { value }, Message::ColorIs);
            return None;
        }
        draft.unsupported(span, Message::NotAColor { value }, Message::NearestTaken);
    }
    let codes = codes.clamp(DVec3::ZERO, DVec3::splat(255.0));
    Some(Color::from((codes / 255.0).to_array()))
}

/// Three numbers with commas between them.
fn point(word: &Word<'_>, draft: &mut Draft) -> Option<DVec3> {
    let parts: Vec<_> = word.text.split(',').map(str::trim).take(7).collect();
    if let Some(example) = without_decimal_comma(word.text) {
        let message = Message::DecimalComma { word: word.text.to_owned() };
        draft.refuse(&word.span, message, Some(Message::DecimalPoint { example }));
        return None;
    }
    let numbers: Vec<f64> = parts.iter().map_while(|part| number(part)).collect();
    match (numbers.as_slice(), parts.len()) {
        (&[x, y, z], 3) => Some(DVec3::new(x, y, z)),
        (_, 6) if numbers.len() == 6 => {
            let example = parts.chunks(2).map(|pair| pair.join(".")).collect::<Vec<_>>().join(",");
            let message = Message::DecimalComma { word: word.text.to_owned() };
            draft.refuse(&word.span, message, Some(Message::DecimalPoint { example }));
            None
        }
        _ => {
            let message = Message::NotThreeNumbers { word: word.text.to_owned() };
            draft.refuse(&word.span, message, Some(Message::ThreeNumbersAre));
            None
        }
    }
}

fn scalar(word: &Word<'_>, draft: &mut Draft) -> Option<f64> {
    let value = number(word.text);
    if value.is_none() {
        draft.refuse(&word.span, Message::NotANumber { word: word.text.to_owned() }, None);
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
