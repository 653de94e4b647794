#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gazeloop::bench {

/// One figure. Speed figures are ratios measured in one process, interleaved.
struct Figure {
    std::string bench;
    std::string name;  ///< the case, e.g. "1920x1080"
    std::string metric;
    double value = 0.0;
    std::string unit;  ///< "x", "ms" ...
    std::string better = "higher";
    std::optional<double> bound{};   ///< what no implementation could beat
    std::optional<double> target{};  ///< what we want to reach
};

struct Options {
    std::optional<unsigned> samples{};   ///< --spp
    unsigned rounds = 3;                 ///< --rounds
    bool quick = false;                  ///< --quick: does it run? Figures of small pictures
    std::vector<std::string> cases{};    ///< --case, by name; all of them if empty
    std::vector<std::string> scenes{};   ///< --scene: files besides the built-in scenes
    std::optional<std::string> trace{};  ///< --trace: recorded gaze for the benches that follow one
    std::optional<std::string> against{};  ///< --against: another build's gazeloop

    [[nodiscard]] bool wants(std::string_view name) const;
};

/// Speed of KFR over full resolution on the ray-marched scene: fovea centred, at an edge, in a
/// corner and along a trace.
std::vector<Figure> kfr_raycast(const Options& options);

/// Speed of KFR and of the acuity-derived map over full resolution on the built-in scene of meshes,
/// with the time of each stage under the paper's names; gaze in the middle. Beside it what leaving
/// out saves, and pass II against a plain blit.
std::vector<Figure> kfr_mesh(const Options& options);

/// How old the gaze is when the first pass that needs it begins, read before the G-buffer is drawn,
/// once that is submitted, and once it is finished; and what each costs a frame. The case
/// `host-signal`: what passes would gain that are submitted before the gaze is read and let go by a
/// signal of the host.
std::vector<Figure> latch(const Options& options);

/// The frame loop's own work: from gaze to fovea, CPU time outside Vulkan and OpenXR, allocations,
/// memory over 10,000 frames, and the program's start-up.
std::vector<Figure> loop(const Options& options);

/// How much pictures change from frame to frame in a slow fly-through, and how far they are from
/// many samples, with and without each ingredient of antialiasing.
std::vector<Figure> stability(const Options& options);

/// Writes the KFR paper's Figures 4, 6 and 7 (alpha 1 to 6; sigma 1.2, 1.8, 2.4 beside the full
/// picture), of the built-in scene of meshes, as PNG into build/release/figures; and how far each
/// picture is from full resolution.
std::vector<Figure> paper_figures(const Options& options);

/// Speed of the acuity-derived map over full resolution and over KFR, gaze in the middle.
std::vector<Figure> acuity(const Options& options);

/// What maps cost the processor: building the tables of every kernel and of the acuity-derived map,
/// once, and following the gaze, which needs no new ones.
std::vector<Figure> maps(const Options& options);

/// An emulated HID tracker of 1000 Hz: how soon its samples are there for the loop, what reading it
/// costs, and whether any is lost in a minute beside a loop under load. Runs under umockdev's
/// preload library.
std::vector<Figure> devices(const Options& options);

/// `gazeloop report` on a session of an hour (1 kHz, 90 Hz, made once in virtual time and kept in
/// the cache, 1.1 GB): its time and peak memory, and both over those of another build, in turns. On
/// four such hours (made of that one, 4.4 GB) in all formats: time, memory and sizes.
std::vector<Figure> report(const Options& options);

/// A glTF scene of a million triangles and 22 textures (made once and kept in the cache, 70 MB):
/// processor time of loading it, over that of reading its files and decoding its pictures, and the
/// memory that it then holds, over what its buffers and mip chains need.
std::vector<Figure> gltf(const Options& options);

/// What watching a latency budget costs the loop: each frame, with the queue that takes snapshots
/// to the monitor's thread, for windows of the default length and of the longest.
std::vector<Figure> monitor(const Options& options);

/// What the picture metrics take per frame, with two threads: wall time, and processor time, which
/// a busy machine leaves alone.
std::vector<Figure> quality(const Options& options);

/// What the eyes do, told by the event detector and by two people (recordings of Andersson et al.
/// 2017): Cohen's kappa per event and stimulus, on persons on whom no parameter was chosen and on
/// all, beside coder against coder and plain I-VT; and what an hour of 1 kHz gaze costs.
std::vector<Figure> events(const Options& options);

/// How far off predicted gaze is, over holding the last one: the 95th percentile of each person at
/// 5 to 60 ms, by what the eyes do at the time predicted, of persons on whom no parameter was
/// chosen and of the others; and what an hour of 1 kHz gaze costs.
std::vector<Figure> prediction(const Options& options);

/// Every method against full resolution and against KFR as published, at each display's size (one
/// eye, one frame per scene, 16 samples): speed, time of each pass, samples, share of the bound,
/// quality by our contrast metric; and what a taller LP-buffer or the acuity map save at KFR's
/// quality. Of cases that are named, only what they need is measured; the larger displays only
/// where a case of theirs is named.
std::vector<Figure> headline(const Options& options);

/// What interleaved log-polar rendering saves at the quality of KFR as published, over scenes and
/// people on whom nothing was chosen: with gaze and head as a simulated person moves them over a
/// saccade (average), and in fixation after the eighth frame, with the head's sway. Ratios to full
/// resolution with as many samples, of which each takes as many rays. The case `ingredients`, by
/// name only, says what each setting of it is worth.
std::vector<Figure> front(const Options& options);

/// Every method on every scene, on one display along one gaze trace, frame by frame in turns:
/// samples, time of each pass, speed-up over full resolution. Also written as a CSV file and, for
/// each scene, a plot.
std::vector<Figure> rivals(const Options& options);

/// What the OpenXR API layer adds to a frame of an application that reads gaze, on Monado's null
/// compositor, frame by frame in turns with and without it; its allocations. Without and with a
/// recording.
std::vector<Figure> layer(const Options& options);

/// Table 1 of Guenter et al. 2012 on the built-in scene of meshes, at 1920x1080 on the paper's
/// display: content by content (a case each), frames by layers for three eyes and at full
/// resolution with three antialiasings, as times and as ratios to full resolution.
std::vector<Figure> layers(const Options& options);

/// What the article on sparse samples leaves open: quality, flicker and speed by placement, number
/// of neighbours, depth and turning patterns, each at as many samples.
std::vector<Figure> sparse(const Options& options);

/// Speed of 3D-KFR and of KFR over full resolution of all 25 x 25 views of a light field, and their
/// error, by sigma; through a lens that takes every view and through one that asks for some. The
/// case `memory`: frames that wait for views which memory has no room for, with and without
/// fetching ahead, and of views in BC1, over frames of views that are all there, while the head
/// goes past the cameras.
std::vector<Figure> lightfield(const Options& options);

/// How fast traces are read: MB of CSV per second of CPU time, of the whole reader and of its
/// parts.
std::vector<Figure> traces(const Options& options);

/// How often the true gaze of simulated people lies outside the sharp region when a frame is shown,
/// and what that takes: by widening rule and display, on the people that the rule was chosen on and
/// on others, beside a constant widening.
std::vector<Figure> misses(const Options& options);

/// The median; of an even number, the mean of the middle two. Precondition: not empty.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace gazeloop::bench
