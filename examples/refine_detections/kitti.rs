//! Reads the text files of the KITTI tracking benchmark, and tells every line it cannot use.
//!
//! Camera coordinates: x right, y down, z forward, metres and radians. Seen from above a box is
//! centred at (x, z); its length runs along the heading and its width across. `rotation_y` is 0
//! along +x and a positive turn moves +z towards +x, so in the plane with the axes (x, z) the
//! counter-clockwise heading is its negative. The place given is the middle of the box's bottom, and up is
//! the negative of y.
use crate::model::{Class, Frames, Seen};
use geograd::{Vec3, YawBox3};
use std::path::Path;

/// Bad lines are told on stderr, at most this many of each file one by one.
const TOLD: usize = 20;

/// The counts of lines and boxes read from all files.
#[derive(Debug, Default)]
pub struct Report {
    /// Lines that could not be used.
    pub bad: usize,
    /// Detections that were read.
    pub detections: usize,
    /// Labelled boxes that were read.
    pub truths: usize,
}

/// Detections: `frame, class (1 pedestrian, 2 car, 3 cyclist), image box x1, y1, x2, y2, score, h,
/// w, l, x, y, z, rotation_y, alpha`.
pub fn read_detections(
    path: &Path,
    frames: &mut Frames,
    report: &mut Report,
) -> Result<(), String> {
    let (mut read, before) = (0, report.bad);
    each_line(path, report, |line| {
        let fields: Vec<&str> = line.split(',').map(str::trim).collect();
        let fields = Fields::new(&fields, 15)?;
        fields.unused(&[(2, "x1"), (3, "y1"), (4, "x2"), (5, "y2"), (14, "alpha")])?;
        let class = match fields.text(1) {
            "1" => Class::Pedestrian,
            "2" => Class::Car,
            "3" => Class::Cyclist,
            other => {
                return Err(format!(
                    "class is 1 (pedestrian), 2 (car) or 3 (cyclist): `{other}`"
                ));
            }
        };
        let detection = Seen {
            class,
            score: fields.number(6, "score")?,
            shape: fields.shape(7)?,
        };
        frames
            .entry(fields.frame()?)
            .or_default()
            .detections
            .push(detection);
        read += 1;
        Ok(())
    })?;
    tell_nothing(path, "detections", read, report.bad - before);
    report.detections += read;
    Ok(())
}

/// Ground truth: `frame, track id, class name, truncated, occluded, alpha, image box x1 y1 x2 y2, h
/// w l, x y z, rotation_y`. Regions marked DontCare have no geometry and are passed over.
pub fn read_labels(path: &Path, frames: &mut Frames, report: &mut Report) -> Result<(), String> {
    let (mut read, before) = (0, report.bad);
    each_line(path, report, |line| {
        let fields: Vec<&str> = line.split_whitespace().collect();
        if fields.get(2) == Some(&"DontCare") {
            return Ok(());
        }
        let fields = Fields::new(&fields, 17)?;
        fields.unused(&[
            (1, "track id"),
            (3, "truncated"),
            (4, "occluded"),
            (5, "alpha"),
        ])?;
        fields.unused(&[(6, "x1"), (7, "y1"), (8, "x2"), (9, "y2")])?;
        let truth = Seen {
            class: match fields.text(2) {
                "Car" => Class::Car,
                "Pedestrian" => Class::Pedestrian,
                "Cyclist" => Class::Cyclist,
                "Van" | "Truck" | "Tram" | "Misc" | "Person" | "Person_sitting" => Class::Other,
                other => return Err(format!("unknown class name `{other}`")),
            },
            score: 1.0,
            shape: fields.shape(10)?,
        };
        let frame = frames.entry(fields.frame()?).or_default();
        frame.truths.push(truth);
        read += 1;
        let class = match fields.text(2) {
            "Van" => Class::Car,
            "Person" | "Person_sitting" => Class::Pedestrian,
            _ => return Ok(()),
        };
        frame.alike.push(Seen { class, ..truth });
        Ok(())
    })?;
    tell_nothing(path, "labelled boxes", read, report.bad - before);
    report.truths += read;
    Ok(())
}

/// Tells a file of which nothing could be read.
fn tell_nothing(path: &Path, what: &str, read: usize, bad: usize) {
    let name = path.display();
    match (read, bad) {
        (0, 0) => eprintln!("{name}: no {what} in it"),
        (0, _) => eprintln!("{name}: no {what} in it but bad lines"),
        _ => {}
    }
}

/// So many bad lines, in words.
pub fn bad_lines(count: usize) -> String {
    match count {
        1 => "1 bad line".to_string(),
        _ => format!("{count} bad lines"),
    }
}

/// Every line that is not blank; what is wrong with one is told with file and line number.
fn each_line(
    path: &Path,
    report: &mut Report,
    mut take: impl FnMut(&str) -> Result<(), String>,
) -> Result<(), String> {
    let name = path.display();
    let bytes = std::fs::read(path).map_err(|error| format!("{name}: {error}"))?;
    // A byte that is no UTF-8 becomes a character that fits nowhere, so its line is told like any.
    let text = String::from_utf8_lossy(&bytes);
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let mut bad = 0;
    for (i, line) in text.lines().enumerate() {
        if line.trim().is_empty() {
            continue;
        }
        if let Err(why) = take(line) {
            bad += 1;
            if bad <= TOLD {
                eprintln!("{name}:{}: {why}", i + 1);
            }
        }
    }
    if bad > TOLD {
        eprintln!("{name}: and another {}", bad_lines(bad - TOLD));
    }
    report.bad += bad;
    Ok(())
}

/// The fields of a line.
struct Fields<'a>(&'a [&'a str]);

impl<'a> Fields<'a> {
    fn new(fields: &'a [&'a str], count: usize) -> Result<Self, String> {
        if fields.len() == count {
            Ok(Fields(fields))
        } else {
            Err(format!("{} fields where {count} are needed", fields.len()))
        }
    }

    fn text(&self, i: usize) -> &'a str {
        self.0[i]
    }

    /// Columns that nothing here depends on: numbers all the same, or the line is not what it should be.
    fn unused(&self, columns: &[(usize, &str)]) -> Result<(), String> {
        for &(i, name) in columns {
            self.number(i, name)?;
        }
        Ok(())
    }

    fn frame(&self) -> Result<u32, String> {
        let text = self.text(0);
        text.parse()
            .map_err(|_| format!("frame is not a whole number: `{text}`"))
    }

    fn number(&self, i: usize, name: &str) -> Result<f32, String> {
        let text = self.text(i);
        match text.parse::<f32>() {
            Ok(number) if number.is_finite() => Ok(number),
            Ok(_) => Err(format!("{name} is not finite: `{text}`")),
            Err(_) => Err(format!("{name} is not a number: `{text}`")),
        }
    }

    /// The box of the seven fields `h, w, l, x, y, z, rotation_y`.
    fn shape(&self, first: usize) -> Result<YawBox3<f32>, String> {
        let mut values = [0.0; 7];
        let names = ["h", "w", "l", "x", "y", "z", "rotation_y"];
        for (i, (value, name)) in values.iter_mut().zip(names).enumerate() {
            *value = self.number(first + i, name)?;
            if i < 3 && *value < 0.0 {
                return Err(format!("{name} is negative: `{}`", self.text(first + i)));
            }
        }
        let [height, width, length, x, y, z, rotation_y] = values;
        Ok(YawBox3::new(
            Vec3::new(x, z, 0.5 * height - y),
            Vec3::new(length, width, height),
            -rotation_y,
        ))
    }
}
