//! Numbers drawn into a picture.

use crate::picture::Picture;

/// Rows of a digit.
pub(super) const HEIGHT: u32 = 7;
/// Columns of a digit, and with the gap to the next one.
const WIDTH: u32 = 5;
const ADVANCE: u32 = WIDTH + 1;

/// The rows of each character, the leftmost of five columns in the highest bit.
const fn glyph(character: char) -> [u8; 7] {
    match character {
        '0' => [0b01110, 0b10001, 0b10011, 0b10101, 0b11001, 0b10001, 0b01110],
        '1' => [0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110],
        '2' => [0b01110, 0b10001, 0b00001, 0b00110, 0b01000, 0b10000, 0b11111],
        '3' => [0b01110, 0b10001, 0b00001, 0b00110, 0b00001, 0b10001, 0b01110],
        '4' => [0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010],
        '5' => [0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110],
        '6' => [0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110],
        '7' => [0b11111, 0b00001, 0b00010, 0b00100, 0b00100, 0b01000, 0b01000],
        '8' => [0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110],
        '9' => [0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100],
        '.' => [0, 0, 0, 0, 0, 0b01100, 0b01100],
        _ => [0; 7],
    }
}

/// The columns that a text takes.
pub(super) fn width(text: &str) -> u32 {
    (text.chars().count() as u32 * ADVANCE).saturating_sub(1)
}

/// Draws digits and points with their upper left corner at a column and row; what lies outside is left out.
pub(super) fn draw(picture: &mut Picture, [left, top]: [u32; 2], text: &str, color: [f32; 3]) {
    for (index, character) in (0..).zip(text.chars()) {
        for (row, bits) in picture.rows_mut().skip(top as usize).zip(glyph(character)) {
            let columns = row.iter_mut().skip((left + index * ADVANCE) as usize).take(WIDTH as usize);
            for (column, pixel) in (0..).zip(columns) {
                if bits & (0b10000 >> column) != 0 {
                    *pixel = color;
                }
            }
        }
    }
}
