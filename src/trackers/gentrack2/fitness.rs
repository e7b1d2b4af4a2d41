//! Fitness of a particle (eq. 4-6), each term in `[0, 1]`.

use super::parameters::GenTrack2Parameters;

/// Weights of history, exploration and social fitness, summing to 1 (eq. 4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    /// `sigma_h`.
    pub history: f64,
    /// `sigma_p`.
    pub exploration: f64,
    /// `sigma_i`.
    pub social: f64,
}

impl Weights {
    /// The configured weights divided by their sum.
    pub fn new(p: &GenTrack2Parameters) -> Self {
        let sum = p.sigma_h + p.sigma_p + p.sigma_i;
        Self { history: p.sigma_h / sum, exploration: p.sigma_p / sum, social: p.sigma_i / sum }
    }

    /// `f_PSO` (eq. 4).
    pub fn combine(&self, history: f64, exploration: f64, social: f64) -> f64 {
        self.history * history + self.exploration * exploration + self.social * social
    }
}

/// `f_m` of eq. 5 at a distance in pixels: 1 at none, 0 from `limit` on.
pub fn motion(distance: f64, limit: f64) -> f64 {
    // The limit of a box that a camera motion shrank to nothing is 0.
    if distance < limit { 1.0 - distance / limit } else { 0.0 }
}

/// `f` of eq. 5. Without appearance the motion term has all the weight.
pub fn similarity(lambda_s: f64, appearance: Option<f64>, motion: f64) -> f64 {
    match appearance {
        Some(appearance) => lambda_s * appearance + (1.0 - lambda_s) * motion,
        None => motion,
    }
}

/// `f_s` of eq. 5 from the cosine of two HOG vectors: cosines up to `offset` count as no similarity.
pub fn appearance(cosine: f64, offset: f64) -> f64 {
    ((cosine - offset) / (1.0 - offset)).clamp(0.0, 1.0)
}

/// What the social fitness of one target's particles needs to know.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Social {
    /// `xi_p`, the share of position.
    pub position_share: f64,
    /// `2 epsilon_nei` in pixels.
    pub position_limit: f64,
    /// `V_s^max` in pixels per tick.
    pub velocity_limit: f64,
}

impl Social {
    /// `f_PSO^i` (eq. 6): how far the particle keeps from its neighbours, in position and velocity, given the sums of its
    /// distances to them, each up to its limit; 1 without any.
    pub fn fitness(&self, position: f64, velocity: f64, neighbours: usize) -> f64 {
        if neighbours == 0 {
            return 1.0;
        }
        let mean = |sum: f64, limit: f64| if limit > 0.0 { sum / (neighbours as f64 * limit) } else { 1.0 };
        self.position_share * mean(position, self.position_limit)
            + (1.0 - self.position_share) * mean(velocity, self.velocity_limit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equation_4_weighs_the_three_terms() {
        // The defaults .5, .2, .3 of terms .8, .6, .4: .4 + .12 + .12 = .64.
        let weights = Weights::new(&GenTrack2Parameters::default());
        assert!((weights.combine(0.8, 0.6, 0.4) - 0.64).abs() < 1e-12);
        // Weights 1, 1, 0 become .5, .5, 0.
        let even = GenTrack2Parameters { sigma_h: 1.0, sigma_p: 1.0, sigma_i: 0.0, ..Default::default() };
        assert_eq!(Weights::new(&even).combine(0.8, 0.6, 0.1), 0.7);
    }

    #[test]
    fn equation_5_motion_falls_to_zero_at_the_limit() {
        // 5 px of 50: 1 - .1.
        assert!((motion(5.0, 50.0) - 0.9).abs() < 1e-12);
        assert_eq!(motion(80.0, 50.0), 0.0);
        assert_eq!(motion(0.0, 50.0), 1.0);
        assert_eq!(motion(0.0, 0.0), 0.0);
    }

    #[test]
    fn equation_5_without_appearance_is_motion_alone() {
        // .8 * .5 + .2 * .9 = .58.
        assert!((similarity(0.8, Some(0.5), 0.9) - 0.58).abs() < 1e-12);
        assert_eq!(similarity(0.8, None, 0.9), 0.9);
    }

    #[test]
    fn cosines_are_rescaled_above_the_offset() {
        // (.725 - .45) / .55 = .5.
        assert!((appearance(0.725, 0.45) - 0.5).abs() < 1e-12);
        assert_eq!(appearance(0.3, 0.45), 0.0);
        assert_eq!(appearance(0.3, 0.0), 0.3);
        assert_eq!(appearance(1.0 + 1e-7, 0.45), 1.0);
    }

    #[test]
    fn equation_6_is_one_without_neighbours_and_grows_with_distance() {
        let social = Social { position_share: 0.5, position_limit: 100.0, velocity_limit: 10.0 };
        assert_eq!(social.fitness(0.0, 0.0, 0), 1.0);
        // Neighbour A 50 px away, velocity difference 4; neighbour B 300 px away (counts 100), difference 0:
        // position .5 * (50 + 100) / 200 = .375, velocity .5 * (4 + 0) / 20 = .1.
        assert!((social.fitness(150.0, 4.0, 2) - 0.475).abs() < 1e-12);
    }
}
