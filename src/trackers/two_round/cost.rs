//! What a pair costs: IoU, score and looks.

use crate::frame::Detection;
use crate::kalman::BoxFilter;

use super::Rules;
use super::member::Member;

/// What embeddings are used for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Looks {
    /// Nothing.
    Unused,
    /// BoT-SORT: a pair that looks alike is as cheap as it looks alike, in rounds 1 and 3.
    Attract {
        /// Largest IoU distance of a pair whose looks count.
        proximity: f64,
        /// Largest halved cosine distance that counts.
        threshold: f64,
    },
    /// SMILEtrack: a pair that does not look alike is refused, in round 1.
    Veto {
        /// Largest weighted sum of cosine and Mahalanobis distance.
        limit: f64,
        /// Weight of the cosine distance; the squared Mahalanobis distance has the rest.
        weight: f64,
        /// Largest squared Mahalanobis distance.
        gate: f64,
    },
}

impl Rules {
    /// Cost of a pair in round 1; at least 1 for one that is refused.
    pub fn first_cost<F: BoxFilter>(
        &self,
        member: &Member<F>,
        detection: &Detection,
        embedding: Option<&[f64]>,
        iou: f64,
    ) -> f64 {
        let distance = embedding.and_then(|seen| member.embedding.distance(seen));
        match (self.looks, distance) {
            (Looks::Attract { proximity, threshold }, Some(distance)) => {
                self.attracted(self.fused(detection, iou), iou, distance, proximity, threshold)
            }
            (Looks::Veto { limit, weight, gate }, Some(distance)) => {
                let far = member.filter.gating_distance(&detection.rect);
                let alike = far <= gate && weight * distance + (1.0 - weight) * far <= limit;
                if alike { 1.0 - iou } else { 1.0 }
            }
            _ => self.fused(detection, iou),
        }
    }

    /// Cost of a pair in round 3.
    pub fn third_cost<F: BoxFilter>(
        &self,
        member: &Member<F>,
        detection: &Detection,
        embedding: Option<&[f64]>,
        iou: f64,
    ) -> f64 {
        match self.looks {
            Looks::Attract { .. } => self.first_cost(member, detection, embedding, iou),
            Looks::Unused | Looks::Veto { .. } => self.fused(detection, iou),
        }
    }

    fn fused(&self, detection: &Detection, iou: f64) -> f64 {
        if self.fuse_score { 1.0 - iou * detection.score } else { 1.0 - iou }
    }

    fn attracted(&self, motion: f64, iou: f64, distance: f64, proximity: f64, threshold: f64) -> f64 {
        let halved = 0.5 * distance;
        if halved > threshold || 1.0 - iou > proximity { motion.min(1.0) } else { motion.min(halved) }
    }
}
