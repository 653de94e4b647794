#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <numbers>

#include "drivers/trace/read_trace.h"
#include "runtime/error.h"
#include "runtime/methods/registry.h"
#include "runtime/profiles/profiles.h"
#include "runtime/report/line_chart.h"
#include "runtime/scene/scenes.h"
#include "tests/bench/bench.h"
#include "tests/bench/raycast_setup.h"
#include "tests/bench/timed_method.h"
#include "tests/support/method_by_settings.h"

namespace gazeloop::bench {
namespace {

constexpr const char* kDisplay = "fove0";
constexpr double kScale = 0.5;  ///< of its pictures' sides
constexpr unsigned kSamples = 4;
/// Moments of the trace, evenly spread: consecutive frames here, so that methods which keep
/// something from frame to frame do.
constexpr std::size_t kFrames = 24;
constexpr double kSceneTime_s = 2.5;

struct Gaze {
    gaze::PerEye<glm::dvec3> directions;
};

/// The gaze of each frame; straight ahead without a trace.
std::vector<Gaze> gazes(const Options& options) {
    std::vector<Gaze> all;
    if (options.trace) {
        const gaze::GazeTrace trace = value_or_throw(drivers::read_trace(*options.trace));
        std::vector<const gaze::GazeSample*> valid;
        for (const gaze::GazeSample& sample : trace.samples) {
            if (sample.eyes[0].valid && sample.eyes[1].valid) {
                valid.push_back(&sample);
            }
        }
        for (std::size_t i = 0; i < kFrames && !valid.empty(); ++i) {
            const auto& eyes = valid[(2 * i + 1) * valid.size() / (2 * kFrames)]->eyes;
            all.push_back({{eyes[0].direction, eyes[1].direction}});
        }
    }
    if (all.empty()) {
        all.assign(kFrames, {{glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.0, 0.0, -1.0)}});
    }
    return all;
}

/// All methods on one scene.
class Measurement {
  public:
    Measurement(const vulkan::Context& context, std::string_view scene, const Options& options)
        : context_(context),
          scene_name_(scene),
          scene_(scene::make_scene(context, scene)),
          display_(value_or_throw(profiles::load_display(kDisplay))),
          gazes_(gazes(options)) {
        config_.samples = options.samples.value_or(kSamples);
        const vk::Extent2D extent(static_cast<std::uint32_t>(display_.width_px * kScale),
                                  static_cast<std::uint32_t>(display_.height_px * kScale));
        config_.extents = {extent, extent};
        for (const methods::Method& method : methods::all_methods()) {
            if (method.passes != nullptr) {
                rivals_.push_back(
                    std::make_unique<TimedMethod>(context, std::string(method.name), *scene_,
                                                  tests::passes_by(method.name), config_, kFrames));
                rivals_.back()->warm_up(context, views(0));
            }
        }
        for (unsigned round = 0; round < options.rounds; ++round) {
            for (std::size_t i = 0; i < kFrames; ++i) {
                one_frame(round * kFrames + i, i);
            }
        }
    }

    void add_figures(std::vector<Figure>& figures) const {
        const TimedMethod& full = *rivals_.front();
        for (const auto& rival : rivals_) {
            const auto add = [&](std::string_view metric, double value, const char* unit,
                                 const char* better) {
                figures.push_back({"rivals", scene_name_,
                                   fmt::format("{} {}", rival->name(), metric), value, unit,
                                   better});
            };
            add("speedup", full.ms() / rival->ms(), "x", "higher");
            add("fewer samples", full.samples() / rival->samples(), "x", "higher");
            for (std::size_t pass = 0; pass < rival->passes().size(); ++pass) {
                add(rival->passes()[pass], rival->pass_ms(pass), "ms", "lower");
            }
        }
    }

    /// A line for each method, and for each of its passes.
    void write_csv(std::ostream& out) const {
        const TimedMethod& full = *rivals_.front();
        for (const auto& rival : rivals_) {
            out << fmt::format("{},{},all,{:.3f},{:.0f},{:.3f}\n", scene_name_, rival->name(),
                               rival->ms(), rival->samples(), full.ms() / rival->ms());
            for (std::size_t pass = 0; pass < rival->passes().size(); ++pass) {
                out << fmt::format("{},{},{},{:.3f},,\n", scene_name_, rival->name(),
                                   rival->passes()[pass], rival->pass_ms(pass));
            }
        }
    }

