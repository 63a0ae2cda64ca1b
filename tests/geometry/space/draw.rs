//! Shapes of space at random, and all that is hard about pairs of them.
use super::oracle::{Boxed, Vector, Wide, axes, times, vector};
use geograd::{Obb3, Rotation3, Vec3};

/// The families of hard inputs, and what each makes of a pair.
pub const FAMILIES: [&str; 8] = [
    "random",
    "on a grid: equal, touching, parallel, flat",
    "nearly parallel",
    "thin",
    "short and close",
    "stacked, touching by 0 and 1e-9",
    "far from the origin",
    "concentric",
];

/// Numbers at random, the same ones every time.
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11
    }
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() as f64 / (1_u64 << 53) as f64)
    }
    pub fn below(&mut self, n: usize) -> usize {
        (self.next() >> 20) as usize % n
    }
    /// A power of ten.
    pub fn power(&mut self, low: f64, high: f64) -> f64 {
        10_f64.powf(self.within(low, high))
    }
    pub fn vector(&mut self, size: f64) -> Vec3<f64> {
        let mut one = || self.within(-size, size);
        Vec3::new(one(), one(), one())
    }
    fn on_grid(&mut self) -> Vec3<f64> {
        let mut one = || self.below(5) as f64 * 0.5 - 1.0;
        Vec3::new(one(), one(), one())
    }
    /// A corner of a hull in a family.
    pub fn corner(&mut self, family: usize) -> Vec3<f64> {
        let close = Vec3::new(0.3, 0.2, 0.1);
        match family {
            0 => self.vector(1.0),
            1 => self.on_grid(),
            2 => {
                let size = self.power(-15.0, -3.0);
                self.on_grid() + self.vector(size)
            }
            3 => {
                let (at, thin) = (self.vector(1.0), self.power(-12.0, -3.0));
                Vec3::new(at.x, at.y, at.z * thin)
            }
            4 if self.below(2) == 0 => self.vector(1.0),
            4 => {
                let size = self.power(-9.0, 0.0);
                close + self.vector(size)
            }
            5 => {
                let heights = [0.0, 1.0, 1.0 + 1e-9, 1.0 - 1e-9];
                let at = self.vector(1.0);
                Vec3::new(at.x, at.y, heights[self.below(4)])
            }
            6 => Vec3::new(1e6, -2e6, 3e6) + self.vector(1.0),
            _ => {
                let at = self.on_grid();
                if self.below(2) == 0 { at } else { at * 0.5 }
            }
        }
    }
    /// A box in a family.
    pub fn solid(&mut self, family: usize) -> Obb3<f64> {
        let size = |random: &mut Random| match family {
            0 | 6 => Vec3::new(
                random.within(0.1, 2.0),
                random.within(0.1, 2.0),
                random.within(0.1, 2.0),
            ),
            3 => Vec3::new(random.within(0.1, 2.0), random.power(-6.0, -2.0), 1.0),
            _ => {
                let mut one = || [0.0, 0.5, 1.0, 1.0, 2.0][random.below(5)];
                Vec3::new(one(), one(), one())
            }
        };
        let mut size = size(self);
        let center = match family {
            0 => self.vector(1.5),
            5 => {
                size.z = 1.0;
                self.corner(5)
            }
            6 => Vec3::new(1e6, -2e6, 3e6) + self.vector(1.5),
            7 => Vec3::zero(),
            _ => self.on_grid(),
        };
        let turn = self.power(-15.5, -3.0);
        let mut small = || self.within(-turn, turn);
        let [x, y, z] = [small(), small(), small()];
        let rotation = match family {
            1 => [
                Rotation3::identity(),
                Rotation3::new(1.0, 0.0, 0.0, 1.0),
                Rotation3::new(1.0, 1.0, 1.0, 1.0),
            ][self.below(3)],
            2 => Rotation3::new(1.0, x, y, z),
            4 => Rotation3::new(1.0, 0.0, 0.0, z),
            5 => Rotation3::from_yaw(self.within(-3.0, 3.0)),
            _ => {
                let v = self.vector(1.0);
                Rotation3::new(self.within(-1.0, 1.0), v.x, v.y, v.z)
            }
        };
        Obb3::new(center, size, rotation)
    }
}

pub fn wide(v: Vec3<f64>) -> Vector {
    vector([v.x, v.y, v.z])
}

/// The same box for the oracle.
pub fn boxed(shape: &Obb3<f64>) -> Boxed {
    let (q, size) = (shape.rotation, shape.size);
    let axes = axes([q.w, q.x, q.y, q.z]);
    let half = [size.x, size.y, size.z].map(|side| Wide::of(side * 0.5));
    Boxed {
        center: wide(shape.center),
        arms: [0, 1, 2].map(|k| times(axes[k], half[k])),
    }
}
