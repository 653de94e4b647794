#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/foveation/log_polar/log_polar_map.h"
#include "tests/bench/bench.h"
#include "tests/bench/plain_blit.h"
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
const std::array kStages{
    Stage{"depth", {"depth"}},          Stage{"shadow", {"shadow"}},
    Stage{"defer", {"defer", "glass"}}, Stage{"sky", {"sky"}},
    Stage{"shading", {"full"}},         Stage{"pass I", {"pass_i", "disc", "lp_gaussian"}},
    Stage{"pass II", {"resolve"}}};
constexpr std::size_t kFirstOfSamples = 4;
constexpr std::size_t kPassTwo = kStages.size() - 1;

constexpr const char* kFull = "full";
constexpr const char* kKfr = "kfr";
constexpr const char* kKfrAll = "kfr, all required";

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

/// Of what is drawn before the gaze is read.
double geometry_ms(const Contender& contender) {
    double sum = 0.0;
    for (std::size_t stage = 0; stage < kFirstOfSamples; ++stage) {
        sum += stage_ms(contender, kStages.at(stage));
    }
    return sum;
}

/// Of full resolution: what fewer samples make faster.
double shading_ms(const Contender& full) { return full.median_ms("full"); }

struct Entrant {
    std::string name;
    Contender contender;

    /// Processor time of all threads: what a driver that renders on the processor takes of a busy
    /// machine too.
    [[nodiscard]] double processor_ms() const { return contender.median_processor_ms(); }
    [[nodiscard]] double before_gaze_processor_ms() const {
        return contender.median_before_gaze_processor_ms();
    }
    [[nodiscard]] double after_gaze_processor_ms() const {
        return processor_ms() - before_gaze_processor_ms();
    }
};

class Measurement {
  public:
    /// `all_scene` is the same scene with everything drawn as if it were needed.
    Measurement(const vulkan::Context& context, scene::Scene& scene, scene::Scene& all_scene,
                const Case& at, const Options& options)
        : context_(context),
          scene_(scene),
          case_(at),
          rounds_(std::min(options.rounds, at.most_rounds)),
          setup_(context, at.extent, kHalfWidth_rad) {
        config_ = setup_.config(options);
        config_.samples = options.samples.value_or(1);
        const auto enter = [&](std::string name, const render::MethodConfig& config,
                               scene::Scene& of) {
            contenders_.push_back({std::move(name), Contender(context, config, of)});
        };
        enter(kFull, with(render::Method::Full), scene);
        enter(kKfr, with(render::Method::Kfr), scene);
        enter(kKfrAll, with(render::Method::Kfr), all_scene);
        for (const double mar : {0.022, 0.0275}) {
            render::MethodConfig acuity = with(render::Method::Acuity);
            acuity.acuity.mar.slope = mar;
            enter(fmt::format("acuity {}", mar), acuity, scene);
        }
        const auto lp = value_or_throw(
            foveation::lp_buffer_size(config_.kfr, {at.extent.width, at.extent.height}));
        blit_.emplace(context, vk::Extent2D(lp.width, lp.height), at.extent, config_.format);
    }

    void run(std::vector<Figure>& figures) {
        render::FrameRequest frame = setup_.frame(0.0, setup_.centre());
        // Of the other eye nothing should count, its geometry neither: it looks up, into the sky.
        frame.views[1].pose.orientation =
            glm::angleAxis(std::numbers::pi / 2.0, glm::dvec3(1.0, 0.0, 0.0));
        for (unsigned round = 0; round <= rounds_; ++round) {
            for (Entrant& entrant : contenders_) {
                entrant.contender.round(frame, round > 0);
            }
            blit_->round(round > 0);
        }
        for (const Entrant& entrant : contenders_) {
            if (entrant.name != kFull && entrant.name != kKfrAll) {
                add_speed(entrant, figures);
            }
            add_stages(entrant, figures);
        }
        add_processor_share(frame, figures);
        add_left_out(figures);
        add_pass_two(figures);
    }

  private:
    [[nodiscard]] render::MethodConfig with(render::Method method) const {
        render::MethodConfig config = config_;
        config.method = method;
        return config;
    }

    [[nodiscard]] const Entrant& entrant(std::string_view name) const {
        return *std::ranges::find(contenders_, name, &Entrant::name);
    }

    Figure& add(std::vector<Figure>& figures, std::string metric, double value, std::string unit,
                std::string better) const {
        return figures.emplace_back(Figure{.bench = "kfr-mesh",
                                           .name = setup_.name(),
                                           .metric = std::move(metric),
                                           .value = value,
                                           .unit = std::move(unit),
                                           .better = std::move(better)});
    }

