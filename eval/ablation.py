#!/usr/bin/env python3
"""What each component of GenTrack2 is worth: rows with one of them left out, on set-ups H, P, Ws, Wf and I.

Takes the options of evaluate.py, but --entries.
"""
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))

# Name of the row, and the settings that leave the component out.
WITHOUT = [
    # The paper's components.
    ("particles", "particles=1,pso_iterations=0"),
    ("swarm", "pso_iterations=0"),
    ("social-fitness", "sigma_i=0"),
    ("hog", "hog_cost=0,lambda_s=0"),
    ("hog-in-the-cost", "hog_cost=0"),
    ("hog-in-the-swarm", "lambda_s=0"),
    ("confidence-cost", "lambda_d=0"),
    ("penalty-cost", "lambda_h=0"),
    ("velocity-regression", "history=2,regression_window=1"),
    ("neighbours", "weak_motion=own"),
    ("camera-motion", "use_camera_motion=false,common_motion=false"),
    # What goes beyond it.
    ("blend", "strong_update=replace"),
    ("blend-adaptation", "blend_adaptation=0"),
    ("foot-and-height", "lambda_foot=0,height_overlap=false"),
    ("adaptive-distance-scale", "distance_scale_max=0.38"),
    ("soft-motion-cost", "soft_least=1"),
    ("crowd-cost", "crowd_cost=0"),
    ("lost-cost", "lost_cost=0"),
    ("score-gates", "low_score_gate=1,doubt_score=0"),
    ("birth-suppression", "birth_iou=1"),
    ("late-gate", "late_gate=0"),
    ("confirmation", "confirm_hits=1,confirm_evidence=0"),
    ("evidence", "confirm_evidence=0"),
    ("reacquisition", "reacquire_reach=0"),
    ("returns", "reacquire_returns=0,lost_cost_returns=0"),
    ("velocity-doubt", "velocity_doubt=0"),
    ("covered-pace", "covered_pace=1"),
    ("life-outside", "outside_pace=1000"),
    ("coasting", "coast=0"),
    ("doubt-at-the-border", "border_birth_factor=1,border_report_share=0"),
    ("predicted-reference", "history_reference=previous"),
]


def main():
    entries = ["gentrack2", "paper", *(f"no-{name}=gentrack2:{settings}" for name, settings in WITHOUT)]
    program = os.path.join(HERE, "evaluate.py")
    options = ["--setups", "H,P,Ws,Wf,I", *sys.argv[1:], "--entries", ",".join(entries)]
    os.execv(sys.executable, [sys.executable, program, *options])


if __name__ == "__main__":
    main()
