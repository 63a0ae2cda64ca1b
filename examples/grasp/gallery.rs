//! The picture: of every body the start of its best grasp, and the grasp.
use crate::gripper::{self, Grasp};
use common::blend::Faces;
use common::painter::{Colour, Painter, View};
use common::svg::{FAINT, Page, headed};
use geograd::Vec2;
use std::f64::consts::PI;

const PANEL: Vec2<f64> = Vec2::new(300.0, 290.0);
const LEFT: f64 = 24.0;
const TOP: f64 = 104.0;
/// The space over a row of panels for its words.
const WORDS: f64 = 26.0;
/// Pixels of a metre.
const SCALE: f64 = 1250.0;
const TURNED: f64 = 0.55;
const TILTED: f64 = 0.5;
const BODY: Colour = [222, 200, 160];
const FINGERS: Colour = [60, 130, 200];
const PALM: Colour = [134, 142, 150];

/// A body with its best grasp.
pub struct Shown<'a> {
    pub name: &'a str,
    pub body: &'a Faces,
    pub grasps: [Grasp<f64>; 2],
    pub words: String,
}

/// Returns the whole picture.
pub fn page(all: &[Shown<'_>]) -> String {
    let columns = all.len() as f64;
    let size = Vec2::new(
        LEFT + columns * (PANEL.x + LEFT),
        TOP + 2.0 * (PANEL.y + WORDS) + LEFT,
    );
    let title = "Two fingers take hold: starts, and the grasps that derivatives find";
    let mut page = Page::titled(size, title);
    page.head(LEFT, title, []);
    let words = "both fingers touch, no part overlaps the body or the table, the line of both contacts is in both cones of friction";
    page.text(
        Vec2::new(LEFT, 66.0),
        format_args!(r#"fill="{FAINT}""#),
        words,
    );
    for (column, shown) in all.iter().enumerate() {
        // From the side where the palm is not.
        let [_, _, palm] = gripper::parts(shown.grasps[1]);
        let near = View::turned(Vec2::zero(), SCALE, TURNED, TILTED).axes[2];
        let turned = match near.dot(palm.center()) > 0.0 {
            true => TURNED + PI,
            false => TURNED,
        };
        for row in 0..2 {
            let corner = Vec2::new(
                LEFT + column as f64 * (PANEL.x + LEFT),
                TOP + row as f64 * (PANEL.y + WORDS),
            );
            let words = match row {
                0 => headed(shown.name, ": start"),
                _ => shown.words.clone(),
            };
            page.text(corner - Vec2::new(0.0, 7.0), "", words);
            let id = format!("panel{column}{row}");
            page.ground(&id, [corner.x, corner.y, PANEL.x, PANEL.y]);
            page.inside(&id, |page| {
                let origin = corner + PANEL * 0.5 + Vec2::new(0.0, 25.0);
                let mut painter = Painter::new(View::turned(origin, SCALE, turned, TILTED));
                painter.mesh(shown.body, BODY);
                let parts = gripper::parts(shown.grasps[row]);
                for (part, colour) in parts.iter().zip([FINGERS, FINGERS, PALM]) {
                    painter.capsule(part, colour);
                }
                painter.finish(page);
            });
        }
    }
    page.finish()
}
