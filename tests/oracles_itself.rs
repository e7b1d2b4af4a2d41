//! The comparison with the oracles itself: what agrees passes, every kind of difference is noticed, and the inputs are
//! read as they were fed to the references.

mod oracles;

use gentrack2::{CameraMotion, Detection, Rect};
use oracles::compare::{Difference, Report};
use oracles::golden::{self, Row, Rows};
use oracles::sequence::{DIMENSION, Input, SYNTHETIC_LENGTH};
use oracles::{place, variants};

const FRAMES: usize = 20;

fn row(id: u64, left: f64) -> Row {
    Row { id, rect: Rect::new(left, 20.0, 40.0, 100.0) }
}

/// Three objects that walk apart, the third from the sixth frame on.
fn three() -> Rows {
    let at = |t: usize, id: u64| row(id, id as f64 * 200.0 + t as f64);
    (0..FRAMES).map(|t| (1..=3).filter(|id| *id < 3 || t >= 5).map(|id| at(t, id)).collect()).collect()
}

const THREE: usize = 2 * FRAMES + FRAMES - 5;

/// Other identities, and the rows of a frame in another order.
fn renamed(rows: &Rows) -> Rows {
    let rename = |row: &Row| Row { id: 1_000_000 - 7 * row.id, ..*row };
    rows.iter().map(|frame| frame.iter().rev().map(rename).collect()).collect()
}

/// The report on what became of a renamed copy.
fn after(change: impl FnOnce(&mut Rows)) -> Report {
    let mut ours = renamed(&three());
    change(&mut ours);
    let report = Report::new(&three(), &ours);
    assert_eq!(report.right + report.wrong + report.missing, report.golden);
    assert_eq!(report.right + report.wrong + report.surplus, ours.iter().map(Vec::len).sum::<usize>());
    report
}

/// Right, wrong, missing and surplus rows.
fn counts(report: &Report) -> (usize, usize, usize, usize) {
    assert!(!report.is_exact());
    (report.right, report.wrong, report.missing, report.surplus)
}

fn of(frame: &mut [Row], golden_id: u64) -> &mut Row {
    frame.iter_mut().find(|row| row.id == 1_000_000 - 7 * golden_id).expect("the object is there")
}

#[test]
fn a_renamed_and_reordered_copy_is_exact() {
    let report = after(|_| {});
    assert!(report.is_exact(), "{report}");
    assert_eq!((report.golden, report.differences.len()), (THREE, 0));
}

#[test]
fn every_oracle_reproduces_itself_under_other_names() {
    for variant in variants::all() {
        for name in variant.synthetic {
            let path = place::fixtures().join(variant.folder).join(format!("{name}.csv"));
            let golden = golden::read(&path, SYNTHETIC_LENGTH).unwrap();
            let report = Report::new(&golden, &renamed(&golden));
            assert!(report.is_exact() && report.golden > 100, "{}/{name}: {report}", variant.folder);
        }
    }
}

#[test]
fn nothing_is_not_exact() {
    assert!(!Report::new(&vec![Vec::new(); 3], &vec![Vec::new(); 3]).is_exact());
    assert_eq!(counts(&after(|ours| ours.clear())), (0, 0, THREE, 0));
}

#[test]
fn a_box_may_be_off_by_the_tolerance_and_no_more() {
    let sides: [fn(&mut Rect) -> &mut f64; 4] = [|r| &mut r.left, |r| &mut r.top, |r| &mut r.width, |r| &mut r.height];
    for side in sides {
        // Frame 1 is where the identity is met first, frame 10 where it is known.
        for frame in [0, 9] {
            for sign in [-1.0, 1.0] {
                assert!(after(|ours| *side(&mut of(&mut ours[frame], 2).rect) += sign * 0.0009).is_exact());
                let report = after(|ours| *side(&mut of(&mut ours[frame], 2).rect) += sign * 0.002);
                assert_eq!(counts(&report), (THREE - 1, 1, 0, 0));
            }
            assert_eq!(counts(&after(|ours| *side(&mut of(&mut ours[frame], 2).rect) = f64::NAN)).0, THREE - 1);
        }
    }
}

#[test]
fn an_identity_switched_in_the_middle_is_wrong_from_there_on() {
    let report = after(|ours| ours[12..].iter_mut().for_each(|frame| of(frame, 1).id = 77));
    assert_eq!(counts(&report), (THREE - 8, 8, 0, 0));
    let golden = three()[12][0];
    let expected = Difference {
        frame: 13,
        golden: Some(golden),
        ours: Some(Row { id: 77, ..golden }),
        renamed: Some(1_000_000 - 7),
    };
    assert_eq!(report.differences[0], expected);
}

