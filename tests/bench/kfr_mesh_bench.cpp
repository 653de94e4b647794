#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "tests/bench/bench.h"
#include "tests/bench/raycast_setup.h"

namespace gazeloop::bench {
namespace {

constexpr double kHalfWidth_rad = 0.8;

struct Case {
    vk::Extent2D extent;
    double target;  ///< of KFR over full resolution
    unsigned most_rounds;
};
const std::array kCases{Case{{1920, 1080}, 2.4, 100}, Case{{2560, 1440}, 2.7, 5},
                        Case{{3840, 2160}, 3.0, 3}};

/// A stage as the paper's Table 2 names it, and the passes that it is made of here.
struct Stage {
    std::string_view name;
    std::vector<std::string_view> passes;
};
const std::array kStages{Stage{"depth", {"depth"}},
                         Stage{"shadow", {"shadow"}},
                         Stage{"defer", {"defer", "glass"}},
                         Stage{"sky", {"sky"}},
                         Stage{"shading", {"full", "pass_i", "disc", "lp_gaussian"}},
                         Stage{"pass_ii", {"resolve"}}};

double stage_ms(const Contender& contender, const Stage& stage) {
    double sum = 0.0;
    for (const std::string_view pass : stage.passes) {
        sum += contender.median_ms(pass);
    }
    return sum;
}

double total_ms(const Contender& contender) {
    double sum = 0.0;
    for (const Stage& stage : kStages) {
        sum += stage_ms(contender, stage);
    }
    return sum;
}

class Measurement {
  public:
    Measurement(const vulkan::Context& context, scene::Scene& scene, const Case& at,
                const Options& options)
        : case_(at),
          rounds_(std::min(options.rounds, at.most_rounds)),
          setup_(context, at.extent, kHalfWidth_rad) {
        config_ = setup_.config(options);
        config_.samples = options.samples.value_or(1);
        contenders_.emplace_back("full", Contender(context, with(render::Method::Full), scene));
        contenders_.emplace_back("kfr", Contender(context, with(render::Method::Kfr), scene));
        for (const double mar : {0.022, 0.0275}) {
            render::MethodConfig acuity = with(render::Method::Acuity);
            acuity.acuity.mar.slope = mar;
            contenders_.emplace_back(fmt::format("acuity {}", mar),
                                     Contender(context, acuity, scene));
        }
    }

    void run(std::vector<Figure>& figures) {
        const render::FrameRequest frame = setup_.frame(0.0, setup_.centre());
        for (auto& [name, contender] : contenders_) {
            contender.round(frame, false);
        }
        for (unsigned round = 0; round < rounds_; ++round) {
            for (auto& [name, contender] : contenders_) {
                contender.round(frame);
            }
        }
        const Contender& full = contenders_.front().second;
        const double full_ms = total_ms(full);
        const double shading_ms = stage_ms(full, kStages[4]);
        const auto add = [&](const std::string& metric, double value, std::string unit,
                             std::string better) -> Figure& {
            return figures.emplace_back(Figure{.bench = "kfr-mesh",
                                               .name = setup_.name(),
                                               .metric = metric,
                                               .value = value,
                                               .unit = std::move(unit),
                                               .better = std::move(better)});
        };
        for (const auto& [name, contender] : contenders_) {
            const std::string prefix = name == "kfr" ? "" : name + " ";
            const double ms = total_ms(contender);
            if (name != "full") {
                // Samples at what full resolution pays for one, and the resolve as measured.
                const double share = contender.cells() / full.cells();
                const double predicted = full_ms / (full_ms - shading_ms + share * shading_ms +
                                                    stage_ms(contender, kStages[5]));
                Figure& speedup = add(prefix + "speedup", full_ms / ms, "x", "higher");
                speedup.bound = full_ms / (full_ms - shading_ms + share * shading_ms);
                if (name == "kfr") {
                    speedup.target = case_.target;
                }
                add(prefix + "share of Amdahl", 100.0 * full_ms / ms / predicted, "%", "higher")
                    .target = 90.0;
            }
            add(prefix + "samples", contender.cells(), "", "lower");
            for (const Stage& stage : kStages) {
                if (stage_ms(contender, stage) > 0.0) {
                    add(fmt::format("{} {}", name, stage.name), stage_ms(contender, stage), "ms",
                        "lower");
                }
            }
            add(name + " total", ms, "ms", "lower");
        }
        const double resolve_ms = stage_ms(contenders_[1].second, kStages[5]);
        add("pass_ii over full", 100.0 * resolve_ms / full_ms, "%", "lower").target = 5.0;
    }

  private:
    [[nodiscard]] render::MethodConfig with(render::Method method) const {
        render::MethodConfig config = config_;
        config.method = method;
        return config;
    }

    const Case& case_;
    unsigned rounds_;
    RaycastSetup setup_;
    render::MethodConfig config_;
    std::vector<std::pair<std::string, Contender>> contenders_;
};

}  // namespace

std::vector<Figure> kfr_mesh(const Options& options) {
    const vulkan::Context context({}, nullptr);
    const auto scene = scene::make_scene(context, "gallery");
    std::vector<Figure> figures;
    for (const Case& at : kCases) {
        if (options.wants(fmt::format("{}x{}", at.extent.width, at.extent.height))) {
            Measurement(context, *scene, at, options).run(figures);
        }
    }
    return figures;
}

}  // namespace gazeloop::bench
