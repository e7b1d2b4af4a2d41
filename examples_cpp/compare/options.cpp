#include "options.hpp"

#include <string_view>

#include "shared_options.hpp"
#include "text.hpp"

namespace compare {
namespace {

using examples::UserError;

const char *const manual =
    R"(usage: compare --left NAME --right NAME (--det FILE | --detector hog | --detector onnx:FILE) --out FILE [options]

Shows two trackers side by side on the same frames and the same detections, with the number of tracks in the frame and
of identities so far, and prints a line about each. With --truth identity switches are marked and counted.

  --left NAME, --right NAME
                       @NAMES@
                       (the same one twice is fine, with other settings)
  --video FILE         frames; without any it is drawn on a plain ground
  --images DIR         the same from the image files of a directory, in the order of their names
  --truth FILE         the true boxes: frame,id,left,top,width,height,flag,class,visibility, of which the last three
                       may be missing; an object whose track changes gets a frame for a second, with both
                       identities, and is counted as CLEAR MOT does, at an IoU of 0.5
  --det FILE           detections: frame,id,left,top,width,height,score,... with frames from 1 and scores in 0..1
  --detector hog       find people with OpenCV's HOG detector
  --detector onnx:FILE find people with a YOLOX-style model
  --out FILE           the video to write (.mp4, .avi)

  --left-set KEY=VALUE, --right-set KEY=VALUE
                       a parameter of that tracker, such as preset=paper; may be given again
  --left-config FILE, --right-config FILE
                       TOML file of parameters; the settings are applied after it
  --gmc FILE           camera motion, a line per frame: frame, then 2x3 affine row-major, previous -> current
  --embeddings FILE    raw little-endian f32, one row per row of --det; needs --dim
  --dim N              numbers per embedding
  --estimate-camera-motion
                       estimate the camera's motion from the images' background, all that lies outside the detections,
                       for both trackers, and print to stderr for how many frames that failed
  --min-score S        drop detections below S before the trackers see them
  --max-height H       drop detections taller than H pixels, where nobody can be so near
  --normalise-scores   first squash the scores of --det, of any range, by 1 / (1 + exp(-score / s)), s being their
                       root mean square
  --fps F              frames per second; by default that of --video, else the trackers' default
  --size WxH           size of the frames in pixels, where there are none to look at
  --frames N           number of frames; by default all
  --detect-every K     run the detector on frames 1, 1 + K, 1 + 2K, ... only
  --timestamp-rate F   give every frame its time, F frames per second
  --particles          draw the trackers' particles
  --neighbours         draw the neighbours that guided each weak track
  --focus ID,ID,..     draw these identities bold, and particles and neighbours of these alone
  --class-names FILE   names of the classes 0, 1, ..., one per line: the eighth field of --det is then the class
  --sheet FILE         write a picture of six of the frames
  --sheet-frames A,B,..  which six; by default they are spread over the run
  --help               print this
)";

void check_together(const Options &o) {
    for (const examples::TrackerSettings &tracker : o.trackers) {
        if (tracker.name.empty()) throw UserError(tracker.option + " is missing (--help lists the options)");
    }
    check_inputs(o.input);
    if (o.out.empty()) throw UserError("--out is missing");
    check_not_overwritten(o.input, {o.trackers[0].config, o.trackers[1].config, o.truth}, {o.out, o.sheet});
    if (!o.sheet_frames.empty() && o.sheet.empty()) throw UserError("--sheet-frames needs --sheet");
}

}  // namespace

std::string usage() {
    static constexpr std::string_view placeholder = "@NAMES@";
    std::string text = manual;
    return text.replace(text.find(placeholder), placeholder.size(), examples::tracker_names());
}

Options parse_options(const std::vector<std::string> &arguments) {
    Options o;
    examples::ArgumentReader r(arguments);
    examples::OptionTable table = {
        {"--out", [&] { o.out = r.value(); }},
        {"--truth", [&] { o.truth = r.value(); }},
        {"--fps", [&] { o.fps = r.number(0, 1e6, "a number of frames per second"); }},
        {"--sheet", [&] { o.sheet = r.value(); }},
        {"--sheet-frames", [&] { o.sheet_frames = r.frame_list(); }},
    };
    table.merge(examples::input_options(r, o.input));
    table.merge(examples::drawing_options(r, o.drawing, o.input));
    for (examples::TrackerSettings &tracker : o.trackers) {
        tracker.option = &tracker == &o.trackers[0] ? "--left" : "--right";
        table[tracker.option] = [&] { tracker.name = r.value(); };
        table[tracker.option + "-config"] = [&] { tracker.config = r.value(); };
        table[tracker.option + "-set"] = [&] {
            const auto [key, value] = r.setting();
            tracker.settings.push_back({key, value, r.option() + " " + key + "=" + value});
        };
    }
    o.help = examples::read_arguments(r, table);
    if (!o.help) check_together(o);
    return o;
}

}  // namespace compare