#[test]
fn two_identities_that_swap_are_wrong_from_there_on() {
    let report = after(|ours| {
        for frame in &mut ours[12..] {
            let (first, second) = (of(frame, 1).id, of(frame, 2).id);
            // One after the other, or both would be the same.
            of(frame, 1).id = 0;
            of(frame, 2).id = first;
            frame.iter_mut().find(|row| row.id == 0).unwrap().id = second;
        }
    });
    assert_eq!(counts(&report), (THREE - 16, 16, 0, 0));
}

#[test]
fn an_identity_used_for_two_is_wrong_for_the_second() {
    // The first object ends where the third begins, so no frame has the identity twice.
    let mut golden = three();
    golden[5..].iter_mut().for_each(|frame| frame.retain(|row| row.id != 1));
    let mut ours = golden.clone();
    ours[5..].iter_mut().flatten().filter(|row| row.id == 3).for_each(|row| row.id = 1);
    let report = Report::new(&golden, &ours);
    assert_eq!(counts(&report), (golden.iter().map(Vec::len).sum::<usize>() - 15, 15, 0, 0));
    // Nor may two identities be used for one.
    assert_eq!(counts(&Report::new(&ours, &golden)).1, 15);
}

#[test]
fn an_identity_twice_in_a_frame_is_wrong_once() {
    assert_eq!(counts(&after(|ours| ours[9][0].id = ours[9][1].id)), (THREE - 1, 1, 0, 0));
    let report = after(|ours| {
        let copy = ours[9][0];
        ours[9].push(copy);
    });
    assert_eq!(counts(&report), (THREE, 0, 0, 1));
}

#[test]
fn a_missing_row_is_noticed() {
    for frame in [0, 9, FRAMES - 1] {
        let report = after(|ours| ours[frame] = ours[frame][1..].to_vec());
        assert_eq!(counts(&report), (THREE - 1, 0, 1, 0));
        assert_eq!((report.differences[0].frame, report.differences[0].ours), (frame + 1, None));
    }
}

#[test]
fn a_surplus_row_is_noticed() {
    for frame in [0, 9, FRAMES - 1] {
        let report = after(|ours| ours[frame].push(row(77, 1500.0)));
        assert_eq!(counts(&report), (THREE, 0, 0, 1));
        assert_eq!((report.differences[0].frame, report.differences[0].golden), (frame + 1, None));
    }
    // Also beyond the last frame.
    assert_eq!(counts(&after(|ours| ours.push(vec![row(77, 1500.0)]))), (THREE, 0, 0, 1));
}

#[test]
fn a_row_in_the_wrong_frame_is_noticed() {
    // The third object's first row, a frame too early.
    let report = after(|ours| {
        let moved = *of(&mut ours[5], 3);
        ours[5].retain(|row| row.id != moved.id);
        ours[4].push(moved);
    });
    assert_eq!(counts(&report), (THREE - 1, 0, 1, 1));
    assert_eq!(counts(&after(|ours| ours.insert(0, Vec::new()))).0, 0);
}

#[test]
fn of_two_newcomers_with_one_box_each_gets_its_own_name() {
    let rows = |ids: [u64; 2]| -> Rows {
        (0..FRAMES).map(|t| vec![row(ids[0], 100.0 + t as f64), row(ids[1], 100.0 - t as f64)]).collect()
    };
    for ours in [rows([5, 6]), rows([6, 5]), renamed(&rows([5, 6]))] {
        let report = Report::new(&rows([1, 2]), &ours);
        assert!(report.is_exact(), "{report}");
    }
}

#[test]
fn a_report_says_what_is_wrong() {
    let report = after(|ours| {
        of(&mut ours[9], 2).rect.left += 0.5;
        ours[9].push(row(77, 1500.0));
    });
    assert_eq!(report.to_string(), "98.18 %: 54 of 55 rows right, 1 wrong, 0 missing, 1 surplus");
    let lines: Vec<String> = report.differences.iter().map(|d| d.to_string()).collect();
    assert_eq!(
        lines,
        [
            "frame 10: golden 2 (409.0000 20.0000 40.0000 100.0000), ours 999986 (409.5000 20.0000 40.0000 100.0000); \
             2 has been 999986",
            "frame 10: golden nothing, ours 77 (1500.0000 20.0000 40.0000 100.0000)",
        ]
    );
}

#[test]
fn one_row_of_many_does_not_round_to_all() {
    let golden: Rows = vec![(0..100_000).map(|id| row(id, id as f64)).collect()];
    let report = Report { golden: golden[0].len(), right: golden[0].len() - 1, missing: 1, ..Report::default() };
    assert!(report.to_string().starts_with("99.99 %"), "{report}");
}

