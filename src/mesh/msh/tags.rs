//! From node tags, in whatever order and with whatever gaps, to node numbers 0, 1, 2, ...

use super::content::{MeshFault, damaged};

/// The number of each node tag.
pub(super) enum Tags {
    /// Number = tag − first.
    Ascending { first: u64, count: u32 },
    /// Number of every tag from `first` on, `ABSENT` for gaps.
    Table { first: u64, numbers: Vec<u32> },
    /// Tags with large gaps: (tag, number), ascending.
    Sparse(Vec<(u64, u32)>),
}

const ABSENT: u32 = u32::MAX;
/// Entries of a table per node, at most: keeps it below the size of the node in the file.
const SPREAD: u64 = 4;

impl Tags {
    /// Refuses a tag that occurs twice.
    pub(super) fn new(tags: &[u64]) -> Result<Tags, MeshFault> {
        let first = tags.iter().copied().min().unwrap_or(1);
        let last = tags.iter().copied().max().unwrap_or(0);
        if u32::try_from(tags.len()).is_err() || tags.len() as u64 >= u64::from(ABSENT) {
            return Err(MeshFault {
                what: format!("has {} nodes", tags.len()),
                help: "use a coarser mesh".into(),
            });
        }
        let numbered = tags.iter().zip(0_u32..);
        if tags.windows(2).all(|pair| pair[0].checked_add(1) == Some(pair[1])) {
            return Ok(Tags::Ascending { first, count: tags.len() as u32 });
        }
        let span = (last - first).saturating_add(1);
        if span <= SPREAD * tags.len() as u64 {
            let mut numbers = vec![ABSENT; span as usize];
            for (tag, number) in numbered {
                let entry = &mut numbers[(tag - first) as usize];
                if *entry != ABSENT {
                    return Err(repeated(*tag));
                }
                *entry = number;
            }
            return Ok(Tags::Table { first, numbers });
        }
        let mut pairs: Vec<(u64, u32)> = numbered.map(|(&tag, number)| (tag, number)).collect();
        pairs.sort_unstable();
        match pairs.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            Some(pair) => Err(repeated(pair[0].0)),
            None => Ok(Tags::Sparse(pairs)),
        }
    }

    /// The node number of a tag.
    pub(super) fn number(&self, tag: u64) -> Option<u32> {
        match self {
            Tags::Ascending { first, count } => {
                tag.checked_sub(*first).and_then(|n| u32::try_from(n).ok()).filter(|n| n < count)
            }
            Tags::Table { first, numbers } => {
                let entry = usize::try_from(tag.checked_sub(*first)?).ok()?;
                numbers.get(entry).copied().filter(|&number| number != ABSENT)
            }
            Tags::Sparse(pairs) => {
                pairs.binary_search_by_key(&tag, |pair| pair.0).ok().map(|found| pairs[found].1)
            }
        }
    }
}

fn repeated(tag: u64) -> MeshFault {
    damaged(format!("has node {tag} twice"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_find_their_numbers_in_every_arrangement() {
        for tags in [vec![5, 6, 7], vec![3, 1, 2], vec![4, 9, 2], vec![u64::MAX, 1, 1 << 40]] {
            let map = Tags::new(&tags).unwrap();
            for (number, &tag) in (0..).zip(&tags) {
                assert_eq!(map.number(tag), Some(number), "{tags:?}");
            }
            assert_eq!(map.number(8), None);
            assert_eq!(map.number(0), None);
        }
    }

    #[test]
    fn a_repeated_tag_is_refused() {
        assert!(Tags::new(&[1, 2, 1]).is_err());
        assert!(Tags::new(&[1, 1 << 50, 1]).is_err());
    }
}
