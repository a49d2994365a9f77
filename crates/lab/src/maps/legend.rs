//! The legend of a map: what it shows, and the scale with its numbers.

use catoptric_picture::scale_color;

use super::{Map, MapKind};

/// The strip below a map.
pub(super) struct Legend {
    /// Pixels of the picture to a pixel of the letters.
    zoom: u32,
    width: u32,
    title: &'static str,
    /// Where the numbers of the scale stand, 0 to 1.
    ticks: Vec<(f32, String)>,
    /// How many even steps the scale has, if its numbers are whole.
    steps: Option<u32>,
}

/// Rows from the top of the strip, in pixels of the letters: the title, the bar, the ticks, the numbers, the end.
const TITLE: u32 = 4;
const BAR: u32 = TITLE + GLYPH[1] + 3;
const TICKS: u32 = BAR + 7;
const NUMBERS: u32 = TICKS + 3;
const END: u32 = NUMBERS + GLYPH[1] + 4;
/// Room at both sides.
const SIDE: u32 = 14;
/// Size of a letter.
const GLYPH: [u32; 2] = [5, 7];
const PAPER: [f32; 3] = [0.004; 3];
const INK: [f32; 3] = [0.8; 3];

impl Legend {
    pub(super) fn new(map: &Map) -> Self {
        let end = map.scale_end();
        let steps = (map.kind == MapKind::Generations).then_some(end as u32);
        let count = match steps {
            Some(steps) if steps <= 8 => steps,
            _ => 4,
        };
        let tick = |step: u32| {
            let at = step as f32 / count as f32;
            let value = if steps.is_some() { (at * end).round() } else { at * end };
            (value / end, map.in_words(value))
        };
        Self {
            zoom: (map.width / 480).clamp(1, 4),
            width: map.width,
            title: map.kind.title(),
            ticks: (0..=count).map(tick).collect(),
            steps,
        }
    }

    /// Rows of the strip.
    pub(super) fn height(&self) -> u32 {
        END * self.zoom
    }

    /// Draws one row of the strip.
    pub(super) fn draw_row(&self, y: u32, row: &mut [[f32; 3]]) {
        row.fill(PAPER);
        let line = y / self.zoom;
        let side = SIDE * self.zoom;
        let bar = self.width.saturating_sub(2 * side).max(1);
        match line {
            TITLE..BAR => self.write(row, line - TITLE, side, self.title),
            BAR..TICKS => {
                for (x, pixel) in row.iter_mut().skip(side as usize).take(bar as usize).enumerate() {
                    let at = x as f64 / f64::from(bar.saturating_sub(1).max(1));
                    // Whole numbers have a color each, in the middle of which their tick stands.
                    let at =
                        self.steps.map_or(at, |steps| (at * f64::from(steps)).round() / f64::from(steps));
                    *pixel = scale_color(at);
                }
            }
            TICKS..NUMBERS if line < TICKS + 2 => {
                for (at, _) in &self.ticks {
                    let x = side + (at * (bar - 1) as f32).round() as u32;
                    let thick = row.iter_mut().skip(x as usize).take(self.zoom as usize);
                    thick.for_each(|pixel| *pixel = INK);
                }
            }
            NUMBERS.. => {
                for (at, text) in &self.ticks {
                    let middle = side + (at * (bar - 1) as f32).round() as u32;
                    let half = self.extent(text) / 2;
                    let most = self.width.saturating_sub(self.extent(text));
                    self.write(row, line - NUMBERS, middle.saturating_sub(half).min(most), text);
                }
            }
            _ => {}
        }
    }

    /// Pixels that a text takes across.
    fn extent(&self, text: &str) -> u32 {
        (text.chars().count() as u32 * (GLYPH[0] + 1)).saturating_sub(1) * self.zoom
    }

    /// Draws one line of a text's letters from `left` on.
    fn write(&self, row: &mut [[f32; 3]], line: u32, left: u32, text: &str) {
        for (number, letter) in text.chars().enumerate() {
            let bits = glyph(letter).get(line as usize).copied().unwrap_or(0);
            let start = left + number as u32 * (GLYPH[0] + 1) * self.zoom;
            for column in (0..GLYPH[0]).filter(|column| bits >> (GLYPH[0] - 1 - column) & 1 == 1) {
                let first = (start + column * self.zoom) as usize;
                row.iter_mut().skip(first).take(self.zoom as usize).for_each(|pixel| *pixel = INK);
            }
        }
    }
}

