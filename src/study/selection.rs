//! Selection of a study's points: all of them, one, or a shard, which is every N-th from K on.

use std::iter::StepBy;
use std::ops::Range;
use std::str::FromStr;

/// Most shards of a study.
const MOST: usize = 1_000_000;

/// Share of the points for one process: the points k with k mod `count` = `index`. Neighbours, which mostly differ in cost by
/// little, go to different shards, so that all of them take about as long; and no shard has to know how many points there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Its number, from 0.
    pub index: usize,
    /// Number of shards.
    pub count: usize,
}

/// Points that are checked and run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Selection {
    /// All points.
    All,
    /// One point.
    Point(usize),
    /// The points of a shard.
    Shard(Shard),
}

impl Selection {
    /// The points of it among so many, in order.
    pub(super) fn of(&self, total: usize) -> StepBy<Range<usize>> {
        match *self {
            Selection::All => (0..total).step_by(1),
            Selection::Point(point) => (point..total.min(point.saturating_add(1))).step_by(1),
            Selection::Shard(Shard { index, count }) => (index..total).step_by(count),
        }
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Shard, String> {
        let numbers = text.split_once('/').map(|(index, count)| (index.parse(), count.parse()));
        let Some((Ok(index), Ok(count))) = numbers else {
            return Err("K/N, shard K of N, such as 0/4".into());
        };
        match count {
            1..=MOST if index < count => Ok(Shard { index, count }),
            1..=MOST => Err(format!("{count} shards count from 0 to {}", count - 1)),
            _ => Err(format!("from 1 to {MOST} shards")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_have_every_point_once() {
        for (total, count) in [(10, 3), (3, 3), (2, 5), (0, 2), (7, 1)] {
            let shards = (0..count).map(|index| Selection::Shard(Shard { index, count }));
            let mut points: Vec<usize> = shards.flat_map(|shard| shard.of(total)).collect();
            points.sort_unstable();
            assert_eq!(points, Selection::All.of(total).collect::<Vec<_>>(), "{total} in {count}");
        }
        assert_eq!(Selection::Point(2).of(3).collect::<Vec<_>>(), [2]);
        assert_eq!(Selection::Point(3).of(3).count(), 0);
    }
}
