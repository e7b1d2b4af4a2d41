//! No parameter is dead: each, set to another value, changes what the tracker makes of at least one of a few scenes. A
//! step that no longer happens, or that no longer listens to its parameter, shows here.

mod simulator;

use gentrack2::parameters::{Kind, ParameterSpec, Value};
use gentrack2::{Config, Embeddings, Frame, ImageView, PixelFormat, Tracker};
use simulator::contract::all_tracks;
use simulator::scene::{Observation, Scene};
use simulator::stage;

/// A scene with what the tracker is given of it, and the settings under which a parameter may matter.
struct Setup {
    scene: Scene,
    seen: Vec<Observation>,
    image: bool,
    embeddings: bool,
    settings: &'static [(&'static str, &'static str)],
}

impl Setup {
    fn new(scene: Scene, image: bool, embeddings: bool, settings: &'static [(&'static str, &'static str)]) -> Self {
        let seen = scene.play(image).collect();
        Self { scene, seen, image, embeddings, settings }
    }

    /// Everything that comes out, particles included; `None` if the settings do not go together.
    fn outcome(&self, key: &str, value: Option<&Value>) -> Option<Vec<String>> {
        let mut config = Config::new("gentrack2").unwrap();
        for (key, text) in self.settings {
            config.set_text(key, text).unwrap();
        }
        if let Some(value) = value {
            config.set(key, value).unwrap();
        }
        let mut tracker = Tracker::new(&config).ok()?;
        Some(self.seen.iter().map(|seen| self.step(&mut tracker, seen)).collect())
    }

    fn step(&self, tracker: &mut Tracker, seen: &Observation) -> String {
        // Each object has its own direction, clutter has one of its own, too.
        let looks: Vec<f32> = seen
            .source
            .iter()
            .flat_map(|source| (0..4).map(move |k| if source.map_or(3, |s| s % 3) == k { 1.0 } else { 0.2 }))
            .collect();
        let (width, height) = (self.scene.width, self.scene.height);
        let image = seen.image.as_ref().filter(|_| self.image);
        let result = tracker.step(&Frame {
            detections: &seen.detections,
            image: image.map(|d| ImageView::new(d, width, height, 0, PixelFormat::Gray8).unwrap()),
            size: Some((width, height)),
            embeddings: self.embeddings.then(|| Embeddings::new(&looks, 4)),
            timestamp_ns: Some((seen.time * 1e9) as i64),
            ..Frame::default()
        });
        match result.cloned() {
            Ok(output) => {
                let particles: Vec<_> = all_tracks(&output).map(|t| tracker.particles(t.id).unwrap()).collect();
                format!("{output:?} {particles:?}")
            }
            Err(error) => error.to_string(),
        }
    }
}

fn setups() -> Vec<Setup> {
    let crowd = || Scene { duration: 3.5, ..stage::ten_targets(3, 0.3) };
    let hidden = || stage::full_occlusion(0, 1.0);
    let pan = Scene { duration: 4.0, ..stage::moving_camera(0, stage::SLOW_PAN) };
    vec![
        Setup::new(crowd(), false, false, &[]),
        Setup::new(crowd(), true, false, &[]),
        Setup::new(pan, false, false, &[]),
        Setup::new(stage::meeting_and_turning_back(0), false, true, &[]),
        Setup::new(stage::turn_while_hidden(2), false, false, &[]),
        Setup::new(Scene { duration: 9.0, ..stage::entering_and_leaving(1) }, false, false, &[]),
        Setup::new(crowd(), true, false, &[("preset", "paper")]),
        Setup::new(crowd(), false, false, &[("resampling", "discard"), ("particle_source", "prior_particles")]),
        Setup::new(crowd(), false, false, &[("strong_update", "replace"), ("jump_distance", "0.05")]),
        // Somebody is lost for more than a second.
        Setup::new(hidden(), false, false, &[("entrance_areas", "0,0,768,576"), ("fitness_floor", "0")]),
        Setup::new(hidden(), true, false, &[("preset", "paper")]),
    ]
}

/// Other values than the default, those that change the most first.
fn alternatives(spec: &ParameterSpec) -> Vec<Value> {
    match (&spec.kind, &spec.default) {
        (Kind::Float, Value::Float(default)) => {
            [spec.minimum, spec.maximum, 0.5 * default, 2.0 * default].map(Value::Float).to_vec()
        }
        (Kind::Integer, Value::Integer(default)) => vec![
            Value::Integer(spec.minimum as i64),
            Value::Integer(default - 1),
            Value::Integer(default + 1),
            Value::Integer(spec.minimum as i64 + 1),
        ],
        (Kind::Boolean, Value::Boolean(default)) => vec![Value::Boolean(!default)],
        (Kind::Choice(names), Value::Choice(default)) => {
            names.iter().filter(|name| *name != default).map(|name| Value::Choice(name)).collect()
        }
        (Kind::Areas, _) => vec![spec.parse("0,0,384,576").unwrap()],
        other => panic!("{other:?}"),
    }
}

#[test]
fn every_parameter_changes_something() {
    let setups = setups();
    let before: Vec<_> = setups.iter().map(|s| s.outcome("", None).expect("the settings go together")).collect();
    let mut dead = Vec::new();
    for spec in Config::new("gentrack2").unwrap().specs() {
        let in_range = |value: &Value| *value != spec.default && spec.check(value).is_ok();
        let values: Vec<Value> = alternatives(spec).into_iter().filter(in_range).collect();
        let matters = |(setup, before): (&Setup, &Vec<String>)| {
            values.iter().any(|value| setup.outcome(spec.key, Some(value)).is_some_and(|after| after != *before))
        };
        if !setups.iter().zip(&before).any(matters) {
            dead.push(spec.key);
        }
    }
    assert_eq!(dead, [""; 0], "parameters that change nothing");
}