/// A letter of the legend: seven lines of five bits, the left one the highest.
fn glyph(letter: char) -> [u8; 7] {
    match letter {
        '0' => [0x0e, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0e],
        '1' => [0x04, 0x0c, 0x04, 0x04, 0x04, 0x04, 0x0e],
        '2' => [0x0e, 0x11, 0x01, 0x06, 0x08, 0x10, 0x1f],
        '3' => [0x1f, 0x02, 0x04, 0x02, 0x01, 0x11, 0x0e],
        '4' => [0x02, 0x06, 0x0a, 0x12, 0x1f, 0x02, 0x02],
        '5' => [0x1f, 0x10, 0x1e, 0x01, 0x01, 0x11, 0x0e],
        '6' => [0x06, 0x08, 0x10, 0x1e, 0x11, 0x11, 0x0e],
        '7' => [0x1f, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08],
        '8' => [0x0e, 0x11, 0x11, 0x0e, 0x11, 0x11, 0x0e],
        '9' => [0x0e, 0x11, 0x11, 0x0f, 0x01, 0x02, 0x0c],
        '.' => [0, 0, 0, 0, 0, 0x0c, 0x0c],
        '%' => [0x18, 0x19, 0x02, 0x04, 0x08, 0x13, 0x03],
        'A' => [0x0e, 0x11, 0x11, 0x1f, 0x11, 0x11, 0x11],
        'B' => [0x1e, 0x11, 0x11, 0x1e, 0x11, 0x11, 0x1e],
        'C' => [0x0e, 0x11, 0x10, 0x10, 0x10, 0x11, 0x0e],
        'D' => [0x1e, 0x11, 0x11, 0x11, 0x11, 0x11, 0x1e],
        'E' => [0x1f, 0x10, 0x10, 0x1e, 0x10, 0x10, 0x1f],
        'F' => [0x1f, 0x10, 0x10, 0x1e, 0x10, 0x10, 0x10],
        'G' => [0x0e, 0x11, 0x10, 0x17, 0x11, 0x11, 0x0f],
        'H' => [0x11, 0x11, 0x11, 0x1f, 0x11, 0x11, 0x11],
        'I' => [0x0e, 0x04, 0x04, 0x04, 0x04, 0x04, 0x0e],
        'L' => [0x10, 0x10, 0x10, 0x10, 0x10, 0x10, 0x1f],
        'M' => [0x11, 0x1b, 0x15, 0x15, 0x11, 0x11, 0x11],
        'N' => [0x11, 0x19, 0x15, 0x13, 0x11, 0x11, 0x11],
        'O' => [0x0e, 0x11, 0x11, 0x11, 0x11, 0x11, 0x0e],
        'P' => [0x1e, 0x11, 0x11, 0x1e, 0x10, 0x10, 0x10],
        'R' => [0x1e, 0x11, 0x11, 0x1e, 0x14, 0x12, 0x11],
        'S' => [0x0f, 0x10, 0x10, 0x0e, 0x01, 0x01, 0x1e],
        'T' => [0x1f, 0x04, 0x04, 0x04, 0x04, 0x04, 0x04],
        'W' => [0x11, 0x11, 0x11, 0x15, 0x15, 0x15, 0x0a],
        'X' => [0x11, 0x11, 0x0a, 0x04, 0x0a, 0x11, 0x11],
        'Y' => [0x11, 0x11, 0x0a, 0x04, 0x04, 0x04, 0x04],
        _ => [0; 7],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_letter_of_every_title_and_number_is_drawn() {
        let titles: String = MapKind::ALL.map(MapKind::title).concat();
        for letter in titles.chars().chain("0123456789.%".chars()).filter(|letter| *letter != ' ') {
            assert_ne!(glyph(letter), [0; 7], "{letter}");
        }
    }
}
