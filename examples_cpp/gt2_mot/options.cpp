#include "options.hpp"

#include <string_view>

#include "shared_options.hpp"
#include "text.hpp"

namespace gt2_mot {

using examples::UserError;

namespace {

const char *const manual =
    R"(usage: gt2_mot --tracker NAME (--det FILE | --detector hog | --detector onnx:FILE) --out FILE [options]

Tracks the objects of a video or of a file of detections and writes MOTChallenge rows.

  --tracker NAME       @NAMES@
  --det FILE           detections: frame,id,left,top,width,height,score,... with frames from 1 and scores in 0..1
  --detector hog       find people with OpenCV's HOG detector
  --detector onnx:FILE find people with a YOLOX-style model
  --out FILE           tracks: frame,id,left,top,width,height,score,-1,-1,-1; "-" is stdout

  --video FILE         frames for detector, appearance and drawing
  --images DIR         the same from the image files of a directory, in the order of their names
  --gmc FILE           camera motion, a line per frame: frame, then 2x3 affine row-major, previous -> current
  --estimate-camera-motion
                       estimate it from the images' background, all that lies outside the detections, and print to
                       stderr for how many frames that failed
  --embeddings FILE    raw little-endian f32, one row per row of --det; needs --dim
  --dim N              numbers per embedding
  --min-score S        drop detections below S before the tracker sees them
  --max-height H       drop detections taller than H pixels, where nobody can be so near
  --normalise-scores   first squash the scores of --det, of any range, by 1 / (1 + exp(-score / s)), s being their
                       root mean square
  --size WxH           size of the frames in pixels, where there are none to look at
  --fps F              frames per second; by default that of --video, else the tracker's default
  --frames N           number of frames to step; by default all of --video or --images, else up to the last
                       frame of --det or --gmc
  --detect-every K     run the detector on frames 1, 1 + K, 1 + 2K, ... only; the tracker is told of the others that it
                       rested there, and rows of --det for them are left out
  --timestamp-rate F   give every frame its time, F frames per second; --fps stays the nominal rate
  --seed N             seed of the tracker's random numbers
  --config FILE        TOML file of parameters
  --set KEY=VALUE      a parameter; may be given again

  --annotate FILE      write an annotated video (.mp4, .avi): a green box was detected in that frame, a dashed red one
                       is predicted, a dotted one lost; without images it is drawn on a plain ground
  --sheet FILE         write a picture of six annotated frames
  --sheet-frames A,B,..  which six; by default they are spread over the run
  --particles          draw the tracker's particles
  --neighbours         draw the neighbours that guided each weak track, how they move and by which rule it followed them
  --focus ID,ID,..     draw these identities bold, and particles and neighbours of these alone
  --class-names FILE   names of the classes 0, 1, ..., one per line, to stand beside the identities: the eighth field
                       of --det is then the class
  --all-states         also write tentative and lost tracks
  --save-det FILE      write the detections that the tracker was given
  --time               print the time of the tracker alone to stderr
  --help               print this

Settings are applied in this order, later ones win: frame rate of the video, --config, --set, --seed, --fps.
)";

}  // namespace

std::string usage() {
    static constexpr std::string_view placeholder = "@NAMES@";
    std::string text = manual;
    return text.replace(text.find(placeholder), placeholder.size(), examples::tracker_names());
}

namespace {

void check_together(const Options &o) {
    if (o.tracker.empty()) throw UserError("--tracker is missing (--help lists the options)");
    check_inputs(o.input);
    if (o.out.empty()) throw UserError("--out is missing");
    const bool draws = !o.annotate.empty() || !o.sheet.empty();
    check_not_overwritten(o.input, {o.config}, {o.out, o.save_det, o.annotate, o.sheet});
    for (const auto &[layer, wanted] : {std::pair("--particles", o.drawing.particles),
                                        std::pair("--neighbours", o.drawing.neighbours),
                                        std::pair("--focus", !o.drawing.focus.empty())}) {
        if (wanted && !draws) throw UserError(std::string(layer) + " needs --annotate or --sheet");
    }
    if (!o.sheet_frames.empty() && o.sheet.empty()) throw UserError("--sheet-frames needs --sheet");
}

}  // namespace

Options parse_options(const std::vector<std::string> &arguments) {
    Options o;
    examples::ArgumentReader r(arguments);
    examples::OptionTable table = {
        {"--tracker", [&] { o.tracker = r.value(); }},
        {"--out", [&] { o.out = r.value(); }},
        {"--fps", [&] { o.fps = r.number(0, 1e6, "a number of frames per second"); }},
        {"--seed", [&] { o.seed = r.value(); }},
        {"--config", [&] { o.config = r.value(); }},
        {"--set", [&] { o.set.push_back(r.setting()); }},
        {"--annotate", [&] { o.annotate = r.value(); }},
        {"--sheet", [&] { o.sheet = r.value(); }},
        {"--sheet-frames", [&] { o.sheet_frames = r.frame_list(); }},
        {"--all-states", [&] { o.all_states = true; }},
        {"--save-det", [&] { o.save_det = r.value(); }},
        {"--time", [&] { o.time = true; }},
    };
    table.merge(examples::input_options(r, o.input));
    table.merge(examples::drawing_options(r, o.drawing, o.input));
    o.help = examples::read_arguments(r, table);
    if (!o.help) check_together(o);
    return o;
}

examples::TrackerSettings tracker_settings(const Options &o) {
    examples::TrackerSettings s{o.tracker, "--tracker", o.config, {}};
    for (const auto &[key, value] : o.set) s.settings.push_back({key, value, "--set " + key + "=" + value});
    if (o.seed) s.settings.push_back({"seed", *o.seed, "--seed"});
    if (o.fps) s.settings.push_back({"frame_rate", examples::text_of(*o.fps), "--fps"});
    return s;
}

}  // namespace gt2_mot
