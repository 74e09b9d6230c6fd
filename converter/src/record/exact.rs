//! Integers of one scale and offset as integers of another, where that is possible without any change of the
//! coordinate. Scale and offset are taken as the shortest decimal that reads back as the stored float64, so
//! `0.01` means one hundredth.

/// value = mantissa × 10^exponent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Decimal {
    mantissa: i128,
    exponent: i32,
}

impl Decimal {
    /// `None` for a value that is not finite.
    fn of(value: f64) -> Option<Self> {
        if !value.is_finite() {
            return None;
        }
        let text = format!("{value:e}");
        let (digits, exponent) = text.split_once('e')?;
        let fraction = digits.split_once('.').map_or(0, |(_, f)| f.len());
        let mantissa = digits.replace('.', "").parse().ok()?;
        Some(Self { mantissa, exponent: exponent.parse::<i32>().ok()? - i32::try_from(fraction).ok()? })
    }

    /// The mantissa at a smaller exponent; `None` if it does not fit.
    fn at(self, exponent: i32) -> Option<i128> {
        if self.mantissa == 0 {
            return Some(0);
        }
        let shift = u32::try_from(self.exponent - exponent).ok()?;
        self.mantissa.checked_mul(10i128.checked_pow(shift)?)
    }
}

/// The change of one axis: X' = (X × factor + shift) / divisor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Axis {
    factor: i128,
    shift: i128,
    divisor: i128,
}

impl Axis {
    fn between(scale: f64, offset: f64, to_scale: f64, to_offset: f64) -> Option<Self> {
        let parts = [scale, offset, to_scale, to_offset].map(Decimal::of);
        let exponent = parts.iter().flatten().filter(|d| d.mantissa != 0).map(|d| d.exponent).min()?;
        let [scale, offset, to_scale, to_offset] = parts.map(|d| d.and_then(|d| d.at(exponent)));
        let axis = Self { factor: scale?, shift: offset?.checked_sub(to_offset?)?, divisor: to_scale? };
        (axis.divisor != 0).then_some(axis)
    }

    fn apply(&self, value: i32) -> Option<i32> {
        let scaled = i128::from(value).checked_mul(self.factor)?.checked_add(self.shift)?;
        if scaled % self.divisor != 0 {
            return None;
        }
        i32::try_from(scaled / self.divisor).ok()
    }
}

/// The exact change of X, Y and Z from one scale and offset to another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExactChange([Axis; 3]);

impl ExactChange {
    /// `None` where no record at all can be changed, e.g. because the numbers are too far apart.
    pub fn between(
        scale: [f64; 3],
        offset: [f64; 3],
        to_scale: [f64; 3],
        to_offset: [f64; 3],
    ) -> Option<Self> {
        let axis = |i: usize| Axis::between(scale[i], offset[i], to_scale[i], to_offset[i]);
        Some(Self([axis(0)?, axis(1)?, axis(2)?]))
    }

    /// Whether every coordinate of the one scale and offset is one of the other, but for the range of int32.
    pub fn is_total(&self) -> bool {
        self.0.iter().all(|axis| axis.factor % axis.divisor == 0 && axis.shift % axis.divisor == 0)
    }

    /// Changes the first 12 bytes of a record; `None`, with the record half changed, if that is not exact or
    /// leaves the range of int32.
    pub fn apply(&self, record: &mut [u8]) -> Option<()> {
        let position = super::position(record);
        for (index, axis) in self.0.iter().enumerate() {
            let value = axis.apply(position[index])?;
            record[index * 4..index * 4 + 4].copy_from_slice(&value.to_le_bytes());
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn change(x: i32, scale: f64, offset: f64, to_scale: f64, to_offset: f64) -> Option<i32> {
        Axis::between(scale, offset, to_scale, to_offset)?.apply(x)
    }

    #[test]
    fn decimals() {
        assert_eq!(Decimal::of(0.01), Some(Decimal { mantissa: 1, exponent: -2 }));
        assert_eq!(Decimal::of(-637291.0), Some(Decimal { mantissa: -637291, exponent: 0 }));
        assert_eq!(Decimal::of(-0.0), Some(Decimal { mantissa: 0, exponent: 0 }));
        assert_eq!(Decimal::of(f64::NAN), None);
    }

    #[test]
    fn exact_or_refused() {
        assert_eq!(change(123, 0.01, 637291.0, 0.01, 0.0), Some(63_729_223));
        assert_eq!(change(1230, 0.001, 0.0, 0.01, 0.0), Some(123));
        assert_eq!(change(1231, 0.001, 0.0, 0.01, 0.0), None);
        assert_eq!(change(7, 0.25, 0.5, 0.125, 0.0), Some(18));
        assert_eq!(change(i32::MAX, 0.01, 1.0, 0.01, 0.0), None);
        assert_eq!(change(1, 1e-300, 0.0, 1e300, 0.0), None);
        assert_eq!(change(5, 0.01, -0.0, 0.01, 0.0), Some(5));
    }

    #[test]
    fn total_where_no_coordinate_lies_between_steps() {
        let total = |scale, offset, to_scale, to_offset| {
            ExactChange::between([scale; 3], [offset; 3], [to_scale; 3], [to_offset; 3]).unwrap().is_total()
        };
        assert!(total(0.01, 637291.0, 0.01, 0.0));
        assert!(total(0.01, 0.0, 0.001, 0.0));
        assert!(total(0.01, 0.005, 0.001, 7.0));
        assert!(!total(0.001, 0.0, 0.01, 0.0));
        assert!(!total(0.01, 0.005, 0.01, 0.0));
        assert!(!ExactChange::between([0.01; 3], [0.0; 3], [0.01, 0.01, 0.1], [0.0; 3]).unwrap().is_total());
    }

    proptest! {
        #[test]
        fn there_and_back(x in -1_000_000i32..1_000_000, digits in 0i32..5, finer in 0i32..3, offset in -1000i32..1000) {
            let (coarse, fine) = (10f64.powi(-digits), 10f64.powi(-digits - finer));
            let there = change(x, coarse, f64::from(offset), fine, 0.0);
            if let Some(there) = there {
                prop_assert_eq!(change(there, fine, 0.0, coarse, f64::from(offset)), Some(x));
            } else {
                let value = f64::from(x) * coarse + f64::from(offset);
                prop_assert!((value / fine).abs() > f64::from(i32::MAX) - 1.0);
            }
        }
    }
}
