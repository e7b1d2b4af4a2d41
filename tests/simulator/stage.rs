//! The scenes in which identities must last. The seed varies speeds, positions, textures and the detector's noise;
//! the event that makes a scene hard is in all of them, and `tests/simulator_itself.rs` checks that it is.

use super::camera::{Camera, Swing};
use super::detector::Detector;
use super::noise::Noise;
use super::path::Path;
use super::scene::{Object, Scene};

/// Walking speed of a person 100 px tall: about 0.8 heights per second.
const WALK: f64 = 80.0;

/// Each scene's own randomness.
fn variation(seed: u64) -> Noise {
    Noise::new(seed, 3)
}

/// Turns a scene into its mirror image for odd seeds.
fn mirrored(mut scene: Scene) -> Scene {
    if scene.seed % 2 == 1 {
        let width = scene.width as f64;
        scene.objects.iter_mut().for_each(|o| o.path.mirror(width));
    }
    scene
}

/// Two targets whose ways cross in the middle of the image after 2.5 s, the second behind the first. At 90 degrees
/// both walk alike; at small angles the farther one overtakes, as else they would stay on top of each other for
/// seconds.
pub fn crossing(seed: u64, degrees: f64) -> Scene {
    let mut vary = variation(seed);
    let heading = vary.between(-10.0, 10.0);
    let overtaking = if degrees < 45.0 { 1.7 } else { 1.0 };
    let mut walker = |degrees: f64, speed: f64, depth: f64| {
        let angle = degrees.to_radians();
        let speed = speed * vary.between(0.95, 1.05);
        let (vx, vy) = (speed * libm::cos(angle), speed * libm::sin(angle));
        let (x, y) = (384.0 + vary.between(-4.0, 4.0), 288.0 + vary.between(-4.0, 4.0));
        let height = vary.between(92.0, 106.0);
        Object::new(0.4 * height, height, depth, Path::through(2.5, x, y, vx, vy, 5.0))
    };
    let first = walker(heading - 0.5 * degrees, WALK, 1.0);
    let second = walker(heading + 0.5 * degrees, WALK * overtaking, 2.0);
    mirrored(Scene::new(seed, 5.0, vec![first, second]))
}

/// A walker passes behind a slower, much nearer target and cannot be seen at all for `hidden` seconds; with what the
/// detector does not see of its parts it is gone for longer.
pub fn full_occlusion(seed: u64, hidden: f64) -> Scene {
    let mut vary = variation(seed);
    let slow = 20.0 * vary.between(0.9, 1.1);
    let (wide, narrow) = (110.0, 36.0);
    // Fully hidden while the distance of the centres is less than half the difference of the widths.
    let fast = slow + (wide - narrow) / hidden;
    let end = 6.0;
    let near = Object::new(wide, 260.0, 1.0, Path::through(3.0, 384.0, 300.0, slow, 0.0, end));
    let y = 290.0 + vary.between(-30.0, 30.0);
    let far = Object::new(narrow, 90.0, 2.0, Path::through(3.0, 384.0, y, fast, vary.between(-4.0, 4.0), end));
    mirrored(Scene::new(seed, end, vec![near, far]))
}

/// Two targets walk side by side with a gap of a quarter of their width; the detector misses the second from 2.5 s on
/// for `gone` seconds.
pub fn side_by_side(seed: u64, gone: f64) -> Scene {
    let mut vary = variation(seed);
    let speed = WALK * vary.between(0.9, 1.1);
    let (vx, vy) = (speed, vary.between(-10.0, 10.0));
    let first = Object::new(40.0, 100.0, 1.0, Path::from(0.0, 110.0, 280.0).walk(vx, vy, 6.0));
    let y = 280.0 + vary.between(-6.0, 6.0);
    let mut second = Object::new(40.0, 98.0, 2.0, Path::from(0.0, 60.0, y).walk(vx, vy, 6.0));
    second.missed = Some((2.5, 2.5 + gone));
    mirrored(Scene::new(seed, 6.0, vec![first, second]))
}

/// A walker goes behind a standing target hardly wider than itself and turns there by 60 to 90 degrees, so that it
/// comes out at the top instead of the other side. It is out of sight for about half a second.
pub fn turn_while_hidden(seed: u64) -> Scene {
    let mut vary = variation(seed);
    let speed = 60.0 * vary.between(0.9, 1.1);
    let angle = vary.between(60.0, 90.0f64).to_radians();
    let standing = Object::new(46.0, 170.0, 1.0, Path::from(0.0, 384.0, 320.0).walk(0.0, 0.0, 6.0));
    // At the turn, at 3 s, its head shows 13 px above that of the standing target: a seventh of it.
    let (x, y) = (384.0 + 3.0, 235.0 - 13.0 + 45.0 + vary.between(-1.0, 1.0));
    let before = Path::from(0.0, x - 3.0 * speed, y).walk(speed, 0.0, 3.0);
    let path = before.walk(speed * libm::cos(angle), -speed * libm::sin(angle), 6.0);
    mirrored(Scene::new(seed, 6.0, vec![standing, Object::new(36.0, 90.0, 2.0, path)]))
}

