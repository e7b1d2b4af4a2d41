#!/usr/bin/env python3
"""Tracks from Python through ctypes, with nothing to build: python3 track.py [path of libgentrack2.so.0]"""
import ctypes as c
import sys


def struct(**fields):  # as in gentrack2.h
    return type("Struct", (c.Structure,), {"_fields_": list(fields.items())})


d, i32, u32, i64, u64, size, pointer = c.c_double, c.c_int32, c.c_uint32, c.c_int64, c.c_uint64, c.c_size_t, c.c_void_p
Detection = struct(left=d, top=d, width=d, height=d, score=d, class_id=i32, reserved=i32, tag=u64)
Frame = struct(struct_size=size, detections=pointer, detection_count=size, detection_stride=size, embeddings=pointer,
               embedding_dimension=size, embedding_stride=size, image=pointer, camera_motion=pointer, image_width=u32,
               image_height=u32, timestamp_ns=i64, has_timestamp=i32, detector_skipped=i32)
Track = struct(id=u64, left=d, top=d, width=d, height=d, velocity_u=d, velocity_v=d, velocity_w=d, velocity_h=d, score=d,
               detection_index=i64, tag=u64, class_id=i32, state=i32, age=u32, hits=u32, frames_since_match=u32, reserved=u32)
TrackList = struct(struct_size=size, tracks=pointer, count=size, stride=size)

lib = c.CDLL(sys.argv[1] if len(sys.argv) > 1 else "libgentrack2.so.0")
lib.gt2_last_error_message.restype = lib.gt2_version.restype = c.c_char_p


def call(function, *arguments):
    if getattr(lib, function)(*arguments) != 0:
        raise RuntimeError(lib.gt2_last_error_message().decode())


config, tracker = pointer(), pointer()
call("gt2_config_new", b"gentrack2", c.byref(config))
call("gt2_config_set", config, b"frame_rate", b"25")
call("gt2_tracker_new", config, c.byref(tracker))
for t in range(40):
    boxes = (Detection * 2)((20 + 4 * t, 60, 40, 100, 0.9, 1), (300 - 4 * t, 80, 40, 100, 0.8, 1))  # your detector's
    frame = Frame(struct_size=c.sizeof(Frame), detections=c.addressof(boxes), detection_count=2)
    call("gt2_tracker_step", tracker, c.byref(frame))
    tracks = TrackList(struct_size=c.sizeof(TrackList))
    call("gt2_tracker_tracks", tracker, 0, c.byref(tracks))  # GT2_TRACKS_REPORTED
    for i in range(tracks.count):
        track = Track.from_address(tracks.tracks + i * tracks.stride)
        print(f"frame {t}: track {track.id} at {track.left:.1f} {track.top:.1f}, detection {track.detection_index}")
lib.gt2_tracker_free(tracker)
lib.gt2_config_free(config)
