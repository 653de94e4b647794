#include <fmt/core.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

#include "drivers/trace/read_trace.h"
#include "runtime/error.h"
#include "runtime/foveation/log_polar_map.h"
#include "tests/bench/bench.h"
#include "tests/bench/raycast_setup.h"

namespace gazeloop::bench {
namespace {

using latency::Pass;

constexpr double kHalfWidth_rad = 0.8;

/// The picture's content decides much of the ratio: the middle of the first view is the scene's
/// dearest spot, a mirror. So the frame is rendered in all four directions, as a head would turn.
constexpr std::array kYaws_deg{0.0, 90.0, 180.0, 270.0};
constexpr std::size_t kTraceFoveae = 8;

struct Case {
    vk::Extent2D extent;
    double target;        ///< with the disc; a prototype's figures
    double paper_target;  ///< without it: the paper's pipeline and its figures
    unsigned most_rounds;
    bool off_centre;
};
const std::array kCases{Case{{1920, 1080}, 3.9, 2.9, 100, true},
                        Case{{2560, 1440}, 4.1, 3.0, 3, false},
                        Case{{3840, 2160}, 4.1, 3.2, 2, false}};

/// Times of one way to foveate, a figure for each view.
struct Times {
    std::vector<double> full_ms{};
    std::vector<double> ms{};
    std::vector<double> pass_i_ms{};
    std::vector<double> disc_ms{};
    std::vector<double> resolve_ms{};
    std::vector<double>
        predicted_ms{};  ///< Amdahl's: the samples' cost at full resolution + resolve
    std::vector<double> cells{};
};

double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

gaze::PixelPosition texel_position(const foveation::SamplingPlan& plan,
                                   const foveation::LogPolarMap& map, std::uint32_t x,
                                   std::uint32_t y) {
    const double radius_px = map.radius_px((x + 0.5) / plan.lp.width);
    const double angle = (y + 0.5) * 2.0 * std::numbers::pi / plan.lp.height;
    return {plan.fovea.x_px + radius_px * std::cos(angle),
            plan.fovea.y_px + radius_px * std::sin(angle)};
}

class Measurement {
  public:
    Measurement(const render::VulkanContext& context, const Case& at, const Options& options)
        : context_(context),
          case_(at),
          name_(fmt::format("{}x{}", at.extent.width, at.extent.height)),
          rounds_(std::min(options.rounds, at.most_rounds)),
          setup_(context, at.extent, kHalfWidth_rad),
          config_(config_of(setup_, options)),
          full_(context, with_method(config_, render::Method::Full, false)),
          kfr_(context, with_method(config_, render::Method::Kfr, true)),
          plain_(context, with_method(config_, render::Method::Kfr, false)) {
        if (options.trace && at.off_centre) {
            trace_ = value_or_throw(drivers::read_trace(*options.trace));
        }
    }

    std::vector<Figure> run() {
        const render::FrameRequest warm_up = setup_.frame(kYaws_deg[0], setup_.centre());
        for (Contender* const contender : {&full_, &kfr_, &plain_}) {
            contender->round(warm_up, false);
        }
        for (const double yaw_deg : kYaws_deg) {
            one_view(yaw_deg);
        }
        add_figures("", centred_, case_.target, true);
        add_figures("plain ", centred_plain_, case_.paper_target, true);
        if (case_.off_centre) {
            name_ += " edge";
            add_figures("", edge_, std::nullopt, false);
            name_.replace(name_.rfind(' '), std::string::npos, " corner");
            add_figures("", corner_, std::nullopt, false);
            if (!trace_.samples.empty()) {
                name_.replace(name_.rfind(' '), std::string::npos, " trace");
                add_figures("", along_trace_, std::nullopt, false);
            }
        }
        return figures_;
    }

  private:
    static render::RendererConfig config_of(const RaycastSetup& setup, const Options& options) {
        render::RendererConfig config;
        config.samples = options.samples.value_or(16);
        config.extents = setup.extents();
        return config;
    }

    static render::RendererConfig with_method(render::RendererConfig config, render::Method method,
                                              bool disc) {
        config.method = method;
        config.kfr.disc = disc;
        return config;
    }

