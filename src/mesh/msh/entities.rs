//! Which physical groups the geometric entities of an MSH file belong to.

use mshio::Entities as Parsed;

use super::content::{Declared, KINDS, MeshFault, damaged};

/// Physical tags of the entities, by dimension.
#[derive(Debug, Default)]
pub(super) struct Entities {
    /// For points, curves, surfaces and volumes: entity tag and its physical tags, ascending by entity tag.
    by_dim: [Vec<(i32, Vec<u32>)>; 4],
    /// True if the file has `$Entities`.
    listed: bool,
    /// True if any entity is in a physical group.
    grouped: bool,
}

impl Entities {
    /// Takes the physical tags out of what mshio read.
    pub(super) fn new(parsed: Parsed<i32, f64>) -> Result<Entities, MeshFault> {
        let by_dim = [
            parsed.points.into_iter().map(|e| (e.tag, absolute(&e.physical_tags))).collect(),
            parsed.curves.into_iter().map(|e| (e.tag, absolute(&e.physical_tags))).collect(),
            parsed.surfaces.into_iter().map(|e| (e.tag, absolute(&e.physical_tags))).collect(),
            parsed.volumes.into_iter().map(|e| (e.tag, absolute(&e.physical_tags))).collect(),
        ];
        let mut entities = Entities { by_dim, listed: true, grouped: false };
        for (dim, list) in entities.by_dim.iter_mut().enumerate() {
            entities.grouped |= list.iter().any(|(_, groups)| !groups.is_empty());
            list.sort_by_key(|(tag, _)| *tag);
            if let Some(pair) = list.windows(2).find(|pair| pair[0].0 == pair[1].0) {
                return Err(damaged(format!("lists {} {} twice", KINDS[dim], pair[0].0)));
            }
        }
        Ok(entities)
    }

    /// Physical tags of an entity; `None` if its elements are in no group while others are, so that gmsh would not
    /// have saved them either.
    pub(super) fn groups(&self, dim: i32, tag: i32) -> Result<Option<&[u32]>, MeshFault> {
        if !self.listed {
            return Ok(Some(&[]));
        }
        let list = usize::try_from(dim).ok().and_then(|dim| self.by_dim.get(dim));
        let list = list.ok_or_else(|| damaged(format!("has elements of dimension {dim}")))?;
        let found = list.binary_search_by_key(&tag, |(tag, _)| *tag);
        let found = found.map_err(|_| {
            damaged(format!("has elements on {} {tag}, which $Entities does not list", KINDS[dim as usize]))
        })?;
        let groups = list[found].1.as_slice();
        Ok((!groups.is_empty() || !self.grouped).then_some(groups))
    }

    /// Declares the groups that have no name under their numbers, after those that have one.
    pub(super) fn declare(&self, declared: &mut Vec<Declared>) {
        let mut named: Vec<(usize, u32)> = declared.iter().map(|group| (group.dim, group.tag)).collect();
        named.sort_unstable();
        let mut unnamed: Vec<(usize, u32)> = Vec::new();
        for (dim, list) in self.by_dim.iter().enumerate() {
            unnamed.extend(list.iter().flat_map(|(_, groups)| groups).map(|&tag| (dim, tag)));
        }
        unnamed.sort_unstable();
        unnamed.dedup();
        for (dim, tag) in unnamed {
            if named.binary_search(&(dim, tag)).is_err() {
                declared.push(Declared { dim, tag, name: tag.to_string() });
            }
        }
    }
}

/// gmsh writes the number of a group negative where the entity was listed reversed.
fn absolute(tags: &[i32]) -> Vec<u32> {
    let mut tags: Vec<u32> = tags.iter().map(|tag| tag.unsigned_abs()).collect();
    tags.sort_unstable();
    tags.dedup();
    tags
}
