#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "drivers/trace/read_trace.h"
#include "runtime/error.h"
#include "runtime/foveation/log_polar/log_polar_map.h"
#include "tests/bench/bench.h"
#include "tests/bench/raycast_times.h"

namespace gazeloop::bench {
namespace {

constexpr double kHalfWidth_rad = 0.8;
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

class Measurement {
  public:
    Measurement(const vulkan::Context& context, const Case& at, const Options& options)
        : context_(context),
          case_(at),
          rounds_(std::min(options.rounds, at.most_rounds)),
          setup_(context, at.extent, kHalfWidth_rad),
          config_(setup_.config(options)),
          full_(context, with_method(config_, render::Method::Full, false)),
          kfr_(context, with_method(config_, render::Method::Kfr, true)),
          plain_(context, with_method(config_, render::Method::Kfr, false)) {
        if (options.trace && at.off_centre) {
            trace_ = value_or_throw(drivers::read_trace(*options.trace));
        }
    }

    void run(std::vector<Figure>& figures) {
        const render::FrameRequest warm_up = setup_.frame(kYaws_deg[0], setup_.centre());
        for (Contender* const contender : {&full_, &kfr_, &plain_}) {
            contender->round(warm_up, false);
        }
        for (const double yaw_deg : kYaws_deg) {
            one_view(yaw_deg);
        }
        const std::string name = setup_.name();
        centred_.add_figures("kfr-raycast", name, "", case_.target, true, figures);
        centred_plain_.add_figures("kfr-raycast", name, "plain ", case_.paper_target, true,
                                   figures);
        for (const auto& [where, times] :
             {std::pair{"edge", &edge_}, {"corner", &corner_}, {"trace", &along_trace_}}) {
            if (!times->empty()) {
                times->add_figures("kfr-raycast", fmt::format("{} {}", name, where), "",
                                   std::nullopt, false, figures);
            }
        }
    }

  private:
    static render::MethodConfig with_method(render::MethodConfig config, render::Method method,
                                            bool disc) {
        config.method = method;
        config.kfr.disc = disc;
        return config;
    }

    void one_view(double yaw_deg) {
        const render::FrameRequest centred = setup_.frame(yaw_deg, setup_.centre());
        for (Contender* const contender : {&full_, &kfr_, &plain_}) {
            contender->reset();
        }
        for (unsigned round = 0; round < rounds_; ++round) {
            for (Contender* const contender : {&full_, &kfr_, &plain_}) {
                contender->round(centred);
            }
        }
        const CostMap costs(context_, setup_, config_, centred, full_.median_ms());
        keep(kfr_, costs, centred_);
        keep(plain_, costs, centred_plain_);
        if (!case_.off_centre) {
            return;
        }
        off_centre(yaw_deg, {0.5, case_.extent.height / 2.0}, costs, edge_);
        off_centre(yaw_deg, {0.5, 0.5}, costs, corner_);
        std::vector<gaze::PixelPosition> foveae;
        for (const gaze::GazeSample& sample : trace_.samples) {
            if (sample.eyes[0].valid) {
                foveae.push_back(gaze::project(sample.eyes[0].direction, centred.views[0]));
            }
        }
        for (std::size_t i = 0; i < kTraceFoveae && !foveae.empty(); ++i) {
            const std::size_t at = (2 * i + 1) * foveae.size() / (2 * kTraceFoveae);
            off_centre(yaw_deg, foveae[at], costs, along_trace_);
        }
    }

    void off_centre(double yaw_deg, const gaze::PixelPosition& fovea, const CostMap& costs,
                    RaycastTimes& times) {
        kfr_.reset();
        kfr_.round(setup_.frame(yaw_deg, fovea));
        keep(kfr_, costs, times);
    }

    void keep(const Contender& contender, const CostMap& costs, RaycastTimes& times) const {
        const foveation::LogPolarMap map(
            config_.kfr.kernel, {case_.extent.width, case_.extent.height}, contender.plan().fovea);
        times.keep(full_, contender, costs, map);
    }

    const vulkan::Context& context_;
    const Case& case_;
    unsigned rounds_;
    RaycastSetup setup_;
    render::MethodConfig config_;
    Contender full_;
    Contender kfr_;
    Contender plain_;
    gaze::GazeTrace trace_;
    RaycastTimes centred_;
    RaycastTimes centred_plain_;
    RaycastTimes edge_;
    RaycastTimes corner_;
    RaycastTimes along_trace_;
};

}  // namespace

std::vector<Figure> kfr_raycast(const Options& options) {
    const vulkan::Context context({}, nullptr);
    std::vector<Figure> figures;
    for (const Case& at : kCases) {
        if (options.wants(fmt::format("{}x{}", at.extent.width, at.extent.height))) {
            Measurement(context, at, options).run(figures);
        }
    }
    return figures;
}

}  // namespace gazeloop::bench