    void write_plot(const std::filesystem::path& file) const {
        report::LineChart chart{
            .title = fmt::format("Frames of every method: {}", scene_name_),
            .subtitle =
                fmt::format("{} at {}x{} an eye, {} samples per cell, in turns", kDisplay,
                            config_.extents[0].width, config_.extents[0].height, config_.samples),
            .x = {.label = "frame", .low = 0.0, .high = double{kFrames} - 1.0},
            .y = {.label = "GPU time of a frame, ms", .low = 1e9, .high = 0.0, .logarithmic = true},
            .lines = {}};
        for (std::size_t i = 0; i < rivals_.size(); ++i) {
            report::ChartLine line{.label = rivals_[i]->name(),
                                   .points = {},
                                   .colour = report::chart_colour(i),
                                   .dashes = i / 4};
            const std::vector<double> ms = rivals_[i]->frame_ms();
            for (std::size_t frame = 0; frame < ms.size(); ++frame) {
                line.points.push_back({static_cast<double>(frame), ms[frame]});
                chart.y.low = std::min(chart.y.low, 0.9 * ms[frame]);
                chart.y.high = std::max(chart.y.high, 1.1 * ms[frame]);
            }
            chart.lines.push_back(std::move(line));
        }
        value_or_throw(report::write_chart(chart, file));
    }

  private:
    /// The head turns once, a quarter at a time: content is dearer in one direction than in
    /// another.
    [[nodiscard]] gaze::StereoView views(std::size_t frame) const {
        gaze::StereoView made;
        const double yaw_deg = kYaws_deg.at(frame * kYaws_deg.size() / kFrames);
        const glm::dquat yaw =
            glm::angleAxis(yaw_deg * std::numbers::pi / 180.0, glm::dvec3(0.0, 1.0, 0.0));
        for (const gaze::Eye eye : gaze::kEyes) {
            const std::size_t e = gaze::index(eye);
            made[e] = display::profile_view(display_, eye, config_.extents[e].width,
                                            config_.extents[e].height);
            made[e].pose.orientation = yaw * made[e].pose.orientation;
            made[e].pose.position_m = yaw * made[e].pose.position_m;
        }
        return made;
    }

    void one_frame(std::size_t index, std::size_t frame) {
        render::FrameView view{
            .index = index, .scene_time_s = kSceneTime_s, .views = views(frame), .targets = {}};
        gaze::FrameFovea fovea;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            fovea.eyes[e].direction = gazes_[frame].directions[e];
            fovea.eyes[e].position = gaze::project(fovea.eyes[e].direction, view.views[e]);
        }
        for (const auto& rival : rivals_) {
            rival->frame(frame, view, fovea);
        }
    }

    const vulkan::Context& context_;
    std::string scene_name_;
    std::unique_ptr<scene::Scene> scene_;
    display::DisplayProfile display_;
    std::vector<Gaze> gazes_;
    render::RendererConfig config_;
    std::vector<std::unique_ptr<TimedMethod>> rivals_;
};

}  // namespace

std::vector<Figure> rivals(const Options& options) {
    const vulkan::Context context({}, nullptr);
    const std::filesystem::path folder(GAZELOOP_BINARY_DIR);
    const std::filesystem::path csv = folder / "rivals.csv";
    std::ofstream out(csv);
    out << "scene,method,pass,ms,samples,speedup\n";
    std::vector<Figure> figures;
    for (const std::string_view scene : scene::scene_names()) {
        if (options.wants(scene)) {
            const Measurement measurement(context, scene, options);
            measurement.add_figures(figures);
            measurement.write_csv(out);
            const std::filesystem::path plot = folder / fmt::format("rivals-{}.png", scene);
            measurement.write_plot(plot);
            fmt::print(stderr, "written: {}\n", plot.string());
        }
    }
    if (!out.flush()) {
        throw SetupError(ErrorKind::BadInput, csv.string() + " cannot be written");
    }
    fmt::print(stderr, "written: {}\n", csv.string());
    return figures;
}

}  // namespace gazeloop::bench