/// Two walkers meet in the middle, one right behind the other, and both turn back: to motion alone they have passed
/// each other, only their looks tell.
pub fn meeting_and_turning_back(seed: u64) -> Scene {
    let mut vary = variation(seed);
    let (speed, y) = (WALK * vary.between(0.9, 1.1), 288.0 + vary.between(-40.0, 40.0));
    let height = vary.between(92.0, 106.0);
    let mut walker = |side: f64, depth: f64| {
        let start = 384.0 - side * (2.5 * speed + 3.0);
        let path = Path::from(0.0, start, y).walk(side * speed, 0.0, 2.5).walk(-side * speed, 0.0, 5.0);
        Object::new(0.4 * height, height * vary.between(0.99, 1.01), depth, path)
    };
    let (left, right) = (walker(1.0, 1.0), walker(-1.0, 2.0));
    mirrored(Scene::new(seed, 5.0, vec![left, right]))
}

/// A walker turns back while the detector misses it for two and a half seconds: by motion it would be far away, and its
/// track would have ended.
pub fn turning_back_unseen(seed: u64) -> Scene {
    let mut vary = variation(seed);
    let (speed, y) = (WALK * vary.between(0.9, 1.1), 288.0 + vary.between(-40.0, 40.0));
    let path = Path::from(0.0, 384.0 - 2.5 * speed, y).walk(speed, 0.0, 3.0).walk(-speed, 0.0, 6.0);
    let mut walker = Object::new(40.0, 100.0, 1.0, path);
    walker.missed = Some((1.8, 4.3));
    mirrored(Scene::new(seed, 6.0, vec![walker]))
}

/// Nine targets cross the image one after the other, in three lanes and both directions; each enters at an edge and
/// leaves at the other, and where one has left another comes in a second later.
pub fn entering_and_leaving(seed: u64) -> Scene {
    let mut vary = variation(seed);
    let mut objects = Vec::new();
    for lane in 0..3 {
        let y = 100.0 + 180.0 * lane as f64;
        let mut start = 0.7 * lane as f64;
        for nth in 0..3 {
            let speed = 200.0 * vary.between(0.9, 1.1);
            let end = start + (768.0 + 60.0) / speed;
            let rightwards = (lane + nth) % 2 == 0;
            let (x, vx) = if rightwards { (-30.0, speed) } else { (798.0, -speed) };
            let path = Path::from(start, x, y).walk(vx, vary.between(-3.0, 3.0), end);
            objects.push(Object::new(40.0, 100.0, objects.len() as f64, path));
            start = end + 1.0;
        }
    }
    // Then nothing for a while, so that all must end.
    Scene::new(seed, 20.0, objects)
}

/// Ten targets in five rows, two to a row, towards each other: each meets the one of its row, whom it hides, and is
/// partly hidden by those of the row in front.
pub fn ten_targets(seed: u64, miss: f64) -> Scene {
    let mut vary = variation(seed);
    let mut objects = Vec::new();
    for row in 0..5 {
        for rightwards in [true, false] {
            let height = 80.0 + 6.0 * row as f64 + vary.between(-3.0, 3.0);
            let y = 90.0 + 90.0 * row as f64 + vary.between(-8.0, 8.0);
            let speed = WALK * vary.between(0.9, 1.2);
            let x = vary.between(60.0, 200.0);
            let (x, vx) = if rightwards { (x, speed) } else { (768.0 - x, -speed) };
            let path = Path::from(0.0, x, y).walk(vx, vary.between(-3.0, 3.0), 6.0);
            objects.push(Object::new(0.4 * height, height, -y, path));
        }
    }
    let mut scene = Scene::new(seed, 6.0, objects);
    scene.detector = Detector { miss, ..scene.detector };
    scene
}

/// Six targets walk about, some crossing, while the camera moves.
pub fn moving_camera(seed: u64, camera: Camera) -> Scene {
    let mut vary = variation(seed);
    let mut objects = Vec::new();
    for row in 0..3 {
        for rightwards in [true, false] {
            let y = 150.0 + 130.0 * row as f64 + vary.between(-10.0, 10.0);
            let speed = 0.7 * WALK * vary.between(0.9, 1.1);
            let x = vary.between(200.0, 280.0);
            let (x, vx) = if rightwards { (x, speed) } else { (768.0 - x, -speed) };
            let path = Path::from(0.0, x, y).walk(vx, vary.between(-3.0, 3.0), 5.0);
            objects.push(Object::new(40.0, 100.0, -y, path));
        }
    }
    let mut scene = Scene::new(seed, 5.0, objects);
    scene.camera = camera;
    scene
}

/// A shaking camera: up to 25 px per frame of pan, 0.6 degrees of rotation and 0.5 % of zoom.
pub const SHAKE: Camera = Camera {
    pan_x: Swing::new(80.0, 1.5),
    pan_y: Swing::new(25.0, 2.1),
    rotation: Swing::new(0.04, 1.1),
    zoom: Swing::new(0.05, 0.5),
};

/// A slow pan: up to 2.5 px per frame.
pub const SLOW_PAN: Camera = Camera {
    pan_x: Swing::new(60.0, 0.2),
    pan_y: Swing::new(10.0, 0.15),
    rotation: Swing::new(0.01, 0.1),
    zoom: Swing::new(0.02, 0.1),
};
