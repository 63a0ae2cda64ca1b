//! Pairs of boxes in space, ordinary and difficult ones.
use geograd::{Obb3, Rotation3, Vec3, YawBox3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// A small generator of random numbers (SplitMix64).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.next() >> 11) as f64 / (1_u64 << 53) as f64)
    }
    pub fn vector(&mut self, reach: f64) -> Vec3<f64> {
        let mut one = || self.between(-reach, reach);
        Vec3::new(one(), one(), one())
    }
    pub fn size(&mut self) -> Vec3<f64> {
        let mut one = || self.between(0.5, 3.0);
        Vec3::new(one(), one(), one())
    }
    pub fn yaw_box(&mut self) -> YawBox3<f64> {
        YawBox3::new(self.vector(1.0), self.size(), self.between(-PI, PI))
    }
}

/// An even distribution over all rotations, with a quaternion of any length.
pub fn random_rotation(random: &mut Random) -> Rotation3<f64> {
    loop {
        let (w, v) = (random.between(-1.0, 1.0), random.vector(1.0));
        let norm = w * w + v.length_squared();
        if norm > 0.01 && norm < 1.0 {
            return Rotation3::new(w, v.x, v.y, v.z);
        }
    }
}

/// The families of pairs.
pub const FAMILIES: [&str; 19] = [
    "random",
    "upright",
    "aligned",
    "identical",
    "nearly identical",
    "nearly parallel",
    "shared face",
    "touching",
    "touching edges",
    "touching corners",
    "nested",
    "thin",
    "thin nearly parallel",
    "tiny",
    "huge",
    "far away",
    "zero size",
    "halves of right angles",
    "cubes",
];

/// A random pair of a family.
pub fn pair(family: &str, random: &mut Random) -> (Obb3<f64>, Obb3<f64>) {
    let a = Obb3::new(random.vector(0.7), random.size(), random_rotation(random));
    let b = Obb3::new(random.vector(0.7), random.size(), random_rotation(random));
    let local = a.world_from_local();
    let (h, k) = (a.size * 0.5, b.size * 0.5);
    let small = 10_f64.powf(random.between(-7.0, -3.0));
    let corner = Vec3::new(h.x + k.x, h.y + k.y, h.z + k.z);
    match family {
        "random" => (a, b),
        "upright" => (random.yaw_box().into(), random.yaw_box().into()),
        "aligned" => (
            a,
            Obb3 {
                rotation: a.rotation,
                ..b
            },
        ),
        "identical" => (a, a),
        "nearly identical" => {
            let moved = a.retract(random.vector(small));
            (
                a,
                Obb3 {
                    center: a.center + random.vector(small),
                    ..moved
                },
            )
        }
        "nearly parallel" => (
            a,
            Obb3 {
                rotation: a.retract(random.vector(small)).rotation,
                ..b
            },
        ),
        "shared face" => {
            // Both upper faces along z lie in one plane.
            let at = Vec3::new(random.between(-0.5, 0.5), 0.3, h.z - k.z);
            let turn = a.rotation * Rotation3::from_yaw(random.between(0.0, 3.0));
            (
                a,
                Obb3 {
                    center: local * at,
                    rotation: turn,
                    ..b
                },
            )
        }
        "touching" => {
            let at = Vec3::new(random.between(-0.5, 0.5), 0.3, corner.z);
            let turn = a.rotation * Rotation3::from_yaw(random.between(0.0, 3.0));
            (
                a,
                Obb3 {
                    center: local * at,
                    rotation: turn,
                    ..b
                },
            )
        }
        "touching edges" => {
            let at = Vec3::new(corner.x, corner.y, 0.2);
            (
                a,
                Obb3 {
                    center: local * at,
                    rotation: a.rotation,
                    ..b
                },
            )
        }
        "touching corners" => (
            a,
            Obb3 {
                center: local * corner,
                rotation: a.rotation,
                ..b
            },
        ),
        "nested" => (
            a,
            Obb3 {
                center: a.center + random.vector(0.02),
                size: b.size * 0.05,
                ..b
            },
        ),
        "thin" | "thin nearly parallel" => {
            let size = |random: &mut Random| {
                Vec3::new(random.between(10.0, 30.0), random.between(0.3, 0.6), 5e-4)
            };
            let a = Obb3 {
                size: size(random),
                ..a
            };
            let rotation = if family == "thin" {
                a.rotation * Rotation3::from_yaw(random.between(-0.1, 0.1))
            } else {
                a.retract(random.vector(small * 0.01)).rotation
            };
            let at = Vec3::new(random.between(-3.0, 3.0), 0.05, random.between(-2e-4, 2e-4));
            (
                a,
                Obb3::new(a.world_from_local() * at, size(random), rotation),
            )
        }
        "tiny" | "huge" => {
            let factor = if family == "tiny" { 1e-15 } else { 1e15 };
            let by = |x: Obb3<f64>| Obb3 {
                center: x.center * factor,
                size: x.size * factor,
                ..x
            };
            (by(a), by(b))
        }
        "far away" => {
            let far = Vec3::new(1e6, -2e6, 3e6);
            (
                Obb3 {
                    center: a.center + far,
                    ..a
                },
                Obb3 {
                    center: b.center + far,
                    ..b
                },
            )
        }
        "zero size" => (
            a,
            Obb3 {
                size: Vec3::new(b.size.x, 0.0, b.size.z),
                ..b
            },
        ),
        "halves of right angles" => {
            let angle = |random: &mut Random| (random.next() % 8) as f64 * FRAC_PI_4;
            let x = Rotation3::from_axis_angle(Vec3::new(1.0, 0.0, 0.0), angle(random));
            let y = Rotation3::from_axis_angle(Vec3::new(0.0, 1.0, 0.0), angle(random));
            let z = Rotation3::from_yaw(angle(random));
            (
                Obb3 { rotation: z, ..a },
                Obb3 {
                    rotation: x * y * z,
                    ..b
                },
            )
        }
        "cubes" => {
            let cube = Obb3 {
                size: Vec3::new(2.0, 2.0, 2.0),
                ..a
            };
            let quarters = (random.next() % 4) as f64 * FRAC_PI_2;
            let turn = Rotation3::from_axis_angle(Vec3::new(0.0, 1.0, 0.0), quarters);
            let half = Rotation3::from_yaw((random.next() % 2) as f64 * FRAC_PI_4);
            (
                cube,
                Obb3 {
                    rotation: a.rotation * turn * half,
                    ..cube
                },
            )
        }
        _ => unreachable!("{family}"),
    }
}

/// The same box in single precision, rounded.
pub fn single(x: Obb3<f64>) -> Obb3<f32> {
    let v = |v: Vec3<f64>| Vec3::new(v.x as f32, v.y as f32, v.z as f32);
    let q = x.rotation;
    let q = Rotation3::new(q.w as f32, q.x as f32, q.y as f32, q.z as f32);
    Obb3::new(v(x.center), v(x.size), q)
}
