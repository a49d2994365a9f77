//! Sums of single-precision numbers without rounding.

/// The exact sum of single-precision numbers, kept as double-precision numbers that do not overlap
/// (Shewchuk 1997, Adaptive precision floating-point arithmetic and fast robust geometric predicates, sec. 2.4).
#[derive(Clone, Debug, Default)]
pub(crate) struct ExactSum {
    /// Of growing magnitude; their sum is exact.
    parts: Vec<f64>,
    /// How many numbers, 0 not counted.
    count: usize,
    /// The sum of magnitudes, but for rounding.
    magnitude: f64,
    /// The smallest unit of which all the numbers are multiples; `None` without any.
    unit: Option<f64>,
}

impl ExactSum {
    /// One number.
    pub(crate) fn of(number: f32) -> Self {
        let mut sum = Self::default();
        if number != 0.0 {
            sum.count = 1;
            sum.magnitude = f64::from(number).abs();
            sum.unit = Some(lowest_bit(number));
            sum.add(f64::from(number));
        }
        sum
    }

    fn add(&mut self, number: f64) {
        let mut carry = number;
        let mut kept = 0;
        for index in 0..self.parts.len() {
            let Some(&part) = self.parts.get(index) else { break };
            let (sum, error) = two_sum(carry, part);
            if error != 0.0
                && let Some(place) = self.parts.get_mut(kept)
            {
                *place = error;
                kept += 1;
            }
            carry = sum;
        }
        self.parts.truncate(kept);
        self.parts.push(carry);
    }

    /// Adds all numbers of another sum.
    pub(crate) fn absorb(&mut self, other: &Self) {
        for &part in &other.parts {
            self.add(part);
        }
        self.count += other.count;
        self.magnitude += other.magnitude;
        self.unit = match (self.unit, other.unit) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
    }

    /// The sum, rounded once to double precision.
    pub(crate) fn value(&self) -> f64 {
        let mut parts = self.parts.iter().rev();
        let Some(&(mut sum)) = parts.next() else { return 0.0 };
        let mut rest = 0.0;
        while rest == 0.0
            && let Some(&part) = parts.next()
        {
            (sum, rest) = two_sum(sum, part);
        }
        // Halfway between two numbers, what is behind decides.
        if let Some(&behind) = parts.next()
            && ((rest < 0.0 && behind < 0.0) || (rest > 0.0 && behind > 0.0))
        {
            let twice = 2.0 * rest;
            let other = sum + twice;
            if twice == other - sum {
                sum = other;
            }
        }
        sum
    }

    /// Whether a sum in double precision, rounded to single precision at the end, is the exact sum so rounded, whatever the
    /// order of adding.
    ///
    /// The order does not matter if no order rounds: all numbers and sums are multiples of one unit, below 2⁵³. Else a
    /// sum of n numbers is off by at most (n - 1)·u·Σ|x| to first order, u = 2⁻⁵³ (Higham 2002, Accuracy and Stability
    /// of Numerical Algorithms, sec. 4.2), and this takes twice that: if all sums that are possible are rounded alike,
    /// the order does not matter.
    pub(crate) fn is_certain(&self) -> bool {
        /// Whole numbers up to 2⁵³ are exact.
        const WHOLE: f64 = 9_007_199_254_740_992.0;
        let Some(unit) = self.unit else { return true };
        let exact = self.value();
        if !exact.is_finite() {
            return false;
        }
        let bound = f64::EPSILON * self.magnitude * self.count as f64;
        let [least, most] = [exact - bound, exact + bound].map(|sum| sum as f32);
        self.magnitude / unit < WHOLE || least.to_bits() == most.to_bits()
    }
}

/// a + b rounded, and the rest (Knuth 1969, The Art of Computer Programming 2, sec. 4.2.2, theorem B).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// The value of the lowest bit that is set in a number other than 0.
fn lowest_bit(number: f32) -> f64 {
    let bits = number.to_bits();
    let (exponent, fraction) = (bits >> 23 & 0xff, bits & 0x007f_ffff);
    let mantissa = if exponent == 0 { fraction } else { fraction | 1 << 23 };
    let shift = mantissa.trailing_zeros() as i32 + exponent.max(1) as i32 - 150;
    2.0_f64.powi(shift)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum(numbers: &[f32]) -> ExactSum {
        let mut all = ExactSum::default();
        numbers.iter().for_each(|&number| all.absorb(&ExactSum::of(number)));
        all
    }

    #[test]
    fn nothing_is_lost_between_large_and_small() {
        let small = 1e-30_f32;
        assert_eq!(sum(&[1e20, small, -1e20]).value(), f64::from(small));
        assert_eq!(sum(&[1.0, 2.0_f32.powi(-60), 2.0_f32.powi(-140)]).value(), 1.0);
        // Halfway between 1 and its neighbor, and a little more.
        let half = 2.0_f32.powi(-53);
        assert_eq!(sum(&[1.0, half]).value(), 1.0);
        assert_eq!(sum(&[1.0, half, 2.0_f32.powi(-120)]).value(), 1.0 + f64::EPSILON);
        assert_eq!(sum(&[]).value(), 0.0);
    }

    #[test]
    fn it_is_known_when_the_order_does_not_matter() {
        assert!(sum(&[1.0, 0.1, 3.0e-7]).is_certain(), "no order rounds");
        assert!(sum(&[1.0, 1e-20, 1e-25]).is_certain(), "all orders are rounded alike");
        // Halfway between two single-precision numbers, what is tiny decides: added to 1 first, it is lost.
        let half = f32::EPSILON / 2.0;
        assert!(sum(&[1.0, half]).is_certain());
        assert!(!sum(&[1.0, half, 1e-20]).is_certain());
        assert!(!sum(&[f32::INFINITY, 1.0]).is_certain());
    }

    #[test]
    fn lowest_bits() {
        for (number, bit) in [(1.0, 1.0), (0.75, 0.25), (f32::from_bits(1), 2.0_f64.powi(-149)), (-6.0, 2.0)]
        {
            assert_eq!(lowest_bit(number), bit, "{number}");
        }
    }
}