    void add_speed(const Entrant& entrant, std::vector<Figure>& figures) const {
        const Contender& contender = entrant.contender;
        const Contender& full = this->entrant(kFull).contender;
        const std::string prefix = entrant.name == kKfr ? "" : entrant.name + " ";
        const double full_ms = total_ms(full);
        const double ms = total_ms(contender);
        // Samples at what full resolution pays for one, and the resolve as measured.
        const double share = contender.cells() / full.cells();
        const double least_ms = full_ms - shading_ms(full) + share * shading_ms(full);
        const double predicted = full_ms / (least_ms + stage_ms(contender, kStages[kPassTwo]));
        Figure& speedup = add(figures, prefix + "speedup", full_ms / ms, "x", "higher");
        speedup.bound = full_ms / least_ms;
        if (entrant.name == kKfr) {
            speedup.target = case_.target;
        }
        add(figures, prefix + "processor speedup",
            this->entrant(kFull).processor_ms() / entrant.processor_ms(), "x", "higher");
        add(figures, prefix + "share of Amdahl", 100.0 * full_ms / ms / predicted, "%", "higher")
            .target = 90.0;
    }

    /// Of KFR, in processor time: what a sample costs is what full resolution pays at its place.
    void add_processor_share(const render::FrameRequest& frame,
                             std::vector<Figure>& figures) const {
        const Entrant& full = entrant(kFull);
        const Entrant& kfr = entrant(kKfr);
        const CostMap costs(context_, setup_, config_, frame, full.after_gaze_processor_ms(),
                            &scene_);
        const foveation::LogPolarMap map(config_.kfr.kernel,
                                         {case_.extent.width, case_.extent.height},
                                         kfr.contender.plan().fovea);
        const double samples_ms = costs.predicted_ms(kfr.contender.plan(), map);
        const double mean_ms =
            full.after_gaze_processor_ms() * kfr.contender.cells() / full.contender.cells();
        // Passes run one after the other, so that they take of processors what they take of time.
        const double resolve_ms = kfr.after_gaze_processor_ms() *
                                  stage_ms(kfr.contender, kStages[kPassTwo]) /
                                  (total_ms(kfr.contender) - geometry_ms(kfr.contender));
        const double predicted_ms = full.before_gaze_processor_ms() + samples_ms + resolve_ms;
        add(figures, "processor share of Amdahl, by place",
            100.0 * predicted_ms / kfr.processor_ms(), "%", "higher")
            .target = 90.0;
        add(figures, "cost of a sample's place over the mean", samples_ms / mean_ms, "x", "lower");
        add(figures, "cost of a sample over its place's",
            (kfr.after_gaze_processor_ms() - resolve_ms) / samples_ms, "x", "lower");
    }

    void add_stages(const Entrant& entrant, std::vector<Figure>& figures) const {
        const std::string& name = entrant.name;
        const Contender& contender = entrant.contender;
        add(figures, name + " samples", contender.cells(), "", "lower");
        for (const Stage& stage : kStages) {
            if (stage_ms(contender, stage) == 0.0) {
                continue;
            }
            add(figures, fmt::format("{} {}", name, stage.name), stage_ms(contender, stage), "ms",
                "lower");
            for (const std::string_view pass : stage.passes) {
                if (stage.passes.size() > 1 && contender.median_ms(pass) > 0.0) {
                    add(figures, fmt::format("{} {}: {}", name, stage.name, pass),
                        contender.median_ms(pass), "ms", "lower");
                }
            }
        }
        add(figures, name + " total", total_ms(contender), "ms", "lower");
        add(figures, name + " processor", entrant.processor_ms(), "ms", "lower");
        add(figures, name + " processor before gaze", entrant.before_gaze_processor_ms(), "ms",
            "lower");
    }

    /// What the scene does not need, as time that it does not take.
    void add_left_out(std::vector<Figure>& figures) const {
        const Contender& kfr = entrant(kKfr).contender;
        const Contender& all = entrant(kKfrAll).contender;
        for (const Stage& stage : kStages) {
            if (stage_ms(kfr, stage) == 0.0 && stage_ms(all, stage) > 0.0) {
                add(figures, fmt::format("left out: {}", stage.name), stage_ms(all, stage), "ms",
                    "higher");
            }
        }
        add(figures, "left out: all saves", total_ms(all) - total_ms(kfr), "ms", "higher");
    }

    void add_pass_two(std::vector<Figure>& figures) const {
        const double resolve_ms = stage_ms(entrant(kKfr).contender, kStages[kPassTwo]);
        add(figures, "blit", blit_->median_ms(), "ms", "lower");
        add(figures, "pass II over blit", resolve_ms / blit_->median_ms(), "x", "lower").target =
            1.5;
        add(figures, "pass II over full", 100.0 * resolve_ms / total_ms(entrant(kFull).contender),
            "%", "lower")
            .target = 5.0;
    }

    const vulkan::Context& context_;
    scene::Scene& scene_;
    const Case& case_;
    unsigned rounds_;
    RaycastSetup setup_;
    render::MethodConfig config_;
    std::vector<Entrant> contenders_;
    std::optional<PlainBlit> blit_;
};

}  // namespace

std::vector<Figure> kfr_mesh(const Options& options) {
    const vulkan::Context context({}, nullptr);
    const auto scene = scene::make_scene(context, "gallery");
    const auto all_scene = scene::make_scene(context, "gallery", {.require_all = true});
    std::vector<Figure> figures;
    for (const Case& at : kCases) {
        if (options.wants(fmt::format("{}x{}", at.extent.width, at.extent.height))) {
            Measurement(context, *scene, *all_scene, at, options).run(figures);
        }
    }
    return figures;
}

}  // namespace gazeloop::bench