    void one_view(double yaw_deg) {
        const render::FrameRequest centred = setup_.frame(yaw_deg, setup_.centre());
        full_.reset();
        kfr_.reset();
        plain_.reset();
        for (unsigned round = 0; round < rounds_; ++round) {
            full_.round(centred);
            kfr_.round(centred);
            plain_.round(centred);
        }
        const CostMap costs(context_, setup_, config_, yaw_deg, full_.median_ms());
        keep(kfr_, costs, centred_);
        keep(plain_, costs, centred_plain_);
        if (!case_.off_centre) {
            return;
        }
        off_centre(yaw_deg, {0.5, case_.extent.height / 2.0}, costs, edge_);
        off_centre(yaw_deg, {0.5, 0.5}, costs, corner_);
        const gaze::EyeView& view = centred.views[0];
        std::vector<gaze::PixelPosition> foveae;
        for (std::size_t i = 0; i < trace_.samples.size(); ++i) {
            const gaze::EyeRay& ray = trace_.samples[i].eyes[0];
            if (ray.valid) {
                foveae.push_back(gaze::project(ray.direction, view));
            }
        }
        for (std::size_t i = 0; i < kTraceFoveae && !foveae.empty(); ++i) {
            const std::size_t at = (2 * i + 1) * foveae.size() / (2 * kTraceFoveae);
            off_centre(yaw_deg, foveae[at], costs, along_trace_);
        }
    }

    void off_centre(double yaw_deg, const gaze::PixelPosition& fovea, const CostMap& costs,
                    Times& times) {
        const render::FrameRequest request = setup_.frame(yaw_deg, fovea);
        kfr_.reset();
        kfr_.round(request);
        keep(kfr_, costs, times);
    }

    void keep(const Contender& contender, const CostMap& costs, Times& times) const {
        const foveation::SamplingPlan& plan = contender.plan();
        const foveation::LogPolarMap map(config_.kfr.kernel,
                                         {case_.extent.width, case_.extent.height}, plan.fovea);
        times.full_ms.push_back(full_.median_ms());
        times.ms.push_back(contender.median_ms());
        times.pass_i_ms.push_back(contender.median_ms(Pass::PassI));
        times.disc_ms.push_back(contender.median_ms(Pass::Disc));
        times.resolve_ms.push_back(contender.median_ms(Pass::Resolve));
        times.predicted_ms.push_back(
            times.resolve_ms.back() +
            costs.predicted_ms(plan, [&](std::uint32_t x, std::uint32_t y) {
                return texel_position(plan, map, x, y);
            }));
        times.cells.push_back(contender.cells());
    }

    void add_figures(std::string_view prefix, const Times& times, std::optional<double> target,
                     bool passes) {
        const auto add = [&](std::string_view metric, double value, std::string_view unit,
                             std::optional<double> bound, std::optional<double> goal,
                             std::string_view better) {
            figures_.push_back({"kfr-raycast", name_, fmt::format("{}{}", prefix, metric), value,
                                std::string(unit), std::string(better), bound, goal});
        };
        const double speedup = sum(times.full_ms) / sum(times.ms);
        const double views = static_cast<double>(times.ms.size());
        const double fewer = full_.cells() * views / sum(times.cells);
        const double amdahl = sum(times.full_ms) / sum(times.predicted_ms);
        double least = speedup;
        for (std::size_t i = 0; i < times.ms.size(); ++i) {
            least = std::min(least, times.full_ms[i] / times.ms[i]);
        }
        add("speedup", speedup, "x", amdahl, target, "higher");
        add("speedup, dearest view", least, "x", std::nullopt, std::nullopt, "higher");
        add("fewer samples", fewer, "x", std::nullopt, std::nullopt, "higher");
        add("share of Amdahl", 100.0 * speedup / amdahl, "%", 100.0, 90.0, "higher");
        if (!passes) {
            return;
        }
        if (prefix.empty()) {
            add("full", sum(times.full_ms) / views, "ms", std::nullopt, std::nullopt, "lower");
        }
        add("pass_i", sum(times.pass_i_ms) / views, "ms", std::nullopt, std::nullopt, "lower");
        if (sum(times.disc_ms) > 0.0) {
            add("disc", sum(times.disc_ms) / views, "ms", std::nullopt, std::nullopt, "lower");
        }
        add("resolve", sum(times.resolve_ms) / views, "ms", std::nullopt, std::nullopt, "lower");
    }

    const render::VulkanContext& context_;
    const Case& case_;
    std::string name_;
    unsigned rounds_;
    RaycastSetup setup_;
    render::RendererConfig config_;
    Contender full_;
    Contender kfr_;
    Contender plain_;
    drivers::Trace trace_;
    Times centred_;
    Times centred_plain_;
    Times edge_;
    Times corner_;
    Times along_trace_;
    std::vector<Figure> figures_;
};

}  // namespace

std::vector<Figure> kfr_raycast(const Options& options) {
    const render::VulkanContext context({}, nullptr);
    std::vector<Figure> figures;
    for (const Case& at : kCases) {
        if (options.wants(fmt::format("{}x{}", at.extent.width, at.extent.height))) {
            const std::vector<Figure> more = Measurement(context, at, options).run();
            figures.insert(figures.end(), more.begin(), more.end());
        }
    }
    return figures;
}

}  // namespace gazeloop::bench