#[test]
fn a_broken_oracle_is_refused() {
    let header = "frame,id,left,top,width,height\n";
    assert_eq!(
        golden::parse(&format!("{header}2,7,1,2.5,3,4\n"), 2).unwrap()[1][0].rect,
        Rect::new(1.0, 2.5, 3.0, 4.0)
    );
    for bad in ["2,7,1,2.5,3,4\n", &format!("{header}3,7,1,2,3,4"), &format!("{header}0,7,1,2,3,4")] {
        assert!(golden::parse(bad, 2).is_err(), "{bad}");
    }
    for bad in ["1,7,1,2,3", "1,7,1,2,3,4,5", "1,7,1,2,x,4", "1,-1,1,2,3,4", ""] {
        assert!(golden::parse(&format!("{header}{bad}\n"), 2).is_err(), "{bad}");
    }
}

#[test]
fn an_unknown_tracker_or_setting_is_no_success() {
    let sort = variants::named("sort");
    let unknown = variants::Variant { tracker: "no_such_tracker", ..sort.clone() };
    let error = place::reproduce_synthetic(&unknown, "syn_a4").unwrap_err();
    assert!(error.contains("no_such_tracker"), "{error}");
    let other = variants::Variant { tracker: "gentrack2", ..sort };
    let error = place::reproduce_synthetic(&other.with("no_such_key", "1"), "syn_a4").unwrap_err();
    assert!(error.contains("no_such_key"), "{error}");
}

#[test]
fn another_tracker_does_not_pass_for_any() {
    for variant in variants::all() {
        let other = variants::Variant { tracker: "gentrack2", settings: Vec::new(), ..variant };
        let report = place::reproduce_synthetic(&other, other.synthetic[0]).unwrap();
        assert!(report.right < report.golden, "{}: {report}", other.folder);
    }
}

#[test]
fn every_tracker_has_a_mistake_that_must_be_noticed() {
    let mistakes = variants::mistakes();
    for variant in variants::all() {
        assert!(mistakes.iter().any(|m| m.wrong.tracker == variant.tracker), "{}", variant.tracker);
    }
    for mistake in &mistakes {
        assert!(mistake.wrong.synthetic.contains(&mistake.sequence), "{}", mistake.name);
    }
}

#[test]
fn inputs_are_read_as_they_lie_in_the_files() {
    let a1 = place::synthetic("syn_a1").unwrap();
    assert_eq!(a1.frames.len(), SYNTHETIC_LENGTH);
    assert_eq!(a1.frames[0].detections[0], Detection::new(935.56, 463.98, 58.40, 128.29, 0.98));
    assert!(a1.frames.iter().any(|f| f.detections.is_empty()), "also frames without detections are stepped");
    assert!(a1.frames.iter().all(|f| f.camera_motion.is_none()));
    for name in ["syn_a1", "syn_a2", "syn_a3", "syn_a4", "syn_b1", "syn_b2", "syn_b3"] {
        for frame in &place::synthetic(name).unwrap().frames {
            assert_eq!(frame.embeddings.len(), frame.detections.len() * DIMENSION);
            for embedding in frame.embeddings.chunks_exact(DIMENSION) {
                let norm = embedding.iter().map(|x| x * x).sum::<f32>().sqrt();
                assert!((norm - 1.0).abs() < 1e-3, "{name}: {norm}");
            }
        }
    }
    // The first line is the first frame's, which nothing precedes.
    let b2 = place::synthetic("syn_b2").unwrap();
    assert_eq!(b2.frames[0].camera_motion, Some(CameraMotion::IDENTITY));
    let second = CameraMotion([1.000226, -0.000084, 2.077557, 0.000084, 1.000226, 0.176775]);
    assert_eq!(b2.frames[1].camera_motion, Some(second));
}

#[test]
fn a_score_at_the_limit_is_fed_and_embeddings_stay_with_their_detections() {
    let scores = [0.59, 0.6, 0.1, 0.61];
    let input = Input {
        detections: scores.iter().map(|s| Detection::new(1.0, 2.0, 3.0, 4.0, *s)).collect(),
        embeddings: scores.iter().flat_map(|s| [*s as f32; DIMENSION]).collect(),
        camera_motion: Some(CameraMotion::IDENTITY),
    };
    let kept = input.scored_from(0.6);
    assert_eq!(kept.detections.iter().map(|d| d.score).collect::<Vec<_>>(), [0.6, 0.61]);
    assert_eq!(kept.embeddings, [[0.6; DIMENSION], [0.61; DIMENSION]].concat());
    assert_eq!(kept.camera_motion, input.camera_motion);
    assert_eq!(input.scored_from(0.1), input);
}
