//! A run in parts, each on a machine of its own.

use std::collections::BTreeMap;
use std::str::FromStr;

use super::ShardStamp;

/// Which part, and of how many.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// From 1.
    pub index: u32,
    /// At least as large.
    pub count: u32,
}

/// More machines than anyone lends.
const MOST: u32 = 10_000;

impl FromStr for Shard {
    type Err = String;

    /// Reads `K/N`.
    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(k, n)| Some((k.trim().parse().ok()?, n.trim().parse().ok()?)));
        match numbers {
            Some((index, count)) if (1..=count).contains(&index) && count <= MOST => Ok(Self { index, count }),
            _ => Err(format!("'{text}' is no shard; write K/N with K from 1 to N, such as 2/4")),
        }
    }
}

impl Shard {
    /// Deals ids to all shards, the same on every machine, and says which are this one's. Without costs by a hash of each id, so that
    /// ids that come or go leave the others where they are; with costs (seconds; the mean for what has none) the longest first, each to
    /// the shard that has least.
    #[must_use]
    pub fn deal(self, ids: &[&str], costs: Option<&BTreeMap<String, f64>>) -> ShardStamp {
        let owners = costs.map_or_else(|| self.by_hash(ids), |costs| self.by_cost(ids, costs));
        let own = ids.iter().zip(owners).filter(|(_, owner)| *owner == self.index).map(|(id, _)| (*id).to_owned());
        ShardStamp {
            index: self.index,
            count: self.count,
            own: own.collect(),
            dealt: ids.iter().map(|id| (*id).to_owned()).collect(),
        }
    }

    fn by_hash(self, ids: &[&str]) -> Vec<u32> {
        let owner = |id: &&str| {
            let hash = blake3::hash(id.as_bytes());
            let number = u64::from_le_bytes(*hash.as_bytes().first_chunk().expect("a hash has 32 bytes"));
            (number % u64::from(self.count)) as u32 + 1
        };
        ids.iter().map(owner).collect()
    }

    fn by_cost(self, ids: &[&str], costs: &BTreeMap<String, f64>) -> Vec<u32> {
        let known: Vec<f64> = ids.iter().filter_map(|id| costs.get(*id)).copied().filter(|cost| cost.is_finite()).collect();
        let mean = if known.is_empty() { 1.0 } else { known.iter().sum::<f64>() / known.len() as f64 };
        let cost = |i: usize| costs.get(ids[i]).copied().filter(|cost| cost.is_finite()).unwrap_or(mean);
        let mut order: Vec<usize> = (0..ids.len()).collect();
        order.sort_by(|&a, &b| cost(b).total_cmp(&cost(a)).then(ids[a].cmp(ids[b])));
        let mut loads = vec![0.0; self.count as usize];
        let mut owners = vec![0; ids.len()];
        for i in order {
            let least = (0..loads.len()).min_by(|&a, &b| f64::total_cmp(&loads[a], &loads[b])).unwrap_or(0);
            loads[least] += cost(i);
            owners[i] = least as u32 + 1;
        }
        owners
    }
}

/// What is wrong with a set of shards, if anything is: one absent, there twice, or dealt otherwise.
///
/// # Errors
///
/// In words, each shard by its name.
pub fn check_whole(shards: &[(&str, &ShardStamp)]) -> Result<(), String> {
    let [(first_name, first), ..] = shards else { return Err("there are no shards".into()) };
    let mut named: BTreeMap<u32, &str> = BTreeMap::new();
    for (name, shard) in shards {
        if (shard.count, &shard.dealt) != (first.count, &first.dealt) {
            return Err(format!("{first_name} and {name} are not shards of one run: they were dealt differently"));
        }
        if let Some(twin) = named.insert(shard.index, name) {
            return Err(format!("shard {}/{} is there twice: {twin} and {name}", shard.index, shard.count));
        }
    }
    let absent: Vec<String> =
        (1..=first.count).filter(|k| !named.contains_key(k)).map(|k| format!("{k}/{}", first.count)).collect();
    if !absent.is_empty() {
        return Err(format!("shard {} is absent; name the results of all {}", absent.join(", "), first.count));
    }
    let mut own: Vec<&String> = shards.iter().flat_map(|(_, shard)| &shard.own).collect();
    let mut dealt: Vec<&String> = first.dealt.iter().collect();
    own.sort();
    dealt.sort();
    if own != dealt {
        return Err("the shards together are not the whole run; give --costs the same file for all of them".into());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const IDS: [&str; 7] = ["a", "b", "c", "d", "e", "f", "g"];

    fn deal(count: u32, costs: Option<&BTreeMap<String, f64>>) -> Vec<ShardStamp> {
        (1..=count).map(|index| Shard { index, count }.deal(&IDS, costs)).collect()
    }

    fn check(shards: &[ShardStamp]) -> Result<(), String> {
        let named: Vec<(&str, &ShardStamp)> = shards.iter().map(|shard| ("a file", shard)).collect();
        check_whole(&named)
    }

    #[test]
    fn shards_are_read() {
        assert_eq!("2/4".parse(), Ok(Shard { index: 2, count: 4 }));
        for bad in ["", "0/4", "5/4", "1", "1/0", "-1/2", "1/2/3", "a/b", "1/99999"] {
            assert!(bad.parse::<Shard>().is_err(), "{bad}");
        }
    }

    #[test]
    fn every_id_is_dealt_once_and_stays_when_others_come() {
        for count in 1..6 {
            check(&deal(count, None)).expect("whole");
        }
        let shard = Shard { index: 2, count: 3 };
        let (few, all) = (shard.deal(&IDS[..4], None).own, shard.deal(&IDS, None).own);
        assert!(all.starts_with(&few), "{few:?} {all:?}");
    }

    #[test]
    fn costs_are_levelled() {
        let costs: BTreeMap<String, f64> =
            IDS.iter().zip([9.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0]).map(|(id, cost)| ((*id).to_owned(), cost)).collect();
        let dealt = deal(2, Some(&costs));
        check(&dealt).expect("whole");
        assert_eq!(dealt[0].own, ["a"]);
        let unknown = BTreeMap::from([("a".to_owned(), f64::NAN)]);
        check(&deal(3, Some(&unknown))).expect("whole");
    }

    #[test]
    fn what_is_absent_or_there_twice_is_named() {
        let mut dealt = deal(3, None);
        dealt.pop();
        assert!(check(&dealt).expect_err("absent").contains("3/3 is absent"));
        dealt.push(dealt[0].clone());
        assert!(check(&dealt).expect_err("twice").contains("1/3 is there twice"));
        let mut other = deal(3, None);
        other[1].own.clear();
        other[1].own.push("x".into());
        assert!(check(&other).expect_err("dealt by other costs").contains("--costs"));
        other[1].dealt.push("x".into());
        assert!(check(&other).expect_err("of another run").contains("dealt differently"));
        assert!(check_whole(&[]).is_err());
    }
}
