#include <fmt/core.h>

#include <array>
#include <numbers>

#include "runtime/error.h"
#include "runtime/foveation/eye/fewest_samples.h"
#include "runtime/foveation/eye/guenter_acuity.h"
#include "runtime/foveation/log_polar/acuity_map.h"
#include "runtime/foveation/log_polar/log_polar_map.h"
#include "tests/bench/bench.h"
#include "tests/bench/raycast_times.h"

namespace gazeloop::bench {
namespace {

struct Case {
    vk::Extent2D extent;
    double target;  ///< a prototype's figures
};
const std::array kCases{Case{{1280, 1440}, 11.0}, Case{{2160, 2160}, 24.0}};

constexpr double kHalfWidth_rad = 50.0 * std::numbers::pi / 180.0;

class Measurement {
  public:
    Measurement(const vulkan::Context& context, const Case& at, const Options& options)
        : context_(context),
          case_(at),
          rounds_(options.rounds),
          setup_(context, at.extent, kHalfWidth_rad),
          config_(setup_.config(options)),
          full_(context, with_method(render::Method::Full)),
          acuity_(context, with_method(render::Method::Acuity)),
          kfr_(context, with_method(render::Method::Kfr)) {}

    void run(std::vector<Figure>& figures) {
        const render::FrameRequest warm_up = setup_.frame(kYaws_deg[0], setup_.centre());
        for (Contender* const contender : {&full_, &acuity_, &kfr_}) {
            contender->round(warm_up, false);
        }
        RaycastTimes acuity_times;
        RaycastTimes kfr_times;
        for (const double yaw_deg : kYaws_deg) {
            const render::FrameRequest frame = setup_.frame(yaw_deg, setup_.centre());
            for (Contender* const contender : {&full_, &acuity_, &kfr_}) {
                contender->reset();
            }
            for (unsigned round = 0; round < rounds_; ++round) {
                for (Contender* const contender : {&full_, &acuity_, &kfr_}) {
                    contender->round(frame);
                }
            }
            const CostMap costs(context_, setup_, config_, frame, full_.median_ms());
            acuity_times.keep(full_, acuity_, costs, acuity_map(frame));
            kfr_times.keep(
                full_, kfr_, costs,
                foveation::LogPolarMap(config_.kfr.kernel,
                                       {case_.extent.width, case_.extent.height}, frame.foveae[0]));
        }
        const std::string name = setup_.name();
        acuity_times.add_figures("acuity", name, "", case_.target, true, figures);
        const double over_kfr = kfr_times.total_ms() / acuity_times.total_ms();
        figures.push_back({"acuity", name, "speedup_over_kfr", over_kfr, "x", "higher"});
        figures.push_back({"acuity", name, "samples", acuity_times.samples(), "", "lower"});
        const foveation::GazeField field = value_or_throw(foveation::GazeField::create(
            setup_.frame(0.0, setup_.centre()).views[0], {0.0, 0.0, -1.0}));
        const double fewest = foveation::fewest_samples(
            field, *value_or_throw(foveation::GuenterAcuity::create(config_.acuity.mar)),
            gaze::Eye::Left);
        figures.push_back({"acuity", name, "bound_share", 100.0 * fewest / acuity_times.samples(),
                           "%", "higher", 100.0});
    }

  private:
    [[nodiscard]] render::MethodConfig with_method(render::Method method) const {
        render::MethodConfig config = config_;
        config.method = method;
        return config;
    }

    [[nodiscard]] foveation::AcuityMap acuity_map(const render::FrameRequest& frame) const {
        return {value_or_throw(foveation::AcuityProfile::create(config_.acuity, frame.views[0])),
                foveation::GazeFrame(frame.views[0], frame.gaze_directions[0])};
    }

    const vulkan::Context& context_;
    const Case& case_;
    unsigned rounds_;
    RaycastSetup setup_;
    render::MethodConfig config_;
    Contender full_;
    Contender acuity_;
    Contender kfr_;
};

}  // namespace

std::vector<Figure> acuity(const Options& options) {
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
