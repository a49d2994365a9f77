use glam::Vec3;

use super::*;

/// Numbers from 0 to 1 that look random (Steele, Lea, Flood 2014, Fast splittable pseudorandom number generators).
fn random(seed: u64) -> impl FnMut() -> f32 {
    let mut state = seed;
    move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = state;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 40) as f32 / (1_u64 << 24) as f32
    }
}

fn entries(count: usize, mut center: impl FnMut(usize) -> Vec3, size: f32) -> Vec<BuildEntry> {
    let bounds = |center: Vec3| Bounds { min: center - size, max: center + size };
    (0..count).map(|at| BuildEntry::new(bounds(center(at)), at as u32, at as u32 % 4)).collect()
}

/// Lists of all kinds, with their names.
fn lists() -> Vec<(&'static str, Vec<BuildEntry>)> {
    let mut number = random(7);
    let mut point = move || 10.0 * Vec3::new(number(), number(), number());
    let mut other = random(8);
    vec![
        ("thirteen", entries(13, |_| point(), 0.1)),
        ("a cloud", entries(5000, |_| point(), 0.1)),
        ("overlapping", entries(3000, |_| point(), 5.0)),
        ("a large cloud", entries(70_000, |_| point(), 0.02)),
        ("all in one place", entries(9000, |_| Vec3::ONE, 1.0)),
        ("a line", entries(2000, |at| Vec3::X * at as f32, 0.5)),
        ("ever closer", entries(1500, |at| Vec3::X * 0.9_f32.powi(at as i32 % 700), 1e-6)),
        ("far away", entries(500, |_| 1e18 * point(), 1e16)),
        ("few places", entries(4000, |_| Vec3::Y * (3.0 * other()).floor(), 0.1)),
    ]
}

struct Walk<'a> {
    bvh: &'a Bvh,
    entries: &'a [BuildEntry],
    /// How often each entry is in a leaf.
    met: Vec<u32>,
}

impl Walk<'_> {
    /// Checks all below a node, and returns its box.
    fn node(&mut self, place: u32, depth: usize) -> Bounds {
        assert!(depth < MAX_DEPTH);
        let node = self.bvh.nodes[place as usize];
        for slot in 0..WIDTH {
            let own = self.slot(&node, slot, depth);
            let sides = node.sides.map(|side| side[slot]);
            let held = Bounds {
                min: [sides[0], sides[2], sides[4]].into(),
                max: [sides[1], sides[3], sides[5]].into(),
            };
            assert_eq!(held, own, "the box is that of what it holds");
        }
        node.bounds()
    }

    fn slot(&mut self, node: &BvhNode, slot: usize, depth: usize) -> Bounds {
        let (first, count) = (node.first[slot], node.count[slot]);
        if count == 0 {
            return if first == 0 { Bounds::EMPTY } else { self.node(first, depth + 1) };
        }
        let range = first as usize..(first + count) as usize;
        let leaf = &self.entries[range.clone()];
        assert!(leaf.is_sorted_by_key(BuildEntry::leaf_key) && count as usize <= build::LEAF_SIZE);
        self.met[range].iter_mut().for_each(|met| *met += 1);
        leaf.iter().fold(Bounds::EMPTY, |all, entry| all.union(entry.bounds()))
    }
}

#[test]
fn every_body_is_in_one_leaf_and_every_box_fits() {
    for (name, mut entries) in lists() {
        let before: Vec<Bounds> = entries.iter().map(BuildEntry::bounds).collect();
        let bvh = Bvh::build(&mut entries);
        let mut walk = Walk { bvh: &bvh, entries: &entries, met: vec![0; entries.len()] };
        let all = walk.node(0, 0);
        assert!(walk.met.iter().all(|&met| met == 1), "{name}");
        assert_eq!(all, bvh.bounds());
        let mut places: Vec<u32> = entries.iter().map(BuildEntry::place).collect();
        assert!(entries.iter().all(|entry| entry.bounds() == before[entry.place() as usize]), "{name}");
        places.sort_unstable();
        assert!(places.into_iter().eq(0..before.len() as u32), "{name}");
    }
}

#[test]
fn it_does_not_depend_on_the_number_of_threads() {
    for (name, entries) in lists() {
        let built = [1, 2, 5].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut entries = entries.clone();
            let bvh = pool.install(|| Bvh::build(&mut entries));
            (bvh, entries.iter().map(BuildEntry::place).collect::<Vec<_>>())
        });
        for (bvh, order) in &built[1..] {
            assert!(bvh.nodes == built[0].0.nodes && *order == built[0].1, "{name}");
            assert_eq!(bvh.cost.to_bits(), built[0].0.cost.to_bits(), "{name}");
        }
    }
}

#[test]
fn nodes_are_well_filled() {
    for (name, mut entries) in lists() {
        let bvh = Bvh::build(&mut entries);
        let bytes = bvh.bytes() as f64 / entries.len() as f64;
        assert!(bytes < 80.0, "{name}: {bytes} bytes a body");
    }
}
