//! Attribute statistics of all points, the second of Groma's records.

use crate::record::fields::Field;
use serde::Serialize;
use std::collections::BTreeMap;

/// Byte of the return number and of the classification in the formats 6 to 8.
const RETURN_AT: usize = 14;
const CLASS_AT: usize = 16;

/// What the JSON of the record says.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Statistics {
    version: u32,
    points: u64,
    /// 8 where no colour exceeds 255, 16 where one does, none where there is no colour but black.
    pub rgb_bits: Option<u8>,
    attributes: Vec<Attribute>,
    /// Points per class.
    classes: BTreeMap<u8, u64>,
    /// Points per return number.
    returns: BTreeMap<u8, u64>,
}

/// Range and mean of one attribute, in its own unit (source coordinates for x, y and z).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Attribute {
    pub name: String,
    pub min: f64,
    pub max: f64,
    pub mean: f64,
}

impl Statistics {
    /// What the sums over all records say.
    pub fn of(total: &Tally, fields: &[Field]) -> Self {
        let attributes: Vec<_> =
            fields.iter().zip(&total.sums).filter_map(|(f, sum)| sum.finish(f)).collect();
        let brightest = attributes.iter().filter(|a| matches!(a.name.as_str(), "red" | "green" | "blue"));
        let brightest = brightest.map(|a| a.max).reduce(f64::max);
        let present = |counts: &[u64]| -> BTreeMap<u8, u64> {
            (0..=u8::MAX).zip(counts).filter(|(_, n)| **n > 0).map(|(value, n)| (value, *n)).collect()
        };
        Self {
            version: 1,
            points: total.points,
            rgb_bits: brightest.filter(|max| *max > 0.0).map(|max| if max > 255.0 { 16 } else { 8 }),
            attributes,
            classes: present(&total.classes),
            returns: present(&total.returns),
        }
    }

    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|attribute| attribute.name == name)
    }

    /// Points of the return numbers 1 to 15, as the header of LAS 1.4 counts them.
    pub fn points_by_return(&self) -> [u64; 15] {
        std::array::from_fn(|i| self.returns.get(&(i as u8 + 1)).copied().unwrap_or(0))
    }
}

/// Values are summed up divided by this: no sum of 2^64 of them overflows, and a power of two rounds nothing but what
/// is below 2^-958.
const SCALE_DOWN: f64 = 18_446_744_073_709_551_616.0;

/// Range and sum of the stored numbers of one field.
#[derive(Debug, Clone, Copy)]
struct Sum {
    min: f64,
    max: f64,
    /// In units of [`SCALE_DOWN`].
    total: f64,
    count: u64,
}

impl Sum {
    const EMPTY: Self = Self { min: f64::INFINITY, max: f64::NEG_INFINITY, total: 0.0, count: 0 };

    fn finish(&self, field: &Field) -> Option<Attribute> {
        let value = |stored: f64| stored * field.scale + field.offset;
        let (a, b) = (value(self.min), value(self.max));
        if !(a.is_finite() && b.is_finite()) {
            return None;
        }
        let (min, max) = (a.min(b), a.max(b));
        let mean = value(self.total / self.count as f64 * SCALE_DOWN).clamp(min, max);
        Some(Attribute { name: field.name.clone(), min, max, mean })
    }
}

/// Sums over some records. Those of pieces of the input are added up in the input's order, so that float sums depend
/// on nothing else.
#[derive(Debug, Clone)]
pub struct Tally {
    points: u64,
    sums: Vec<Sum>,
    classes: [u64; 256],
    returns: [u64; 16],
}

impl Tally {
    pub fn empty(fields: usize) -> Self {
        Self { points: 0, sums: vec![Sum::EMPTY; fields], classes: [0; 256], returns: [0; 16] }
    }

    /// Sums up whole records of `length` bytes; values that are not finite do not count.
    pub fn of(block: &[u8], length: usize, fields: &[Field]) -> Self {
        let mut tally = Self::empty(fields.len());
        tally.points = (block.len() / length) as u64;
        for (field, sum) in fields.iter().zip(&mut tally.sums) {
            field.each(block, length, |value| {
                if value.is_finite() {
                    sum.min = sum.min.min(value);
                    sum.max = sum.max.max(value);
                    sum.total += value * (1.0 / SCALE_DOWN);
                    sum.count += 1;
                }
            });
        }
        for record in block.chunks_exact(length) {
            tally.classes[usize::from(record[CLASS_AT])] += 1;
            tally.returns[usize::from(record[RETURN_AT] & 15)] += 1;
        }
        tally
    }

    pub fn add(&mut self, other: &Self) {
        self.points += other.points;
        for (mine, its) in self.sums.iter_mut().zip(&other.sums) {
            mine.min = mine.min.min(its.min);
            mine.max = mine.max.max(its.max);
            mine.total += its.total;
            mine.count += its.count;
        }
        let pairs =
            self.classes.iter_mut().zip(&other.classes).chain(self.returns.iter_mut().zip(&other.returns));
        for (mine, its) in pairs {
            *mine += its;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Target;
    use crate::record::fields::fields;

    #[test]
    fn ranges_counts_and_colour_depth() {
        let mut records = vec![0u8; 36 * 3];
        for (index, record) in records.chunks_exact_mut(36).enumerate() {
            record[..4].copy_from_slice(&(index as i32 * 100).to_le_bytes());
            record[14] = 0x21 + index as u8;
            record[16] = 2;
            record[22..30].copy_from_slice(&[1.5, f64::NAN, 2.5][index].to_le_bytes());
            record[30] = 200;
        }
        let all = fields(Target::Rgb, [0.01, 1.0, 1.0], [10.0, 0.0, 0.0], &[], 36);
        let statistics = Statistics::of(&Tally::of(&records, 36, &all), &all);
        let x = statistics.attribute("x").unwrap();
        assert_eq!((x.min, x.max, x.mean), (10.0, 12.0, 11.0));
        let time = statistics.attribute("gpsTime").unwrap();
        assert_eq!((time.min, time.max, time.mean), (1.5, 2.5, 2.0));
        assert_eq!(statistics.rgb_bits, Some(8));
        assert_eq!(statistics.points_by_return()[..4], [1, 1, 1, 0]);
        let json = serde_json::to_value(&statistics).unwrap();
        assert_eq!(json["classes"], serde_json::json!({ "2": 3 }));
        assert_eq!(json["returns"], serde_json::json!({ "1": 1, "2": 1, "3": 1 }));
    }

    #[test]
    fn a_sum_too_large_for_a_number_costs_no_range() {
        let mut records = vec![0u8; 30 * 4];
        for (record, time) in records.chunks_exact_mut(30).zip([1.7e308, f64::NAN, 1.7e308, -0.5]) {
            record[22..].copy_from_slice(&f64::to_le_bytes(time));
        }
        let all = fields(Target::Plain, [1.0; 3], [0.0; 3], &[], 30);
        let statistics = Statistics::of(&Tally::of(&records, 30, &all), &all);
        let time = statistics.attribute("gpsTime").unwrap();
        assert_eq!((time.min, time.max), (-0.5, 1.7e308));
        assert!((time.mean / 1.7e308 - 2.0 / 3.0).abs() < 1e-15);
    }

    #[test]
    fn black_is_no_colour() {
        let all = fields(Target::Rgb, [1.0; 3], [0.0; 3], &[], 36);
        assert_eq!(Statistics::of(&Tally::of(&[0; 72], 36, &all), &all).rgb_bits, None);
    }
}
