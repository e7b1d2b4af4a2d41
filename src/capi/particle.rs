//! Particles on their way out.

use std::mem::offset_of;

use super::structs::SizedStruct;
use crate::track::Particle;

/// One particle of a track: a hypothesis of its box.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gt2_particle {
    /// Left edge in pixels.
    pub left: f64,
    /// Top edge in pixels.
    pub top: f64,
    /// Width in pixels.
    pub width: f64,
    /// Height in pixels.
    pub height: f64,
    /// Velocity of the centre to the right, in pixels per second.
    pub velocity_u: f64,
    /// Velocity of the centre downwards, in pixels per second.
    pub velocity_v: f64,
    /// Growth of the width, in pixels per second.
    pub velocity_w: f64,
    /// Growth of the height, in pixels per second.
    pub velocity_h: f64,
    /// Fitness after optimisation, in 0..=1.
    pub fitness: f64,
}

// A tracker's particles are handed out where they lie, so the two types must have the same layout.
const _: () = {
    assert!(size_of::<gt2_particle>() == size_of::<Particle>());
    assert!(align_of::<gt2_particle>() == align_of::<Particle>());
    assert!(offset_of!(gt2_particle, left) == offset_of!(Particle, rect.left));
    assert!(offset_of!(gt2_particle, top) == offset_of!(Particle, rect.top));
    assert!(offset_of!(gt2_particle, width) == offset_of!(Particle, rect.width));
    assert!(offset_of!(gt2_particle, height) == offset_of!(Particle, rect.height));
    assert!(offset_of!(gt2_particle, velocity_u) == offset_of!(Particle, velocity.u));
    assert!(offset_of!(gt2_particle, velocity_v) == offset_of!(Particle, velocity.v));
    assert!(offset_of!(gt2_particle, velocity_w) == offset_of!(Particle, velocity.w));
    assert!(offset_of!(gt2_particle, velocity_h) == offset_of!(Particle, velocity.h));
    assert!(offset_of!(gt2_particle, fitness) == offset_of!(Particle, fitness));
};

/// A list of particles that belongs to the tracker. Start from `GT2_PARTICLE_LIST_INIT` and go through it with
/// `gt2_particle_at`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gt2_particle_list {
    /// `sizeof(gt2_particle_list)`, set by the caller; 0 stands for the first published layout of this struct.
    pub struct_size: usize,
    /// The particles; NULL if there are none.
    pub particles: *const gt2_particle,
    /// How many there are.
    pub count: usize,
    /// Bytes from one particle to the next.
    pub stride: usize,
}

// SAFETY: repr(C), size first, raw pointers and integers only.
unsafe impl SizedStruct for gt2_particle_list {
    const NAME: &'static str = "out";
    const FIRST_SIZE: usize = size_of::<gt2_particle_list>();
}
